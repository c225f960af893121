"""What a dynamic stage starts with after a stage without inertia: the velocities of what moves, and nothing of what loads left behind."""
import os
import unittest

import numpy as np
from mudline_case import History, MudlineCase, deck_text, program

HEIGHT, YOUNG, POISSON, DENSITY, G = 10.0, 1e7, 0.3, 2000.0, 9.81
MODULUS = YOUNG * (1 - POISSON) / (1 + POISSON) / (1 - 2 * POISSON)
SETTLEMENT = DENSITY * G * HEIGHT**2 / 2 / MODULUS
SAND = {"porosity": 0.4, "density": 2000.0, "skeleton": {"type": "linear elastic", "Young's modulus": YOUNG, "Poisson's ratio": POISSON}}
WET = {"grain density": 2650.0, "porosity": 0.4, "skeleton": SAND["skeleton"], "fluid": {"type": "water"},
       "permeability": {"type": "constant", "hydraulic conductivity": 1e-6}}


def column(stages, conditions=None, physics=None, **more):
    """A column on rollers, the stages' first time steps given with their types."""
    sides = {side: {"type": "fixed", "set": side, "components": "x"} for side in ("left", "right")}
    if physics is None:
        physics = {"type": "solid", "gravity": [0.0, -G], "gravity factor": "1"}
    wet = physics["type"] == "biot"
    if wet:
        sides["drained"] = {"type": "pore pressure", "set": "top"}
    return deck_text("column", {
        "mesh": {"type": "box", "geometry": "plane strain", "cell": "quad9", "cells": [1, 10], "upper": [1.0, HEIGHT]},
        "materials": {"sand": WET if wet else {k: v for k, v in SAND.items() if k != "porosity"}},
        "physics": {"ground": physics},
        "boundary conditions": {"base": {"type": "fixed", "set": "bottom"}, **sides, **(conditions or {})},
        "stages": stages,
        "output": {"probes": {"top": [0.0, HEIGHT], "middle": [0.0, HEIGHT / 2]}},
        **more})


def stage(kind, duration, step, **more):
    return {"type": kind, "duration": duration, "time step": {"initial": step}, **more}


NEWMARK = {"integrator": {"type": "newmark"}}
TOP, MIDDLE = "probe/top/displacement y", "probe/middle/displacement y"


class StaticThenDynamic(MudlineCase):
    def column(self, *arguments, **keys):
        """The history of the second stage, and what was said."""
        done = program(["run", self.write("column.xml", column(*arguments, **keys)), "--overwrite"], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return self.history("column"), done.stdout + done.stderr

    def history(self, name):
        return History(os.path.join(self.folder, "results", name + ".csv"))

    def test_weight_then_rest(self):
        """A weight that was put on without inertia leaves no velocity: the column rests, whichever integrator goes on, in one step or many."""
        for integrator in ("newmark", "generalised alpha"):
            for step, weight in ((1.0, "1"), (1.0, "min(t,1)"), (0.25, "min(t,1)")):
                for rates in ({}, {"initial rates": "consistent"}):
                    with self.subTest(integrator=integrator, step=step, weight=weight, rates=rates):
                        history, said = self.column(
                            {"weight": stage("quasi-static", 1.0, step),
                             "rest": stage("dynamic", 0.5, 0.01, integrator={"type": integrator}, **rates)},
                            physics={"type": "solid", "gravity": [0.0, -G], "gravity factor": weight})
                        top = history[TOP][history.time >= 1]
                        self.assertLess(abs(top[0] + SETTLEMENT), 0.01 * SETTLEMENT)  # the column gets shorter
                        self.assertLess(np.abs(top - top[0]).max(), 1e-5 * SETTLEMENT)
                        self.assertIn("starts at rest", said)

    def test_wet_weight_then_rest(self):
        """Water-filled soil that is loaded within a second: neither velocities nor rates of pressure come out of that."""
        history, _ = self.column(
            {"weight": stage("quasi-static", 1.0, 1.0), "rest": stage("dynamic", 0.5, 0.01)},
            conditions={"load": {"type": "pressure", "set": "top", "value": 50e3}}, physics={"type": "biot"})
        after = history.time >= 1
        top, pressure = history[TOP][after], history["probe/middle/pore pressure"][after]
        self.assertGreater(pressure[0], 45e3)
        self.assertLess(np.abs(pressure - pressure[0]).max(), 5e-3 * pressure[0])
        # what was kept before moved the top by its whole settlement in a second
        self.assertLess(np.abs(top - top[0]).max(), 0.3 * abs(top[0]))

    def test_keep_is_doubted(self):
        history, said = self.column({"weight": stage("quasi-static", 1.0, 1.0),
                                     "swing": stage("dynamic", 0.5, 0.01, **NEWMARK, **{"initial rates": "keep"})})
        top = history[TOP][history.time >= 1]
        self.assertGreater(np.abs(top - top[0]).max(), 0.05 * SETTLEMENT)
        self.assertRegex(said, r"warning: stage 'weight' without inertia left velocities of up to 0\.072\d m/s, .* nothing in stage 'swing' keeps "
                               r"up; the soil starts with them, as 'initial rates' = keep says")

    def test_what_is_pushed_goes_on(self):
        """A top that is pushed down steadily without inertia, and on with it: all points go on as they went."""
        speed = 0.01
        history, said = self.column(
            {"push": stage("quasi-static", 1.0, 0.1), "on": stage("dynamic", 0.5, 0.01, **NEWMARK)},
            conditions={"push": {"type": "velocity", "set": "top", "y": -speed}}, physics={"type": "solid"})
        middle, t = history[MIDDLE], history.time
        self.assertLess(np.abs(middle + 0.5 * speed * t).max(), 1e-4 * speed)
        self.assertNotIn("starts at rest", said)

    def test_a_load_that_jumps_is_no_motion(self):
        """The weight stands; another load is put on as the dynamic stage starts: the top moves as that of a column without weight."""
        load, shock = {"shock": {"type": "pressure", "set": "top", "value": 20e3}}, stage("dynamic", 1.0, 0.005, **NEWMARK)
        alone, _ = self.column({"shock": shock}, conditions=load, physics={"type": "solid"})
        history, said = self.column(
            {"weight": stage("quasi-static", 1.0, 1.0, conditions=["base", "left", "right"]), "shock": shock}, conditions=load)
        self.assertIn("starts at rest", said)
        top, static = history[TOP][history.time >= 1], 20e3 * HEIGHT / MODULUS
        same = np.interp(history.time[history.time >= 1] - 1, alone.time, alone[TOP])
        self.assertLess(np.abs(top - top[0] - (same - same[0])).max(), 0.1 * static)  # the velocities left out would add 0.4

    def test_a_loading_that_goes_on(self):
        """A load that grows steadily through both stages: the velocities are those of the loading and go on."""
        rate = 2e3  # Pa/s
        history, said = self.column(
            {"slow": stage("quasi-static", 1.0, 0.1), "on": stage("dynamic", 1.0, 0.01, **NEWMARK)},
            conditions={"load": {"type": "pressure", "set": "top", "value": f"{rate}*t"}}, physics={"type": "solid"})
        static = rate * history.time * HEIGHT / MODULUS
        self.assertLess(np.abs(history[TOP] + static).max(), 1e-3 * static[-1])
        self.assertNotIn("starts at rest", said)

    def test_a_restart_between_the_stages(self):
        """The judgement is the same in a run that was interrupted where the dynamic stage begins."""
        deck = self.write("column.xml", column({"weight": stage("quasi-static", 1.0, 1.0), "rest": stage("dynamic", 0.1, 0.01, **NEWMARK)}))
        self.assertEqual(program(["run", "-q", deck], folder=self.folder).returncode, 0)
        whole = self.history("column")
        self.assertEqual(program(["run", "-q", deck, "--overwrite", "--steps", 1], folder=self.folder).returncode, 0)
        self.assertEqual(program(["run", "-q", deck, "--restart"], folder=self.folder).returncode, 0)
        self.assertTrue(np.array_equal(whole.data[:, 1:3], self.history("column").data[:, 1:3]))
        self.assertTrue(np.array_equal(whole[TOP], self.history("column")[TOP]))


class PushedBody(MudlineCase):
    """A strip that is pressed into a block of soil."""

    def block(self, motion, stages, mass=0.0, run=("run",)):
        body = {"position": [0.0, 0.0], "motion": motion,
                "contour": {"type": "strip", "extent": "full", "width": 0.6, "thickness": 0.2, "corner radius": 0.04}}
        if mass > 0:
            body["mass"] = mass
        text = deck_text("block", {
            "mesh": {"type": "box", "geometry": "plane strain", "cell": "quad9", "cells": [10, 4], "lower": [-1.0, -0.8], "upper": [1.0, 0.0]},
            "materials": {"soil": {"density": 2000.0, "skeleton": SAND["skeleton"]}},
            "physics": {"ground": {"type": "solid"}},
            "bodies": {"strip": body},
            "boundary conditions": {side: {"type": "fixed", "set": side} for side in ("bottom", "left", "right")},
            "contacts": {"face": {"type": "penalty", "body": "strip", "surface": "top"}},
            "stages": stages,
            "output": {"probes": {"below": [0.0, -0.4]}}})
        done = program([*run, self.write("block.xml", text)], folder=self.folder)
        path = os.path.join(self.folder, "results", "block.csv")
        return done, History(path) if done.returncode == 0 and os.path.exists(path) else None

    def test_a_pushed_body_goes_on(self):
        """A body pushed on at the same speed: soil and reaction go on, without a jolt."""
        speed = 1e-3
        done, history = self.block({"type": "prescribed velocity", "velocity y": -speed},
                                   {"push": stage("quasi-static", 1.0, 0.1), "on": stage("dynamic", 0.1, 0.002, **NEWMARK)})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertNotIn("starts at rest", done.stdout + done.stderr)
        t, below, reaction = history.time, history["probe/below/displacement y"], history["contact/face/reaction y"]
        on = t > 1
        for name, values in (("soil", below), ("reaction", reaction)):
            per_time = values[t == 1][0]  # elastic: in proportion to the time
            self.assertLess(np.abs(values[on] - per_time * t[on]).max(), 2e-3 * abs(per_time), name)

    def test_a_pushed_body_that_stops(self):
        """Held in the dynamic stage: the soil stops with it."""
        done, history = self.block({"type": "prescribed velocity", "velocity y": -1e-3},
                                   {"push": stage("quasi-static", 1.0, 0.1),
                                    "rest": stage("dynamic", 0.1, 0.002, **NEWMARK, motions={"strip": {"type": "held"}})})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("starts at rest", done.stdout)
        below = history["probe/below/displacement y"][history.time >= 1]
        self.assertLess(np.abs(below - below[0]).max(), 1e-5 * abs(below[0]))

    def test_a_carried_body_is_let_go(self):
        """A body that was moved through the air by a prescribed motion keeps that velocity when it is set free."""
        speed = 0.5
        _, history = self.block({"type": "prescribed velocity", "velocity y": -speed},
                                {"carry": stage("quasi-static", 0.1, 0.05),
                                 "free": stage("dynamic", 0.1, 0.002, motions={"strip": {"type": "free", "gravity": [0.0, 0.0]}})}, mass=100.0,
                                run=("run", "--set", "bodies/strip/position={0, 1}"))
        self.assertAlmostEqual(history["body/strip/velocity y"][-1], -speed, delta=1e-9)

    def test_a_load_leaves_the_body_at_rest(self):
        """A body laid down by a force in one step rests under that force afterwards."""
        force = {"type": "force", "force y": "-1000*min(t,1)"}
        done, history = self.block(force, {"lay": stage("quasi-static", 1.0, 1.0), "rest": stage("dynamic", 0.1, 0.002)}, mass=100.0)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        place = history["body/strip/displacement y"][history.time >= 1]
        self.assertLess(np.abs(place - place[0]).max(), 1e-4 * abs(place[0]))

    def test_an_idle_initial_velocity_is_refused(self):
        """One that no stage would ever give the body, in its own motion or a stage's; where a dynamic stage gives it first, it is right."""
        thrown = {"type": "free", "initial velocity": [0.0, -1.0]}
        slow, fast = stage("quasi-static", 1.0, 0.5), stage("dynamic", 0.1, 0.05)
        held = {"type": "held"}
        for motion, stages, where in (
                (thrown, {"lay": slow, "on": fast}, "bodies/strip/motion/initial velocity"),
                (held, {"lay": {**slow, "motions": {"strip": thrown}}}, "stages/lay/motions/strip/initial velocity")):
            done, _ = self.block(motion, stages, mass=100.0, run=("check",))
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"{where}: body 'strip' would start with this in stage 'lay', which is quasi-static: without inertia it has no effect",
                          done.stderr)
        for motion, stages in ((thrown, {"fall": fast, "on": slow}), (thrown, {"lay": {**slow, "motions": {"strip": held}}, "on": fast}),
                               ({"type": "free"}, {"lay": slow, "on": fast})):
            done, _ = self.block(motion, stages, mass=100.0, run=("check",))
            self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
