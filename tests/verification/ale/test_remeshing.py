"""The region is remeshed during the run: constant stresses stay what they are, an answer changes by less than a thousandth, what is
conserved stays, a restart goes on on the last mesh bit for bit, and ranks agree."""
import os
import re
import shutil
import unittest

import h5py
import numpy as np

from compared_case import problem
from mudline_case import ROOT, History, MudlineCase, deck_text, program
from remeshed_ball import ADAPTIVE, ESTIMATE, FOCUS, WALL, ball, remeshing


def block(cells):
    """A block on rough ground, pressed from above: the stress is singular in the two corners at its base."""
    skeleton = {"type": "linear elastic", "Young's modulus": 1e7, "Poisson's ratio": 0.3}
    return deck_text("block", {
        "mesh": {"type": "box", "cell": "tri6", "cells": [cells, cells], "upper": [1.0, 1.0]},
        "materials": {"soil": {"void ratio": 0.8, "skeleton": skeleton}},
        "physics": {"ground": {"type": "solid"}},
        "boundary conditions": {"bottom": {"type": "fixed", "set": "bottom"},
                                "load": {"type": "pressure", "set": "top", "value": "1e3 * (t / 20)^6"}},
        "mesh motion": {},
        "stages": {"load": {"type": "quasi-static", "duration": 20.0, "time step": {"initial": 1.0, "maximum": 1.0}}},
        "output": {"error estimate": True, "target error": 0.008}})


def front():
    """Soft clay, normally consolidated, under three times its stress: after 23 days a front some three elements thick has entered."""
    skeleton = {"type": "modified cam clay", "critical stress ratio": 0.9, "compression slope": 0.3, "swelling slope": 0.05, "Poisson's ratio": 0.25}
    return deck_text("front", {
        "mesh": {"type": "box", "cell": "tri6", "cells": [8, 8], "upper": [1.0, 1.0], "distortion": 0.2},
        "materials": {"soil": {"void ratio": 1.9, "skeleton": skeleton, "fluid": {"type": "water", "incompressible": True},
                               "permeability": {"type": "constant", "hydraulic conductivity": 1.5e-9}}},
        "physics": {"ground": {"type": "biot", "initial state": {
            "type": "uniform", "effective stress yy": 20e3, "effective stress xx": 13e3, "effective stress zz": 13e3, "overconsolidation ratio": 1.0}}},
        "boundary conditions": {"base": {"type": "fixed", "set": "bottom", "components": "y"},
                                "left side": {"type": "fixed", "set": "left", "components": "x"},
                                "right side": {"type": "fixed", "set": "right", "components": "x"},
                                "drained": {"type": "pore pressure", "set": "top"},
                                "load": {"type": "pressure", "set": "top", "value": 60e3}},
        "stages": {"consolidation": {"type": "quasi-static", "duration": 2e6, "integrator": {"type": "theta", "theta": 1.0},
                                     "time step": {"initial": 5e3, "growth": 1.1, "maximum": 5e4}}}})


@problem("consistency", title="Remeshing in the plane")
class Remeshing(MudlineCase):
    def test_a_front_three_elements_thick_is_not_worn_down(self):
        """Remeshed every four steps. (By a single recovery: 2.9 % less water flowed out, the surface was uneven by 4.1 % of the settlement.)"""
        still = self.run_deck(self.write("front.xml", front()))
        moved = self.run_deck([self.write("front.xml", front()), self.write("remeshing.xml", remeshing(4))])
        self.assertGreater(moved["mesh/remeshings"][-1], 8)
        self.compare("outflow", abs(moved["balance/water/outflow"][-1] / still["balance/water/outflow"][-1] - 1),
                     0.016)
        with h5py.File(os.path.join(self.folder, "results", "front.h5")) as file:
            last = file["steps"][sorted(file["steps"])[-1]]
            y, pressure = last["coordinates"][:, 1], last["nodal/pore_pressure"][:].ravel()
        surface = y[(y > 0.9) & (pressure == 0)]
        self.assertGreater(len(surface), 10)
        self.compare("uneven surface", np.ptp(surface) / (1 - surface.mean()), 0.028)

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
            self.compare(f"stress {column}", np.abs(stress[:, column] - value).max() / 5e4, 1e-12)
        self.assertLess(displacement, 1e-12)
        self.compare("change of solid", np.abs(history["mesh motion/change of solid"]).max(), 1e-13)

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
            self.compare(name, error, 1e-3)
        self.compare("change of solid", np.abs(moved["mesh motion/change of solid"]).max(), 1e-11)
        self.compare("change of water", np.abs(moved["mesh motion/change of water"]).max(), 1e-10)

    @problem("consistency")
    def test_sizes_from_the_error_estimate(self):
        sizes = {"when side above": 1.3, "size": "adaptive", "smallest size": 0.005, "largest size": 0.3}
        adaptive = self.write("remeshing.xml", remeshing(3, sizes))
        found = self.run_deck([self.write("block.xml", block(8)), adaptive], ("output/name=adaptive",), name="adaptive")
        elements = found["mesh/elements"][-1]
        self.assertGreaterEqual(found["mesh/remeshings"][-1], 2)
        self.assertLess(elements, 2 * 12 * 12)  # of a uniform mesh with more elements
        uniform = self.run_deck(self.write("uniform.xml", block(12)), name="uniform")
        fine = self.run_deck(self.write("fine.xml", block(40)), name="fine")
        self.assertLess(found["mesh/stress error"][-1], 0.5 * uniform["mesh/stress error"][-1])
        self.compare("estimated error of the stress", found["mesh/stress error"][-1], 0.008)  # the target
        # a mesh is too stiff: the energy tells of the true error
        work = [run["balance/energy/stress divergence"][-1] for run in (found, uniform, fine)]
        self.assertLess(abs(work[0] - work[2]), 0.3 * abs(work[1] - work[2]))
        with h5py.File(os.path.join(self.folder, "results", "adaptive.h5")) as file:
            last = file["steps"][sorted(file["steps"])[-1]]
            corners = last["mesh/coordinates"][:][:, :2]
        # vertices within a tenth of a corner against all others: they stand in 1.6 % of the block
        near = np.minimum(np.hypot(corners[:, 0], corners[:, 1]), np.hypot(corners[:, 0] - 1, corners[:, 1])) < 0.1
        self.assertGreater(near.mean(), 0.25)

    @problem("behaviour")
    def test_sizes_that_cannot_be_found_are_refused(self):
        sizes = {"size": "adaptive", "smallest size": 0.005, "largest size": 0.3}
        deck = self.write("block.xml", block(4))
        for more, expected in (
            ({**sizes, "largest size": 0.001}, "must not be smaller than the smallest size, 0.005 m"),
            ({"smallest size": 0.001}, "smallest size"),
            ({"size": "adaptive", "smallest size": 0.005}, "largest size"),
        ):
            overlay = self.write("remeshing.xml", remeshing(3, more))
            done = program(["run", "-q", deck, overlay], folder=self.folder)
            errors = [line for line in done.stderr.splitlines() if line.startswith("error:")]
            self.assertEqual((done.returncode, len(errors)), (2, 1), done.stderr)
            self.assertIn(expected, errors[0])


@problem("exact", "what the transfer must keep: grains, water, momentum", "A ball on a remeshed region")
class Ball(MudlineCase):
    """A ball pushed dynamically into saturated clay, on triangles that are remeshed every five steps."""

    def setUp(self):
        super().setUp()
        self.deck = self.write("ball.xml", ball())
        self.overlay = self.write("remeshing.xml", remeshing(5, WALL, FOCUS))

    def run_ball(self, name, *extra, ranks=1):
        return self.run_deck([self.deck, self.overlay], (f"output/name={name}",), ranks, extra, name=name)

    def content(self, name, ending=".csv"):
        with open(os.path.join(self.folder, "results", name + ending), "rb") as file:
            return file.read()

    def test_what_is_conserved(self):
        # nothing but the remeshings moves the mesh
        moved = self.run_deck([self.deck, self.overlay], ("output/name=whole", "mesh motion/every=1000000"), name="whole")
        self.assertGreaterEqual(moved["mesh/remeshings"][-1], 3)
        self.compare("change of solid", np.abs(moved["mesh motion/change of solid"]).max(), 1e-12)
        self.compare("change of water", np.abs(moved["mesh motion/change of water"]).max(), 1e-11)
        momentum = np.abs(moved["balance/momentum/change y"]).max()
        for axis in "xy":
            self.compare(f"change of momentum {axis}",
                         np.abs(moved[f"mesh motion/change of momentum {axis}"]).max() / momentum, 1e-12)
        kinetic = moved["mesh motion/change of kinetic energy"]
        self.assertLess(np.diff(kinetic).max(), 1e-12 * np.abs(moved["balance/energy/kinetic"]).max())
        self.assertLess(kinetic[-1], 0)

    @problem("consistency")
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

    @problem("behaviour")
    def test_a_restart_between_stages_and_what_a_stage_dissipates(self):
        """The ball is held behind its push; the region is remeshed in both stages. The run that has only the push, and goes on with the
        second stage behind a restart, is the run of both, bit for bit, and both say how far the pressures on the wall have fallen."""
        held = self.write("held.xml", deck_text("held", {"stages": {"held": {
            "type": "quasi-static", "duration": 1e3, "motions": {"ball": {"type": "held"}},
            "conditions": ["base", "axis", "far side", "drained surface", "surcharge"],
            "time step": {"initial": 1.0, "growth": 2.0}}}}))
        said = {}
        for name, decks in (("both", [held]), ("part", []), ("part", [held, "--restart"])):
            done = program(["run", self.deck, self.overlay, *decks, "--set", f"output/name={name}"], folder=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            said[name] = done.stdout
        self.assertEqual(self.content("part"), self.content("both"))
        both = History(os.path.join(self.folder, "results", "both.csv"))
        self.assertGreater(both["mesh/remeshings"][-1], both.at("mesh/remeshings", 0.005))
        for log in said.values():
            self.assertRegex(log, r"contact 'ball on clay': excess pore pressure on the wall [0-9.]+ -> [0-9.]+ kPa")

    @problem("consistency")
    def test_sizes_from_the_error_estimate_on_ranks_and_behind_a_restart(self):
        self.overlay = self.write("remeshing.xml", remeshing(5, {**WALL, **ADAPTIVE}, FOCUS, ESTIMATE))
        runs = {ranks: self.run_ball(f"whole{ranks}", ranks=ranks) for ranks in (1, 3)}
        self.assertGreaterEqual(runs[1]["mesh/remeshings"][-1], 2)
        # before the ball touches the clay the flow is rounding, and so is its error
        names = [name for name in runs[1].columns
                 if name.startswith(("contact/", "balance/water", "body/", "mesh/")) and name != "mesh/flow error"]
        estimates = [name for name in names if name.endswith("error")]  # small differences of what agrees to 1e-8
        answers = [name for name in names if name not in estimates]
        self.assert_same_run(runs[1], runs[3], answers, "3 ranks")
        self.assert_same_run(runs[1], runs[3], estimates, "3 ranks", rounding=1e-6)
        self.run_ball("part", "--steps", "7")  # behind a remeshing
        results = os.path.join(self.folder, "results")
        shutil.copytree(results, results + " of one rank")
        self.assert_same_run(runs[1], self.run_ball("part", "--restart", ranks=2), answers, "restart on 2 ranks")
        shutil.rmtree(results)
        os.rename(results + " of one rank", results)
        self.run_ball("part", "--restart")
        self.assertEqual(self.content("part"), self.content("whole1"))

    @problem("behaviour")
    def test_what_cannot_be_carried_over_is_refused(self):
        for overlay, expected in (
            ({"output": {"probes": {"tip": [0.0, 0.3]}}}, "a node is lost when the mesh is remeshed"),
            ({"boundary conditions": {"far": {"type": "absorbing", "set": "right"}}},
             "the state 'absorbing/far' has parts of a sum at nodes that a remeshing would move; name their set in boundary/material sides"),
            ({"mesh motion": {"remeshing": ADAPTIVE}},
             "'adaptive' takes the sizes from the error estimate; it needs output/error estimate = true"),
            ({"mesh": {"cell": "quad9"}}, "the mesh has cells quad9; only meshes of triangles (tri3, tri6) and tetrahedra (tet4, tet10) can be remeshed"),
        ):
            more = self.write("more.xml", deck_text("more", overlay))
            done = program(["run", "-q", self.deck, self.overlay, more], folder=self.folder)
            errors = [line for line in done.stderr.splitlines() if line.startswith("error:")]
            self.assertEqual((done.returncode, len(errors)), (2, 1), done.stderr)
            self.assertIn(expected, errors[0])


if __name__ == "__main__":
    unittest.main()
