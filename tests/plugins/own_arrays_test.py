"""Arrays of a plugin (own_arrays.cpp), one of each kind, which it declares and fills and then leaves alone: they go through mesh motion,
remeshing, restart on another number of ranks, and output."""
import os
import unittest

import h5py
import numpy as np

from mudline_case import MudlineCase, deck_text, program

FILES = [os.path.abspath(os.environ[name]) for name in ("MUDLINE_OWN_ARRAYS", "MUDLINE_SWINGING_MESH")]
ERRORS = ("points off", "surface off", "nodes off")
KINDS = ("points of a wrong kind", "surface of a wrong kind", "nodes of a wrong kind")
KEPT = ("content", "heat", "force", "grains")


def linear(x):
    return 3 - 2 * x[:, 0] + 5 * x[:, 1] + x[:, 2]


class OwnArrays(MudlineCase):
    """The soil is stretched evenly in its length and height, so that places of the start are linear in the present ones. A body far above
    draws the sides of the boundary along."""

    def deck(self, geometry, motion, soil=(), steps=8):
        space = geometry == "three-dimensional"
        axes = "xyz"[:3 if space else 2]
        sides = {"left": "x", "bottom": axes[-1], **({"front": "y"} if space else {})}
        moved = {"right": ("x", 0.05), "top": (axes[-1], -0.04)}
        elastic = {"type": "linear elastic", "Young's modulus": 1e7, "Poisson's ratio": 0.3}
        shape = {"surface": {"type": "box", "length x": 0.1, "length y": 0.1, "length z": 0.1}} if space else {
            "contour": {"type": "sphere", "diameter": 0.1, "extent": "full"}}
        body = {"position": [0.2, 3.0] if not space else [0.2, 0.5, 3.0], **shape,
                "motion": {"type": "prescribed velocity", "velocity x": 0.6}}
        entries = {
            "mesh": {"type": "box", "geometry": geometry, "cell": "tet10" if space else "tri6", "cells": [3] * 3 if space else [6, 6],
                     "upper": [1.0] * len(axes), "distortion": 0.2},
            "materials": {"soil": {"void ratio": 0.8, "skeleton": elastic}},
            "physics": {"ground": {"type": "solid", **dict(soil)}, "own": {"type": "own arrays"}},
            "bodies": {"sun": body},
            "boundary conditions": {
                **{side: {"type": "fixed", "set": side, "components": axis} for side, axis in sides.items()},
                **{side: {"type": "displacement", "set": side, axis: f"{speed}*t"} for side, (axis, speed) in moved.items()}},
            "mesh motion": motion,
            "plugins": {"files": FILES},
            "stages": {"stretch": {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 1.0 / steps, "maximum": 1.0 / steps}}},
            "output": {"checkpoint steps": 0},
            "solver": {"residual tolerance": 1e-10},
        }
        return self.write("own.xml", deck_text("own", entries))

    MOTION = {"interior": {"type": "swinging", "amplitude": 0.2, "period": 0.7},
              "boundary": {"focus": "sun", "size near focus": 0.1, "near distance": 2.0, "growth": 2.0, "material sides": ["bottom"]}}
    REMESHING = {**MOTION, "remeshing": {"when side above": 0.1, "when quality below": 0.0, "least steps": 3}}

    def check(self, history, grains=1e-9):
        for name in ERRORS:
            self.compare(name, np.abs(history["own/" + name]).max(), 1e-8)
        for name in KINDS:
            self.assertEqual(np.abs(history["own/" + name]).max(), 0, name)
        for name in KEPT:
            values = history["own/" + name]
            self.compare(name, np.abs(values / values[0] - 1).max(), grains if name == "grains" else 1e-12)
        steps = np.diff(history.time, prepend=0.0)
        volumes = np.concatenate(([1.0], history["own/volume"][:-1]))
        self.compare("sum", np.abs(history["own sum/volume time"] / np.cumsum(steps * volumes) - 1).max(), 1e-9)
        self.compare("clock", np.abs(history["own clock/time"] - history.time).max(), 1e-12)

    def check_output(self, slides=False):
        """The nodal fields are those of the places at the start; the number of a node beside the border may be either."""
        with h5py.File(os.path.join(self.folder, "results", "own.h5")) as file:
            last = file["steps"][sorted(file["steps"])[-1]]
            nodal = {name: last["nodal"][name][:] for name in last["nodal"]}
            start = last["coordinates"][:] - nodal["displacement"]
            self.assertLess(np.abs(nodal["own_nodes_origin"].ravel() - linear(start)).max(), 1e-8)
            self.assertEqual(set(nodal["own_nodes_kind"].ravel()), {1.0, 2.0})
            top = start[:, -1 if np.ptp(start[:, 2]) > 0 else 1] > 1 - 1e-6
            off = np.abs(nodal["own_surface_origin"].ravel() - linear(start))
            self.assertGreaterEqual((off[top] < 1e-8).sum(), 5)  # the vertices; other nodes have the mean of the rows around
            self.assertLess(off[top].max(), 1)
            self.assertEqual(np.abs(nodal["own_surface_origin"].ravel()[~top]).max(), 0)
            self.assertGreater(np.abs(nodal["own_held_force"]).max(), 1)
            self.assertIn("origin", last["cell"])
            if slides:  # the sides of the top moved past the soil
                self.assertGreater(np.abs(start - file["mesh/coordinates"][:])[top].max(), 0.02)

    def test_a_moved_mesh(self):
        for geometry in ("plane strain", "three-dimensional"):
            with self.subTest(geometry=geometry):
                history = self.run_deck(self.deck(geometry, self.MOTION))
                self.assertGreater(np.ptp(history["mesh/quality"]), 0.02)
                self.check(history)
                self.check_output(slides=geometry == "plane strain")

    def test_a_new_mesh(self):
        for geometry in ("plane strain", "three-dimensional"):
            with self.subTest(geometry=geometry):
                history = self.run_deck(self.deck(geometry, self.REMESHING))
                self.assertGreaterEqual(history["mesh/remeshings"][-1], 2)
                self.check(history)
                self.check_output()

    def test_ranks_and_restart(self):
        deck = self.deck("plane strain", self.REMESHING)
        whole = self.run_deck(deck)
        names = [name for name in whole.columns if name.startswith("own") and name.split("/")[1] not in ERRORS]
        self.assert_same_run(whole, self.run_deck(deck, ranks=2), names, "two ranks", rounding=1e-9)
        for before, after in ((1, 2), (4, 1)):
            self.run_deck(deck, ranks=before, extra=("--steps", "4", "--overwrite"))
            part = self.run_deck(deck, ranks=after, extra=("--restart",))
            self.check(part)
            self.assert_same_run(whole, part, names, f"from {before} to {after} ranks", rounding=1e-9)

    def test_layers_keep_no_void_ratio_of_a_plugin(self):
        deck = self.deck("plane strain", self.MOTION)
        layer = self.write("layer.xml", deck_text("layer", {"materials": {"deep": {
            "void ratio": 0.8, "top": 0.4, "skeleton": {"type": "linear elastic", "Young's modulus": 1e7, "Poisson's ratio": 0.3}}}}))
        done = program(["run", "-q", deck, layer], folder=self.folder)
        errors = [line for line in done.stderr.splitlines() if line.startswith("error:")]
        self.assertEqual((done.returncode, len(errors)), (2, 1), done.stderr)
        self.assertIn("in layered soil the variable 'ratio' of 'own points' cannot be transferred by its rule", errors[0])


if __name__ == "__main__":
    unittest.main()
