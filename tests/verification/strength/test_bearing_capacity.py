"""Rigid footings on weightless soil, pushed down until they fail, against slip-line theory.

Displacement elements meet the collapse load from above; the tests ask for how far above on the decks' mesh, and for the way there.
"""
import unittest

import numpy as np

from strength_case import StrengthCase

COHESION = 10e3
ROUGH = ("boundary conditions/footing/x=0.0",)
CIRCLE = ("mesh/geometry=axisymmetric", "boundary conditions/footing/y=-8e-5*t")


def mesh(cells, triangles=True):
    return (f"mesh/parameters/cells={cells}", f"mesh/parameters/triangles={int(triangles)}",
            f"physics/ground/quadrature degree={2 if triangles else 4}")


class BearingCapacity(StrengthCase):
    def factor(self, deck, settings, area=1.0):
        """Bearing capacity factor, and how much it still grows over the last tenth of the way."""
        history = self.run_deck(self.deck("bearing_capacity", deck), settings)
        factor = -history["reaction/footing y"] / area / COHESION
        return factor[-1], factor[-1] / np.interp(0.9, history.time, factor) - 1

    def assert_collapse(self, what, deck, settings, exact, tolerance, area=1.0):
        factor, growth = self.factor(deck, settings, area)
        self.assert_between(what, factor / exact, 1.0, 1 + tolerance)
        self.assert_between(what + ", growth at the end", growth, -1e-4, 0.01)
        return factor

    def test_smooth_strip_on_clay(self):
        coarse = self.assert_collapse("4 cells", "strip_tresca", mesh(4, False), 5.141593, 0.04)
        fine = self.assert_collapse("6 triangles", "strip_tresca", mesh(6), 5.141593, 0.015)
        self.assertLess(fine, coarse)

    def test_rough_strip_on_clay(self):
        self.assert_collapse("rough", "strip_tresca", mesh(8) + ROUGH + ("mesh/parameters/ratio=30",
                             "boundary conditions/footing/y=-8e-5*t"), 5.141593, 0.02)

    def test_rough_circle_on_clay(self):
        self.assert_collapse("rough circle", "strip_tresca", mesh(8) + ROUGH + CIRCLE, 6.048, 0.02, np.pi)

    def test_smooth_circle_on_clay(self):
        self.assert_collapse("smooth circle", "strip_tresca", mesh(5) + CIRCLE, 5.6893, 0.02, np.pi)

    def test_smooth_strip_on_frictional_soil(self):
        quads = tuple(f"mesh/parameters/{s}" for s in ("ratio=10",))
        coarse = self.assert_collapse("4 cells", "strip_mohr_coulomb", mesh(4, False) + quads, 14.834712, 0.06)
        fine = self.assert_collapse("8 cells", "strip_mohr_coulomb", mesh(8, False) + quads, 14.834712, 0.025)
        self.assertLess(fine, coarse)


if __name__ == "__main__":
    unittest.main()
