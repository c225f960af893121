"""A smooth cone wished in place in saturated Modified Cam Clay and pushed on: a quarter in space against the same section in the
axisymmetric program. The ground is weightless under one stress, which the contact does not bear: it acts on the hole too."""
import unittest

from compared_case import problem
from mudline_case import deck_text
from space_case import SpaceCase

STRESS = 50e3
SECTION = """
Point(1) = {0, -2.5, 0, 0.5};
Point(2) = {2, -2.5, 0, 0.5};
Point(3) = {2, 0, 0, 0.5};
Point(4) = {0.2, 0, 0, 0.15};
Point(5) = {0.2, -0.8, 0, fine};
Point(6) = {0, -1, 0, fine};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1:6};
Plane Surface(1) = {1};
Physical Surface("clay") = {1};
Physical Curve("base") = {1};
Physical Curve("far") = {2};
Physical Curve("surface") = {3};
Physical Curve("hole") = {4, 5};
Physical Curve("axis") = {6};
"""


@problem("consistency", title="Cone in space against the axisymmetric program")
class Cone(SpaceCase):
    def history(self, space, conductivity, fine=0.05):
        up = "z" if space else "y"
        self.write("cone.geo", f"fine = {fine};\n" + SECTION)
        section = {"type": "gmsh", "file": "cone.geo"}
        mesh = {"type": "revolved", "geometry": "three-dimensional", "angle": 90.0, "layers": 4, "plane": section} if space else {
            **section, "geometry": "axisymmetric"}
        contour = {"type": "polyline", "extent": "half", "x": [0.0, 0.2, 0.2], "y": [0.0, 0.2, 2.0]}
        held = {"base": "x y" + " z" * space, "far": "x y" if space else "x", "axis": "x y" if space else "x"}
        if space:
            held.update(start="y", end="x")
        conditions = {name: {"type": "fixed", "set": name, "components": which} for name, which in held.items()}
        for name in ("surface", "hole"):
            conditions["load on " + name] = {"type": "pressure", "set": name, "value": STRESS}
            conditions["water at " + name] = {"type": "pore pressure", "set": name}
        return self.run_text("cone", deck_text("cone", {
            "mesh": mesh,
            "materials": {"clay": {
                "void ratio": 1.2,
                "skeleton": {"type": "modified cam clay", "critical stress ratio": 1.0, "compression slope": 0.1, "swelling slope": 0.02,
                             "Poisson's ratio": 0.3},
                "fluid": {"type": "water"}, "permeability": {"type": "constant", "hydraulic conductivity": conductivity}}},
            "physics": {"ground": {"type": "biot", "initial state": {
                "type": "uniform", "overconsolidation ratio": 2.0, **{f"effective stress {axes}": STRESS for axes in ("xx", "yy", "zz")}}}},
            "bodies": {"cone": {"position": [0.0] * (2 if space else 1) + [-1.0],
                                **({"surface": {"type": "revolved", "contour": contour}} if space else {"contour": contour}),
                                "motion": {"type": "prescribed displacement", up: "-0.005*t"}}},
            "boundary conditions": conditions,
            "contacts": {"face": {"type": "frictionless penalty", "body": "cone", "surface": "hole"}},
            "solver": {"linear solver": {"type": "direct"}},
            "stages": {"push": {"type": "quasi-static", "duration": 1.0,
                                "time step": {"initial": 0.25, "maximum": 0.25}}}}))

    def test_quarter(self):
        for name, conductivity in (("undrained", 1e-12), ("drained", 1.0)):
            flat, space = self.history(False, conductivity), self.history(True, conductivity)
            forces = flat["contact/face/reaction y"][-1], 4 * space["contact/face/reaction z"][-1]
            self.assertGreater(forces[0], 0.1 * STRESS * 0.04)
            self.compare_values(f"{name}: force", forces[1], forces[0], 0.03)


if __name__ == "__main__":
    unittest.main()
