"""Quadrilaterals of 8 nodes and hexahedra of 20 are made complete when a file is read: their geometry stays, and they are as good as
cells of 9 and 27 nodes."""
import os
import unittest

import h5py
import numpy as np

from compared_case import problem
from grid_file import SIDES, SIDES_IN_SPACE, Grid
from mudline_case import MudlineCase, deck_text, program

YOUNG, POISSON, DENSITY, GRAVITY = 1e7, 0.3, 1800.0, 10.0
SOIL = {"density": DENSITY, "skeleton": {"type": "linear elastic", "Young's modulus": YOUNG, "Poisson's ratio": POISSON}}
SATURATED = {"porosity": 0.4, "skeleton": SOIL["skeleton"], "fluid": {"type": "water", "incompressible": True, "unit weight": 1e4},
             "permeability": {"type": "constant", "hydraulic conductivity": 1e-6}}
TIGHT = {"residual tolerance": 1e-12, "update tolerance": 1e-10, "linear tolerance": 1e-12}
AXES = {2: "xy", 3: "xyz"}
CELLS = {8: (4, 3), 20: (3, 2, 2)}


def bent(x):
    """Moves all places, those on the sides too."""
    turned = np.roll(x, 1, axis=1)
    return x + 0.05 * np.sin(3 * turned + 0.5) + 0.03 * np.cos(2 * x)


def moved_inside(x):
    """Moves what is not on the sides of a box of 2 x 1 (x 1)."""
    inside = np.sin(np.pi * x / np.array([2.0, 1.0, 1.0])[:x.shape[1]]).prod(axis=1, keepdims=True)
    return x + inside * np.array([0.09, 0.08, -0.07])[:x.shape[1]]


@problem("exact", "uniform strain, pure bending, weight", "Cells of 8 and 20 nodes")
class IncompleteCells(MudlineCase):
    def deck(self, grid, conditions, physics=None, **mesh):
        path = grid.write(os.path.join(self.folder, "mesh.msh"))
        physics = {"type": "solid", **(physics or {})}
        return deck_text("case", {
            "mesh": {"type": "gmsh", "geometry": "plane strain" if grid.dim == 2 else "three-dimensional", "file": path, **mesh},
            "materials": {"soil": SATURATED if physics["type"] == "biot" else SOIL},
            "physics": {"ground": physics},
            "boundary conditions": conditions,
            "stages": {"pull": {"type": "quasi-static", "duration": 1e12, "time step": {"initial": 1e12},
                                "integrator": {"type": "theta", "theta": 1.0, "start-up steps": 0}}},
            "solver": TIGHT})

    def run_grid(self, grid, conditions, physics=None, **mesh):
        self.history = self.run_deck(self.write("case.xml", self.deck(grid, conditions, physics, **mesh)))
        with h5py.File(os.path.join(self.folder, "results", "case.h5"), "r") as file:
            last = file["steps"][sorted(file["steps"])[-1]]
            self.places = file["mesh/coordinates"][:][:, :grid.dim]
            self.displacement = last["nodal/displacement"][:][:, :grid.dim]
            self.stress = last["cell/effective_stress"][:]

    def test_uniform_strain_on_curved_cells(self):
        gradient = 1e-5 * np.array([[1.0, 0.4, -0.3], [-0.2, -0.7, 0.5], [0.6, 0.1, 0.45]])
        for nodes, physics in ((8, "solid"), (8, "biot"), (20, "solid"), (20, "biot")):
            with self.subTest(nodes=nodes, physics=physics):
                grid = Grid(nodes, CELLS[nodes], move=bent, curved=True)
                slope = gradient[:grid.dim, :grid.dim]
                linear = {a: " + ".join(f"{v!r}*{b}" for v, b in zip(row, AXES[grid.dim])) for a, row in zip(AXES[grid.dim], slope.tolist())}
                sides = SIDES if grid.dim == 2 else SIDES_IN_SPACE
                conditions = {f"hold {side}": {"type": "displacement", "set": side, **linear} for side in sides}
                if physics == "biot":
                    conditions.update({f"drained {side}": {"type": "pore pressure", "set": side} for side in sides})
                self.run_grid(grid, conditions, {"type": physics})
                self.assertEqual(len(self.places), np.prod(2 * np.array(CELLS[nodes]) + 1))
                exact = self.places @ slope.T
                self.compare_values("displacement", self.displacement, exact, 1e-10, np.abs(exact).max())
                self.compare_values("uniform stress", self.stress, self.stress[0], 1e-9, np.abs(self.stress).max())

    def test_bending_is_exact_on_distorted_cells(self):
        """Pure bending: quadratic displacements, which cells of 8 and 20 nodes hold on parallelograms only."""
        curvature = 1e-6
        for nodes in (8, 20):
            with self.subTest(nodes=nodes):
                grid = Grid(nodes, CELLS[nodes], upper=(2.0, 1.0, 1.0)[:len(CELLS[nodes])], move=moved_inside)
                if grid.dim == 2:
                    modulus, ratio = YOUNG / (1 - POISSON ** 2), POISSON / (1 - POISSON)
                    exact = {"x": "k*x*(y - 0.5)", "y": f"-0.5*k*(x*x + {ratio!r}*(y - 0.5)*(y - 0.5))"}
                    pull = "m*(y - 0.5)"
                else:
                    modulus, ratio = YOUNG, POISSON
                    exact = {"x": "k*x*(z - 0.5)", "y": f"-{ratio!r}*k*(y - 0.5)*(z - 0.5)",
                             "z": f"-0.5*k*(x*x + {ratio!r}*((z - 0.5)*(z - 0.5) - (y - 0.5)*(y - 0.5)))"}
                    pull = "m*(z - 0.5)"
                given = {axis: text.replace("k", repr(curvature)) for axis, text in exact.items()}
                self.run_grid(grid, {"hold": {"type": "displacement", "set": "left", **given},
                                     "pull": {"type": "traction", "set": "right", "x": pull.replace("m", repr(modulus * curvature))}})
                x = dict(zip(AXES[grid.dim], self.places.T), k=curvature)
                true = np.stack([eval(text, {}, x) for text in exact.values()], axis=1)  # noqa: S307
                self.compare_values("displacement", self.displacement, true, 1e-5, np.abs(true).max())

    def test_weight_of_curved_cells(self):
        for nodes in (8, 20):
            with self.subTest(nodes=nodes):
                grid = Grid(nodes, CELLS[nodes], move=bent, curved=True)
                up = AXES[grid.dim][-1]
                gravity = [0.0] * (grid.dim - 1) + [-GRAVITY]
                self.run_grid(grid, {"base": {"type": "fixed", "set": "bottom"}}, {"gravity": gravity})
                weight = DENSITY * GRAVITY * grid.volume()
                self.compare_values("weight", self.history[f"reaction/base {up}"][-1], weight, 1e-9, weight)

    @problem("behaviour")
    def test_it_is_told_in_one_line(self):
        for nodes, told in ((8, "mesh: 12 quadrilaterals of 8 nodes in 'mesh.msh' made complete by nodes in the centre; "),
                            (20, "mesh: 12 hexahedra of 20 nodes in 'mesh.msh' made complete by nodes in the centre and the faces; ")):
            conditions = {"base": {"type": "fixed", "set": "bottom"}}
            path = self.write("case.xml", self.deck(Grid(nodes, CELLS[nodes]), conditions))
            ended = program(["check", path], folder=self.folder)
            self.assertEqual(ended.returncode, 0, ended.stderr)
            self.assertEqual(sum(line.startswith(told) for line in ended.stdout.splitlines()), 1, ended.stdout)
            path = self.write("case.xml", self.deck(Grid(nodes, CELLS[nodes]), conditions, order=1))
            ended = program(["check", path], folder=self.folder)
            self.assertEqual(ended.returncode, 2)
            self.assertIn("which are of order 2, but 'order' is 1", ended.stderr)


if __name__ == "__main__":
    unittest.main()
