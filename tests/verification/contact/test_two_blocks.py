"""What contact of two deformable surfaces has in common with that of a body: a film of water between two blocks that are pulled
apart, friction on the effective traction, and blocks that are pressed, dragged and remeshed meanwhile."""
import os
import unittest

import numpy as np
from scipy.interpolate import CubicSpline

from compared_case import problem
from contact_case import ContactCase
from mudline_case import deck_text
from references import biot
from references.suction import PulledPlate
from sliding_blocks import SLIDE

HEIGHT, WIDTH, UNIT_WEIGHT = 1.0, 0.1, 1e4
COLUMN = f'''
Point(1) = {{0, 0, 0}}; Point(2) = {{{WIDTH}, 0, 0}}; Point(3) = {{{WIDTH}, {HEIGHT}, 0}}; Point(4) = {{0, {HEIGHT}, 0}};
Point(5) = {{0, {HEIGHT}, 0}}; Point(6) = {{{WIDTH}, {HEIGHT}, 0}}; Point(7) = {{{WIDTH}, 1.1, 0}}; Point(8) = {{0, 1.1, 0}};
Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 1}};
Line(5) = {{5, 6}}; Line(6) = {{6, 7}}; Line(7) = {{7, 8}}; Line(8) = {{8, 5}};
Curve Loop(1) = {{1, 2, 3, 4}}; Curve Loop(2) = {{5, 6, 7, 8}};
Plane Surface(1) = {{1}}; Plane Surface(2) = {{2}};
Transfinite Curve {{1, 3, 5, 7, 6, 8}} = 2;
Transfinite Curve {{2}} = 41 Using Progression 1.0548;
Transfinite Curve {{4}} = 41 Using Progression 1 / 1.0548;
Transfinite Surface {{1, 2}};
Recombine Surface {{1, 2}};
Physical Surface("lower") = {{1}}; Physical Surface("upper") = {{2}};
Physical Curve("bottom") = {{1}}; Physical Curve("face") = {{3}}; Physical Curve("under") = {{5}}; Physical Curve("top") = {{7}};
Physical Curve("sides") = {{2, 4, 6, 8}};
'''


def saturated(region, young, conductivity):
    return {"regions": [region], "porosity": 0.4, "skeleton": {"type": "linear elastic", "Young's modulus": young, "Poisson's ratio": 0.25},
            "fluid": {"type": "water", "incompressible": True, "unit weight": UNIT_WEIGHT},
            "permeability": {"type": "constant", "hydraulic conductivity": conductivity}}


@problem("exact", "series solution in references/suction.py", "Two blocks pulled apart")
class PulledApart(ContactCase):
    """A stiff drained block is pulled off a column of clay: the film between them is that of a rigid plate."""

    def pull(self, young, conductivity, velocity, stress, duration, **contact):
        modulus = 1.2 * young
        time = HEIGHT**2 * UNIT_WEIGHT / (modulus * conductivity)
        rest = 20 * time if stress > 0 else 0.0
        stages = {}
        if stress > 0:
            stages["press"] = {"type": "quasi-static", "duration": rest, "time step": {"initial": 0.01 * time, "growth": 1.5}}
        stages["pull"] = {"type": "quasi-static", "duration": duration * time,
                          "integrator": {"type": "theta", "theta": 0.5, "start-up steps": 8},
                          "time step": {"initial": 1e-5 * time, "growth": 1.2, "maximum": 0.02 * time}}
        self.write("column.geo", COLUMN)
        history = self.run_deck(self.write("pull.xml", deck_text("pull", {
            "mesh": {"type": "gmsh", "file": "column.geo", "order": 2},
            "materials": {"clay": saturated("lower", young, conductivity), "stiff": saturated("upper", 1e5 * young, conductivity)},
            "physics": {"ground": {"type": "biot"}},
            "boundary conditions": {
                "base": {"type": "fixed", "set": "bottom"}, "sides": {"type": "fixed", "set": "sides", "components": "x"},
                "pulled": {"type": "displacement", "set": "top",
                           "y": f"{-stress * HEIGHT / modulus}*min(t/{time},1)+{velocity}*max(t-{rest},0)"},
                **{f"drained {name}": {"type": "pore pressure", "set": name} for name in ("bottom", "face", "under", "top")}},
            "contacts": {"face": {"type": "node to segment", "slave": "face", "master": "under", "drainage": "film",
                                  "penalty factor": 1e4, "residual aperture": 1e-11, **contact}},
            "stages": stages})))
        pulled = history.time > rest * (1 + 1e-9)
        exact = PulledPlate(HEIGHT, modulus, conductivity / UNIT_WEIGHT, velocity, stress, contact.get("cavitation pressure", -np.inf))
        return history, pulled, history.time[pulled] - rest, exact

    def test_pressed_then_pulled(self):
        """Tolerances are those of the rigid plate (test_film.py)."""
        history, pulled, times, exact = self.pull(1e7, 1e-6, 2e-9, 10.0, 1.5)
        total = np.array([exact.total(t) for t in times])
        self.compare_values("force on the column", -history["contact/face/force on slave y"][pulled] / WIDTH, total,
                            5e-3, scale=np.max(np.abs(total)))
        self.compare_values("of the film", -history["contact/face/film force y"][pulled][-1] / WIDTH, total[-1], 5e-3)
        gap = np.array([exact.gap(t) for t in times])
        self.compare_values("water in the gap", history["contact/face/film water"][pulled] / WIDTH, gap, 5e-3,
                            scale=gap.max())

    def test_cavitation(self):
        history, _, times, exact = self.pull(1e9, 1e-6, 4e-5, 0.0, 1.0, **{"cavitation pressure": -100e3})
        self.compare_values("force on the column", -history["contact/face/force on slave y"] / WIDTH,
                            [exact.total(t) for t in times], 8e-3, scale=100e3)
        vapour = np.array([exact.vapour(t) for t in times])
        self.compare_values("vapour", history["contact/face/film vapour"] / WIDTH, vapour, 1e-2, scale=vapour.max())


SLIDER = '''
For b In {0:1}
  p = newp; c = newc; w = 1 - b;
  Point(p) = {-w, b - 1, 0}; Point(p+1) = {1 + w, b - 1, 0}; Point(p+2) = {1 + w, b, 0}; Point(p+3) = {-w, b, 0};
  Line(c) = {p, p+1}; Line(c+1) = {p+1, p+2}; Line(c+2) = {p+2, p+3}; Line(c+3) = {p+3, p};
  l = newll; Curve Loop(l) = {c:c+3};
  s~{b} = news; Plane Surface(s~{b}) = {l};
  Transfinite Curve {c, c+2} = b ? 6 : 12;
  Transfinite Curve {c+1, c+3} = b ? 13 : 3;
  Transfinite Surface {s~{b}}; Recombine Surface {s~{b}};
  bottom~{b} = c; top~{b} = c+2; left~{b} = c+3; right~{b} = c+1;
EndFor
Physical Surface("lower") = {s_0}; Physical Surface("upper") = {s_1};
Physical Curve("base") = {bottom_0}; Physical Curve("face") = {top_0};
Physical Curve("lower sides") = {left_0, right_0};
Physical Curve("under") = {bottom_1}; Physical Curve("top") = {top_1};
Physical Curve("upper sides") = {left_1, right_1};
'''


@problem("exact", "Coulomb: shear stress is the coefficient times the effective pressure",
         "A saturated block that slides on another one")
class SlidingInWater(ContactCase):
    """The upper block, 1 m by 1 m, is pressed by LOAD and dragged over a stiff one; meshes do not match."""
    LOAD, COEFFICIENT = 10.0, 0.3  # [Pa], so that strains are small
    SOIL = biot.Soil(young=1e7, poisson=0.25, alpha=0.9, storage=2.75e-8)

    def slide(self, duration, step, pressures, contact, ranks=1, extra=(), order=2):
        """`pressures`: prescribed ones by set."""
        self.write("slider.geo", SLIDER)
        wet = {"porosity": 0.4, "fluid": {"type": "water", "bulk modulus": 2e7, "unit weight": UNIT_WEIGHT},
               "permeability": {"type": "constant", "hydraulic conductivity": self.SOIL.mobility * UNIT_WEIGHT}}
        skeleton = {"type": "linear elastic", "Young's modulus": self.SOIL.young, "Poisson's ratio": self.SOIL.poisson}
        return self.run_deck(self.write("slider.xml", deck_text("slider", {
            "mesh": {"type": "gmsh", "file": "slider.geo", "order": order},
            "materials": {
                "upper": {"regions": ["upper"], **wet, "skeleton": skeleton, "Biot coefficient": self.SOIL.alpha,
                          "grain bulk modulus": 0.5 / 0.75e-8},
                "lower": {"regions": ["lower"], **wet, "skeleton": {**skeleton, "Young's modulus": 1e11}}},
            "physics": {"ground": {"type": "biot", **({"pressure": "equal order"} if order == 1 else {})}},
            "boundary conditions": {
                "base": {"type": "fixed", "set": "base"},
                "lower sides": {"type": "fixed", "set": "lower sides", "components": "x"},
                "dragged": {"type": "displacement", "set": "upper sides", "x": f"1e-3*t/{duration}"},
                "load": {"type": "traction", "set": "top", "y": -self.LOAD},
                **{f"water {name}": {"type": "pore pressure", "set": name, "value": value}
                   for name, value in pressures.items()}},
            "contacts": {"contact": {"gap tolerance": 1e-11, **contact,
                                     "friction": {"type": "coulomb", "coefficient": self.COEFFICIENT}}},
            "stages": {"slide": {"type": "quasi-static", "duration": duration,
                                 "integrator": {"type": "theta", "theta": 0.5, "start-up steps": 8}, "time step": step}},
            "solver": {"residual tolerance": 1e-10, "update tolerance": 1e-8, "linear tolerance": 1e-12}})), ranks=ranks, extra=extra)

    def drag(self, history):
        return np.abs(history["contact/contact/force on slave x"]) / self.COEFFICIENT

    def test_drained(self):
        """Each block has a pore pressure of its own on its surface. That of the slave counts, a suction too."""
        for slave, master, pressure, order in (("under", "face", 4.0, 2), ("under", "face", -4.0, 2), ("face", "under", 1.0, 2),
                                               ("under", "face", 4.0, 1)):
            water = {"under": 4.0, "face": 1.0, **{slave: pressure}}
            contact = {"type": "mortar", "slave": slave, "master": master}
            history = self.slide(1.0, {"initial": 0.25}, water, contact, order=order)
            self.compare_values("load", np.abs(history["contact/contact/force on slave y"]), self.LOAD, 1e-8)
            self.compare_values(f"{slave}, {pressure}, order {order}", self.drag(history), self.LOAD - pressure, 1e-6)

    @problem("exact", "Terzaghi (1943): pore pressure under the block; Coulomb")
    def test_sealed(self):
        """The drag grows as the upper block, drained on top, consolidates. The pore pressures that shear makes are odd
        in x: their force is none."""
        column = biot.Column(self.SOIL, load=self.LOAD)
        whole = column.time(1.0)
        step = {"initial": 1e-4 * whole, "growth": 1.2, "maximum": 0.02 * whole}
        history = self.slide(whole, step, {"top": 0.0, "face": 0.0, "base": 0.0},
                             {"type": "mortar", "slave": "under", "master": "face"})
        times = np.array([0.05, 0.1, 0.2, 0.5, 1.0])
        exact = np.array([self.LOAD - column.pressure(1.0, T) for T in times])
        drag = CubicSpline(history.time, self.drag(history))(column.time(times))
        self.compare_values("drag", drag, exact, 2e-3, self.LOAD)
        self.assertLessEqual(np.median(history["step/newton iterations"]), 5)

    @problem("consistency")
    def test_restart_and_ranks(self):
        def slide(**options):
            history = self.slide(80.0, {"initial": 10.0}, {"top": 0.0, "face": 0.0, "base": 0.0},
                                 {"type": "mortar", "slave": "under", "master": "face"}, **options)
            with open(os.path.join(self.folder, "results", "slider.csv")) as file:
                return file.read(), history
        text, history = slide()
        slide(extra=("--steps", "3"))
        self.assertEqual(slide(extra=("--restart",))[0], text)
        self.assert_same_run(history, slide(ranks=3)[1], [f"contact/contact/force on slave {axis}" for axis in "xy"],
                             "3 ranks")


@problem("consistency", title="Blocks that are remeshed while they slide")
class Remeshed(ContactCase):
    """The upper of two blocks is pressed and dragged while both are remeshed every second step."""

    def assert_slides_as_without_remeshing(self, decks):
        remeshing = self.write("remeshing.xml", deck_text("remeshing", {"mesh motion": {"remeshing": {
            "when side above": 0.1, "least steps": 2, "when quality below": 0.0}}}))
        # short steps, so that there are as many remeshings however many steps Newton's method cuts
        settings = ("solver/newton/damped retry=false", "mesh/parameters/lower_cells=6",
                    "mesh/parameters/upper_cells=9", "stages/slide/time step/initial=0.05")
        still = self.run_deck(decks, settings)
        moved = self.run_deck([*decks, remeshing], settings)
        self.assertGreaterEqual(moved["mesh/remeshings"][-1], 4)
        for time in (1.25, 1.5, 1.75, 2.0):
            drag = -still.at("contact/face/force on slave x", time)
            self.assertGreater(drag, 5)
            self.compare_values(f"drag at {time}", -moved.at("contact/face/force on slave x", time), drag, 5e-3, 30)
        self.compare_values("load", moved["contact/face/force on slave y"], 100, 1e-3)
        heat = still["contact/face/friction heat"][-1]
        self.assertGreater(heat, 1e-3)
        self.compare_values("heat", moved["contact/face/friction heat"][-1], heat, 0.01)

    def test_mortar(self):
        """With multipliers, which are transferred."""
        self.assert_slides_as_without_remeshing([self.deck("blocks"), self.write("slide.xml", SLIDE)])

    def test_nodes(self):
        overlay = self.write("penalty.xml", deck_text("penalty", {"contacts": {"face": {
            "type": "node to segment", "enforcement": "penalty", "master surface": "sides", "penalty factor": 100.0}}}))
        with open(self.deck("blocks")) as file:
            text = "".join(line for line in file if "gap tolerance" not in line)
        blocks = self.write("blocks.xml", text.replace("blocks.geo", self.deck("blocks").replace(".xml", ".geo")))
        slide = self.write("slide.xml", "".join(line for line in SLIDE.splitlines(True) if "gap tolerance" not in line))
        self.assert_slides_as_without_remeshing([blocks, overlay, slide])


if __name__ == "__main__":
    unittest.main()
