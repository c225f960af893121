"""Filters of a body: the mean of a linear pore pressure over a part of an inclined wall, which is known in closed form."""
import unittest

import numpy as np

from compared_case import problem
from mudline_case import MudlineCase, deck_text

# soil outside of a cone, whose wall goes from (0.5, 0) to (1, 1); {sides} of them along it
SOIL = """Point(1) = {0.5, 0, 0}; Point(2) = {3, 0, 0}; Point(3) = {3, 1, 0}; Point(4) = {1, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Mesh.MeshSizeMax = 0.5; Transfinite Curve {4} = 8;
Physical Surface("soil") = {1};
Physical Curve("base") = {1}; Physical Curve("far") = {2}; Physical Curve("top") = {3}; Physical Curve("wall") = {4};
"""
AT_FOOT, GROWTH = 3e3, 2e3  # [Pa], [Pa/m] of the pore pressure at the wall
DOWN = 1e-6  # [m] by which the cone is pushed into the wall
# middle and height of each filter above the reference point, which is the height of the wall's foot
RINGS = {"inside a side": (0.5, 0.01), "over sides": (0.4, 0.37), "half in the air": (1.0, 0.2), "in the air": (1.3, 0.1)}


def deck(geometry, pressure):
    held = {name: {"type": "fixed", "set": name} for name in ("base", "far", "top")}
    return deck_text("filters", {
        "mesh": {"type": "gmsh", "file": "soil.geo", "geometry": geometry},
        "materials": {"soil": {"void ratio": 1.0, "skeleton": {"type": "linear elastic", "Young's modulus": 1e8, "Poisson's ratio": 0.2},
                               "fluid": {"type": "water"}, "permeability": {"type": "constant", "hydraulic conductivity": 1e-3}}},
        "physics": {"ground": {"type": "biot"}},
        "bodies": {"cone": {"position": [0.0, 0.0], "contour": {"type": "polyline", "x": [0.0, 1.25], "y": [-1.0, 1.5]},
                            "motion": {"type": "prescribed velocity", "velocity y": -DOWN}}},
        "boundary conditions": {**held, "water": {"type": "pore pressure", "set": "wall", "value": pressure}},
        "contacts": {"cone": {"type": "frictionless penalty", "body": "cone", "surface": "wall", "penalty": 1e10, "drainage": "drained"}},
        "stages": {"press": {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 1.0, "maximum": 1.0}}},
        "output": {"filters": {name: {"body": "cone", "position": middle, "height": height} for name, (middle, height) in RINGS.items()}}})


def mean(low, high, round_the_axis):
    """Of AT_FOOT + GROWTH y over the wall between two heights, whose radius is (1 + y)/2."""
    moment = np.polynomial.Polynomial([1, 1]) if round_the_axis else np.polynomial.Polynomial([1])
    area, sum_ = moment.integ(), (np.polynomial.Polynomial([AT_FOOT, GROWTH]) * moment).integ()
    return (sum_(high) - sum_(low)) / (area(high) - area(low))


@problem("exact", "mean of a linear pressure over a part of the wall", "Filters")
class Filters(MudlineCase):
    def setUp(self):
        super().setUp()
        self.write("soil.geo", SOIL)

    def push(self, geometry, pressure=f"{AT_FOOT} + {GROWTH}*y", ranks=1):
        return self.run_deck(self.write("filters.xml", deck(geometry, pressure)), ranks=ranks)

    def test_linear_pressure(self):
        for geometry, ranks in (("axisymmetric", 1), ("axisymmetric", 2), ("plane strain", 1)):
            history, round_the_axis = self.push(geometry, ranks=ranks), geometry == "axisymmetric"
            for name, (middle, height) in RINGS.items():
                low, high = middle - height / 2 - DOWN, min(middle + height / 2 - DOWN, 1.0)
                found = {quantity: history[f"filter/{name}/{quantity}"][-1]
                         for quantity in ("pore pressure", "excess pore pressure", "pore pressure error", "covered share")}
                with self.subTest(geometry=geometry, ranks=ranks, name=name):
                    if name == "in the air":
                        self.assertEqual(set(found.values()), {0.0})
                        continue
                    exact = mean(low, high, round_the_axis)
                    self.compare("mean", abs(found["pore pressure"] / exact - 1), 2e-6)
                    self.compare("excess", abs(found["excess pore pressure"] / exact - 1), 2e-6)
                    self.compare("estimated error", found["pore pressure error"] / exact, 2e-6)
                    share = (2 + low + high) / (2 + 2 * middle) if round_the_axis else 1.0
                    self.compare("share", abs(found["covered share"] - share * (high - low) / height), 2e-6)

    def test_ripple_shows_in_the_error(self):
        """A pressure that goes up and down from node to node, by 1 kPa to either side: seven sides of the wall."""
        history = self.push("axisymmetric", f"{AT_FOOT} + {GROWTH}*y + 1e3*cos(7*pi*y)")
        error = history["filter/over sides/pore pressure error"][-1]
        # the line through three vertices misses the middle one by four thirds of the ripple
        self.compare_values("error", error, 4e3 / 3, 0.05)


if __name__ == "__main__":
    unittest.main()
