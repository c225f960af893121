"""Steps chosen by their time error in a dynamic column: as exact as short ones, and refused where the load has a corner."""
import os
import unittest

import numpy as np

from compared_case import problem
from dynamics_case import SCALE, SINE_RAMP, DynamicsCase, reference
from mudline_case import History, program

STEP = "stages/shaking/time step/"


@problem("exact", "linear u-p theory, modal sums", "Steps by their time error, dynamic column")
class TimeError(DynamicsCase):
    def controlled(self, tolerance):
        settings = ("boundary conditions/load/y=t < 0.1 ? -sin(pi*t/0.2) : (t < 0.4 ? -1 : -1 - 0.5*sin(40*pi*(t-0.4)))",
                    "stages/shaking/duration=0.45", "stages/shaking/integrator/spectral radius=0.8",
                    f"{STEP}initial=2e-3", f"{STEP}maximum=0.1", f"{STEP}growth=2", f"{STEP}error tolerance={tolerance}")
        done = program(["run", self.deck("sine_ramp")] + [word for s in settings for word in ("--set", s)], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])
        return History(f"{self.folder}/results/sine_ramp.csv"), done.stdout.count("rejected: time error")

    def test_column(self):
        errors, times = [], np.array([0.1, 0.2, 0.3, 0.39])
        u, _ = SINE_RAMP.response([0], times, reference.sine_ramp(1e3 * SCALE, 0.1))
        for tolerance in (1e-2, 1e-3):
            history, rejected = self.controlled(tolerance)
            self.assertGreater(rejected, 0)
            self.assertLess(len(history.time), 450)
            errors.append(np.abs(self.settlement(history, "top", times) - u[:, 0]).max() / np.abs(u).max())
            if os.environ.get("MUDLINE_SHOW_ERRORS"):
                print(f"{tolerance}: {len(history.time)} steps, {rejected} rejected, error {errors[-1]:.1e}")
            self.compare(f"settlement, tolerance {tolerance}", errors[-1], 15 * tolerance)
        self.assertLess(errors[1], 0.5 * errors[0])


if __name__ == "__main__":
    unittest.main()
