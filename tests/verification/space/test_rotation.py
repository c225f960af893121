"""A whole deck turned about a slanting axis, gravity and all, gives the turned answer: displacements, pressures, stresses, reactions."""
import unittest

import numpy as np
from scipy.spatial import cKDTree

from compared_case import problem
from space_case import SIDES, WATER, BoxMesh, SpaceCase, deck, quasi_static, rotation

EQUAL = 1e-9  # of the largest entry
TIGHT = {"residual tolerance": 1e-12, "update tolerance": 1e-10, "linear tolerance": 1e-12, "newton": {"maximum iterations": 30}}
UPPER = (1.5, 1.2, 1.0)
WET = {"porosity": 0.4, "fluid": WATER, "permeability": {"type": "constant", "hydraulic conductivity": 1e-5}}
LAWS = {
    "linear elastic": {"type": "linear elastic", "Young's modulus": 2e6, "Poisson's ratio": 0.25},
    "modified cam clay": {"type": "modified cam clay", "critical stress ratio": 1.0, "compression slope": 0.2, "swelling slope": 0.04,
                          "Poisson's ratio": 0.3},
    # the strength grows with depth, and depth is along gravity
    "tresca": {"type": "tresca", "undrained strength": 3e3, "undrained strength gradient": 2e3, "reference elevation": 1.0,
               "rigidity index": 200.0, "Poisson's ratio": 0.3},
    "mohr-coulomb": {"type": "mohr-coulomb", "Young's modulus": 2e6, "Poisson's ratio": 0.3, "cohesion": 1e3, "cohesion gradient": 500.0,
                     "reference elevation": 1.0, "friction angle [deg]": 15.0, "dilation angle [deg]": 5.0}}


def inside_moved(x):
    """Moves the nodes inside, and leaves the sides flat."""
    bubble = np.prod([np.sin(np.pi * x[:, i] / UPPER[i]) for i in range(3)], axis=0)
    return x + 0.08 * bubble[:, None] * np.cos(3 * x[:, [1, 2, 0]] + 0.4)


def vector(turn, *entries):
    """A constant vector of the deck as it stands, in the turned one."""
    return (turn @ np.array(entries, dtype=float)).tolist()


def field(turn, *formulas):
    """Formulas of the three components, of x, y, z as the deck stands, as components and places of the turned one."""
    place = {c: "(" + " + ".join(f"({turn[j, i]!r})*{d}" for j, d in enumerate("xyz")) + ")" for i, c in enumerate("xyz")}
    turned = ["(" + "".join(place.get(c, c) for c in formula) + ")" for formula in formulas]
    return {c: " + ".join(f"({turn[i, j]!r})*{turned[j]}" for j in range(3)) for i, c in enumerate("xyz")}


def ground(turn, mesh, law):
    """Layered by depth, under its weight and a surcharge; loaded through its surface at a slant, then shaken."""
    fixed = {side: {"type": "fixed", "set": side} for side in SIDES if side != "top"}
    conditions = {
        **fixed, "water": {"type": "hydrostatic pressure", "set": "top", "water level": 1.2, "unit weight": 9810.0},
        "surcharge": {"type": "pressure", "set": "top", "value": 4e3 + 0.2 * 9810.0},
        "load": {"type": "traction", "set": "top", **field(turn, "1e3*t*z", "400*t*x", "-3e4*t*y*(1.5 - x)")},
        "side": {"type": "absorbing", "set": "right"}}
    at_rest = [*fixed, "water", "surcharge"]
    return deck("ground", mesh, conditions, {
        "rest": {"type": "geostatic", "conditions": at_rest},
        "loading": {**quasi_static(1.0, 0.25), "conditions": [*at_rest, "load"]},
        "shaking": {"type": "dynamic", "duration": 0.03, "time step": {"initial": 0.01},
                    "conditions": [name for name in [*at_rest, "load", "side"] if name != "right"]}},
        "biot", {**WET, "skeleton": LAWS[law]},
        {"gravity": vector(turn, 0, 0, -9.81), "initial state": {
            "type": "geostatic", "water level": 1.2, "surcharge": 4e3, "K0": 0.7, **({"overconsolidation ratio": 1.2} if "clay" in law else {})}},
        solver=TIGHT)


def partners(places, others):
    """Of each place the number of the other one that is there; the program numbers by place."""
    distance, number = cKDTree(others).query(places)
    assert distance.max() < 1e-9 and len(set(number)) == len(places) == len(others)
    return number


@problem("consistency", title="A turned deck gives the turned answer")
class Rotation(SpaceCase):
    def compare_turned(self, cell, law):
        turn = rotation()
        runs = []
        for matrix in (np.eye(3), turn):
            file = BoxMesh(cell, (2, 2, 2), UPPER, inside_moved).turned(matrix).write(f"{self.folder}/box.msh")
            history = self.run_text("ground", ground(matrix, file, law))
            runs.append((history, self.fields("ground")))
        (still, was), (turned, now) = runs
        self.assertEqual(still.time.tolist(), turned.time.tolist())
        what = f"{cell}, {law}: "
        node = partners(was.nodes @ turn.T, now.nodes)
        for name in ("displacement", "velocity", "acceleration"):
            self.compare_values(what + name, now.nodal[name][node], was.nodal[name] @ turn.T, EQUAL,
                                np.abs(was.nodal[name]).max())
        self.compare_values(what + "pressure", now.nodal["pore_pressure"][node], was.nodal["pore_pressure"], EQUAL,
                            np.abs(was.nodal["pore_pressure"]).max())
        cell = partners(was.nodes[was.cells].mean(axis=1) @ turn.T, now.nodes[now.cells].mean(axis=1))
        tensor = [[0, 1, 2], [1, 3, 4], [2, 4, 5]]
        before = np.einsum("ik,ekl,jl->eij", turn, was.cell["effective_stress"][:, tensor], turn)
        self.compare_values(what + "stress", now.cell["effective_stress"][cell][:, tensor], before, EQUAL,
                            np.abs(before).max())
        forces = np.array([[[run[f"reaction/{side} {c}"] for c in "xyz"] for side in SIDES[:-1]] for run in (still, turned)])
        scale = np.abs(forces).max()
        self.assertGreater(scale, 1e3)
        self.compare_values(what + "reactions", forces[1], np.einsum("ij,sjt->sit", turn, forces[0]), EQUAL, scale)
        return was.cell

    def test_elastic(self):
        for cell in ("tet10", "hex27"):
            with self.subTest(cell=cell):
                self.compare_turned(cell, "linear elastic")

    def test_yielding(self):
        for cell, law in (("hex27", "modified cam clay"), ("tet10", "tresca"), ("tet10", "mohr-coulomb")):
            with self.subTest(cell=cell, law=law):
                cells = self.compare_turned(cell, law)
                name = next(name for name in cells if name.endswith("plastic_shear_strain"))
                self.assertGreater(np.mean(cells[name] > 1e-3), 0.1)


if __name__ == "__main__":
    unittest.main()
