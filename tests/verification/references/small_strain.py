"""Closed forms of the shear stress at small strain: first loading by Hardin and Drnevich, with the reference strain of
Santos and Correia and an exponent as Darendeli's, until the tangent has fallen to the shear modulus of the law;
reversals by Masing's rule.

No bricks here: a history is a list of reversals. Strain is engineering shear."""
import numpy as np


class Curve:
    """G0 [Pa] at zero strain, g [Pa] of the law, strain: gamma_0.7, a: curvature."""

    def __init__(self, G0, g, strain, a=1.0):
        self.G0, self.g, self.strain, self.a = G0, g, strain, a
        low, high = 0.0, 1e3 * strain
        for _ in range(200):  # where the tangent is g
            middle = 0.5 * (low + high)
            y = 0.385 * (middle / strain) ** a
            low, high = (middle, high) if G0 * (1 + (1 - a) * y) > g * (1 + y) ** 2 else (low, middle)
        self.end = low

    def first(self, gamma):
        """Shear stress of first loading [Pa]."""
        within = np.minimum(gamma, self.end)
        return self.G0 * within / (1 + 0.385 * (within / self.strain) ** self.a) + self.g * (gamma - within)

    def tangent(self, gamma):
        y = 0.385 * (gamma / self.strain) ** self.a
        return np.where(gamma < self.end, self.G0 * (1 + (1 - self.a) * y) / (1 + y) ** 2, self.g)

    def history(self, gamma):
        """Shear stress along a path of strain from zero: Masing; an inner loop is forgotten when it closes."""
        turns, stress, last, sign = [], [0.0], 0.0, 0
        for strain in gamma[1:]:
            way = np.sign(strain - last)
            if way and sign and way != sign:
                turns.append((last, stress[-1]))
            sign = way or sign
            while turns:
                start, at = turns[-1]
                size = abs(turns[-2][0] - start) if len(turns) > 1 else 2 * abs(start)
                if abs(strain - start) <= size * (1 + 1e-12):
                    break
                turns = turns[:-2] if len(turns) > 1 else []
            if turns:
                start, at = turns[-1]
                stress.append(at + np.sign(strain - start) * 2 * self.first(0.5 * abs(strain - start)))
            else:
                stress.append(np.sign(strain) * self.first(abs(strain)))
            last = strain
        return np.array(stress)

    def damping(self, amplitude):
        """Damping ratio of the loop between two equal amplitudes: its area over 4 pi times the energy of the secant.
        Closed form where a = 1 and the loop ends before the tangent is g."""
        if self.a == 1.0 and amplitude <= self.end:
            x = 0.385 * amplitude / self.strain
            return 4 / np.pi * (1 + 1 / x) * (1 - np.log1p(x) / x) - 2 / np.pi
        gamma = amplitude * np.linspace(0, 1, 20001) ** 2
        area = np.trapz(self.first(gamma), gamma)
        secant = 0.5 * self.first(amplitude) * amplitude
        return 8 * (area - secant) / (4 * np.pi * secant)

    def cavity(self, gamma):
        """Growth of the pressure in a long cylindrical cavity in soil without drainage, strained by gamma (twice the
        strain of the wall) from rest: the integral of tau/gamma over gamma, for gamma falls with the square of the
        radius."""
        if gamma == 0:
            return 0.0
        grid = gamma * np.linspace(0, 1, 20001)[1:] ** 2
        return np.trapz(self.first(grid) / grid, grid)
