"""Rigid circular footings on Tresca clay, a quarter of each in ten-node tetrahedra, against slip-line theory: met from
above.

Three layers of elements around the axis give the smooth footing's factor of five to a thousandth. The solver is the
default for models of this size there, and the direct one, which takes half the time, elsewhere.
"""
import unittest

import numpy as np

from compared_case import problem
from space_case import SpaceCase

STRENGTH = 10e3
LAYERS = ("mesh/layers=3",)
FINER = ("mesh/plane/parameters/cells=6", "mesh/plane/parameters/ratio=30", "solver/linear solver/type=direct")
ROUGH = ("boundary conditions/footing/x=0.0", "boundary conditions/footing/y=0.0", *FINER)


@problem("exact", "slip-line theory: 5.69 and 6.05", "Circular footings on Tresca clay in space")
class CircularFooting(SpaceCase):
    def factor(self, deck, settings, area):
        """Bearing capacity factor of a quarter of the footing, and how much it still grows over the last tenth of the path."""
        history = self.run_deck(self.input(deck), LAYERS + settings)
        factor = -history["reaction/footing z"] / area / STRENGTH
        return factor[-1], factor[-1] / np.interp(0.9, history.time, factor) - 1

    def assert_collapse(self, what, settings, exact):
        factor, growth = self.factor("circular_footing", settings, np.pi / 4)
        self.compare_values(what, factor, exact, 0.03)
        self.assertGreater(factor, exact)
        self.compare_values(what + ", growth at the end", growth, 0.0, 0.01, 1.0)

    def test_smooth(self):
        self.assert_collapse("smooth", (), 5.6893)

    def test_rough(self):
        self.assert_collapse("rough", ROUGH, 6.048)

    @problem("exact", "Martin and Randolph (2001)")
    def test_deep_plate(self):
        """A thin plate deep in clay moves what is above it as what is below: the plane of the plate has no change of normal stress beside it, and
        no motion along it. So half of its capacity, 12.42 s_u (smooth) or 13.11 (rough; Martin and Randolph 2001), is that of a footing
        on such a surface."""
        across = ("boundary conditions/beside/type=fixed", "boundary conditions/beside/set=surface",
                  "boundary conditions/beside/components=x y")
        self.assert_collapse("smooth plate", FINER + across, 12.42 / 2)
        self.assert_collapse("rough plate", ROUGH + across, 13.11 / 2)


if __name__ == "__main__":
    unittest.main()
