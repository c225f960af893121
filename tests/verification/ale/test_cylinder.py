"""A cylinder deep in Tresca clay pushed by a tenth of its diameter and more: full flow-around, exact 9.14 smooth (Randolph & Houlsby 1984,
Martin & Randolph 2006) and 11.94 rough, per diameter and strength. The mesh goes round the cylinder."""
import os
import unittest

import numpy as np

from compared_case import problem
from mudline_case import ROOT, MudlineCase

DECKS = [os.path.join(ROOT, "inputs", "t_bar", name) for name in ("smooth.xml", "rough.xml")]
STRENGTH, DIAMETER = 10e3, 1.0


@problem("exact", "Randolph and Houlsby (1984), Martin and Randolph (2006)", "Cylinder pushed through Tresca clay")
class Cylinder(MudlineCase):
    def check(self, decks, name, duration, exact):
        history = self.run_deck(decks, (f"stages/push/duration={duration}",), name=name)
        pushed = -history["body/bar/displacement y"]
        factor = 2 * history["contact/bar/reaction y"] / (STRENGTH * DIAMETER)  # half the plane is modelled
        plateau = factor[pushed > 0.06 * DIAMETER]
        if os.environ.get("MUDLINE_SHOW_ERRORS"):
            print(f"{name}: {plateau[0]:.3f} to {plateau[-1]:.3f}, exact {exact}, {len(pushed)} steps")
        self.compare(f"{name}: resistance", np.abs(plateau / exact - 1).max(), 0.02)
        self.compare(f"{name}: evenness of the plateau", np.ptp(plateau) / exact, 0.005)
        self.assertGreater(history["mesh/quality"].min(), 0.3)

    def test_smooth(self):
        self.check(DECKS[:1], "smooth", 15.0, 9.14)

    def test_rough(self):
        self.check(DECKS, "rough", 12.0, 11.94)


if __name__ == "__main__":
    unittest.main()
