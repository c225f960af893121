"""Factors of safety of slopes by strength reduction, against published ones; steps, restart, ranks, and what
follows."""
import unittest

import numpy as np

from compared_case import problem
from mudline_case import deck_text, program
from strength_case import StrengthCase

BISHOP_MORGENSTERN, GRIFFITHS_LANE, TAYLOR = 1.380, 1.4, 1.47
TOLERANCE = 0.03
FACTOR = "strength reduction/factor"
COARSE = ["mesh/parameters/size=2.5"]


@problem("benchmark", "Bishop and Morgenstern; Griffiths and Lane", "Slopes by strength reduction")
class Slope(StrengthCase):
    def slope(self, name, settings=(), ranks=1, extra=("--overwrite",), more=()):
        """The history of the slope's run."""
        return self.run_deck([self.deck("slope", name), *more], settings, ranks, extra=list(extra))

    def found(self, name):
        """What strength reductions found, by stage and quantity."""
        return {(stage, quantity): value for (stage, of, quantity), value in self.results(name).items()
                if of == "strength reduction"}

    def bracket(self, name):
        """The last factor with equilibrium and the first one without."""
        found = self.found(name)
        return found["safety", "factor of safety"], found["safety", "factor without equilibrium"]

    def test_homogeneous_slope(self):
        history = self.slope("homogeneous")
        found, lost = self.bracket("homogeneous")
        self.compare_values("charts of Bishop and Morgenstern", found, BISHOP_MORGENSTERN, TOLERANCE)
        self.compare_values("finite elements of Griffiths and Lane", found, GRIFFITHS_LANE, TOLERANCE)
        self.compare("factor in the history", abs(history[FACTOR][-1] - found), 1e-12)
        self.assertTrue(found < lost < found + 0.005, (found, lost))
        gravity = history.time <= 1
        self.assertTrue((history[FACTOR][gravity] == 1).all())

    @problem("benchmark", "Taylor's chart")
    def test_undrained_slope(self):
        self.slope("undrained")
        self.compare_values("chart of Taylor", self.bracket("undrained")[0], TAYLOR, TOLERANCE)

    @problem("consistency")
    def test_two_first_steps(self):
        """Other steps find the same factor, to the resolution."""
        brackets = []
        for step in (0.1, 0.03):
            self.slope("undrained", [*COARSE, f"stages/safety/time step/initial={step}"])
            brackets.append(self.bracket("undrained"))
        self.compare("factor of safety", abs(brackets[0][0] - brackets[1][0]), 0.01)

    @problem("behaviour")
    def test_displacement_limit(self):
        """Beyond the factor of safety the soil moves so much more that the limit hardly matters. Without one it flows
        on to the largest factor: steps that converge say nothing alone."""
        limit = "stages/safety/strength reduction/displacement limit"
        found = []
        for value in (0.02, 0.08):
            self.slope("undrained", [f"{limit}={value}"])
            found.append(self.bracket("undrained")[0])
        self.assertLess(found[1] / found[0] - 1, 0.01, found)
        history = self.slope("undrained", [f"{limit}=0.5"])
        self.assertEqual(self.found("undrained"), {("safety", "factor with equilibrium"): history[FACTOR][-1]})

    @problem("consistency")
    def test_ranks(self):
        one = self.slope("homogeneous", COARSE)
        bracket = self.bracket("homogeneous")
        two = self.slope("homogeneous", COARSE, ranks=2)
        self.assert_same_run(one, two, [FACTOR, "probe/crest/displacement y"], "two ranks", 1e-6)
        self.assertEqual(self.bracket("homogeneous"), bracket)

    @problem("behaviour")
    def test_restart(self):
        """A run that is interrupted within the reduction goes on with the same factor, bit for bit, and ends alike; what
        is over stays so. The factor's growth can no longer change."""
        whole = self.slope("homogeneous", COARSE).data
        results = self.found("homogeneous")
        self.slope("homogeneous", COARSE, extra=["--overwrite", "--steps", "9"])
        self.assertEqual(self.found("homogeneous"), {})
        for entry, value in (("duration", 2), ("strength reduction/largest factor", 3)):
            done = program(["run", "-q", self.deck("slope", "homogeneous"), "--restart", "--set", *COARSE, "--set",
                            f"stages/safety/{entry}={value}"], 1, self.folder)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn("but the strengths of that stage are being reduced already", done.stderr)
        for _ in range(2):
            again = self.slope("homogeneous", COARSE, extra=["--restart"]).data
            self.assertTrue(np.array_equal(again, whole))
            self.assertEqual(self.found("homogeneous"), results)

    @problem("consistency")
    def test_next_stage_has_whole_strengths(self):
        """After the reduction the strengths are whole: the slope stays, and a second reduction finds the factor
        again."""
        reduction = {
            "type": "quasi-static",
            "duration": 1.0,
            "strength reduction": {"largest factor": 2.0},
            "time step": {"initial": 0.05},
        }
        rest = {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 0.5}}
        more = self.write("more.xml", deck_text("more", {"stages": {"rest": rest, "again": reduction}}))
        history = self.slope("homogeneous", COARSE, more=[more])
        found = {stage: value for (stage, quantity), value in self.found("homogeneous").items()
                 if quantity == "factor of safety"}
        self.assertEqual(set(found), {"safety", "again"})
        self.compare("factor of safety", abs(found["again"] - found["safety"]), 0.01)
        resting = np.flatnonzero(np.diff(history[FACTOR]) < -0.1)[0] + 1  # the first step of the rest
        self.assertEqual(list(history[FACTOR][resting : resting + 2]), [1, 1])
        crest = history["probe/crest/displacement y"]
        self.compare("displacement of the crest [m]", abs(crest[resting + 1] - crest[resting - 1]), 1e-6)

    @problem("consistency")
    def test_numbers_of_place(self):
        """Strengths that are functions of the place, or grow with depth, are reduced as plain numbers are."""
        plain = self.slope("homogeneous", COARSE)
        skeleton = "materials/soil/skeleton"
        functions = [f"{skeleton}/cohesion=10e3 + 0*y", f"{skeleton}/friction angle [deg]=20 + 0*x"]
        varied = self.slope("homogeneous", [*COARSE, *functions])
        self.assert_same_run(plain, varied, [FACTOR, "probe/crest/displacement y"], "functions of the place", 1e-6)

    @problem("behaviour")
    def test_factor_that_is_not_reached(self):
        done = program(["run", self.deck("slope", "homogeneous"), "--set", *COARSE, "--set",
                        "stages/safety/strength reduction/largest factor=1.1", "--set",
                        "stages/safety/time step/initial=0.5"], 1, self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("stage 'safety' ends in equilibrium: the factor of safety is above the largest factor, 1.1",
                      done.stderr)
        self.assertEqual(self.found("homogeneous"), {("safety", "factor with equilibrium"): 1.1})


if __name__ == "__main__":
    unittest.main()
