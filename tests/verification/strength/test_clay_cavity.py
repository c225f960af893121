"""Expansion of a cylindrical cavity in Modified Cam Clay against the exact similarity solution, and that solution against others."""
import unittest

import h5py
import numpy as np

from cavity_case import DRAINED, KPA, CavityCase, clay
from compared_case import ComparedCase, problem
from references.cam_clay import CamClay
from references.cavity import Drained, MohrCoulombRates, Undrained, yu_houlsby

START = "physics/ground/initial state/"


@problem("exact", "Yu and Houlsby (1991); quadrature", "The cavity references against others")
class References(ComparedCase):
    """The solutions against others that do not share their equations."""

    def test_undrained_sphere_is_a_triaxial_test(self):
        """Every particle is compressed along the radius: axial strain 2 ln(stretch)."""
        for ocr in (1.0, 2.0, 5.0):
            solution = Undrained(clay((100.0, 100.0, 100.0), ocr), 2, 4.0)
            for stretch in (1.001, 1.004, 1.02, 1.1):
                p, q = CamClay(ocr=ocr).undrained(2 * np.log(stretch))
                stress = solution.at(stretch)[0]
                self.compare_values("mean and deviatoric stress", (stress.sum() / 3, stress[0] - stress[1]), (p, q),
                                    1e-6)

    def test_undrained_pressure_by_quadrature(self):
        """Equilibrium of total stress, integrated over the present radius."""
        for k in (1, 2):
            solution = Undrained(clay((100.0, 100.0, 160.0 if k == 1 else 100.0), 1.5), k, 2.0, far=50.0)
            x = np.linspace(0, np.log(1e4), 4001)  # ln(r/a)
            stretches = solution.stretch(2 * np.exp(x), 2.0, 1.0)
            stresses = [solution.at(stretch)[0] for stretch in stretches]
            difference = np.array([stress[0] - stress[1] for stress in stresses])
            self.compare("pressure by quadrature [kPa]", abs(150 + k * np.trapz(difference, x) - solution.at(2.0)[1]),
                         1e-2)

    def test_yu_and_houlsby(self):
        """Small strain outside the plastic zone: the difference falls with the stiffness."""
        for k, E, tolerance in ((1, 1e4, 1e-5), (1, 1e5, 1e-7), (2, 1e4, 4e-4), (2, 1e5, 4e-5)):
            solution = Drained(MohrCoulombRates(E, 0.3, 5.0, 30.0, 10.0, (100.0, 100.0, 100.0), k), k, 4.0)
            for ratio in (1.2, 2.0, 4.0):
                exact = yu_houlsby(ratio, k, E, 0.3, 5.0, 30.0, 10.0, 100.0)
                self.compare("pressure of Yu and Houlsby", abs(solution.at(ratio)[0][0] / exact - 1.0), tolerance)


@problem("exact", "similarity solution after Chen and Abousleiman (2012, 2013)",
         "Cylindrical cavity in Modified Cam Clay")
class Cylinder(CavityCase):
    def test_pressures_and_stresses(self):
        """Isotropic from OCR 1 to 5, and a cavity along the larger initial stress."""
        for vertical, ocr in ((100.0, 1.0), (100.0, 2.0), (100.0, 5.0), (160.0, 1.2)):
            start = [START + f"effective stress yy={vertical * KPA}", START + f"overconsolidation ratio={ocr}",
                     "stages/expansion/time step/initial=0.01"]
            what = f"sigma'_v {vertical:g}, R {ocr:g}"
            law = clay((100.0, 100.0, vertical), ocr)
            history = self.run_deck(self.deck("cavity_expansion", "clay_cylinder"), start)
            undrained = Undrained(law, 1, 4.001)
            self.compare_pressures(what + ", undrained", history, 1, undrained, 1e-3, 2e-3)
            self.compare_stresses(undrained)
            history = self.run_deck(self.deck("cavity_expansion", "clay_cylinder"), start + [DRAINED])
            drained = Drained(law, 1, 4.001)
            self.compare_pressures(what + ", drained", history, 1, drained, 1e-3)
            self.compare_stresses(drained)

    def compare_stresses(self, solution):
        """All stresses (and the void ratio, drained) in the cells of the first thirty radii, at the end."""
        with h5py.File(self.folder + "/results/clay_cylinder.h5", "r") as file:
            step = file["steps"][sorted(file["steps"])[-1]]
            x = step["coordinates"][:, 0]
            stress, void_ratio = -step["cell/effective_stress"][()] / KPA, step["cell/void_ratio"][()]
        corners = np.unique(np.round(x, 9))[::2]
        points = np.sqrt(0.6) * np.array([-1, 0, 1])  # of the cells; fields show the mean of their values
        largest = np.abs(stress).max()
        worst = 0.0
        for i in np.nonzero(corners[1:] < 30)[0]:
            radii = 0.5 * (corners[i] + corners[i + 1]) + 0.5 * (corners[i + 1] - corners[i]) * points
            at = [solution.at(solution.stretch(r, 4.0, 1.0)) for r in radii]
            exact = np.mean([values[0] for values in at], axis=0)
            worst = max(worst, np.abs(stress[i][[0, 5, 3]] - exact).max() / largest)
            if isinstance(solution, Drained):
                volume = np.mean([2 * np.exp(-values[1]) for values in at])
                self.compare("void ratio", abs((1 + void_ratio[i]) / volume - 1), 1e-3)
        self.compare("stresses", worst, 1e-2)


if __name__ == "__main__":
    unittest.main()
