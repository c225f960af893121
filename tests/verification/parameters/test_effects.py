"""What the reference promises of parameters that no other test and no deck gives, on the ball of tests/mpi, a column and points."""
import os
import re
import unittest

import numpy as np

from compared_case import problem
from mudline_case import ROOT, MudlineCase, deck_text, program

BALL = os.path.join(ROOT, "tests", "mpi", "ball_in_clay.xml")
ANCHOR = os.path.join(ROOT, "inputs", "impact", "free_fall.xml")
TERZAGHI = os.path.join(ROOT, "inputs", "consolidation", "terzaghi.xml")
CONTACT = "contacts/ball on clay"
MESH_MOTION = {"mesh motion": {"boundary": {"focus": "ball", "size near focus": 0.05, "near distance": 0.1, "growth": 0.2}}}
STEPS = ("--steps", "14")
FORCE = "contact/ball on clay/reaction y"
MOTION = "mesh motion/"

# a bar of 1 m, E = 1e7 Pa without lateral strain, 2000 kg/m3: waves of 70.7 m/s; its top moves with 0.01 m/s
BAR = {
    "mesh": {"type": "box", "cell": "quad9", "cells": [1, 40], "upper": [0.05, 1.0]},
    "materials": {"bar": {"density": 2000.0, "skeleton": {"type": "linear elastic", "Young's modulus": 1e7, "Poisson's ratio": 0.0}}},
    "physics": {"ground": {"type": "solid"}},
    "boundary conditions": {
        "left": {"type": "fixed", "set": "left", "components": "x"}, "right": {"type": "fixed", "set": "right", "components": "x"},
        "top": {"type": "velocity", "set": "top", "y": "-0.01", "ramp time": 0.002}},
    "stages": {"wave": {"type": "dynamic", "duration": 0.03, "time step": {"initial": 1e-4}}},
    "output": {"probes": {"base": [0.0, 0.0], "top": [0.0, 1.0]}},
}
WAVE = 1 / (1e7 / 2000) ** 0.5  # [s] through the bar


class BallCase(MudlineCase):
    def ball(self, *settings, overlay=None, steps=STEPS):
        decks = [BALL] + ([self.write("over.xml", deck_text("over", overlay))] if overlay else [])
        return self.run_deck(decks, settings=settings, extra=steps)

    def run_text(self, decks, *settings):
        """What a run prints."""
        arguments = ["run", *decks, *STEPS] + [word for setting in settings for word in ("--set", setting)]
        done = program(arguments, folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout


@problem("consistency", title="Effects of parameters")
class Effects(BallCase):
    def bar(self, base, **top):
        deck = dict(BAR, **{"boundary conditions": dict(BAR["boundary conditions"], base=base)})
        deck["boundary conditions"]["top"] = dict(deck["boundary conditions"]["top"], **{k.replace("_", " "): v for k, v in top.items()})
        return self.run_deck(self.write("bar.xml", deck_text("bar", deck)))

    def test_tip_height(self):
        whole = self.ball("bodies/ball/tip height=1")
        total = whole[FORCE][-1]
        self.assertGreater(total, 10)
        self.compare("share of the tip", abs(whole["contact/ball on clay/tip reaction y"][-1] / total - 1), 1e-12)
        none = self.ball("bodies/ball/tip height=1e-9")
        self.compare("share of the shaft", abs(none["contact/ball on clay/shaft reaction y"][-1] / total - 1), 1e-12)

    def test_start_time(self):
        at_once, late = self.bar({"type": "fixed", "set": "bottom"}), self.bar({"type": "fixed", "set": "bottom"}, start_time=0.005)
        moved = lambda history, time: history.at("probe/top/displacement y", time)
        self.assertEqual(moved(late, 0.005), 0)
        for time in (0.006, 0.01, 0.015):
            self.compare("displacement", abs(moved(late, time) - moved(at_once, time - 0.005)), 1e-12)

    @problem("exact", "a dashpot of a share of rho c passes 2/(1 + share)")
    def test_factors_of_absorbing_boundaries(self):
        # the base's velocity over that of the incident wave: 2/(1 + factor), until the wave comes back from the top
        for factor in (0.5, 1.0, 3.0):
            history = self.bar({"type": "absorbing", "set": "bottom", "normal factor": factor})
            times = np.array([1.4 * WAVE, 1.8 * WAVE]) + 0.002
            moved = np.diff([history.at("probe/base/displacement y", time) for time in times])[0]
            self.compare(f"velocity, factor {factor}",
                         abs(-moved / (0.01 * (times[1] - times[0])) - (2 / (1 + factor))), 0.02)

    @problem("exact", "a dashpot of a share of rho c passes 2/(1 + share)")
    def test_tangential_factor(self):
        roller = {"left": {"type": "fixed", "set": "left", "components": "y"}, "right": {"type": "fixed", "set": "right", "components": "y"},
                  "top": {"type": "velocity", "set": "top", "x": "-0.01", "ramp time": 0.002}}
        shear = 2 ** 0.5 * WAVE
        for factor in (1.0, 3.0):
            base = {"type": "absorbing", "set": "bottom", "tangential factor": factor}
            deck = dict(BAR, **{"boundary conditions": dict(roller, base=base)})
            history = self.run_deck(self.write("bar.xml", deck_text("bar", deck)), settings=["stages/wave/duration=0.04"])
            times = np.array([1.4 * shear, 1.8 * shear]) + 0.002
            moved = np.diff([history.at("probe/base/displacement x", time) for time in times])[0]
            self.compare(f"velocity, factor {factor}",
                         abs(-moved / (0.01 * (times[1] - times[0])) - (2 / (1 + factor))), 0.02)

    def test_drag_area(self):
        area = ["bodies/anchor/motion/water/drag area=1.0", "bodies/anchor/motion/water/drag coefficient=0.2"]
        twice = ["bodies/anchor/motion/water/drag area=0.5", "bodies/anchor/motion/water/drag coefficient=0.4"]
        none = ["bodies/anchor/motion/water/drag area=0.5", "bodies/anchor/motion/water/drag coefficient=0.2"]
        velocity = [self.run_deck(ANCHOR, settings=settings)["body/anchor/velocity y"][-1] for settings in (area, twice, none)]
        self.compare("velocity", abs(velocity[0] - velocity[1]) / abs(velocity[0]), 1e-9)
        self.assertGreater(abs(velocity[2]), 1.01 * abs(velocity[0]))

    @problem("behaviour")
    def test_sealing_gap(self):
        # the wider the sealed ring round the face, the less water leaves and the larger the force
        narrow, wide = (self.ball(f"{CONTACT}/sealing gap={gap}")[FORCE][-1] for gap in (0.1, 1))
        self.assertGreater(wide, 1.1 * narrow)

    @problem("behaviour")
    def test_error_tolerance(self):
        # steps of second order, of an error proportional to their square or cube
        step, rows = "stages/consolidation/time step/", []
        for tolerance in (1e-2, 1e-4):
            history = self.run_deck(TERZAGHI, settings=[f"{step}error tolerance={tolerance}", f"{step}growth=2", f"{step}maximum=1e5"])
            rows.append(len(history.time))
        self.assertGreater(rows[1], 2.5 * rows[0])  # 4.6 or more but for the steps at the start of the stage
        self.assertLess(rows[1], 15 * rows[0])

    @problem("behaviour")
    def test_reuse_iterations(self):
        reuse = ["solver/linear solver/type=direct", "solver/linear solver/reuse factorisation=true"]
        often, seldom = (self.run_text([BALL], *reuse, f"solver/linear solver/reuse iterations={n}") for n in (1, 40))
        krylov = lambda text: max(int(n) for n in re.findall(r"linear (\d+)", text))
        self.assertLess(krylov(often), krylov(seldom))


@problem("consistency", title="Parameters of mesh motion")
class MeshMotion(BallCase):
    def moved(self, *settings):
        return self.ball(*settings, overlay=MESH_MOTION)

    @problem("behaviour")
    def test_when_quality_below(self):
        resting, always = self.moved("mesh motion/when quality below=0.01"), self.moved("mesh motion/when quality below=2")
        self.assertEqual(abs(resting[MOTION + "change of momentum y"]).max(), 0)
        self.assertGreater(abs(always[MOTION + "change of momentum y"]).max(), 0)
        self.assertGreater(always["mesh/quality"][-1], resting["mesh/quality"][-1] + 0.01)

    def test_conserve_mass(self):
        kept, free = self.moved(), self.moved("mesh motion/conserve mass=false")
        for name in ("change of solid", "change of water"):
            self.compare(name, abs(kept[MOTION + name]).max(), 1e-12)
            self.assertGreater(abs(free[MOTION + name]).max(), 1e-8)

    @problem("behaviour")
    def test_mass_tolerance(self):
        text = self.run_text([BALL, self.write("over.xml", deck_text("over", MESH_MOTION))], "mesh motion/mass tolerance=1e-9")
        self.assertRegex(text, r"rejected: the remap changes the mass of (grains|water) by a share of -?\d")

    @problem("behaviour")
    def test_largest_slide(self):
        # nodes held back on the boundary leave it as the soil has moved it
        free, held = self.moved(), self.moved("mesh motion/boundary/largest slide=1e-4")
        self.assertGreater(free["mesh/quality"][-1], held["mesh/quality"][-1] + 1e-3)

    def test_largest_motion(self):
        # in parts or at once the mesh goes to the same place, and the state differs by the error of the transfer only
        once, parts = self.moved("mesh motion/largest motion=10"), self.moved("mesh motion/largest motion=0.001")
        self.assertNotEqual(once[FORCE][-1], parts[FORCE][-1])
        self.compare("force", abs(parts[FORCE][-1] / once[FORCE][-1] - 1), 2e-3)
        self.compare("quality", abs(parts["mesh/quality"][-1] - once["mesh/quality"][-1]), 1e-3)

    @problem("behaviour")
    def test_sweeps(self):
        # one pass, whether by number or because every vertex moves by less than the tolerance; more go on from there
        interior = f"{MOTION}interior/"
        many, one, loose = (self.moved(interior + "type=optimisation", *more) for more in
                            ((), (interior + "sweeps=1",), (interior + "sweep tolerance=1",)))
        self.assertEqual(one["mesh/quality"][-1], loose["mesh/quality"][-1])
        self.assertNotEqual(one["mesh/quality"][-1], many["mesh/quality"][-1])

    def test_ideal(self):
        # the graded mesh is its own ideal and stays; for equilateral triangles it is far from the best
        ideal = [f"{MOTION}interior/type=optimisation", "bodies/ball/motion/velocity y=-1e-9", f"{MOTION}interior/ideal="]
        source, equilateral = (self.moved(*ideal[:2], ideal[2] + word)["mesh/quality"][-1] for word in ("source", "equilateral"))
        self.compare("quality", abs(source - 1), 1e-6)
        self.assertLess(equilateral, 0.9)

    def test_remap(self):
        # transfers of the state, which differ by their own error only
        usual = self.moved()[FORCE][-1]
        for setting in ("scheme=incremental", "limited=false"):
            other = self.moved(f"{MOTION}remap/type=convection", f"{MOTION}remap/{setting}")[FORCE][-1]
            self.assertNotEqual(other, usual, setting)
            self.compare(setting, abs(other / usual - 1), 2e-3)


if __name__ == "__main__":
    unittest.main()
