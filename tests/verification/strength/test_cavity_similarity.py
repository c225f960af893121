"""Expansion of spherical cavities in Modified Cam Clay, and of both kinds in Mohr-Coulomb soil, against exact similarity solutions."""
import unittest

from cavity_case import DRAINED, CavityCase, clay, sand
from compared_case import problem
from references.cavity import Drained, Undrained


@problem("exact", "similarity solutions after Yu and Houlsby (1991), Collins and Yu (1996)", "Cavities")
class Similarity(CavityCase):
    def test_sphere_in_clay(self):
        for settings, solution, tolerances in (([], Undrained(clay((100.0,) * 3, 2.0), 2, 4.001), (2e-3, 1e-2)),
                                               ([DRAINED, "mesh/parameters/sectors=4"], Drained(clay((100.0,) * 3, 2.0), 2, 4.001), (2e-3,))):
            history = self.run_deck(self.deck("cavity_expansion", "clay_sphere"), settings)
            self.compare_pressures(type(solution).__name__, history, 2, solution, *tolerances)

    def test_sand(self):
        for name, k in (("cylinder", 1), ("sphere", 2)):
            history = self.run_deck(self.deck("cavity_expansion", "sand_" + name))
            self.compare_pressures(name, history, k, Drained(sand(k), k, 4.001), 2e-3)


if __name__ == "__main__":
    unittest.main()
