"""The cone on its guide tube, from the surface to one and a half of its radii: the tube's soil opens without loss of quality and goes nowhere."""
import os
import unittest

import numpy as np

from mudline_case import ROOT, SharedRun

RADIUS, TUBE, SPEED, STRENGTH = 0.01785, 0.001785, 0.02, 10e3
OFFSET = 0.0012  # [m] the cone starts above the mudline
DEEP = 1.5  # radii


class GuideTube(SharedRun):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.run_once([os.path.join(ROOT, "inputs", "cpt", "guide_tube.xml")], [f"stages/push/duration={DEEP * RADIUS / SPEED}"])

    def test_steps_are_easy_and_the_mesh_stays_good(self):
        self.assertLessEqual(self.rejected, 0.05 * self.steps)
        self.assertLess(self.history["step/newton iterations"].mean(), 7)
        self.assertGreater(self.history["mesh/quality"].min(), 0.2)
        self.assertLess(np.abs(self.history["mesh motion/change of solid"]).max(), 1e-10)

    def test_resistance_is_that_of_a_cone_going_in(self):
        # In weightless clay a cone going in stays similar to itself: the force over its section at the mudline is constant until the
        # shoulder comes, and below the 5.69 s_u of a flat smooth circle.
        force, depth = self.history["contact/cone/reaction y"], -self.history["body/cone/displacement y"]
        section = np.pi * ((TUBE + (depth - OFFSET) * np.tan(np.pi / 6)) ** 2 - TUBE ** 2)
        inside = (depth > 0.8 * RADIUS) & (depth < 1.35 * RADIUS)
        factor = force[inside] / (section[inside] * STRENGTH)
        self.assertLess(np.abs(factor / factor.mean() - 1).max(), 0.03)
        self.assertTrue(4 < factor.mean() < 5.69, factor.mean())
        smooth = np.polyval(np.polyfit(depth[inside], force[inside], 3), depth[inside])
        self.assertLess(np.std(force[inside] - smooth) / force[inside].mean(), 0.02)


if __name__ == "__main__":
    unittest.main()
