"""Steps chosen by their time error: Terzaghi's column against fine steps on the same mesh, and a second load during the run."""
import os
import unittest

import numpy as np

from compared_case import problem
from consolidation_case import COMPRESSIBLE, ConsolidationCase, between
from mudline_case import History, program

STAGE = "stages/consolidation/"
SECOND_LOAD = "boundary conditions/load/y=t < 400 ? -10 : (t < 420 ? -10 - (t - 400) : -30)"
LOAD = 10.0


@problem("consistency", title="Steps by their time error, against fine steps")
class TimeError(ConsolidationCase):
    def table(self, settings):
        """History, and how many steps the program rejected for their time error."""
        arguments = ["run", self.deck("terzaghi")] + [word for s in settings + COMPRESSIBLE for word in ("--set", s)]
        done = program(arguments, folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])
        return History(f"{self.folder}/results/terzaghi.csv"), done.stdout.count("rejected: time error")

    def controlled(self, theta, tolerance, more=()):
        return self.table((f"{STAGE}integrator/theta={theta}", f"{STAGE}time step/error tolerance={tolerance}",
                           f"{STAGE}time step/maximum=200", f"{STAGE}time step/growth=3") + more)

    def error(self, history, fine, after):
        """Largest error of the base's pressure over the load."""
        times = history.time[history.time > after]
        name = "probe/base/pore pressure"
        return np.abs(history.at(name, times) - between(fine, name, times)).max() / LOAD

    def fine(self, more=()):
        return self.table((f"{STAGE}time step/initial=0.01", f"{STAGE}time step/maximum=1.0", f"{STAGE}time step/growth=1.1") + more)[0]

    def test_consolidation(self):
        """The error of a step stays below its tolerance, so that the pressure's is a few times that, and it falls with the
        order of the integrator: so do the numbers of steps, as tolerance^-1/2 and tolerance^-1/3."""
        fine = self.fine()
        for theta, order in ((1.0, 1), (0.5, 2)):
            with self.subTest(theta=theta):
                steps, errors = [], []
                for tolerance in (1e-3, 1e-4):
                    history, _ = self.controlled(theta, tolerance)
                    steps.append(len(history.time))
                    errors.append(self.error(history, fine, 20))
                    if os.environ.get("MUDLINE_SHOW_ERRORS"):
                        print(f"theta {theta}, {tolerance}: {steps[-1]} steps, error {errors[-1]:.1e}")
                    # backward Euler forgets over some 1/sqrt(2 tolerance) steps what one has lost
                    self.compare(f"theta {theta}: pressure", errors[-1],
                                 2 * tolerance * (tolerance ** (-1 / (order + 1))))
                self.assertLess(errors[1], 0.5 * errors[0])
                self.assertGreater(steps[1], 1.3 * steps[0])
                self.assertLess(steps[1], 1.5 * 10 ** (1 / (order + 1)) * steps[0])

    def test_second_load(self):
        """Steps that have grown long before the second load are refused until they see it."""
        fine = self.fine((SECOND_LOAD,))
        history, rejected = self.controlled(1.0, 1e-3, (SECOND_LOAD,))
        self.assertGreater(rejected, 0)
        error = self.error(history, fine, 20)
        self.compare("pressure", error, 0.06)


if __name__ == "__main__":
    unittest.main()
