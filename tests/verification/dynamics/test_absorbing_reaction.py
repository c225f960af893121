"""A block at rest whose rollers are replaced by absorbing boundaries stays at rest: each holds what nothing else holds."""
import unittest

import numpy as np

from compared_case import problem
from dynamics_case import DynamicsCase
from mudline_case import deck_text

ROLLERS = {"base": ("bottom", "y"), "left": ("left", "x"), "right": ("right", "x")}


def block(stages, more=None):
    """10 m x 8 m of soil under its weight, K0 0.5, on rollers; then dynamic stages of a second, each with its own conditions."""
    rollers = {name: {"type": "fixed", "set": side, "components": way} for name, (side, way) in ROLLERS.items()}
    absorbing = {"open " + name: {"type": "absorbing", "set": side} for name, (side, way) in ROLLERS.items()}
    named = {name for stage in stages for name in stage}
    absorbing = {name: entry for name, entry in absorbing.items() if name in named}
    dynamic = {f"stage {i}": {"type": "dynamic", "duration": 1.0, "conditions": names, "time step": {"initial": 0.02}}
               for i, names in enumerate(stages)}
    return deck_text("block", {
        "mesh": {"type": "box", "cell": "quad9", "cells": [5, 4], "upper": [10.0, 8.0]},
        "materials": {"soil": {"density": 1900.0, "void ratio": 0.7, "skeleton": {
            "type": "linear elastic", "Young's modulus": 2e7, "Poisson's ratio": 0.3}}},
        "physics": {"ground": {"type": "solid", "gravity": [0.0, -9.81],
                               "initial state": {"type": "geostatic", "K0": 0.5}}},
        "boundary conditions": {**rollers, **absorbing, **(more or {})},
        "stages": {"rest": {"type": "geostatic", "conditions": list(ROLLERS), "balance tolerance": 1e-9}, **dynamic},
        "output": {"probes": {f"{x:g} {y:g}": [x, y] for x in (0.0, 5.0, 10.0) for y in (0.0, 4.0, 8.0)}}})


@problem("exact", "rest", "Absorbing boundaries hold what rollers held")
class AbsorbingReaction(DynamicsCase):
    def moves(self, stages, more=None, ranks=1):
        history = self.run_deck(self.write("block.xml", block(stages, more)), ranks=ranks)
        self.assertGreater(history.time[-1], len(stages) - 1e-6)
        return max(np.abs(values).max() for name, values in history.columns.items() if "/displacement" in name)

    @problem("behaviour")
    def test_two_at_one_time(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                self.assertLess(self.moves([["open base", "open left", "right"]], ranks=ranks), 1e-9)

    @problem("behaviour")
    def test_three_at_one_time(self):
        self.assertLess(self.moves([["open base", "open left", "open right"]]), 1e-9)

    @problem("behaviour")
    def test_two_on_one_side(self):
        second = {"again": {"type": "absorbing", "set": "bottom", "normal factor": 0.5}}
        self.assertLess(self.moves([["open base", "again", "left", "right"]], second), 1e-9)

    @problem("behaviour")
    def test_one_after_the_other(self):
        """The rollers of the base keep the corners while the sides open; later the base takes them over, not the sides."""
        sides = ["base", "open left", "open right"]
        self.assertLess(self.moves([sides, ["open base", "open left", "open right"]]), 1e-9)

    def test_reactions_stay_with_what_prescribes(self):
        history = self.run_deck(self.write("block.xml", block([["base", "open left", "right"]])))
        weight = 1900.0 * 9.81 * 10 * 8
        self.compare_values("base", history["reaction/base y"], weight, 1e-8, weight)


if __name__ == "__main__":
    unittest.main()
