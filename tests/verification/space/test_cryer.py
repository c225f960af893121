"""Cryer's sphere as an octant: the rise and fall of the pore pressure in its centre, and its radius."""
import unittest

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize_scalar

from references import biot
from space_case import SpaceCase

COMPRESSIBLE = ("materials/soil/Biot coefficient=0.9", "materials/soil/grain bulk modulus=66666666.666666667",
                "materials/soil/fluid/incompressible=false", "materials/soil/fluid/bulk modulus=2e7")
SOILS = {"incompressible": (biot.INCOMPRESSIBLE, (), (1.3075, 0.0494)), "compressible": (biot.COMPRESSIBLE, COMPRESSIBLE, (1.1172, 0.0455)),
         "Poisson's ratio 0.1": (biot.Soil(poisson=0.1), ("materials/soil/skeleton/Poisson's ratio=0.1",), None)}
TIMES = np.array([0.02, 0.05, 0.1])


STAGE = "stages/consolidation/"


class Cryer(SpaceCase):
    def peak(self, history, diffusivity):
        T = history.time * diffusivity
        p = CubicSpline(T, history["probe/centre/pore pressure"])
        found = minimize_scalar(lambda x: -p(x), bounds=(0.03, 0.08), method="bounded", options={"xatol": 1e-7})
        return np.array([-found.fun, found.x]), p

    def test_sphere(self):
        """The linear pressures' error falls with the square of the size of the cells: that of the finer mesh is within 0.8 %, and
        what two meshes show together, one of half the size of the other, within 0.2 %."""
        for name, (soil, settings, published) in SOILS.items():
            with self.subTest(soil=name):
                sphere = biot.Symmetric(3, soil, load=10.0)
                steps = (f"{STAGE}duration={0.105 / soil.diffusivity}", f"{STAGE}time step/growth=1.15",
                         f"{STAGE}time step/maximum={0.004 / soil.diffusivity}")
                peaks = []
                for cells, around in ((2, 3), (4, 6)):
                    history = self.run_deck(self.input("cryer"), settings + steps + (
                        f"mesh/parameters/cells={cells}", f"mesh/parameters/around={around}", f"mesh/parameters/ratio={0.7 if cells == 4 else 0.7 ** 0.8}"))
                    found, p = self.peak(history, soil.diffusivity)
                    peaks.append(found)
                exact = np.array(sphere.peak()[::-1])
                if published:
                    self.assert_near("the reference itself", exact / (10, 1), published, 1e-3)
                both = peaks[1] + (peaks[1] - peaks[0]) / 3
                self.assert_near(f"{name}: peak {peaks[1][0] / 10:.4f} of {exact[0] / 10:.4f}", peaks[1][0], exact[0], 8e-3)
                self.assert_near(f"peak of both {both[0] / 10:.4f}", both[0], exact[0], 2e-3)
                self.assert_near(f"time of the peak {peaks[1][1]:.4f} of {exact[1]:.4f}", peaks[1][1], exact[1], 4e-2)
                self.assert_near(f"time of both {both[1]:.4f}", both[1], exact[1], 1e-2)
                self.assert_near("p in the centre", p(TIMES), np.array([sphere.pressure(t) for t in TIMES]), 1e-2, exact[0])
                radius = np.array([sphere.radial_displacement(t) for t in TIMES])
                for probe, axis in (("surface", "x"), ("pole", "z")):
                    u = CubicSpline(history.time * soil.diffusivity, history[f"probe/{probe}/displacement {axis}"])(TIMES)
                    self.assert_near(f"radius along {axis}", u, radius, 5e-3)
                self.assertLess(np.abs(history["balance/water/error"]).max(), 1e-11)

    def test_tetrahedra(self):
        history = self.run_deck(self.input("cryer"), ("mesh/file=sphere_tetrahedra.geo", f"{STAGE}duration=60", f"{STAGE}time step/growth=1.2"))
        found, _ = self.peak(history, biot.INCOMPRESSIBLE.diffusivity)
        self.assert_near(f"peak {found[0] / 10:.4f}", found[0], 13.0754, 2e-2)


if __name__ == "__main__":
    unittest.main()
