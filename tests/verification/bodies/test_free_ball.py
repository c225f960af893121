"""A free ball in contact with a rigid floor in space: it slides and then rolls, spins, and bounces obliquely. The floor is a bed of
springs (the penalty), so that forces and impacts have closed forms."""
import math
import unittest

import numpy as np
from compared_case import problem
from mudline_case import MudlineCase, deck_text

RADIUS, MASS, G, DEPTH = 0.5, 1000.0, 10.0, 6.25e-4  # m, kg, m/s2; m that its weight presses the ball in: the radius
# of what touches is a twentieth of the ball's, and normals tilt by as much
PENALTY = MASS * G / (math.pi * RADIUS * DEPTH**2)  # over the depth DEPTH - r^2 / (2 RADIUS), integrated
FRICTION = 0.2


@problem("exact", "rigid body with Coulomb's friction on a bed of springs", "Free ball on a rigid floor")
class FreeBall(MudlineCase):
    def ball(self, duration, step, start=0.0375, height=-DEPTH, gravity=True, friction=FRICTION, length=0.075,
             **motion):
        """The floor's nodes are all held. It is as wide as what touches, and a cell more on both sides."""
        cell, width = 0.0125, 0.075
        contact = {"type": "penalty", "body": "ball", "surface": "top", "penalty": PENALTY, "advance limit": 2.0}
        if friction > 0:
            contact["friction"] = {"type": "coulomb", "coefficient": friction, "on": "total"}
        return self.run_deck(self.write("ball.xml", deck_text("ball", {
            "mesh": {"type": "box", "geometry": "three-dimensional", "cell": "hex8", "upper": [length, width, 0.1],
                     "cells": [round(length / cell), round(width / cell), 1]},
            "materials": {"soil": {"porosity": 0.4, "skeleton": {"type": "linear elastic", "Young's modulus": 1e9, "Poisson's ratio": 0.3}}},
            "physics": {"ground": {"type": "solid"}},
            "bodies": {"ball": {"position": [start, width / 2, 0.1 + height], "mass": MASS,
                                "surface": {"type": "revolved", "contour": {"type": "sphere", "diameter": 2 * RADIUS}},
                                "motion": {"type": "free", "gravity": [0.0, 0.0, -G if gravity else 0.0], **motion}}},
            "boundary conditions": {name: {"type": "fixed", "set": name} for name in ("top", "bottom")},
            "contacts": {"floor": contact},
            "solver": {"residual tolerance": 1e-12, "update tolerance": 1e-12},
            "stages": {"way": {"type": "dynamic", "duration": duration,
                               "integrator": {"type": "generalised alpha", "spectral radius": 1.0},
                               "time step": {"initial": step, "maximum": step}}}})))

    def test_slides_then_rolls(self):
        """Sliding, the ball loses mu g of its speed and gains spin; from 2 v/(7 mu g) on it rolls with 5/7 of its speed."""
        speed = 2.0
        history = self.ball(0.36, 1e-3, start=0.05, length=0.7, **{"initial velocity": [speed, 0.0, 0.0]})
        t = history.time
        rolls = 2 * speed / (7 * FRICTION * G)
        velocity, spin = history["body/ball/velocity x"], history["body/ball/spin y"]
        centre = velocity + spin * RADIUS * np.cos(history["body/ball/rotation y"])  # that of the reference point turns around it
        sliding = t < 0.95 * rolls
        self.compare("speed while it slides", np.abs(centre - (speed - FRICTION * G * t))[sliding].max() / speed,
                     3e-3)
        self.compare("spin while it slides", np.abs(spin * RADIUS - 2.5 * FRICTION * G * t)[sliding].max() / speed,
                     3e-3)
        rolling = t > 1.1 * rolls
        self.compare("speed while it rolls", np.abs(centre[rolling] - 5 / 7 * speed).max() / speed, 3e-3)
        slip = (centre - spin * RADIUS)[rolling]  # swings about 0: the ball sticks to springs
        self.compare("slip while it rolls", np.abs(slip).max() / speed, 1e-2)
        self.compare("its mean", abs(slip.mean()) / speed, 1e-3)

    def test_spins(self):
        """Pressed by its weight, the ball that spins about the vertical is braked by 8/15 mu m g a, with the radius a of what touches."""
        touching = math.sqrt(2 * RADIUS * DEPTH)
        inertia = 0.4 * MASS * RADIUS**2
        braking = 8 / 15 * FRICTION * MASS * G * touching / inertia
        start = 1.0
        stops = start / braking
        history = self.ball(1.2 * stops, stops / 400, **{"initial spin": [0.0, 0.0, start]})
        spin = history["body/ball/spin z"]
        braked = history.time < 0.9 * stops
        self.compare("spin", np.abs(spin - (start - braking * history.time))[braked].max() / start, 1e-2)
        self.compare("spin at rest", np.abs(spin[history.time > 1.1 * stops]).max() / start, 2e-2)
        self.compare("way", np.abs(history["body/ball/displacement x"]).max(), 1e-6)

    def test_smooth_oblique_bounce(self):
        """Without friction the springs give back what they took, to rounding, and what lies along the floor stays."""
        velocity = [0.07, -0.04, -0.05]
        history = self.ball(0.06, 2.5e-4, gravity=False, friction=0, height=1e-4,
                            **{"initial velocity": velocity, "initial spin": [0.3, 0.1, 0.2]})
        kinetic = history["body/ball/kinetic energy"]
        self.assertEqual(history["contact/floor/active points"][-1], 0)
        self.assertGreater(history["contact/floor/active points"].max(), 20)
        self.compare("energy", abs(kinetic[-1] / kinetic[0] - 1), 1e-9)
        self.assertGreater(history["body/ball/velocity z"][-1], 0)
        spin = np.array([history[f"body/ball/spin {axis}"] for axis in "xyz"])
        self.compare("spin", np.abs(spin - [[0.3], [0.1], [0.2]]).max(), 1e-9)

    def test_gross_slip(self):
        """A flat oblique impact slides throughout: along the floor it loses mu times what the normal impulse is, 2 m v."""
        down, along = 0.03, 0.2
        history = self.ball(0.04, 1e-4, gravity=False, height=1e-4, **{"initial velocity": [along, 0.0, -down]})
        spin = history["body/ball/spin y"][-1]
        centre = history["body/ball/velocity x"][-1] + spin * RADIUS
        rise = history["body/ball/velocity z"][-1]
        self.assertEqual(history["contact/floor/active points"][-1], 0)
        lost = (along - centre) / (down + rise)
        self.compare("rebound", abs(rise / down - 1), 1e-2)
        self.compare("ratio of the impulses", abs(lost / FRICTION - 1), 1e-2)
        self.compare("spin", abs(spin * RADIUS / (2.5 * (along - centre)) - 1), 1e-2)


if __name__ == "__main__":
    unittest.main()
