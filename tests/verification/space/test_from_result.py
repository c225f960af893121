"""An axisymmetric result becomes the initial state of a model in space, which then goes on as that run does."""

import os
import unittest

import h5py
import numpy as np
from scipy.interpolate import CubicSpline

from compared_case import problem
from mudline_case import ROOT, deck_text, program
from space_case import SpaceCase, quasi_static

LOAD = 12e3  # [Pa], ramped over 20 s
TIMES = np.array([200.0, 1e3, 5e3, 2e4, 1e5])  # [s] after the load
FAST = 5e-4  # [m/s] at which the pile is pushed
WATER = {"fluid": {"type": "water"}, "permeability": {"type": "constant", "hydraulic conductivity": 1e-8}}
GEOSTATIC = {"type": "geostatic", "surcharge": 10e3, "K0": 0.6, "overconsolidation ratio": 1.5}
REST = quasi_static(TIMES[-1], 20.0, 0.5, 4, growth=1.4, maximum=2e4)
PUSH = quasi_static(10.0, 1.0, 0.5, 4, growth=1.25, maximum=2.0)


def clay(slope, **more):
    return {
        "void ratio": 1.3,
        "grain density": 2700.0,
        **WATER,
        **more,
        "skeleton": {
            "type": "modified cam clay",
            "critical stress ratio": 1.0,
            "compression slope": slope,
            "swelling slope": 0.04,
            "Poisson's ratio": 0.3,
        },
    }


def model(name, up, mesh, initial, conditions, stages, materials=None, **sections):
    ground = {
        "type": "biot",
        "pore pressure": "excess",
        "gravity": [0.0, -9.81] if up == "y" else [0.0, 0.0, -9.81],
        "initial state": initial,
    }
    return deck_text(
        name,
        {
            "mesh": mesh,
            "materials": materials or {"clay": clay(0.2)},
            "physics": {"ground": ground},
            "boundary conditions": conditions,
            "stages": stages,
            **sections,
        },
    )


def fixed(sides):
    """`sides`: with the components that they hold."""
    return {side: {"type": "fixed", "set": side, "components": held} for side, held in sides.items()}


def turned(file, layers):
    return {
        "type": "revolved",
        "geometry": "three-dimensional",
        "angle": 90.0,
        "layers": layers,
        "plane": {"type": "gmsh", "file": file},
    }


QUARTER = {"start": "y", "end": "x"}


@problem("consistency", title="From an axisymmetric result, footing")
class Footing(SpaceCase):
    """A circular footing on two layers of clay, loaded beyond yield, which then consolidate."""

    PLANE = {
        "type": "gmsh",
        "file": os.path.join(ROOT, "inputs", "bearing_capacity", "footing.geo"),
        "parameters": {"cells": 3, "ratio": 6, "triangles": 0, "width": 4.0, "depth": 3.0},
    }
    BALANCE = {"type": "geostatic", "balance tolerance": 1e-3}

    def deck(self, name, up, mesh, initial, sides, stages, load):
        def place(r, height):
            there = [r, height] if up == "y" else [r * float(np.cos(np.pi / 4)), r * float(np.sin(np.pi / 4)), height]
            return {"point": there, "moves with": "nothing"}

        conditions = fixed(
            {**sides, "base": "x y" if up == "y" else "x y z", "far side": "x y" if up == "y" else "x y z"}
        )
        conditions.update(
            {
                "drained": {"type": "pore pressure", "set": "surface"},
                "drained footing": {"type": "pore pressure", "set": "footing"},
                "surcharge": {"type": "pressure", "set": "surface", "value": 10e3},
                "load": {"type": "pressure", "set": "footing", "value": load},
            }
        )
        probes = {
            "below": place(0.05, -1.0),
            "beside": place(1.2, -0.6),
            "deep": place(0.8, -2.0),
            "near": place(0.5, -0.3),
        }
        return model(
            name,
            up,
            mesh,
            initial,
            conditions,
            stages,
            {"deep clay": clay(0.15, top=-1.2), "clay": clay(0.2)},
            output={"probes": probes},
        )

    def plane(self):
        loading = quasi_static(20.0, 2.0, 0.5, 4, growth=1.25, maximum=5.0)
        return self.run_text(
            "plane",
            self.deck(
                "plane",
                "y",
                {"geometry": "axisymmetric", **self.PLANE},
                GEOSTATIC,
                {"symmetry": "x"},
                {"loading": loading, "rest": REST},
                f"10e3 + {LOAD}*min(t/20, 1)",
            ),
        )

    def in_space(self, stages, mesh=None, **initial):
        return self.deck(
            "space",
            "z",
            mesh or turned("loaded.msh", 4),
            {"type": "from result", "result": "results/plane@loading", **initial},
            {"symmetry": "x y", **QUARTER},
            stages,
            str(10e3 + LOAD),
        )

    def test_consolidation(self):
        plane = self.plane()
        done = program(["mesh", "results/plane@loading", "-o", "loaded.msh"], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        space = self.run_text("space", self.in_space({"balance": self.BALANCE, "rest": REST}))
        pressure = max(plane["probe/near/pore pressure"])
        settlement = abs(plane["probe/near/displacement y"][-1])
        for probe in ("below", "beside", "deep", "near"):
            of_plane = CubicSpline(plane.time, plane[f"probe/{probe}/pore pressure"])(20 + TIMES)
            self.compare_values(f"{probe}: pressure",
                                CubicSpline(space.time, space[f"probe/{probe}/pore pressure"])(TIMES), of_plane, 0.01,
                                pressure)
            moved = CubicSpline(plane.time, plane[f"probe/{probe}/displacement y"])
            self.compare_values(f"{probe}: settlement since the load",
                                CubicSpline(space.time, space[f"probe/{probe}/displacement z"])(TIMES),
                                moved(20 + TIMES) - moved(20), 0.01, settlement)
        # the excess counts from the plane run's start, not from the loaded state
        _, _, nodal, _ = self.plane_fields(-1)
        self.compare_values("highest excess at the end", self.fields("space").nodal["excess_pore_pressure"].max(),
                            nodal.max(), 0.01)
        self.check_start()

    def plane_fields(self, step):
        """Middles and stresses of the plane run's cells (quad9), excess pressures at nodes, void ratios of the cells."""
        with h5py.File(os.path.join(self.folder, "results", "plane.h5"), "r") as file:
            fields = file["steps"][sorted(file["steps"])[step]]
            cells = file["mesh/topology"][:].reshape(-1, 10)[:, 1:5]
            return (
                fields["coordinates"][:][cells].mean(axis=1)[:, :2],
                fields["cell/effective_stress"][:],
                fields["nodal/excess_pore_pressure"][:],
                fields["cell/void_ratio"][:],
            )

    def check_start(self):
        """Mean stresses of the hexahedra at the start are those of the plane cells, turned."""
        of_plane, stress, _, ratio = self.plane_fields(1)
        with h5py.File(os.path.join(self.folder, "results", "space.h5"), "r") as file:
            rows = np.split(file["mesh/topology"][:], file["mesh/offset"][1:])
            hexahedra = np.array([k for k, row in enumerate(rows) if row[0] == 50])
            middle = file["mesh/coordinates"][:][np.array([rows[k][1:9] for k in hexahedra])].mean(axis=1)
            start = file["steps"][sorted(file["steps"])[0]]
            turned, ratios = start["cell/effective_stress"][:][hexahedra], start["cell/void_ratio"][:][hexahedra]
        self.assertGreater(len(middle), 100)
        radius = np.hypot(middle[:, 0], middle[:, 1])
        away = np.hypot(
            radius[:, None] / np.cos(np.pi / 16) - of_plane[None, :, 0], middle[:, 2][:, None] - of_plane[None, :, 1]
        )
        found = away.argmin(axis=1)
        self.assertLess(away.min(axis=1).max(), 0.02)
        c, s = middle[:, 0] / radius, middle[:, 1] / radius
        rr, zz, tt, rz = (stress[found, k] for k in (0, 3, 5, 1))  # files have xx, xy, xz, yy, yz, zz
        expected = np.stack(
            [c * c * rr + s * s * tt, c * s * (rr - tt), c * rz, s * s * rr + c * c * tt, s * rz, zz], axis=1
        )
        # a cell's mean is over an angle of 22.5 degrees, in which the stress turns: 1 - sinc is 1 to 3 per cent
        self.compare("turned stresses of the start", np.abs(turned - expected).max() / np.abs(rr).max(), 0.03)
        self.compare("void ratios of the start", np.abs(ratios - ratio[found]).max(), 2e-3)

    def refused(self, message, old="", new="", mesh=None, **initial):
        text = self.in_space({"rest": REST}, mesh, **initial)
        self.assertIn(old, text)
        done = program(["check", self.write("wrong.xml", text.replace(old, new) if old else text)], folder=self.folder)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertIn(message, done.stderr)
        self.assertRegex(done.stderr, r"wrong\.xml:\d+: physics/ground/initial state")

    @problem("behaviour")
    def test_refusals(self):
        self.plane()
        box = {
            "type": "box",
            "geometry": "three-dimensional",
            "lower": [0.0, 0.0, -3.0],
            "upper": [2.0, 2.0, 0.0],
            "cells": [2, 2, 2],
        }
        text = self.in_space({"rest": REST}, box)
        sides = {
            "symmetry": "left",
            "start": "front",
            "end": "right",
            "base": "bottom",
            "far side": "back",
            "surface": "top",
            "footing": "top",
        }
        for side, name in sides.items():
            text = text.replace(f'name="set" type="string" value="{side}"', f'name="set" type="string" value="{name}"')
        self.in_space = lambda stages, mesh=None, **initial: (
            text.replace('value="results/plane@loading"', f'value="{initial["result"]}"')
            if "result" in initial
            else text
        )
        self.refused("have no end of a stage 'lading' (did you mean 'loading'?)", result="results/plane@lading")
        self.refused("there are no results 'results/plain'", result="results/plain@loading")
        self.refused("expected results and a stage, 'results/pile@push', given 'results/plane'", result="results/plane")
        self.refused(
            "the materials of the result are deep clay (modified cam clay), clay (modified cam clay); here they are",
            '"deep clay"',
            '"lower clay"',
        )
        self.refused("gravity is -9.81 m/s2 along y in the result, which becomes z", "-9.81", "-9.8")
        self.refused(
            "pore pressures of the result are in excess of water at rest",
            '"pore pressure" type="string" value="excess"',
            '"pore pressure" type="string" value="total"',
        )
        self.refused("the mesh reaches beyond the soil of the result", "-3.0}", "-6.0}")
        self.refused(
            "with 'type' = 'from result' the result gives it",
            '"result" type="string" value="results/plane@loading"/>',
            '"result" type="string" value="results/plane@loading"/><Parameter name="K0" type="double" value="1.0"/>',
        )
        self.refused(
            "needs the results and the stage", '<Parameter name="result" type="string" value="results/plane@loading"/>'
        )
        self.refused("has a meaning only with 'type' = 'from result'", 'value="from result"', 'value="stress free"')


@problem("consistency", title="From an axisymmetric result, wall of a pile")
class Wall(SpaceCase):
    """The shaft of a pile is pushed down along clay, which yields at the wall, and then pulled up."""

    PLANE = {"type": "box", "geometry": "axisymmetric", "lower": [0.5, -2.0], "upper": [4.0, 0.0], "cells": [8, 4]}

    def deck(self, name, up, mesh, initial, sides, stages, z):
        conditions = fixed(
            {**sides, "bottom": "x y" if up == "y" else "x y z", "right": "x y" if up == "y" else "x y z"}
        )
        conditions.update(
            {
                "drained": {"type": "pore pressure", "set": "top"},
                "surcharge": {"type": "pressure", "set": "top", "value": 10e3},
            }
        )
        contour = {"type": "flat pile", "diameter": 1.0, "corner radius": 0.05, "shaft length": 6.0}
        body = {
            **({} if z is None else {"position": [0.0, z] if up == "y" else [0.0, 0.0, z]}),
            "motion": {"type": "prescribed velocity", f"velocity {up}": 0.0},
            **({"contour": contour} if up == "y" else {"surface": {"type": "revolved", "contour": contour}}),
        }
        wall = {
            "type": "penalty",
            "body": "pile",
            "surface": "left",
            "penalty": 1e8,
            "initial gap": "in-situ stress",
            "closing distance": 0.05,
            "friction": {"type": "coulomb", "coefficient": 0.3, "tangential penalty factor": 0.1},
        }
        return model(name, up, mesh, initial, conditions, stages, bodies={"pile": body}, contacts={"wall": wall})

    @staticmethod
    def moving(up, speed):
        return {**PUSH, "motions": {"pile": {"type": "prescribed velocity", f"velocity {up}": speed}}}

    def in_space(self, z=None):
        # the clay beside the wall keeps the volume strain of the water from the end of the push: that is in balance again
        # after the next step only, which moves it by 1.7e-5 m
        balance = {"type": "geostatic", "contacts": ["wall"], "balance tolerance": 2e-5}
        return self.deck(
            "space",
            "z",
            turned("wall.msh", 3),
            {"type": "from result", "result": "results/wall@push"},
            QUARTER,
            {"balance": balance, "pull": self.moving("z", 2 * FAST)},
            z,
        )

    def test_friction_goes_on(self):
        start = {"type": "geostatic", "contacts": ["wall"], "balance tolerance": 1e-6}
        plane = self.run_text(
            "wall",
            self.deck(
                "wall",
                "y",
                self.PLANE,
                GEOSTATIC,
                {},
                {"start": start, "push": self.moving("y", -FAST), "pull": self.moving("y", 2 * FAST)},
                -4.0,
            ),
        )
        done = program(["mesh", "results/wall@push", "-o", "wall.msh"], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        space = self.run_text("space", self.in_space())
        pushed, pulled = plane.at("contact/wall/reaction y", 10.0), plane["contact/wall/reaction y"][-1]
        self.assertGreater(pushed, 1e4)
        self.assertLess(pulled, -1e4)
        self.compare_values("reaction at the start", 4 * space["contact/wall/reaction z"][0], pushed, 0.01)
        self.compare_values("pull-out", 4 * space["contact/wall/reaction z"][-1], pulled, 0.01)
        halves = self.run_text("halves", self.in_space(), ranks=2, settings=["stages/pull/duration=2"])
        self.compare_values("pull-out on two ranks", halves["contact/wall/reaction z"][:2],
                            space["contact/wall/reaction z"][:2], 1e-5, pulled)
        self.restart_without_result(space)
        done = program(["check", self.write("low.xml", self.in_space(-4.05))], folder=self.folder)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn(
            "the body stands at {0, 0, -4.005} m at the end of the result 'results/wall@push'; without a position it "
            "stands there here too",
            done.stderr,
        )

    def restart_without_result(self, space):
        """The body stays where it stood although the result is gone; the deck gives it no position."""
        deck = self.write("gone.xml", self.in_space())
        done = program(["run", deck, "--steps", "2"], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        result = os.path.join(self.folder, "results", "wall@push.restart")
        os.rename(result, result + ".away")
        done = program(["run", deck, "--restart", "--steps", "2"], folder=self.folder)
        os.rename(result + ".away", result)
        self.assertEqual(done.returncode, 0, done.stderr)
        reactions = self.history_of("gone")["contact/wall/reaction z"]
        self.assertEqual(list(reactions), list(space["contact/wall/reaction z"][: len(reactions)]))
        self.assertGreaterEqual(len(reactions), 4)


if __name__ == "__main__":
    unittest.main()
