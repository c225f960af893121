"""The mesh inside may move as it likes in space too: its vertices swing, and the state transferred at every step is compared with the same
run on a mesh that goes with the soil."""
import os
import unittest

import numpy as np

from compared_case import problem
from mudline_case import ROOT, deck_text
from space_case import Fields, SpaceCase, quasi_static
from swinging_mesh import swinging_mesh

TERZAGHI = os.path.join(ROOT, "inputs", "space", "terzaghi.xml")
LOAD = 3452184.8694  # [Pa] a quarter of the height


def swing(period, amplitude=0.15):
    """An overlay: vertices inside swing; the boundary goes with the soil."""
    sides = {"material sides": ["left", "right", "front", "back", "bottom", "top"]}
    return deck_text("swing", swinging_mesh(amplitude, period, boundary=sides))


@problem("consistency", title="Swinging mesh in space")
class MeshMotion(SpaceCase):
    def test_large_strain_consolidation(self):
        settings = ["mesh/cells={3, 3, 12}", "mesh/upper={0.375, 0.375, 1.0}", f"boundary conditions/load/z={-LOAD}",
                    "stages/consolidation/duration=200", "stages/consolidation/time step/initial=1", "stages/consolidation/time step/growth=1.25",
                    "stages/consolidation/time step/maximum=10", "solver/residual tolerance=1e-8"]
        overlay = self.write("swing.xml", swing(40))
        places = {"node": [0.125, 0.25, 0.0], "same": {"point": [0.125, 0.25, 0.0], "moves with": "nothing"},
                  "inside": {"point": [0.17, 0.23, 0.41], "moves with": "nothing"},
                  "outside": {"point": [0.1, 0.2, 1.0], "moves with": "nothing"}}
        probes = self.write("probes.xml", deck_text("probes", {"output": {"probes": places}}))
        for cell in ("tet10", "hex27", "wedge15"):
            with self.subTest(cell=cell):
                still = self.run_deck([TERZAGHI, probes], settings + ["mesh/cell=" + cell])
                moved = self.run_deck([TERZAGHI, probes, overlay], settings + ["mesh/cell=" + cell, "output/name=moved"], name="moved", extra=["--overwrite"])
                self.assertGreater(np.ptp(moved["mesh/quality"]), 0.005)  # it does swing, flat as the elements are
                for name in ("probe/top/displacement z", "probe/base/pore pressure", "probe/inside/displacement z", "probe/inside/pore pressure"):
                    scale = np.abs(still[name]).max()
                    self.compare(f"{cell}: {name}", np.abs(moved.at(name, still.time) - still[name]).max() / scale,
                                 # linear between vertices that are elsewhere
                                 5e-3 if name == "probe/inside/pore pressure" else 1e-3)
                place = {name: moved[f"probe/{name}/pore pressure"] for name in ("node", "same", "outside")}
                self.compare("probe at a node",
                             np.abs(place["same"] - place["node"]).max() / (np.abs(place["node"]).max()), 1e-12)
                self.compare("probe outside", np.abs(place["outside"][1:]).max() / (np.abs(place["node"]).max()),
                             1e-12)  # above the top that has sunk: drained
                self.assertLess(np.abs(moved["mesh motion/change of solid"]).max(), 1e-11)
                self.assertLess(np.abs(moved["balance/water/error"]).max(), 1e-8)

    def test_uniform_stress_survives(self):
        stress = {"effective stress xx": 3e4, "effective stress yy": 5e4, "effective stress zz": 2e4, "shear stress xy": 1e4, "shear stress yz": -4e3}
        for cell in ("tet4", "tet10", "hex8", "hex27", "wedge6", "wedge15", "wedge18"):
            with self.subTest(cell=cell):
                deck = self.write("uniform.xml", deck_text("uniform", {
                    "mesh": {"type": "box", "geometry": "three-dimensional", "cell": cell, "cells": [3, 3, 3], "upper": [1.0, 1.0, 1.0], "distortion": 0.2},
                    "materials": {"soil": {"void ratio": 0.8, "skeleton": {"type": "linear elastic", "Young's modulus": 1e7, "Poisson's ratio": 0.3}}},
                    "physics": {"ground": {"type": "solid", "initial state": {"type": "uniform", **stress}}},
                    "boundary conditions": {side: {"type": "fixed", "set": side} for side in ("left", "right", "front", "back", "top", "bottom")},
                    "stages": {"hold": quasi_static(10.0, 1.0, 1.0, 0)}}))
                overlay = self.write("swing.xml", swing(7, 0.2))
                history = self.run_deck([deck, overlay], extra=["--overwrite"])
                self.assertGreater(np.ptp(history["mesh/quality"]), 0.05)
                fields = Fields(self.folder, "uniform")
                for column, value in zip(range(6), (-3e4, -1e4, 0.0, -5e4, 4e3, -2e4)):  # XDMF's order; tension positive
                    self.compare(f"stress {column}",
                                 np.abs(fields.cell["effective_stress"][:, column] - value).max() / 5e4, 1e-11)
                self.compare("displacement [m]", np.abs(fields.nodal["displacement"]).max(), 1e-12)


if __name__ == "__main__":
    unittest.main()
