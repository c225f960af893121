"""A rigid rough square footing on Tresca clay, a quarter of it in ten-node tetrahedra, between published bounds."""
import unittest

import numpy as np

from space_case import SpaceCase

STRENGTH = 10e3


class SquareFooting(SpaceCase):
    def test_rough(self):
        history = self.run_deck(self.input("square_footing"))
        factor = -history["reaction/footing z"] / STRENGTH
        self.assert_near("rough", factor[-1], 5.85, 0.35, 1.0)  # 5.5 to 6.2
        self.assert_near("rough, growth at the end", factor[-1] / np.interp(0.9, history.time, factor) - 1, 0.0, 0.01, 1.0)


if __name__ == "__main__":
    unittest.main()
