"""A smooth strip footing pushed deep into Tresca clay, on a coarse mesh: resistance against the limit load of the deformed geometry (found by
docs/benchmarks/limit_load.py on a finer mesh, without elasticity, contact law or history), and against the mesh that goes with the soil while
that is still good. Also what the first guess of a step changes: iterations, not answers."""
import os
import unittest

import numpy as np

from compared_case import problem
from mudline_case import ROOT, MudlineCase

DECK = os.path.join(ROOT, "inputs", "footing", "tresca_penetration.xml")
COARSE = ("mesh/parameters/fine=0.05", "mesh/parameters/coarse=0.8")
HALF_WIDTH, STRENGTH = 0.5, 10e3
LIMIT_LOADS = {0.101: 5.190, 0.199: 5.406}  # depth [m]: N_c


def depth(history):
    return -history["body/footing/displacement y"]


def factor(history, at):
    return np.interp(at, depth(history), history["contact/footing/tip reaction y"]) / (HALF_WIDTH * STRENGTH)


@problem("benchmark", "limit loads of the deformed geometry, [limit_load.py](benchmarks/limit_load.py)",
         "Deep penetration of a strip footing in Tresca clay")
class StripPenetration(MudlineCase):
    def push(self, duration, *settings):
        return self.run_deck(DECK, COARSE + (f"stages/push/duration={duration}",) + settings, name="tresca_penetration")

    def show(self, *what):
        if os.environ.get("MUDLINE_SHOW_ERRORS"):
            print(*what)

    def test_limit_load_of_the_deformed_geometry(self):
        history = self.push(20.5)
        errors = [factor(history, at) / exact - 1 for at, exact in LIMIT_LOADS.items()]
        self.show("errors against limit loads:", errors, len(history.time), "steps, quality", history["mesh/quality"].min())
        self.compare("resistance against limit loads", np.abs(errors).max(), 0.03)
        self.assertGreater(history["mesh/quality"].min(), 0.3)
        self.assertLess(history["step/newton iterations"].mean(), 7)

    @problem("consistency")
    def test_mesh_that_goes_with_the_soil_while_it_is_good(self):
        at = np.linspace(0.005, 0.04, 15)
        moving, still = self.push(4.5), self.push(4.5, "stages/push/mesh motion=false")
        difference = np.abs(factor(moving, at) / factor(still, at) - 1).max()
        self.show("against the Lagrangian mesh:", difference, "N", factor(moving, 0.04))
        self.compare("resistance against the material mesh", difference, 0.01)
        self.assertLess(still["mesh/quality"][-1], moving["mesh/quality"][-1])

    @problem("consistency")
    def test_first_guess_changes_iterations_only(self):
        small = ("stages/push/time step/maximum=0.1", "stages/push/time step/growth=1.5")
        one, other = self.push(5.0, *small), self.push(5.0, "solver/newton/first guess=committed", *small)
        iterations = [h["step/newton iterations"].sum() for h in (one, other)]
        self.show("iterations extrapolated, committed:", iterations, "N", factor(one, 0.05), factor(other, 0.05))
        self.compare("resistance with another first guess", abs(factor(one, 0.05) / factor(other, 0.05) - 1), 1e-3)
        self.assertLess(iterations[0], 0.9 * iterations[1])


if __name__ == "__main__":
    unittest.main()
