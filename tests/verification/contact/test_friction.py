"""Coulomb friction: full sliding on effective and total traction, and partial slip under a cylinder."""
import unittest

import numpy as np

from contact_case import PRESSURE, SHEAR, ContactCase
from references import contact as reference


class Sliding(ContactCase):
    def sliding(self, water, settings=(), ranks=1, coefficient=0.3):
        history = self.run_deck(self.deck("sliding_plate"), settings, ranks)
        drag, force = -history["contact/face/reaction x"][-1], history["contact/face/reaction y"][-1]
        limit = coefficient * (force - water * history["contact/face/contact area"][-1])
        self.assert_within("sliding force", drag, limit, 1e-6)
        # what the plate gave is in the soil, in the springs, or has become heat
        soil = -history["balance/energy/contact/face"][-1]
        spent = history["contact/face/friction heat"][-1] + soil
        self.assertLess(abs(history["contact/face/work"][-1] - spent), 0.1 * history["contact/face/work"][-1])
        return history

    def test_effective(self):
        one, two = self.sliding(500.0), self.sliding(500.0, ranks=2)
        self.assert_within("two ranks", two["contact/face/reaction x"][-1], one["contact/face/reaction x"][-1], 1e-9)

    def test_coefficient_that_falls_with_the_speed(self):
        """The plate goes at 0.01 m/s, ten times the decay speed; the soil under it creeps by 2e-6 m/s as water leaves."""
        self.sliding(500.0, ("contacts/face/friction/kinetic coefficient=0.1", "contacts/face/friction/decay speed=0.001"),
                     coefficient=0.1 + 0.2 * np.exp(-10))

    def test_total(self):
        self.sliding(0.0, ("contacts/face/friction/on=total",))

    def test_cap(self):
        history = self.run_deck(self.deck("sliding_plate"), ("contacts/face/friction/cap=100",))
        self.assert_within("capped force", -history["contact/face/reaction x"][-1], 100 * history["contact/face/contact area"][-1], 1e-9)


class PartialSlip(ContactCase):
    def test_penalty(self):
        self.cattaneo_mindlin()

    def test_augmented_lagrangian(self):
        """The stretch of what sticks is followed as far as the load deserves, without a tolerance in the deck."""
        # with so soft a penalty the multipliers of corners and mid-side nodes differ by up to 0.2 of the limit, however small the tolerance
        history = self.cattaneo_mindlin(("contacts/face/enforcement=augmented Lagrangian", "contacts/face/penalty factor=2"), 0.25, 0.06)
        self.assertLess(history["step/newton iterations"].mean(), 20)

    def cattaneo_mindlin(self, settings=(), largest=0.08, mean=0.03):
        history = self.run_deck(self.deck("partial_slip"), settings)
        force, shear = history["contact/face/reaction y"][-1], -history["contact/face/reaction x"][-1]
        a, p0 = reference.hertz_line(force, 1.0, reference.plane_modulus(2e8, 0.49))
        stick = reference.stick_half_width(a, shear, 0.3 * force)
        self.assertLess(0.3 * a, stick)
        self.assertLess(stick, 0.8 * a)
        x, pressure, stress = self.surface("partial_slip", 0.0, PRESSURE, SHEAR)
        x = x - history["body/cylinder/displacement x"][-1]
        self.assert_within("largest pressure", pressure.max(), p0, 0.02)
        # nodal stresses are means over the elements around: away from the edges, where the slope is infinite
        error = np.abs(stress - reference.partial_slip(x, a, stick, 0.3 * p0)) / (0.3 * p0)
        smooth = np.minimum(np.abs(np.abs(x) - a), np.abs(np.abs(x) - stick)) > 0.0014
        self.assert_within("shear stress", error[smooth], 0.0, largest, 1.0)
        self.assert_within("mean error of the shear stress", error[np.abs(x) < a].mean(), 0.0, mean, 1.0)
        self.assert_within("shear stress in the middle", np.interp(0.0, x, stress), reference.partial_slip(0.0, a, stick, 0.3 * p0), 0.02, 0.3 * p0)
        # the points that slide are those outside the stick zone
        slides = history["contact/face/sliding points"][-1] / history["contact/face/active points"][-1]
        self.assert_within("sliding share", slides, 1 - stick / a, 0.07, 1.0)
        return history


if __name__ == "__main__":
    unittest.main()
