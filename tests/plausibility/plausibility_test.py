"""What `check` and a run tell of the physics: figures against formulas, slips that are doubted, decks that are not."""
import copy
import math
import os
import pathlib
import re
import shlex
import unittest

from mudline_case import ROOT, MudlineCase, deck_text, program
from shipped_decks import needs_result, shipped_decks

# shipped decks that are doubted: why, and the doubt
EARLY = "first step of .* at a drained surface that is loaded"
DOUBTED = {
    # their start-up steps damp what the short first step excites: the theory is singular there
    "consolidation/cryer": EARLY,
    "consolidation/de_leeuw": EARLY,
    "consolidation/large_strain": EARLY,
    "consolidation/terzaghi": EARLY,
    "space/cryer": EARLY,
    "space/terzaghi": EARLY,
    # steps follow the waves, and the soil is too tight for the cells at the drained surface: the doubt is right
    "footing/dynamic_footing": EARLY,
    "footing/dynamic_footing_plastic": EARLY,
    # a cardboard roller and a soil like diamond: references of contact, not of soil
    "contact/roller": "mass over volume is 127|its 'penalty' of 2 MPa",
    "contact/sliding_block": "shear modulus is 500 GPa|its 'penalty' of 1 GPa|its largest load in stage",
    # consolidation with inertia, whose steps follow the pore pressure and no waves: the doubt is right
    "consolidation/strip_footing": "over the time in which a wave crosses the mesh",
    # starts without stress and water pressure, but with weight: the doubt is right
    "impact/fall_and_pull_out": "over that of water at rest",
    # falls through 60 m of water, and meets no soil
    "impact/free_fall": "distance from the soil|to reach the soil",
}


def doubts_of(done):
    return [line[len("warning: "):] for line in done.stderr.splitlines() if line.startswith("warning: ")]


class Telling(MudlineCase):
    def check(self, decks, settings=(), ranks=1):
        arguments = ["check"] + list(decks)
        for setting in settings:
            arguments += ["--set", setting]
        return program(arguments, ranks, self.folder)

    def doubts(self, decks, settings=(), ranks=1):
        done = self.check(decks, settings, ranks)
        self.assertEqual(done.returncode, 0, done.stderr)  # a doubt is never fatal
        return doubts_of(done)

    def shipped(self, name):
        return [os.path.join(ROOT, "inputs", name + ".xml")]


class Shipped(Telling):
    def test_no_deck_is_doubted_without_reason(self):
        self.maxDiff = None
        found = {}
        for name, files in shipped_decks().items():
            with self.subTest(deck=name):
                doubts = self.doubts(files)
                if doubts:
                    found[name] = doubts
        self.assertEqual({name: [d for d in doubts if not re.search(DOUBTED.get(name, "^$"), d)] for name, doubts in found.items()
                          if name not in DOUBTED or not all(re.search(DOUBTED[name], d) for d in doubts)}, {})
        self.assertEqual(sorted(set(DOUBTED) - set(found)), [])  # the list has no more than is needed


class Documented(Telling):
    """What a reader is told to run, and the decks that the program itself writes."""

    COMMAND = re.compile(r"mudline (?:-n \d+ )?(?:run|check) ((?:inputs/[\w/.-]+\.xml\s+)+(?:--set\s+(?:\"[^\"]+\"|\S+)\s*)*)")

    def commands(self):
        """{words: document} of the commands on shipped decks in the documents."""
        found = {}
        for path in [pathlib.Path(ROOT, "README.md"), pathlib.Path(ROOT, "inputs", "README.md"), *sorted(pathlib.Path(ROOT, "docs").rglob("*.md"))]:
            for command in self.COMMAND.finditer(path.read_text().replace("`", "\n")):
                found[tuple(shlex.split(command[1]))] = path.name
        return found

    def test_commands_of_the_documents_are_not_doubted(self):
        commands = self.commands()
        self.assertGreaterEqual(len(commands), 5)
        names = {tuple(os.path.relpath(f, ROOT) for f in files): name for name, files in shipped_decks().items()}
        for words, document in commands.items():
            with self.subTest(command=" ".join(words), document=document):
                decks = tuple(word for word in words if word.endswith(".xml") and "=" not in word)
                if any(needs_result(os.path.join(ROOT, deck)) for deck in decks):
                    continue
                allowed = DOUBTED.get(names.get(decks), "^$")
                rest = [word for word in words if word not in decks and word != "--set"]
                if not rest and decks in names:  # Shipped looks at it
                    continue
                doubts = self.doubts([os.path.join(ROOT, deck) for deck in decks], rest)
                self.assertEqual([doubt for doubt in doubts if not re.search(allowed, doubt)], [])

    def test_the_readme_walk_with_its_changes(self):
        self.assertEqual(self.doubts(self.shipped("pile/clay"), ["stages/push/duration=0.5"]), [])

    def test_templates_are_not_doubted(self):
        for physics in ("biot", "solid"):
            with self.subTest(physics=physics):
                deck = self.write(physics + ".xml", program(["template", physics]).stdout)
                self.assertEqual(self.doubts([deck]), [])


class Slips(Telling):
    """Slips in valid decks, each a change that the program must accept and doubt."""

    def doubted(self, deck, settings, expected, right=()):
        if right:  # else it is a shipped deck as it is: Shipped looks at all of them
            self.assertEqual(self.doubts(self.shipped(deck), right), [], "the deck without the slip")
        for ranks in (1, 2):
            doubts = self.doubts(self.shipped(deck), settings, ranks)
            self.assertTrue(any(re.search(expected, doubt) for doubt in doubts), f"{expected} not in {doubts}")

    def test_strength_in_kilopascal(self):
        law = "materials/clay/skeleton/undrained strength"
        self.doubted("torpedo/tresca", [law + "=5", law + " gradient=0.25"],
                     r"material 'clay': the undrained strength is 3[45](\.\d+)? Pa, usual is 200 Pa to 2 MPa \(plausibility/undrained strength\)")

    def test_mass_in_tonnes(self):
        self.doubted("torpedo/tresca", ["bodies/anchor/mass=98"],
                     r"body 'anchor': mass over volume is [\d.]+ kg/m3, usual is 1000 to 20000 kg/m3 \(plausibility/body density\)")

    def test_upward_speed(self):
        self.doubted("cpt/clay", ["bodies/cone/motion/velocity y=0.02"], "body 'cone' moves away from the soil: down is negative")

    def test_upward_throw(self):
        self.doubted("impact/ball_on_clay", ["bodies/ball/motion/initial velocity={0, 3}", "bodies/ball/position={0, 0.01}"],
                     "body 'ball' moves away from the soil")

    def test_body_far_above_its_mould(self):
        self.doubted("torpedo/tresca", ["bodies/anchor/position={0, 57.86}"],
                     r"body 'anchor': its distance from the soil, in widths, is 5\d\.\d+, usual is 0 to 5")

    def test_mesh_of_another_diameter(self):
        self.doubted("pile/clay", ["bodies/pile/contour/diameter=0.6"],
                     r"body 'pile': the mesh has a corner of the surface at 0.208 m, the body's radius is 0.3 m; their ratio is 0.6933, usual is 0.9")
        self.doubted("torpedo/tresca", ["bodies/anchor/contour/diameter=0.7", "bodies/anchor/contour/tail diameter=0.4"],
                     r"body 'anchor': the mesh has a corner of the surface at 0.535 m, the body's radius is 0.35 m; their ratio is 1.529")

    def test_a_hole_under_water_whose_wall_is_drained(self):
        with open(self.shipped("pile/clay")[0]) as file:
            right = file.read()
        self.write("pile.geo", open(os.path.join(ROOT, "inputs", "pile", "pile.geo")).read())

        def pile(level, *changes):
            """The pile in total pressures, water up to a level [m]."""
            deck = re.sub(r'(?s)<Parameter name="pore pressure" type="string" value="excess"/>(.*?"geostatic"/>)',
                          rf'\1<Parameter name="water level" type="double" value="{level}"/>', right)
            self.assertNotEqual(deck, right)
            for old, new in changes:
                self.assertIn(old, deck)
                deck = deck.replace(old, new)
            return [self.write("total.xml", deck)]

        sides = ('name="drained surface">\n      <Parameter name="type" type="string" value="pore pressure"/>\n      <Parameter name="set" '
                 'type="string" value="surface"/>')
        for ranks in (1, 2):
            doubts = self.doubts(pile(0), ranks=ranks)
            self.assertEqual(len(doubts), 1, doubts)
            found = re.match(r"body 'pile': condition 'drained surface' holds 0 Pa on the wall of the hole that it opens too, where down to "
                             r"([\d.]+) m water at rest has ([\d.]+) kPa: .*'pore pressure' = excess .*, is 5\.\d+, usual is 0 to 1 "
                             r"\(plausibility/drained hole\)", doubts[0])
            self.assertIsNotNone(found, doubts[0])
            depth, water = (float(number) for number in found.groups())
            self.assertAlmostEqual(depth, 2.0 + 0.02, delta=0.005)  # push and load test
            self.assertAlmostEqual(1e3 * water / (9810 * depth), 1, delta=0.05)  # the nearest node above
        self.assertEqual(self.doubts(pile(0), ["plausibility/drained hole={0, 6}"]), [])
        # beside the hole alone, no condition at all, water below the hole, a hole half as deep as wide
        self.assertEqual(self.doubts(pile(0, (sides, sides.replace('"surface"', '"seabed"')))), [])
        # water that low is held by suction, which is another doubt; a drained surface is then refused
        in_air = (sides, sides.replace('"pore pressure"', '"seepage face"'))
        self.assertEqual([d for d in self.doubts(pile(-3.0, in_air)) if "drained hole" in d], [])
        refused = self.check(pile(-3.0))
        self.assertEqual(refused.returncode, 2)
        self.assertIn("where the start has a suction of 29430 Pa", refused.stderr)
        self.assertEqual(self.doubts(pile(0), ["stages/push/duration=0.2"]), [])

    def test_plane_strain_for_a_body_of_revolution(self):
        self.doubted("cpt/tresca", ["mesh/geometry=plane strain"], "body 'cone' is a body of revolution by its contour, but the mesh is in plane strain")

    def test_first_step_too_short_for_the_mesh(self):
        # c_v = k M/gamma = 1e-6 1.2e7/1e4 = 1.2e-3; the last of 40 cells graded 1:0.2 is 10 mm high: h^2/(6 c_v) = 0.0139 s
        step = "stages/consolidation/time step/initial="
        self.doubted("consolidation/terzaghi", [step + "1e-3"], r"stage 'consolidation': the first step of 1 ms at a drained surface that is "
                     r"loaded, over h\^2/\(6 c_v\) = 13.9 ms .*, is 0.0\d+, usual is 1 or more", right=[step + "0.015"])

    def test_ranges_are_the_decks(self):
        settings = ["bodies/anchor/mass=98", "plausibility/body density={1, 20000}"]
        self.assertEqual([d for d in self.doubts(self.shipped("torpedo/tresca"), settings) if "mass over volume" in d], [])
        self.assertEqual(self.doubts(self.shipped("torpedo/tresca"), ["bodies/anchor/position={0, 57.86}", "plausibility/first gap={0, 60}",
                                                                         "plausibility/speed gain={1, 2}"]), [])
        for setting, what in (("sides under a body={1e4, 1e5}", "number of sides of the surface that it covers is"),
                              ("consolidation coefficient={1, 2}", "the consolidation coefficient is")):
            doubts = self.doubts(self.shipped("cpt/clay"), ["plausibility/" + setting])
            self.assertEqual(len(doubts), 1, doubts)
            self.assertIn(what, doubts[0])
        done = self.check(self.shipped("torpedo/tresca"), ["plausibility/body density={5, 1}"])
        self.assertEqual(done.returncode, 2)
        self.assertIn("plausibility/body density: the first value, the lowest, is above the second", done.stderr)


def column(law, k0=0.5, layers=None, body=None):
    """Saturated soil, 2 m by 4 m, under a surcharge of 20 kPa."""
    mesh = {"type": "box", "geometry": "axisymmetric", "cells": [8, 16], "lower": [0.0, -4.0], "upper": [2.0, 0.0]}
    soil = {"void ratio": 1.0, "grain density": 2700.0, "skeleton": law, "fluid": {"type": "water"},
            "permeability": {"type": "constant", "hydraulic conductivity": 1e-8}}
    materials = {"soil": soil}
    if layers:
        mesh.update({"layer tops": [-2.0], "layer regions": ["lower", "upper"]})
        if layers == "two soils":
            materials = {"first": dict(soil, regions=["upper"]), "second": dict(soil, regions=["lower"])}
    deck = {"mesh": mesh, "materials": materials,
            "physics": {"ground": {"type": "biot", "gravity": [0.0, -10.0],
                                   "initial state": {"type": "geostatic", "K0": k0, "surcharge": 20e3, "water level": 0.0}}},
            "boundary conditions": {"base": {"type": "fixed", "set": "bottom"},
                                    "side": {"type": "fixed", "set": "right", "components": "x"},
                                    "axis": {"type": "fixed", "set": "left", "components": "x"},
                                    "load": {"type": "pressure", "set": "top", "value": 20e3}},
            "stages": {"start": {"type": "geostatic", "balance tolerance": 1e-6}}}
    if body:
        deck["bodies"] = {"pin": body}
        deck["contacts"] = {"pin": {"type": "frictionless penalty", "body": "pin", "surface": "top"}}
        deck["stages"]["push"] = {"type": "dynamic", "duration": 1.0, "time step": {"initial": 1e-3}}
    return deck


ELASTIC = {"type": "linear elastic", "Young's modulus": 1e7, "Poisson's ratio": 0.3}
CLAY = {"type": "modified cam clay", "critical stress ratio": 1.0, "compression slope": 0.2, "swelling slope": 0.04, "Poisson's ratio": 0.3}
SAND = {"type": "mohr-coulomb", "Young's modulus": 2e7, "Poisson's ratio": 0.3, "cohesion": 1e2, "friction angle [deg]": 30.0}


class Figures(Telling):
    def told(self, deck, ranks=1):
        done = self.check([self.write("deck.xml", deck_text("deck", deck))], ranks=ranks)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def numbers(self, text, symbol):
        """The numbers behind a symbol, of pressures in Pa."""
        found = re.search(rf"{re.escape(symbol)} ([\d.e+-]+)( [kM]?Pa)?(?: to ([\d.e+-]+)( [kM]?Pa)?)?", text)
        self.assertIsNotNone(found, symbol + " in " + text)
        low, low_unit, high, high_unit = found.groups()
        size = {" Pa": 1.0, " kPa": 1e3, " MPa": 1e6, None: 1.0}
        return [float(low) * size[low_unit or high_unit]] + ([float(high) * size[high_unit]] if high else [])

    def test_a_material(self):
        for ranks in (1, 2):
            line = next(line for line in self.told(column(CLAY), ranks).splitlines() if line.startswith("material 'soil'"))
            points = 0.25 * 0.5 * (1 - math.sqrt(0.6))  # depth of the first row of Gauss points in cells of 0.25 m
            for end, depth in enumerate((points, 4 - points)):
                vertical = 20e3 + 0.5 * 1700 * 10 * depth
                p, q = vertical * 2 / 3, vertical / 2
                pc = p + q * q / p
                strength = 0.5 * p * (pc / (2 * p)) ** (0.16 / 0.2)
                stiffness = 2 * p / 0.04
                shear = stiffness * 1.5 * (1 - 0.6) / 1.3
                self.assertAlmostEqual(self.numbers(line, "p'")[end] / p, 1, delta=6e-3)
                self.assertAlmostEqual(self.numbers(line, "s_u")[end] / strength, 1, delta=6e-3)
                self.assertAlmostEqual(self.numbers(line, " G")[end] / shear, 1, delta=6e-3)
                # means over an element, whose middle is the row between
                self.assertAlmostEqual(self.numbers(line, "c_v")[end] / (1e-8 * (stiffness + 4 / 3 * shear) / 9810), 1, delta=0.05)
            self.assertEqual(set(self.numbers(line, "OCR")), {1.0})
            self.assertEqual(set(self.numbers(line, " e")), {1.0})
            self.assertEqual(set(self.numbers(line, " k")), {1e-8})

    def test_a_body(self):
        ball = {"position": [0.0, 0.3], "contour": {"type": "sphere", "diameter": 1.0}, "mass": 2000.0,
                "motion": {"type": "free", "initial velocity": [0.0, -2.0], "water": {"density": 1000.0}}}
        said = self.told(column(CLAY, body=ball))
        volume = math.pi / 6
        self.assertIn(f"body 'pin': 1 m wide, volume {volume:.3g} m3, mass 2000 kg, {2000 / volume:.4g} kg/m3, weight in water "
                      f"{9.81 * (2 - volume):.4g} kN, 0.3 m from the soil", said)
        speed = math.sqrt(2.0 ** 2 + 2 * 9.81 * (1 - 1000 * volume / 2000) * 0.3)
        self.assertIn(f"body 'pin': {speed:.3g} m/s where it meets the soil", said)
        self.assertIn("stage 'push': about 1000 steps, the first of 1 ms", said)
        touching = self.told(column(CLAY, body=dict(ball, position=[0.0, 0.0])))
        self.assertIn("body 'pin': 2 m/s where it meets the soil", touching)
        self.told(column(CLAY, body=ball))
        done = program(["run", "--steps", "1", "deck.xml"], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("m/s where it meets the soil", done.stdout)  # a run tells it too, before its stages
        self.assertLess(done.stdout.index("meets the soil"), done.stdout.index("stage 'start'"))


class EarthPressure(Telling):
    def start(self, law, k0):
        return self.check([self.write("deck.xml", deck_text("deck", column(law, k0)))])

    def test_k0_beyond_the_strength_is_named(self):
        undrained = {"type": "tresca", "undrained strength": 10e3, "shear modulus": 1e6, "Poisson's ratio": 0.3}
        cone = {"type": "drucker-prager", "match": "compression", "Young's modulus": 2e7, "Poisson's ratio": 0.3, "cohesion": 1e2,
                "friction angle [deg]": 30.0}
        # Ka = (1 - sin)/(1 + sin) with 30 degrees; q/p' = M: K = (3 - M)/(3 + 2 M), (3 + M)/(3 - 2 M);
        # sigma_v' = 20 kPa at least: 2 s_u/sigma_v'
        for law, inside, outside in ((SAND, (0.34, 2.99), (0.31, 3.1)), (CLAY, (0.41, 3.9), (0.39, 4.1)),
                                     (cone, (0.34, 4.0), (0.31,)), (ELASTIC, (0.01, 20.0), ())):
            for k0 in inside:
                done = self.start(law, k0)
                self.assertEqual(done.returncode, 0, f"{law['type']} {k0}: {done.stderr}")
            for k0 in outside:
                done = self.start(law, k0)
                self.assertEqual(done.returncode, 2, f"{law['type']} {k0}")
                self.assertRegex(done.stderr, rf"material 'soil' cannot start at \([\d.]+, -[\d.]+\): K0 = {k0} is outside \[[\d.]+, [\d.]+\], "
                                 f"what the strength of '{law['type']}' under sigma'_v = [\\d.e+]+ Pa allows between active and passive")
                self.assertEqual(len(done.stderr.strip().splitlines()), 1)
        self.assertEqual(self.start(undrained, 1.0).returncode, 0)
        self.assertIn("K0 = 0.4 is outside", self.start(undrained, 0.4).stderr)


class Layers(Telling):
    def pin(self, depth, **motion):
        law = {"type": "prescribed displacement", "y": f"-{depth} * min(t, 1)"}
        return {"position": [0.0, 0.0], "contour": {"type": "cone", "diameter": 0.4, "apex angle [deg]": 60.0, "shaft length": 3.0},
                "mass": 500.0, "motion": motion or law}

    def said(self, deck):
        return self.check([self.write("deck.xml", deck_text("deck", deck))])

    def test_a_prescribed_way_through_a_layer_is_refused(self):
        done = self.said(column(ELASTIC, layers="two soils", body=self.pin(2.5)))
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"deck.xml:\d+: bodies/pin: its prescribed path crosses the boundary between the regions '(upper|lower)' and "
                         r"'(upper|lower)': a body cannot pass from one region to another")
        self.assertEqual(len(done.stderr.strip().splitlines()), 1)
        self.assertEqual(self.said(column(ELASTIC, layers="two soils", body=self.pin(1.9))).returncode, 0)

    def test_regions_of_one_soil_matter_where_the_mesh_moves(self):
        deck = column(ELASTIC, layers="one soil", body=self.pin(2.5))
        self.assertEqual(self.said(deck).returncode, 0)
        deck = copy.deepcopy(deck)
        deck["mesh motion"] = {"boundary": {"focus": "pin", "size near focus": 0.05, "near distance": 0.3}}
        self.assertEqual(self.said(deck).returncode, 2)

    def test_layers_of_one_region_are_passed(self):
        done = self.said(column(ELASTIC, layers="two soils", body=self.pin(2.5)))
        self.assertIn("make them one region, of one material or of layers by the 'top' of each material", done.stderr)
        deck = column(ELASTIC, body=self.pin(2.5))
        soil = deck["materials"]["soil"]
        deck["materials"] = {"first": soil, "second": dict(soil, top=-2.1, skeleton=dict(ELASTIC, **{"Young's modulus": 3e7}))}
        deck["mesh motion"] = {"boundary": {"focus": "pin", "size near focus": 0.05, "near distance": 0.3}}
        done = self.said(deck)
        self.assertEqual(done.returncode, 0, done.stderr)
        for name, young in (("first", 1e7), ("second", 3e7)):
            self.assertIn(f"material '{name}': G {young / 2.6e6:.3g} MPa", done.stdout)

    def test_a_free_body_above_a_layer_is_doubted(self):
        fall = {"type": "free", "initial velocity": [0.0, -1.0]}
        done = self.said(column(ELASTIC, layers="two soils", body=self.pin(0, **fall)))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("body 'pin' may come to the boundary between the regions", done.stderr)
        deep = dict(column(ELASTIC, layers="two soils", body=self.pin(0, **fall)), plausibility={"layer depth": [4.0, 1e9]})
        self.assertNotIn("may come to the boundary", self.said(deep).stderr)  # 5 widths below
        done = self.said(column(ELASTIC, body=self.pin(0, **fall)))
        self.assertNotIn("may come to the boundary", done.stderr)


if __name__ == "__main__":
    unittest.main()
