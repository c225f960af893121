"""Cryer's sphere, an octant of it in hexahedra: the pressure in the centre rises above the load before it falls. Against the solution
in Laplace space; loads scaled by 1e-3."""
import unittest

import numpy as np
from scipy.interpolate import CubicSpline

from compared_case import problem
from references import biot
from space_case import SpaceCase

STAGE = "stages/consolidation/"
# small cells around the centre, where the peak is; steps with a time error of 0.07 % of it
FINE = ("mesh/parameters/cells=4", "mesh/parameters/around=10", "mesh/parameters/core=0.25", "mesh/parameters/ratio=1",
        f"{STAGE}time step/initial=0.5", f"{STAGE}time step/growth=1.2", f"{STAGE}time step/maximum=3",
        f"{STAGE}integrator/start-up steps=4", "solver/linear solver/type=direct")
# alpha = 0.9 and storage n/K_f + (alpha - n)/K_s = 2.75e-8 1/Pa at the deck's porosity of 0.4
COMPRESSIBLE = ("materials/soil/Biot coefficient=0.9", "materials/soil/grain bulk modulus=66666666.666666667",
                "materials/soil/fluid/incompressible=false", "materials/soil/fluid/bulk modulus=2e7")


@problem("exact", "Cryer (1963), in Laplace space", "Cryer's sphere in space")
class Cryer(SpaceCase):
    def test_peak(self):
        for name, soil, settings in (("incompressible", biot.INCOMPRESSIBLE, ()), ("compressible", biot.COMPRESSIBLE, COMPRESSIBLE)):
            with self.subTest(name):
                sphere = biot.Symmetric(3, soil, load=10.0)
                history = self.run_deck(self.input("cryer"), FINE + settings + (f"{STAGE}duration={0.068 / soil.diffusivity}",))
                fine = np.linspace(0.03, 0.066, 2000)
                p = CubicSpline(history.time, history["probe/centre/pore pressure"])(fine / soil.diffusivity)
                when, peak = sphere.peak()
                self.compare_values(f"{name}: peak", p.max(), peak, 5e-3)
                self.compare_values(f"{name}: time of the peak", fine[p.argmax()], when, 3e-2)  # the peak is flat
                T = np.array([0.02, 0.05])
                for probe, axis in (("surface", "x"), ("pole", "z")):
                    u = CubicSpline(history.time, history[f"probe/{probe}/displacement {axis}"])(T / soil.diffusivity)
                    self.compare_values(f"{name}: u {axis} of the surface", u,
                                        [sphere.radial_displacement(t) for t in T], 5e-3)
                self.assertLess(np.abs(history["balance/water/error"]).max(), 1e-12)


if __name__ == "__main__":
    unittest.main()
