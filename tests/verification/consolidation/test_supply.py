"""Water supplied inside the soil: a well in a confined layer against Theis (1935), and an even supply against the steady flow
that it makes."""
import os
import unittest

import h5py
import numpy as np
from scipy.special import exp1

from compared_case import problem
from mudline_case import ROOT, MudlineCase, deck_text, program

CONDUCTIVITY, WEIGHT, POROSITY, BULK = 1e-4, 9810.0, 0.4, 1e7  # [m/s, N/m3, -, Pa]
STIFF = {"porosity": POROSITY, "skeleton": {"type": "linear elastic", "Young's modulus": 1e14, "Poisson's ratio": 0.2},
         "fluid": {"type": "water", "bulk modulus": BULK, "unit weight": WEIGHT},
         "permeability": {"type": "constant", "hydraulic conductivity": CONDUCTIVITY}}
DISCHARGE, THICKNESS = 2e-5, 1.0  # [m3/s, m]


def theis(radius, time):
    """Pore pressure [Pa] of a well of constant discharge in a layer without end."""
    diffusivity = CONDUCTIVITY * BULK / (WEIGHT * POROSITY)
    return DISCHARGE * WEIGHT / (4 * np.pi * CONDUCTIVITY * THICKNESS) * exp1(radius ** 2 / (4 * diffusivity * time))


def layer(supply, cell="quad9", rows=2):
    """A disc of 100 m with the axis at x = 0, sealed above and below; soil that does not move."""
    return {
        "mesh": {"type": "box", "geometry": "axisymmetric", "cell": cell, "cells": [60, rows], "upper": [100.0, THICKNESS], "grading": [400.0, 3.0]},
        "materials": {"sand": STIFF},
        "physics": {"ground": {"type": "biot"}},
        "boundary conditions": {
            "held": {"type": "fixed", "set": "bottom"}, "above": {"type": "fixed", "set": "top"},
            "far": {"type": "pore pressure", "set": "right", "value": 0.0}, "supply": supply},
        "stages": {"pump": {"type": "quasi-static", "duration": 100.0, "time step": {"initial": 0.02, "maximum": 0.5, "growth": 1.2}}},
        "output": {"field steps": 1000}}


def column(supply):
    """A column of 2 m whose right end is drained; elsewhere sealed."""
    return {
        "mesh": {"type": "box", "cell": "quad9", "cells": [8, 1], "upper": [2.0, 0.5]},
        "materials": {"sand": STIFF},
        "physics": {"ground": {"type": "biot"}},
        "boundary conditions": {
            "held": {"type": "fixed", "set": "bottom"}, "above": {"type": "fixed", "set": "top"},
            "drained": {"type": "pore pressure", "set": "right", "value": 0.0}, "supply": supply},
        "stages": {"flow": {"type": "quasi-static", "duration": 4000.0, "time step": {"initial": 10.0, "growth": 2.0}}},
        "solver": {"residual tolerance": 1e-11},
        "output": {"field steps": 1000}}


@problem("exact", "Theis (1935)", "Water supplied in the soil")
class Supply(MudlineCase):
    def pressures(self, name):
        with h5py.File(f"{self.folder}/results/{name}.h5") as file:
            last = file["steps"][sorted(file["steps"])[-1]]
            return last["coordinates"][:], last["nodal/pore_pressure"][:].ravel()

    def test_well_in_a_confined_layer(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                deck = self.write("well.xml", deck_text("well", layer({"type": "well", "set": "left", "discharge": DISCHARGE})))
                history = self.run_deck(deck, ranks=ranks, extra=["--overwrite"])
                x, pressure = self.pressures("well")
                for radius in (1.0, 3.0, 8.0):
                    line = np.flatnonzero(np.isclose(x[:, 1], 0))
                    line = line[np.argsort(x[line, 0])]
                    found = np.interp(np.log(radius), np.log(x[line, 0] + 1e-9), pressure[line])
                    self.compare(f"pressure at {radius} m", abs(found / theis(radius, 100.0) - 1), 0.01)
                self.assertLess(np.abs(history["balance/water/error"]).max(), 1e-12)

    @problem("exact", "balance of water; Thiem (1906)")
    def test_pumped_well(self):
        """The shipped deck: the drawdown of Thiem (1906), a little deeper for the water that the clay gives; all water comes from the sides."""
        history = self.run_deck(os.path.join(ROOT, "inputs", "consolidation", "pumped_well.xml"))
        thiem = -2e-4 * 9810.0 / (2 * np.pi * 1e-5 * 8.0) * np.log(100.0 / 20.0)
        self.assertGreater(history["probe/sand at 20 m/pore pressure"][-1] / thiem, 1.0)
        self.assertLess(history["probe/sand at 20 m/pore pressure"][-1] / thiem, 1.03)
        self.compare("discharge through the sides",
                     abs((history["reaction/far sand"][-1] + history["reaction/surface"][-1]) / 2e-4 - 1), 0.02)
        self.assertLess(np.abs(history["balance/water/error"]).max(), 1e-9)

    def test_well_is_the_supply_of_a_thin_core(self):
        """The same discharge as a supply of the soil within the first column of elements."""
        supply = {"type": "fluid supply", "rate": f"{DISCHARGE}/(pi*0.25^2*{THICKNESS})*(x < 0.25)"}
        deck = self.write("core.xml", deck_text("core", layer(supply)))
        self.run_deck(deck)
        x, pressure = self.pressures("core")
        at = np.argmin(np.hypot(x[:, 0] - 5.0, x[:, 1]))
        self.compare("pressure", abs(pressure[at] / theis(x[at, 0], 100.0) - 1), 0.08)

    @problem("exact", "steady flow under an even supply")
    def test_even_supply(self):
        rate = 1e-6
        history = self.run_deck(self.write("even.xml", deck_text("even", column({"type": "fluid supply", "region": "soil", "rate": rate}))))
        x, pressure = self.pressures("even")
        exact = rate * WEIGHT / (2 * CONDUCTIVITY) * (4.0 - x[:, 0] ** 2)
        corners = np.isclose(np.mod(x[:, 0], 0.25), 0) & (np.isclose(x[:, 1], 0) | np.isclose(x[:, 1], 0.5))
        self.compare("pressure", np.abs(pressure - exact)[corners].max() / exact.max(), 1e-6)
        self.compare("discharge", abs(history["reaction/drained"][-1] / (rate * 2.0 * 0.5) + 1), 1e-6)
        self.assertLess(np.abs(history["balance/water/error"]).max(), 1e-12)
        self.compare("outflow against storage",
                     abs(history["balance/water/outflow"][-1] - (-history["balance/water/change"][-1])), 1e-12)

    @problem("behaviour")
    def test_refusals(self):
        well = {"type": "well", "set": "right", "discharge": 1e-5}
        for entries, words in (
                (column({**well, "set": "rihgt"}), "boundary conditions/supply/set: unknown mesh set 'rihgt' (did you mean 'right'?)"),
                (column({"type": "fluid supply", "region": "sol", "rate": 1.0}), "boundary conditions/supply/region: unknown mesh region 'sol' (did you mean 'soil'?)"),
                ({**column(well), "physics": {"ground": {"type": "solid"}}, "materials": {"sand": {**STIFF, "fluid": None}}},
                 "boundary conditions/supply/type: this model has no pore water")):
            with self.subTest(words=words):
                if entries["materials"]["sand"]["fluid"] is None:
                    entries["materials"]["sand"] = {k: v for k, v in STIFF.items() if k not in ("fluid", "permeability")}
                    del entries["boundary conditions"]["drained"]
                done = program(["check", self.write("wrong.xml", deck_text("wrong", entries))], 1, self.folder)
                self.assertEqual(done.returncode, 2)
                self.assertIn(words, done.stderr)


if __name__ == "__main__":
    unittest.main()
