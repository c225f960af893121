"""Patch tests on distorted meshes: a linear displacement given on the sides holds inside, with its uniform stress; so do an even
flow of water, and the soil that such a flow compresses."""
import unittest

import numpy as np

from compared_case import problem
from space_case import SATURATED, SIDES, SOLID, BoxMesh, SpaceCase, deck, prescribed, quasi_static

GRADIENT = 1e-5 * np.array([[1.0, 0.4, -0.3], [-0.2, -0.7, 0.5], [0.6, 0.1, 0.45]])
TIGHT = {"residual tolerance": 1e-12, "update tolerance": 1e-10, "linear tolerance": 1e-12}
SHEAR, LAME = 4e6, 4e6  # of E = 10 MPa, nu = 0.25
UPPER = (1.0, 0.8, 1.2)
PAIRS = [("solid", cell) for cell in ("tet4", "hex8", "tet10", "hex27", "wedge6", "wedge15", "wedge18")] + [
    ("biot", cell) for cell in ("tet10", "hex27", "wedge15", "wedge18")]
GEO = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1.0, 0.8, 1.2};
MeshSize{:} = 0.45;
Physical Volume("soil") = {1};
Physical Surface("left") = {1};
Physical Surface("right") = {2};
Physical Surface("front") = {3};
Physical Surface("back") = {4};
Physical Surface("bottom") = {5};
Physical Surface("top") = {6};
"""
MIXED = """// hexahedra at low x, prisms of 18 nodes at high x, with common sides
Point(1) = {0, 0, 0}; Point(2) = {0.5, 0, 0}; Point(3) = {1, 0, 0}; Point(4) = {1, 0.8, 0}; Point(5) = {0.5, 0.8, 0}; Point(6) = {0, 0.8, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1}; Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6}; Plane Surface(1) = {1};
Curve Loop(2) = {2, 3, 4, -7}; Plane Surface(2) = {2};
MeshSize{:} = 0.4;
Transfinite Curve{1, 5} = 2; Transfinite Curve{6, 7} = 3; Transfinite Surface{1}; Recombine Surface{1};
block[] = Extrude {0, 0, 1.2} { Surface{1, 2}; Layers{2}; Recombine; };
Physical Volume("soil") = {block[1], block[7]};
Physical Surface("left") = {block[5]};
Physical Surface("right") = {block[9]};
Physical Surface("front") = {block[2], block[8]};
Physical Surface("back") = {block[4], block[10]};
Physical Surface("bottom") = {1, 2};
Physical Surface("top") = {block[0], block[6]};
"""


def bent(x):
    """Moves all nodes, those of the sides too."""
    return x + 0.06 * np.sin(3 * x[:, [1, 2, 0]] + 0.5) + 0.05 * np.cos(2 * x[:, [2, 0, 1]])


def linear(gradient):
    return {axis: f"{row[0]!r}*x + {row[1]!r}*y + {row[2]!r}*z" for axis, row in zip("xyz", gradient.tolist())}


@problem("exact", "linear fields, and p = a.x with its displacement", "Patch tests in space")
class Patch(SpaceCase):
    def meshes(self, cell):
        yield "box", {"type": "box", "cell": cell, "cells": [3, 2, 3], "upper": list(UPPER), "distortion": 0.3}
        file = BoxMesh(cell, (3, 2, 2), UPPER, bent).write(f"{self.folder}/{cell}.msh")
        yield "file", {"type": "gmsh", "file": file, "order": 1 if cell in ("tet4", "hex8", "wedge6") else 2}
        if cell == "hex27":  # the quadrature of curved tetrahedra is not exact
            yield "curved", BoxMesh(cell, (3, 2, 2), UPPER, bent, curved=True).write(f"{self.folder}/curved.msh")
        if cell == "wedge18":
            yield "mixed", {"type": "gmsh", "file": self.write("mixed.geo", MIXED)}
        if cell.startswith("tet"):
            yield "gmsh", {"type": "gmsh", "file": self.write("box.geo", GEO), "order": 2 if cell == "tet10" else 1}

    def test_linear_displacement(self):
        strain = (GRADIENT + GRADIENT.T) / 2
        stress = LAME * np.trace(strain) * np.eye(3) + 2 * SHEAR * strain
        for physics, cell in PAIRS:
            for kind, mesh in self.meshes(cell):
                with self.subTest(physics=physics, cell=cell, mesh=kind):
                    conditions = prescribed(linear(GRADIENT))
                    if physics == "biot":  # drained on all sides, so that the pressure has gone after a long step
                        conditions.update({f"drained {side}": {"type": "pore pressure", "set": side} for side in SIDES})
                    self.run_text("patch", deck("patch", mesh, conditions, {"pull": quasi_static(1e12, 1e12)}, physics, solver=TIGHT))
                    found = self.fields("patch")
                    inner = ~np.isclose(found.nodes[:, :, None], 0.0).any(axis=(1, 2))
                    self.assertGreater(inner.sum(), 0)
                    exact = found.nodes @ GRADIENT.T
                    self.compare_values(f"{physics} {cell} {kind}: u", found.nodal["displacement"], exact, 1e-10,
                                        np.abs(exact).max())
                    values = found.cell["effective_stress"]
                    self.compare_values("stress is uniform", values, values[0], 1e-9, np.abs(stress).max())
                    self.compare_values("stress", values, stress[np.triu_indices(3)], 1e-4, np.abs(stress).max())
                    if physics == "biot":
                        self.compare_values("p", found.nodal["pore_pressure"], 0.0, 1e-9, np.abs(stress).max())

    def test_even_flow(self):
        """Pressures linear in space, given on two sides, and the flow that belongs to them on the others; soil too stiff to move."""
        slope, mobility = np.array([900.0, -400.0, 650.0]), 1e-10
        stiff = dict(SATURATED, skeleton={"type": "linear elastic", "Young's modulus": 1e20, "Poisson's ratio": 0.25})
        for cell in ("tet10", "hex27", "wedge15", "wedge18", "mixed"):
            box = {"type": "box", "cell": cell, "cells": [3, 2, 3], "upper": list(UPPER), "distortion": 0.3}
            if cell == "mixed":
                box = {"type": "gmsh", "file": self.write("mixed.geo", MIXED)}
            with self.subTest(cell=cell):
                pressure = "1000 + 900*x - 400*y + 650*z"
                conditions = prescribed({axis: 0.0 for axis in "xyz"})
                conditions.update({f"pressure {side}": {"type": "pore pressure", "set": side, "value": pressure} for side in ("left", "right")})
                for side, normal in (("top", (0, 0, 1)), ("front", (0, -1, 0)), ("back", (0, 1, 0)), ("bottom", (0, 0, -1))):
                    conditions[f"flow {side}"] = {"type": "flux", "set": side, "value": float(-mobility * slope @ normal)}
                history = self.run_text("flow", deck("flow", box, conditions, {"flow": quasi_static(1e12, 1e12)}, "biot", stiff, solver=TIGHT))
                found = self.fields("flow")
                exact = 1000 + found.nodes @ slope
                self.compare_values(f"{cell}: p", found.nodal["pore_pressure"], exact, 1e-10, np.abs(exact).max())
                through = mobility * slope[0] * UPPER[1] * UPPER[2]
                for side, sign in (("left", -1), ("right", 1)):  # what is supplied to keep the pressure
                    self.compare_values("discharge", history[f"reaction/pressure {side}"][-1], sign * through, 1e-8)

    def test_soil_compressed_by_a_flow(self):
        """p = a.x, and with it u = a (a.x)^2 / (2 M a.a), which a quadratic cell with straight sides holds exactly."""
        slope, modulus = np.array([9.0, -4.0, 6.5]), 12e6
        factor = 1 / (2 * modulus * slope @ slope)
        along = "(9*x - 4*y + 6.5*z)"
        for cell in ("tet10", "hex27", "wedge18"):
            for kind, mesh in self.meshes(cell):
                if kind == "curved":
                    continue
                with self.subTest(cell=cell, mesh=kind):
                    conditions = prescribed({axis: f"{a * factor!r}*{along}*{along}" for axis, a in zip("xyz", slope.tolist())})
                    conditions.update({f"pressure {side}": {"type": "pore pressure", "set": side, "value": along} for side in SIDES})
                    exact = {"quadrature degree": 6} if cell == "wedge18" else {}  # nine points are not where sides are twisted
                    self.run_text("seepage", deck("seepage", mesh, conditions, {"flow": quasi_static(1e12, 1e12)}, "biot", None, exact, solver=TIGHT))
                    found = self.fields("seepage")
                    p = found.nodes @ slope
                    u = factor * slope * (p ** 2)[:, None]
                    # strains are 1e-6, and so large is what the small-strain solution leaves out
                    self.compare_values(f"{cell} {kind}: u", found.nodal["displacement"], u, 2e-6, np.abs(u).max())
                    self.compare_values(f"{cell} {kind}: p", found.nodal["pore_pressure"], p, 2e-6, np.abs(p).max())


if __name__ == "__main__":
    unittest.main()
