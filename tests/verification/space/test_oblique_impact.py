"""Oblique impact of a rigid ball on an elastic half-space with Coulomb friction (Maw, Barber and Fawcett 1976): the local angle of rebound over that
of incidence through all regimes: sticking at first, sliding at both ends, sliding throughout. Half of the space, in ten-node tetrahedra; nearly
incompressible and light, so that pressures do not move what lies along the surface (Dundurs' second constant is 0.01), and no wave carries energy away."""
import unittest

from references.oblique_impact import rebound, regimes
from space_case import SpaceCase, deck

YOUNG, POISSON, FRICTION, MASS, RADIUS, DEPTH = 1e7, 0.49, 0.2, 1000.0, 1.0, 0.01  # DEPTH [m] of the deepest point: contact radius 0.1 m
SPEED = (16 / 15 * YOUNG / (1 - POISSON ** 2) * RADIUS ** 0.5 * DEPTH ** 2.5 / MASS) ** 0.5
DURATION = 2.9432 * DEPTH / SPEED  # of Hertz's impact
FACTOR = 2 * (1 - POISSON) / (FRICTION * (2 - POISSON))
GEOMETRY = '''SetFactory("Built-in");
w = 2.5;
Point(1) = {-w, 0, 0}; Point(2) = {w, 0, 0}; Point(3) = {w, w, 0}; Point(4) = {-w, w, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
out[] = Extrude {0, 0, -w} { Surface{1}; };
Field[1] = MathEval;
Field[1].F = "0.035 + 0.5*Max(Sqrt(x^2 + y^2 + z^2) - 0.11, 0)";
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Physical Volume("soil") = {out[1]};
Physical Surface("surface") = {1};
Physical Surface("symmetry") = {out[2]};
Physical Surface("far side") = {out[0], out[3], out[4], out[5]};
'''


class ObliqueImpact(SpaceCase):
    def impact(self, incidence, steps=30):
        """(psi_2, normal speed of rebound over that of the approach); forces and mass are those of the half."""
        self.write("half_space.geo", GEOMETRY)
        along = incidence / FACTOR * SPEED
        history = self.run_text("ball", deck(
            "ball", "half_space.geo",
            {"far side": {"type": "fixed", "set": "far side"}, "symmetry": {"type": "fixed", "set": "symmetry", "components": "y"}},
            {"impact": {"type": "dynamic", "duration": 1.15 * DURATION, "integrator": {"type": "generalised alpha", "spectral radius": 1.0},
                        "time step": {"initial": DURATION / steps, "maximum": DURATION / steps}}},
            material={"density": 1.0, "skeleton": {"type": "linear elastic", "Young's modulus": YOUNG, "Poisson's ratio": POISSON}},
            bodies={"ball": {"position": [0.0, 0.0, 0.0], "mass": MASS / 2,
                             "inertia tensor": [0.2 * MASS * RADIUS ** 2] * 3 + [0.0] * 3, "centre of mass": [0.0, 0.0, RADIUS],
                             "surface": {"type": "revolved", "contour": {"type": "sphere", "diameter": 2 * RADIUS}},
                             "motion": {"type": "free", "freedom": ["x", "z", "rotation y"], "initial velocity": [along, 0.0, -SPEED]}}},
            contacts={"face": {"type": "penalty", "body": "ball", "surface": "surface", "penalty": 1.5e10, "advance limit": 10.0,
                               "friction": {"type": "coulomb", "coefficient": FRICTION, "on": "total"}}},
            solver={"residual tolerance": 1e-5, "update tolerance": 1e-3, "linear solver": {"type": "direct"}}), timeout=120)
        self.assertEqual(history["contact/face/active points"][-1], 0)
        # the velocity is that of the reference point, the ball's lowest one
        return FACTOR * history["body/ball/velocity x"][-1] / SPEED, history["body/ball/velocity z"][-1] / SPEED

    def test_regimes(self):
        sticks, slides, _ = regimes(POISSON)
        for incidence in (0.5, 1.8, 3.0, 4.5):
            self.assertNotEqual(incidence in (1.8, 3.0), incidence < sticks or incidence > slides)
            found, rise = self.impact(incidence)
            self.assert_near(f"psi_1 {incidence}: psi_2", found, rebound(incidence, POISSON, springs=200, steps=2000)[0], 0.1, 1.0)
            self.assert_near(f"psi_1 {incidence}: normal rebound", rise, 1.0, 0.03)


if __name__ == "__main__":
    unittest.main()
