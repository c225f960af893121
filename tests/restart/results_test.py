"""The results of a run: depth, resistance and dissipation of each stage in <stem>.results.csv, the same after a restart."""
import math
import os
import unittest

import numpy as np
from mudline_case import ROOT, History, deck_text
from restart_test import RestartCase, settings
from stages_test import ANCHOR, COLUMN, TERZAGHI

DURATION = 833.3333333333333  # of Terzaghi's deck, a time factor of 1


class Results(RestartCase):
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

    def test_a_plate_that_is_lifted_has_no_wall_pressure(self):
        """By less than a hundredth of its half width, at which a body that forces hold still rests."""
        plate = [os.path.join(ROOT, "inputs", "contact", "sliding_plate.xml"),
                 *settings("contacts/face/drainage=sealed", "bodies/plate/motion/x=0*t")]
        for name, way in (("lifted", "-1e-4*min(t,1) + 2e-3*max(0,t-1.5)"), ("rests", "-1e-4*min(t,1)")):
            self.runs(*plate, *settings(f"output/name={name}", f"bodies/plate/motion/y={way}"))
            pressure = self.results(name).get(("pull", "plate", "excess pore pressure on the wall at the end"))
            area = History(self.result(name, ".csv"))["contact/face/contact area"]
            if name == "rests":
                self.assertGreater(pressure, 0)
                self.assertGreater(area[-1], 0)
            else:
                self.assertIsNone(pressure)
                self.assertEqual(area[-1], 0)

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


class Sounding(RestartCase):
    """A cone penetration test: what is told is what the columns of forces and pressures say."""
    SMALL = settings("variables/push=0.3*diameter", "mesh/size near body=0.05*diameter", "mesh motion/boundary/size near focus=0.07*diameter",
                     "output/observers/sounding/u2=0.15*diameter", "output/name=cone")  # u2: on the face, which touches
    AREA = math.pi / 4 * 0.0357**2

    def setUp(self):
        super().setUp()
        self.deck = [self.write("cone.xml", deck_text("cone", {"based on": "cpt"})), *self.SMALL]

    def test_figures(self):
        self.runs(*self.deck)
        found = {(stage, quantity): value for (stage, of, quantity), value in self.results("cone").items()
                 if of == "sounding"}
        history = History(self.result("cone", ".csv"))
        tip = history["body/cone/position y"]
        net, u2 = (history[f"cone/sounding/{name}"] for name in ("net cone resistance", "excess pore pressure u2"))
        # the reaction contains the weight of what lay above, as far as the load there has given way to the cone
        overburden = (2e3 + 1.3e3 * 10) / (1.3e3 / 6e3) * np.clip(-tip / 0.0357, 0, 1) - 6e3 * tip
        total = history["contact/cone/tip reaction y"] / self.AREA
        np.testing.assert_allclose(net, total - overburden, rtol=1e-9, atol=1e-7)
        np.testing.assert_allclose(history["cone/sounding/cone factor"], net / (2e3 + 1.3e3 * (10 - tip)), rtol=1e-9)
        np.testing.assert_allclose(history["cone/sounding/pore pressure ratio"], u2 / np.where(net > 0, net, np.inf), rtol=1e-9, atol=1e-12)
        end = int(np.argmax(history.time > 0.3 * 0.0357 / 0.02 * (1 + 1e-9))) - 1  # last row of the push
        for quantity in ("net cone resistance", "cone factor", "pore pressure ratio"):
            self.assertEqual(found["push", quantity], history["cone/sounding/" + quantity][end])
            self.assertNotIn(("dissipation", quantity), found)
        half = found["dissipation", "excess pore pressure u2 half dissipated after"]
        after, since = u2[end + 1:], history.time[end + 1:] - history.time[end]
        peak = int(np.argmax(np.abs(after)))  # a filter that the soil has just reached may swing before
        highest = found["dissipation", "highest excess pore pressure u2"]
        first = peak + int(np.argmax(np.abs(after[peak:]) <= 0.5 * highest))
        self.assertTrue(since[first - 1] < half <= since[first], (since[first - 1], half, since[first]))
        # rigidity: G/s_u of Modified Cam Clay, the same at all depths
        ratio = 1.3e3 / 6e3
        slope = ratio / (0.68**0.8 / 2 - 0.4 * ratio)
        rest = (3 - 0.6 * slope) / (3 + 1.2 * slope)
        rigidity = 3 * 0.4 / 2.6 * (1.7 * 9810 / 6e3) / 0.04 * (1 + 2 * rest) / 3 / ratio
        self.assertAlmostEqual(found["dissipation", "coefficient of consolidation"] / (0.245 * 0.01785**2 * math.sqrt(rigidity) / half), 1, places=9)
        whole = self.content("cone", ".results.csv")
        self.runs(*self.deck, "--overwrite", "--steps", "45")
        self.runs(*self.deck, "--restart")
        self.assertEqual(self.content("cone", ".results.csv"), whole)

    def test_refused(self):
        for setting, expected in (
                ("body=con", "output/observers/sounding/body: unknown body 'con' (did you mean 'cone'?)"),
                ("filter height=0", "output/observers/sounding/filter height: 0 is out of range; allowed: (0, inf)"),
                ("u3=9", "output/observers/sounding/u3: no surface of body 'cone' lies between 8.998 and 9.002 m above its reference point; it reaches from "),
                ("strengh=3", "output/observers/sounding/strengh: unknown parameter (did you mean 'strength'?)")):
            self.refused(expected, *self.deck, "--set", "output/observers/sounding/" + setting)
        for kind, more, expected in (
                ("pile", {"body": "pile", "rigidity index": 100.0}, "rigidity index: has no effect without a filter 'u2'"),
                ("t-bar", {"body": "bar"}, "type: a cone penetration test is axisymmetric; the mesh is not")):
            deck = self.write("other.xml", deck_text("other", {"based on": kind, "output": {"observers": {"test": {
                "type": "cone penetration test", **more}}}}))
            self.refused("output/observers/test/" + expected, deck)


if __name__ == "__main__":
    unittest.main()
