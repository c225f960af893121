"""The torpedo deck's first metres on a coarser mesh: 98 t at 20 m/s, the mesh moving against the clay."""
import os
import unittest

import numpy as np

from mudline_case import ROOT, SharedRun

DECK = os.path.join(ROOT, "inputs", "torpedo", "tresca.xml")
MASS, DIAMETER, TIP, SPEED = 98e3, 1.07, 2.14, 20.0


class Torpedo(SharedRun):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        settings = ("mesh/parameters/fine=0.1", "mesh/parameters/coarse=2.5", "mesh/parameters/depth=20", "mesh/parameters/width=8", "stages/penetration/duration=0.15")
        cls.run_once([DECK], settings, timeout=280)

    def test_steps_are_easy_and_the_mesh_stays_good(self):
        self.assertLessEqual(self.rejected, 0.05 * self.steps)
        self.assertLess(self.history["step/newton iterations"].mean(), 7)
        self.assertGreater(self.history["mesh motion/quality"].min(), 0.2)
        self.assertLess(np.abs(self.history["mesh motion/change of solid"]).max(), 1e-11)

    def test_the_body_obeys_newton_and_energy_is_accounted_for(self):
        time = self.history.time
        force = self.history["contact/anchor/reaction y"]
        load = self.history["body/anchor/load y"]
        impulse = np.concatenate(([0.0], np.cumsum(0.5 * np.diff(time) * ((force + load)[1:] + (force + load)[:-1]))))
        velocity = self.history["body/anchor/velocity y"]
        self.assertLess(np.abs(MASS * (velocity[2:] - velocity[2]) - (impulse[2:] - impulse[2])).max(), 2e-3 * MASS * SPEED)
        self.assertLess(np.abs(self.history["balance/energy/error"]).max(), 1e-3 * 0.5 * MASS * SPEED ** 2)

    def test_resistance(self):
        depth, tip = -self.history["body/anchor/position y"], self.history["contact/anchor/tip reaction y"]
        for z in (3.5, 4.5):
            strength = (5e3 + 2e3 * (z - 0.5 * TIP)) * (SPEED / DIAMETER / 0.1) ** 0.07
            factor = np.interp(z, depth, tip) / (np.pi * DIAMETER ** 2 / 4) / strength
            if os.environ.get("MUDLINE_SHOW_ERRORS"):
                print(f"z = {z}: tip resistance {factor:.2f} times the strength at half the tip's height")
            self.assertTrue(7 < factor < 15, (z, factor))  # around a cone's; shallow, and v close to the speed of shear waves


if __name__ == "__main__":
    unittest.main()
