"""A body with mass away from the soil: water, given forces, the integrator's order."""
import math
import os
import unittest

import numpy as np
from compared_case import problem
from mudline_case import ROOT, MudlineCase
from references import falling_body as reference

DECK = os.path.join(ROOT, "inputs", "impact", "free_fall.xml")
START = 60.0  # the ball's lowest point in the deck
RADIUS, MASS, WATER = 0.4, 1000.0, 1025.0
DRY = ("bodies/anchor/motion/water/density=0", "bodies/anchor/motion/water/drag coefficient=0", "bodies/anchor/motion/gravity={0,0}")


def steps(dt):
    return (f"stages/fall/time step/initial={dt}", f"stages/fall/time step/maximum={dt}")


@problem("exact", "Newton's equation with drag and buoyancy, closed form", "Free fall")
class FreeFall(MudlineCase):
    def errors(self, exact, settings, sizes, end):
        """Largest error of position and velocity for each step size."""
        result = []
        for dt in sizes:
            history = self.run_deck(DECK, settings + steps(dt) + (f"stages/fall/duration={end}",))
            depth, speed = zip(*(exact(t) for t in history.time))
            result.append((np.abs(START - history["body/anchor/position y"] - depth).max(),
                           np.abs(-history["body/anchor/velocity y"] - speed).max()))
        return np.array(result)

    def test_terminal_velocity(self):
        volume, area = 4 / 3 * math.pi * RADIUS**3, math.pi * RADIUS**2
        exact = lambda t: reference.fall_in_water(t, MASS, volume, area, WATER, 0.5)
        errors = self.errors(exact, (), (0.1, 0.05, 0.025), 4.0)
        self.compare("way", errors[-1, 0], 2e-4)
        self.compare("velocity", errors[-1, 1], 4e-4)
        self.compare_orders("order of the way", errors[:, 0], 1.85, all_orders=True)
        self.compare_orders("order of the velocity", errors[:, 1], 1.85, all_orders=True)
        history = self.run_deck(DECK, steps(0.05) + ("stages/fall/duration=8",))
        terminal = math.sqrt(2 * MASS * 9.81 * (1 - WATER * volume / MASS) / (WATER * 0.5 * area))
        self.compare("terminal velocity", abs(-history["body/anchor/velocity y"][-1] / terminal - 1), 1e-4)

    def test_linear_resistance(self):
        """An oscillator: stopped by a spring below the mudline; verification of the free-fall references."""
        settings = DRY[:2] + ("bodies/anchor/motion/initial velocity={0,-10}", f"bodies/anchor/motion/force y=-50000*(y-{START})")
        exact = lambda t: reference.linear_resistance(t, MASS, 5e4, 10.0, 9810.0)
        errors = self.errors(exact, settings, (4e-3, 2e-3, 1e-3), 0.24)
        self.compare_orders("order of the way", errors[:, 0], 1.9, all_orders=True)
        self.compare_orders("order of the velocity", errors[:, 1], 1.9, all_orders=True)
        history = self.run_deck(DECK, settings + steps(1e-3) + ("stages/fall/duration=0.3",))
        self.compare("depth of rest", abs(START - history["body/anchor/position y"].min() - 1.623959), 1e-4)

    def test_constant_resistance(self):
        settings = DRY + ("bodies/anchor/motion/initial velocity={0,-10}", "bodies/anchor/motion/force y=25000")
        history = self.run_deck(DECK, settings + steps(0.01) + ("stages/fall/duration=0.4",))
        self.compare("depth of rest", abs(START - history["body/anchor/position y"][-1] - 2.0), 1e-9)
        self.compare("speed at rest", abs(history["body/anchor/velocity y"][-1]), 1e-9)

    def test_buoyancy_ends_at_the_mudline(self):
        """The load is the weight less that of the water displaced above the mudline; energy is conserved at radius 1."""
        settings = ("bodies/anchor/motion/water/drag coefficient=0", "bodies/anchor/motion/water/mudline=59.5",
                    "stages/fall/integrator/spectral radius=1", "bodies/anchor/motion/water/added mass coefficient=0.5")
        history = self.run_deck(DECK, settings + steps(0.01) + ("stages/fall/duration=1.5",))
        y = history["body/anchor/position y"]
        self.assertLess(y.min(), 59.5 - 2 * RADIUS)
        total = 4 / 3 * math.pi * RADIUS**3
        displaced = np.array([total - reference.sphere_below(59.5 - h, RADIUS) for h in y])
        self.compare("load",
                     np.abs(history["body/anchor/load y"] - 9.81 * (WATER * displaced - MASS)).max() / (9.81 * MASS),
                     1e-9)
        moving = MASS + 0.5 * WATER * total
        self.compare("first acceleration",
                     np.abs(history["body/anchor/acceleration y"][0] - history["body/anchor/load y"][0] / moving),
                     1e-5)
        self.compare("kinetic energy",
                     abs(history["body/anchor/kinetic energy"][-1]
                         / (0.5 * moving * history["body/anchor/velocity y"][-1]**2) - 1), 1e-12)
        energy = history["body/anchor/kinetic energy"][-1]
        self.compare("balance of energy", np.abs(history["balance/energy/error"]).max() / energy, 1e-6)
        taken = np.abs(history["balance/energy/numerical dissipation"]).max()
        self.compare("numerical dissipation", taken / energy, 1e-9)


if __name__ == "__main__":
    unittest.main()
