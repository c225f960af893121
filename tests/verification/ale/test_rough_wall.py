"""A rough cone in clay out of which no water flows: the clay along its face keeps its void ratio and is critical."""
import os
import pathlib
import sys
import unittest

from compared_case import problem
from mudline_case import PROGRAM, ROOT, SharedRun

sys.path[:0] = [os.path.join(ROOT, folder) for folder in ("docs/benchmarks", "python")]
import cone_influences  # noqa: E402

ROW = "sealed, alpha 1"


@problem(title="Rough cone in clay that cannot drain: strain of the water")
class RoughWall(SharedRun):
    """A row of docs/benchmarks/cone_influences.md: 1.6 radii deep, adhesion 1, hydraulic conductivity 1e-14 m/s."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = pathlib.Path(cls.shared.folder)
        cone_influences.folder_of(folder, ROW).mkdir()
        cone_influences.run(PROGRAM, folder, ROW)
        cls.void_ratio, cls.mean_stress = cone_influences.along_face(folder, ROW)

    @problem("exact", "no water flows; critical state at the void ratio of the start")
    def test_along_the_face(self):
        self.assertGreater(len(self.void_ratio), 10)
        exact = cone_influences.VOLUME - 1
        self.compare_values("void ratio along the face, mean", self.void_ratio.mean(), exact, 0.002)
        self.compare_values("void ratio along the face", self.void_ratio, exact, 0.01)
        self.compare_values("mean effective stress along the face", self.mean_stress.mean(),
                            cone_influences.critical_stress(), 0.02)


if __name__ == "__main__":
    unittest.main()
