"""Steps that Newton's method must find with its defaults: a sudden load on soft clay, and rough bodies laid down by a force."""
import os
import re
import unittest

from mudline_case import ROOT, History, MudlineCase, deck_text, program


class Convergence(MudlineCase):
    def take(self, name, entries, steps, *more):
        """Runs so many steps; none may be rejected. Returns the history and the largest number of iterations of a step."""
        path = self.write(name + ".xml", deck_text(name, entries))
        done = program(["run", "--overwrite", "--steps", steps, path, *more], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout[-1500:] + done.stderr[-1500:])
        self.assertNotIn("rejected:", done.stdout)
        history = History(os.path.join(self.folder, "results", name + ".csv"))
        return history, max(int(n) for n in re.findall(r"  newton (\d+)", done.stdout))


class SuddenLoad(Convergence):
    """Soft Modified Cam Clay under 15 kPa, drained at the top, is loaded at once."""

    def column(self, load, cell="tri6", initial=15e3, solver=None, cells=8.0):
        k0 = 10594.721351384682 / 15000
        return {
            "mesh": {"type": "box", "cell": cell, "cells": [1.0, cells], "upper": [0.4, 1.6], "grading": [1.0, 0.15]},
            "materials": {"clay": {
                "void ratio": 2.1,
                "skeleton": {"type": "modified cam clay", "critical stress ratio": 1.05, "compression slope": 0.38, "swelling slope": 0.06,
                             "Poisson's ratio": 0.25},
                "fluid": {"type": "water", "incompressible": True, "unit weight": 9810.0},
                "permeability": {"type": "log-linear", "hydraulic conductivity": 3e-9, "permeability index": 0.8}}},
            "physics": {"ground": {"type": "biot", "initial state": {
                "type": "uniform", "effective stress yy": initial, "effective stress xx": k0 * initial, "effective stress zz": k0 * initial}}},
            "boundary conditions": {
                "base": {"type": "fixed", "set": "bottom", "components": "y"},
                **{side: {"type": "fixed", "set": side, "components": "x"} for side in ("left", "right")},
                "drained": {"type": "pore pressure", "set": "top"},
                "load": {"type": "pressure", "set": "top", "value": initial + load}},
            "stages": {"consolidation": {"type": "quasi-static", "duration": 1.2e8, "integrator": {"type": "theta", "theta": 0.5},
                                         "time step": {"initial": 1200.0, "growth": 1.06, "maximum": 8e5}}},
            "output": {"probes": {"base": [0.0, 0.0]}},
            **({"solver": solver} if solver else {})}

    def test_runs_by_defaults(self):
        for cell, loads in (("tri6", (100e3, 240e3, 400e3)), ("quad9", (100e3, 240e3))):
            for load in loads:
                with self.subTest(load=load, cell=cell):
                    history, _ = self.take("column", self.column(load, cell), 6)
                    # water that cannot leave bears the load
                    self.assertAlmostEqual(history["probe/base/pore pressure"][-1] / load, 1, delta=0.03)

    def test_the_answer_is_that_of_damped_steps(self):
        """The second solve of a step is the one that 'largest growth' = 1.2 makes."""
        retried, _ = self.take("column", self.column(240e3), 3)
        damped, _ = self.take("column", self.column(240e3, solver={"newton": {"largest growth": 1.2}}), 3)
        column, first = "probe/base/pore pressure", list(retried.time).index(1200.0)
        self.assertLess(abs(retried[column][first] / damped[column][first] - 1), 1e-9)
        self.assertGreater(retried["step/newton iterations"][first], damped["step/newton iterations"][first])

    def test_without_the_second_solve_it_is_cut(self):
        path = self.write("column.xml", deck_text("column", self.column(240e3, solver={"newton": {"damped retry": False}})))
        done = program(["run", "--steps", 1, path], folder=self.folder)
        self.assertIn("step 1 rejected:", done.stdout)


class Rate(Convergence):
    """A slow push of a cone into clay whose strength grows with the logarithm of the strain rate. The growth begins
    where the rate passes a given one, here in the middle of the soil's rates."""

    def steps(self, name, **law):
        deck = os.path.join(ROOT, "inputs", "cpt", "tresca.xml")
        settings = {"output/name": name, "stages/push/duration": 0.15,
                    **{"materials/clay/skeleton/" + word.replace("_", " "): value for word, value in law.items()}}
        words = [word for entry, value in settings.items() for word in ("--set", f"{entry}={value}")]
        done = program(["run", deck, *words], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout[-1500:] + done.stderr[-1500:])
        taken, rejected = re.search(r"done: (\d+) steps(?:, (\d+) rejected)?", done.stdout).groups()
        return int(taken), int(rejected or 0)

    def test_takes_no_more_steps(self):
        without, _ = self.steps("without")
        taken, rejected = self.steps("rate", rate_law="logarithmic", rate_coefficient=0.1, reference_strain_rate=0.3)
        self.assertLessEqual(taken, 1.3 * without)
        self.assertLessEqual(rejected, 0.02 * taken)


class LaidDown(Convergence):
    """Rough bodies without a support of their own are laid on elastic ground by a force."""
    SLAB = {"slab": {"density": 2500.0, "skeleton": {"type": "linear elastic", "Young's modulus": 5e7, "Poisson's ratio": 0.2}}}
    STRIP = {"type": "strip", "extent": "full", "width": 0.6, "thickness": 0.2, "corner radius": 0.04}

    def plane(self, contour=None, friction=0.4, force=-2800.0, height=0.0, freedom=("y",), step=0.25, poisson=0.2, penalty=None, adhesion=0.0):
        materials = {"slab": {**self.SLAB["slab"], "skeleton": {**self.SLAB["slab"]["skeleton"], "Poisson's ratio": poisson}}}
        contact = {"type": "penalty", "body": "block", "surface": "top", "friction": {"type": "coulomb", "coefficient": friction}}
        if adhesion > 0:
            contact["friction"]["adhesion"] = adhesion
        if penalty:
            contact["penalty factor"] = penalty
        body = {"position": [0.0, height], "mass": 333.0, "contour": contour or self.STRIP,
                "motion": {"type": "force", "freedom": list(freedom), "force y": f"{force}*min(t,1)"}}
        if "rotation" in freedom:
            body.update({"moment of inertia": 10.0, "centre of mass": [0.0, 0.1]})
        return {"mesh": {"type": "box", "geometry": "plane strain", "cell": "quad9", "cells": [8.0, 2.0], "lower": [-0.6, -0.3], "upper": [0.8, 0.0]},
                "materials": materials, "physics": {"slab": {"type": "solid"}}, "bodies": {"block": body},
                "boundary conditions": {"base": {"type": "fixed", "set": "bottom"}}, "contacts": {"touch": contact},
                "stages": {"lay down": {"type": "quasi-static", "duration": 1.0, "time step": {"initial": step}}}}

    def space(self, friction=0.4, freedom=("z",), side=0.6):
        return {"mesh": {"type": "box", "geometry": "three-dimensional", "cell": "hex8", "cells": [8.0, 8.0, 2.0], "lower": [-0.6, -0.6, -0.3],
                         "upper": [0.8, 0.8, 0.0]},
                "materials": self.SLAB, "physics": {"slab": {"type": "solid"}},
                "bodies": {"block": {"position": [0.0, 0.0, 0.1], "mass": 200.0,
                                     "surface": {"type": "box", "length x": side, "length y": 0.6, "length z": 0.2, "fillet radius": 0.04},
                                     "motion": {"type": "force", "freedom": list(freedom), "force z": "-1700*min(t,1)"}}},
                "boundary conditions": {"base": {"type": "fixed", "set": "bottom"}},
                "contacts": {"touch": {"type": "penalty", "body": "block", "surface": "top", "friction": {"type": "coulomb", "coefficient": friction}}},
                "stages": {"lay down": {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 0.25}}}}

    def laid(self, entries, force, axis, steps=4, most=8):
        history, iterations = self.take("block", entries, steps)
        self.assertAlmostEqual(history[f"contact/touch/reaction {axis}"][-1] / (-force * history.time[-1]), 1, delta=1e-5)
        if most:
            self.assertLessEqual(iterations, most)

    def test_in_the_plane(self):
        cylinder = {"type": "cylinder", "extent": "full", "diameter": 0.6}
        for keys in ({}, {"friction": 0.1}, {"friction": 0.8}, {"step": 1.0}, {"height": 1e-3}, {"freedom": ("x", "y", "rotation")},
                     {"contour": cylinder}, {"contour": cylinder, "height": 1e-4}, {"poisson": 0.45}, {"penalty": 1.0}, {"penalty": 100.0},
                     {"adhesion": 500.0}, {"force": -28.0}, {"force": -28000.0}):
            with self.subTest(**{k: str(v) for k, v in keys.items()}):
                entries = self.plane(**keys)
                # a body in the air takes guesses until it touches, twelve to sixteen, the damped ones among them: no step may be lost
                self.laid(entries, keys.get("force", -2800.0), "y", steps=1 if keys.get("step") else 4, most=None if "height" in keys else 8)
                with open(os.path.join(self.folder, "results", "block.results.csv"), encoding="utf-8") as file:
                    self.assertEqual("shaft resistance" in file.read(), "contour" in keys)  # a strip has no shaft

    def test_in_space(self):
        for keys in ({}, {"friction": 0.1}, {"friction": 0.8}, {"side": 0.4}):
            with self.subTest(**{k: str(v) for k, v in keys.items()}):
                self.laid(self.space(**keys), -1700.0, "z")


if __name__ == "__main__":
    unittest.main()
