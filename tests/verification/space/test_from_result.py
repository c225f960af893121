"""An axisymmetric result becomes the initial state of a model in space, which then goes on as the axisymmetric run does."""
import os
import unittest

import numpy as np
from scipy.interpolate import CubicSpline

from mudline_case import ROOT, deck_text, program
from space_case import SpaceCase, quasi_static

LOAD = 12e3  # [Pa], ramped over 20 s
TIMES = np.array([200.0, 1e3, 5e3, 2e4, 1e5])  # [s] after the load
CLAY = {"void ratio": 1.3, "grain density": 2700.0,
        "skeleton": {"type": "modified cam clay", "critical stress ratio": 1.0, "compression slope": 0.2, "swelling slope": 0.04,
                     "Poisson's ratio": 0.3},
        "fluid": {"type": "water"}, "permeability": {"type": "constant", "hydraulic conductivity": 1e-8}}


def model(name, mesh, up, initial, sides, stages):
    """`sides`: of the axis and of planes of symmetry, with the components that they hold."""
    def place(r, height):
        return [r, height] if up == "y" else [float(r * np.cos(np.pi / 4)), float(r * np.sin(np.pi / 4)), height]

    conditions = {side: {"type": "fixed", "set": side, "components": held} for side, held in sides.items()}
    conditions.update({"base": {"type": "fixed", "set": "base"}, "far side": {"type": "fixed", "set": "far side"},
                       "drained": {"type": "pore pressure", "set": "surface"}, "drained footing": {"type": "pore pressure", "set": "footing"},
                       "surcharge": {"type": "pressure", "set": "surface", "value": 10e3},
                       "load": {"type": "pressure", "set": "footing", "value": "10e3 + " + initial.pop("load")}})
    return deck_text(name, {
        "mesh": mesh, "materials": {"clay": CLAY},
        "physics": {"ground": {"type": "biot", "pore pressure": "excess", "gravity": [0.0, -9.81] if up == "y" else [0.0, 0.0, -9.81],
                               "initial state": initial}},
        "boundary conditions": conditions, "stages": stages,
        "output": {"probes": {"centre": place(0.0, -0.02), "below": place(0.0, -1.0), "beside": place(1.2, -0.6), "deep": place(0.8, -2.0)}}})


def footing(triangles):
    return {"type": "gmsh", "file": os.path.join(ROOT, "inputs", "bearing_capacity", "footing.geo"),
            "parameters": {"cells": 3, "ratio": 6, "triangles": triangles, "width": 4.0, "depth": 3.0}}


REST = quasi_static(TIMES[-1], 20.0, 0.5, 4, growth=1.4, maximum=2e4)


class FromResult(SpaceCase):
    """A footing on Modified Cam Clay, loaded beyond yield, which then consolidates."""

    def start(self, triangles=0):
        loading = quasi_static(20.0, 2.0, 0.5, 4, growth=1.25, maximum=5.0)
        deck = model("plane", {"geometry": "axisymmetric", **footing(triangles)}, "y",
                     {"type": "geostatic", "surcharge": 10e3, "K0": 0.6, "overconsolidation ratio": 1.5, "load": f"{LOAD}*min(t/20, 1)"},
                     {"symmetry": "x"}, {"loading": loading, "rest": REST})
        return self.run_text("plane", deck)

    def in_space(self, mesh, sides):
        return self.run_text("space", model("space", mesh, "z", {"type": "from result", "result": "results/plane@loading", "load": str(LOAD)},
                                            sides, {"balance": {"type": "geostatic", "balance tolerance": 1e-3}, "rest": REST}))

    def test_consolidation_goes_on(self):
        plane = self.start()
        out = program(["mesh", "results/plane@loading", "-o", "loaded.msh"], folder=self.folder)
        self.assertEqual(out.returncode, 0, out.stderr)
        mesh = {"type": "revolved", "geometry": "three-dimensional", "angle": 90.0, "layers": 4, "plane": {"type": "gmsh", "file": "loaded.msh"}}
        space = self.in_space(mesh, {"symmetry": "x y", "start": "y", "end": "x"})
        print(space.text if hasattr(space, "text") else "")
        for probe in ("centre", "below", "beside", "deep"):
            now = CubicSpline(space.time, space[f"probe/{probe}/pore pressure"])(TIMES)
            then = CubicSpline(plane.time, plane[f"probe/{probe}/pore pressure"])(20 + TIMES)
            print(probe, now, then)
            settled = CubicSpline(plane.time, plane[f"probe/{probe}/displacement y"])
            print(space.at(f"probe/{probe}/displacement z", TIMES), settled(20 + TIMES) - settled(20))


if __name__ == "__main__":
    unittest.main()
