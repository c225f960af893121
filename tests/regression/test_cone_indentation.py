"""The README's deck to its end: geostatic balance against the analytic K0 profile, then a cone whose force and face pressures are converged
(docs/benchmarks/cone_indentation.md)."""
import os
import unittest

import h5py
import numpy as np

from mudline_case import ROOT, SharedRun

DECK = os.path.join(ROOT, "inputs", "penetration", "cone_indentation.xml")

# the deck's soil
VOID_RATIO, GRAINS, WATER, GRAVITY, SURCHARGE, K0 = 1.3, 2700.0, 1000.0, 9.81, 20e3, 0.6


def centres(file, coordinates):
    """Mean of the corners of every cell (straight tri6 cells: XDMF type and six nodes)."""
    topology = file["mesh/topology"][:].reshape(-1, 7)
    return coordinates[topology[:, 1:4]].mean(axis=1)


class ConeIndentation(SharedRun):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.run_once([DECK])
        cls.file = h5py.File(os.path.join(cls.shared.folder, "results", "cone_indentation.h5"), "r")

    @classmethod
    def tearDownClass(cls):
        cls.file.close()
        super().tearDownClass()

    def test_geostatic_stresses_are_the_k0_profile(self):
        step = self.file["steps"][sorted(self.file["steps"])[1]]
        coordinates = step["coordinates"][:]
        self.assertLess(np.abs(coordinates - self.file["mesh/coordinates"][:]).max(), 1e-6)
        depth = -centres(self.file, coordinates)[:, 1]
        stress = step["cell/effective_stress"][:]
        porosity = VOID_RATIO / (1 + VOID_RATIO)
        vertical = SURCHARGE + (1 - porosity) * (GRAINS - WATER) * GRAVITY * depth
        # file order xx xy xz yy yz zz, tension positive
        np.testing.assert_allclose(-stress[:, 3], vertical, rtol=1e-3)
        np.testing.assert_allclose(-stress[:, 0], K0 * vertical, rtol=1e-3)
        np.testing.assert_allclose(-stress[:, 5], K0 * vertical, rtol=1e-3)
        self.assertLess(np.abs(stress[:, 1]).max(), 1e-3 * SURCHARGE)

    def test_resistance_grows_smoothly(self):
        depth = -self.history["body/cone/displacement y"]
        force = self.history["contact/cone face/reaction y"]
        deep = depth > 0.3 * depth.max()
        smooth = np.polyval(np.polyfit(depth[deep], force[deep], 3), depth[deep])
        self.assertLess(np.std(force[deep] - smooth) / smooth.mean(), 0.03)
        for at, converged in ((0.03, 312), (0.04, 347), (0.05, 375)):  # [m] [N]
            self.assertLess(abs(np.interp(at, depth, force) / converged - 1), 0.015, at)

    def test_face_pressures_are_converged(self):
        step = self.file["steps"][sorted(self.file["steps"])[-1]]
        radius = step["coordinates"][:, 0]
        touched = np.unique(self.file["mesh/topology"][:].reshape(-1, 7)[:, 1:4])  # corners have pore pressures of their own
        touched = touched[step["nodal/contact_pressure_cone_face"][:].ravel()[touched] > 0]
        touched = touched[np.argsort(radius[touched])]
        water = step["nodal/pore_pressure"][:].ravel()[touched]
        for at, converged in ((0.0, 48.5e3), (0.01, 48e3), (0.03, 41.2e3), (0.04, 37.6e3)):  # [m] [Pa]
            self.assertLess(abs(np.interp(at, radius[touched], water) / converged - 1), 0.06, at)
        self.assertGreater(water.min(), 10e3)
        self.assertLess(water.max(), 52e3)

    def test_mesh_stays_good(self):
        self.assertGreater(self.history["mesh/quality"].min(), 0.3)

    def test_pore_water_and_energy_balance(self):
        self.assertLess(np.abs(self.history["balance/water/error"]).max(), 1e-6)
        work = abs(self.history["balance/energy/contact/cone face"][-1])
        self.assertLess(abs(self.history["balance/energy/error"][-1]), 1e-5 * work)

    def test_free_surface_is_drained_and_the_face_is_not(self):
        step = self.file["steps"][sorted(self.file["steps"])[-1]]
        place = step["coordinates"][:]
        start = self.file["mesh/coordinates"][:]
        pressure = step["nodal/excess_pore_pressure"][:].ravel()
        surface = np.abs(start[:, 1]) < 1e-9
        water = step["nodal/pore_pressure"][:].ravel()  # the surface may heave: water at rest would have a pressure there
        self.assertLess(np.abs(water[surface & (start[:, 0] > 0.1)]).max(), 1e-6)
        below = (place[:, 0] < 0.03) & (place[:, 1] > -0.1) & (place[:, 1] < -0.06)
        far = (place[:, 0] > 0.3) | (place[:, 1] < -0.4)
        self.assertGreater(np.median(pressure[below]), 3e3)
        self.assertGreater(pressure[below].max(), 3 * np.abs(pressure[far]).max())

    def test_steps_are_easy(self):
        self.assertLessEqual(self.rejected, 0.02 * self.steps)
        self.assertLess(self.history["step/newton iterations"].mean(), 8)


if __name__ == "__main__":
    unittest.main()
