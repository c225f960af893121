"""Modified Cam Clay with elasticity that stores energy, in `mudline point` and around a cavity, against the potential
and an independent integration (references/clay_with_energy.py). Tolerances were set before the first run."""
import os
import unittest

import numpy as np

from compared_case import problem
from mudline_case import ROOT, MudlineCase, point_deck
from references.cavity import Drained, Undrained
from references.clay_with_energy import EnergyRates, Potential, triaxial

KPA = 1e3
G = 30.0  # G/p'
NUMBERS = {"M": 1.2, "slope": 0.15, "swelling": 0.03, "v0": 2.0}
CLAY = {"type": "modified cam clay", "critical stress ratio": 1.2, "compression slope": 0.15, "swelling slope": 0.03,
        "shear modulus ratio": G}
ELASTIC = 1e-8
PATH = 1e-3  # explicit; implicit with 200 increments to 20 % axial strain
AXES = ("xx", "yy", "zz", "yz", "xz", "xy")
AXIAL = [0.005, 0.02, 0.05, 0.1, 0.2]
METHODS = ("runge-kutta-dormand-prince", "modified euler", "implicit")


def rates(ocr, start=(100.0, 100.0, 100.0)):
    return EnergyRates(G, start=start, ocr=ocr, **NUMBERS)


def start(ocr):
    return {"mean effective stress": 100 * KPA, "overconsolidation ratio": float(ocr)}


def strain_name(axis):
    return ("strain " if axis[0] == axis[1] else "shear strain ") + axis


def stress_name(axis):
    return ("effective stress " if axis[0] == axis[1] else "shear stress ") + axis


@problem("exact", "potential of Houlsby, Amorosi and Rojas (2005), on the clay's own compression line",
         "Clay whose elasticity stores energy")
class ClayWithEnergy(MudlineCase):
    def point(self, tests, clay=CLAY):
        return self.run_point(self.write("clay.xml", point_deck(clay, tests)))

    def test_elastic_path(self):
        """Six strains that turn the principal axes, inside the yield surface, at all rows."""
        strains = {"xx": "0.002*sin(3*t)", "yy": "0.006*sin(2*t)", "zz": "0.003*(1-cos(4*t))", "yz": "0.004*sin(5*t)",
                   "xz": "0.005*(1-cos(2*t))", "xy": "0.008*sin(t)"}
        path = {"type": "path", "duration": 3.0, "steps": 60,
                **{strain_name(axis): text for axis, text in strains.items()},
                "initial state": {"mean effective stress": 100 * KPA, "overconsolidation ratio": 30.0}}
        for volume in ("current", "initial"):
            potential = Potential(G, 0.03, 2.0, 100 * KPA, volume == "current")
            for method in METHODS:
                h = self.point({"path": path}, {**CLAY, "specific volume": volume, "integration": method})["path"]
                np.testing.assert_array_equal(h["plastic shear strain"], 0)
                worst = 0.0
                for row in range(1, 61):
                    exact = potential.stress([h[strain_name(axis)][row] for axis in AXES])
                    found = np.array([h[stress_name(axis)][row] for axis in AXES])
                    worst = max(worst, np.abs(np.abs(found) - np.abs(exact)).max() / exact[:3].mean())
                self.compare(f"{volume}, {method}", worst, ELASTIC)

    def test_the_work_of_the_loop_with_poissons_ratio(self):
        """The loop that docs/materials.md tells of: 222 J/m3 with a Poisson's ratio, nothing with energy. The work is
        integrated by Simpson's rule, whose error is allowed."""
        volume, shear, steps = 0.006, 0.01, 2000

        def there(k):
            return f"(min(max(t-{k},0),1)-min(max(t-{k + 2},0),1))"

        ev, eq = f"{volume}*{there(0)}", f"{shear}*{there(1)}"
        loop = {"type": "path", "duration": 4.0, "steps": 4 * steps, "strain yy": f"{ev}/3+{eq}",
                **{f"strain {axis}": f"{ev}/3-{eq}/2" for axis in ("xx", "zz")},
                "initial state": {"mean effective stress": 100 * KPA, "overconsolidation ratio": 8.0}}
        poisson = {key: value for key, value in CLAY.items() if key != "shear modulus ratio"}
        works = {}
        for name, clay in (("energy", CLAY), ("ratio", {**poisson, "Poisson's ratio": 0.3})):
            h = self.point({"loop": loop}, clay)["loop"]
            np.testing.assert_array_equal(h["plastic shear strain"], 0)
            total = np.zeros(2 * steps)
            for axis in ("xx", "yy", "zz"):
                s, e = h[f"effective stress {axis}"], h[f"strain {axis}"]
                total += (s[:-1:2] + 4 * s[1::2] + s[2::2]) / 6 * (e[2::2] - e[:-1:2])
            works[name] = np.cumsum(total)
            if name == "energy":
                self.compare("stress left", abs(h["stress difference"][-1]) / (100 * KPA), 1e-10)
                self.compare("p' left", abs(h["mean effective stress"][-1] / (100 * KPA) - 1), 1e-10)
        self.compare("work", abs(works["energy"][-1]) / works["energy"].max(), 1e-9)
        self.compare_values("work with Poisson's ratio", works["ratio"][-1], -222.0, 1 / 222)

    @problem("benchmark", "independent integration of the rate equations")
    def test_triaxial(self):
        """Elastic, then yielding: OCR 1 to 5, undrained, drained, and one-dimensional; p', q and the volume."""
        cases = [(kind, ocr) for kind in ("undrained", "drained", "oedometer") for ocr in (1, 2, 5)]
        for method in ("runge-kutta-dormand-prince", "implicit"):
            tests = {}
            for kind, ocr in cases:
                name = kind if kind == "oedometer" else "triaxial " + kind
                tests[f"{kind} {ocr}"] = {"type": name, "axial strain": AXIAL, "steps": 40,
                                          "initial state": start(ocr)}
            histories = self.point(tests, {**CLAY, "integration": method})
            for kind, ocr in cases:
                h = histories[f"{kind}_{ocr}"]
                rows = 40 * np.arange(1, len(AXIAL) + 1)
                p, q, volume, size = triaxial(rates(float(ocr)), kind, AXIAL)
                what = f"{method}, {kind}, OCR {ocr}: "
                for name, exact in (("mean effective stress", p), ("preconsolidation pressure", size)):
                    self.compare(what + name, np.abs(h[name][rows] / (exact * KPA) - 1).max(), PATH)
                self.compare(what + "q", np.abs(h["deviatoric stress"][rows] / (q * KPA) - 1).max(), PATH)
                self.compare(what + "volume", np.abs(h["volumetric strain"][rows] - volume).max(), PATH * 0.02)

    def test_undrained_strength_and_k0_are_what_the_law_says(self):
        """s_u = M/2 p' (OCR/2)^(1 - kappa/lambda) exp(v M^2/(6 g lambda)), and a virgin K0 that stays."""
        far = {"type": "triaxial undrained", "axial strain": [1.0], "steps": 400}
        tests = {str(ocr): {**far, "initial state": start(ocr)} for ocr in (1, 2, 5)}
        tests["K0"] = {"type": "oedometer", "axial stress": [400 * KPA], "steps": 200,
                       "initial state": {"vertical effective stress": 100 * KPA}}
        h = self.point(tests)
        for ocr in (1, 2, 5):
            law = 1.2 * 100 * KPA * (ocr / 2) ** 0.8 * np.exp(2 * 1.44 / (6 * G * 0.15))
            self.compare(f"OCR {ocr}", abs(h[str(ocr)]["deviatoric stress"][-1] / law - 1), 2e-3)
        ratio = h["K0"]["effective stress xx"] / h["K0"]["effective stress yy"]
        self.compare("K0", np.abs(ratio / ratio[0] - 1).max(), 1e-5)


@problem("exact", "similarity solution with the law's own rates", "Cavity in clay whose elasticity stores energy")
class Cavity(MudlineCase):
    """A cylindrical cavity in saturated clay of OCR 2 (inputs/cavity_expansion/clay_cylinder.xml)."""

    def test_cylinder(self):
        """Pressure and pore pressure at the wall against the similarity solution; as many iterations as without, 20 %
        more at most."""
        with open(os.path.join(ROOT, "inputs", "cavity_expansion", "clay_cylinder.xml")) as file:
            deck = file.read()
        plain = '<Parameter name="Poisson\'s ratio" type="double" value="0.3"/>'
        self.assertIn(plain, deck)
        with_energy = deck.replace(plain, f'<Parameter name="shear modulus ratio" type="double" value="{G}"/>')
        drained = "materials/soil/permeability/hydraulic conductivity=1e4"
        for settings, solution in (([], Undrained), ([drained], Drained)):
            exact, what = solution(rates(2.0), 1, 4.001), solution.__name__
            before = self.run_deck(self.write("plain.xml", deck), settings)
            h = self.run_deck(self.write("energy.xml", with_energy), settings)
            iterations = [run["step/newton iterations"].sum() for run in (before, h)]
            if os.environ.get("MUDLINE_SHOW_ERRORS"):
                print(what, "iterations without and with", iterations, "in", len(before.time), len(h.time), "steps")
            self.assertEqual(len(h.time), len(before.time))
            self.assertLess(iterations[1], 1.2 * iterations[0], what)
            radius = 1 + 3 * h.time ** 2
            pressure = h["reaction/cavity x"] / (2 * np.pi * radius) / KPA
            for a in (1.2, 2.0, 4.0):
                at = exact.at(a)
                total = at[1] if solution is Undrained else at[0][0]
                self.compare(f"{what}, pressure at {a:g}", abs(np.interp(a, radius, pressure) / total - 1), 1e-3)
                if solution is Undrained:
                    pore = np.interp(a, radius, h["probe/wall/pore pressure"]) / KPA
                    self.compare(f"{what}, pore pressure at {a:g}", abs(pore / at[2] - 1), 2e-3)


if __name__ == "__main__":
    unittest.main()
