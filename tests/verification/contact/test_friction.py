"""Coulomb friction: full sliding on effective and total traction, and partial slip under a cylinder."""
import os
import unittest

import numpy as np

from compared_case import problem
from contact_case import PRESSURE, SHEAR, ContactCase
from mudline_case import deck_text, program
from references import contact as reference


@problem("exact", "Coulomb: shear stress is the coefficient times the pressure", "Full sliding")
class Sliding(ContactCase):
    def sliding(self, water, settings=(), ranks=1, coefficient=0.3):
        history = self.run_deck(self.deck("sliding_plate"), settings, ranks)
        drag, force = -history["contact/face/reaction x"][-1], history["contact/face/reaction y"][-1]
        limit = coefficient * (force - water * history["contact/face/contact area"][-1])
        self.compare_values("sliding force", drag, limit, 1e-6)
        # what the plate gave is in the soil, in the springs, or has become heat
        soil = -history["balance/energy/contact/face"][-1]
        spent = history["contact/face/friction heat"][-1] + soil
        self.compare("work against heat of friction",
                     abs(history["contact/face/work"][-1] - spent) / (history["contact/face/work"][-1]), 0.1)
        return history

    def test_effective(self):
        one, two = self.sliding(500.0), self.sliding(500.0, ranks=2)
        self.compare_values("two ranks", two["contact/face/reaction x"][-1], one["contact/face/reaction x"][-1], 1e-9)

    def test_coefficient_that_falls_with_the_speed(self):
        """The plate goes at 0.01 m/s, ten times the decay speed; the soil under it creeps by 2e-6 m/s as water leaves."""
        self.sliding(500.0, ("contacts/face/friction/kinetic coefficient=0.1", "contacts/face/friction/decay speed=0.001"),
                     coefficient=0.1 + 0.2 * np.exp(-10))

    def test_total(self):
        self.sliding(0.0, ("contacts/face/friction/on=total",))

    def test_cap(self):
        history = self.run_deck(self.deck("sliding_plate"), ("contacts/face/friction/cap=100",))
        self.compare_values("capped force", -history["contact/face/reaction x"][-1],
                            100 * history["contact/face/contact area"][-1], 1e-9)


@problem("exact", "alpha times the undrained strength", "Friction by the soil's strength")
class Alpha(ContactCase):
    """The strength of an interface as a share of the touching soil's present undrained strength."""
    ALPHA = ("contacts/face/friction/coefficient=50", "contacts/face/friction/on=total",
             "contacts/face/friction/alpha=0.6")
    STIFF = {"type": "tresca", "rigidity index": 1e4, "Poisson's ratio": 0.3}  # so that it hardly moves

    def pulled(self, skeleton, settings=(), ranks=1, decks=()):
        """History of the plate that is pulled along soil of this law, a section of a deck."""
        with open(self.deck("sliding_plate"), encoding="utf-8") as file:
            text = file.read()
        start = text.index('<ParameterList name="skeleton">')
        end = text.index("</ParameterList>", start)
        law = deck_text("skeleton", skeleton)
        deck = self.write("pulled.xml", text[:start] + law + text[end + len("</ParameterList>"):])
        return self.run_deck([deck, *decks], (*self.ALPHA, *settings), ranks, extra=("--overwrite",), name="pulled")

    def test_strength_of_the_place(self):
        """The soil is strong enough not to shear itself (alpha < 1). Nodes at the ends, where the soil loses touch, and
        beside a jump are left out."""
        # the strength at the surface, not in the middle of the first row of elements
        for text, strength, away in (("1000*(1 + x) + 4000*(0.5 - y)", lambda x: 1000 * (1 + x), 0.0),
                                     ("1000*(1 + 2*(x>1))", lambda x: np.where(x > 1, 3000.0, 1000.0), 0.3)):
            for ranks in (1, 2):
                self.pulled({**self.STIFF, "undrained strength": text}, ("mesh/distortion=0",), ranks)
                x, shear = self.surface("pulled", 0.5, SHEAR)
                inside = (x > 0.3) & (x < 1.7) & (np.abs(x - 1) >= away)
                self.assertGreater(inside.sum(), 5)
                self.compare_values("shear stress", np.abs(shear[inside]) / (0.6 * strength(x[inside])), 1.0, 1e-3)

    def test_speed(self):
        """100 times the reference speed and 20 % a decade."""
        history = self.pulled({**self.STIFF, "undrained strength": 1e3},
                              ("contacts/face/friction/rate coefficient=0.2",
                               "contacts/face/friction/reference speed=1e-4"))
        stress = -history["contact/face/friction x"][-1] / history["contact/face/contact area"][-1]
        self.compare_values("shear stress", stress, 0.6 * 1e3 * 1.4, 1e-3)

    def test_sand_beside_clay(self):
        """Clay with alpha times its strength, drained sand with a coefficient on its effective traction. The border
        goes through a column of elements. Nodes at the ends and within an element of the border are left out."""
        sand = {"type": "linear elastic", "Young's modulus": 1e7, "Poisson's ratio": 0.3}
        border = 1.1
        beside = self.write("beside.xml", deck_text("beside", {"materials": {"sand": {
            "top": f"x > {border} ? 1 : -1", "porosity": 0.4, "skeleton": sand, "fluid": {"type": "water"},
            "permeability": {"type": "constant", "hydraulic conductivity": 1e-4}}}}))
        clay = {**self.STIFF, "undrained strength": 1e3}
        for traction, coefficient in (("total", 50), ("effective", 50), ("effective", 0.5)):
            settings = ("mesh/distortion=0", "mesh/cells={16, 4}", "contacts/face/friction/drained coefficient=0.3",
                        f"contacts/face/friction/on={traction}", f"contacts/face/friction/coefficient={coefficient}")
            self.pulled(clay, settings, decks=(beside,))
            x, pressure, shear = self.surface("pulled", 0.5, PRESSURE, SHEAR)
            effective = pressure - 500.0
            in_clay, in_sand = (x > 0.3) & (x < border - 0.3), (x > border + 0.3) & (x < 1.7)
            self.assertGreater(min(in_clay.sum(), in_sand.sum()), 3)
            limit = np.minimum(600.0, coefficient * (effective if traction == "effective" else pressure))
            self.compare_values(f"clay, {traction}, {coefficient}", np.abs(shear / limit)[in_clay], 1.0, 1e-3)
            self.compare_values(f"sand, {traction}, {coefficient}",
                                np.abs(shear / (0.3 * effective))[in_sand], 1.0, 1e-3)
            self.assertGreater(effective[in_sand].min(), 300.0)
        settings = [word for setting in self.ALPHA for word in ("--set", setting)]
        done = program(["check", os.path.join(self.folder, "pulled.xml"), beside, *settings], 1, self.folder)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertIn("the soil at 'top'; the law 'linear elastic' of material 'sand' has none", done.stderr)

    def test_set_up(self):
        """Clay that has consolidated under the plate has the strength of its new specific volume v: s_u = M/2 p0
        2^-Lambda before, and exp(decrease of v / lambda) times that after."""
        ratio, compression, swelling, stress, void_ratio, height = 1.0, 0.2, 0.04, 20e3, 1.0, 0.5
        rollers = {side: {"type": "fixed", "set": side, "components": "x"} for side in ("left", "right")}
        plate = {"position": [0.0, height],
                 "contour": {"type": "polyline", "extent": "full", "x": [-10.0, 10.0], "y": [0.0, 0.0]},
                 "motion": {"type": "prescribed displacement", "x": "0.02*(t>1e8)*(t-1e8)",
                            "y": "-0.025*(t*(t<1e8)+1e8*(t>=1e8))/1e8"}}
        deck = self.write("set_up.xml", deck_text("set_up", {
            "mesh": {"type": "box", "cell": "quad9", "cells": [4, 4], "upper": [1.0, height]},
            "materials": {"clay": {
                "void ratio": void_ratio, "grain density": 2700.0, "fluid": {"type": "water"},
                "permeability": {"type": "constant", "hydraulic conductivity": 1e-9},
                "skeleton": {"type": "modified cam clay", "critical stress ratio": ratio,
                             "compression slope": compression, "swelling slope": swelling, "Poisson's ratio": 0.3}}},
            "physics": {"ground": {"type": "biot", "initial state": {
                "type": "uniform", **{f"effective stress {axes}": stress for axes in ("xx", "yy", "zz")}}}},
            "bodies": {"plate": plate},
            "boundary conditions": {"base": {"type": "fixed", "set": "bottom"}, **rollers,
                                    "filter": {"type": "pore pressure", "set": "bottom", "value": 0.0}},
            "contacts": {"face": {
                "type": "penalty", "body": "plate", "surface": "top", "initial gap": "in-situ stress",
                "friction": {"type": "coulomb", "coefficient": 2.0, "on": "total", "alpha": 0.6}}},
            "stages": {"press": {"type": "quasi-static", "duration": 1e8, "time step": {"initial": 5e6}},
                       "pull": {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 0.1}}},
            "output": {"probes": {"top": [0.5, height]}}}))
        history = self.run_deck(deck)
        start = 0.5 * ratio * stress * 0.5 ** (1 - swelling / compression)
        volume = (1 + void_ratio) * history["probe/top/displacement y"][history.time <= 1e8][-1] / height
        shear = -history["contact/face/friction x"] / history["contact/face/contact area"]
        self.compare_values("drag after set-up", shear[-1], 0.6 * start * np.exp(-volume / compression), 0.01)
        self.assertGreater(np.exp(-volume / compression), 1.5)


@problem("exact", "Cattaneo and Mindlin, after Johnson (1985)", "Partial slip under a cylinder")
class PartialSlip(ContactCase):
    def test_penalty(self):
        self.cattaneo_mindlin()

    def test_augmented_lagrangian(self):
        """The stretch of what sticks is followed as far as the load deserves, without a tolerance in the deck."""
        # with so soft a penalty the multipliers of corners and mid-side nodes differ by up to 0.2 of the limit, however small the tolerance
        history = self.cattaneo_mindlin(("contacts/face/enforcement=augmented Lagrangian", "contacts/face/penalty factor=2"), 0.25, 0.06)
        self.assertLess(history["step/newton iterations"].mean(), 20)

    def cattaneo_mindlin(self, settings=(), largest=0.08, mean=0.03):
        history = self.run_deck(self.deck("partial_slip"), settings)
        force, shear = history["contact/face/reaction y"][-1], -history["contact/face/reaction x"][-1]
        a, p0 = reference.hertz_line(force, 1.0, reference.plane_modulus(2e8, 0.49))
        stick = reference.stick_half_width(a, shear, 0.3 * force)
        self.assertLess(0.3 * a, stick)
        self.assertLess(stick, 0.8 * a)
        x, pressure, stress = self.surface("partial_slip", 0.0, PRESSURE, SHEAR)
        x = x - history["body/cylinder/displacement x"][-1]
        self.compare_values("largest pressure", pressure.max(), p0, 0.02)
        # nodal stresses are means over the elements around: away from the edges, where the slope is infinite
        error = np.abs(stress - reference.partial_slip(x, a, stick, 0.3 * p0)) / (0.3 * p0)
        smooth = np.minimum(np.abs(np.abs(x) - a), np.abs(np.abs(x) - stick)) > 0.0014
        self.compare_values("shear stress", error[smooth], 0.0, largest, 1.0)
        self.compare_values("mean error of the shear stress", error[np.abs(x) < a].mean(), 0.0, mean, 1.0)
        self.compare_values("shear stress in the middle", np.interp(0.0, x, stress),
                            reference.partial_slip(0.0, a, stick, 0.3 * p0), 0.02, 0.3 * p0)
        # the points that slide are those outside the stick zone
        slides = history["contact/face/sliding points"][-1] / history["contact/face/active points"][-1]
        self.compare_values("sliding share", slides, 1 - stick / a, 0.07, 1.0)
        return history


if __name__ == "__main__":
    unittest.main()
