"""Pore pressure in soil whose displacements are held: it must leave by the storage of water and grains alone."""
import unittest

import numpy as np

from compared_case import problem
from consolidation_case import ConsolidationCase, between
from references import biot

TIMES = np.array([0.05, 0.1, 0.2, 0.5, 1.0])
STORAGE, MOBILITY = 2.75e-8, 1e-10


@problem("exact", "Terzaghi's series with the storage of water and grains", "Pore pressure in immovable soil")
class PressureDecay(ConsolidationCase):
    def test_decay(self):
        history = self.run_deck(self.deck("pressure_decay"))
        column = biot.Column(biot.INCOMPRESSIBLE, load=10.0)  # the same series, with its own time scale below
        for probe, depth in (("middle", 0.5), ("base", 1.0)):
            self.compare_values(f"p {probe}",
                                between(history, f"probe/{probe}/pore pressure", TIMES * STORAGE / MOBILITY),
                                [column.pressure(depth, T) for T in TIMES], 1e-3)
            self.assertEqual(np.abs(history[f"probe/{probe}/displacement y"]).max(), 0.0)
        self.assertLess(np.abs(history["balance/water/error"]).max(), 1e-12)

    def test_without_storage_it_vanishes_at_once(self):
        """Nothing holds the pressure in incompressible, immovable soil."""
        history = self.run_deck(self.deck("pressure_decay"), (
            "materials/soil/fluid/incompressible=true", "materials/soil/grain bulk modulus=0", "materials/soil/Biot coefficient=1",
            "stages/consolidation/duration=0.02"))
        self.compare_values("p base", history["probe/base/pore pressure"][0], 0.0, 1e-9, scale=10.0)


if __name__ == "__main__":
    unittest.main()
