"""Columns with compressible water: undrained waves, gassy water, steady vibration, a pressure wave from the surface."""
import unittest
from dataclasses import replace

import numpy as np

from compared_case import problem
from dynamics_case import LAYER, SAND, SCALE, SINE_RAMP, DynamicsCase, between, corner, fluid_acceleration, reference, stiff_layer


def leading_pole(signal, dt, order):
    """The pole of largest amplitude with an imaginary part in a sum of exponentials (matrix pencil; Hua and Sarkar 1990)."""
    window = len(signal) // 3
    hankel = np.lib.stride_tricks.sliding_window_view(signal, window)
    _, _, v = np.linalg.svd(hankel, full_matrices=False)
    v = v[:order].T
    z = np.linalg.eigvals(np.linalg.pinv(v[:-1]) @ v[1:])
    amplitude = np.linalg.lstsq(np.vander(z, len(signal), increasing=True).T, signal.astype(complex), rcond=None)[0]
    amplitude[z.imag < 1e-6] = 0
    return np.log(z[np.argmax(np.abs(amplitude))]) / dt


@problem("exact", "linear u-p theory after Zienkiewicz, Chang and Bettess (1980), modal sums",
         "Column with compressible water")
class CompressibleColumn(DynamicsCase):
    def compare_response(self, history, column, load, times, probes, name, tolerance=5e-3, top=True):
        depths = [0] + list(probes.values())
        u, p = column.response(depths, times, load)
        if top:
            self.compare_values(name + "u top", self.settlement(history, "top", times), u[:, 0], tolerance,
                                np.abs(u[:, 0]).max())
        for i, probe in enumerate(probes, 1):
            self.compare_values(f"{name}p {probe}", self.pressure(history, probe, times), p[:, i], tolerance,
                                np.abs(p[:, i]).max())

    def test_sand_and_water(self):
        middle = corner(10.0, 80, 0.03, 5.0)
        for accelerating in (False, True):
            with self.subTest(fluid_acceleration=accelerating):
                history = self.run_deck(self.deck("sand_and_water"), fluid_acceleration(accelerating) + (
                    f"output/probes/middle={{0.0, {10 - middle}}}",))
                self.compare_response(history, replace(SAND, fluid_acceleration=accelerating),
                                      reference.one_minus_cosine(1e3 * SCALE, 200.0), np.array([0.01, 0.03, 0.1]),
                                      {"middle": middle, "base": 10.0}, f"fluid acceleration {accelerating}: ")

    def test_gassy_water_under_a_sine_ramp(self):
        middle = corner(30.0, 60, 0.2, 15.0)
        for accelerating in (False, True):
            with self.subTest(fluid_acceleration=accelerating):
                history = self.run_deck(self.deck("sine_ramp"), fluid_acceleration(accelerating) + (
                    f"output/probes/middle={{0.0, {30 - middle}}}",))
                self.compare_response(history, replace(SINE_RAMP, fluid_acceleration=accelerating),
                                      reference.sine_ramp(1e3 * SCALE, 0.1), np.array([0.1, 0.5, 1.0]),
                                      {"middle": middle, "base": 30.0}, f"fluid acceleration {accelerating}: ")

    def test_undrained_frequency_and_damping(self):
        """A short pulse, then free vibration. Without algorithmic damping the flow of water alone damps it."""
        dt = 1e-4
        for conductivity in (1e-4, 1e-3):
            with self.subTest(conductivity=conductivity):
                history = self.run_deck(self.deck("sand_and_water"), (
                    "mesh/cells={1, 20}", "mesh/grading={1.0, 1.0}", f"materials/soil/permeability/hydraulic conductivity={conductivity}",
                    "boundary conditions/load/y=t < 0.02 ? -(1 - cos(100*pi*t)) : 0", "stages/shaking/duration=0.12",
                    f"stages/shaking/time step/initial={dt}"))
                free = history.time > 0.0201
                pole = leading_pole(history["probe/base/pore pressure"][free][::8], 8 * dt, 9)
                frequency, damping = replace(SAND, mobility=conductivity / 1e4).free_vibration()
                self.compare_values(f"k {conductivity}: frequency", abs(pole), frequency, 1e-3, frequency)
                self.compare_values(f"k {conductivity}: damping", -pole.real / abs(pole), damping, 1e-2, damping)

    def test_steady_vibration(self):
        """Amplitude and phase of the last cycles by least squares."""
        depths = {name: corner(30.0, 60, 0.01, z) for name, z in (("one metre", 1.0), ("five metres", 5.0), ("middle", 15.0), ("base", 30.0))}
        history = self.run_deck(self.deck("steady_layer"), [f"output/probes/{n}={{0.0, {30 - z}}}" for n, z in depths.items()])
        w = 3.379
        last = history.time > history.time[-1] - 2 * np.pi / w
        t = history.time[last]
        basis = np.array([np.sin(w * t), np.cos(w * t), np.ones_like(t)]).T

        def amplitude(name):
            s, c, _ = np.linalg.lstsq(basis, history[name][last], rcond=None)[0]
            return s + 1j * c

        u, p = LAYER.steady([0] + list(depths.values()), w, 100.0)
        self.compare_values("u top", -amplitude("probe/top/displacement y"), u[0], 5e-3, abs(u[0]))
        for i, probe in enumerate(depths, 1):
            self.compare_values(f"p {probe}", amplitude(f"probe/{probe}/pore pressure"), p[i], 5e-3, abs(p[i]))

    def test_pressure_wave(self):
        """Pore pressures behind and ahead of the fast wave (2242 m/s)."""
        times = np.array([2e-4, 4e-4])
        for conductivity in (1e-3, 1e-4):
            with self.subTest(conductivity=conductivity):
                history = self.run_deck(self.deck("pressure_wave"), (f"materials/soil/permeability/hydraulic conductivity={conductivity}",))
                _, p = stiff_layer(conductivity).response([0.1, 0.2, 0.4, 0.6, 0.8], times, reference.ramp(5e3, 1e-5))
                for i, d in enumerate((0.1, 0.2, 0.4, 0.6, 0.8)):
                    self.compare_values(f"k {conductivity}: p({d} m)",
                                        between(history, f"probe/{d:g} m/pore pressure", times), p[:, i], 5e-3, 5e3)


if __name__ == "__main__":
    unittest.main()
