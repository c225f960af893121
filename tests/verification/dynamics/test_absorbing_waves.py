"""What an absorbing boundary throws back: plane pulses of P and S waves at 0, 30 and 60 degrees against the reflection that
its dashpots have by theory, and a wave in saturated soil.

A square of soil with the boundary on its right. On the other three sides the motion is prescribed: the incident pulse and
what theory says comes back, so that nothing else enters. Amplitudes of the waves that go back are fitted to the motion of
points at and before the boundary."""
import unittest

import numpy as np

from compared_case import problem
from dynamics_case import DynamicsCase
from mudline_case import deck_text
from references import viscous_boundary as theory

SOIL = theory.Elastic()
SIZE, CELLS = 4.0, 12       # [m], along each side
ORDER, AMPLITUDE = 8, 1e-6  # of the pulse; [m]
PROBES = [(x, 2.0) for x in (0.0, -0.5, -1.0)] + [(0.0, 1.5), (0.0, 2.5)]


class Pulse:
    """F(s) = (1 + i s / width)^-order: smooth, of one sign of frequency, with a peak at (order - 1) / width."""

    def __init__(self, wave_length, speed):
        self.width = (ORDER - 1) * wave_length / (2 * np.pi * speed)

    def __call__(self, s):
        return (1 + 1j * s / self.width) ** -ORDER

    def expression(self, wave, component, delay):
        """Re(displacement F(t - delay - slowness . x)), in the deck's terms."""
        factor = AMPLITUDE * wave.displacement[component]
        across, along = wave.slowness
        real = f"(t - {delay:.12g} - ({across.real:.12g})*x - ({along.real:.12g})*y)/{self.width:.12g}"
        decay = f"(1 + ({across.imag:.12g})*x/{self.width:.12g})"
        return (f"({abs(factor):.12g})*(({decay})^2 + ({real})^2)^(-{ORDER / 2})"
                f"*cos({np.angle(factor):.12g} - {ORDER}*atan(({real})/({decay})))")


class Incidence:
    """A pulse at an angle against a boundary with these factors; the motion everywhere, and a deck in which it must appear."""

    def __init__(self, kind, angle, normal=1.0, tangential=1.0):
        self.kind, self.factors = kind, (normal, tangential)
        self.incident, self.back, self.coefficient = theory.reflection(SOIL, kind, np.radians(angle), normal, tangential)
        speed = SOIL.speed_p if kind == "P" else SOIL.speed_s
        self.pulse = Pulse(SIZE / 1.5, speed)
        # at t = 0 next to nothing has arrived where the pulse enters first, in the end it has passed the points
        self.delay = 3.5 * self.pulse.width + SIZE * abs(self.incident.slowness[0].real)
        self.duration = self.delay + 3 * self.pulse.width + SIZE * self.incident.slowness[1].real

    def motion(self, wave, position, t):
        return np.outer(self.pulse(t - self.delay - wave.slowness @ position), AMPLITUDE * wave.displacement)

    def deck(self):
        waves = [self.incident] + [w for w in self.back.values() if np.abs(w.displacement).max() > 1e-9]
        exact = {name: " + ".join(self.pulse.expression(w, i, self.delay) for w in waves) for i, name in enumerate("xy")}
        sides = {side: {"type": "displacement", "set": side, **exact} for side in ("left", "bottom", "top")}
        return deck_text("wave", {
            "mesh": {"type": "box", "cell": "quad9", "cells": [CELLS, CELLS], "lower": [-SIZE, 0.0], "upper": [0.0, SIZE]},
            "materials": {"soil": {"density": SOIL.density, "void ratio": 0.7, "skeleton": {
                "type": "linear elastic", "Young's modulus": 2 * SOIL.shear * (1 + SOIL.poisson), "Poisson's ratio": SOIL.poisson}}},
            "physics": {"ground": {"type": "solid"}},
            "boundary conditions": {**sides, "open": {"type": "absorbing", "set": "right", "normal factor": self.factors[0],
                                                      "tangential factor": self.factors[1]}},
            "stages": {"wave": {"type": "dynamic", "duration": float(self.duration),
                                "integrator": {"type": "generalised alpha", "spectral radius": 1.0},
                                "time step": {"initial": float(self.pulse.width / 100)}}},
            "output": {"probes": {f"{i}": list(place) for i, place in enumerate(PROBES)}}})


DEPTH, PULSE = 30.0, 1e-3  # [m] column; [s] the pulse is exp(-(t/PULSE)^2), 3.5 of these after the start


def sand(conductivity):
    return theory.Saturated(40e6, 0.6 * 2650 + 0.4 * 1000, conductivity / 1e4, 0.4 / 2.2e9)


def saturated_column(conductivity):
    """A column that is hit on top by a pulse of total stress; the base absorbs, no water leaves anywhere."""
    return deck_text("column", {
        "mesh": {"type": "box", "cell": "quad9", "cells": [1, 120], "upper": [0.25, DEPTH]},
        "materials": {"soil": {
            "porosity": 0.4, "grain density": 2650.0,
            "skeleton": {"type": "linear elastic", "Young's modulus": 40e6, "Poisson's ratio": 0.0},
            "fluid": {"type": "water", "density": 1000.0, "bulk modulus": 2.2e9, "unit weight": 1e4},
            "permeability": {"type": "constant", "hydraulic conductivity": conductivity}}},
        "physics": {"ground": {"type": "biot"}},
        "boundary conditions": {
            "left side": {"type": "fixed", "set": "left", "components": "x"},
            "right side": {"type": "fixed", "set": "right", "components": "x"},
            "load": {"type": "traction", "set": "top", "y": f"-100*exp(-(t/{PULSE} - 3.5)^2)"},
            "open": {"type": "absorbing", "set": "bottom"}},
        "stages": {"wave": {"type": "dynamic", "duration": 0.035,
                            "integrator": {"type": "generalised alpha", "spectral radius": 1.0},
                            "time step": {"initial": PULSE / 20}}},
        "output": {"probes": {"middle": [0.0, DEPTH / 2]}}})


@problem("exact", "Lysmer and Kuhlemeyer (1969): reflection at dashpots", "What an absorbing boundary throws back")
class AbsorbingWaves(DynamicsCase):
    def reflected(self, case):
        """Fitted coefficients by kind, and the largest difference of any motion from the theory's, over the incident amplitude.
        The amplitude and phase of what comes in are fitted, too: over a few wave lengths time steps shift it a little."""
        history = self.run_deck(self.write("wave.xml", case.deck()))
        t = history.time
        waves = [case.incident] + [theory.plane_wave(SOIL, kind, case.incident.slowness[1].real, -1) for kind in "PS"]
        rows, right, error = [], [], 0.0
        for i, place in enumerate(np.array(PROBES)):
            measured = np.array([history[f"probe/{i}/displacement {c}"] for c in "xy"]).T
            exact = sum(case.motion(w, place, t).real for w in [case.incident] + list(case.back.values()))
            error = max(error, np.abs(measured - exact).max() / AMPLITUDE)
            moved = [case.motion(w, place, t).ravel() for w in waves]
            rows.append(np.array([part for m in moved for part in (m.real, -m.imag)]).T)
            right.append(measured.ravel())
        fit = np.linalg.lstsq(np.concatenate(rows), np.concatenate(right), rcond=None)[0]
        incident, p, s = fit[0::2] + 1j * fit[1::2]
        return {"P": p / incident, "S": s / incident}, error

    def check(self, case, name):
        found, error = self.reflected(case)
        self.compare_values(f"{name}: motion", error, 0.0, 1e-2, 1.0)
        for kind in "PS":
            self.compare_values(f"{name}: reflected {kind}", found[kind], case.coefficient[kind], 3e-3, 1.0)
        return found

    def test_normal_incidence(self):
        for kind in "PS":
            with self.subTest(kind):
                found = self.check(Incidence(kind, 0), kind)
                self.compare(f"reflected {kind}", abs(found[kind]), 1e-3)

    def test_saturated_soil(self):
        """The dashpots are those of soil without flow; what flows throws a little back, as the u-p equations say."""
        for conductivity in (1e-4, 1e-3):
            with self.subTest(conductivity=conductivity):
                self.check_column(conductivity)

    def check_column(self, conductivity):
        soil = sand(conductivity)
        history = self.run_deck(self.write("column.xml", saturated_column(conductivity)))
        t, p = history.time, history["probe/middle/pore pressure"]
        between = 0.0215  # [s] the pulse is past the middle and goes down, nothing has come back yet
        incident, reflected = np.where(t < between, p, 0), np.where(t < between, 0, p)
        dt, n = t[1] - t[0], 8 * len(t)
        frequencies, spectrum = 2 * np.pi * np.fft.rfftfreq(n, dt), np.fft.rfft(incident, n)
        back = np.zeros_like(spectrum)
        for i in range(1, np.searchsorted(frequencies, 6 / PULSE)):  # numpy's waves are exp(+i w t)
            w = frequencies[i]
            # a pressure changes its sign against the displacement when the wave turns
            back[i] = spectrum[i] * np.conj(-soil.reflection(w) * np.exp(1j * soil.wave_numbers(w)[0] * DEPTH))
        expected = np.fft.irfft(back, n)[:len(t)]
        peak = np.abs(incident).max()
        self.compare_values(f"k {conductivity}: peak that comes back", np.abs(reflected).max() / peak,
                            np.abs(expected).max() / peak, 1e-3, 1.0)
        self.compare_values(f"k {conductivity}: history", reflected[t > between], expected[t > between], 1.5e-3, peak)

    def test_oblique_incidence(self):
        for kind in "PS":
            for angle in (30, 60):
                with self.subTest(kind, angle=angle):
                    self.check(Incidence(kind, angle), f"{kind} {angle}")

    def test_factors(self):
        """Other dashpots throw back other waves: what is measured is the boundary, not what the sides prescribe."""
        self.check(Incidence("P", 30, normal=0.5, tangential=1.5), "P 30, other factors")
        case = Incidence("P", 30)
        case.factors = (0.5, 1.0)
        self.assertGreater(self.reflected(case)[1], 5e-2)


if __name__ == "__main__":
    unittest.main()
