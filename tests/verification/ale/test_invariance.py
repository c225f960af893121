"""The mesh may move as it likes: the solution must not notice. Interior nodes swing by a sixth of an element (swinging_mesh.py),
and the state transferred at every step is compared with the same run on a mesh that goes with the soil."""
import os
import unittest

import h5py
import numpy as np

from compared_case import problem
from mudline_case import ROOT, MudlineCase, deck_text
from swinging_mesh import swinging_mesh


def motion(period):
    """Overlay with a swinging mesh."""
    return deck_text("swing", swinging_mesh(0.15, period))


@problem("consistency", title="A swinging mesh changes nothing")
class Invariance(MudlineCase):
    def pair(self, deck, settings, period):
        """The same run with and without the swing."""
        still = self.run_deck(deck, settings)
        overlay = self.write("swing.xml", motion(period))
        moved = self.run_deck([deck, overlay], settings)
        self.assertGreater(moved["mesh/quality"].max() - moved["mesh/quality"].min(), 0.02)  # it does swing
        return still, moved

    def assert_same(self, still, moved, names, tolerance):
        for name in names:
            scale = np.abs(still[name]).max()
            difference = np.abs(np.interp(still.time, moved.time, moved[name]) - still[name]).max() / scale
            self.assertGreater(scale, 0)
            self.compare(name, difference, tolerance)

    def test_large_strain_consolidation(self):
        deck = os.path.join(ROOT, "inputs", "consolidation", "large_strain.xml")
        for cell in ("quad9", "tri6"):
            with self.subTest(cell=cell):
                settings = (f"mesh/cell={cell}", "mesh/cells={3, 24}", "stages/consolidation/duration=400",
                            "stages/consolidation/time step/maximum=5", "solver/residual tolerance=1e-8")
                still, moved = self.pair(deck, settings, 40)
                self.assert_same(still, moved, ("probe/top/displacement y", "probe/base/pore pressure"), 1e-3)
                self.compare("change of solid", np.abs(moved["mesh motion/change of solid"]).max(), 1e-11)
                self.compare("change of water", np.abs(moved["mesh motion/change of water"]).max(), 1e-10)
                self.compare("water error", np.abs(moved["balance/water/error"]).max(), 1e-8)

    def test_dynamic_column(self):
        deck = os.path.join(ROOT, "inputs", "dynamic_column", "de_boer.xml")
        settings = ("mesh/cells={3, 60}", "mesh/upper={0.5, 10.0}", "mesh/grading={1.0, 1.0}")
        still, moved = self.pair(deck, settings, 0.05)
        names = [name for name in still.columns if name.startswith("probe/") and ("pore pressure" in name or "displacement y" in name)
                 and np.abs(still[name]).max() > 0]
        self.assertGreaterEqual(len(names), 2)
        self.assert_same(still, moved, names, 1e-3)

    def test_uniform_stress_survives(self):
        skeleton = {"type": "linear elastic", "Young's modulus": 1e7, "Poisson's ratio": 0.3}
        start = {"type": "uniform", "effective stress xx": 3e4, "effective stress yy": 5e4, "effective stress zz": 2e4,
                 "shear stress xy": 1e4}
        deck = self.write("uniform.xml", deck_text("uniform", {
            "mesh": {"type": "box", "cell": "tri6", "cells": [6, 6], "upper": [1.0, 1.0], "distortion": 0.2},
            "materials": {"soil": {"void ratio": 0.8, "skeleton": skeleton}},
            "physics": {"ground": {"type": "solid", "initial state": start}},
            "boundary conditions": {side: {"type": "fixed", "set": side} for side in ("left", "right", "top", "bottom")},
            **swinging_mesh(0.2, 7),
            "stages": {"hold": {"type": "quasi-static", "duration": 30.0, "time step": {"initial": 1.0}}}}))
        history = self.run_deck(deck)
        self.assertGreater(np.ptp(history["mesh/quality"]), 0.1)
        with h5py.File(os.path.join(self.folder, "results", "uniform.h5")) as file:
            last = file["steps"][sorted(file["steps"])[-1]]
            stress = last["cell/effective_stress"][:]
            moved = np.abs(last["coordinates"][:, :2] - file["mesh/coordinates"][:, :2]).max()
            displacement = np.abs(last["nodal/displacement"][:]).max()
        self.assertGreater(moved, 0.01)
        for column, value in zip(range(6), (-3e4, -1e4, 0.0, -5e4, 0.0, -2e4)):  # XDMF's order; tension positive
            self.compare(f"stress {column}", np.abs(stress[:, column] - value).max() / 5e4, 1e-12)
        self.assertLess(displacement, 1e-12)


if __name__ == "__main__":
    unittest.main()
