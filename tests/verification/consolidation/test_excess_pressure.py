"""Pore pressures counted from water at rest: the same soil under its own weight and a load, once with all of the water's weight,
once without. Displacements agree, and the pressures differ by the hydrostatic ones."""
import unittest

import h5py
import numpy as np

from compared_case import problem
from mudline_case import MudlineCase, deck_text, program

GRAVITY, WATER = 9.81, 1000.0


def column(excess, acceleration):
    """Five metres of soil, loaded on its drained top within 0.2 s, with inertia."""
    soil = {"void ratio": 0.9, "grain density": 2700.0, "Biot coefficient": 0.9, "grain bulk modulus": 4e9,
            "skeleton": {"type": "linear elastic", "Young's modulus": 5e8, "Poisson's ratio": 0.3},
            "fluid": {"type": "water"}, "permeability": {"type": "constant", "hydraulic conductivity": 1e-5}}
    start = {"type": "geostatic", "K0": 0.5, "surcharge": 5e3}
    physics = {"type": "biot", "gravity": [0.0, -GRAVITY], "fluid acceleration": acceleration, "initial state": start}
    if excess:
        physics["pore pressure"] = "excess"
        top = {"type": "pore pressure", "set": "top"}
    else:
        start["water level"] = 5.0
        top = {"type": "hydrostatic pressure", "set": "top", "unit weight": WATER * GRAVITY, "water level": 5.0}
    return deck_text("excess" if excess else "total", {
        "mesh": {"type": "box", "cell": "quad9", "cells": [1, 20], "upper": [1.0, 5.0]},
        "materials": {"clay": soil},
        "physics": {"ground": physics},
        "boundary conditions": {
            "base": {"type": "fixed", "set": "bottom"},
            "left": {"type": "fixed", "set": "left", "components": "x"}, "right": {"type": "fixed", "set": "right", "components": "x"},
            "top": top,
            "load": {"type": "traction", "set": "top", "y": "-5e3 - 1e3 * min(t / 0.2, 1)"}},
        "stages": {
            "rest": {"type": "geostatic", "balance tolerance": 1e-9},
            "load": {"type": "dynamic", "duration": 1.0, "time step": {"initial": 0.02, "maximum": 0.02},
                     "integrator": {"type": "generalised alpha", "spectral radius": 0.8}}},
        "solver": {"residual tolerance": 1e-10, "update tolerance": 1e-6},
        "output": {"field steps": 10}})


@problem("consistency", title="Excess pressures against whole ones")
class ExcessPressure(MudlineCase):
    def test_the_same_soil_with_and_without_the_weight_of_water(self):
        for acceleration in (False, True):
            with self.subTest(fluid_acceleration=acceleration):
                result = {}
                for excess in (False, True):
                    name = "excess" if excess else "total"
                    self.run_deck(self.write(f"{name}.xml", column(excess, acceleration)))
                    with h5py.File(f"{self.folder}/results/{name}.h5") as file:
                        last = file["steps"][sorted(file["steps"])[-1]]
                        result[name] = {key: last[f"nodal/{key}"][:] for key in ("displacement", "pore_pressure", "excess_pore_pressure")}
                        result[name]["height"] = last["coordinates"][:, 1]
                        result[name]["stress"] = last["cell/effective_stress"][:]
                total, excess = result["total"], result["excess"]
                size = np.abs(excess["displacement"]).max()
                self.assertGreater(size, 5e-7)
                # what remains: the water that stands above a sunken top (some micrometres here) loads its pores only
                self.compare("displacement", np.abs(total["displacement"] - excess["displacement"]).max() / size,
                             1e-4)
                self.compare("stress [Pa]", np.abs(total["stress"] - excess["stress"]).max(), 2.0)
                pressure = excess["pore_pressure"].ravel()
                self.assertGreater(pressure.max(), 300)
                rest = WATER * GRAVITY * (5.0 - total["height"])
                self.compare("excess pressure",
                             np.abs(total["pore_pressure"].ravel() - rest - pressure).max() / pressure.max(), 1e-3)
                np.testing.assert_array_equal(excess["excess_pore_pressure"].ravel(), pressure)

    @problem("behaviour")
    def test_a_water_level_is_refused(self):
        deck = column(True, False).replace('name="surcharge"', 'name="water level" type="double" value="5"/><Parameter name="surcharge"')
        done = program(["run", self.write("level.xml", deck)], folder=self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("water level: pore pressures are in excess of water at rest", done.stderr)


if __name__ == "__main__":
    unittest.main()
