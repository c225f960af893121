"""Mandel's slab, de Leeuw's cylinder and Cryer's sphere: pressure at the centre rises above its initial value before it
falls. Pressure, displacement and the peak against the solutions in Laplace space; loads scaled by 1e-3."""
import unittest

import numpy as np

from compared_case import problem
from consolidation_case import COMPRESSIBLE, ConsolidationCase, between
from references import biot

TIMES = np.array([0.01, 0.02, 0.05, 0.1, 0.2, 0.5])
TOLERANCE = 2e-3


@problem("exact", "Mandel (1953), de Leeuw (1965), Cryer (1963), in Laplace space", "Mandel, de Leeuw, Cryer")
class Symmetric(ConsolidationCase):
    def check(self, name, history, exact, side):
        t = TIMES / exact.soil.diffusivity
        self.compare_values(f"{name}: p", between(history, "probe/centre/pore pressure", t),
                            [exact.pressure(T) for T in TIMES], TOLERANCE)
        self.compare_values(f"{name}: u", between(history, f"probe/{side}/displacement x", t),
                            [exact.radial_displacement(T) for T in TIMES], TOLERANCE)
        fine = np.geomspace(0.02, 0.2, 2000)
        p = between(history, "probe/centre/pore pressure", fine / exact.soil.diffusivity)
        peak_time, peak = exact.peak()
        self.compare_values(f"{name}: peak", p.max(), peak, TOLERANCE)
        self.compare_values(f"{name}: time of the peak", fine[p.argmax()], peak_time, 2e-2)  # the peak is flat
        self.assertLess(np.abs(history["balance/water/error"]).max(), 1e-12)

    def test_mandel(self):
        for soil, decks in ((biot.INCOMPRESSIBLE, ["mandel"]), (biot.COMPRESSIBLE, ["mandel", "mandel_compressible"])):
            name = decks[-1]
            with self.subTest(name):
                exact = biot.Symmetric(1, soil, load=10.0)
                history = self.run_deck([self.deck(deck) for deck in decks], ["output/name=" + name], name=name)
                self.check(name, history, exact, "side")
                # the plate's work over its travel is the force on it, 10 Pa times 1 m in every step
                work, travel = history["balance/energy/supplied by prescribed motion"], history["probe/plate/displacement y"]
                force = -np.diff(work) / np.diff(travel)
                late = history.time[1:] * soil.diffusivity > 0.01
                self.compare_values(f"{name}: force on the plate", force[late], 10.0, TOLERANCE)

    def test_de_leeuw(self):
        self.radial("de_leeuw", 2)

    def test_cryer(self):
        self.radial("cryer", 3)

    def radial(self, deck, dimensions):
        for name, soil, settings in (("incompressible", biot.INCOMPRESSIBLE, ()), ("compressible", biot.COMPRESSIBLE, COMPRESSIBLE)):
            with self.subTest(name):
                exact = biot.Symmetric(dimensions, soil, load=10.0)
                duration = f"stages/consolidation/duration={0.54 / soil.diffusivity}"
                history = self.run_deck(self.deck(deck), settings + (duration,))
                self.check(f"{deck}, {name}", history, exact, "surface")


if __name__ == "__main__":
    unittest.main()
