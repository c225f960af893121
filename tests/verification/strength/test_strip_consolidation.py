"""A footing pushed into saturated Mohr-Coulomb soil, so fast that no water moves, so slowly that no pressure builds up, and between."""
import unittest

import numpy as np

from compared_case import problem
from strength_case import StrengthCase

COHESION = 10e3
PRANDTL = 14.834712
# p' = 0 stays in the undrained soil, so that the strength is c cos(phi) less what the rounding of the tip (0.05) takes
UNDRAINED = (2 + np.pi) * np.cos(np.radians(20)) * np.sqrt(1 - 0.05 ** 2)
DILATION = "materials/soil/skeleton/dilation angle [deg]=20"


def conductivity(k):
    return (f"materials/soil/permeability/hydraulic conductivity={k}",)


@problem("exact", "slip-line theory, undrained and drained", "Strip footing on saturated Mohr-Coulomb soil")
class StripFooting(StrengthCase):
    def capacity(self, cells, settings):
        """q/c', and how much of it came over the last tenth of the path."""
        history = self.run_deck(self.deck("consolidation", "strip_footing"), (f"mesh/parameters/cells={cells}",) + settings)
        factor = -history["reaction/footing y"] / COHESION
        return factor[-1], factor[-1] / np.interp(0.9, history.time, factor) - 1

    def test_fast(self):
        fast = conductivity(1e-15) + ("boundary conditions/footing/y=-1.2e-5*t", "physics/ground/stiffness damping=5e-5")
        loads = []
        for cells, tolerance in ((4, 0.045), (6, 0.025)):
            q, growth = self.capacity(cells, fast)
            self.compare_range(f"{cells} cells", q / UNDRAINED, 1, 1 + tolerance, 1)
            self.compare_range(f"{cells} cells, growth at the end", growth, -1e-3, 0.005, 0)
            loads.append(q)
        self.assertLess(loads[1], loads[0])

    def test_slow(self):
        q, growth = self.capacity(6, conductivity(0.1) + (DILATION,))
        self.compare_range("associated", q / PRANDTL, 1, 1.02, 1)
        self.compare_range("growth at the end", growth, -1e-4, 0.005, 0)

    @problem("consistency")
    def test_between(self):
        # at half of the settlement that the drained limit needs the fast footing has long failed
        half = ("boundary conditions/footing/y=-3e-5*t", "physics/ground/stiffness damping=2e-5")
        fast, medium, slow = (self.capacity(4, half + conductivity(k))[0] for k in (1e-15, 1e-6, 0.1))
        self.compare_range("medium over fast", medium / fast, 1.4, 1.9)
        self.compare_range("slow over medium", slow / medium, 1.35, 1.8)
        self.assertLess(slow, PRANDTL)  # psi = 0: no more than the associated footing

    @problem("behaviour")
    def test_dilating_soil_does_not_fail_undrained(self):
        q, _ = self.capacity(4, conductivity(1e-15) + (DILATION,))
        self.assertGreater(q, 2 * PRANDTL)


if __name__ == "__main__":
    unittest.main()
