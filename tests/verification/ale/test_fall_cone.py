"""A cone that falls into undrained clay, as in the fall cone test: one run of docs/measurements/fall_cone.md."""
import os
import sys
import unittest

from compared_case import problem
from mudline_case import PROGRAM, ROOT, SharedRun

sys.path.insert(0, os.path.join(ROOT, "docs", "measurements"))
import fall_cone  # noqa: E402


@problem(title="Fall cone")
class FallCone(SharedRun):
    """80 g, 30 degrees, rough, strength that grows with the rate."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.history = fall_cone.run(PROGRAM, cls.shared.folder, rate=True, roughness=1)

    @problem("exact", "work of the weight")
    def test_work(self):
        """At rest the clay has taken the work of the cone's weight, from where a sharp apex met it."""
        weight = fall_cone.MASS[30] * fall_cone.GRAVITY
        deepest = fall_cone.depth(self.history, 30).argmax()
        self.compare_values("work of the clay", self.history["contact/cone/work"][deepest],
                            weight * fall_cone.depth(self.history, 30)[deepest], 0.01)

    @problem("measured", "Llano-Serna and Contreras (2019), [fall cone](measurements/fall_cone.md)")
    def test_literature(self):
        """The largest cone factor in the literature, or a few per cent more, as the page says."""
        share = fall_cone.factor(self.history, 30) / fall_cone.BAND[1]
        self.compare_range("K over the largest in the literature", share, 0.98, 1.09, 1.0)


if __name__ == "__main__":
    unittest.main()
