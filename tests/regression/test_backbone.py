"""The undrained and the drained end of the backbone, inputs/cpt/backbone.xml: its fastest and its slowest cone, 3.4 radii deep on the mesh of
inputs/cpt/short_cone.xml, against the figures of finer meshes (docs/benchmarks/mesh_convergence.md)."""
import os
import unittest

import numpy as np

from mudline_case import ROOT, MudlineCase

DECKS = [os.path.join(ROOT, "inputs", "cpt", name) for name in ("clay.xml", "short_cone.xml")]
RADIUS, DEPTH = 0.01785, 0.06  # [m]
UNDRAINED, DRAINED = 2e-2, 2e-7  # [m/s]

# converged with the mesh, docs/benchmarks/mesh_convergence.md
RESISTANCE = {UNDRAINED: 169.2e3, DRAINED: 351e3}  # [Pa] net
EXCESS_PRESSURE = 158.9e3  # [Pa] 4 mm beside the centre of the undrained cone's face


class Backbone(MudlineCase):
    def push(self, velocity):
        """Net resistance and excess pressure beside the face at the end [Pa]."""
        settings = (f"bodies/cone/motion/velocity y={-velocity}", f"stages/push/duration={DEPTH / velocity}", f"output/field interval={DEPTH / velocity}",
                    f"stages/push/time step/initial={4e-5 / velocity}", f"stages/push/time step/maximum={1.6e-3 / velocity}")
        history = self.run_deck(DECKS, settings, name="short_cone")
        self.assertGreater(history["mesh/quality"].min(), 0.2)
        return (history["contact/cone/tip reaction y"][-1] / (np.pi * RADIUS ** 2), history["probe/face/excess pore pressure"][-1])

    def test_undrained(self):
        resistance, pressure = self.push(UNDRAINED)
        self.compare_values("undrained resistance", resistance, RESISTANCE[UNDRAINED], 0.03)
        self.compare_values("excess pressure beside the undrained cone", pressure, EXCESS_PRESSURE, 0.05)

    def test_drained(self):
        resistance, pressure = self.push(DRAINED)
        self.compare_values("drained resistance", resistance, RESISTANCE[DRAINED], 0.03)
        self.assertLess(abs(pressure), 0.05 * EXCESS_PRESSURE)


if __name__ == "__main__":
    unittest.main()
