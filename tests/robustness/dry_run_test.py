"""`mudline run --dry-run` tells what a run takes, and writes nothing."""
import os
import re
import unittest

from mudline_case import ROOT, MudlineCase, program

TERZAGHI = os.path.join(ROOT, "inputs", "consolidation", "terzaghi.xml")
BALL = os.path.join(ROOT, "tests", "mpi", "ball_in_clay.xml")


class DryRun(MudlineCase):
    def said(self, *arguments, ranks=1, code=0):
        done = program(["run", *arguments], ranks, self.folder)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stdout + done.stderr

    def found(self, pattern, text):
        match = re.search(pattern, text)
        self.assertIsNotNone(match, text)
        return match.group(1)

    def test_what_the_run_has(self):
        """Mesh and unknowns as in the run; its steps; nothing on the disk."""
        few = ["--set", "stages/consolidation/duration=0.5", "--set", "mesh/cells={1, 10}"]
        for ranks in (1, 2):
            dry = self.said(TERZAGHI, "--dry-run", *few, ranks=ranks)
            self.assertEqual(os.listdir(self.folder), [])
            mesh = self.found(r"(\d+ elements, \d+ nodes, \d+ unknowns) ", dry)
            steps = int(self.found(r"steps: about (\d+) in all stages", dry))
            self.assertIn("results: results/terzaghi.{vtkhdf,csv}\n", dry)
            self.assertGreater(float(self.found(r"memory: (\S+) MB after a step", dry)), 10)
            iterations = int(self.found(r"first step of stage 'consolidation': (\d+) iterations", dry))
            self.assertRegex(dry, r"time: about \S+ m?s at 2 iterations a step, \S+ m?s at 6, ")
            self.assertEqual("on a rank" in dry, ranks == 2)
        run = self.said(TERZAGHI, *few)
        self.assertEqual(self.found(r"(\d+ elements, \d+ nodes, \d+ unknowns) ", run), mesh)
        self.assertEqual(int(self.found(r"  step +1 .* newton (\d+)", run)), iterations)
        self.assertLess(abs(int(self.found(r"done: (\d+) steps", run)) / steps - 1), 0.3)
        before = sorted(os.listdir(os.path.join(self.folder, "results")))
        self.assertIn("there are results of this name already", self.said(TERZAGHI, "--dry-run", *few))
        self.assertEqual(sorted(os.listdir(os.path.join(self.folder, "results"))), before)

    def test_body_after_a_geostatic_stage(self):
        dry = self.said(BALL, "--dry-run", "--set", "mesh/cells={4, 4}")
        self.assertIn("stages: geostatic, push\n", dry)
        self.assertIn("first step of stage 'push': ", dry)
        self.assertEqual(os.listdir(self.folder), [])

    def test_a_step_that_cannot_be_solved(self):
        load = ["--set", "boundary conditions/load/y=-1e12", "--set", "mesh/cells={1, 4}"]
        dry = self.said(TERZAGHI, "--dry-run", *load)
        self.assertIn("; it did not converge from the state at the start: ", dry)

    def test_refused(self):
        for other in ("--restart", "--overwrite"):
            self.assertIn("excludes", self.said(TERZAGHI, "--dry-run", other, code=2))
        self.assertIn("unknown parameter", self.said(TERZAGHI, "--dry-run", "--set", "mesh/cels=3", code=2))


if __name__ == "__main__":
    unittest.main()
