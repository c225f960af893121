"""What ends a stage before its duration is over, and runs that start at the end of a stage of another run."""
import math
import os
import unittest

import numpy as np
import restart_test
from mudline_case import ROOT, History, deck_text, program
from restart_test import RestartCase, settings

TERZAGHI = os.path.join(ROOT, "inputs", "consolidation", "terzaghi.xml")
BASE = "probe/base/pore pressure"
# first steps long enough for the elements at the drained surface: the pressures there do not oscillate
COLUMN = settings("mesh/cells={1, 20}", *(f"stages/consolidation/time step/{name}={value}" for name, value in (
    ("initial", 0.1), ("growth", 1.2), ("maximum", 2))))
ANCHOR = [restart_test.ANCHOR, *settings("mesh/cells={6, 5}")]


class Ends(RestartCase):
    def ends(self, stage, **entries):
        """An overlay that gives the stage one end."""
        return self.write("ends.xml", deck_text("ends", {"stages": {stage: {"ends when": {"enough": entries}}}}))

    def consolidation(self, *more, ranks=1, **entries):
        """The history of Terzaghi's column up to an end of its stage."""
        self.runs(TERZAGHI, self.ends("consolidation", **entries), *COLUMN, *more, ranks=ranks)
        return History(self.result("terzaghi", ".csv"))

    def test_share_of_excess_pressure(self):
        for ranks in (1, 2):
            column = self.consolidation("--overwrite", type="dissipated", share=0.8, ranks=ranks)
            share = column[BASE] / column[BASE].max()
            self.assertLessEqual(share[-1], 0.2)
            self.assertGreater(share[-2], 0.2)
            # the deck lasts for a time factor of 1; Terzaghi's first term is exact here to 1e-7
            expected = 4 / math.pi**2 * math.log(4 / math.pi / 0.2) * 833.3333333333333
            self.assertLess(abs(column.time[-1] / expected - 1), 5e-3)

    def test_column_falls(self):
        in_kilopascal = settings("stages/consolidation/ends when/enough/falls to=3.5e-3 kPa")
        for entries, more, limit in (({"falls to": 1.0}, in_kilopascal, 3.5), ({"falls by": 0.5}, [], None)):
            column = self.consolidation("--overwrite", *more, type="history", column=BASE, **entries)
            pressure = column[BASE]
            self.assertLessEqual(pressure[-1], limit or 0.5 * pressure.max())
            self.assertGreater(pressure[-2], limit or 0.5 * pressure.max())

    def test_column_rises(self):
        column = self.consolidation(type="history", column="probe/top/displacement y", **{"rises to": -1.0})
        self.assertEqual(len(column.time), 1)

    def test_what_it_remembers_survives_a_restart(self):
        whole = self.consolidation(type="dissipated", share=0.6).data
        deck = [TERZAGHI, os.path.join(self.folder, "ends.xml"), *COLUMN]
        self.runs(*deck, "--steps", "50")
        self.runs(*deck, "--restart")
        self.assertTrue(np.array_equal(History(self.result("terzaghi", ".csv")).data, whole))
        # a run that is over stays so, unless its end is another one
        self.runs(*deck, "--restart")
        self.assertTrue(np.array_equal(History(self.result("terzaghi", ".csv")).data, whole))
        self.runs(*deck, "--restart", *settings("stages/consolidation/ends when/enough/share=0.7"))
        self.assertGreater(len(History(self.result("terzaghi", ".csv")).time), len(whole))

    def test_body_at_rest(self):
        rest = self.ends("fall", type="at rest", body="anchor", speed=0.3)
        done = self.mudline(*ANCHOR, rest, *settings("stages/fall/duration=10", "output/name=anchor"))
        self.assertEqual(done.returncode, 0, done.stderr)
        anchor = History(self.result("anchor", ".csv"))
        last = int(np.argmax(anchor["step/dt"] > 0.1)) - 1  # the stage without inertia that follows takes longer steps
        speed = np.abs(anchor["body/anchor/velocity y"])
        self.assertLess(speed[last], 0.3 - 0.08)  # 0.09 m/s a step
        self.assertTrue((speed[1:last] >= 0.3 - 0.1).all())
        self.assertLess(anchor.time[last], 1)
        self.assertAlmostEqual(anchor.time[-1], anchor.time[last] + 20040, delta=1e-6)

    def test_a_body_that_turns_back_is_not_at_rest(self):
        """It is slow at one step, but changes by 0.09 m/s within it."""
        rest = self.ends("fall", type="at rest", body="anchor", speed=0.08)
        done = self.mudline(*ANCHOR, rest, *settings("stages/fall/duration=0.1", "output/name=anchor"), "--steps", "60")
        self.assertIn("stage 'fall' ends with its duration of 0.1 s: nothing of its 'ends when' was reached",
                      done.stderr)
        anchor = History(self.result("anchor", ".csv"))
        speed = np.abs(anchor["body/anchor/velocity y"])[1:51]
        self.assertLess(speed.min(), 0.05)
        self.assertGreater(speed[-1], 0.5)

    def test_nothing_is_reached(self):
        done = self.runs(TERZAGHI, *COLUMN, self.ends("consolidation", type="dissipated", share=0.99))
        self.assertIn("warning: stage 'consolidation' ends with its duration of 833.333 s: nothing of its 'ends when' was reached",
                      done.stderr)

    def test_column_that_is_not(self):
        for column, expected in (("probe/base/pore presure", " (did you mean 'probe/base/pore pressure'?)"),
                                 ("x", "; the first line of the .csv names them")):
            deck = self.ends("consolidation", type="history", column=column, **{"rises to": 1.0})
            self.refused(f"stages/consolidation/ends when/enough/column: '{column}' is no column of the history{expected}", TERZAGHI, deck)
        deck = self.ends("consolidation", type="history", column=BASE, **{"rises to": 1.0})
        entry = "stages/consolidation/ends when/enough/rises to"
        self.refused(entry + ": '1 kN' is no value in Pa", TERZAGHI, deck, "--set", entry + "=1 kN")


class Start(RestartCase):
    """A run that starts at the end of a stage of another one is the rest of a run that has both."""

    def setUp(self):
        super().setUp()
        self.runs(*ANCHOR, *settings("output/name=anchor"))
        self.whole = History(self.result("anchor", ".csv"))

    def branch(self, stage, *more, ranks=1):
        self.runs(*ANCHOR, *settings("output/name=branch", f"start/from=results/anchor@{stage}"), *more, ranks=ranks)
        return History(self.result("branch", ".csv"))

    def test_is_the_rest(self):
        for stage in ("geostatic", "fall", "dissipation"):
            rest = self.branch(stage)
            self.assertEqual(rest.header, self.whole.header)
            self.assertLess(len(rest.data), len(self.whole.data))
            self.assertTrue(np.array_equal(rest.data, self.whole.data[-len(rest.data):]), stage)
        # as it is in turn for another one, and for its own continuation
        self.runs(*ANCHOR, *settings("output/name=branch", "start/from=results/anchor@geostatic"), "--steps", "5")
        self.runs(*ANCHOR, *settings("output/name=branch", "start/from=results/anchor@geostatic"), "--restart")
        self.runs(*ANCHOR, *settings("output/name=twig", "start/from=results/branch@dissipation"))
        twig = History(self.result("twig", ".csv"))
        self.assertTrue(np.array_equal(twig.data, self.whole.data[-len(twig.data):]))

    def test_other_ranks(self):
        rest = self.branch("dissipation", ranks=2)
        force = next(name for name in rest.columns if name.startswith("contact/") and name.endswith("/reaction y"))
        expected = self.whole[force][-len(rest.data):]
        self.assertLess(np.abs(rest[force] - expected).max(), 1e-6 * np.abs(expected).max())

    def test_another_way_on(self):
        short = self.branch("fall", *settings("stages/dissipation/duration=2000"))
        self.assertAlmostEqual(short.time[-1], self.whole.time[-1] - 18000, delta=1e-6)

    def test_refused(self):
        branch = [*ANCHOR, "--set", "output/name=branch", "--set"]
        for start, expected in (
                ("results/anchor@fal", "have no end of a stage 'fal' (did you mean 'fall'?)"),
                ("results/other@fall", "there are no results 'results/other' with the end of a stage"),
                ("results/branch@fall", "'results/branch' are the results of this run itself: give it another output/name"),
                ("results/anchor", "expected results and a stage, 'results/pile@push', given 'results/anchor'")):
            self.refused("start/from: " + ("the results 'results/anchor' " if "fal'" in expected else "") + expected, *branch,
                         "start/from=" + start)
        fall = [*branch, "start/from=results/anchor@fall"]
        self.refused("stages/fall/duration: 0.2, was 0.1, but that stage is over", *fall, *settings("stages/fall/duration=0.2"))
        self.refused("another model: materials/soil/porosity: 0.4, was 0.5", *fall, *settings("materials/soil/porosity=0.4"))
        self.refused("the deck has no stage after that one", *branch, "start/from=results/anchor@pull-out")

    def test_restart_where_nothing_is_yet(self):
        chain = [*ANCHOR, *settings("output/name=chain"), "--restart", "--steps"]
        for _ in range(2):
            self.runs(*chain, "10")
        rows = History(self.result("chain", ".csv")).data
        self.assertEqual(len(rows), 21)  # the geostatic stage is no step
        self.assertTrue(np.array_equal(rows, self.whole.data[:21]))
        os.remove(self.result("chain", ".restart"))
        self.refused("results/chain.restart: there is no such checkpoint", *chain, "10")


class Branches(RestartCase):
    """The section `branches`: one command runs a deck and what goes on from its stages in other ways."""

    def deck(self, *branches):
        return self.write("branches.xml", deck_text("branches", {"branches": {
            name: {"from": start, "stages": {stage: {"duration": duration}}} for name, start, stage, duration in branches}}))

    def test_is_the_run_that_starts_there(self):
        self.runs(*ANCHOR, *settings("output/name=anchor"))
        self.runs(*ANCHOR, *settings("output/name=by_hand", "start/from=results/anchor@fall", "stages/dissipation/duration=2000"))
        for ranks in (1, 2):
            deck = self.deck(("soon", "fall", "dissipation", 2000), ("fast pull", "dissipation", "pull-out", 20))
            self.runs(*ANCHOR, deck, *settings(f"output/name=all{ranks}"), ranks=ranks)
            if ranks == 1:
                self.assertEqual(self.content("all1"), self.content("anchor"))
                self.assertEqual(self.content("all1_soon"), self.content("by_hand"))
                self.assertEqual(self.content("all1_soon", ".results.csv"), self.content("by_hand", ".results.csv"))
            else:
                one, two = (History(self.result(name, ".csv")) for name in ("all1_fast_pull", "all2_fast_pull"))
                force = next(name for name in one.columns if name.startswith("contact/") and name.endswith("/reaction y"))
                self.assertAlmostEqual(two.time[-1], 20020.1, delta=1e-6)
                self.assertLess(np.abs(one[force] - two[force]).max(), 1e-6 * np.abs(one[force]).max())

    def test_other_commands(self):
        """A mesh that was split serves the branches too; what the deck is doubted for is told once."""
        deck = self.deck(("soon", "fall", "dissipation", 2000))
        done = program(["split", *ANCHOR, deck, "--ranks", "2", "-o", "two.parts.h5"], 1, self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        done = self.runs(*ANCHOR, deck, "--mesh-parts", "two.parts.h5", *settings("output/name=two"), ranks=2)
        self.assertTrue(os.path.exists(self.result("two_soon", ".results.csv")))
        self.assertEqual(done.stderr.count("water at rest): give the start"), 1, done.stderr)
        done = program(["point", os.path.join(ROOT, "inputs", "point", "mcc_triaxial.xml"), deck], 1, self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("not needed here and not read: branches", done.stdout + done.stderr)

    def test_of_a_run_that_starts_from_another(self):
        self.runs(*ANCHOR, *settings("output/name=anchor"))
        deck = self.deck(("soon", "dissipation", "pull-out", 20))
        self.runs(*ANCHOR, deck, *settings("output/name=late", "start/from=results/anchor@fall"))
        self.assertAlmostEqual(History(self.result("late_soon", ".csv")).time[-1], 20020.1, delta=1e-6)

    def test_interrupted(self):
        """A branch waits for its stage; --restart goes on with all of them."""
        deck = self.deck(("soon", "fall", "dissipation", 2000))
        self.runs(*ANCHOR, deck, *settings("output/name=whole"))
        done = program(["run", *ANCHOR, deck, *settings("output/name=parts"), "--steps", "5"], 1, self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("branch 'soon' waits for the end of stage 'fall'", done.stdout + done.stderr)
        self.assertFalse(os.path.exists(self.result("parts_soon", ".csv")))
        self.runs(*ANCHOR, deck, *settings("output/name=parts"), "--restart")
        for end in ("", "_soon"):
            self.assertEqual(self.content("parts" + end), self.content("whole" + end))

    def test_refused(self):
        """Before anything runs, at the line of the branch."""
        good = ("soon", "fall", "dissipation", 2000)
        for branches, expected in (
                ([("soon", "fal", "dissipation", 2000)], "branches.xml:4: branches/soon/from: unknown stage 'fal' (did you mean 'fall'?)"),
                ([("soon", "fall", "fall", 2)], "branches.xml:7: branches/soon/stages/fall/duration: 2, was 0.1, but that stage is over where "
                                                "the branch begins"),
                ([("soon", "pull-out", "pull-out", 2)], "branches/soon/from: there is no stage after 'pull-out'"),
                ([("a b", *good[1:]), ("a_b", *good[1:])], "branches/a_b: another branch's results have the same name, 'a_b'"),
                ([("a/b", *good[1:])], "")):
            self.refused(expected, *ANCHOR, self.deck(*branches))
        for setting, expected in (
                ("materials/soil/porosity=0.4", "branches/soon/materials/soil/porosity: 0.4, was 0.5, but a branch goes on with the model of its run"),
                ("output/name=x", "branches/soon/output/name: the results of a branch are named after the run and the branch"),
                ("stages/pull-out/durationn=3", "stages/pull-out/durationn: unknown parameter (did you mean 'duration'?)")):
            self.refused(expected, *ANCHOR, self.deck(good), "--set", "branches/soon/" + setting)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "results")))


class OtherConditions(RestartCase):
    """What goes on from a run may have conditions of its own."""

    HELD = ("base", "left side", "right side", "drained surface", "load")
    WORKS = "balance/energy/error"

    def stages(self, first=None):
        steps = {"initial": 2.0, "growth": 1.2, "maximum": 20.0}
        first = {} if first is None else {"conditions": list(first)}
        return {"consolidation": {"duration": 100.0, "integrator": {"start-up steps": 0}, "time step": steps, **first},
                "later": {"type": "quasi-static", "duration": 100.0, "time step": steps}}

    def column(self, name, *more, first=None, **sections):
        deck = self.write(f"{name}.xml", deck_text(name, {"stages": self.stages(first), **sections}))
        self.runs(TERZAGHI, deck, *settings("mesh/cells={1, 20}", f"output/name={name}"), *more)

    def rows(self, name):
        return History(self.result(name, ".csv"))

    def same(self, name, whole, column):
        """The last rows are those of the whole run."""
        one, other = self.rows(name)[column], self.rows(whole)[column][-len(self.rows(name).time):]
        self.assertGreater(len(one), 4)
        self.assertLess(np.abs(one - other).max(), 1e-9 * max(1e-3, np.abs(other).max()))

    def test_a_load_more(self):
        load = {"second load": {"type": "traction", "set": "top", "y": -10.0}}
        self.column("whole", first=self.HELD, **{"boundary conditions": load})
        self.column("run", branches={"more": {"from": "consolidation", "boundary conditions": load}})
        for column in (BASE, "probe/top/displacement y", "balance/water/outflow", self.WORKS):
            self.same("run_more", "whole", column)
        self.assertGreater(self.rows("run_more")[BASE].max(), 1.5 * self.rows("run")[BASE][-5:].max())

    def test_a_load_less(self):
        """The work of a load that is gone still counts in the balance of energy."""
        surcharge = {"load": {"type": "traction", "set": "left", "x": 0.0},
                     "weight on top": {"type": "pressure", "set": "top", "value": 10.0}}
        held = [name for name in self.HELD if name != "load"] + ["weight on top"]
        self.column("run", first=held, **{"boundary conditions": surcharge})
        deck = self.write("later.xml", deck_text("later", {"stages": self.stages()}))
        for ranks in (1, 2):
            self.runs(TERZAGHI, deck, *settings("mesh/cells={1, 20}", f"output/name=later{ranks}",
                                                "start/from=results/run@consolidation"), ranks=ranks)
            works = self.rows(f"later{ranks}")
            self.assertLess(np.abs(works[self.WORKS]).max(), 1e-9 * np.abs(works["balance/energy/stress divergence"]).max())


if __name__ == "__main__":
    unittest.main()
