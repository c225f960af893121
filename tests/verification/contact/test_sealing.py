"""A contact closes its own surface to water, from the first step on, and no other: Mandel's slab under a rigid plate that
is a body in contact, its free side drained by a condition that has the plate's corner too."""
import unittest

import numpy as np
from scipy.interpolate import CubicSpline

from compared_case import problem
from contact_case import ContactCase
from mudline_case import deck_text
from references import biot

FORCE = 10.0  # N/m on half the width of 1 m: 10 kPa, scaled by 1e-3 for the small-strain theory
TIMES = np.array([0.01, 0.05, 0.1, 0.2, 0.5])


def slab(drainage="sealed", drained_sets=("right",), walls=("left",), first_step=1 / 120, duration=450.0):
    """The right half of Mandel's slab, 0.1 m high, under a plate that rests on it and is pressed down at once."""
    conditions = {"lower plate": {"type": "fixed", "set": "bottom", "components": "y"}}
    conditions.update({"wall " + name: {"type": "fixed", "set": name, "components": "x"} for name in walls})
    conditions.update({"drained " + name: {"type": "pore pressure", "set": name} for name in drained_sets})
    return deck_text("slab", {
        "mesh": {"type": "box", "cell": "quad9", "cells": [40, 1], "upper": [1.0, 0.1], "grading": [0.2, 1.0]},
        "materials": {"soil": {
            "porosity": 0.4,
            "skeleton": {"type": "linear elastic", "Young's modulus": 1e7, "Poisson's ratio": 0.25},
            "fluid": {"type": "water", "incompressible": True, "unit weight": 1e4},
            "permeability": {"type": "constant", "hydraulic conductivity": 1e-6}}},
        "physics": {"ground": {"type": "biot"}},
        "bodies": {"plate": {"position": [0.0, 0.1],
                             "contour": {"type": "polyline", "extent": "full", "x": [-2.0, 2.0], "y": [0.0, 0.0]},
                             "motion": {"type": "force", "force y": str(-FORCE)}}},
        "boundary conditions": conditions,
        "contacts": {"face": {"type": "penalty", "body": "plate", "surface": "top", "drainage": drainage,
                              "penalty factor": 1000.0}},  # with 10 the springs would be a tenth as soft as the slab
        "stages": {"consolidation": {
            "type": "quasi-static", "duration": duration,
            "integrator": {"type": "theta", "theta": 0.5, "start-up steps": 8},
            "time step": {"initial": first_step, "growth": 1.1, "maximum": max(4.2, first_step)}}},
        "output": {"probes": {"centre": [0.0, 0.0], "side": [1.0, 0.0], "plate": [0.0, 0.1], "under the edge": [1.0, 0.1]}}})


@problem("exact", "Mandel (1953), in Laplace space", "Contact that seals, Mandel's slab")
class Sealing(ContactCase):
    def run_slab(self, **what):
        return self.run_deck(self.write("slab.xml", slab(**what)))

    def check_mandel(self, name, history):
        exact = biot.Symmetric(1, biot.INCOMPRESSIBLE, load=FORCE)
        t = TIMES / exact.soil.diffusivity

        def column(what):
            return CubicSpline(history.time, history[what])(t)

        self.compare_values(f"{name}: p", column("probe/centre/pore pressure"), [exact.pressure(T) for T in TIMES],
                            2e-3)
        self.compare_values(f"{name}: u", column("probe/side/displacement x"),
                            [exact.radial_displacement(T) for T in TIMES], 2e-3)
        self.assertEqual(np.abs(history["probe/under the edge/pore pressure"]).max(), 0)

    def test_sides_stay_drained(self):
        """The surface itself has no condition, one that the plate switches off, or one that 'drained' lets stand (then the
        water leaves upwards at once)."""
        self.check_mandel("no condition on the surface", self.run_slab())
        self.check_mandel("drained surface, sealed", self.run_slab(drained_sets=("right", "top")))
        history = self.run_slab(drained_sets=("right", "top"), drainage="drained", duration=30.0)
        self.assertLess(history["probe/centre/pore pressure"][-1], 1e-3 * FORCE)

    def test_first_step(self):
        """A plate that rests on the drained surface of a slab between smooth walls seals it in the first step already."""
        history = self.run_slab(drained_sets=("top",), walls=("left", "right"), first_step=100.0, duration=100.0)
        self.assertEqual(len(history.time), 1)
        self.compare_values("p", history["probe/plate/pore pressure"], FORCE, 1e-6)


if __name__ == "__main__":
    unittest.main()
