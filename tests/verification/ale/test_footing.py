"""A smooth strip footing pushed into Tresca clay (G/s_u = 100): while the mesh that goes with the soil is still good, the one that
moves against it must give the same resistance."""
import os
import unittest

import numpy as np

from compared_case import problem
from mudline_case import ROOT, MudlineCase, deck_text

DECK = os.path.join(ROOT, "inputs", "bearing_capacity", "strip_tresca.xml")
WIDTH, STRENGTH = 2.0, 10e3
SOFT = {"materials": {"soil": {"skeleton": {"type": "tresca", "rigidity index": 100.0}}},
        "boundary conditions": {"footing": {"type": "displacement", "y": "-0.03*t"}}}


@problem("consistency", title="Strip footing on a moving mesh against the material mesh")
class Footing(MudlineCase):
    def test_both_agree_to_a_settlement_of_one_and_a_half_per_cent(self):
        soft = self.write("soft.xml", deck_text("soft", SOFT))
        moving = self.write("moving.xml", deck_text("moving", {"mesh motion": {"every": 1}}))
        lagrangian = self.run_deck([DECK, soft], ["output/name=lagrangian"], name="lagrangian")
        ale = self.run_deck([DECK, soft, moving], ["output/name=ale"], name="ale")
        column = "reaction/footing y"
        times = np.linspace(0.1, 1.0, 19)
        one = np.array([-lagrangian.at(column, t) for t in times])
        other = np.array([-ale.at(column, t) for t in times])
        if os.environ.get("MUDLINE_SHOW_ERRORS"):
            print("N at the end:", one[-1] / STRENGTH, other[-1] / STRENGTH, "largest difference:", np.abs(other / one - 1).max())
        self.assertGreater(one[-1], 4.5 * STRENGTH)  # near collapse: half the width of 2 m bears
        self.compare("resistance against the material mesh", np.abs(other / one - 1).max(), 1e-2)


if __name__ == "__main__":
    unittest.main()
