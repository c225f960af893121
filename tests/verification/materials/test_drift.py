"""Simple shear to gamma = 5 and back: no law leaves its yield surface, with any integration.

The yield functions are written here once more, from the stress components of the results (docs/materials.md). Sheared, the Lode
angle stays away from the rounded corners.
"""
import os
import unittest

import numpy as np

from compared_case import problem
from mudline_case import MudlineCase, point_deck

TOLERANCE = 1e-9  # the default `yield tolerance`
METHODS = ("implicit", "modified euler", "runge-kutta-dormand-prince")
ELASTIC = {"Young's modulus": 2e7, "Poisson's ratio": 0.3}


def tensors(history):
    """Stresses, tension positive, as matrices."""
    c = lambda name: -history[name]
    xx, yy, zz = (c(f"effective stress {d}") for d in ("xx", "yy", "zz"))
    yz, xz, xy = (c(f"shear stress {d}") for d in ("yz", "xz", "xy"))
    return np.moveaxis(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]), -1, 0)


def invariants(history):
    """p' (compression positive), J2, sin(3 theta), which is 1 in triaxial compression."""
    stress = tensors(history)
    p = -np.trace(stress, axis1=1, axis2=2) / 3
    s = stress + p[:, None, None] * np.eye(3)
    j2 = 0.5 * np.einsum("nij,nij->n", s, s)
    return p, j2, -1.5 * np.sqrt(3) * np.linalg.det(s) / np.maximum(j2, 1e-30) ** 1.5


def cam_clay(lode):
    def f(history, M=1.2):
        p, j2, lode_sine = invariants(history)
        sine = 3 * M / (6 + M)
        a4 = ((3 - sine) / (3 + sine)) ** 4
        m4 = M ** 4 * (2 * a4 / (1 + a4 - (1 - a4) * lode_sine) if lode == "sheng" else 1.0)
        pc = history["preconsolidation pressure"]
        return (3 * j2 / np.sqrt(m4) + p * (p - pc)) / pc ** 2
    return f


def mohr_coulomb(history, c=5e3, phi=np.radians(30.0), apex=0.05):
    p, j2, lode_sine = invariants(history)
    theta = np.arcsin(np.clip(lode_sine, -1, 1)) / 3
    assert np.abs(theta[1:]).max() < np.radians(29)
    K = np.cos(theta) - np.sin(theta) * np.sin(phi) / np.sqrt(3)
    strength = c * np.cos(phi)
    return (np.sqrt(j2 * K ** 2 + (apex * strength) ** 2) - p * np.sin(phi) - strength) / (strength + p * np.sin(phi))


def drucker_prager(history, c=5e3, phi=np.radians(25.0), apex=0.05):
    p, j2, _ = invariants(history)
    slope = 6 * np.sin(phi) / (np.sqrt(3) * (3 - np.sin(phi)))
    strength = slope * c / np.tan(phi)
    return (np.sqrt(j2 + (apex * strength) ** 2) - slope * p - strength) / (strength + slope * p)


def tresca(history, strength=20e3, sensitivity=3.0, ductility=5.0):
    principal = np.linalg.eigvalsh(tensors(history))
    soft = 1 / sensitivity + (1 - 1 / sensitivity) * np.exp(-3 * history["accumulated plastic shear strain"] / ductility)
    return 0.5 * (principal[:, 2] - principal[:, 0]) / strength - soft


def von_mises(history, start=40e3, slope=50e3):
    _, j2, _ = invariants(history)
    return (np.sqrt(3 * j2) - start - slope * history["equivalent plastic strain"]) / start


CLAY = {"type": "modified cam clay", "critical stress ratio": 1.2, "compression slope": 0.15, "swelling slope": 0.03, "Poisson's ratio": 0.3}
LAWS = {"clay": (CLAY, cam_clay("none")),
        "clay, Lode": (dict(CLAY, **{"lode dependence": "sheng"}), cam_clay("sheng")),
        "sand": (dict(ELASTIC, **{"type": "mohr-coulomb", "cohesion": 5e3, "friction angle [deg]": 30.0}), mohr_coulomb),
        "cone": (dict(ELASTIC, **{"type": "drucker-prager", "match": "compression", "cohesion": 5e3, "friction angle [deg]": 25.0}), drucker_prager),
        "tresca": ({"type": "tresca", "undrained strength": 20e3, "rigidity index": 100.0, "Poisson's ratio": 0.49, "sensitivity": 3.0,
                    "ductility": 5.0}, tresca),
        "metal": (dict(ELASTIC, **{"type": "von mises", "yield stress": 40e3, "hardening modulus": 50e3}), von_mises)}


@problem("exact", "the yield functions", "Drift from the yield surface")
class Drift(MudlineCase):
    def test_no_law_leaves_its_surface(self):
        for name, (skeleton, yield_function) in LAWS.items():
            for method in METHODS:
                tests = {f"shear {ocr}": {"type": "simple shear", "shear strain": [5.0, -5.0], "steps": 250,
                                          "initial state": {"mean effective stress": 1e5, "overconsolidation ratio": float(ocr)}}
                         for ocr in ((1, 4) if "clay" in name else (1,))}
                histories = self.run_point(self.write("soil.xml", point_deck(dict(skeleton, integration=method), tests)))
                for history in histories.values():
                    self.assertEqual(len(history.time), 501)
                    f = yield_function(history)
                    if os.environ.get("MUDLINE_SHOW_ERRORS"):
                        print(f"{name}, {method}: f up to {f.max():.1e}, at yield in {np.mean(np.abs(f) < 1e-6):.0%} of the rows")
                    self.compare(f"{name}, {method}: yield function", f.max(), 2 * TOLERANCE)
                    self.assertGreater(np.mean(np.abs(f) < TOLERANCE * 10), 0.8, "it should yield most of the way")

    def test_yield_tolerance(self):
        """What lies outside by less than the tolerance is left there; the rest is taken back."""
        skeleton, yield_function = LAWS["sand"]
        for tolerance in (1e-4, 1e-6):
            test = {"shear": {"type": "simple shear", "shear strain": [5.0], "steps": 250, "initial state": {"mean effective stress": 1e5}}}
            law = dict(skeleton, **{"integration": "modified euler", "yield tolerance": tolerance})
            f = yield_function(self.run_point(self.write("soil.xml", point_deck(law, test)))["shear"]).max()
            self.compare("yield function", f, 2 * tolerance)
            self.assertGreater(f, 10 * TOLERANCE)


if __name__ == "__main__":
    unittest.main()
