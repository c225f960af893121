"""Pressing without friction: a cylinder, a flat punch, a plate on distorted elements."""
import unittest

import numpy as np

from compared_case import problem
from contact_case import PRESSURE, ContactCase
from references import contact as reference

MODULUS = reference.plane_modulus(2e8, 0.3)


@problem("exact", "Hertz and the flat punch, after Johnson (1985)", "Pressing without friction")
class Normal(ContactCase):
    def test_hertz_line(self):
        history = self.run_deck(self.deck("hertz_line"))
        load = 2 * history["contact/face/reaction y"][-1]  # the deck has one half
        a, p0 = reference.hertz_line(load, 1.0, MODULUS)
        x, pressure = self.surface("hertz_line", 0.0, PRESSURE)
        edge = np.searchsorted(x, a)
        self.compare_values("largest pressure", np.interp(0.0, x, pressure), p0, 0.02)
        self.compare_values("half width, in elements", history["contact/face/contact area"][-1], a, 1,
                            x[edge + 1] - x[edge - 1])
        for fraction in (0.5, 0.8):
            self.compare_values(f"pressure at {fraction} a", np.interp(fraction * a, x, pressure),
                                reference.hertz_pressure(fraction * a, a, p0), 0.02, p0)

    def test_circular_punch(self):
        history = self.run_deck(self.deck("flat_punch"))
        load, middle = reference.circular_punch(2.275e-5, 0.1, MODULUS)
        self.compare_values("load", history["contact/face/reaction y"][-1], load, 0.02)
        x, pressure = self.surface("flat_punch", 0.0, PRESSURE)
        self.compare_values("pressure in the middle", np.interp(0.02, x, pressure), middle / np.sqrt(1 - 0.2**2),
                            0.03)

    @problem("exact", "the pressure is uniform")
    def test_patch(self):
        """The force goes evenly into distorted elements, as surface quadrature promises."""
        self.run_deck(self.deck("patch"))
        _, pressure = self.surface("patch", 0.5, PRESSURE)
        self.compare_values("pressure", pressure, pressure.mean(), 1e-8)


if __name__ == "__main__":
    unittest.main()
