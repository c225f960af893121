"""Hypoplastic sand through `mudline point`, against an integration of the published equations
(references/hypoplasticity.py).

Allowed everywhere: 0.5 % of the largest stress of the path, and 5e-4 of the void ratio. Hochstetten sand:
docs/materials.md says where its numbers come from."""
import os
import unittest

import numpy as np

from compared_case import problem
from mudline_case import ROOT, MudlineCase, point_deck
from references import hypoplasticity as reference
from strength_case import SAND

ALLOWED = 5e-3
RANGE = {"intergranular strain range": 1e-4, "reversal stiffness ratio": 5.0, "turn stiffness ratio": 2.0,
         "intergranular strain exponent": 0.5, "stiffness decay exponent": 6.0}
P0 = 1e5


def to(kind, void_ratio, strains, steps):
    return {"type": kind, "axial strain": strains, "steps": steps,
            "initial state": {"mean effective stress": P0, "void ratio": void_ratio}}


@problem("benchmark",
         "von Wolffersdorff (1996), Niemunis and Herle (1997), integrated in references/hypoplasticity.py",
         "Hypoplastic sand", topic="materials")
class HypoplasticityTests(MudlineCase):
    def point(self, tests, skeleton):
        return self.run_point(self.write("sand.xml", point_deck(skeleton, tests, 0.7)))

    def close(self, name, value, exact, allowed):
        self.compare(name, np.abs(value - exact).max() / allowed * ALLOWED, ALLOWED)

    def compare_path(self, name, history, table):
        """Row by row: the reference has one for each step."""
        largest = np.abs(table[:, 1:3]).max()
        np.testing.assert_allclose(history["axial strain"], table[:, 0], atol=1e-9)
        for column, at in (("effective stress xx", 1), ("effective stress yy", 2)):
            self.close(f"{name}: {column}", history[column], -table[:, at], ALLOWED * largest)
        self.compare_values(f"{name}: void ratio", history["void ratio"], table[:, 3], 5e-4)

    def both(self, name, kind, motion, void_ratio, strains, steps, skeleton=None, sand=None):
        sand = sand or reference.Sand(**reference.HOCHSTETTEN, **reference.INTERGRANULAR)
        history = self.point({"path": to(kind, void_ratio, strains, steps)}, skeleton or dict(SAND, **RANGE))["path"]
        table = reference.path(sand, motion, P0, void_ratio, strains, steps + 1)
        self.compare_path(name, history, table)
        return history

    def test_drained_triaxial(self):
        """Dense sand has a peak and dilates, loose sand contracts and comes near the critical stress ratio."""
        ends = {}
        for name, void_ratio in (("dense", 0.62), ("loose", 0.88)):
            h = self.both(f"drained {name}", "triaxial drained", reference.drained, void_ratio, [0.2], 500)
            ratio = h["deviatoric stress"] / h["mean effective stress"]
            ends[name] = ratio.max(), ratio[-1], h["volumetric strain"][-1]
        sine = np.sin(np.radians(33.0))
        critical = 6 * sine / (3 - sine)
        self.assertGreater(ends["dense"][0], 1.15 * critical)
        self.assertLess(ends["dense"][2], -0.02)
        self.assertLess(ends["loose"][0], 1.02 * critical)
        self.assertGreater(ends["loose"][2], 0.02)
        self.assertLess(ends["dense"][1], 0.95 * ends["dense"][0])
        self.compare("critical stress ratio", abs(ends["loose"][1] / critical - 1), 0.03)

    def test_without_intergranular_strain(self):
        sand = reference.Sand(**reference.HOCHSTETTEN)
        for kind, motion in (("triaxial drained", reference.drained), ("triaxial undrained", reference.undrained),
                             ("oedometer", reference.oedometric)):
            self.both(f"plain {kind}", kind, motion, 0.7, [0.05], 250, SAND, sand)

    def test_undrained_triaxial(self):
        for name, void_ratio, strain in (("dense", 0.65, 0.03), ("loose", 0.88, 0.1), ("extension", 0.8, -0.03)):
            self.both(f"undrained {name}", "triaxial undrained", reference.undrained, void_ratio, [strain], 200)

    def test_oedometer_there_and_back(self):
        """Loading, unloading, reloading beyond the first load, with small loops on the way."""
        self.both("oedometer", "oedometer", reference.oedometric, 0.75, [0.01, 0.0085, 0.02, 0.0195, 0.02, 0.03], 100)

    @problem("benchmark", "a UMAT of the same law by others")
    def test_another_program(self):
        """An oedometer test on a UMAT of the same law by others: 294.3 kPa at 0.5 % of strain, stiffness 29080 kPa in
        the last step of 1e-4 and 316559 kPa in the first one back, with a tolerance of 1e-3 and small strain."""
        h = self.point({"path": to("oedometer", 0.7, [0.005, 0.0049], 50)}, dict(SAND, **RANGE))["path"]
        stress = h["effective stress yy"]
        self.compare("stress", abs(stress[50] / 294.3e3 - 1), 1e-3)
        self.compare("stiffness", abs((stress[50] - stress[49]) / 1e-4 / 29080e3 - 1), 2e-3)
        self.compare("stiffness on reversal", abs((stress[50] - stress[100]) / 1e-4 / 316559e3 - 1), 2e-3)

    def test_cycles_of_strain(self):
        """Undrained, twenty cycles of 0.05 %: the mean effective stress falls to a tenth."""
        h = self.both("cycles of strain", "triaxial undrained", reference.undrained, 0.8, [5e-4, -5e-4] * 20, 20)
        self.assertLess(h["mean effective stress"][-1], 0.12 * P0)

    def test_cycles_of_stress(self):
        """Undrained, six cycles of +-30 kPa, to pore pressures above nine tenths of the stress, at the turns."""
        turns, steps = 12, 200
        test = {"type": "triaxial undrained", "stress difference": [30e3, -30e3], "cycles": turns // 2, "steps": steps,
                "initial state": {"mean effective stress": P0, "void ratio": 0.75}}
        h = self.point({"path": test}, dict(SAND, **RANGE))["path"]
        sand = reference.Sand(**reference.HOCHSTETTEN, **reference.INTERGRANULAR)
        radial, axial = reference.turns(sand, reference.undrained, P0, 0.75, 30e3, turns).T
        self.close("cycles of stress: radial", h["effective stress xx"][steps::steps], -radial, ALLOWED * P0)
        self.close("cycles of stress: axial", h["effective stress yy"][steps::steps], -axial, ALLOWED * P0)
        self.assertGreater(h["excess pore pressure"].max(), 0.9 * P0)

    def test_finite_elements(self):
        """The force on the platen of inputs/materials/hypoplasticity.xml, a cylinder of 1 m radius without friction."""
        history = self.run_deck(os.path.join(ROOT, "inputs", "materials", "hypoplasticity.xml"))
        sand = reference.Sand(**reference.HOCHSTETTEN, **reference.INTERGRANULAR)
        table = reference.path(sand, reference.drained, P0, 0.65, [-np.log(0.9)], 2000)
        area = np.pi * np.exp(np.log((1 + table[:, 3]) / 1.65) + table[:, 0])
        force = np.interp(-np.log1p(-0.1 * history.time), table[:, 0], -table[:, 2] * area)
        self.close("finite elements: force", -history["reaction/platen y"][1:], force[1:], ALLOWED * force.max())

    def test_liquefaction(self):
        """Effective stresses at the turns of inputs/materials/liquefaction.xml, and the cycle in which the pore
        pressure comes to 90 % of the cell pressure."""
        history = self.run_deck(os.path.join(ROOT, "inputs", "materials", "liquefaction.xml"))
        self.assertLess(history["step/newton iterations"].mean(), 5)
        sand = reference.Sand(**reference.HOCHSTETTEN, **reference.INTERGRANULAR)
        pore = history["probe/specimen/pore pressure"]
        count = int(history.time[-1] + 0.5)
        table = reference.turns(sand, reference.undrained, P0, 0.75, 30e3, count)
        # at a turn the radial effective stress is the cell pressure less the pore pressure
        at = np.interp(np.arange(count) + 0.5, history.time, pore)
        self.close("pore pressure at the turns", at, P0 + table[:, 0], ALLOWED * P0)
        self.assertGreaterEqual(count, 3)
        self.assertLess(at.max(), 0.9 * P0)
        self.assertGreater(pore[-1], 0.9 * P0)


if __name__ == "__main__":
    unittest.main()
