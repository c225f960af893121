"""Clay and sand of the cavity decks, and how a run is compared with an exact solution."""
import numpy as np

from references.cavity import CamClayRates, MohrCoulombRates
from strength_case import StrengthCase

KPA = 1e3
DRAINED = "materials/soil/permeability/hydraulic conductivity=1e4"
AREA = {1: lambda a: 2 * np.pi * a, 2: lambda a: 0.5 * np.pi ** 2 * a ** 2}  # of a slice; horizontal projection of a hemisphere


def clay(start, ocr):
    return CamClayRates(M=1.2, slope=0.15, swelling=0.03, nu=0.3, v0=2.0, start=start, ocr=ocr)


def sand(k):
    return MohrCoulombRates(E=20e3, nu=0.3, c=5.0, phi=30.0, psi=10.0, start=(100.0, 100.0, 100.0), k=k)


class CavityCase(StrengthCase):
    def compare_pressures(self, what, history, k, solution, tolerance, pore_tolerance=None):
        """Pressures at 1.2, 2 and 4 radii within `tolerance`, excess pore pressure within `pore_tolerance`, of the values."""
        radius = 1 + 3 * history.time ** 2
        pressure = history["reaction/cavity x"] / AREA[k](radius) / KPA
        for a in (1.2, 2.0, 4.0):
            at = solution.at(a)
            exact = at[0][0] if pore_tolerance is None else at[1]
            self.compare_values(f"{what}, pressure at {a:g} radii", np.interp(a, radius, pressure), exact, tolerance)
            if pore_tolerance is not None:
                pore = np.interp(a, radius, history["probe/wall/pore pressure"]) / KPA
                self.compare_values(f"{what}, pore pressure at {a:g} radii", pore, at[2], pore_tolerance)
