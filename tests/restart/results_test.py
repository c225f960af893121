"""The results of a run: depth, resistance and dissipation of each stage in <stem>.results.csv, the same after a restart."""
import csv
import math
import os
import unittest

import numpy as np
from mudline_case import History
from restart_test import RestartCase, settings
from stages_test import ANCHOR, COLUMN, TERZAGHI

DURATION = 833.3333333333333  # of Terzaghi's deck, a time factor of 1


class Results(RestartCase):
    def results(self, name):
        """Values by stage, what they are of, and quantity."""
        with open(self.result(name, ".results.csv"), newline="") as file:
            return {(row["stage"], row["of"], row["quantity"]): float(row["value"]) for row in csv.DictReader(file)}

    def test_dissipation(self):
        for ranks in (1, 2):
            self.runs(TERZAGHI, *COLUMN, *settings("stages/consolidation/duration=1000"), "--overwrite", ranks=ranks)
            found = self.results("terzaghi")
            pressure = History(self.result("terzaghi", ".csv"))["probe/base/pore pressure"]
            highest = found["consolidation", "soil", "highest excess pore pressure"]
            self.assertAlmostEqual(highest, pressure.max(), delta=1e-3 * highest)
            self.assertAlmostEqual(found["consolidation", "soil", "excess pore pressure at the end"], pressure[-1],
                                   delta=1e-6 * highest)
            # Terzaghi's first term is exact here to 1e-6
            for name, left in (("half", 0.5), ("nine tenths", 0.1)):
                after = found["consolidation", "soil", f"excess pore pressure {name} dissipated after"]
                self.assertLess(abs(after / (4 / math.pi**2 * math.log(4 / math.pi / left) * DURATION) - 1), 5e-3, name)

    def test_body(self):
        self.runs(*ANCHOR, *settings("output/name=anchor"))
        found, history = self.results("anchor"), History(self.result("anchor", ".csv"))
        force = next(history[name] for name in history.columns if name.startswith("contact/") and name.endswith("/reaction y"))
        y = history["body/anchor/position y"]
        starts = 0
        for stage in ("fall", "dissipation", "pull-out"):
            end = int(np.argmin(np.abs(history.time - history.time[max(starts - 1, 0)] - found[stage, "stage", "duration"])))
            rows = slice(starts, end + 1)
            self.assertEqual(found[stage, "anchor", "resistance"], force[end])
            self.assertEqual(found[stage, "anchor", "highest resistance"], force[rows].max())
            self.assertEqual(found[stage, "anchor", "lowest resistance"], force[rows].min())
            depth = found["", "anchor", "depth of the tip at the start"] + y[0] - history["body/anchor/displacement y"][0] - y
            self.assertAlmostEqual(found[stage, "anchor", "depth of the tip"], depth[end], places=9)
            self.assertAlmostEqual(found[stage, "anchor", "depth at the highest resistance"],
                                   depth[rows][force[rows].argmax()], places=9)
            starts = end + 1

    def test_the_same_after_a_restart(self):
        deck = [*ANCHOR, *settings("output/name=anchor")]
        self.runs(*deck)
        whole = self.content("anchor", ".results.csv")
        self.runs(*deck, *settings("output/name=cut"), "--steps", "30")
        self.assertNotEqual(self.content("cut", ".results.csv"), whole)
        self.runs(*deck, *settings("output/name=cut"), "--restart")
        self.assertEqual(self.content("cut", ".results.csv"), whole)
        # a branch knows what came before it
        self.runs(*deck, *settings("output/name=branch", "start/from=results/anchor@fall"))
        self.assertEqual(self.content("branch", ".results.csv"), whole)
        # a new run leaves nothing of the old one
        self.runs(*deck, "--steps", "1")
        self.assertEqual({stage for stage, _, _ in self.results("anchor")}, {"", "fall"})


if __name__ == "__main__":
    unittest.main()
