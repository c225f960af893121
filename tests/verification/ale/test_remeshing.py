"""The region is meshed anew on the way: constant stresses stay what they are, an answer changes by less than a thousandth, what is
conserved stays, a restart goes on on the last mesh bit for bit, and ranks agree."""
import os
import re
import unittest

import h5py
import numpy as np

from mudline_case import ROOT, MudlineCase, deck_text, program

BALL = os.path.join(ROOT, "tests", "mpi", "ball_in_clay.xml")
# sides of a new boundary are up to 1.5 times as long as wanted: below that there is a new mesh whenever the steps are over
ALWAYS = 0.1


def remeshing(every, more=(), boundary=()):
    inside = {"when side above": ALWAYS, "least steps": every, "when quality below": 0.0}
    inside.update(more)
    parts = {"remeshing": inside}
    if boundary:
        parts["boundary"] = dict(boundary)
    return deck_text("remeshing", {"mesh motion": parts})


class Remeshing(MudlineCase):
    def test_uniform_stress_survives(self):
        skeleton = {"type": "linear elastic", "Young's modulus": 1e7, "Poisson's ratio": 0.3}
        start = {"type": "uniform", "effective stress xx": 3e4, "effective stress yy": 5e4, "effective stress zz": 2e4,
                 "shear stress xy": 1e4}
        deck = self.write("uniform.xml", deck_text("uniform", {
            "mesh": {"type": "box", "cell": "tri6", "cells": [6, 6], "upper": [1.0, 1.0], "distortion": 0.2},
            "materials": {"soil": {"void ratio": 0.8, "skeleton": skeleton}},
            "physics": {"ground": {"type": "solid", "initial state": start}},
            "boundary conditions": {side: {"type": "fixed", "set": side} for side in ("left", "right", "top", "bottom")},
            "stages": {"hold": {"type": "quasi-static", "duration": 30.0, "time step": {"initial": 1.0}}}}))
        history = self.run_deck([deck, self.write("remeshing.xml", remeshing(10))])
        self.assertEqual(history["mesh/remeshings"][-1], 2)
        with h5py.File(os.path.join(self.folder, "results", "uniform.h5")) as file:
            last = file["steps"][sorted(file["steps"])[-1]]
            self.assertEqual(last.attrs["mesh"], b"mesh_002" if isinstance(last.attrs["mesh"], bytes) else "mesh_002")
            stress, cells = last["cell/effective_stress"][:], last["mesh/offset"][:]
            self.assertEqual(len(stress), len(cells))
            self.assertNotEqual(len(cells), len(file["mesh/offset"]))
            displacement = np.abs(last["nodal/displacement"][:]).max()
        for column, value in zip(range(6), (-3e4, -1e4, 0.0, -5e4, 0.0, -2e4)):  # XDMF's order; tension positive
            self.assertLess(np.abs(stress[:, column] - value).max(), 1e-12 * 5e4)
        self.assertLess(displacement, 1e-12)
        self.assertLess(np.abs(history["mesh motion/change of solid"]).max(), 1e-13)

    def test_large_strain_consolidation_does_not_notice(self):
        deck = os.path.join(ROOT, "inputs", "consolidation", "large_strain.xml")
        settings = ("mesh/cell=tri6", "mesh/cells={3, 24}", "stages/consolidation/duration=400",
                    "stages/consolidation/time step/maximum=5", "solver/residual tolerance=1e-8")
        with open(deck) as file:
            text = re.sub(r'<ParameterList name="probes">.*?</ParameterList>\n', "", file.read(), flags=re.S)
        self.assertNotIn("probes", text)
        deck = self.write("large_strain.xml", text)
        still = self.run_deck(deck, settings)
        moved = self.run_deck([deck, self.write("remeshing.xml", remeshing(20))], settings)
        self.assertGreater(moved["mesh/remeshings"][-1], 3)
        names = [name for name in still.columns
                 if name == "balance/water/outflow" or name.startswith("balance/energy/") and not name.endswith("error")]
        aside = ("kinetic", "inertia", "dissipation")  # there is no inertia: they say nothing
        names = [name for name in names if np.abs(still[name]).max() > 0 and not any(word in name for word in aside)]
        self.assertGreaterEqual(len(names), 2)
        for name in names:
            scale = np.abs(still[name]).max()
            error = np.abs(np.interp(still.time, moved.time, moved[name]) - still[name]).max() / scale
            self.assert_error(name, error, 1e-3)
        self.assertLess(np.abs(moved["mesh motion/change of solid"]).max(), 1e-11)
        self.assertLess(np.abs(moved["mesh motion/change of water"]).max(), 1e-10)


class Ball(MudlineCase):
    """A ball pushed dynamically into saturated clay, on triangles that are made anew every five steps."""

    def setUp(self):
        super().setUp()
        with open(BALL) as file:
            text = file.read()
        text = re.sub(r'    <ParameterList name="probes">.*?</ParameterList>\n', "", text, flags=re.S).replace("quad9", "tri6")
        self.deck = self.write("ball.xml", text)
        overlay = remeshing(5, {"wall size": 0.02}, {"focus": "ball", "size near focus": 0.02, "near distance": 0.11, "growth": 0.3})
        self.overlay = self.write("remeshing.xml", overlay)

    def run_ball(self, name, *extra, ranks=1):
        return self.run_deck([self.deck, self.overlay], (f"output/name={name}",), ranks, extra, name=name)

    def content(self, name, ending=".csv"):
        with open(os.path.join(self.folder, "results", name + ending), "rb") as file:
            return file.read()

    def test_what_is_conserved(self):
        # nothing but the remeshings moves the mesh
        moved = self.run_deck([self.deck, self.overlay], ("output/name=whole", "mesh motion/every=1000000"), name="whole")
        self.assertGreaterEqual(moved["mesh/remeshings"][-1], 3)
        self.assertLess(np.abs(moved["mesh motion/change of solid"]).max(), 1e-12)
        self.assertLess(np.abs(moved["mesh motion/change of water"]).max(), 1e-11)
        momentum = np.abs(moved["balance/momentum/change y"]).max()
        for axis in "xy":
            self.assertLess(np.abs(moved[f"mesh motion/change of momentum {axis}"]).max(), 1e-12 * momentum)
        kinetic = moved["mesh motion/change of kinetic energy"]
        self.assertLess(np.diff(kinetic).max(), 1e-12 * np.abs(moved["balance/energy/kinetic"]).max())
        self.assertLess(kinetic[-1], 0)

    def test_a_restart_goes_on_bit_for_bit_and_ranks_agree(self):
        runs = {}
        for ranks in (1, 2):
            runs[ranks] = self.run_ball(f"whole{ranks}", ranks=ranks)
            for steps in (7, 5)[: 3 - ranks]:  # behind a remeshing, and just before one
                name = f"part{ranks}{steps}"
                self.run_ball(name, "--steps", str(steps), ranks=ranks)
                self.run_ball(name, "--restart", ranks=ranks)
                self.assertEqual(self.content(name), self.content(f"whole{ranks}"))
        names = [name for name in runs[1].columns if name.startswith(("contact/", "balance/water", "body/"))]
        self.assert_same_run(runs[1], runs[2], names, "ranks")

    def test_what_cannot_be_carried_over_is_refused(self):
        for overlay, expected in (
            ({"output": {"probes": {"tip": [0.0, 0.3]}}}, "a node is lost where the mesh is made anew"),
            ({"boundary conditions": {"far": {"type": "absorbing", "set": "right"}}},
             "the boundary condition 'far' holds forces at nodes that would move; name its set in boundary/material sides"),
            ({"mesh": {"cell": "quad9"}}, "the mesh has cells quad9; only meshes of triangles (tri3, tri6) can be made anew"),
        ):
            more = self.write("more.xml", deck_text("more", overlay))
            done = program(["run", "-q", self.deck, self.overlay, more], folder=self.folder)
            errors = [line for line in done.stderr.splitlines() if line.startswith("error:")]
            self.assertEqual((done.returncode, len(errors)), (2, 1), done.stderr)
            self.assertIn(expected, errors[0])


if __name__ == "__main__":
    unittest.main()
