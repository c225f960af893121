"""In space the inside of the region is remeshed during the run: constant stresses stay what they are, an answer changes by less than a
thousandth, what is conserved stays, a restart goes on on the last mesh bit for bit, and ranks agree."""
import os
import re
import unittest

import h5py
import numpy as np

from compared_case import problem
from mudline_case import ROOT, deck_text, program
from space_case import ELASTIC, SIDES, SpaceCase, deck, quasi_static
from swinging_mesh import swinging_mesh

LOAD = 3452184.8694  # [Pa] a quarter of the height of the column
BALL = os.path.join(ROOT, "inputs", "space", "ball.xml")


def remeshing(steps, swing=None, wall=0.0, **motion):
    """An overlay: the region is remeshed after so many steps, whatever its quality; `swing`: the period in which the vertices inside swing
    [s]; `wall`: size at a body [m]."""
    parts = {"remeshing": {"when quality below": 0.0, "when side above": 0.1, "least steps": steps, "wall size": wall}, **motion}
    return deck_text("remeshing", swinging_mesh(0.2, swing, **parts) if swing else {"mesh motion": parts})


@problem("consistency", title="Remeshing in space")
class Remeshing(SpaceCase):
    def test_uniform_stress_survives(self):
        stress = {"effective stress xx": 3e4, "effective stress yy": 5e4, "effective stress zz": 2e4, "shear stress xy": 1e4, "shear stress yz": -4e3}
        for cell in ("tet4", "tet10"):
            with self.subTest(cell=cell):
                held = self.write("uniform.xml", deck_text("uniform", {
                    "mesh": {"type": "box", "geometry": "three-dimensional", "cell": cell, "cells": [3, 3, 3], "upper": [1.0, 1.0, 1.0], "distortion": 0.2},
                    "materials": {"soil": {"void ratio": 0.8, "skeleton": {"type": "linear elastic", "Young's modulus": 1e7, "Poisson's ratio": 0.3}}},
                    "physics": {"ground": {"type": "solid", "initial state": {"type": "uniform", **stress}}},
                    "boundary conditions": {side: {"type": "fixed", "set": side} for side in SIDES},
                    "stages": {"hold": quasi_static(12.0, 1.0, 1.0, 0)}}))
                history = self.run_deck([held, self.write("remeshing.xml", remeshing(3, swing=7))], extra=["--overwrite"])
                self.assertGreater(history["mesh/remeshings"][-1], 1)
                self.assertGreater(history["mesh/quality"][-1], history["mesh/quality"][0])
                with h5py.File(os.path.join(self.folder, "results", "uniform.h5")) as file:
                    last = file["steps"][sorted(file["steps"])[-1]]
                    found, displacement = last["cell/effective_stress"][:], np.abs(last["nodal/displacement"][:]).max()
                    self.assertEqual(len(found), len(last["mesh/offset"][:]))
                    self.assertNotEqual(len(found), len(file["mesh/offset"]))
                for column, value in zip(range(6), (-3e4, -1e4, 0.0, -5e4, 4e3, -2e4)):  # XDMF's order; tension positive
                    self.compare(f"stress {column}", np.abs(found[:, column] - value).max() / 5e4, 1e-11)
                self.assertLess(displacement, 1e-12)
                self.compare("change of solid", np.abs(history["mesh motion/change of solid"]).max(), 1e-13)

    def test_large_strain_consolidation_does_not_notice(self):
        with open(os.path.join(ROOT, "inputs", "space", "terzaghi.xml")) as file:
            text = re.sub(r'<ParameterList name="probes">.*?</ParameterList>\n', "", file.read(), flags=re.S)
        column = self.write("column.xml", text)
        probes = self.write("probes.xml", deck_text("probes", {"output": {"probes": {
            "base": {"point": [0.03, 0.04, 0.0], "moves with": "nothing"}, "inside": {"point": [0.03, 0.05, 0.41], "moves with": "nothing"}}}}))
        settings = ["mesh/cell=tet10", "mesh/cells={2, 2, 24}", "mesh/upper={0.08, 0.08, 1.0}", f"boundary conditions/load/z={-LOAD}",
                    "stages/consolidation/duration=200", "stages/consolidation/time step/initial=1", "stages/consolidation/time step/growth=1.25",
                    "stages/consolidation/time step/maximum=10", "solver/residual tolerance=1e-8"]
        still = self.run_deck([column, probes], settings)
        moved = self.run_deck([column, probes, self.write("remeshing.xml", remeshing(3, swing=40))], settings + ["output/name=moved"], name="moved")
        self.assertGreater(moved["mesh/remeshings"][-1], 2)
        for name in ("probe/base/pore pressure", "probe/inside/displacement z", "balance/water/outflow"):
            scale = np.abs(still[name]).max()
            self.compare(name, np.abs(moved.at(name, still.time) - still[name]).max() / scale, 1e-3)
        self.compare("change of solid", np.abs(moved["mesh motion/change of solid"]).max(), 1e-11)
        self.compare("change of water", np.abs(moved["mesh motion/change of water"]).max(), 1e-10)

    @problem("exact", "what the transfer must keep: grains, water, momentum")
    def test_what_is_conserved(self):
        box = {"type": "box", "cell": "tet10", "cells": [3, 3, 3], "upper": [1.0, 1.0, 1.0], "distortion": 0.3}
        skeleton = {"porosity": 0.4, "grain density": 2700.0, "skeleton": ELASTIC,
                    "fluid": {"type": "water", "bulk modulus": 2e9, "density": 1000.0},
                    "permeability": {"type": "constant", "hydraulic conductivity": 1e-4}}
        conditions = {"bottom": {"type": "fixed", "set": "bottom"}, "drained": {"type": "pore pressure", "set": "top", "value": 0.0},
                      "load": {"type": "traction", "set": "top", "x": "1e5*sin(100*t)", "z": "-2e5*sin(70*t)"}}
        stage = {"type": "dynamic", "duration": 0.03, "time step": {"initial": 0.002, "maximum": 0.002}}
        text = deck("shaken", box, conditions, {"shake": stage}, physics="biot", material=skeleton)
        # nothing but the remeshings moves the mesh
        moved = self.run_deck([self.write("shaken.xml", text), self.write("remeshing.xml", remeshing(4, every=1000000))])
        self.assertGreaterEqual(moved["mesh/remeshings"][-1], 1)
        self.compare("change of solid", np.abs(moved["mesh motion/change of solid"]).max(), 1e-12)
        self.compare("change of water", np.abs(moved["mesh motion/change of water"]).max(), 1e-12)
        momentum = np.abs(moved["balance/momentum/change x"]).max()
        for axis in "xyz":
            self.compare(f"change of momentum {axis}",
                         np.abs(moved[f"mesh motion/change of momentum {axis}"]).max() / momentum, 1e-12)
        kinetic = moved["mesh motion/change of kinetic energy"]
        self.assertLess(np.diff(kinetic).max(), 1e-12 * np.abs(moved["balance/energy/kinetic"]).max())
        self.assertLess(kinetic[-1], 0)

    def test_a_restart_goes_on_bit_for_bit_and_ranks_agree(self):
        overlay = self.write("remeshing.xml", remeshing(3, swing=0.3, wall=0.25))
        layer = self.write("layer.xml", deck_text("layer", {"materials": {"deep": {
            "top": -0.9, "porosity": 0.45, "density": 1700.0,
            "skeleton": {"type": "tresca", "rigidity index": 100.0, "Poisson's ratio": 0.49, "undrained strength": 30000.0}}}}))
        settings = ["mesh/cells={6, 3, 3}", "mesh/distortion=0.3", "stages/push/duration=0.2", "solver/residual tolerance=1e-10"]

        def run(name, *extra, ranks=1):
            return self.run_deck([BALL, overlay, layer], settings + [f"output/name={name}"], ranks, extra, name=name)

        def content(name):
            with open(os.path.join(self.folder, "results", name + ".csv"), "rb") as file:
                return file.read()

        whole = run("whole")
        self.assertGreaterEqual(whole["mesh/remeshings"][-1], 3)
        for name in ("balance/grains/soil", "balance/grains/deep"):
            self.compare(name, np.ptp(whole[name]) / (whole[name][0]), 1e-12)
        for steps in (4, 3):  # behind a remeshing, and just before one
            run(f"part{steps}", "--steps", str(steps))
            run(f"part{steps}", "--restart")
            self.assertEqual(content(f"part{steps}"), content("whole"))
        names = [name for name in whole.columns if name.startswith(("contact/", "body/", "mesh/", "balance/grains"))]
        self.assert_same_run(whole, run("two", ranks=2), names, "2 ranks")

    @problem("behaviour")
    def test_what_is_for_the_plane_is_refused(self):
        for more, expected in (({"size": "source"}, "size: is for meshes of the plane"),):
            more = self.write("more.xml", deck_text("more", {"mesh motion": {"remeshing": more}}))
            done = program(["run", "-q", BALL, more], folder=self.folder)
            errors = [line for line in done.stderr.splitlines() if line.startswith("error:")]
            self.assertEqual((done.returncode, len(errors)), (2, 1), done.stderr)
            self.assertIn(expected, errors[0])


if __name__ == "__main__":
    unittest.main()
