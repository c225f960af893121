"""A cone and a pile pushed into hypoplastic sand, remeshed on their way."""
import os
import unittest

import numpy as np

from compared_case import problem
from mudline_case import ROOT, MudlineCase
from references.cavity import Drained, HypoplasticRates
from references.hypoplasticity import HOCHSTETTEN

RADIUS = 0.01785  # [m] of the cone
SURCHARGE = 100e3  # [Pa]
MEAN = (100e3 + 2 * 45e3) / 3  # [Pa] effective, at the start
# [MPa] net, at two and four radii, of inputs/cpt/sand.xml itself: docs/benchmarks/sand_cone.md
FINER = {0.65: (3.00, 4.93), 0.85: (1.42, 2.10)}
# of inputs/pile/dry_sand.xml: sides half as long again
COARSER = ("mesh/parameters/fine=0.03", "mesh/parameters/coarse=1.2", "mesh motion/boundary/size near focus=0.06",
           "mesh motion/remeshing/wall size=0.0375")


def inputs(folder, *names):
    return [os.path.join(ROOT, "inputs", folder, name + ".xml") for name in names]


def limit_pressure(void_ratio):
    """[Pa] of a spherical cavity that grows from nothing in the sand, at the mean stress of the chamber."""
    return Drained(HypoplasticRates(HOCHSTETTEN, void_ratio, (MEAN,) * 3), 2, 100.0).at(99.0)[0][0]


@problem("benchmark", "limit pressure of a spherical cavity, an ordinary differential equation of the same law",
         "Cone in hypoplastic sand")
class Cone(MudlineCase):
    def push(self, name, void_ratio):
        """Where the face bears at least the limit pressure and rubs with 0.3, the resistance is 1 + 0.3 cot(30 deg)
        times that (Ladanyi and Johnston 1974), 1.52. Upper bound: four times as much."""
        history = self.run_deck(inputs("cpt", "sand", "short_sand"), [f"materials/sand/void ratio={void_ratio}"],
                                name="short_sand")
        self.assertGreaterEqual(history["mesh/remeshings"][-1], 2)
        self.assertGreater(history["mesh/quality"].min(), 0.2)
        self.assertLess(history["step/newton iterations"].mean(), 9)
        net = np.interp([2 * RADIUS, 4 * RADIUS], -history["body/cone/displacement y"],
                        history["contact/cone/reaction y"]) / (np.pi * RADIUS ** 2)
        for radii, value, finer in zip((2, 4), net, FINER[void_ratio]):
            self.compare_values(f"{name}, {radii} radii: finer mesh", value, 1e6 * finer, 0.05)
        least = 1 + 0.3 / np.tan(np.radians(30))
        share = (net[1] + SURCHARGE) / limit_pressure(void_ratio)
        self.compare_range(f"{name}: resistance over limit pressure", share, least, 4 * least)

    def test_dense(self):
        self.push("dense", 0.65)

    def test_loose(self):
        self.push("loose", 0.85)


@problem("consistency", title="Pile in dry and in saturated hypoplastic sand")
class Pile(MudlineCase):
    def test_drained_water_only_takes_weight(self):
        """One diameter deep, with sides half as long again as the deck's: the sand under water, and dry with grains
        lighter by the water's density."""
        settings = ["stages/push/duration=20", *COARSER]
        wet = self.run_deck(inputs("pile", "dry_sand", "saturated_sand"), settings, name="saturated_sand")
        dry = self.run_deck(inputs("pile", "dry_sand"), settings + ["materials/sand/grain density=1650"])
        for history in (wet, dry):
            self.assertLess(history["step/newton iterations"].mean(), 7)
            self.assertGreaterEqual(history["mesh/remeshings"][-1], 1)
        for part in (0.25, 0.5, 0.75, 1.0):
            force = [np.interp(0.4 * part, -h["body/pile/displacement y"], h["contact/pile/reaction y"])
                     for h in (wet, dry)]
            self.compare_values(f"resistance at {part} diameters", force[0], force[1], 0.03)


if __name__ == "__main__":
    unittest.main()
