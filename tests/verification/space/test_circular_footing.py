"""Rigid circular footings on Tresca clay, a quarter of each in ten-node tetrahedra, against slip-line theory: met from above."""
import unittest

import numpy as np

from space_case import SpaceCase

STRENGTH = 10e3
ROUGH = ("boundary conditions/footing/x=0.0", "boundary conditions/footing/y=0.0", "mesh/plane/parameters/cells=6", "mesh/plane/parameters/ratio=30")


class CircularFooting(SpaceCase):
    def factor(self, deck, settings, area):
        """Bearing capacity factor of a quarter of the footing, and how much it still grows over the last tenth of the way."""
        history = self.run_deck(self.input(deck), settings)
        factor = -history["reaction/footing z"] / area / STRENGTH
        return factor[-1], factor[-1] / np.interp(0.9, history.time, factor) - 1

    def assert_collapse(self, what, settings, exact):
        factor, growth = self.factor("circular_footing", settings, np.pi / 4)
        self.assert_near(what, factor, exact, 0.03)
        self.assertGreater(factor, exact)
        self.assert_near(what + ", growth at the end", growth, 0.0, 0.01, 1.0)

    def test_smooth(self):
        self.assert_collapse("smooth", (), 5.6893)

    def test_rough(self):
        self.assert_collapse("rough", ROUGH, 6.048)


if __name__ == "__main__":
    unittest.main()
