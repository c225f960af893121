"""Permeability that depends on the direction: flow through a block whose directions are turned, consolidation in two
directions in closed form, and directions that turn with the soil."""
import unittest

import h5py
import numpy as np

from compared_case import problem
from mudline_case import MudlineCase, deck_text, program

CONDUCTIVITY, WEIGHT, POROSITY, BULK = 1e-6, 9810.0, 0.4, 1e7  # [m/s, N/m3, -, Pa]
WIDTH, HEIGHT = 2.0, 1.0  # [m]
RATIOS, ANGLE = (3.0, 0.5), 30.0  # [-, deg]


def soil(stiffness=1e14, **more):
    return {"porosity": POROSITY, "skeleton": {"type": "linear elastic", "Young's modulus": stiffness, "Poisson's ratio": 0.2},
            "fluid": {"type": "water", "bulk modulus": BULK, "unit weight": WEIGHT},
            "permeability": {"type": "constant", "hydraulic conductivity": CONDUCTIVITY}, **more}


def turned(ratios, rotation):
    return {"permeability ratios": list(ratios), "permeability rotation": list(rotation)}


def rotation_matrix(vector):
    """Rodrigues' formula; vector in degrees."""
    angle = np.deg2rad(np.linalg.norm(vector))
    x, y, z = np.asarray(vector) / np.linalg.norm(vector)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


@problem("exact", "Darcy's law with a turned tensor", "Anisotropic permeability")
class Directions(MudlineCase):
    def pressures(self, name):
        with h5py.File(f"{self.folder}/results/{name}.h5") as file:
            last = file["steps"][sorted(file["steps"])[-1]]
            return last["coordinates"][:], last["nodal/pore_pressure"][:].ravel()

    def check_flow(self, mesh, sides, size, material, mobility, tolerance=1e-8):
        """Pressures that are linear along each axis in turn, given on the two sides across it; on the other sides the discharge that
        belongs to them. sides: the pairs of sides along each axis."""
        gradient = 1e4
        for axis, pair in enumerate(sides):
            with self.subTest(axis=axis, cell=mesh["cell"]):
                flow = [float(-w * gradient) for w in mobility[:, axis]]
                conditions = {"held": {"type": "fixed", "set": sides[-1][0]}, "above": {"type": "fixed", "set": sides[-1][1]}}
                for side in pair:
                    conditions[side] = {"type": "pore pressure", "set": side, "value": f"{gradient}*{'xyz'[axis]}"}
                for other, (low, high) in enumerate(sides):
                    if other != axis:
                        conditions["out of " + low] = {"type": "flux", "set": low, "value": -flow[other]}
                        conditions["out of " + high] = {"type": "flux", "set": high, "value": flow[other]}
                deck = deck_text("block", {
                    "mesh": mesh, "materials": {"sand": material}, "physics": {"ground": {"type": "biot"}}, "boundary conditions": conditions,
                    "stages": {"flow": {"type": "quasi-static", "duration": 1e8, "time step": {"initial": 1e3, "growth": 10.0}}},
                    "solver": {"residual tolerance": 1e-11}, "output": {"field steps": 1000}})
                history = self.run_deck(self.write("block.xml", deck), extra=["--overwrite"])
                x, pressure = self.pressures("block")
                self.compare(f"{mesh['cell']}: pressure",
                             np.abs(pressure - gradient * x[:, axis])[np.abs(pressure) > 0].max() / (gradient
                                 * size.max()), tolerance)
                area = np.prod(size) / size[axis]
                self.compare(f"{mesh['cell']}: discharge",
                             abs(history[f"reaction/{pair[1]}"][-1] / (flow[axis] * area) + 1), 1e-6)

    def test_turned_block(self):
        for cell in ("quad9", "tri6"):
            turn = rotation_matrix((0, 0, ANGLE))
            mobility = (turn @ np.diag(RATIOS + (1.0,)) @ turn.T)[:2, :2] * CONDUCTIVITY / WEIGHT
            mesh = {"type": "box", "cell": cell, "cells": [4, 3], "upper": [WIDTH, HEIGHT], "distortion": 0.2}
            self.check_flow(mesh, (("left", "right"), ("bottom", "top")), np.array([WIDTH, HEIGHT]), soil(**turned(RATIOS, [ANGLE])), mobility)

    def test_turned_block_in_space(self):
        vector, ratios, size = (20.0, -35.0, 50.0), (2.0, 0.3, 0.05), np.array([1.0, 0.8, 1.2])
        turn = rotation_matrix(vector)
        mobility = turn @ np.diag(ratios) @ turn.T * CONDUCTIVITY / WEIGHT
        mesh = {"type": "box", "geometry": "three-dimensional", "cell": "tet10", "cells": [2, 2, 2], "upper": [float(v) for v in size]}
        self.check_flow(mesh, (("left", "right"), ("front", "back"), ("bottom", "top")), size, soil(**turned(ratios, vector)), mobility, 1e-7)

    @problem("exact", "product of two series")
    def test_consolidation_in_two_directions(self):
        """A pressure that is uniform at first leaves a rectangle through all of its sides: the product of two series."""
        diffusivity = CONDUCTIVITY * BULK / (WEIGHT * POROSITY)
        duration = 40.0
        deck = deck_text("rectangle", {
            "mesh": {"type": "box", "cell": "quad9", "cells": [16, 16], "upper": [WIDTH / 2, HEIGHT / 2], "grading": [0.2, 0.2]},
            "materials": {"sand": soil(**{"permeability ratios": list(RATIOS)})},
            "physics": {"ground": {"type": "biot", "initial state": {"type": "uniform", "pore pressure": 1e4}}},
            "boundary conditions": {
                "held": {"type": "fixed", "set": "bottom"}, "above": {"type": "fixed", "set": "top"},
                "right": {"type": "pore pressure", "set": "right", "value": 0.0}, "top": {"type": "pore pressure", "set": "top", "value": 0.0}},
            "stages": {"drain": {"type": "quasi-static", "duration": duration, "time step": {"initial": 0.01, "maximum": 0.2, "growth": 1.2}}},
            "output": {"field steps": 1000}})
        self.run_deck(self.write("rectangle.xml", deck))
        x, pressure = self.pressures("rectangle")

        def series(at, half, c):
            m = np.pi * (np.arange(200) + 0.5)
            return (2 * (-1.0) ** np.arange(200) / m * np.cos(m * at / half) * np.exp(-c * m ** 2 * duration / half ** 2)).sum()

        for place in ((0.0, 0.0), (0.5, 0.0), (0.0, 0.25)):
            inside = np.flatnonzero(pressure > 0)  # the corners of cells; others have no pressure of their own
            node = inside[np.argmin(np.hypot(x[inside, 0] - place[0], x[inside, 1] - place[1]))]
            at = x[node]
            exact = 1e4 * series(at[0], WIDTH / 2, RATIOS[0] * diffusivity) * series(at[1], HEIGHT / 2, RATIOS[1] * diffusivity)
            with self.subTest(place=tuple(at)):
                self.assertGreater(exact, 500)
                self.compare("pressure", abs(pressure[node] - exact) / 1e4, 0.005)

    def test_directions_turn_with_the_soil(self):
        """A block is turned by a quarter. Pressures are given by the initial position: the flow is that of the block as it was."""
        x = "x*(cos(a) - 1) - y*sin(a)".replace("a)", "1.5707963267948966*min(t, 1))")
        y = "x*sin(a) + y*(cos(a) - 1)".replace("a)", "1.5707963267948966*min(t, 1))")
        deck = deck_text("turned", {
            "mesh": {"type": "box", "cell": "quad9", "cells": [4, 4], "upper": [1.0, 1.0]},
            "materials": {"sand": soil(1e7, **{"permeability ratios": [1.0, 0.01]})},
            "physics": {"ground": {"type": "biot"}},
            "boundary conditions": {
                **{side: {"type": "displacement", "set": side, "x": x, "y": y} for side in ("left", "right", "bottom", "top")},
                "in": {"type": "pore pressure", "set": "left", "value": 1e3}, "out": {"type": "pore pressure", "set": "right", "value": 0.0}},
            "stages": {"turn": {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 0.05, "maximum": 0.05}},
                       "flow": {"type": "quasi-static", "duration": 1e6, "time step": {"initial": 10.0, "growth": 10.0}}},
            "output": {"field steps": 1000}})
        history = self.run_deck(self.write("turned.xml", deck))
        self.compare("discharge", abs(history["reaction/out"][-1] / (CONDUCTIVITY / WEIGHT * 1e3) + 1),
                     1e-6)  # it leaves

    @problem("behaviour")
    def test_refusals(self):
        base = {"mesh": {"type": "box", "cells": [2, 2], "upper": [1.0, 1.0]}, "physics": {"ground": {"type": "biot"}},
                "boundary conditions": {"held": {"type": "fixed", "set": "bottom"}},
                "stages": {"flow": {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 1.0}}}}
        for more, words in (({"permeability ratios": [1.0, 2.0, 3.0]}, "materials/sand/permeability ratios: expected 2 numbers, given 3"),
                            ({"permeability rotation": [30.0]}, "permeability rotation: without 'permeability ratios' there are no directions to turn"),
                            (turned(RATIOS, [1.0, 2.0]), "materials/sand/permeability rotation: expected 1 number, given 2")):
            with self.subTest(words=words):
                done = program(["check", self.write("wrong.xml", deck_text("wrong", {**base, "materials": {"sand": soil(**more)}}))], 1, self.folder)
                self.assertEqual(done.returncode, 2)
                self.assertIn(words, done.stderr)


if __name__ == "__main__":
    unittest.main()
