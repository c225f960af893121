"""The estimate of the discretisation error (output/error estimate) against errors that are known."""
import os
import unittest

import h5py
import numpy as np

from compared_case import problem
from mudline_case import ROOT, MudlineCase, deck_text, program
from references import biot

ON = "output/error estimate=true"
YOUNG, POISSON = 1e7, 0.25
SHEAR = YOUNG / (2 * (1 + POISSON))
LAME = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
ELASTIC = {"type": "linear elastic", "Young's modulus": YOUNG, "Poisson's ratio": POISSON}
WALL = 1e-8  # [m] the motion of the cylinder's wall: strains are small


def cylinder(cell, cells):
    """A thick elastic cylinder, 1 m < r < 2 m, whose inner wall is pushed outwards while the outer one is held."""
    fixed = {"type": "fixed", "components": "y"}
    return {
        "mesh": {"type": "box", "geometry": "axisymmetric", "cell": cell, "cells": [cells, cells // 2],
                 "lower": [1.0, 0.0], "upper": [2.0, 0.5]},
        "materials": {"soil": {"density": 2000.0, "skeleton": ELASTIC}},
        "physics": {"ground": {"type": "solid"}},
        "boundary conditions": {
            "below": {**fixed, "set": "bottom"}, "above": {**fixed, "set": "top"},
            "outside": {"type": "fixed", "components": "x", "set": "right"},
            "inside": {"type": "displacement", "set": "left", "x": f"{WALL}*t"}},
        "stages": {"push": {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 0.5}}},
        "solver": {"residual tolerance": 1e-11, "update tolerance": 1e-9},
        "output": {"error estimate": True},
    }


# u = A r + B / r
B = WALL / (1 - 0.25)
A = -B / 4
EXACT = 2 * np.pi * 0.5 * (2 * SHEAR * B - 2 * (LAME + SHEAR) * A)


@problem("exact", "the true error, from Lamé's solution", "Error estimate, elastic cylinder")
class Elastic(MudlineCase):
    def run_cylinder(self, cell, cells, ranks=1):
        name = f"{cell}_{cells}_{ranks}"
        deck = self.write(name + ".xml", deck_text("cylinder", cylinder(cell, cells)))
        return self.run_deck(deck, ranks=ranks, name=name)

    def test_stress_and_resistance_of_a_cylinder(self):
        """Of a force under which a linear soil moves as prescribed, the error is the square of that of the stress in the
        norm of energy. Effectivities within a tenth for the stress, two tenths for the force."""
        for cell in ("quad9", "tri6"):
            found = []
            for cells in (4, 8):
                history = self.run_cylinder(cell, cells)
                force, error = history["reaction/inside x"][-1], history["reaction/inside x error"][-1]
                share, true = history["mesh/stress error"][-1], force / EXACT - 1
                self.assertGreater(true, 1e-9)
                self.compare_values(f"{cell}, {cells} cells: error of the stress", share, np.sqrt(true), 0.1)
                self.compare_values(f"{cell}, {cells} cells: error of the force", error, force - EXACT, 0.2)
                found.append(share)
            self.compare_values(f"{cell}: order", np.log2(found[0] / found[1]), 2.0, 0.1)

    @problem("consistency")
    def test_ranks_agree(self):
        one, two = self.run_cylinder("tri6", 8), self.run_cylinder("tri6", 8, ranks=2)
        for column in ("mesh/stress error", "reaction/inside x error"):
            self.compare_values(column, two[column][-1], one[column][-1], 1e-8)
        fields = [h5py.File(os.path.join(self.folder, "results", f"tri6_8_{ranks}.h5"), "r") for ranks in (1, 2)]
        for name in ("error_stress", "error_wanted_size"):
            a, b = (file["steps"][sorted(file["steps"])[-1]]["cell/" + name][:] for file in fields)
            self.assertGreater(a.min(), 0)
            self.compare(name, np.abs(a / b - 1).max(), 1e-8)


@problem("exact", "the true error, from Terzaghi's series", "Error estimate, flow")
class Flow(MudlineCase):
    def test_gradient_and_pressure_of_terzaghis_column(self):
        """The gradient's effectivity within a tenth, and the error of a probe's pressure is that of its elements."""
        column = biot.Column(biot.INCOMPRESSIBLE, load=10.0)
        time = column.time(0.1)
        deck = os.path.join(ROOT, "inputs", "consolidation", "terzaghi.xml")
        shares = []
        for cells in (10, 20):
            history = self.run_deck(deck, [ON, f"mesh/cells={{1, {cells}}}", "mesh/grading={1.0, 1.0}",
                                           f"stages/consolidation/duration={time}", "output/probes/quarter={0.0, 0.75}"])
            p = self.pressures("terzaghi")
            y = np.linspace(0, 1, 20 * cells + 1)
            y = 0.5 * (y[1:] + y[:-1])
            step = 1e-5
            slope = np.array([(column.pressure(1 - h - step, 0.1) - column.pressure(1 - h + step, 0.1)) / (2 * step) for h in y])
            own = (np.diff(p) * cells)[(y * cells).astype(int)]
            true = np.sqrt(np.mean((own - slope) ** 2))
            share = history["mesh/flow error"][-1]
            found = share / np.sqrt(1 - share ** 2) * np.sqrt(np.mean(own ** 2))
            self.compare_values(f"{cells} cells: gradient", found, true, 0.1)
            shares.append(share)
            # at three quarters of the height, beside which the pressure is most curved, linear cells are off by about
            # h^2 p'' / sqrt(120)
            curvature = (column.pressure(0.25 - 1e-3, 0.1) - 2 * column.pressure(0.25, 0.1) + column.pressure(0.25 + 1e-3, 0.1)) / 1e-6
            self.compare_values(f"{cells} cells: probe", history["probe/quarter/pore pressure error"][-1],
                                abs(curvature) / cells ** 2 / np.sqrt(120), 0.15)
        self.compare_values("order", np.log2(shares[0] / shares[1]), 1.0, 0.1)

    def pressures(self, stem):
        with h5py.File(os.path.join(self.folder, "results", stem + ".h5"), "r") as file:
            last = file["steps"][sorted(file["steps"])[-1]]
            x, p = file["mesh/coordinates"][:], last["nodal/pore_pressure"][:]
            corners = np.unique(file["mesh/topology"][:].reshape(-1, 10)[:, 1:5])
        left = [node for node in corners if abs(x[node, 0]) < 1e-9]
        return p[sorted(left, key=lambda node: x[node, 1])]


@problem("consistency", title="Error estimate, strip footing against a fine mesh")
class Footing(MudlineCase):
    """A strip footing on graded meshes: its force's estimate against the difference to a fine mesh."""
    DECK = os.path.join(ROOT, "inputs", "bearing_capacity", "strip_tresca.xml")

    def forces(self, name, deck, settings, meshes):
        found = []
        for cells in meshes:
            history = self.run_deck(deck, [ON, f"mesh/parameters/cells={cells}", "output/name=footing"] + settings, name="footing")
            found.append((-history["reaction/footing y"][-1], history["reaction/footing y error"][-1]))
        for cells, (force, error) in zip(meshes[:-1], found):
            if os.environ.get("MUDLINE_SHOW_ERRORS"):
                print(f"{name}, {cells} cells: force {force:.6g} N, true error {force - found[-1][0]:.4g}, estimated {error:.4g}")
        return found

    def test_elastic(self):
        """Before the test was run: within a factor of two."""
        soil = self.write("elastic.xml", deck_text("elastic", {"materials": {"soil": {"skeleton": {
            "type": "linear elastic", "Young's modulus": YOUNG, "Poisson's ratio": 0.3}}}}))
        text = open(self.DECK).read()
        for name in ("undrained strength", "rigidity index"):
            line = next(line for line in text.splitlines() if f'"{name}"' in line)
            text = text.replace(line + "\n", "")
        deck = self.write("deck.xml", text.replace("footing.geo", os.path.join(os.path.dirname(self.DECK), "footing.geo")))
        found = self.forces("elastic", [deck, soil], ["stages/loading/time step/initial=0.5", "stages/loading/time step/maximum=0.5",
                                                      "mesh/parameters/ratio=2"], (3, 6, 24))
        for force, error in found[:-1]:
            true = force - found[-1][0]
            self.assertGreater(true, 0)
            self.compare(f"estimated {error:.4g}, true {true:.4g}", abs(np.log2(error / true)), 1)


@problem("behaviour", title="Error estimate, restart")
class Restart(MudlineCase):
    def test_goes_on_as_if_it_had_not_stopped(self):
        deck = self.write("deck.xml", deck_text("cylinder", cylinder("quad9", 4)))
        slow = ["stages/push/time step/initial=0.25"]
        stop = {"boundary conditions/inside/x": f"{WALL}*min(t, 0.5)"}
        slow += [f"{path}={value}" for path, value in stop.items()]  # it rests in the second half: the estimate stands
        whole = self.run_deck(deck, slow + ["output/name=whole"], name="whole")
        self.assertGreater(whole["reaction/inside x error"][-1], 0)
        for extra in (["--steps", "3"], ["--restart"]):
            done = program(["run", "-q", deck, *extra, "--set", "output/name=parts"] + [a for s in slow for a in ("--set", s)], 1, self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
        texts = [open(os.path.join(self.folder, "results", name + ".csv")).read() for name in ("whole", "parts")]
        self.assertEqual(*texts)


if __name__ == "__main__":
    unittest.main()
