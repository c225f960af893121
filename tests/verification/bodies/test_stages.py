"""A body through its stages: held, falling, resting, pulled out; ranks and restarts."""
import os
import re
import unittest

import numpy as np
from compared_case import problem
from mudline_case import ROOT, MudlineCase

CYCLE = os.path.join(ROOT, "inputs", "impact", "fall_and_pull_out.xml")
WEIGHT = 400 * 9.81
PULLED = "stages/pull-out/duration=10"  # past the ramp; test_life_of_an_anchor goes on until it is out


@problem("exact", "equilibrium of forces and the prescribed motion", "Stages of an anchor")
class Stages(MudlineCase):
    def test_life_of_an_anchor(self):
        history = self.run_deck(CYCLE)
        t, y, v = history.time, history["body/anchor/position y"], history["body/anchor/velocity y"]
        reaction, load = history["contact/seabed/reaction y"], history["body/anchor/load y"]
        self.assertEqual(y[0], 0.02)  # held in the geostatic stage
        fall, rest, pull = (t > 0) & (t <= 0.1), (t > 0.1) & (t <= 2e4 + 0.1), t > 2e4 + 0.1
        flight = fall & (t < 0.011)
        # let go with 1 m/s, falling by less than its weight: buoyancy and drag
        self.assertTrue(np.all(np.abs(v[flight] + 1) < 9.81 * t[flight]))
        self.assertTrue(np.all(history["body/anchor/acceleration y"][flight] < -5))
        self.assertGreater(v[fall].max(), 0.5)  # it is thrown back
        # at rest the soil bears the weight less the water displaced above the mudline
        self.compare("reaction at rest", np.abs(reaction[rest] + load[rest]).max() / WEIGHT, 1e-5)
        self.compare("speed at rest", abs(v[rest][-1]), 1e-6)
        # the pull: the prescribed velocity after its ramp, and the force that it takes
        self.compare("speed of the pull", np.abs(v[pull][t[pull] > 2e4 + 5.2] - 1e-3).max(), 1e-15)
        self.compare("way of the pull", abs(y[pull][-1] - y[rest][-1] - 1e-3 * (40 - 2.5)), 1e-12)
        self.assertEqual(np.abs(load[pull]).max(), 0.0)
        driving = history["body/anchor/driving force y"]
        self.compare("driving force", np.abs(driving[pull] + reaction[pull]).max() / WEIGHT, 1e-9)
        self.assertEqual(reaction[-1], 0.0)  # out
        tip, shaft = history["contact/seabed/tip reaction y"], history["contact/seabed/shaft reaction y"]
        self.compare("tip and shaft against the whole", np.abs(tip + shaft - reaction).max() / WEIGHT, 1e-9)

    @problem("consistency")
    def test_ranks(self):
        one = self.run_deck(CYCLE, (PULLED,))
        many = self.run_deck(CYCLE, (PULLED, "output/name=on4"), ranks=4, name="on4")
        self.assertEqual(one.header, many.header)
        own = [name for name in one.columns if not re.search("/error|iterations|numerical", name)]
        self.assert_same_run(one, many, own, "4 ranks")

    def check_restart(self, ranks):
        # the solver's memory is tidied when a checkpoint is written: the whole run writes one there too
        settings = (PULLED, "output/checkpoint steps=31")
        self.run_deck(CYCLE, settings + ("output/name=whole",), ranks, name="whole")
        self.run_deck(CYCLE, settings + ("output/name=parts",), ranks, ("--steps", "30"), name="parts")
        parts = self.run_deck(CYCLE, settings + ("output/name=parts",), ranks, ("--restart",), name="parts")
        self.assertGreater(parts["contact/seabed/active points"][29], 2)  # during the impact
        self.assertEqual(self.content("whole"), self.content("parts"))

    def content(self, name):
        with open(os.path.join(self.folder, "results", name + ".csv"), "rb") as file:
            return file.read()

    @problem("behaviour")
    def test_restart(self):
        self.check_restart(1)

    @problem("behaviour")
    def test_restart_2(self):
        self.check_restart(2)


if __name__ == "__main__":
    unittest.main()
