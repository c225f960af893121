"""Strip footing in plane strain under a suddenly applied load, against a small-strain program of another make.

Reference: converged linear u-p solution on the same meshes and with the same 50 Newmark steps (9-4 node quadrilaterals).
"""
import unittest

from dynamics_case import SCALE, DynamicsCase


class Footing(DynamicsCase):
    def test_settlement_and_pressure(self):
        history = self.run_deck(self.deck("dynamic_footing", "footing"))
        self.assertEqual(len(history.time), 50)
        settlement, pressure = -history["probe/centre/displacement y"][-1], history["probe/two metres down/pore pressure"][-1]
        self.assert_within("settlement", settlement, 2.25017e-2 * SCALE, 1e-3, 2.25017e-2 * SCALE)
        self.assert_within("pressure", pressure, 53.72e3 * SCALE, 1e-3, 53.72e3 * SCALE)


if __name__ == "__main__":
    unittest.main()
