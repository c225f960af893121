"""Orders in space and time, on solutions that are smooth: a point force outside the box (displacement alone), a pressure that grows
evenly while the soil takes up water (both fields), and runs with halved steps."""
import unittest

import numpy as np

from compared_case import problem
from references import biot
from space_case import ELASTIC, SATURATED, BoxMesh, SpaceCase, deck, prescribed, quasi_static

TIGHT = {"residual tolerance": 1e-10, "update tolerance": 1e-8, "linear tolerance": 1e-10}
SOIL = biot.INCOMPRESSIBLE
LAME = SOIL.oedometric - 2 * SOIL.shear
FORCE_AT = (-0.9, 0.4, 1.7)
RATES = {"x": 1.0, "y": 0.8, "z": 1.2}  # [1/m]
SQUARE = sum(k * k for k in RATES.values())
GROWTH = SOIL.diffusivity * SQUARE  # [1/s]
DURATION = 4 / GROWTH


def bent(x):
    """Moves all nodes, those of the sides too; finer meshes are bent alike."""
    return x + 0.06 * np.sin(3 * x[:, [1, 2, 0]] + 0.5) + 0.05 * np.cos(2 * x[:, [2, 0, 1]])


def kelvin():
    """Displacement around a point force along z (Kelvin), as formulas of the deck; 1e-6 of the distance."""
    away = dict(zip("xyz", (f"({c} - ({at!r}))" for c, at in zip("xyz", FORCE_AT))))
    r = "sqrt(" + " + ".join(f"{a}*{a}" for a in away.values()) + ")"
    poisson = ELASTIC["Poisson's ratio"]
    return {c: f"1e-6*({away[c]}*{away['z']}/{r}^3" + (f" + {3 - 4 * poisson!r}/{r})" if c == "z" else ")") for c in "xyz"}


def value(formula):
    """A formula of the deck as a function of places and time."""
    code = compile(formula.replace("^", "**"), "formula", "eval")
    names = {name: getattr(np, name) for name in ("sqrt", "sinh", "cosh", "exp")}
    return lambda x, y, z, t=0.0: eval(code, names, {"x": x, "y": y, "z": z, "t": t})


def swelling(*derivatives):
    """d^n/dx.. of phi = E exp(growth t) cosh(a x) cosh(b y) cosh(d z)/k^2, whose gradient is the displacement and whose Laplacian,
    the volume strain, spreads by diffusion: p = M times that."""
    formula = f"{1e-7 * np.exp(-4.0) / SQUARE!r}*exp({GROWTH!r}*t)"
    for c, rate in RATES.items():
        n = derivatives.count(c)
        formula += f"*{rate ** n!r}*{'sinh' if n % 2 else 'cosh'}({rate!r}*{c})"
    return formula


def swelling_conditions():
    """Symmetry at x, y, z = 0; displacement and pressure are given at x = 1, pressure and tractions at z = 1, displacement and flux at y = 1."""
    volume = f"{SQUARE!r}*{swelling()}"
    displacement = {c: swelling(c) for c in "xyz"}
    pressure = f"{SOIL.oedometric!r}*{volume}"
    conditions = {f"{c} = 0": {"type": "fixed", "set": side, "components": c} for c, side in zip("xyz", ("left", "front", "bottom"))}
    conditions.update(prescribed(displacement, ("right", "back")))
    conditions.update({f"pressure {side}": {"type": "pore pressure", "set": side, "value": pressure} for side in ("right", "top")})
    conditions["traction"] = {"type": "traction", "set": "top", "x": f"{2 * SOIL.shear!r}*{swelling('x', 'z')}",
                              "y": f"{2 * SOIL.shear!r}*{swelling('y', 'z')}", "z": f"{2 * SOIL.shear!r}*({swelling('z', 'z')} - {volume})"}
    conditions["flux"] = {"type": "flux", "set": "back", "value": f"{-SOIL.mobility * SOIL.oedometric * SQUARE!r}*{swelling('y')}"}
    return conditions, displacement, pressure


@problem("exact", "Kelvin's point force; a growing manufactured solution", "Orders in space and time, in space")
class Orders(SpaceCase):
    def test_displacement_in_space(self):
        formulas = kelvin()
        exact = [value(formulas[c]) for c in "xyz"]
        for cell in ("tet10", "hex27", "wedge15", "wedge18"):
            for kind, move, least in (("even", None, 2.9), ("bent", bent, 2.8)):
                with self.subTest(cell=cell, mesh=kind):
                    errors, middle = [], []
                    for n in (2, 4, 8):
                        mesh = BoxMesh(cell, (n, n, n), move=move).write(f"{self.folder}/box.msh")
                        self.run_text("force", deck("force", mesh, prescribed(formulas), {"pull": quasi_static(1.0, 1.0)}, solver=TIGHT))
                        found = self.fields("force")
                        errors.append(found.l2_error(found.nodal["displacement"], lambda *x: [f(*x) for f in exact]))
                        centre = np.argmin(np.linalg.norm(found.nodes - 0.5, axis=1))
                        middle.append(found.nodal["displacement"][centre, 2])
                    self.compare_orders(f"{cell}, {kind} mesh: u in space", errors, least, 9.0)
                    if kind == "even":
                        self.compare_meshes(f"{cell}: u_z in the middle", middle, exact[2](0.5, 0.5, 0.5), 3)

    def test_consolidation_in_space(self):
        """Second order for both fields, in step and mesh together: the linear pressure leads the displacement. The growing solution
        starts from a fiftieth, and what is wrong about that start drains away."""
        conditions, displacement, pressure = swelling_conditions()
        exact_u, exact_p = [value(displacement[c]) for c in "xyz"], value(pressure)
        for cell in ("tet10", "hex27", "wedge15", "wedge18"):
            with self.subTest(cell=cell):
                u, p = [], []
                for n in (2, 4):
                    mesh = BoxMesh(cell, (n, n, n)).write(f"{self.folder}/box.msh")
                    stage = quasi_static(DURATION, DURATION / (12 * n), 0.5, 2)
                    history = self.run_text("swelling", deck("swelling", mesh, conditions, {"swelling": stage}, "biot", solver=TIGHT))
                    self.assertEqual(len(history.time), 12 * n)
                    found = self.fields("swelling")
                    u.append(found.l2_error(found.nodal["displacement"], lambda *x: [f(*x, DURATION) for f in exact_u]))
                    p.append(found.l2_error(found.nodal["pore_pressure"], lambda *x: exact_p(*x, DURATION), linear=True))
                self.compare_orders(f"{cell}: u while water flows", u, 1.9, 9.0)
                self.compare_orders(f"{cell}: p", p, 1.9, 9.0)

    def block(self, stage):
        """A block that is pressed and sheared on top, more and more; drained there."""
        conditions = {"base": {"type": "fixed", "set": "bottom"}, "drained": {"type": "pore pressure", "set": "top"},
                      "load": {"type": "traction", "set": "top", "x": "2*y*sin(8*t)^4", "z": "-5*(1 + x)*sin(8*t)^4"}}
        water = {"type": "water", "bulk modulus": 5e7, "unit weight": 1e4}
        soil = {**SATURATED, "fluid": water, "permeability": {"type": "constant", "hydraulic conductivity": 1e-3}}
        box = {"type": "box", "cell": "hex27", "cells": [1, 2, 2], "upper": [0.6, 1.0, 1.0]}
        probes = {"top": [0.6, 1.0, 1.0], "inside": [0.6, 0.5, 0.5], "base": [0.0, 0.0, 0.0]}
        return deck("block", box, conditions, {"loading": stage}, "biot", soil, solver=TIGHT, output={"probes": probes})

    def assert_time_order(self, what, stage, counts, expected):
        """Of displacements and pressures at the probes, over 20 instants of the stage, in the mean square."""
        names = {"u": ("top/displacement x", "top/displacement z", "inside/displacement y"), "p": ("inside/pore pressure", "base/pore pressure")}
        runs = []
        for steps in counts:
            stage["time step"] = {"initial": stage["duration"] / steps}
            history = self.run_text("block", self.block(stage))
            self.assertEqual(len(history.time), steps)
            runs.append({field: np.array([history["probe/" + name][steps // 20 - 1::steps // 20] for name in names[field]]) for field in names})
        for field in names:
            self.compare_orders(f"{what}: {field} in time",
                                [np.linalg.norm(coarse[field] - fine[field]) for coarse, fine in zip(runs, runs[1:])],
                                expected - 0.15, expected + 0.15)

    @problem("consistency")
    def test_time(self):
        for theta, expected in ((1.0, 1), (0.5, 2)):
            with self.subTest(theta=theta):
                self.assert_time_order(f"theta {theta}", quasi_static(0.3, 0.01, theta), (20, 40, 80, 160), expected)
        for name, integrator in {"radius 0.8": {"type": "generalised alpha", "spectral radius": 0.8}, "newmark": {"type": "newmark"},
                                 "radius 0.5": {"type": "generalised alpha", "spectral radius": 0.5}}.items():
            with self.subTest(integrator=name):
                self.assert_time_order(name, {"type": "dynamic", "duration": 0.3, "integrator": integrator}, (80, 160, 320), 2)


if __name__ == "__main__":
    unittest.main()
