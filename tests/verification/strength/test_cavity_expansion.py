"""Undrained expansion of cylindrical and spherical cavities in Tresca soil at finite strain.

The reference is elastic in logarithmic strain. So is the rate form of the program here: the axes of stretch do not turn, and
the increments add up to it.
"""
import unittest

import numpy as np

from compared_case import problem
from strength_case import StrengthCase


@problem("exact", "cavity in Tresca soil at finite strain", "Cylindrical cavity in Tresca clay")
class Cylinder(StrengthCase):
    def test_wall_pressure(self):
        history = self.run_deck(self.deck("cavity_expansion", "cylinder"))
        radius = 1 + 3 * history.time ** 2
        pressure = history["reaction/cavity x"] / (2 * np.pi * radius)
        for a, exact in ((1.2, 188.4409e3), (2, 206.3997e3), (4, 210.8626e3)):
            self.compare_values(f"pressure at {a} radii", np.interp(a, radius, pressure), exact, 1e-3)


@problem("exact", "cavity in Tresca soil at finite strain", "Spherical cavity in Tresca clay")
class Sphere(StrengthCase):
    def test_wall_pressure(self):
        history = self.run_deck(self.deck("cavity_expansion", "sphere"))
        radius = 1 + 3 * history.time ** 2
        pressure = history["reaction/cavity x"] / (0.5 * np.pi ** 2 * radius ** 2)
        for a, exact in ((1.2, 226.4867e3), (2, 245.9770e3), (4, 249.1179e3)):
            self.compare_values(f"pressure at {a} radii", np.interp(a, radius, pressure), exact, 5e-3)


if __name__ == "__main__":
    unittest.main()
