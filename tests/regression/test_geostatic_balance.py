"""The start of the torpedo anchor in clay: its tip stands in a hole whose wall is held until the body comes."""
import os
import re
import unittest

from mudline_case import ROOT, History, MudlineCase, deck_text, program

CLAY = os.path.join(ROOT, "inputs", "torpedo", "clay.xml")


class GeostaticBalance(MudlineCase):
    """The tip's traction in the large box of clay.xml: its forces are small beside the weight of the box."""

    def run_deck(self, name, *more, steps=1):
        settings = ("mesh/parameters/fine=0.2", "output/name=" + name)
        return program(["run", CLAY, *more, "--steps", str(steps)] + [word for setting in settings for word in ("--set", setting)],
                       folder=self.folder)

    def traction(self, factor):
        """An overlay that holds the tip by the traction of the initial state times a factor, on an ogive, instead of
        the support. The deck's surcharge, which fades with depth, acts there too."""
        surcharge, vertical = "10e3*max(0, 1+y/1.07)", "(10e3-7250.9*y)"
        return self.write("traction.xml", deck_text("traction", {"boundary conditions": {"tip at rest": {
            "type": "traction", "x": f"{factor}*(0.6*{vertical}-{surcharge})*(x+4.01255)/4.54755",
            "y": f"{factor}*({vertical}-{surcharge})*y/4.54755"}}}))

    def balanced(self, done):
        """The largest displacement that equilibrium needed [m]."""
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])
        return float(re.search(r"balanced in [1-9]\d* iterations, largest displacement (\S+) m", done.stdout).group(1))

    def test_right_traction(self):
        self.assertLess(self.balanced(self.run_deck("traction", self.traction(1.0))), 1e-4)

    def test_wrong_traction(self):
        done = self.run_deck("traction", self.traction(1.1))
        self.assertEqual(done.returncode, 3, done.stdout[-2000:] + done.stderr[-2000:])
        self.assertIn("stages/geostatic/balance tolerance", done.stdout + done.stderr)

    def test_support(self):
        """It holds the wall as the traction does, surcharge and water included, and lets it go in the next stage."""
        by_traction, by_support = "traction", "support"
        self.balanced(self.run_deck(by_traction, self.traction(1.0), steps=12))
        self.assertLess(self.balanced(self.run_deck(by_support, steps=12)), 1e-8)
        traction, support = (History(os.path.join(self.folder, "results", name + ".csv")) for name in (by_traction, by_support))
        self.assertEqual(len(traction.time), len(support.time))
        for column in ("body/anchor/velocity y", "contact/anchor/reaction y", "balance/energy/stress divergence"):
            error = abs(support[column] - traction[column]).max() / abs(traction[column]).max()
            self.assertLess(error, 1e-3, column)
        self.assertEqual(abs(support["balance/energy/in-situ support/tip at rest"]).max(), 0)


if __name__ == "__main__":
    unittest.main()
