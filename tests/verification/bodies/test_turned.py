"""Bodies that are turned at the start are the bodies that are drawn turned; moments of contacts balance what acts beside them."""
import copy
import os
import re
import unittest

import numpy as np
from compared_case import problem
from mudline_case import History, MudlineCase, deck_text, program
from references import rigid_body as reference

SOIL = {"density": 1800.0, "skeleton": {"type": "linear elastic", "Young's modulus": 2e7, "Poisson's ratio": 0.2}}
SOLVER = {"residual tolerance": 1e-11, "update tolerance": 1e-11, "linear solver": {"type": "direct"}}


def space(body, stage, contact=None):
    return {"mesh": {"type": "box", "geometry": "three-dimensional", "cell": "hex8", "cells": [6, 6, 3], "lower": [-0.9, -0.9, -0.6], "upper": [0.9, 0.9, 0.0]},
            "materials": {"soil": copy.deepcopy(SOIL)}, "physics": {"soil": {"type": "solid"}}, "bodies": {"block": body},
            "boundary conditions": {"base": {"type": "fixed", "set": "bottom"}},
            "contacts": {"touch": {"type": "penalty", "body": "block", "surface": "top", "penalty": 2e8, "quadrature degree": 3, **(contact or {})}},
            "stages": {"move": stage}, "solver": dict(SOLVER)}


def plane(body, stage):
    return {"mesh": {"type": "box", "geometry": "plane strain", "cell": "quad9", "cells": [12, 4], "lower": [-1.2, -0.6], "upper": [1.2, 0.0]},
            "materials": {"soil": copy.deepcopy(SOIL)}, "physics": {"soil": {"type": "solid"}}, "bodies": {"block": body},
            "boundary conditions": {"base": {"type": "fixed", "set": "bottom"}},
            "contacts": {"touch": {"type": "penalty", "body": "block", "surface": "top", "penalty": 2e8}},
            "stages": {"move": stage}, "solver": dict(SOLVER)}


FALL = {"type": "dynamic", "duration": 0.02, "time step": {"initial": 1e-3, "maximum": 1e-3}}
FRICTION = {"friction": {"type": "coulomb", "coefficient": 0.3, "on": "total"}}


class BodyCase(MudlineCase):
    def run_one(self, name, deck, settings=(), extra=()):
        return self.run_deck(self.write(f"{name}.xml", deck_text(name, deck)), settings, extra=extra, name=name)

    def same(self, one, other, what, tolerance):
        """All columns of bodies and contacts, as vectors: components that only rounding gives are measured by the others."""
        self.assertEqual(one.header, other.header)
        groups = {}
        for name in one.columns:
            if name.startswith(("body/", "contact/")) and " reaction" not in name:  # tip and shaft are told apart in the body's frame
                groups.setdefault(name[:-2] if name[-2:] in (" x", " y", " z") else name, []).append(name)
        for group, names in groups.items():
            a, b = (np.stack([run[name] for name in names]) for run in (one, other))
            size = max(np.abs(a).max(), np.abs(b).max())
            if size > 0:
                self.compare(f"{what}: {group}", np.abs(a - b).max() / size, tolerance)


@problem("consistency", title="Bodies turned at the start")
class Turned(BodyCase):
    def test_a_quarter_turn_in_space(self):
        """A block that hits the ground on an edge: turned by 90 degrees about x, or drawn so, with its mass off the centre and the
        products of inertia that belong to it."""
        free = {"type": "free", "initial velocity": [0.3, 0.1, -1.0], "initial spin": [0.5, 2.0, 1.0]}
        body = {"position": [0.0, 0.0, 0.26], "mass": 80.0}
        # y of the turned body is z, its z is -y
        turned = dict(body, **{"rotation": [90.0, 0.0, 0.0], "centre of mass": [0.05, 0.03, -0.02],
                               "inertia tensor": [3.0, 5.0, 6.0, 0.4, 0.2, -0.3], "motion": free,
                               "surface": {"type": "box", "length x": 0.8, "length y": 0.5, "length z": 0.3, "fillet radius": 0.05}})
        drawn = dict(body, **{"centre of mass": [0.05, 0.02, 0.03],
                              "inertia tensor": [3.0, 6.0, 5.0, -0.4, -0.3, -0.2], "motion": free,
                              "surface": {"type": "box", "length x": 0.8, "length y": 0.3, "length z": 0.5, "fillet radius": 0.05}})
        one, other = (self.run_one(name, space(of, FALL, FRICTION)) for name, of in (("turned", turned), ("drawn", drawn)))
        self.assertGreater(one["contact/touch/reaction z"].max(), 1e3)
        self.same(one, other, "space", 1e-6)

    def test_any_turn_in_space(self):
        """The rotation of the body against that of its shape: one vector in degrees."""
        vector = [20.0, -35.0, 50.0]
        free = {"type": "free", "initial velocity": [0.0, 0.0, -1.0]}
        box = {"type": "box", "length x": 0.8, "length y": 0.5, "length z": 0.3, "fillet radius": 0.05}
        body = {"position": [0.0, 0.0, 0.36], "mass": 80.0, "motion": free}
        turned = self.run_one("turned", space(dict(body, rotation=vector, surface=box), FALL, FRICTION))
        drawn = self.run_one("drawn", space(dict(body, surface=dict(box, rotation=vector)), FALL, FRICTION))
        self.assertGreater(turned["contact/touch/reaction z"].max(), 1e3)
        self.same(turned, drawn, "space", 1e-6)

    def test_in_the_plane(self):
        """A plate that falls on its edge, its weight off the centre."""
        free = {"type": "free", "freedom": ["x", "y", "rotation"], "initial velocity": [0.2, -1.0]}
        body = {"position": [0.1, 0.01], "mass": 300.0, "moment of inertia": 12.0, "motion": free}

        def corners(x, y):
            return {"type": "polyline", "extent": "full", "x": x + x[:1], "y": y + y[:1]}

        turned = dict(body, **{"rotation": [90.0], "centre of mass": [0.1, -0.15], "contour": corners([0.0, 0.6, 0.6, 0.0], [-0.3, -0.3, 0.0, 0.0])})
        drawn = dict(body, **{"centre of mass": [0.15, 0.1], "contour": corners([0.3, 0.3, 0.0, 0.0], [0.0, 0.6, 0.6, 0.0])})
        one, other = (self.run_one(name, plane(of, FALL)) for name, of in (("turned", turned), ("drawn", drawn)))
        self.assertGreater(one["contact/touch/reaction y"].max(), 1e3)
        self.assertGreater(np.abs(one["body/block/rotation"]).max(), 1e-3)
        self.same(one, other, "plane", 1e-6)

    @problem("exact", "the spin times the time")
    def test_restart(self):
        """Bit for bit, of a body that is turned at the start and spins; the rotation counts from the start."""
        free = {"type": "free", "gravity": [0.0, 0.0, 0.0], "initial spin": [1.0, -2.0, 0.5]}
        body = {"position": [0.0, 0.0, 20.0], "mass": 80.0, "rotation": [20.0, -35.0, 50.0], "motion": free,
                "surface": {"type": "box", "length x": 0.8, "length y": 0.5, "length z": 0.3}}
        path = self.write("spins.xml", deck_text("spins", space(body, FALL)))
        whole = self.run_deck(path)
        data = open(os.path.join(self.folder, "results", "spins.csv")).read()
        turned = np.stack([whole[f"body/block/rotation {axis}"] for axis in "xyz"], axis=1)
        self.compare("rotation",
                     np.abs(turned - np.outer(whole.time, [1.0, -2.0, 0.5])).max() / (np.abs(turned).max()), 0.1)
        for arguments in (["--steps", 7, "--overwrite"], ["--restart"]):
            done = program(["run", "-q", path, *arguments], folder=self.folder)
            self.assertIn(done.returncode, (0, 4), done.stderr)
        self.assertEqual(open(os.path.join(self.folder, "results", "spins.csv")).read(), data)


@problem("exact", "shadow of the block", "Width of turned bodies")
class Widths(BodyCase):
    """Half the width of a body is that of its shadow along the direction in which it is pressed."""

    def share_told(self, body, deck_of, **changes):
        """Penetration and its share of the half width in the first warning of a run."""
        stage = {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 0.25, "maximum": 0.25}}
        deck = deck_of({**body, "motion": {"type": "prescribed velocity", **changes}}, stage)
        deck["contacts"]["touch"]["penalty"] = 5e6
        deck["plausibility"] = {f"penetration of {what}": [0.0, 1e9] for what in ("way", "side")}
        done = program(["run", self.write("pressed.xml", deck_text("pressed", deck))], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        told = re.search(r"its penetration, (\S+) (m|mm) at t .* over the body's half width is (\S+)[,;]", done.stderr)
        self.assertIsNotNone(told, done.stderr)
        return float(told[1]) * {"m": 1, "mm": 1e-3}[told[2]], float(told[3])

    def test_lying_tilted_and_standing(self):
        beam = {"type": "box", "length x": 1.2, "length y": 0.2, "length z": 0.2, "fillet radius": 0.02}
        down = {"velocity z": -0.06}
        for name, body in (("lying", {"position": [0.0, 0.0, 0.1], "surface": beam}),
                           ("turned", {"position": [0.0, 0.0, 0.1], "rotation": [0.0, 0.0, 30.0], "surface": beam}),
                           ("standing", {"position": [0.0, 0.0, 0.6], "rotation": [0.0, 90.0, 0.0], "surface": beam})):
            depth, share = self.share_told(body, space, **down)
            self.compare(f"{name}: share of the half width", abs(share / (depth / 0.1) - 1), 0.03)

    def test_in_the_plane(self):
        """A plate that stands on its edge is as wide as it is thick."""
        strip = {"type": "strip", "extent": "full", "width": 1.0, "thickness": 0.3, "corner radius": 0.02}
        for rotation, height, half in (([0.0], 0.0, 0.5), ([90.0], 0.5, 0.15)):
            body = {"position": [0.0, height], "rotation": rotation, "contour": strip}
            depth, share = self.share_told(body, plane, **{"velocity y": -0.3 * half})
            self.compare(f"{rotation}: share of the half width", abs(share / (depth / half) - 1), 0.03)


@problem("exact", "equilibrium of moments", "Moments of contacts")
class Moments(BodyCase):
    PRESS = {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 0.25}}

    def test_in_space(self):
        """A block that a force presses off its centre: the ground's moment about the reference point, and its force, balance it."""
        point, force = np.array([0.08, -0.05, 0.4]), np.array([0.0, 0.0, -2e4])
        motion = {"type": "force", "freedom": ["z", "rotation x", "rotation y"],
                  "loads": {"push": {"point": [float(v) for v in point], "force z": "-2e4*t"}}}
        body = {"position": [0.0, 0.0, 0.0], "centre of mass": [0.1, 0.03, 0.2], "mass": 10.0, "motion": motion,
                "inertia tensor": [1.0, 1.0, 1.0],
                "surface": {"type": "box", "length x": 0.9, "length y": 0.9, "length z": 0.4, "fillet radius": 0.02, "position": [0.0, 0.0, 0.2]}}
        history = self.run_one("press", space(body, self.PRESS))

        def last(what):
            return np.array([history[f"{what} {axis}"][-1] for axis in "xyz"])

        reaction, moment = last("contact/touch/reaction"), last("contact/touch/moment")
        turn = reference.turns_of(last("body/block/rotation")[None])[0]
        # what holds the other directions acts at the centre of mass
        held = np.array([history[f"body/block/driving force {axis}"][-1] for axis in "xyz"])
        expected = -np.cross(turn @ point, force) - np.cross(turn @ np.array(body["centre of mass"]), held)
        self.compare("force", abs(reaction[2] + force[2]) / 2e4, 1e-6)
        # about z nothing is balanced: the body does not turn there
        self.compare("moment", np.abs(moment - expected)[:2].max() / (np.abs(expected).max()), 1e-6)
        self.assertEqual(history.units["contact/touch/moment x"], "N m")

    def test_in_the_plane(self):
        """Counter-clockwise: a force to the right of the reference point makes the ground press there, and turn the body in that direction."""
        motion = {"type": "force", "freedom": ["y", "rotation"], "loads": {"push": {"point": [0.1, 0.3], "force y": "-3e4*t"}}}
        body = {"position": [0.0, 0.0], "centre of mass": [-0.05, 0.1], "mass": 10.0, "moment of inertia": 1.0, "motion": motion,
                "contour": {"type": "strip", "extent": "full", "width": 1.0, "thickness": 0.3, "corner radius": 0.02}}
        history = self.run_one("press", plane(body, self.PRESS))
        angle = history["body/block/rotation"][-1]
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        arm, centre = turn @ [0.1, 0.3], turn @ [-0.05, 0.1]
        held = history["body/block/driving force x"][-1]  # at the centre of mass
        self.assertLess(angle, 0)
        self.compare("moment", abs(history["contact/touch/moment"][-1] - 3e4 * arm[0] - held * centre[1]) / 3e3, 1e-6)

    @problem("behaviour")
    def test_half_a_body_has_none(self):
        motion = {"type": "prescribed velocity", "velocity y": -0.01}
        body = {"position": [-1.2, 0.0], "motion": motion, "contour": {"type": "strip", "width": 1.0, "thickness": 0.3, "corner radius": 0.02}}
        history = self.run_one("half", plane(body, self.PRESS))
        self.assertFalse([name for name in history.columns if "moment" in name.split("/")[-1] and name.startswith("contact/")])


if __name__ == "__main__":
    unittest.main()
