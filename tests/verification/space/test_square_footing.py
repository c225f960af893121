"""A rigid rough square footing on Tresca clay, a quarter of it in ten-node tetrahedra, between published bounds."""
import unittest

import numpy as np

from compared_case import problem
from mudline_case import program
from space_case import SpaceCase

STRENGTH = 10e3


@problem("benchmark", "published bounds of a rough square footing", "Square footing on Tresca clay")
class SquareFooting(SpaceCase):
    def test_rough(self):
        history = self.run_deck(self.input("square_footing"))
        factor = -history["reaction/footing z"] / STRENGTH
        self.compare_values("rough", factor[-1], 5.85, 0.35, 1.0)  # 5.5 to 6.2
        self.compare_values("rough, growth at the end", factor[-1] / np.interp(0.9, history.time, factor) - 1, 0.0,
                            0.01, 1.0)

    def test_linear_cells_do_not_lock(self):
        """A uniform mesh with sides of a tenth of the footing; without the fitted volume strain the factors are above 20."""
        for corners, most in ((8, 1.12), (6, 1.19)):
            with self.subTest(corners=corners):
                history = self.run_deck(self.input("square_footing"), (
                    "mesh/order=1", f"mesh/parameters/corners={corners}", "mesh/parameters/ratio=1"))
                factor = -history["reaction/footing z"][-1] / STRENGTH
                self.compare_range(f"{corners} corners", factor, 5.5, 6.05 * most)

    def test_fitted_tetrahedra(self):
        """Sides of a sixth of the footing: 7.71 with the volume strain at the points."""
        history = self.run_deck(self.input("square_footing"), (
            "mesh/parameters/cells=3", "mesh/parameters/ratio=1", "physics/ground/volume strain=fitted"))
        factor = -history["reaction/footing z"][-1] / STRENGTH
        self.compare_range("fitted tetrahedra", factor, 5.5, 6.05 * 1.1)

    @problem("behaviour")
    def test_nothing_to_fit_is_refused(self):
        done = program(["check", self.input("square_footing"), "--set", "mesh/order=1", "--set", "physics/ground/volume strain=fitted"],
                       1, self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("physics/ground/volume strain: 'fitted' has no effect in tet4 cells with 4 points", done.stderr)


if __name__ == "__main__":
    unittest.main()
