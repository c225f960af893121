"""A free rigid sphere hits an elastic half space obliquely: the regimes of Maw, Barber and Fawcett."""
import unittest

import numpy as np

from compared_case import problem
from mudline_case import MudlineCase, deck_text
from references import oblique_impact as maw

POISSON = 0.49  # nearly incompressible: pressure moves the surface hardly along itself, as the theory has it
SHEAR, RADIUS, SPEED, FRICTION = 1e6, 1.0, 0.1, 0.1  # Pa, m, m/s
TOUCHING = 0.05  # largest radius of what touches [m]
APPROACH = TOUCHING**2 / RADIUS
STEPS = 20  # of an impact
PENALTY = 100 * SHEAR / TOUCHING  # is compressed by 2 % of the approach


@problem("benchmark", "Maw, Barber and Fawcett (1976), integrated in references/oblique_impact.py",
         "Oblique impact of a sphere")
class ObliqueImpact(MudlineCase):
    """Half of a revolved box of ten radii of the touching area, so light that it follows without waves. Radius 0 takes all
    forces at the end of a step: with the mean of both ends, what has no mass swings."""

    def hit(self, psi):
        """History of psi over the time in largest approaches over the speed, and the speed of the rebound over that before."""
        mass = float(maw.mass_for(APPROACH, SPEED, RADIUS, SHEAR, POISSON))
        step = maw.DURATION * APPROACH / SPEED / STEPS
        size = 10 * TOUCHING
        section = {"type": "box", "cell": "tri6", "cells": [8, 7], "lower": [0.0, -size], "upper": [size, 0.0], "grading": [20.0, 0.05]}
        planes = {name: {"type": "fixed", "set": name, "components": "y"} for name in ("start", "end", "left")}
        history = self.run_deck(self.write("hit.xml", deck_text("hit", {
            "mesh": {"type": "revolved", "geometry": "three-dimensional", "angle": 180.0, "layers": 5, "plane": section},
            "materials": {"soil": {"density": 1.0, "skeleton": {
                "type": "linear elastic", "Young's modulus": 2 * SHEAR * (1 + POISSON), "Poisson's ratio": POISSON}}},
            "physics": {"ground": {"type": "solid"}},
            "bodies": {"ball": {"position": [0.0, 0.0, 0.02 * APPROACH], "mass": mass / 2,
                                "surface": {"type": "revolved", "contour": {"type": "sphere", "diameter": 2 * RADIUS}},
                                "motion": {"type": "free", "freedom": ["x", "z", "rotation y"], "gravity": [0.0, 0.0, 0.0],
                                           "initial velocity": [psi * FRICTION * SPEED / maw.kappa(POISSON), 0.0, -SPEED]}}},
            "boundary conditions": {"base": {"type": "fixed", "set": "bottom"}, "far": {"type": "fixed", "set": "right"}, **planes},
            "contacts": {"face": {"type": "penalty", "body": "ball", "surface": "top", "penalty": PENALTY, "impact": "interpolated",
                                  "advance limit": 5.0, "friction": {"type": "coulomb", "coefficient": FRICTION, "on": "total"}}},
            "solver": {"linear solver": {"type": "direct"}},
            "stages": {"impact": {"type": "dynamic", "duration": 1.25 * STEPS * step,
                                  "integrator": {"type": "generalised alpha", "spectral radius": 0.0},
                                  "time step": {"initial": step, "maximum": step}}}})))
        self.assertEqual(history["contact/face/active points"][-1], 0)
        self.assertGreater(history["contact/face/active points"].max(), 100)
        time = history.time * SPEED / APPROACH - 0.02
        return time, maw.kappa(POISSON) * history["body/ball/velocity x"] / (FRICTION * SPEED), history["body/ball/velocity z"][-1] / SPEED

    def check(self, psi):
        """Within a fiftieth of the largest change of psi there can be, 2 x 3.5 kappa."""
        time, found, rebound = self.hit(psi)
        expected_time, expected = maw.impact(psi, POISSON)
        self.compare("rebound", abs(rebound - 1), 0.02)
        self.compare("psi behind the impact", abs(found[-1] - expected[-1]),
                     0.02 * 2 * maw.SLOWNESS * maw.kappa(POISSON))
        # the block is stiffer than a half space, and the impact shorter by 2 or 3 %
        self.compare("its history", np.abs(found - np.interp(time, expected_time, expected)).max(),
                     0.07 * 2 * maw.SLOWNESS * maw.kappa(POISSON))

    def test_sticks_first(self):
        self.check(1.0)

    def test_slips_sticks_and_slips(self):
        self.check(2.5)

    @problem("exact", "gross slip: the tangential impulse is mu times the normal one")
    def test_slips_throughout(self):
        psi = 5.0
        self.check(psi)
        self.compare("psi of gross slip", abs(maw.impact(psi, POISSON)[1][-1] - maw.gross_slip(psi, POISSON)), 0.01)


if __name__ == "__main__":
    unittest.main()
