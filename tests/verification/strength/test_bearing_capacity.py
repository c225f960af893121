"""Rigid footings on weightless soil, pushed down until they fail, against slip-line theory.

Displacement elements meet the collapse load from above; the tests ask for how far above on the decks' mesh, and for the way there.
"""
import unittest

import numpy as np

from compared_case import problem
from mudline_case import program
from strength_case import StrengthCase

COHESION = 10e3
ROUGH = ("boundary conditions/footing/x=0.0", "mesh/parameters/ratio=30")
CIRCLE = ("mesh/geometry=axisymmetric",)
QUAD9 = ("mesh/parameters/triangles=0", "physics/ground/quadrature degree=4")
QUAD4 = ("mesh/parameters/triangles=0", "physics/ground/quadrature degree=3", "mesh/order=1")


@problem("exact", "slip-line theory (Prandtl; circles of Tresca soil)", "Bearing capacity")
class BearingCapacity(StrengthCase):
    def factor(self, deck, settings, area=1.0):
        """Bearing capacity factor, and how much it still grows over the last tenth of the path."""
        decks = [deck] if isinstance(deck, str) else deck
        history = self.run_deck([self.deck("bearing_capacity", d) for d in decks], settings)
        factor = -history["reaction/footing y"] / area / COHESION
        return factor[-1], factor[-1] / np.interp(0.9, history.time, factor) - 1

    def assert_collapse(self, what, deck, settings, exact, tolerance, area=1.0):
        factor, growth = self.factor(deck, settings, area)
        self.compare_range(what, factor / exact, 1.0, 1 + tolerance, 1.0)
        self.compare_range(what + ", growth at the end", growth, -1e-4, 0.01, 0.0)
        return factor

    def assert_sequence(self, deck, settings, exact, tolerances, area=1.0):
        """{cells: tolerance}: each mesh above the exact load, and closer to it than the coarser one."""
        before = np.inf
        for cells, tolerance in tolerances.items():
            factor = self.assert_collapse(f"{cells} cells", deck, settings + (f"mesh/parameters/cells={cells}",), exact, tolerance, area)
            self.assertLess(factor, before)
            before = factor

    def test_smooth_strip_on_clay(self):
        self.assert_sequence("strip_tresca", (), 5.141593, {4: 0.025, 6: 0.015})

    def test_rough_strip_on_clay(self):
        self.assert_sequence("strip_tresca", ROUGH, 5.141593, {6: 0.03, 10: 0.015})

    def test_smooth_circle_on_clay(self):
        self.assert_sequence("strip_tresca", CIRCLE, 5.6893, {4: 0.035, 6: 0.02}, np.pi)

    def test_rough_circle_on_clay(self):
        self.assert_sequence("strip_tresca", ROUGH + CIRCLE, 6.048, {6: 0.03, 8: 0.02}, np.pi)

    def test_quadrilaterals_do_not_lock(self):
        """With the volume strain at the points quad4 bears three times as much, quad9 1.4 to 2.8 % more than exact."""
        fitted = QUAD9 + ("physics/ground/volume strain=fitted",)
        self.assert_sequence("strip_tresca", fitted, 5.141593, {4: 0.01, 6: 0.005})
        self.assert_sequence("strip_tresca", QUAD4, 5.141593, {4: 0.05, 8: 0.02})
        self.assert_sequence("strip_tresca", fitted + ROUGH + CIRCLE, 6.048, {4: 0.02, 6: 0.007}, np.pi)
        self.assert_sequence("strip_tresca", QUAD4 + ROUGH + CIRCLE, 6.048, {4: 0.10, 8: 0.035}, np.pi)

    def test_strip_phi_20(self):
        self.assert_sequence("strip_mohr_coulomb", (), 14.834712, {4: 0.03, 6: 0.015, 8: 0.01})

    def test_strip_phi_30(self):
        self.assert_sequence(["strip_mohr_coulomb", "phi_30"], (), 30.139628, {4: 0.045, 6: 0.03})

    def test_strip_phi_30_with_surcharge(self):
        self.assert_sequence(["strip_mohr_coulomb", "phi_30", "surcharge"], (), 66.94187, {4: 0.045, 6: 0.03})

    @problem("benchmark", "Davis (1968)")
    def test_strip_on_soil_that_dilates_less_than_it_rubs(self):
        """By defaults the collapse load is between that of Davis' (1968) reduced friction and cohesion and the
        associated one, which the mesh exceeds by 4.5 %."""
        soils = ((20.0, 6.7, 1e-4, 7.0, 4.0), (25.0, 8.3, 1.5e-4, 9.0, 5.0))
        for friction, dilation, settlement, width, depth in soils:
            phi, psi = np.radians(friction), np.radians(dilation)
            reduced = np.cos(psi) / (1 - np.sin(psi) * np.sin(phi))
            davis = reduced * np.cos(phi) * self.cohesion_factor(np.arctan(reduced * np.sin(phi)))
            settings = (f"materials/soil/skeleton/friction angle [deg]={friction}",
                        f"materials/soil/skeleton/dilation angle [deg]={dilation}",
                        f"boundary conditions/footing/y=-{settlement}*t", "mesh/parameters/cells=4",
                        f"mesh/parameters/width={width}", f"mesh/parameters/depth={depth}")
            factor, growth = self.factor("strip_mohr_coulomb", settings)
            what = f"phi {friction}, psi {dilation}"
            self.compare_range(what, factor, davis, 1.045 * self.cohesion_factor(phi))
            self.compare_range(what + ", growth at the end", growth, -0.01, 0.01)

    @staticmethod
    def cohesion_factor(phi):
        """N_c of Prandtl (1921)."""
        return (np.exp(np.pi * np.tan(phi)) * np.tan(np.pi / 4 + phi / 2) ** 2 - 1) / np.tan(phi)

    @problem("behaviour")
    def test_cells_that_lock_are_named(self):
        fitted = QUAD9 + ("physics/ground/volume strain=fitted",)
        for settings, warned in (((), False), (QUAD9, True), (fitted, False), (QUAD9 + ("materials/soil/skeleton/Poisson's ratio=0.3",), False)):
            arguments = ["run", "-q", "--steps", "1", self.deck("bearing_capacity", "strip_tresca")]
            for setting in settings:
                arguments += ["--set", setting]
            done = program(arguments, 1, self.folder)
            self.assertEqual("3 x 3 points are some per cent too stiff" in done.stderr, warned, done.stderr)

    @problem("behaviour")
    def test_a_fit_that_does_not_suit_the_law_is_refused(self):
        done = program(["check", self.deck("bearing_capacity", "strip_mohr_coulomb"), "--set", "physics/ground/volume strain=fitted"], 1, self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("physics/ground/volume strain: 'fitted' is for laws whose mean stress follows the volume strain alone: linear elastic, "
                      "neo-hookean, tresca, von mises; material 'soil' is mohr-coulomb", done.stderr)


if __name__ == "__main__":
    unittest.main()
