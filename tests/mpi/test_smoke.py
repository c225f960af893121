"""The README's cone: its first steps, the same on two ranks, and the same after a restart."""
import os
import unittest

import numpy as np

from mudline_case import ROOT, History, MudlineCase, program

DECK = os.path.join(ROOT, "inputs", "penetration", "cone_indentation.xml")
STEPS, RANKS = 6, 1e-8


class Smoke(MudlineCase):
    def first_steps(self, name, steps, ranks=1, extra=()):
        arguments = ["run", "-q", DECK, "--steps", steps, "--set", f"output/name={name}", *extra]
        done = program(arguments, ranks, self.folder)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])
        return History(os.path.join(self.folder, "results", name + ".csv"))

    def test_first_steps(self):
        one, two = self.first_steps("one", STEPS), self.first_steps("two", STEPS, ranks=2)
        self.assertTrue(np.all(np.isfinite(one.data)))
        self.assertGreaterEqual(len(one.time), STEPS)
        (force,) = [name for name in one.columns if name.startswith("contact/") and name.endswith("/tip reaction y")]
        self.assertGreater(one[force][-1], 0)
        np.testing.assert_allclose(two[force], one[force], rtol=RANKS, atol=RANKS * abs(one[force]).max())
        self.first_steps("parts", STEPS // 2)
        self.first_steps("parts", STEPS - STEPS // 2, extra=["--restart"])
        with open(os.path.join(self.folder, "results", "one.csv"), "rb") as whole:
            with open(os.path.join(self.folder, "results", "parts.csv"), "rb") as parts:
                self.assertEqual(whole.read(), parts.read())


if __name__ == "__main__":
    unittest.main()
