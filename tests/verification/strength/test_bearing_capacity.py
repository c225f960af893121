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
        decks = [deck] if isinstance(deck, str) else deck
        history = self.run_deck([self.deck("bearing_capacity", d) for d in decks], settings)
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

    def assert_sequence(self, deck, settings, exact, tolerances):
        """{cells: tolerance}: each mesh above the exact load, and closer to it than the coarser one."""
        before = np.inf
        for cells, tolerance in tolerances.items():
            factor = self.assert_collapse(f"{cells} cells", deck, settings + (f"mesh/parameters/cells={cells}",), exact, tolerance)
            self.assertLess(factor, before)
            before = factor

    def test_strip_phi_20(self):
        self.assert_sequence("strip_mohr_coulomb", (), 14.834712, {4: 0.03, 6: 0.015, 8: 0.01})

    def test_strip_phi_30(self):
        self.assert_sequence(["strip_mohr_coulomb", "phi_30"], (), 30.139628, {4: 0.045, 6: 0.03})

    def test_strip_phi_30_with_surcharge(self):
        self.assert_sequence(["strip_mohr_coulomb", "phi_30", "surcharge"], (), 66.94187, {4: 0.045, 6: 0.03})


if __name__ == "__main__":
    unittest.main()
