"""Rigid motions that nothing holds in a stage without inertia are named, with the stage, before the first step."""
import copy
import unittest

from mudline_case import MudlineCase, deck_text, program

SKELETON = {"type": "linear elastic", "Young's modulus": 1e7, "Poisson's ratio": 0.3}
NOTHING = "nothing that acts in this stage holds it, and the stage has no inertia"


def held(side, components):
    return {"type": "fixed", "set": side, "components": components}


def block(conditions, geometry="plane strain", stage="quasi-static"):
    stages = {"only": {"type": stage, **({} if stage == "geostatic" else {"duration": 1.0, "time step": {"initial": 1.0}})}}
    return {"mesh": {"type": "box", "geometry": geometry, "cells": [2, 2], "upper": [1.0, 1.0]},
            "materials": {"rubber": {"density": 2000.0, "skeleton": SKELETON}},
            "physics": {"ground": {"type": "solid"}},
            "boundary conditions": conditions, "stages": stages}


TWO_BLOCKS = """SetFactory("Built-in");
For k In {0 : 1}
  p = newp;
  Point(p) = {0, k, 0, 0.5}; Point(p + 1) = {1, k, 0, 0.5}; Point(p + 2) = {1, k + 1, 0, 0.5}; Point(p + 3) = {0, k + 1, 0, 0.5};
  l = newl;
  Line(l) = {p, p + 1}; Line(l + 1) = {p + 1, p + 2}; Line(l + 2) = {p + 2, p + 3}; Line(l + 3) = {p + 3, p};
  Curve Loop(10 * k + 101) = {l, l + 1, l + 2, l + 3};
  Plane Surface(k + 1) = {10 * k + 101};
  Physical Curve(Sprintf("bottom %g", k)) = {l};
  Physical Curve(Sprintf("top %g", k)) = {l + 2};
  Physical Surface(Sprintf("block %g", k)) = {k + 1};
EndFor
"""


class Supports(MudlineCase):
    def check(self, deck, ranks=1):
        return program(["check", self.write("deck.xml", deck_text("deck", deck))], ranks, self.folder)

    def missing(self, deck, what, stage="only", ranks=1):
        done = self.check(deck, ranks)
        self.assertEqual(done.returncode, 2, what + done.stdout)
        lines = [line for line in done.stderr.splitlines() if line.startswith("error")]
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertRegex(lines[0], r"^error: .*deck\.xml:\d+: stages/" + stage + ": ")
        self.assertTrue(lines[0].endswith(f"{what}: {NOTHING}"), lines[0])

    def enough(self, deck):
        done = self.check(deck)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_block(self):
        base, side = held("bottom", "y"), held("left", "x")
        corner = dict(held("left", "x"), set="bottom")
        for stage in ("quasi-static", "geostatic"):
            for ranks in (1, 2):
                self.missing(block({"base": base}, stage=stage), "the soil is free to move in x", ranks=ranks)
                self.missing(block({"side": side}, stage=stage), "the soil is free to move in y", ranks=ranks)
            self.enough(block({"base": base, "side": side}, stage=stage))
            self.enough(block({"base": base, "corner": corner}, stage=stage))
        self.enough(block({"base": base}, stage="dynamic"))

    def test_a_hinge_turns(self):
        deck = block({"pin": {"type": "fixed", "set": "hinge", "components": "x y"}})
        deck["mesh"] = {"type": "gmsh", "geometry": "plane strain", "file": "plate.geo"}
        self.write("plate.geo", """Point(1) = {0, 0, 0, 0.5}; Point(2) = {1, 0, 0, 0.5}; Point(3) = {1, 1, 0, 0.5}; Point(4) = {0, 1, 0, 0.5};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Surface("plate") = {1}; Physical Curve("right") = {2}; Physical Point("hinge") = {1};
""")
        self.missing(deck, "the soil is free to rotate")
        deck["boundary conditions"]["rod"] = held("right", "x")
        self.enough(deck)

    def test_around_an_axis_only_y_is_free(self):
        self.missing(block({"side": held("right", "x")}, "axisymmetric"), "the soil is free to move in y")
        self.enough(block({"base": held("bottom", "y")}, "axisymmetric"))

    def test_an_absorbing_boundary_holds_nothing_at_rest(self):
        deck = block({"base": held("bottom", "y"), "side": held("left", "x"), "far": {"type": "absorbing", "set": "left"}})
        deck["stages"]["later"] = copy.deepcopy(deck["stages"]["only"])
        deck["stages"]["only"]["conditions"] = ["base", "side"]
        deck["stages"]["later"]["conditions"] = ["base", "far"]
        self.missing(deck, "the soil is free to move in x", "later")
        deck["stages"]["later"]["type"] = "dynamic"
        self.enough(deck)

    def test_a_block_on_a_block(self):
        deck = block({"base": {"type": "fixed", "set": "bottom 0", "components": "x y"}})
        deck["mesh"] = {"type": "gmsh", "geometry": "plane strain", "file": "two.geo"}
        self.write("two.geo", TWO_BLOCKS)
        deck["contacts"] = {"face": {"type": "mortar", "slave": "bottom 1", "master": "top 0"}}
        self.missing(deck, "the part of the mesh around (0.5, 1.5) is free to move in x", ranks=2)
        rough = copy.deepcopy(deck)
        rough["contacts"]["face"]["friction"] = {"type": "coulomb", "coefficient": 0.3, "on": "total"}
        self.enough(rough)
        # hung up by its top it needs the contact for nothing
        deck["boundary conditions"]["top"] = {"type": "fixed", "set": "top 1", "components": "x"}
        self.enough(deck)
        deck["stages"]["later"] = dict(copy.deepcopy(deck["stages"]["only"]), contacts=["none"])
        self.missing(deck, "the part of the mesh around (0.5, 1.5) is free to move in y", "later")


if __name__ == "__main__":
    unittest.main()
