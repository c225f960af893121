"""Numbers of laws, of the permeability and of the pores that are functions of the place: against closed forms, against
the same decks with plain numbers, carried with the soil through a moving mesh, on two ranks, and what is refused."""

import csv
import os
import unittest

import numpy as np

from compared_case import problem
from mudline_case import ROOT, MudlineCase, deck_text, program

LOAD, STIFFNESS, POISSON = 1.0, 1e7, 0.3  # [Pa, Pa, -]
CONSTRAINED = (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON))  # M/E
CSV = "depth,E [MPa]\n0,20\n1,10\n"  # the same as STIFFNESS*(1 + y) below y = 1

SIDES = {side: {"type": "fixed", "set": side, "components": "x"} for side in ("left", "right")}


def column(young, functions=None, **stages):
    return deck_text(
        "column",
        {
            **({"functions": functions} if functions else {}),
            "mesh": {"type": "box", "cell": "quad9", "cells": [1, 20], "upper": [1.0, 1.0]},
            "materials": {
                "clay": {
                    "density": 1800.0,
                    "skeleton": {"type": "linear elastic", "Young's modulus": young, "Poisson's ratio": POISSON},
                }
            },
            "physics": {"ground": {"type": "solid"}},
            "boundary conditions": {
                "base": {"type": "fixed", "set": "bottom"},
                **SIDES,
                "load": {"type": "pressure", "set": "top", "value": LOAD},
            },
            "stages": {"press": {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 1.0}}},
            "output": {"probes": {"middle": [0.5, 0.5], "top": [0.5, 1.0]}},
        },
    )


@problem("exact", "q/M0 ln(1 + y)", "Stiffness that grows with the height")
class Stiffness(MudlineCase):
    """A column whose stiffness grows with the height: the settlement between two heights is q/M0 times the logarithm
    of 1 + y."""

    def settlements(self, young, functions=None):
        history = self.run_deck(self.write("column.xml", column(young, functions)), extra=["--overwrite"])
        return [-history[f"probe/{name}/displacement y"][-1] for name in ("middle", "top")]

    def test_three_ways(self):
        self.write("sounding.csv", CSV)
        exact = [LOAD / (STIFFNESS * CONSTRAINED) * np.log(1 + y) for y in (0.5, 1.0)]
        for young, functions in (
            (f"{STIFFNESS}*(1 + y)", None),
            (
                "stiffness",
                {
                    "stiffness": {
                        "type": "profile",
                        "depths": [0.0, 1.0],
                        "values": [2 * STIFFNESS, STIFFNESS],
                        "surface": 1.0,
                    }
                },
            ),
            (
                "stiffness",
                {
                    "stiffness": {
                        "type": "profile",
                        "file": "sounding.csv",
                        "depth column": "depth",
                        "value column": "E [MPa]",
                        "factor": 1e6,
                        "surface": 1.0,
                    }
                },
            ),
        ):
            with self.subTest(young=young, functions=functions):
                for found, wanted in zip(self.settlements(young, functions), exact):
                    self.compare("settlement", abs(found / wanted - 1), 1e-6)


@problem("exact", "closed forms of strength over depth", "Strength over depth")
class Strength(MudlineCase):
    @problem("consistency")
    def test_moving_mesh(self):
        """An anchor that falls into clay: the strength by its gradient and as a function give one run, while the mesh
        moves. The stiffness follows the strength, and the strength is carried with the soil."""
        decks = [os.path.join(ROOT, "inputs", "torpedo", name + ".xml") for name in ("tresca", "short_torpedo")]
        short, path = ["stages/penetration/duration=0.03"], "materials/clay/skeleton/undrained strength"
        plain = self.run_deck(decks, short, extra=["--overwrite"], name="short_torpedo")
        function = [f"{path}=20e3 - 5e3*min(y, 0)", f"{path} gradient=0"]
        for ranks in (1, 2):
            varied = self.run_deck(decks, short + function, ranks, extra=["--overwrite"], name="short_torpedo")
            self.assert_same_run(
                plain, varied, ["body/anchor/velocity y", "contact/anchor/reaction y"], f"{ranks} ranks", 1e-7
            )

    def test_sounding(self):
        """A strip footing on the profile of a file: its pressure at failure lies between N_c times the lowest and the
        highest strength, and no longer grows."""
        decks = [
            os.path.join(ROOT, "inputs", "bearing_capacity", name + ".xml") for name in ("strip_tresca", "sounding")
        ]
        history = self.run_deck(decks, name="sounding")
        pressure = np.abs(history["reaction/footing y"])  # on a metre
        self.assertTrue((2 + np.pi) * 12e3 < pressure[-1] < (2 + np.pi) * 25e3, pressure[-1])
        self.assertLess(pressure[-1] / np.interp(0.9, history.time, pressure) - 1, 1e-3)
        done = program(["point", *decks, "--profile"], 1, self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(os.path.join(self.folder, "results", "sounding_ground.csv"), newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        depth, strength = (
            np.array([float(row[name]) for row in rows]) for name in ("depth [m]", "undrained strength [Pa]")
        )
        exact = np.interp(depth, [0.0, 0.3, 0.6, 0.9, 1.5, 2.5], [25e3, 24e3, 16e3, 12e3, 12.6e3, 13.8e3])
        self.compare("strength", np.abs(strength / exact - 1).max(), 1e-5)
        self.assertNotIn("K0 [-]", rows[0])  # there is no vertical stress

    def test_point(self):
        """Soil from a depth has the numbers of this depth; rules across numbers hold at each place."""

        def deck(cohesion, friction, dilation, place):
            return deck_text(
                "point",
                {
                    "materials": {
                        "sand": {
                            "void ratio": 0.7,
                            "grain density": 2650.0,
                            "skeleton": {
                                "type": "mohr-coulomb",
                                "Young's modulus": 3e7,
                                "Poisson's ratio": 0.3,
                                "cohesion": cohesion,
                                "friction angle [deg]": friction,
                                "dilation angle [deg]": dilation,
                            },
                        }
                    },
                    "tests": {
                        "shear": {
                            "type": "triaxial drained",
                            "axial strain": [0.05],
                            "initial state": {"mean effective stress": 1e5, "place": place},
                        }
                    },
                },
            )

        plain = self.run_point(self.write("plain.xml", deck(7e3, 35.0, 5.0, [0.0, 0.0])))["shear"]
        varied = self.run_point(self.write("varied.xml", deck("5e3 - 1e3*y", "30 - 2.5*y", "x", [5.0, -2.0])))["shear"]
        for name in plain.columns:
            self.compare(name, np.abs(plain[name] - varied[name]).max(), 1e-12 * (1 + np.abs(plain[name]).max()))
        self.assertEqual(
            set(varied.columns) - set(plain.columns),
            {"initial cohesion", "friction angle [deg]", "dilation angle [deg]"},
        )
        for place, words in (
            ([40.0, 0.0], "the dilation angle must not be greater than the friction angle"),
            ([5.0, -20.0], "its 'friction angle [deg]' is 80 here; allowed: [0, 60]"),
        ):
            done = program(
                ["point", self.write("wrong.xml", deck("5e3 - 1e3*y", "30 - 2.5*y", "x", place))], 1, self.folder
            )
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(words, done.stderr)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1)


@problem("exact", "flow and weight in closed form", "Pores and permeability over the height")
class Ground(MudlineCase):
    """Pores and permeability that vary with the height."""

    WEIGHT, GRAINS, GRAVITY = 1e4, 2600.0, 10.0

    def soil(self, porosity, conductivity):
        return {
            "porosity": porosity,
            "grain density": self.GRAINS,
            "skeleton": {"type": "linear elastic", "Young's modulus": 1e12, "Poisson's ratio": 0.25},
            "fluid": {"type": "water", "density": self.WEIGHT / self.GRAVITY, "unit weight": self.WEIGHT},
            "permeability": {"type": "kozeny-carman", "hydraulic conductivity": conductivity},
        }

    def test_flow_through_two_layers(self):
        """Water that is pressed upwards through two layers of one material: the pressure at their border, and the
        discharge."""
        lower, upper, pressure = 1e-6, 1e-8, 1e4
        deck = deck_text(
            "layers",
            {
                "mesh": {"type": "box", "cell": "quad9", "cells": [1, 4], "upper": [0.5, 1.0]},
                "materials": {"sand": self.soil(0.4, f"y < 0.5 ? {lower} : {upper}")},
                "physics": {"ground": {"type": "biot"}},
                "boundary conditions": {
                    "base": {"type": "fixed", "set": "bottom"},
                    "top": {"type": "fixed", "set": "top"},
                    **SIDES,
                    "below": {"type": "pore pressure", "set": "bottom", "value": pressure},
                    "above": {"type": "pore pressure", "set": "top", "value": 0.0},
                },
                "stages": {
                    "flow": {"type": "quasi-static", "duration": 1e9, "time step": {"initial": 1e3, "growth": 10.0}}
                },
                "solver": {"residual tolerance": 1e-11},
                "output": {"probes": {"border": [0.25, 0.5]}},
            },
        )
        resistance = 0.5 / lower + 0.5 / upper
        for ranks in (1, 2):
            history = self.run_deck(self.write("layers.xml", deck), ranks=ranks, extra=["--overwrite"])
            self.compare("pressure",
                         abs(history["probe/border/pore pressure"][-1] / (pressure * 0.5 / upper / resistance) - 1),
                         1e-5)
            self.compare("discharge",
                         abs(abs(history["reaction/above"][-1]) / (0.5 * pressure / self.WEIGHT / resistance) - 1),
                         1e-5)

    def ground(self, porosity):
        return deck_text(
            "ground",
            {
                "mesh": {"type": "box", "cell": "quad9", "cells": [2, 10], "lower": [0.0, -10.0], "upper": [2.0, 0.0]},
                "materials": {"clay": self.soil(porosity, 1e-9)},
                "physics": {
                    "ground": {
                        "type": "biot",
                        "gravity": [0.0, -self.GRAVITY],
                        "initial state": {"type": "geostatic", "water level": 0.0, "K0": 0.5},
                    }
                },
                "boundary conditions": {
                    "base": {"type": "fixed", "set": "bottom"},
                    **SIDES,
                    "above": {"type": "pore pressure", "set": "top", "value": 0.0},
                },
                "stages": {
                    "rest": {"type": "geostatic"},
                    "wait": {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 1.0}},
                },
            },
        )

    def test_weight_of_pores_over_the_depth(self):
        """Porosity 0.7 at the surface and 0.5 at 10 m: the effective stress on the sides is K0 times the buoyant
        weight above."""
        history = self.run_deck(self.write("ground.xml", self.ground("0.7 + 0.02*y")))
        buoyant = (self.GRAINS * self.GRAVITY - self.WEIGHT) * (0.3 * 10**2 / 2 + 0.02 * 10**3 / 6)
        water = self.WEIGHT * 10**2 / 2
        self.compare("side", abs(history["reaction/left x"][-1] / (0.5 * buoyant + water) - 1), 1e-6)

    @problem("behaviour")
    def test_refusals(self):
        for porosity, words in (
            ("0.5 + 0.1*x", "the void ratio of material 'clay' varies sideways"),
            ("0.5*t", "materials/clay/porosity: '0.5*t' depends on the time; this number may depend on the place only"),
            ("0.5 + 0.06*y", "the void ratio that the deck gives here"),
            ("0.5 + depth", "materials/clay/porosity: invalid expression '0.5 + depth'"),
            ("3/2", "materials/clay/porosity: 3/2 is out of range; allowed: [0, 1)"),
            ("1.5", "materials/clay/porosity: expected a number (double), given the string"),
        ):
            with self.subTest(porosity=porosity):
                done = program(["check", self.write("ground.xml", self.ground(porosity))], 1, self.folder)
                self.assertEqual(done.returncode, 2, done.stdout)
                self.assertIn(words, done.stderr)
                self.assertEqual(len(done.stderr.strip().splitlines()), 1)

    @problem("behaviour")
    def test_number_out_of_range_somewhere(self):
        """It is named before anything is made of it, such as K0 of the friction angle."""
        deck = (
            self.ground(0.5)
            .replace("linear elastic", "mohr-coulomb")
            .replace(
                '<Parameter name="Young\'s modulus"',
                '<Parameter name="cohesion" type="double" value="1e3"/>'
                '<Parameter name="friction angle [deg]" type="string" value="20 - 6*y"/>'
                '<Parameter name="Young\'s modulus"',
            )
        )
        done = program(["check", self.write("ground.xml", deck)], 1, self.folder)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertRegex(
            done.stderr,
            r"material 'clay' cannot start at \(.*\): its 'friction angle \[deg\]' is .* here; allowed: \[0, 60\]",
        )

    def profile(self, deck, *arguments):
        return program(["point", deck, "--profile", *arguments], 1, self.folder)

    def test_profile(self):
        """What `mudline point --profile` writes of the ground above."""
        done = self.profile(
            self.write("ground.xml", self.ground("0.7 + 0.02*y")), "--at", "1", "0", "--png", "ground.png"
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(len(done.stdout.strip().splitlines()), 2 + 10 + 2)  # heads, rows, the names of the two files
        with open(os.path.join(self.folder, "results", "ground_ground.csv"), newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["material"] for row in rows], ["clay"] * 10)
        depth = np.array([float(row["depth [m]"]) for row in rows])
        self.assertLess(np.abs(depth - (np.arange(10) + 0.5)).max(), 0.5)
        self.assertTrue((np.diff(depth) > 0).all())
        vertical = (self.GRAINS * self.GRAVITY - self.WEIGHT) * (0.3 * depth + 0.02 * depth**2 / 2)
        porosity = 0.7 - 0.02 * depth
        for name, exact in (
            ("height [m]", -depth),
            ("vertical effective stress [Pa]", vertical),
            ("horizontal effective stress [Pa]", 0.5 * vertical),
            ("K0 [-]", 0.5 + 0 * depth),
            ("pore pressure [Pa]", self.WEIGHT * depth),
            ("void ratio [-]", porosity / (1 - porosity)),
            ("hydraulic conductivity [m/s]", 1e-9 + 0 * depth),
            ("shear modulus [Pa]", 0.4e12 + 0 * depth),
        ):
            found = np.array([float(row[name]) for row in rows])
            self.compare(name, np.abs(found / exact - 1).max(), 1e-5)
        with open(os.path.join(self.folder, "ground.png"), "rb") as file:
            self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")

    @problem("behaviour")
    def test_profile_refusals(self):
        deck = self.write("ground.xml", self.ground(0.5))
        for arguments, words in (
            (["--at", "3", "0"], "the vertical line through (3, 0) misses the soil"),
            (["--at", "1", "0", "0"], "--at: expected 2 numbers, given 3"),
            (["--conformance"], "give --profile or --conformance, not both"),
        ):
            done = self.profile(deck, *arguments)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(words, done.stderr)
        done = self.profile(os.path.join(ROOT, "inputs", "point", "mcc_triaxial.xml"))
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("a profile is that of a run's ground", done.stderr)
        done = program(["point", deck, "--at", "1", "0"], 1, self.folder)
        self.assertIn("--at is the place of a --profile", done.stderr)


if __name__ == "__main__":
    unittest.main()
