"""A circular load on a layer that consolidates, as a revolved quarter in space and as today's axisymmetric model on the same plane mesh."""
import os
import unittest

import numpy as np
from scipy.interpolate import CubicSpline

from compared_case import problem
from mudline_case import ROOT, deck_text
from space_case import SATURATED, SpaceCase, quasi_static

def section(triangles):
    """The plane mesh: of triangles, or of quadrilaterals, which become hexahedra and at the axis wedges."""
    return {"type": "gmsh", "file": os.path.join(ROOT, "inputs", "bearing_capacity", "footing.geo"),
            "parameters": {"cells": 3, "ratio": 6, "triangles": triangles, "width": 4.0, "depth": 3.0}}


LOAD = 10.0  # [Pa], ramped over 20 s
DURATION = 4000.0  # [s], c_v t/a^2 = 4.8
TIMES = np.array([20.0, 100.0, 400.0, 1500.0, 4000.0])


def model(name, mesh, up, sides):
    """`sides`: of the axis and of planes of symmetry, with the components that they hold."""
    def place(r, height):
        return [r, height] if up == "y" else [r, 0.0, height]

    conditions = {side: {"type": "fixed", "set": side, "components": held} for side, held in sides.items()}
    conditions.update({"base": {"type": "fixed", "set": "base"}, "far side": {"type": "fixed", "set": "far side"},
                       "drained": {"type": "pore pressure", "set": "surface"}, "drained footing": {"type": "pore pressure", "set": "footing"},
                       "load": {"type": "traction", "set": "footing", up: f"t < 20 ? -{LOAD}*t/20 : -{LOAD}".replace("<", "&lt;")}})
    probes = {"centre": place(0.0, 0.0), "edge": place(1.0, 0.0), "below": place(0.0, -1.0), "beside": place(1.0, -1.0)}
    return deck_text(name, {
        "mesh": mesh, "materials": {"soil": SATURATED}, "physics": {"ground": {"type": "biot"}}, "boundary conditions": conditions,
        "stages": {"loading": quasi_static(DURATION, 5.0, 0.5, 4, growth=1.25, maximum=400.0)}, "output": {"probes": probes}})


@problem("consistency", title="Circular load in space against axial symmetry")
class Revolved(SpaceCase):
    def test_circular_load(self):
        self.check("triangles", section(1))

    def test_circular_load_on_quadrilaterals(self):
        self.check("quadrilaterals", section(0))

    def check(self, cells, section):
        plane = self.run_text("plane", model("plane", {"geometry": "axisymmetric", **section}, "y", {"symmetry": "x"}))
        mesh = {"type": "revolved", "geometry": "three-dimensional", "angle": 90.0, "layers": 5, "plane": section}
        space = self.run_text("space", model("space", mesh, "z", {"symmetry": "x y", "start": "y", "end": "x"}))
        settlement = CubicSpline(plane.time, plane["probe/centre/displacement y"])(DURATION)

        def both(of_plane, of_space):
            return CubicSpline(space.time, space[of_space])(TIMES), CubicSpline(plane.time, plane[of_plane])(TIMES)

        for probe in ("centre", "edge", "below", "beside"):
            self.compare_values(f"{cells}, {probe}: settlement",
                                *both(f"probe/{probe}/displacement y", f"probe/{probe}/displacement z"), 5e-3,
                                settlement)
            self.compare_values(f"{cells}, {probe}: radial",
                                *both(f"probe/{probe}/displacement x", f"probe/{probe}/displacement x"), 5e-3,
                                settlement)
        for probe in ("below", "beside"):
            self.compare_values(f"{cells}, {probe}: pressure",
                                *both(f"probe/{probe}/pore pressure", f"probe/{probe}/pore pressure"), 5e-3, LOAD)
        found, expected = both("reaction/base y", "reaction/base z")
        self.compare_values(f"{cells}, reaction of the base", 4 * found, expected, 5e-3)


if __name__ == "__main__":
    unittest.main()
