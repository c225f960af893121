"""Mistakes of practice with rigid bodies and contacts: each is an edit of a deck that is not doubted, and has a doubt of its own name."""
import copy
import os
import re
import subprocess
import unittest

from mudline_case import PROGRAM, ROOT, MudlineCase, deck_text, program

CLAY = {"density": 1700.0, "skeleton": {"type": "tresca", "undrained strength": 5e3, "shear modulus": 5e5, "Poisson's ratio": 0.45}}


def conditions(bottom, sides):
    held = {"base": {"type": "fixed", "set": bottom}}
    for k, (name, component) in enumerate(sides):
        held[f"side {k}"] = {"type": "fixed", "set": name, "components": component}
    return held


def plane(motion):
    return {"mesh": {"type": "box", "geometry": "plane strain", "cells": [20, 10], "lower": [-2.0, -2.0], "upper": [2.0, 0.0]},
            "materials": {"clay": copy.deepcopy(CLAY)}, "physics": {"soil": {"type": "solid", "gravity": [0.0, -9.81]}},
            "bodies": {"bar": {"position": [0.0, 0.0], "mass": 500.0, "moment of inertia": 20.0, "contour": {"type": "cylinder", "diameter": 0.5, "extent": "full"}, "motion": motion}},
            "boundary conditions": conditions("bottom", [("left", "x"), ("right", "x")]),
            "contacts": {"touch": {"type": "penalty", "body": "bar", "surface": "top",
                                   "friction": {"type": "coulomb", "coefficient": 0.3, "adhesion": 1e3, "on": "total"}}},
            "stages": {"move": {"type": "dynamic", "duration": 1.0, "time step": {"initial": 1e-2}}},
            "plausibility": {"sudden weight": [0.0, 1.0]}}  # the soil is here to be touched only


def space(motion):
    return {"mesh": {"type": "box", "geometry": "three-dimensional", "cell": "hex8", "cells": [8, 8, 4], "lower": [-1.0, -1.0, -1.0], "upper": [1.0, 1.0, 0.0]},
            "materials": {"clay": copy.deepcopy(CLAY)}, "physics": {"soil": {"type": "solid", "gravity": [0.0, 0.0, -9.81]}},
            "bodies": {"block": {"position": [0.0, 0.0, 0.25], "mass": 400.0, "surface": {"type": "box", "length x": 0.6, "length y": 0.5, "length z": 0.5, "fillet radius": 0.05}, "motion": motion}},
            "boundary conditions": conditions("bottom", [("left", "x"), ("right", "x"), ("front", "y"), ("back", "y")]),
            "contacts": {"touch": {"type": "penalty", "body": "block", "surface": "top",
                                   "friction": {"type": "coulomb", "coefficient": 0.3, "on": "total"}}},
            "stages": {"move": {"type": "dynamic", "duration": 1.0, "time step": {"initial": 1e-2}}},
            "plausibility": {"sudden weight": [0.0, 1.0]}}  # the soil is here to be touched only


WATER = {"density": 1000.0, "drag coefficient": 0.5, "added mass coefficient": 0.5}
BASES = {
    "pushed": plane({"type": "prescribed velocity", "velocity y": -0.1, "ramp time": 0.1}),
    "free": plane({"type": "free", "freedom": ["y", "rotation"], "initial velocity": [0.0, -2.0], "water": dict(WATER)}),
    "pushed in space": space({"type": "prescribed velocity", "velocity z": -0.1, "ramp time": 0.1}),
    "free in space": space({"type": "free", "initial velocity": [0.0, 0.0, -2.0], "water": dict(WATER)}),
}
TIP = 3.2  # m, where the mesh was made for 2.14
BAR, BLOCK, TOUCH = "bodies/bar/", "bodies/block/", "contacts/touch/"
BOX = {"type": "polyline", "extent": "full"}
WEIGHT = {"type": "pressure", "set": "top", "value": 2e5}
SATURATED = {"physics/soil/type": "biot", "materials/clay": {
    "porosity": 0.5, "grain density": 2700.0, "fluid": {"type": "water"}, "skeleton": CLAY["skeleton"],
    "permeability": {"type": "constant", "hydraulic conductivity": 1e-9}}}

# base deck, edits, the doubt
MISTAKES = [
    ("pushed", {BAR + "motion/velocity y": -100.0}, "prescribed speed"),                      # mm/s
    ("pushed", {BAR + "motion/velocity y": -10.0}, "prescribed depth"),                       # beyond the mesh
    ("pushed", {"stages/move/duration": 60.0}, "prescribed depth"),                           # minutes
    ("pushed", {BAR + "motion/velocity x": 5.0}, "way aside"),
    ("pushed", {BAR + "motion/ramp time": 10.0}, "ramp time"),
    ("pushed", {BAR + "motion/velocity y": -1e-8}, "prescribed way"),
    ("pushed", {BAR + "motion": {"type": "prescribed displacement", "y": "t < 5 ? 0 : -0.1"}}, "prescribed way"),
    ("pushed", {BAR + "position": [10.0, 0.0]}, "beside the surface"),
    ("pushed", {BAR + "contour/diameter": 500.0}, "body size"),                               # mm
    ("pushed", {BAR + "contour/diameter": 5e-4}, "body size"),                                # km
    ("pushed", {BAR + "contour/diameter": 150.0}, "body over mesh"),
    ("pushed", {BAR + "contour/diameter": 150.0}, "body width"),
    ("pushed", {BAR + "position": [0.0, 50.0]}, "first gap"),
    ("pushed", {BAR + "motion/velocity y": 0.1}, None),                                       # told by "moves away"
    ("pushed", {TOUCH + "surface": "left"}, "facing"),
    ("pushed", {TOUCH + "penalty": 1e2}, "penalty"),
    ("pushed", {TOUCH + "penalty": 1e13}, "penalty"),
    ("pushed", {TOUCH + "penalty": 1e2, TOUCH + "enforcement": "augmented Lagrangian"}, "augmented penalty"),
    ("pushed", {TOUCH + "penalty": 1e13, TOUCH + "enforcement": "augmented Lagrangian"}, "augmented penalty"),
    ("pushed", {BAR + "contour": dict(BOX, x=[-0.25, 0.25, 0.25, -0.25], y=[0.0, 0.0, 0.5, 0.5])}, "open contour"),  # a side is missing
    ("pushed", {BAR + "contour": {"type": "path", "extent": "full", "start": [-0.25, 0.25], "pieces": {
        "round": {"type": "arc", "to": [0.25, 0.25], "radius": 0.25}}}}, "ends of a contour"),                       # half a circle
    ("pushed", {TOUCH + "penalty factor": 0.01}, "penalty factor"),
    ("pushed", {TOUCH + "penalty factor": 1e6}, "penalty factor"),
    ("pushed", {TOUCH + "friction/coefficient": 20.0}, "friction coefficient"),
    ("pushed", {TOUCH + "friction/coefficient": 1.5}, "friction coefficient"),
    ("pushed", {TOUCH + "friction/kinetic coefficient": 0.5, TOUCH + "friction/decay speed": 0.1}, "kinetic friction"),
    ("pushed", {TOUCH + "friction/residual coefficient": 0.5, TOUCH + "friction/residual slip": 0.01},
     "residual friction"),
    ("pushed", {TOUCH + "friction/alpha": 40.0}, "friction alpha"),                           # per cent
    ("pushed", {TOUCH + "friction/adhesion": 2.0}, "adhesion"),                               # kPa
    ("pushed", {TOUCH + "friction/adhesion": 2e4}, "adhesion over strength"),
    ("pushed", {TOUCH + "friction/cap": 5.0}, "friction cap"),
    ("pushed", {TOUCH + "friction/tangential penalty factor": 1e-4}, "tangential penalty"),
    ("pushed", {"boundary conditions/weight": WEIGHT}, "load under friction"),
    ("pushed", {"boundary conditions/weight": dict(WEIGHT, value=2e3)}, "load under friction"),  # 2/5 of the strength
    ("pushed", {TOUCH + "capture distance": 1e-3}, "capture distance"),
    ("pushed", {TOUCH + "advance limit": 50.0}, "advance limit"),
    ("pushed", {**SATURATED, TOUCH + "sealing gap": 20.0}, "sealing gap"),
    ("pushed", {TOUCH + "damping": 100.0}, "contact damping"),
    ("pushed", {TOUCH + "enforcement": "augmented Lagrangian", TOUCH + "gap tolerance": 0.1}, "gap tolerance"),
    ("pushed", {BAR + "tip height": 30.0}, "tip height of a body"),
    ("free", {BAR + "mass": 0.5}, "body density"),
    ("free", {BAR + "motion/initial velocity": [0.0, -2000.0]}, "initial speed"),
    ("free", {BAR + "motion/initial velocity": [0.0, -72.0]}, "initial speed"),               # km/h
    ("free", {BAR + "moment of inertia": 2e4}, "radius of gyration"),
    ("free", {BAR + "moment of inertia": 0.002}, "radius of gyration"),
    ("free", {BAR + "motion/water/drag coefficient": 100.0}, "drag coefficient"),
    ("free", {BAR + "motion/water/added mass coefficient": 50.0}, "added mass"),
    ("free", {BAR + "motion/water/density": 1.0}, "water around"),                            # t/m3
    ("free", {BAR + "motion/water/drag area": 5000.0}, "drag area"),                          # cm2
    ("free", {BAR + "volume": 196.0}, "volume of a body"),                                    # litres
    ("free", {BAR + "centre of mass": [0.0, 250.0]}, "centre of mass"),                       # mm
    ("free", {BAR + "motion/gravity": [9.81, 0.0]}, "body gravity"),
    ("free", {BAR + "motion/gravity": [0.0, 9.81]}, "body gravity"),
    ("free", {BAR + "position": [0.0, 0.35], BAR + "motion/water/density": 900.0}, "speed gain"),
    ("free", {BAR + "motion": {"type": "force", "freedom": ["y"], "force y": -1e-2}}, "load over modulus"),
    ("free", {BAR + "motion/loads/line": {"point": [0.0, 250.0], "force y": 1e3}}, "load point"),
    ("free", {BAR + "motion/freedom": ["y"], BAR + "motion/water/mudline": 50.0}, "mudline"),
    ("pushed", {BAR + "contour": {"type": "cone", "diameter": 0.4, "apex angle [deg]": 1.05, "shaft length": 1.0}}, "apex angle"),
    ("pushed in space", {BLOCK + "surface": {"type": "box", "length x": 0.02, "length y": 0.02, "length z": 0.5, "fillet radius": 1e-3}}, "width over side"),
    ("pushed in space", {BLOCK + "surface": {"type": "box", "length x": 1.5, "length y": 0.02, "length z": 0.5, "fillet radius": 1e-3}}, "width over side"),
    ("pushed in space", {BLOCK + "motion/velocity z": -2000.0}, "prescribed speed"),
    ("pushed in space", {BLOCK + "motion/velocity z": -2.0}, "prescribed depth"),
    ("pushed in space", {BLOCK + "motion/velocity z": 0.1}, "rise"),
    ("pushed in space", {BLOCK + "motion/velocity z": -1e-9}, "prescribed way"),
    ("pushed in space", {BLOCK + "motion/spin z": 30.0}, "turned by"),                        # degrees
    ("pushed in space", {BLOCK + "position": [0.0, 0.0, 50.0]}, "gap in space"),
    ("pushed in space", {BLOCK + "position": [20.0, 0.0, 0.25]}, "beside the surface"),
    ("pushed in space", {TOUCH + "surface": "left"}, "facing"),
    ("pushed in space", {TOUCH + "penalty": 1e2}, "penalty"),
    ("pushed in space", {TOUCH + "friction/coefficient": 30.0}, "friction coefficient"),
    ("pushed in space", {"boundary conditions/weight": WEIGHT}, "load under friction"),
    ("pushed in space", {BLOCK + "surface/length x": 600.0}, "body over mesh"),               # mm
    ("free in space", {BLOCK + "mass": 0.4}, "density in space"),                             # t
    ("free in space", {BLOCK + "inertia tensor": [1.0, 1.0, 10.0]}, "triangle of inertia"),
    ("free in space", {BLOCK + "inertia tensor": [1e4, 1e4, 1e4]}, "radius of gyration"),
    ("free in space", {BLOCK + "motion/gravity": [0.0, -9.81, 0.0]}, "body gravity"),
    ("free in space", {BLOCK + "motion/initial velocity": [0.0, 0.0, 2.0]}, "rise"),
    ("free in space", {BLOCK + "motion/initial spin": [0.0, 0.0, 180.0]}, "initial spin"),    # degrees
    ("free in space", {BLOCK + "motion/water/drag coefficient": 100.0}, "drag coefficient"),
]


def edited(base, edits):
    deck = copy.deepcopy(BASES[base])
    for path, value in edits.items():
        *folders, last = path.split("/")
        section = deck
        for folder in folders:
            section = section.setdefault(folder, {})
        section[last] = value
    return deck


class Mistakes(MudlineCase):
    def doubts(self, decks):
        """Of each deck the answer and the lines of its doubts; all in one start of the program."""
        files = [self.write(f"{k}.xml", deck_text("deck", deck)) for k, deck in enumerate(decks)]
        done = subprocess.run([PROGRAM, "check", "--each"] + files, cwd=self.folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=600)
        result, lines = [], []
        for line in done.stdout.splitlines():
            if line.endswith("the deck is valid") or line.startswith("error"):
                result.append((line, lines))
                lines = []
            else:
                lines.append(line)
        self.assertEqual(len(result), len(decks), done.stdout[-2000:])
        return result

    def test_right_decks_are_not_doubted(self):
        for name, (answer, lines) in zip(BASES, self.doubts([BASES[name] for name in BASES])):
            self.assertTrue(answer.endswith("the deck is valid"), answer)
            self.assertEqual(lines, [], name)

    def test_each_mistake_has_its_doubt(self):
        silent = []
        found = self.doubts([edited(base, edits) for base, edits, _ in MISTAKES])
        for (base, edits, name), (answer, lines) in zip(MISTAKES, found):
            names = re.findall(r"\(plausibility/([^)]*)\)", "\n".join(lines))
            told = name in names if name else any("moves away" in line for line in lines)
            if not told or not answer.endswith("the deck is valid"):
                silent.append((base, edits, name, answer, lines))
            if name and told:
                line = next(line for line in lines if f"(plausibility/{name})" in line)
                self.assertRegex(line, r" is -?[\d.e+-]+.*, usual is .*\(plausibility/[^)]*\)")
        self.assertEqual(silent, [], "\n".join(map(str, silent)))

    def test_two_ranks_doubt_the_same(self):
        files = [self.write(f"{k}.xml", deck_text("deck", edited(base, edits))) for k, (base, edits, _) in enumerate(MISTAKES[::6])]
        one, two = (sorted(program(["check", "--each", *files], ranks, self.folder).stderr.splitlines()) for ranks in (1, 2))
        self.assertGreaterEqual(len(one), len(files))
        self.assertEqual(two, one)

    def test_closed_and_upright_contours_are_not_doubted(self):
        """Contours that are meant: a closed box, one whose sides run on upwards, a plate that runs on to both sides."""
        contours = [dict(BOX, x=[-0.25, 0.25, 0.25, -0.25, -0.25], y=[0.0, 0.0, 0.5, 0.5, 0.0]),
                    dict(BOX, x=[-0.25, -0.25, 0.25, 0.25], y=[0.5, 0.0, 0.0, 0.5]),
                    dict(BOX, x=[-0.25, 0.25], y=[0.0, 0.0])]
        for contour, (answer, lines) in zip(contours, self.doubts([edited("pushed", {BAR + "contour": c}) for c in contours])):
            self.assertTrue(answer.endswith("the deck is valid"), answer)
            self.assertEqual([line for line in lines if "contour" in line], [], contour)

    def test_loads_that_do_not_take_friction_away_are_not_doubted(self):
        """A load that fades within the body's width, one that is small, and one under a body without friction."""
        fading = dict(WEIGHT, value="2e5 * min(1, max(0, 1 + y/0.4))", position="present")
        loads = [{"boundary conditions/weight": fading}, {"boundary conditions/weight": dict(WEIGHT, value=1e3)},
                 {"boundary conditions/weight": WEIGHT, TOUCH + "friction/coefficient": 0.0}]
        for load, (answer, lines) in zip(loads, self.doubts([edited("pushed", load) for load in loads])):
            self.assertTrue(answer.endswith("the deck is valid"), answer)
            self.assertEqual([line for line in lines if "load under friction" in line], [], load)

    def test_inverted_contours_are_refused(self):
        """The body on the right of its path: a box, and a pile from its axis downwards."""
        for extent, x, y in (("full", [-0.25, -0.25, 0.25, 0.25, -0.25], [0.0, 0.5, 0.5, 0.0, 0.0]), ("half", [0.0, 0.2, 0.2], [0.0, -0.1, -2.0])):
            ((answer, _),) = self.doubts([edited("pushed", {BAR + "contour": {"type": "polyline", "extent": extent, "x": x, "y": y}})])
            self.assertIn("the contour is inverted: the body must lie on the left of the path", answer)

    def test_ranges_are_the_decks(self):
        deck = edited("pushed", {TOUCH + "friction/coefficient": 20.0, "plausibility/friction coefficient": [0.0, 30.0]})
        wanted = edited("pushed", {"plausibility/contacts of a body": [2.0, 3.0]})
        found = self.doubts([deck, wanted])
        self.assertEqual(found[0][1], [])
        self.assertIn("the number of its contacts is 1, usual is 2 to 3 (plausibility/contacts of a body)", "".join(found[1][1]))

    def test_a_tip_of_another_length_than_the_hole(self):
        deck = os.path.join(ROOT, "inputs", "torpedo", "tresca.xml")
        for length, doubted in ((2.14, False), (2.5, True), (TIP, True)):
            done = program(["check", "-q", deck, "--set", f"bodies/anchor/contour/tip length={length}"], folder=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual("(plausibility/fit in a hole)" in done.stderr, doubted, done.stderr)
        done = program(["check", "-q", deck, "--set", "bodies/anchor/contour/tip length=1.8"], folder=self.folder)
        self.assertEqual(done.returncode, 2, done.stderr)  # blunter than the hole
        self.assertIn("body 'anchor' overlaps the surface by 0.045", done.stderr)
        self.assertNotIn("fit in a hole", program(["check", "-q", deck, "--set", f"bodies/anchor/contour/tip length={TIP}", "--set",
                                                   "plausibility/fit in a hole={0, 10}"], folder=self.folder).stderr)


if __name__ == "__main__":
    unittest.main()
