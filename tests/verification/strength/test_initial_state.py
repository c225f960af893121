"""Geostatic start of layers, and of a slope under gravity that grows."""
import os
import unittest

import h5py
import numpy as np
from scipy.optimize import brentq

from compared_case import problem
from mudline_case import deck_text, program
from strength_case import StrengthCase

G, WATER = 9.81, 1000 * 9.81
# bottom and top [m], porosity, grain density of the layers in inputs/initial_state/layers.xml
LAYERS = ((-2, 0, 0.4, 2650), (-5, -2, 0.6, 2700), (-6, -5, 0.3, 2650))


def vertical(y):
    """Effective vertical stress [Pa], by integration of each layer's weight; above the water level there is suction."""
    total = 10e3
    for bottom, top, porosity, grains in LAYERS:
        total += ((1 - porosity) * grains + porosity * 1000) * G * max(top - max(y, bottom), 0)
    return total - WATER * (-1 - y)


def overconsolidation(y):
    return 1 + 50e3 / vertical(y)


def horizontal(y):
    sine = np.sin(np.radians(35 if y > -2 else 25))
    return (1 - sine) * overconsolidation(y) ** sine * vertical(y)


def mean_over_cell(function, y, height, points):
    """The mean that fields show, of the values at three rows of points, not weighted."""
    return sum(w * function(y + 0.5 * height * x) for x, w in points)


POINTS = tuple((x, 1 / 3) for x in (-np.sqrt(0.6), 0.0, np.sqrt(0.6)))


def components(step):
    """xx yy zz xy of the mean effective stress of cells, compression positive; the file has xx xy xz yy yz zz."""
    return -step["effective_stress"][:][:, [0, 3, 5, 1]]


def layer_fields(folder):
    """Height, effective stress and preconsolidation pressure of the cells of the layers at the end."""
    with h5py.File(os.path.join(folder, "results", "layers.h5"), "r") as file:
        cells = file["mesh/topology"][:].reshape(-1, 10)[:, 1:]
        y = file["mesh/coordinates"][:, 1][cells[:, :4]].mean(axis=1)
        step = file["steps"][sorted(file["steps"])[-1]]["cell"]
        return y, components(step), step["preconsolidation_pressure"][:].ravel()


@problem("exact", "weight of the layers", "Geostatic start of layers")
class Layers(StrengthCase):
    def stress(self, settings=()):
        self.run_deck(self.deck("initial_state", "layers"), settings)
        return layer_fields(self.folder)

    def test_stress_of_layers_with_a_lost_overburden(self):
        y, stress, preconsolidation = self.stress()
        for i, height in enumerate(y):
            self.compare("vertical stress", abs(stress[i, 1] / vertical(height) - 1), 1e-6)
            for c in (0, 2):
                self.compare(f"horizontal stress {c}",
                             abs(stress[i, c] / mean_over_cell(horizontal, height, 0.5, POINTS) - 1), 1e-6)
            self.compare("shear stress [Pa]", abs(stress[i, 3]), 1e-6)

        def through(depth):  # the surface through the initial stress, M = 1
            v, h = vertical(depth), horizontal(depth)
            p, q = (v + 2 * h) / 3, v - h
            return overconsolidation(depth) * (p + q * q / p)
        clay = (y > -5) & (y < -2)
        self.assertEqual(clay.sum(), 12)
        for height, value in zip(y[clay], preconsolidation[clay]):
            self.compare("value", abs(value / mean_over_cell(through, height, 0.5, POINTS) - 1), 1e-6)

    @problem("behaviour")
    def test_both_ways_to_say_the_same_are_refused(self):
        for settings, what in ((("K0=0.5",), "give either this or 'K0'"),
                               (("overconsolidation ratio=2",), "give either this or 'overconsolidation ratio'"),
                               (("preoverburden pressure=-1e3",),
                                "preoverburden pressure: -1000 is out of range; allowed: [0, inf)"),
                               (("K0 friction angle [deg]=90",),
                                "K0 friction angle [deg]: 90 is out of range; allowed: [0, 90)")):
            arguments = ["run", "-q", self.deck("initial_state", "layers")]
            for setting in settings:
                arguments += ["--set", "physics/ground/initial state/" + setting]
            done = program(arguments, 1, self.folder)
            self.assertEqual(done.returncode, 2, what)
            self.assertIn(what, done.stderr)


@problem("exact", "M/2 p (pc/2p)^Lambda", "Start from the undrained strength")
class FromStrength(StrengthCase):
    """The clay between sand and gravel by its undrained strength, M/2 p (pc/2p)^Lambda, or by that over the vertical
    stress."""
    START = "physics/ground/initial state/"

    def layers(self, entry, value):
        with open(self.deck("initial_state", "layers"), encoding="utf-8") as file:
            text = file.read()
        lost = '<Parameter name="preoverburden pressure" type="double" value="50e3"/>'
        self.assertIn(lost, text)
        found = f'<Parameter name="{entry}" type="string" value="{value}"/>'
        return self.write("layers.xml", text.replace(lost, found))

    def preconsolidation(self, y, strength):
        """pc [Pa] for which the clay has this strength at the height y."""
        def state(ratio):
            sine, v = np.sin(np.radians(25)), vertical(y)
            h = (1 - sine) * ratio ** sine * v
            p, q = (v + 2 * h) / 3, v - h
            return p, ratio * (p + q * q / p)

        def lacks(ratio):
            p, pc = state(ratio)
            return 0.5 * p * (pc / (2 * p)) ** 0.8 / strength(y) - 1

        return state(brentq(lacks, 1.0, 100.0, xtol=1e-13))[1]

    def test_strength_and_its_ratio(self):
        for entry, value, strength in (
                ("undrained strength", "5e3 - 4e3*y", lambda y: 5e3 - 4e3 * y),
                ("undrained strength ratio", "0.4 + 0.02*y", lambda y: (0.4 + 0.02 * y) * vertical(y))):
            for ranks in (1, 2):
                self.run_deck(self.layers(entry, value), ranks=ranks, extra=("--overwrite",))
                y, _, found = layer_fields(self.folder)
                clay = (y > -5) & (y < -2)
                self.assertEqual(clay.sum(), 12)
                for height, pc in zip(y[clay], found[clay]):
                    exact = mean_over_cell(lambda at: self.preconsolidation(at, strength), height, 0.5, POINTS)
                    self.compare("preconsolidation pressure", abs(pc / exact - 1), 1e-6)

    @problem("behaviour")
    def test_refusals(self):
        deck = self.layers("undrained strength", "20e3")
        for settings, words in (
                (("undrained strength=1e3",),
                 "an undrained strength of 1000 Pa is less than that of normally consolidated soil, "),
                (("undrained strength=-1e3",), "undrained strength: -1e3 is out of range; allowed: (0, inf)"),
                (("undrained strength=1e3*y",),
                 "undrained strength: the value of '1e3*y' is -"),
                (("undrained strength=9e9",), "what the strength of 'modified cam clay' under sigma'_v = "),
                (("overconsolidation ratio=2",),
                 "undrained strength: give either this or 'overconsolidation ratio', not both"),
                (("undrained strength ratio=0.3",),
                 "undrained strength ratio: give either this or 'undrained strength', not both"),
                (("type=uniform", "undrained strength ratio=0.3"), "give either this"),
                (("type=stress free",),
                 "without stress there is no overconsolidation; give the strength in 'skeleton'")):
            with self.subTest(settings=settings):
                arguments = [word for setting in settings for word in ("--set", self.START + setting)]
                done = program(["check", deck, *arguments], 1, self.folder)
                self.assertEqual(done.returncode, 2, done.stdout)
                self.assertIn(words, done.stderr)
                self.assertEqual(len(done.stderr.strip().splitlines()), 1)

    @problem("behaviour")
    def test_soils_whose_strength_is_another_matter(self):
        tresca = {"type": "tresca", "undrained strength": 1e4, "rigidity index": 100.0, "Poisson's ratio": 0.49}
        stress = {f"effective stress {axes}": 5e4 for axes in ("xx", "yy", "zz")}
        for skeleton, words in (
                ({"type": "linear elastic", "Young's modulus": 1e8, "Poisson's ratio": 0.3},
                 "undrained strength: no soil of this model has a law with an undrained strength"),
                (tresca, "the undrained strength of the law 'tresca' does not follow from an overconsolidation ratio")):
            deck = self.write("column.xml", deck_text("column", {
                "mesh": {"type": "box", "cell": "quad9", "cells": [1, 2], "upper": [1.0, 2.0]},
                "materials": {"clay": {"density": 1800.0, "skeleton": skeleton}},
                "physics": {"ground": {"type": "solid", "initial state": {
                    "type": "uniform", "undrained strength": 2e4, **stress}}},
                "boundary conditions": {"base": {"type": "fixed", "set": "bottom"}},
                "stages": {"wait": {
                    "type": "quasi-static", "duration": 1.0, "time step": {"initial": 1.0}}}}))
            done = program(["check", deck], 1, self.folder)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(words, done.stderr)


@problem("exact", "equilibrium with v of the compression line", "Void ratio from the law")
class VoidRatioFromLaw(StrengthCase):
    """v = N - lambda ln(pc/1 kPa) + kappa ln(pc/p') under water: d sigma'_v/d depth = (rho_s - rho_f) g/v. With v = A - lambda ln(sigma'_v),
    depth = [(A + lambda) sigma'_v - lambda sigma'_v ln(sigma'_v)] / ((rho_s - rho_f) g) from the surface on."""
    N, SLOPE, SWELLING, K0, R, M = 2.9, 0.2, 0.04, 0.6, 1.5, 1.0

    def volume(self, vertical, n=2.9):  # [kPa]
        p, q = vertical * (1 + 2 * self.K0) / 3, vertical * (1 - self.K0)
        pc = self.R * (p + q * q / (self.M ** 2 * p))
        return n - self.SLOPE * np.log(pc) + self.SWELLING * np.log(pc / p)

    def vertical(self, depth):
        A = self.volume(1.0)
        primitive = lambda s: ((A + self.SLOPE) * s - self.SLOPE * s * np.log(s)) * 1e3 / (1700 * G)
        return brentq(lambda s: primitive(s) - primitive(5.0) - depth, 1.0, 1e4, xtol=1e-12)

    def fields(self, settings=(), ranks=1):
        self.run_deck(self.deck("initial_state", "void_ratio_from_law"), settings, ranks)
        with h5py.File(os.path.join(self.folder, "results", "void_ratio_from_law.h5"), "r") as file:
            cells = file["mesh/topology"][:].reshape(-1, 10)[:, 1:]
            y = file["mesh/coordinates"][:, 1][cells[:, :4]]
            step = file["steps"][sorted(file["steps"])[-1]]["cell"]
            return y, components(step), step["void_ratio"][:].ravel()

    def check(self, settings=(), ranks=1):
        y, stress, void_ratio = self.fields(settings, ranks)
        for i in range(len(y)):
            middle, height = y[i].mean(), np.ptp(y[i])
            exact = mean_over_cell(lambda h: 1e3 * self.vertical(-h), middle, height, POINTS)
            self.compare("vertical stress", abs(stress[i, 1] / exact - 1), 1e-6)
            exact = mean_over_cell(lambda h: self.volume(self.vertical(-h)), middle, height, POINTS)
            self.compare("specific volume", abs(1 + void_ratio[i] - exact), 1e-6)

    def test_profile(self):
        self.check()
        self.check(ranks=2)

    def test_other_ways_to_give_the_line(self):
        """The critical state line, and a reference pressure of 100 kPa."""
        drop = (self.SLOPE - self.SWELLING) * np.log(2)
        base = "materials/clay/skeleton/"
        with open(self.deck("initial_state", "void_ratio_from_law")) as file:
            deck = file.read().replace("normal compression volume", "critical state volume")
        self.write("void_ratio_from_law.xml", deck)
        self.deck = lambda *_: "void_ratio_from_law.xml"
        self.check([base + f"critical state volume={self.N - drop - self.SLOPE * np.log(100)!r}", base + "reference pressure=100e3"])

    @problem("behaviour")
    def test_contradictions(self):
        for setting, what in (("void ratio=1.0", "with 'void ratio from law' there is no 'void ratio' or 'porosity'"),
                              ("skeleton/critical state volume=2.0", "give 'normal compression volume' or 'critical state volume', not both"),
                              ("skeleton/normal compression volume=1.2", "is not positive"),
                              ("skeleton/normal compression volume=0.5", "a specific volume is greater than 1")):
            done = program(["run", "-q", self.deck("initial_state", "void_ratio_from_law"), "--set", "materials/clay/" + setting], 1, self.folder)
            self.assertEqual(done.returncode, 2, what)
            self.assertIn(what, done.stderr)


@problem("exact", "weight of two columns", "Fresh water over brine")
class TwoFluids(StrengthCase):
    """Fresh water over brine, each in 5 m of soil, the water level 1 m above the surface: the weight of both columns counts."""
    GRAVITY, FRESH, BRINE, LEVEL = 10.0, 1000.0, 1200.0, 1.0

    def soil(self, region, density, alpha):
        return {"regions": [region], "void ratio": 1.0, "grain density": 2700.0, "Biot coefficient": alpha,
                "skeleton": {"type": "linear elastic", "Young's modulus": 1e7, "Poisson's ratio": 0.3},
                "fluid": {"type": "water", "density": density}, "permeability": {"type": "constant", "hydraulic conductivity": 1e-4}}

    def deck_of_two(self, layered=True, excess=False):
        start = {"type": "geostatic", "K0": 0.5, "surcharge": 5e3}
        if not excess:
            start["water level"] = self.LEVEL
        on_top = 0.0 if excess else self.FRESH * self.GRAVITY * self.LEVEL
        mesh = {"type": "box", "cell": "quad9", "cells": [2, 10], "lower": [0.0, -10.0], "upper": [2.0, 0.0]}
        if layered:
            mesh.update({"layer tops": [-5.0], "layer regions": ["deep", "shallow"]})
            if layered == "upside down":
                mesh["layer regions"] = ["shallow", "deep"]
        sides = {name: {"type": "fixed", "set": name, "components": "x"} for name in ("left", "right")}
        # the material of the deep region first: its Biot coefficient must not count at the surface
        return deck_text("fluids", {
            "mesh": mesh,
            "materials": {"a": self.soil("deep", self.BRINE, 0.8), "b": self.soil("shallow", self.FRESH, 1.0)},
            "physics": {"ground": {"type": "biot", "pore pressure": "excess" if excess else "total", "gravity": [0.0, -self.GRAVITY],
                                   "initial state": start}},
            "boundary conditions": {"base": {"type": "fixed", "set": "bottom"}, **sides,
                                    "water": {"type": "pore pressure", "set": "top", "value": on_top},
                                    "load": {"type": "pressure", "set": "top", "value": on_top + 5e3}},
            "stages": {"rest": {"type": "geostatic", "balance tolerance": 1e-9},
                       "wait": {"type": "quasi-static", "duration": 1e5, "time step": {"initial": 1e4}}},
            "output": {"probes": {"top": [1.0, 0.0], "interface": [1.0, -5.0], "base": [1.0, -10.0]}}})

    def test_the_start_is_in_balance_and_stays(self):
        for ranks in (1, 2):
            history = self.run_deck(self.write("fluids.xml", self.deck_of_two()), ranks=ranks)
            for place, pressure in (("top", 10e3), ("interface", 60e3), ("base", 120e3)):
                values = history[f"probe/{place}/pore pressure"]
                self.compare(f"{place}: pore pressure", np.abs(values - pressure).max() / pressure, 1e-6)
                self.compare(f"{place}: displacement [m]", np.abs(history[f"probe/{place}/displacement y"]).max(),
                             1e-9)  # 2.1 mm of heave once
            with h5py.File(os.path.join(self.folder, "results", "fluids.h5"), "r") as file:
                excess = file["steps"][sorted(file["steps"])[-1]]["nodal/excess_pore_pressure"][:]
            self.compare("excess pore pressure [Pa]", np.abs(excess).max(), 0.1)
            weight = 2.0 * (15e3 + 10 * 5 * (0.5 * 2700 + 0.5 * self.FRESH) + 10 * 5 * (0.5 * 2700 + 0.5 * self.BRINE))
            self.compare("weight", abs(history["reaction/base y"][-1] / weight - 1), 1e-6)

    def refused(self, deck, message):
        done = program(["check", self.write("fluids.xml", deck)], 1, self.folder)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn(message, done.stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1)

    @problem("behaviour")
    def test_excess_pressures_need_one_density(self):
        self.refused(self.deck_of_two(excess=True), "with 'pore pressure' = 'excess' all pore fluids have one density; it is 1000 kg/m3 "
                     "here and 1200 in 'a'")


@problem("exact", "K0 over the depth", "Profile of K0")
class Profile(StrengthCase):
    """K0 over the depth, 0.5 at the surface and 0.8 at 10 m: as an expression, as a profile in the deck and as one in a file."""
    CSV = "# a sounding\nz [m]; K0 [%] ; remark\n 0; 50; fill\n2.5;57.5;\n\n10;80;\n"

    def column(self, k0, profile=None):
        deck = {
            "mesh": {"type": "box", "cell": "quad9", "cells": [1, 10], "lower": [0.0, -8.0], "upper": [1.0, 2.0]},
            "materials": {"clay": {"density": 1800.0, "skeleton": {"type": "linear elastic", "Young's modulus": 1e8, "Poisson's ratio": 0.3}}},
            "physics": {"ground": {"type": "solid", "gravity": [0.0, -10.0], "initial state": {"type": "geostatic", "K0": k0}}},
            "boundary conditions": {"base": {"type": "fixed", "set": "bottom"},
                                    **{side: {"type": "fixed", "set": side, "components": "x"} for side in ("left", "right")}},
            "stages": {"rest": {"type": "geostatic"}, "wait": {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 1.0}}}}
        return deck_text("column", {**({"functions": {"k0 profile": {"type": "profile", **profile}}} if profile else {}), **deck})

    # as a spreadsheet writes it, with a byte order mark, and depths in centimetres
    SHEET = "\ufeffz [cm],K0 [-]\r\n0,0.5\r\n1000,0.8\r\n"

    def test_three_ways(self):
        self.write("sounding.csv", self.CSV)
        found = []
        for k0, profile in (("0.5 + 0.03*(2 - y)", None),
                            ("k0 profile", {"depths": [0.0, 10.0], "values": [0.5, 0.8], "surface": 2.0}),
                            ("k0 profile", {"file": "sounding.csv", "depth column": "z [m]", "value column": "K0 [%]", "factor": 0.01, "surface": 2.0})):
            history = self.run_deck(self.write("column.xml", self.column(k0, profile)), extra=["--overwrite"])
            found.append(history["reaction/left x"][-1])
            exact = 1800 * 10 * (0.5 * 10 ** 2 / 2 + 0.03 * 10 ** 3 / 3)
            self.compare("reaction of the side", abs(found[-1] / exact - 1), 1e-9)
        self.compare("spread over the three ways", np.ptp(found) / found[0], 1e-9)

    @problem("behaviour")
    def test_sheet(self):
        self.write("sheet.csv", self.SHEET)
        sheet = {"file": "sheet.csv", "depth column": "z [cm]", "value column": "K0 [-]", "surface": 2.0}
        lists = {"depths": [0.0, 10.0], "values": [0.5, 0.8], "surface": 2.0}
        found = []
        for profile in (sheet, lists):
            deck = self.write("column.xml", self.column("k0 profile", profile))
            found.append(self.run_deck(deck, extra=["--overwrite"])["reaction/left x"][-1])
        self.assertEqual(found[0], found[1])

    @problem("behaviour")
    def test_refusals(self):
        columns = {"file": "sounding.csv", "depth column": "z [m]", "value column": "K0 [%]"}
        lists = {"depths": [0.0, 10.0], "values": [0.5, 0.8]}
        for profile, csv, words in (
                (lists | columns, self.CSV, "functions/k0 profile/file: give either 'depths' and 'values' or a 'file' with its two columns"),
                ({}, self.CSV, "give either 'depths' and 'values' or a 'file' with its two columns"),
                ({**lists, "values": [0.5]}, self.CSV, "functions/k0 profile/values: 2 depths and 1 values; as many of each are needed, at least one"),
                ({**lists, "depths": [0.0, 0.0]}, self.CSV, "functions/k0 profile/depths: depths must increase strictly: 0 after 0 (row 2)"),
                ({"file": "sounding.csv", "depth column": "z [m]"}, self.CSV, "functions/k0 profile/file: a file needs a 'value column'"),
                ({**lists, "depth column": "z"}, self.CSV, "functions/k0 profile/depth column: without 'file' there are no columns"),
                ({**columns, "value column": "K0[%]"}, self.CSV, "sounding.csv:2: there is no column 'K0[%]' (did you mean 'K0 [%]'?)"),
                (columns, self.CSV.replace("57.5", "57,5"),
                 "sounding.csv:4: '57,5' in column 'K0 [%]' is not a number; decimals need a point"),
                (columns, "z [m],K0 [%]\n0,50\n2,5,57,5\n",
                 "sounding.csv:3: 4 cells, the first line has 2; decimals need a point"),
                (columns, self.CSV.replace("57.5;", "57.5"), "sounding.csv:4: 2 cells, the first line has 3"),
                (columns, self.CSV.replace("10;80", "1;80"), "functions/k0 profile/file: depths must increase strictly: 1 after 2.5 (row 3)"),
                (columns, "z [m]; K0 [%]\n", "has no rows of numbers")):
            with self.subTest(words=words):
                self.write("sounding.csv", csv)
                done = program(["check", self.write("column.xml", self.column("k0 profile", profile or {"factor": 1.0}))], 1, self.folder)
                self.assertEqual(done.returncode, 2, done.stdout)
                self.assertIn(words, done.stderr)
                self.assertEqual(len(done.stderr.strip().splitlines()), 1)


@problem("exact", "weight", "Slope under gravity")
class Slope(StrengthCase):
    def test_gravity_stage_leaves_a_slope_in_balance(self):
        history = self.run_deck(self.deck("initial_state", "slope"))
        weight = (40 * 8 + 25 * 5 - 0.5 * 10 * 5) * 1900 * G
        self.compare("weight", abs(history["reaction/base y"][-1] / weight - 1), 1e-6)
        for probe in ("crest", "toe"):
            for axis in "xy":
                self.assertEqual(history[f"probe/{probe}/displacement {axis}"][-1], 0)
        self.assertLess(history["probe/crest/displacement y"][-3], -1e-3)  # it settled before
        with h5py.File(os.path.join(self.folder, "results", "slope.h5"), "r") as file:
            step = file["steps"][sorted(file["steps"])[-1]]["cell"]
            stress = components(step)
            nodes, topology = file["mesh/coordinates"][:], file["mesh/topology"][:].reshape(-1, 7)[:, 1:4]
        centre = nodes[topology].mean(axis=1)
        far = (centre[:, 0] < -12) & (centre[:, 1] > -7)  # level ground away from the slope: weight above, within the mesh
        depth = -centre[far, 1]
        self.compare("vertical stress", np.abs(stress[far, 1] / (1900 * G * depth) - 1)[depth > 3].max(), 0.1)

    @problem("behaviour")
    def test_report_of_a_slope(self):
        self.run_deck(self.deck("initial_state", "slope"))
        done = program(["report", "results/slope"], 1, self.folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue(os.path.exists(os.path.join(self.folder, "results", "slope_report.html")))


if __name__ == "__main__":
    unittest.main()
