"""Soil above the water table: infiltration against Srivastava and Yeh (1991), a dam with a free surface against
Dupuit and Charny, rest above the water level, weight and stress by Bishop against quadrature, and the balance of water."""
import os
import unittest

import h5py
import numpy as np
from scipy.integrate import cumulative_trapezoid
from scipy.optimize import brentq

from compared_case import problem
from mudline_case import ROOT, MudlineCase, deck_text, program

CONDUCTIVITY, WEIGHT, POROSITY = 1e-5, 9810.0, 0.4  # [m/s, N/m3, -]
GRAINS, WATER, GRAVITY = 2700.0, 1000.0, 9.81
HELD = {"held": {"type": "fixed", "set": "bottom"}, "above": {"type": "fixed", "set": "top"},
        "left": {"type": "fixed", "set": "left"}, "right": {"type": "fixed", "set": "right"}}
ROLLERS = {"base": {"type": "fixed", "set": "bottom"}, "left": {"type": "fixed", "set": "left", "components": "x"},
           "right": {"type": "fixed", "set": "right", "components": "x"}}


def soil(retention, young=1e12, poisson=0.3, **fluid):
    result = {"porosity": POROSITY, "grain density": GRAINS,
              "skeleton": {"type": "linear elastic", "Young's modulus": young, "Poisson's ratio": poisson},
              "fluid": {"type": "water", "unit weight": WEIGHT, **(fluid or {"incompressible": True})},
              "permeability": {"type": "constant", "hydraulic conductivity": CONDUCTIVITY}}
    return {**result, "retention": retention} if retention else result


def conductivity(z, time, length, before, after, count=300):
    """Relative conductivity at heights z above the table, all without dimension (Srivastava and Yeh 1991): the inflow
    at the top changes at the time 0 from `before` to `after`, as shares of the saturated conductivity."""
    def condition(x):
        return np.sin(x * length) + 2 * x * np.cos(x * length)

    roots = np.array([brentq(condition, (k - 0.5) * np.pi / length, k * np.pi / length) for k in range(1, count + 1)])
    series = np.sin(np.outer(z, roots)) * np.sin(roots * length) * np.exp(-roots ** 2 * time)
    series = np.sum(series / (1 + length / 2 + 2 * roots ** 2 * length), axis=1)
    return after - (after - 1) * np.exp(-z) - 4 * (after - before) * np.exp((length - z) / 2 - time / 4) * series


@problem("exact", "equilibrium, by quadrature", "Soil above the water table", topic="unsaturated soil")
class Unsaturated(MudlineCase):
    def last(self, name):
        """Coordinates at the start, and pore pressures at the end, of all nodes."""
        with h5py.File(f"{self.folder}/results/{name}.h5") as file:
            step = file["steps"][sorted(file["steps"])[-1]]
            return file["mesh/coordinates"][:], step["nodal/pore_pressure"][:].ravel()

    def nodes(self, name):
        """Heights at the start and pore pressures at the end, of the nodes along the edge x = 0 (y = 0)."""
        x, p = self.last(name)
        across, up = ([0, 1], 2) if np.ptp(x[:, 2]) > 0 else ([0], 1)
        line = np.flatnonzero(np.all(np.isclose(x[:, across], 0), axis=1))
        order = line[np.argsort(x[line, up])]
        return x[order, up], p[order]

    def infiltration(self, name, cell="quad9", geometry="plane strain", ranks=1):
        """A column of 1 m over its water table; rain of a tenth, then of nine tenths of the conductivity."""
        alpha, residual, space = 5.0, 0.1, cell in ("hex27", "tet10")
        top, cells = ([0.1, 0.1, 1.0], [1, 1, 20]) if space else ([0.1, 1.0], [1, 40])
        sides = {name: {"type": "fixed", "set": name} for name in (("front", "back") if space else ())}
        time = 0.5 / (alpha * CONDUCTIVITY) * POROSITY * (1 - residual)
        deck = deck_text(name, {
            "mesh": {"type": "box", "geometry": geometry, "cell": cell, "cells": cells, "upper": top},
            "materials": {"sand": soil({"type": "exponential", "reference suction": WEIGHT / alpha,
                                        "residual saturation": residual})},
            "physics": {"ground": {"type": "biot", "gravity": [0.0, 0.0, -GRAVITY][3 - len(top):]}},
            "boundary conditions": {**HELD, **sides,
                                    "table": {"type": "pore pressure", "set": "bottom", "value": 0.0},
                                    "dew": {"type": "flux", "set": "top", "value": -0.1 * CONDUCTIVITY},
                                    "rain": {"type": "flux", "set": "top", "value": -0.9 * CONDUCTIVITY}},
            "stages": {"dry": {"type": "quasi-static", "duration": 1e6, "conditions": [*HELD, *sides, "table", "dew"],
                               "time step": {"initial": 100.0, "growth": 1.5}},
                       "wet": {"type": "quasi-static", "duration": time,
                               "conditions": [*HELD, *sides, "table", "rain"],
                               "time step": {"initial": time / 80, "growth": 1.0}}},
            "solver": {"residual tolerance": 1e-11},
            "output": {"field steps": 100000}})
        history = self.run_deck(self.write(name + ".xml", deck), ranks=ranks)
        z, p = self.nodes(name)
        corners = slice(None, None, 2)
        found = np.exp(p * alpha / WEIGHT)
        exact = conductivity(z * alpha, 0.5, alpha, 0.1, 0.9)
        self.compare(f"{name}: relative conductivity", np.abs(found - exact)[corners].max(), 0.005)
        self.assertLess(np.abs(history["balance/water/error"]).max(), 1e-10)
        return found

    @problem("exact", "Srivastava and Yeh (1991)")
    def test_infiltration(self):
        self.infiltration("rain_on_ranks", ranks=2)
        self.infiltration("rain_round", geometry="axisymmetric")

    @problem("exact", "Srivastava and Yeh (1991)")
    def test_infiltration_in_space(self):
        self.infiltration("rain_in_space", cell="hex27", geometry="three-dimensional")

    @problem("exact", "Charny (1951)")
    def test_dam(self):
        """The shipped deck. What flows through every section follows from the pore pressures of the two faces alone:
        Q = k/(weight L) times the difference of the integrals of the potential of k_r (Charny 1951); without suction that
        is Dupuit's discharge."""
        width, height, suction = 4.0, 4.0, 5000.0
        history = self.run_deck(os.path.join(ROOT, "inputs", "consolidation", "dam.xml"))
        discharge = history["discharge/open face"][-1]
        self.compare("dam: what enters leaves", abs(history["reaction/lake"][-1] / discharge - 1), 1e-4)
        dupuit = CONDUCTIVITY * height ** 2 / (2 * width)
        self.assertTrue(1.0 < discharge / dupuit < 1.08, discharge / dupuit)
        x, p = self.last("dam")
        table = -np.geomspace(1e6, 1e-3, 20001)  # pore pressures, rising
        ratio = -table / suction
        effective = (1 + ratio ** 2) ** -0.5
        drained = cumulative_trapezoid(effective ** 0.5 * (1 - ratio * effective) ** 2, table, initial=0)

        def potential(face):
            on = np.flatnonzero(np.isclose(x[:, 0], face))
            on = on[np.argsort(x[on, 1])][::2]  # corners
            fine = np.linspace(0, 5.0, 20001)
            at = np.interp(fine, x[on, 1], p[on])
            of_height = np.where(at > 0, drained[-1] + at, np.interp(at, table, drained))
            return cumulative_trapezoid(of_height, fine)[-1]

        exact = CONDUCTIVITY / (WEIGHT * width) * (potential(0.0) - potential(width))
        self.compare("dam: discharge over that of the potentials", abs(discharge / exact - 1), 0.005)
        face = np.isclose(x[:, 0], width)
        self.assertLess(p[face].max(), 0.01 * WEIGHT)  # no pressure on the face
        wet = x[face & (p > -1.0), 1].max()
        self.assertTrue(0.5 < wet < 2.5, wet)  # the water comes out above the toe
        self.assertLess(np.abs(history["balance/water/error"]).max(), 1e-6)

    def resting(self, name, **changes):
        """Ground of 10 m with its water level at 4 m, under a surcharge."""
        column = {
            "mesh": {"type": "box", "cell": "quad9", "cells": [1, 40], "upper": [1.0, 10.0]},
            "materials": {"silt": soil({"type": "van genuchten", "reference suction": 20000.0, "shape": 2.0,
                                        "residual saturation": 0.1}, young=1e7)},
            "physics": {"ground": {"type": "biot", "gravity": [0.0, -GRAVITY],
                                   "initial state": {"type": "geostatic", "water level": 4.0, "surcharge": 10000.0,
                                                     "K0": 0.5}}},
            "boundary conditions": {**ROLLERS, "load": {"type": "pressure", "set": "top", "value": 10000.0}},
            "stages": {"start": {"type": "geostatic"},
                       "wait": {"type": "quasi-static", "duration": 1e7,
                                "time step": {"initial": 1e4, "growth": 2.0}}},
            "solver": {"residual tolerance": 1e-11},
            "output": {"field steps": 100000, "probes": {"top": [0.0, 10.0]}}}
        column["boundary conditions"].update(changes)
        return self.write(name + ".xml", deck_text(name, column))

    def test_rest_above_the_table(self):
        """Nothing moves, and stresses are those of the weight of moist soil and of Bishop's suction."""
        for name, top in (("sealed", {}), ("open", {"air": {"type": "seepage face", "set": "top"}})):
            with self.subTest(top=name):
                history = self.run_deck(self.resting(name, **top))
                self.compare("settlement", np.abs(history["probe/top/displacement y"]).max(), 1e-6)
        with h5py.File(f"{self.folder}/results/open.h5") as file:
            last = file["steps"][sorted(file["steps"])[-1]]
            stress, filled = -last["cell/effective_stress"][:, 3], last["cell/saturation"][:].ravel()
        middle = 10.0 * (np.arange(40) + 0.5) / 40  # of the cells
        y = np.linspace(10.0, 0.0, 100001)
        pore = WEIGHT * (4.0 - y)
        effective = np.where(pore < 0, (1 + (np.maximum(-pore, 0) / 20000.0) ** 2) ** -0.5, 1.0)
        saturation = 0.1 + 0.9 * effective
        density = (1 - POROSITY) * GRAINS + POROSITY * saturation * WATER
        total = 10000.0 + GRAVITY * cumulative_trapezoid(density, -y, initial=0)

        def of_cells(values):  # means of the three heights of the cells' points
            places = [middle + shift * np.sqrt(0.6) * 0.125 for shift in (-1, 0, 1)]
            return sum(np.interp(place, y[::-1], values[::-1]) for place in places) / 3

        self.compare("saturation above the table", np.abs(filled - of_cells(saturation)).max(), 1e-6)
        self.compare("effective stress", np.abs(stress / of_cells(total - effective * pore) - 1).max(), 2e-4)

    def test_shrinkage(self):
        """Suction that comes slowly from both ends shortens a laterally held column by S_e s/M."""
        young, suction, alpha = 1e7, 3e4, 1e-4
        modulus = young * 0.7 / (1.3 * 0.4)
        deck = deck_text("shrinks", {
            "mesh": {"type": "box", "geometry": "axisymmetric", "cell": "quad9", "cells": [1, 8],
                     "upper": [0.5, 1.0]},
            "materials": {"clay": soil({"type": "van genuchten", "reference suction": 1 / alpha, "shape": 1.5},
                                       young=young)},
            "physics": {"ground": {"type": "biot"}},
            "boundary conditions": {**ROLLERS, "dry": {"type": "pore pressure", "set": "top",
                                                       "value": f"-{suction}*min(1, t/1e5)"}},
            "stages": {"dry": {"type": "quasi-static", "duration": 1e9,
                               "time step": {"initial": 5000.0, "growth": 1.3}}},
            "solver": {"residual tolerance": 1e-11},
            "output": {"field steps": 100000, "probes": {"top": [0.0, 1.0]}}})
        history = self.run_deck(self.write("shrinks.xml", deck))
        acting = suction * (1 + (alpha * suction) ** 1.5) ** (1 / 1.5 - 1)
        exact = np.expm1(-acting / modulus)  # of the logarithmic strain of a law in rates
        self.compare("shrinkage", abs(history["probe/top/displacement y"][-1] / exact - 1), 1e-4)
        self.assertLess(np.abs(history["balance/water/error"]).max(), 1e-10)

    @problem("exact", "flow by k k_r, after Mualem (1976)")
    def test_relative_permeability(self):
        """Water that sinks through evenly moist soil, its suction held at both ends, flows by k k_r."""
        for suction, least, connectivity in ((2e4, 1e-9, 1.5), (5e5, 1e-3, 0.5)):
            with self.subTest(suction=suction):
                deck = deck_text("moist", {
                    "mesh": {"type": "box", "cell": "quad9", "cells": [1, 4], "upper": [1.0, 1.0]},
                    "materials": {"silt": soil({"type": "van genuchten", "reference suction": 1e4, "shape": 2.5,
                                                "connectivity": connectivity, "least relative permeability": least})},
                    "physics": {"ground": {"type": "biot", "gravity": [0.0, -GRAVITY],
                                           "initial state": {"type": "uniform", "pore pressure": -suction}}},
                    "boundary conditions": {**HELD, "in": {"type": "pore pressure", "set": "top", "value": -suction},
                                            "out": {"type": "pore pressure", "set": "bottom", "value": -suction}},
                    "stages": {"sink": {"type": "quasi-static", "duration": 10.0, "time step": {"initial": 5.0}}},
                    "output": {"field steps": 100000}})
                history = self.run_deck(self.write("moist.xml", deck), extra=["--overwrite"])
                ratio, m = suction / 1e4, 1 - 1 / 2.5
                effective = (1 + ratio ** 2.5) ** -m
                mualem = effective ** connectivity * (1 - (1 - effective ** (1 / m)) ** m) ** 2
                found = history["reaction/in"][-1] / CONDUCTIVITY
                self.compare("k_r", abs(found / max(mualem, least) - 1), 1e-6)

    @problem("behaviour")
    def test_refusals(self):
        """Saturated soil that is opened to water at no suction would swell without end."""
        def refused(entries, words):
            with self.subTest(words=words):
                done = program(["check", self.write("wrong.xml", entries)], 1, self.folder)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(words, done.stderr)

        with open(self.resting("base", drained={"type": "pore pressure", "set": "top", "value": 0.0})) as file:
            text = file.read()
        start = text.index('<ParameterList name="retention">')
        saturated = text[:start] + text[text.index("</ParameterList>", start) + len("</ParameterList>"):]
        refused(saturated, "boundary conditions/drained: prescribes the pore pressure 0 Pa at (0, 10), where the "
                           "start has a suction of 58860 Pa")
        done = program(["check", self.write("wetted.xml", text)], 1, self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        refused(text.replace('"reference suction"', '"referense suction"'),
                "retention/referense suction: unknown parameter (did you mean 'reference suction'?)")
        refused(text.replace('value="2"', 'value="1"').replace('value="2.0"', 'value="1.0"'), "retention/shape")
        refused(text.replace('"van genuchten"', '"exponential"'),
                "retention/shape: has no effect with 'type' = 'exponential'")
        refused(text.replace('"biot"', '"thermo-hydro-mechanical"'), "physics 'thermo-hydro-mechanical'")


if __name__ == "__main__":
    unittest.main()
