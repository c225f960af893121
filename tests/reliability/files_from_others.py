"""Geometries, meshes, contours and options of Gmsh that hold commands: what `mudline check` does with files from others."""

import itertools
import random
import re
import shutil

import fault
from mudline_case import deck_text

TITLE = "files from others with commands for the system, as mesh, contour, included file or options, plain and hidden; and harmless ones"
SAMPLE = 18  # every command and every way once, and some more

WITNESS = "witness"
SQUARE = """h = 0.5;
Point(1) = {0, -1, 0, h}; Point(2) = {1, -1, 0, h}; Point(3) = {1, 0, 0, h}; Point(4) = {0, 0, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Surface("soil") = {1}; Physical Curve("bottom") = {1}; Physical Curve("top") = {3};
"""
CONTOUR = """Point(1) = {0, 0.1, 0, 1}; Point(2) = {0.25, 0.35, 0, 1}; Point(3) = {0.25, 2, 0, 1}; Point(4) = {0, 0.35, 0, 1};
Circle(1) = {1, 4, 2}; Line(2) = {2, 3};
Physical Curve("body") = {1, 2};
"""
COMMANDS = {
    "SystemCall": f'SystemCall "touch {WITNESS}";',
    "NonBlockingSystemCall": f'NonBlockingSystemCall "touch {WITNESS}";',
    "System": f'System "touch {WITNESS}";',
    "OnelabRun": f'OnelabRun("a", "touch {WITNESS}");',
    "ExternalProcess": f'Field[1] = ExternalProcess; Field[1].CommandLine = "touch {WITNESS}"; Background Field = 1;',
    "Save": f'Save "{WITNESS}.msh";',
    "Print": f'Print "{WITNESS}.png";',
    "Printf": f'Printf("x") > "{WITNESS}";',
    "Error": f'Error("x") >> "{WITNESS}";',
    "CreateDir": f'CreateDir "{WITNESS}";',
    "LogFileName": f'General.LogFileName = "{WITNESS}.log";',
    "Exit": "Exit;",
}
# how a command may stand in a file: text with the command, further files
WAYS = {
    "plain": lambda c: (c, {}),
    "in a condition": lambda c: (f"If(1 > 0)\n{c}\nEndIf", {}),
    "in a loop": lambda c: (f"For i In {{0:1}}\n{c}\nEndFor", {}),
    "in a macro": lambda c: (f"Macro harm\n{c}\nReturn\nCall harm;", {}),
    "over lines": lambda c: (c.replace(" ", "\n", 1) if " " in c else "\n\n" + c, {}),
    "behind comments": lambda c: (f"/* no /* harm */ x = 1; // here\n{c} // nor there", {}),
    "behind a text with a quote": lambda c: (f"name = \"don't\"; {c}", {}),
    "included": lambda c: ('Include "part.geo";', {"part.geo": c + "\n"}),
    "merged": lambda c: ('Merge "part.geo";', {"part.geo": c + "\n"}),
    "included by what is included": lambda c: ('Include "part.geo";', {"part.geo": 'Include "inner.geo";\n', "inner.geo": c + "\n"}),
    "merged as a mesh": lambda c: ('Merge "part.msh";', {"part.msh": c + "\n"}),
    "merged by a name that is worked out": lambda c: ('Merge Sprintf("part%g.geo", 1);', {"part1.geo": c + "\n"}),
}
# what must be said of a command: the file, and what it would do
REASON = r"\.(geo|msh|opt)(:\d+)?'?:? .*(starts? a program|writes? a file|makes a folder|ends Gmsh|is worked out|is no mesh of Gmsh)"
PLACES = ["mesh, at its begin", "mesh, at its end", "contour", "options beside the mesh", "a .msh that is none"]
HARMLESS = ["// SystemCall \"touch witness\";", "/* Save \"witness.msh\"; */", "Printf(\"a > b: %g\", 1);", "Mesh.SaveAll = 1;", "General.Verbosity = 2;",
            "Save = 3; x = Save + 1;", "If(0)\nx = 1;\nEndIf", 'Include "part.geo";', "Mesh.Algorithm = 6;"]
FULL = len(COMMANDS) * len(WAYS) + 2 * len(HARMLESS)


def deck(mesh, contour):
    entries = {
        "mesh": {"type": "gmsh", "file": mesh, "geometry": "axisymmetric"},
        "materials": {"soil": {"density": 1800.0, "skeleton": {"type": "linear elastic", "Young's modulus": 1e7, "Poisson's ratio": 0.3}}},
        "physics": {"ground": {"type": "solid"}},
        "boundary conditions": {"base": {"type": "fixed", "set": "bottom"}},
        "stages": {"push": {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 1.0}}},
    }
    if contour:
        entries["bodies"] = {"pile": {"contour": {"type": "gmsh curve", "file": contour, "physical curve": "body"}, "position": [0.0, 0.0],
                                      "motion": {"type": "prescribed velocity", "velocity y": -0.01}}}
        entries["contacts"] = {"touch": {"type": "penalty", "body": "pile", "surface": "top"}}
    return deck_text("deck", entries)


def put(folder, place, text, more):
    """Writes the deck and its files."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    files = {"soil.geo": SQUARE}
    mesh, contour = "soil.geo", ""
    if place == "mesh, at its begin":
        files["soil.geo"] = text + "\n" + SQUARE
    elif place == "mesh, at its end":
        files["soil.geo"] = SQUARE + text + "\n"
    elif place == "contour":
        files["body.geo"], contour = CONTOUR + text + "\n", "body.geo"
    elif place == "options beside the mesh":
        files["soil.geo.opt"] = text + "\n"
    else:
        files["soil.msh"], mesh = SQUARE + text + "\n", "soil.msh"
    for name, content in {**files, **more, "deck.xml": deck(mesh, contour)}.items():
        (folder / name).write_text(content, encoding="utf-8")


def judged(name, folder, place, text, more, harmless):
    put(folder, place, text, more)
    before = sorted(p.name for p in folder.iterdir())
    ended = fault.start(["check", "-q", "deck.xml"], folder, limit=60)
    new = sorted({p.name for p in folder.iterdir()} - set(before))
    if new:
        return fault.Outcome(name, "carried out", ", ".join(new))
    outcome = fault.judge(name, ended, (lambda: "") if harmless else None)
    if harmless and outcome.verdict == "said":
        return fault.Outcome(name, "several lines", "a harmless file is refused: " + outcome.said)
    if not harmless and outcome.verdict == "other numbers":
        return fault.Outcome(name, "carried out", "the check says that the deck is valid")
    if not harmless and outcome.verdict == "said" and not re.search(REASON, outcome.said):
        return fault.Outcome(name, "several lines", outcome.said)
    return outcome


def run(count, seed, folder):
    rng = random.Random(seed)
    places = itertools.cycle(PLACES)
    once, faults = [], []  # the former have every command and every way once
    for (i, (command, line)), (k, way) in itertools.product(enumerate(COMMANDS.items()), enumerate(WAYS)):
        place = next(places)
        text, more = WAYS[way](line)
        (once if i == k else faults).append((f"{command}, {way} ({place})", place, text, more, False))
    for text in HARMLESS:
        for place in ("mesh, at its end", "contour"):
            faults.append((f"harmless: {text} ({place})", place, text, {"part.geo": "x = 1;\n"}, True))
    for name, *what in once[:count] + rng.sample(faults, max(0, min(count - len(once), len(faults)))):
        yield judged(name, folder / "here", *what)
