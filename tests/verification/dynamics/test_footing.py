"""Strip footing in plane strain under a suddenly applied load, against a small-strain program of another make.

Reference: converged linear u-p solution on the same meshes and with the same 50 Newmark steps (9-4 node quadrilaterals).
"""
import unittest

from compared_case import problem
from dynamics_case import SCALE, DynamicsCase


@problem("benchmark", "small-strain program of another make, same mesh and steps",
         "Strip footing under a sudden load")
class Footing(DynamicsCase):
    def test_settlement_and_pressure(self):
        history = self.run_deck(self.deck("dynamic_footing", "footing"))
        self.assertEqual(len(history.time), 50)
        settlement, pressure = -history["probe/centre/displacement y"][-1], history["probe/two metres down/pore pressure"][-1]
        self.compare_values("settlement", settlement, 2.25017e-2 * SCALE, 1e-3, 2.25017e-2 * SCALE)
        self.compare_values("pressure", pressure, 53.72e3 * SCALE, 1e-3, 53.72e3 * SCALE)


if __name__ == "__main__":
    unittest.main()
