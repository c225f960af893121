"""A pile pushed straight down, whose soil slides past it: a quarter of it in space against axial symmetry, both with mesh motion; and off its
axis, where the mesh has to stay sound."""
import os
import unittest

import numpy as np

from compared_case import problem
from mudline_case import ROOT, deck_text
from space_case import SpaceCase

HERE = os.path.dirname(os.path.abspath(__file__))
OBLIQUE = os.path.join(ROOT, "inputs", "space", "oblique_pile.xml")
PRESSURE = 200e3


def axisymmetric(duration):
    """The deck inputs/space/oblique_pile.xml in axial symmetry, straight down, with sides that are 2.7 times finer."""
    stress = {f"effective stress {axis}{axis}": PRESSURE for axis in "xyz"}
    return deck_text("axisymmetric", {
        "mesh": {"type": "gmsh", "geometry": "axisymmetric", "file": os.path.join(HERE, "pile_section.geo")},
        "materials": {"clay": {"density": 1800.0, "skeleton": {"type": "tresca", "undrained strength": 20e3, "rigidity index": 100.0,
                                                               "Poisson's ratio": 0.49, "lode transition angle [deg]": 25.0}}},
        "physics": {"ground": {"type": "solid", "initial state": {"type": "uniform", **stress}}},
        "bodies": {"pile": {"position": [0.0, -0.8],
                            "contour": {"type": "flat pile", "diameter": 0.4, "corner radius": 0.08, "shaft length": 1.6},
                            "motion": {"type": "prescribed velocity", "velocity y": -0.1}}},
        "boundary conditions": {"far side": {"type": "fixed", "set": "far side"}, "axis": {"type": "fixed", "set": "axis", "components": "x"},
                                "surcharge": {"type": "pressure", "set": "seabed", "value": PRESSURE}},
        "contacts": {"pile": {"type": "penalty", "body": "pile", "surface": "pile", "penalty": 1e9, "initial gap": "in-situ stress",
                              "closing distance": 0.02,
                              "friction": {"type": "coulomb", "coefficient": 0.0, "adhesion": 10e3, "on": "total"}}},
        "mesh motion": {"boundary": {"focus": "pile", "size near focus": 0.02, "near distance": 0.25, "growth": 0.04}},
        "stages": {"start": {"type": "geostatic", "contacts": ["pile"], "balance tolerance": 1e-3},
                   "push": {"type": "quasi-static", "duration": duration,
                            "time step": {"initial": 0.01, "maximum": 0.1, "growth": 1.5, "easy iterations": 6, "hard iterations": 12}}},
        "solver": {"residual tolerance": 1e-4, "update tolerance": 1e-2, "newton": {"maximum iterations": 20}}})


@problem("consistency", title="Pile in space against axial symmetry, mesh motion")
class SlidingBoundary(SpaceCase):
    def test_straight(self):
        duration = 0.8  # 0.2 diameters
        plane = self.run_deck(self.write("axisymmetric.xml", axisymmetric(duration)), name="axisymmetric")
        quarter = self.write("quarter.xml", deck_text("quarter", {
            "mesh": {"parameters": {"angle": 90.0}},
            "boundary conditions": {"x = 0": {"type": "fixed", "set": "x = 0", "components": "x"}}}))
        space = self.run_deck([OBLIQUE, quarter], [f"stages/push/duration={duration}", "bodies/pile/motion/velocity x=0",
                                                   "bodies/pile/motion/velocity z=-0.1"])
        down = -space["body/pile/displacement z"]
        for name, allowed in (("reaction", 0.03), ("shaft reaction", 0.03)):
            exact = np.interp(down, -plane["body/pile/displacement y"], plane[f"contact/pile/{name} y"])
            late = down > 0.02
            self.compare(name, np.abs(4 * space[f"contact/pile/{name} z"][late] / exact[late] - 1).max(), allowed)

    @problem("behaviour")
    def test_off_the_axis(self):
        history = self.run_deck(OBLIQUE, ["stages/push/duration=0.3"])
        self.assertGreater(history["mesh/quality"].min(), 0.1)
        self.assertGreater(np.ptp(history["mesh/quality"]), 0)
        self.assertLess(np.abs(history["mesh motion/change of solid"]).max(), 1e-12)
        self.assertLess(history["contact/pile/reaction x"][-1], -5e3)  # the pile is held back


if __name__ == "__main__":
    unittest.main()
