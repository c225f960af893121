"""Small-strain stiffness over several laws against closed forms (references/small_strain.py), in `mudline point` and
around a cavity.

Bricks make a polygon of the curve: with a ratio of 5 the secant of twelve is allowed to be 0.35 % off, the area of their
loops 5 %; that of forty 0.03 and 1 %."""
import os
import unittest

import h5py
import numpy as np

from compared_case import problem
from mudline_case import ROOT, History, MudlineCase, deck_text, point_deck, program
from references.small_strain import Curve

RATIO, STRAIN = 5.0, 1e-4
SMALL = {"ratio": RATIO, "reference strain": STRAIN}
BRICKS = {12: (3.5e-3, 0.05), 40: (3e-4, 0.01)}  # errors of the secant modulus and of the damping ratio
SECANT = BRICKS[12][0]
START = {"mean effective stress": 1e5}
E, NU = 2.6e7, 0.3
G = E / 2 / (1 + NU)
ELASTIC = {"Young's modulus": E, "Poisson's ratio": NU}
CLAY = {"critical stress ratio": 1.0, "compression slope": 0.2, "swelling slope": 0.02, "Poisson's ratio": 0.25}
CLAY_K = 2.0 * 1e5 / 0.02
CLAY_G = 0.6 * CLAY_K
# law, its G at the start, shear stress in simple shear at failure (or None), parameters
LAWS = {
    "linear elastic": (G, None, ELASTIC),
    "tresca": (G, 60e3, {"undrained strength": 60e3, "shear modulus": G, "Poisson's ratio": 0.45}),
    "von mises": (G, 60e3, dict(ELASTIC, **{"yield stress": 60e3 * 3**0.5})),
    "drucker-prager": (G, None, dict(ELASTIC, **{"friction angle [deg]": 30.0, "cohesion": 1e4})),
    # at 0 degrees of dilation p' stays, and the strength in plane shear is c cos phi + p' sin phi
    "mohr-coulomb": (G, 1e4 * np.cos(np.pi / 6) + 0.5e5, dict(ELASTIC, **{
        "friction angle [deg]": 30.0, "cohesion": 1e4, "stiffness exponent": 0.5, "apex rounding": 0.001})),
    "modified cam clay": (CLAY_G, None, CLAY),
    "s-clay1s": (CLAY_G, None, CLAY),
}
LOOPS = (0.3, 1.0, 3.0, 20.0)  # amplitudes over gamma_0.7


def law(name, small=SMALL, **more):
    skeleton = dict(LAWS[name][2], type=name, **more)
    if small:
        skeleton["small-strain stiffness"] = small
    return skeleton


def path(steps=80, duration=1.0, **components):
    test = {"type": "path", "duration": duration, "steps": steps, "initial state": dict(START)}
    test.update({name.replace("_", " "): value for name, value in components.items()})
    return test


@problem("exact", "Hardin and Drnevich, Santos and Correia, Masing", "Small-strain stiffness")
class SmallStrain(MudlineCase):
    def point(self, skeleton, tests):
        return self.run_point(self.write("soil.xml", point_deck(skeleton, tests, 1.0)))

    def close(self, what, found, exact, allowed):
        self.compare(what, np.abs(found - exact).max(), allowed)

    def test_curve(self):
        """First loading in simple shear from 1e-6 to 1 %: the secant modulus of each law, and its strength."""
        for name, (shear, strength, _) in LAWS.items():
            test = path(90, shear_strain_xy="1e-6*(exp(9.2104*t)-1)")
            test["initial state"]["overconsolidation ratio"] = 4.0
            history = self.point(law(name), {"shear": test})["shear"]
            gamma, tau = history["shear strain xy"][1:], history["shear stress xy"][1:]
            curve = Curve(RATIO * shear, shear, STRAIN)
            elastic = curve.first(gamma) < 0.6 * (strength or 5e4)
            self.assertGreater(np.count_nonzero(elastic), 50)
            self.assertGreater(gamma[elastic][-1], 1.2 * curve.end)
            self.close(f"{name}, secant", (tau / curve.first(gamma))[elastic], 1.0, SECANT)
            if strength:
                self.close(f"{name}, strength", tau[-1] / strength, 1.0, 2e-3)
        test = path(90, shear_strain_xy="1e-6*(exp(8.0*t)-1)")
        darendeli = self.point(law("tresca", dict(SMALL, curvature=0.919)), {"shear": test})["shear"]
        gamma, tau = darendeli["shear strain xy"][1:], darendeli["shear stress xy"][1:]
        curve = Curve(RATIO * G, G, STRAIN, 0.919)
        self.close("Darendeli, secant", tau / curve.first(gamma), 1.0, SECANT)

    def test_stiffness_of_changing_pressure(self):
        """Cam Clay sheared while p' grows to twice its value: K is the law's own, dtau = m(gamma) G(p') dgamma."""
        test = path(400, shear_strain_xy="4e-4*t", **{f"strain_{c}": "0.0025*t" for c in ("xx", "yy", "zz")})
        test["initial state"]["overconsolidation ratio"] = 6.0
        skeleton = law("modified cam clay", **{"specific volume": "initial"})
        history = self.point(skeleton, {"both": test})["both"]
        pressure = 1e5 * np.exp(history["volumetric strain"] * 2.0 / 0.02)
        self.assertGreater(pressure[-1], 2e5)
        self.close("p'", history["mean effective stress"] / pressure, 1.0, 1e-6)
        gamma = np.linspace(0, 4e-4, 40001)
        curve = Curve(RATIO, 1.0, STRAIN)
        rate = 0.6 * 2.0 / 0.02 * 1e5 * np.exp(2.0 / 0.02 * 0.0075 * gamma / 4e-4) * curve.tangent(gamma)
        tau = np.concatenate(([0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(gamma))))
        exact = np.interp(history["shear strain xy"], gamma, tau)
        self.close("tau", history["shear stress xy"][5:] / exact[5:], 1.0, 5e-3)

    def test_loops(self):
        """Closed loops that follow Masing, and their damping ratio."""
        for name, bricks in (("linear elastic", 12), ("modified cam clay", 12), ("tresca", 40)):
            shear, (secant, loop) = LAWS[name][0], BRICKS[bricks]
            curve = Curve(RATIO * shear, shear, STRAIN)
            tests = {f"loop {a:g}": path(1000, 2.5, shear_strain_xy=f"{a * STRAIN:g}*{TRIANGLE}") for a in LOOPS}
            for test in tests.values():
                test["initial state"]["overconsolidation ratio"] = 6.0
            for a, history in zip(LOOPS, self.point(law(name, dict(SMALL, bricks=bricks)), tests).values()):
                gamma, tau = history["shear strain xy"], history["shear stress xy"]
                size, what = curve.first(a * STRAIN), f"{name}, {a:g}"
                # the error of the reversal, and twice that of the way from it
                self.close(f"{what}: branches", tau, curve.history(gamma), 3 * secant * size)
                # periods end at t = 0.25 + n: rows 100, 500, 900
                self.close(f"{what}: closed", tau[900], tau[500], 1e-9 * size)
                area = np.trapz(tau[500:901], gamma[500:901])
                damping = area / (2 * np.pi * a * STRAIN * tau[500])
                self.close(f"{what}: damping {damping:.4f}", damping / curve.damping(a * STRAIN), 1.0, loop)

    def test_inner_loop(self):
        """A small loop within a large one leaves no trace."""
        strain = ("3e-4*(min(t,1)-min(max(t-1,0),1)+0.2*min(max(t-2,0),1)-0.1*min(max(t-3,0),1)+0.1*min(max(t-4,0),1)"
                  "-0.7*min(max(t-5,0),1))")
        history = self.point(law("linear elastic"), {"nested": path(600, 6.0, shear_strain_xy=strain)})["nested"]
        exact = Curve(RATIO * G, G, STRAIN).history(history["shear strain xy"])
        self.close("nested loops", history["shear stress xy"], exact, 2 * SECANT * exact.max())

    def test_undrained_triaxial(self):
        """Undrained compression of lightly overconsolidated Cam Clay: stress path and strength are those of the law
        alone, and at the same stress the axial strain is less by that of the strings, all of them taut."""
        start = dict(START, **{"overconsolidation ratio": 1.2})
        test = {"type": "triaxial undrained", "axial strain": [0.02, 0.2], "steps": 500, "initial state": start}
        plain = self.point(law("modified cam clay", None), {"CU": test})["CU"]
        stiff = self.point(law("modified cam clay"), {"CU": test})["CU"]
        q, p = plain["stress difference"], plain["mean effective stress"]
        self.close("path", stiff["mean effective stress"] / np.interp(stiff["stress difference"], q, p), 1.0, 1e-3)
        self.close("strength", stiff["stress difference"][-1] / q[-1], 1.0, 1e-4)
        late = (stiff["stress difference"] > 0.7 * q[-1]) & (stiff["stress difference"] < 0.95 * q[-1])
        self.assertGreater(np.count_nonzero(late), 20)
        lag = np.interp(stiff["stress difference"], q, plain["axial strain"])[late] - stiff["axial strain"][late]
        strings = (Curve(RATIO, 1.0, STRAIN).first(1e-2) - 1e-2) / np.sqrt(3)
        self.close("strings", lag / strings, 1.0, 0.02)

    def test_cavity(self):
        """A pressuremeter in clay without drainage: expansion by 0.1 % and back, with G_0, with strings and with G_ur;
        a restart gives the same bits."""
        law_text = "materials/soil/skeleton/"
        deck = os.path.join(ROOT, "inputs", "cavity_expansion", "cylinder.xml")
        end, strain = 1e-3, 4e-4
        settings = ["mesh/cells={24, 1}", "stages/expansion/duration=2",
                    f"boundary conditions/cavity/x={end}*min(t,2-t)",
                    "stages/expansion/time step/initial=0.05", "stages/expansion/time step/maximum=0.05",
                    law_text + "rigidity index=100"]
        small = [law_text + f"small-strain stiffness/ratio={RATIO}",
                 law_text + f"small-strain stiffness/reference strain={strain}"]
        history = self.run_deck(deck, settings + small)
        curve = Curve(RATIO * 2e6, 2e6, strain)
        wall = end * np.minimum(history.time, 2 - history.time)
        pressure = history["reaction/cavity x"] / (2 * np.pi * (1 + wall)) - 100e3
        gamma = 2 * np.log1p(wall)
        up = np.array([curve.cavity(x) for x in gamma])
        top = history.time.searchsorted(1.0 - 1e-9)
        down = np.array([2 * curve.cavity(0.5 * (gamma[top] - x)) if x < gamma[top] else 0.0 for x in gamma])
        exact = np.where(history.time > history.time[top], up[top] - down, up)
        self.close("cavity, pressure", pressure, exact, 0.003 * exact.max())
        first = pressure[0] / gamma[0] / 2e6
        self.close("cavity, first modulus over that of the law", first, up[0] / gamma[0] / 2e6, 0.02)
        reached = []
        for ratio in (1.0, RATIO):  # the law alone with G_ur, and with G_0
            stronger = law_text + f"undrained strength={20e3 * ratio}"
            only = self.run_deck(deck, settings + ["stages/expansion/duration=1", stronger])
            reached.append(only["reaction/cavity x"][-1] / (2 * np.pi * (1 + end)) - 100e3)
            self.close(f"cavity, {ratio:g} G_ur", reached[-1] / (2e6 * ratio * gamma[top]), 1.0, 0.002)
        self.assertTrue(1.5 * reached[0] < pressure[top] < 0.7 * reached[1])
        self.restarted(deck, settings + small)

    def test_numbers_of_place(self):
        """A column whose ratio and reference strain vary with the height, by an expression and by a profile, sheared
        at its top: the displacement is the integral of the strains that belong to one shear stress. The field of the
        present stiffness begins with the ratio of each cell and falls."""
        profile = {"profile": {"type": "profile", "depths": [0.0, 1.0], "values": [7.0, 3.0], "surface": 1.0}}
        end, heights = 2e-4, np.linspace(0, 1, 201)
        strains = np.linspace(0, 2e-3, 4001)
        columns = [Curve(G * (3 + 4 * y), G, 1e-4 * (1 + y)).first(strains) for y in heights]
        for ratio, functions in (("3 + 4*y", {}), ("profile", {"functions": profile})):
            skeleton = {"type": "linear elastic", **ELASTIC,
                        "small-strain stiffness": {"ratio": ratio, "reference strain": "1e-4*(1 + y)"}}
            sides = {side: {"type": "fixed", "set": side, "components": "y"} for side in ("left", "right", "top")}
            deck = deck_text("column", {
                **functions, "mesh": {"type": "box", "cell": "quad9", "cells": [1, 4], "upper": [1.0, 1.0]},
                "materials": {"soil": {"density": 1800.0, "skeleton": skeleton}},
                "physics": {"ground": {"type": "solid"}},
                "boundary conditions": {"base": {"type": "fixed", "set": "bottom"}, **sides,
                                        "pull": {"type": "displacement", "set": "top", "x": f"{end}*t"}},
                "stages": {"shear": {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 0.1}}}})
            history = self.run_deck(self.write("column.xml", deck), extra=["--overwrite"])
            stress = abs(history["reaction/pull x"][-1])
            pulled = np.trapz([np.interp(stress, column, strains) for column in columns], heights)
            self.close(f"{ratio}, displacement", pulled / end, 1.0, 5e-3)
            with h5py.File(self.folder + "/results/column.h5", "r") as file:
                steps = [file["steps"][name]["cell/shear_stiffness_ratio"][()] for name in sorted(file["steps"])]
            self.close(f"{ratio}, field", np.sort(steps[0]), np.array([3.5, 4.5, 5.5, 6.5]), 1e-9)
            self.assertTrue((steps[-1] < 0.8 * steps[0]).all() and (steps[-1] >= 1).all(), steps[-1])

    def test_present_stiffness(self):
        """The column `shear stiffness ratio` of a test: G_0 over that of the law at rest, nearly so after a
        reversal, the slope of the bricks on the way, 1 at the end."""
        test = path(400, 2.0, shear_strain_xy="1e-3*(t-2*max(t-1,0))")
        for name in ("linear elastic", "modified cam clay"):
            test["initial state"]["overconsolidation ratio"] = 6.0
            history = self.point(law(name), {"shear": test})["shear"]
            columns = ("shear stiffness ratio", "shear strain xy", "shear stress xy")
            present, gamma, tau = (history[column] for column in columns)
            self.close("at rest", present[0], RATIO, 1e-12)
            self.close("beyond the strings", present[200], 1.0, 1e-12)
            # the step back of 5e-6 is longer than the first of twelve bricks allows
            self.assertTrue(0.95 * RATIO < present[201] < RATIO, present[201])
            slope = np.diff(tau) / np.diff(gamma) / LAWS[name][0]
            steady = present[1:-1] == present[2:]  # no string came to its end in the step
            steady &= np.arange(1, len(present) - 1) != 200  # the reversal
            self.assertGreater(np.count_nonzero(steady), 300)
            self.close(f"{name}, slope", present[1:-1][steady], slope[1:][steady], 1e-6)

    def test_strip(self):
        """A strip footing on clay: stiffer at first, the same limit load."""
        deck = os.path.join(ROOT, "inputs", "bearing_capacity", "strip_tresca.xml")
        small = ["materials/soil/skeleton/small-strain stiffness/" + entry
                 for entry in ("ratio=5", "reference strain=1e-6")]
        alone, stiff = (self.run_deck(deck, settings)["reaction/footing y"] for settings in ([], small))
        self.assertTrue(2 * alone[0] > stiff[0] > 5 * alone[0], "first step")  # upwards is positive
        self.close("limit load", stiff[-1] / alone[-1], 1.0, 2e-3)

    def restarted(self, deck, settings):
        """The last row of a run that was interrupted in the middle is that of the whole one, bit for bit."""
        words = [word for setting in settings for word in ("--set", setting)]
        rows = []
        for name, more in (("whole", []), ("half", ["--steps", "25"]), ("half", ["--restart"])):
            done = program(["run", "-q", deck, *words, "--set", f"output/name={name}", *more], folder=self.folder)
            self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])
            rows.append(History(os.path.join(self.folder, "results", name + ".csv")).data[-1])
        self.assertEqual(rows[0].tolist(), rows[2].tolist())


# a triangle of amplitude 1 and period 1 that starts upwards
TRIANGLE = "(2/3.141592653589793*asin(sin(6.283185307179586*t)))"

if __name__ == "__main__":
    unittest.main()
