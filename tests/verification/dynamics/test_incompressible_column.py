"""Column with incompressible constituents: harmonic and step load, with and without the fluid's acceleration."""
import unittest
from dataclasses import replace

import numpy as np

from compared_case import problem
from dynamics_case import DE_BOER, HAN, SCALE, DynamicsCase, fluid_acceleration, reference


@problem("exact", "de Boer, Ehlers and Liu (1993), modal sums", "Column with incompressible constituents")
class IncompressibleColumn(DynamicsCase):
    def test_harmonic_load(self):
        times = np.array([0.05, 0.1, 0.2, 0.4])
        for accelerating in (False, True):
            column = replace(DE_BOER, fluid_acceleration=accelerating)
            u, p = column.response([0, 1, 10], times, reference.one_minus_cosine(3e3 * SCALE, 75.0))
            for radius in (1.0, 0.8):
                with self.subTest(fluid_acceleration=accelerating, spectral_radius=radius):
                    history = self.run_deck(self.deck("de_boer"), fluid_acceleration(accelerating) + (
                        f"stages/shaking/integrator/spectral radius={radius}",))
                    name = f"radius {radius}, fluid acceleration {accelerating}: "
                    self.compare_values(name + "u(0)", self.settlement(history, "top", times), u[:, 0], 5e-3,
                                        u[:, 0].max())
                    self.compare_values(name + "u(1)", self.settlement(history, "one metre", times), u[:, 1], 5e-3,
                                        u[:, 1].max())
                    self.compare_values(name + "p(1)", self.pressure(history, "one metre", times), p[:, 1], 5e-3,
                                        p[:, 1].max())
                    self.compare_values(name + "p(10)", self.pressure(history, "base", times), p[:, 2], 5e-3,
                                        p[:, 2].max())

    def test_step_load(self):
        """Displacements only: the pressure of the discrete solution rings at the front."""
        times = np.array([0.1, 0.2, 0.5, 1.0])
        for accelerating in (False, True):
            with self.subTest(fluid_acceleration=accelerating):
                column = replace(DE_BOER, fluid_acceleration=accelerating)
                u, _ = column.response([0, 5], times, reference.step(1e3 * SCALE))
                history = self.run_deck(self.deck("de_boer"), fluid_acceleration(accelerating) + (
                    "boundary conditions/load/y=-1", "stages/shaking/duration=1", "stages/shaking/time step/initial=2e-3"))
                for i, probe in enumerate(("top", "middle")):
                    self.compare_values(f"fluid acceleration {accelerating}: u {probe}",
                                        self.settlement(history, probe, times), u[:, i], 5e-3, u[:, i].max())

    def test_ramp_and_sine(self):
        times = np.array([0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5])
        load = 1e3 * SCALE
        u, p = HAN.response([0, 5, 10], times, reference.together(
            reference.ramp(load, 0.02), reference.sine(load / 4, 20 * np.pi, 0.02)))
        history = self.run_deck(self.deck("ramp_and_sine"))
        self.compare_values("u(0)", self.settlement(history, "top", times), u[:, 0], 5e-3, u[:, 0].max())
        self.compare_values("p(5)", self.pressure(history, "middle", times), p[:, 1], 5e-3, p[:, 1].max())
        self.compare_values("p(10)", self.pressure(history, "base", times), p[:, 2], 5e-3, p[:, 2].max())


if __name__ == "__main__":
    unittest.main()
