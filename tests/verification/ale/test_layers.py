"""Layers whose boundaries are no mesh lines: every point has its material, which goes with the soil.

The references do not come from the program: settlements are sums over the layers, q h / M each; the consolidation of a layered
column is integrated by finite volumes here; a mesh that moves must change nothing."""
import os
import re
import unittest

import h5py
import numpy as np

from compared_case import problem
from mudline_case import History, MudlineCase, deck_text, program
from remeshed_ball import remeshing
from swinging_mesh import swinging_mesh

SOFT, STIFF = 1e6, 4e6  # [Pa] confined moduli
LOAD = 10.0  # [Pa]
ROW = 8 / 18 / 40 / 0.47  # share of the thinner layer that a row of points of 40 cells may have
INTERFACE = 0.528  # [m] of 1 m; no multiple of what follows, near points of 40 cells

SWING = swinging_mesh(0.2, 7)


def soil(modulus, conductivity=None, ratio=1.0, top=None):
    poisson = 0.25
    young = modulus * (1 + poisson) * (1 - 2 * poisson) / (1 - poisson)
    entry = {"void ratio": ratio, "skeleton": {"type": "linear elastic", "Young's modulus": young, "Poisson's ratio": poisson}}
    if top is not None:
        entry["top"] = top
    if conductivity:
        entry["fluid"] = {"type": "water", "incompressible": True}
        entry["permeability"] = {"type": "constant", "hydraulic conductivity": conductivity}
    return entry


PROBES = {"top": [0.0, 1.0], "base": [0.0, 0.0]}


def column(cells, materials, physics, extra, stages, columns=1, cell="quad9", probes=PROBES):
    return deck_text("layers", {
        "mesh": {"type": "box", "cell": cell, "cells": [columns, cells], "upper": [0.2, 1.0]},
        "materials": materials,
        "physics": {"ground": physics},
        "boundary conditions": {
            "sides": {"type": "fixed", "set": "left", "components": "x"},
            "other side": {"type": "fixed", "set": "right", "components": "x"},
            "base": {"type": "fixed", "set": "bottom"}, **extra},
        "stages": stages,
        "solver": {"residual tolerance": 1e-9},
        "output": {"probes": probes} if probes else {}})


def consolidation(times, k_upper, k_lower, cells=400):
    """Settlement of the drained top and pressure at the base of a two-layer column under a sudden load, small strains."""
    gamma, h = 9.81e3, 1.0 / cells
    y = (np.arange(cells) + 0.5) * h
    stiffness = np.where(y > INTERFACE, SOFT, STIFF)
    mobility = np.where(y > INTERFACE, k_upper, k_lower) / gamma
    between = 1 / (0.5 * h * (1 / mobility[:-1] + 1 / mobility[1:]))
    top = mobility[-1] / (0.5 * h)
    flow = np.diag(np.r_[between, top] + np.r_[0.0, between]) - np.diag(between, 1) - np.diag(between, -1)
    rate = stiffness[:, None] * flow / h
    root = np.sqrt(stiffness)
    values, vectors = np.linalg.eigh(rate * root[None, :] / root[:, None])
    amplitude = vectors.T @ (np.full(cells, LOAD) / root)
    pressures = np.array([root * (vectors @ (np.exp(-values * t) * amplitude)) for t in times])
    return (h * (LOAD - pressures) / stiffness).sum(axis=1), pressures[:, 0]


@problem("exact", "sum of q h / M over the layers", "Layers without mesh lines")
class Layers(MudlineCase):
    def test_settlement_is_the_sum_over_the_layers(self):
        """An element that the interface crosses cannot bend as sharply as the soil: the error is less than if it were all of
        one soil or the other, and falls with its size."""
        exact = LOAD * ((1 - INTERFACE) / SOFT + INTERFACE / STIFF)
        for cells in (5, 10, 40):
            deck = self.write("column.xml", column(
                cells, {"upper": soil(SOFT), "lower": soil(STIFF, top=INTERFACE)}, {"type": "solid"},
                {"load": {"type": "traction", "set": "top", "y": -LOAD}},
                {"load": {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 1.0}}}))
            found = -self.run_deck(deck)["probe/top/displacement y"][-1]
            self.compare(f"settlement, {cells} cells", abs(found - exact),
                         LOAD * (1 / SOFT - 1 / STIFF) / cells * 0.5)

    def consolidate(self, cells, more=None, columns=1, duration=60.0, **run):
        deck = self.write("column.xml", column(
            cells, {"upper": soil(SOFT, 1e-5, 1.5), "lower": soil(STIFF, 4e-6, 0.7, INTERFACE)}, {"type": "biot"},
            {"load": {"type": "traction", "set": "top", "y": -LOAD}, "drain": {"type": "pore pressure", "set": "top", "value": 0.0}},
            {"run": {"type": "quasi-static", "duration": duration,
                     "time step": {"initial": 0.05, "maximum": 1.0, "growth": 1.1}}}, columns))
        return self.run_deck([deck] + ([self.write("swing.xml", deck_text("swing", more))] if more else []), **run)

    @problem("benchmark", "finite volumes in the test")
    def test_consolidation_of_two_layers(self):
        history = self.consolidate(40)
        later = history.time > 5
        settlement, pressure = consolidation(history.time[later], 1e-5, 4e-6)
        self.compare("settlement",
                     np.abs(-history["probe/top/displacement y"][later] - settlement).max() / settlement.max(), 0.01)
        self.compare("pressure at the base",
                     np.abs(history["probe/base/pore pressure"][later] - pressure).max() / LOAD, 0.01)

    @problem("consistency")
    def test_a_swinging_mesh_changes_nothing(self):
        still = self.consolidate(40, columns=2)
        moved = self.consolidate(40, SWING, columns=2)
        self.assertGreater(np.ptp(moved["mesh/quality"]), 0.02)  # it does swing
        self.assertGreater(moved["mesh motion/points of another material"][-1], 20)
        self.assertEqual(moved["mesh motion/laws started anew"][-1], 0)
        for name in ("probe/top/displacement y", "probe/base/pore pressure"):
            scale = np.abs(still[name]).max()
            self.compare(name, np.abs(moved.at(name, still.time) - still[name]).max() / scale, 1e-3)
        for name in ("upper", "lower"):
            grains = moved["balance/grains/" + name]
            self.compare("grains of " + name, np.abs(grains / grains[0] - 1).max(), 1e-12)
            # the volume of a layer's points is that of the layer to a row of points
            self.compare("put back to " + name, np.abs(moved["mesh motion/restored grains of " + name]).max(), ROW)
        with h5py.File(os.path.join(self.folder, "results", "column.h5")) as file:
            last = file["steps"][sorted(file["steps"])[-1]]
            nodes = last["coordinates"][:, 1]
            ratio, material = last["cell/void_ratio"][:].ravel(), last["cell/material"][:].ravel()
            start = last["cell/place_at_the_start"][:]
        self.assertLess(nodes.min(), 1e-9)
        upper = start[:, 1] > INTERFACE + 1.0 / 40
        lower = start[:, 1] < INTERFACE - 1.0 / 40
        self.assertTrue((material[upper] == 0).all() and (material[lower] == 1).all())
        # nothing of one layer's void ratio gets into the other's: it stays even, but for strains of 1e-5
        for name, cells, started in (("above", upper, 1.5), ("below", lower, 0.7)):
            self.compare("spread of the void ratio " + name, np.ptp(ratio[cells]), 1e-3)
            self.compare("void ratio " + name, abs(ratio[cells].mean() - started) / (1 + started), ROW)

    @problem("consistency")
    def test_layers_on_ranks_and_after_a_restart(self):
        def swing(name, ranks=1, extra=()):
            settings = ["output/name=" + name, "output/checkpoint steps=10"]
            return self.consolidate(40, SWING, 2, 8.0, settings=settings, ranks=ranks, extra=extra, name=name)

        def content(name):
            with open(os.path.join(self.folder, "results", name + ".csv"), "rb") as file:
                return file.read()

        one = swing("one")
        self.assertGreater(one["mesh motion/points of another material"][-1], 5)
        names = [name for name in one.columns if re.match("probe/.*(y|pressure)$|balance/grains|mesh motion/points|mesh/quality", name)]
        self.assertGreater(len(names), 6)
        for ranks in (2,):
            self.assert_same_run(one, swing(f"on{ranks}", ranks), names, f"{ranks} ranks")
        swing("parts", 2, ["--steps", "10"])
        self.assertNotEqual(content("parts"), content("on2"))
        swing("parts", 2, ["--restart"])
        self.assertEqual(content("parts"), content("on2"))

    @problem("consistency")
    def test_layers_go_over_to_other_meshes(self):
        def consolidate(more=None):
            deck = self.write("column.xml", column(
                24, {"upper": soil(SOFT, 1e-5, 1.5), "lower": soil(STIFF, 4e-6, 0.7, INTERFACE)}, {"type": "biot"},
                {"load": {"type": "traction", "set": "top", "y": -LOAD}, "drain": {"type": "pore pressure", "set": "top", "value": 0.0}},
                {"run": {"type": "quasi-static", "duration": 30.0, "time step": {"initial": 0.05, "maximum": 1.0, "growth": 1.1}}},
                columns=4, cell="tri6", probes={}))
            return self.run_deck([deck] + ([self.write("remeshing.xml", more)] if more else []))

        still, moved = consolidate(), consolidate(remeshing(12))
        self.assertGreaterEqual(moved["mesh/remeshings"][-1], 3)
        self.assertEqual(moved["mesh motion/laws started anew"][-1], 0)
        scale = np.abs(still["balance/water/outflow"]).max()
        self.compare("water that flowed out",
                     np.abs(moved.at("balance/water/outflow", still.time)
                            - still["balance/water/outflow"]).max() / scale, 2e-3)
        for name in ("upper", "lower"):
            grains = moved["balance/grains/" + name]
            self.compare("grains of " + name, np.abs(grains / grains[0] - 1).max(), 1e-12)
        with h5py.File(os.path.join(self.folder, "results", "column.h5")) as file:
            last = file["steps"][sorted(file["steps"])[-1]]
            ratio, material = last["cell/void_ratio"][:].ravel(), last["cell/material"][:].ravel()
            start = last["cell/place_at_the_start"][:]
        for name, cells, number, started in (("above", start[:, 1] > INTERFACE + 1 / 24, 0, 1.5), ("below", start[:, 1] < INTERFACE - 1 / 24, 1, 0.7)):
            self.assertGreater(cells.sum(), 20)
            self.assertTrue((material[cells] == number).all())
            self.compare("void ratio " + name, np.abs(ratio[cells] - started).max() / (1 + started), ROW)


@problem("behaviour", title="A layer that starts anew")
class StartsAnew(MudlineCase):
    def test_it_is_told_once_and_counted(self):
        """A wedge that runs out to nothing: no point is in its thin end at the start. A mesh that swings through it brings points there which
        have no soil of the wedge within an element; their laws start again from stress and void ratio."""
        wedge = "0.5+0.04*x"
        deck = self.write("wedge.xml", deck_text("wedge", {
            "mesh": {"type": "box", "cell": "quad9", "cells": [10, 10], "upper": [1.0, 1.0]},
            "materials": {"upper": soil(SOFT), "wedge": soil(STIFF, top=wedge), "lower": soil(SOFT, top=0.5)},
            "physics": {"ground": {"type": "solid"}},
            "boundary conditions": {"base": {"type": "fixed", "set": "bottom"}, "load": {"type": "traction", "set": "top", "y": -LOAD}},
            **SWING, "stages": {"swing": {"type": "quasi-static", "duration": 3.5, "time step": {"initial": 0.25, "maximum": 0.25}}}}))
        done = program(["run", deck], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        history = History(os.path.join(self.folder, "results", "wedge.csv"))
        anew = history["mesh motion/laws started anew"]
        self.assertGreater(anew[-1], 0)
        told = re.findall(r"^warning: laws start anew at (\d+) points where the soil has become another one, the first of material '(\w+)' at \(.*\), at t (\S+) s: "
                          r"no soil of that material was within an element", done.stderr, re.MULTILINE)
        self.assertEqual(len(told), 1, done.stderr)
        first = int(np.argmax(anew > 0))
        points, material, time = told[0]
        self.assertEqual((int(points), material), (int(anew[first]), "wedge"))
        self.assertAlmostEqual(float(time), history.time[first], delta=1e-5)


CLAYS = {  # void ratio, critical stress ratio, slopes, Poisson's ratio, conductivity
    "soft": (1.9, 0.9, 0.3, 0.05, 0.25, 1.5e-9),
    "stiff": (1.0, 1.1, 0.1, 0.02, 0.3, 8e-9)}
TOP_OF_SOFT = 1.19  # [m] of 2 m


@problem("exact", "swelling line of Cam Clay on each point's own stress path", "Flat elements in layered clay")
class FlatElements(MudlineCase):
    """Two overconsolidated clays under 120 kPa more, elements up to 14 times as wide as high. Both stay elastic: their preconsolidation is what it
    was, and at the end every point of a layer has the void ratio that the swelling line gives for its own stress path, as on a mesh that goes with the soil."""

    def consolidate(self, cells, moves, name):
        def clay(key):
            ratio, critical, compression, swelling, poisson, conductivity = CLAYS[key]
            return {"void ratio": ratio,
                    "skeleton": {"type": "modified cam clay", "critical stress ratio": critical, "compression slope": compression,
                                 "swelling slope": swelling, "Poisson's ratio": poisson},
                    "fluid": {"type": "water", "incompressible": True, "unit weight": 9810.0},
                    "permeability": {"type": "constant", "hydraulic conductivity": conductivity}}

        deck = self.write(name + ".xml", deck_text(name, {
            "mesh": {"type": "box", "cell": "quad9", "cells": [2, cells], "upper": [0.4, 2.0], "grading": [1.0, 0.4]},
            "materials": {"soft": {**clay("soft"), "top": TOP_OF_SOFT}, "stiff": clay("stiff")},
            "physics": {"ground": {"type": "biot", "initial state": {
                "type": "uniform", "effective stress yy": 20e3, "effective stress xx": 13e3, "effective stress zz": 13e3,
                "overconsolidation ratio": 12.0}}},
            "boundary conditions": {
                "base": {"type": "fixed", "set": "bottom", "components": "y"},
                "left side": {"type": "fixed", "set": "left", "components": "x"},
                "right side": {"type": "fixed", "set": "right", "components": "x"},
                "drained": {"type": "pore pressure", "set": "top"},
                "load": {"type": "pressure", "set": "top", "value": 120e3}},
            "mesh motion": {},
            "stages": {"consolidation": {"type": "quasi-static", "duration": 8e7, "mesh motion": moves,
                                         "time step": {"initial": 8e3, "growth": 1.3, "maximum": 2e6}}}}))
        history = self.run_deck(deck, name=name)
        with h5py.File(os.path.join(self.folder, "results", name + ".h5")) as file:
            last = file["steps"][sorted(file["steps"])[-1]]
            columns = [last["cell/" + key][:] for key in ("void_ratio", "preconsolidation_pressure", "material")]
            place = last["cell/place_at_the_start"][:, 1]
        return history, place, [column.ravel() for column in columns]

    def test_void_ratios_and_preconsolidation_of_each_layer(self):
        for cells in (20, 40, 80):
            _, there, (still, pressures, _) = self.consolidate(cells, False, "still")
            history, place, (ratio, preconsolidation, material) = self.consolidate(cells, True, "moved")
            self.assertGreater(history["mesh motion/points of another material"][-1], 5)
            self.assertEqual(history["mesh motion/laws started anew"][-1], 0)
            for number, away in ((0, TOP_OF_SOFT - place), (1, place - TOP_OF_SOFT)):
                own = away > 1.6 / cells  # no element that the interface cuts
                here = there[:, None] - TOP_OF_SOFT > 1.6 / cells if number else TOP_OF_SOFT - there[:, None] > 1.6 / cells
                self.assertTrue((material[own] == number).all())
                e, p = still[here.ravel()].mean(), pressures[here.ravel()].mean()
                self.compare(f"void ratio, {cells} cells, layer {number}", np.abs(ratio[own] - e).max() / (1 + e),
                             0.02 / cells)
                self.compare(f"preconsolidation, {cells} cells, layer {number}",
                             np.abs(preconsolidation[own] / p - 1).max(), 2e-3)
            for name in ("soft", "stiff"):
                grains = history["balance/grains/" + name]
                self.compare("grains of " + name, np.abs(grains / grains[0] - 1).max(), 1e-12)
                self.compare("unresolved of " + name,
                             np.abs(history["mesh motion/unresolved grains of " + name]).max(), 0.4 / cells)


if __name__ == "__main__":
    unittest.main()
