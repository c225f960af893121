"""Meshes of other programs: every kind of cell under a load that has an exact answer (Abaqus) or against the same mesh
in another format (universal files), groups, and what is refused."""
import itertools
import os
import subprocess
import sys
import unittest

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, "..", "..", "python"), os.path.join(HERE, "..", "..", "tests", "support")]
from mudline import MudlineError, import_mesh  # noqa: E402
from mudline.foreign_mesh import CELLS  # noqa: E402
from mudline_case import PROGRAM, History, MudlineCase, deck_text  # noqa: E402

HIGH = 2.0  # of the box [m]; the others are 1
CUT = {3: [(0, 1, 2), (0, 2, 3)], 6: [(0, 1, 2), (0, 2, 3)],  # of a square, and of a cube
       "tet": [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)],
       "wedge": [(0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7)]}


def box(dimension, size):
    """(kind of cell, nodes, elements) of a box of two cells over each other, cut where the kind asks for it."""
    cell = CELLS[dimension, size]
    places, nodes, elements = {}, [], []

    def node(place):
        key = tuple(np.round(place, 9))
        if key not in places:
            places[key] = len(nodes) + 1
            nodes.append(place)
        return places[key]

    for level in range(2):
        low, high = 0.5 * HIGH * level, 0.5 * HIGH * (level + 1)
        corners = [(0, low), (1, low), (1, high), (0, high)] if dimension == 2 else \
            [(0, 0, low), (1, 0, low), (1, 1, low), (0, 1, low), (0, 0, high), (1, 0, high), (1, 1, high), (0, 1, high)]
        corners = np.array(corners)
        parts = CUT["tet"] if (dimension, cell.corners) == (3, 4) else CUT["wedge"] if (dimension, cell.corners) == (3, 6) else \
            CUT[3] if (dimension, cell.corners) == (2, 3) else [tuple(range(len(corners)))]
        for part in parts:
            own = [corners[k] for k in part]
            own += [0.5 * (own[a] + own[b]) for a, b in cell.edges]
            elements.append([node(place) for place in own])
    return cell, np.array(nodes), elements


def inp(dimension, size, family):
    cell, nodes, elements = box(dimension, size)
    up = nodes[:, -1]
    lines = ["*Heading", " a box", "** a comment", "*Node"]
    lines += [f"{k + 1}, " + ", ".join(f"{x:.9g}" for x in place) for k, place in enumerate(nodes)] + ["999, 5., 5., 5."]
    lines.append(f"*Element, type={family}{size}R, elset=all")
    for k, element in enumerate(elements):
        words = [str(k + 1), *map(str, element)]
        lines += [", ".join(words[:10]) + ("," if len(words) > 10 else "")] + ([", ".join(words[10:])] if len(words) > 10 else [])
    lines += ["*Nset, nset=Base", ", ".join(str(k + 1) for k in np.flatnonzero(up == 0))]
    for axis, name in zip(range(dimension - 1), ("x", "y")):
        for value in (0, 1):
            lines += [f"*Nset, nset={name}{value}"] + [str(k + 1) for k in np.flatnonzero(nodes[:, axis] == value)]
    lines += ["*Nset, nset=corner", "1", "*Surface, type=ELEMENT, name=Top"]
    for k, element in enumerate(elements):
        for face in range(len(cell.faces)):
            if all(up[element[place] - 1] == HIGH for place in cell.side(face)):
                lines.append(f"{k + 1}, S{face + 1}")
    lines += ["*Elset, elset=soil, generate", f"1, {len(elements)}, 1", "*Solid Section, elset=soil, material=clay", ",", "*Step", "*Static"]
    return "\n".join(lines) + "\n", len(elements)


# Numbers of elements in universal files, by dimension and nodes
UNV_KINDS = {(1, 2): 21, (1, 3): 24, (2, 3): 91, (2, 4): 44, (2, 6): 52, (2, 8): 85, (3, 4): 111, (3, 10): 118,
             (3, 6): 112, (3, 15): 113, (3, 8): 115, (3, 20): 116}


def around(nodes, corners, in_space):
    """Nodes, corners first, in the order of universal files: rings of corners and middles in turn, the lowest first."""
    if len(nodes) == corners:
        return nodes
    turn = [[a, b] for a, b in zip(nodes, nodes[corners:])]  # (in the plane)
    if not in_space:
        return sum(turn, [])
    foot = 3 if corners in (4, 6) else 4
    low, middles = nodes[:foot], nodes[corners:]
    bottom = sum(([a, b] for a, b in zip(low, middles)), [])
    if corners == 4:
        return bottom + middles[3:] + [nodes[3]]
    top = sum(([a, b] for a, b in zip(nodes[foot:corners], middles[foot:2 * foot])), [])
    return bottom + middles[2 * foot:] + top


def integers(numbers, columns):
    return ["".join(f"{n:10d}" for n in numbers[k:k + columns]) for k in range(0, len(numbers), columns)]


def unv(dimension, size, factor=1.0):
    """The mesh of inp() as a universal file, with lengths `factor` times as large and the unit that says so."""
    cell, nodes, elements = box(dimension, size)
    up = nodes[:, -1]

    def number(x):
        return f"{factor * x:25.16E}".replace("E", "D")

    lines = ["    -1", "   151", "a file", "    -1"]
    lines += ["    -1", "   164", f"{2:10d}mm{0:18d}", number(1), number(0), "    -1"]
    lines += ["    -1", "  2411"]
    for k, place in enumerate(nodes):
        lines += integers([k + 1, 1, 1, 11], 8) + ["".join(map(number, [*place, 0.0][:3]))]
    lines += integers([999, 1, 1, 11], 8) + ["".join(map(number, (5, 5, 0)))] + ["    -1", "    -1", "  2412"]
    top = [(k, face) for k, element in enumerate(elements) for face in range(len(cell.faces))
           if all(up[element[place] - 1] == HIGH for place in cell.side(face))]
    listed = [(dimension, element, cell.corners) for element in elements]
    for k, face in top:
        listed.append((dimension - 1, [elements[k][place] for place in cell.side(face)], len(cell.faces[face])))
    for k, (own, members, corners) in enumerate(listed):
        kind = UNV_KINDS[own, len(members)]
        lines += integers([k + 1, kind, 1, 1, 7, len(members)], 8) + (integers([0, 1, 1], 8) if own == 1 else [])
        ordered = [members[0], members[2], members[1]] if kind == 24 else around(members, corners, own == 3)
        lines += integers(ordered, 8)
    groups = {"soil": (8, range(1, len(elements) + 1)), "top": (8, range(len(elements) + 1, len(listed) + 1)),
              "base": (7, np.flatnonzero(up == 0) + 1), "corner": (7, [1])}
    for axis, name in zip(range(dimension - 1), ("x", "y")):
        for value in (0, 1):
            groups[f"{name}{value}"] = (7, np.flatnonzero(nodes[:, axis] == value) + 1)
    lines += ["    -1", "    -1", "  2467"]
    for k, (name, (kind, members)) in enumerate(groups.items()):
        lines += integers([k + 1, 0, 0, 0, 0, 0, 0, len(members)], 8) + [name]
        lines += integers([n for member in members for n in (kind, member, 0, 0)], 8)
    return "\n".join(lines + ["    -1"]) + "\n"


def parsed(path):
    """Groups and elements of an MSH 2.2 file: {names}, {nodes}, {(kind, name, nodes)}."""
    with open(path) as file:
        words = [line.split() for line in file]
    at = {line[0]: k for k, line in enumerate(words)}
    part = {name: words[at["$" + name] + 2:at["$End" + name]] for name in ("PhysicalNames", "Nodes", "Elements")}
    names = {tag: name.strip('"') for _, tag, name in part["PhysicalNames"]}
    places = {number: tuple(round(float(x), 12) for x in place) for number, *place in part["Nodes"]}
    elements = {(kind, names[tag], tuple(nodes)) for _, kind, _, tag, _, *nodes in part["Elements"]}
    return set(names.values()), set(places.items()), elements


class Universal(MudlineCase):
    def convert(self, name, text, scale=1.0):
        """Groups by kind, and what was written."""
        target = os.path.join(self.folder, name + ".msh")
        return import_mesh(self.write(name, text), target, scale), parsed(target)

    def test_every_kind_of_cell(self):
        """The same mesh, in other units, is written as from an Abaqus input file."""
        millimetres = f"{1000.0:25.16E}".replace("E", "D") + "\n"
        for dimension, size in CELLS:
            with self.subTest(dimension=dimension, nodes=size):
                groups, expected = self.convert("a.inp", inp(dimension, size, "CPE" if dimension == 2 else "C3D")[0])
                text = unv(dimension, size, 1000.0).replace(millimetres, "   1.D+3\n", 1)
                found, written = self.convert("b.unv", text)
                self.assertEqual(written, expected)
                self.assertEqual({kind: sorted(names) for kind, names in found.items()},
                                 {kind: sorted(names) for kind, names in groups.items()})

    def test_no_groups_and_scale(self):
        text = unv(2, 6)
        groups, (_, nodes, _) = self.convert("box.unv", text[:text.index("    -1\n  2467\n")], 10.0)
        self.assertEqual(groups, {"region": ["soil"], "side set": [], "node set": []})
        self.assertIn((10.0, 20.0, 0.0), [place for _, place in nodes])

    def test_program(self):
        self.write("box.unv", unv(2, 3))
        done = subprocess.run([PROGRAM, "import", "box.unv", "-o", "soil.msh"], capture_output=True, text=True,
                              cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout, "soil.msh\nregion: soil\nside sets: top, base, x0, x1\nnode set: corner\n")
        done = subprocess.run([PROGRAM, "import", "box.med"], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (
            2, "error: box.med: meshes of files '.med' are not imported; allowed: .inp, .unv\n"))

    def test_refused(self):
        text = unv(2, 8)
        line = {part: number for number, part in enumerate(text.splitlines(), 1)}
        [first] = integers([1, 85, 1, 1, 7, 8], 8)
        [twin] = integers([2, 85, 1, 1, 7, 8], 8)
        [one], [two] = integers([1, 1, 1, 11], 8), integers([2, 1, 1, 11], 8)
        [soil], [cells] = integers([1, 0, 0, 0, 0, 0, 0, 2], 8), integers([8, 1, 0, 0, 8, 2, 0, 0], 8)
        at, group = f"box.unv:{line[first]}: element 1 ", f"box.unv:{line[soil] + 1}: the group 'soil' "
        x, zero, five = (f"{value:25.16E}".replace("E", "D") for value in (1.0, 0.0, 5.0))
        node = " " * 9 + "1"
        for old, new, message in (
                (first, first.replace("85", "71"), at + "is of the kind 71, which is not read; allowed"),
                (first, first[:-1] + "6", at + "of the kind 85 has 6 nodes; expected 8"),
                (one, two, f"box.unv:{line[two] + 1}: node 2 is given twice"),
                (first, twin, ": element 2 is given twice"),
                (f"{first}\n{node}", f"{first}\n       777", at + "names node 777, which there is not"),
                (f"{first}\n{node}", f"{first}\n         a", f"box.unv:{line[first] + 1}: 'a' is no whole number"),
                (x + zero, " 1.0 zero", f"box.unv:{line[two] + 1}: 'zero' is no number"),
                (x + zero, " 1.0", f"box.unv:{line[two] + 1}: node 2 has 2 coordinates; expected 3"),
                (f"{zero}\n{two}", f"{x}\n{two}", at + "does not lie in the plane z = 0"),
                (soil, soil.replace("2", "3"), ": group 'soil' has 16 numbers; expected 12"),
                (cells, cells.replace("         2", "        55"), group + "names element 55, which there is not"),
                (cells, cells.replace("8", "7", 1), group + "mixes nodes, cells and sides; make a group of each"),
                (f"{soil}\nsoil", soil + "\n", f"box.unv:{line[soil] + 1}: a group has no name"),
                (f"{five}{zero}\n    -1", f"{five}{zero}\n{two}\n    -1", ": the dataset ends within node 2"),
                ("  2412\n", "  2400\n", "box.unv:1: there are no elements (dataset 2412)"),
                ("  2411\n", "  2400\n", at + "names node 1, which there is not"),
                ("    -1\n", "", "box.unv:1: no universal file: a dataset begins with a line '-1'")):
            with self.subTest(new):
                self.assertIn(old, text)
                with self.assertRaises(MudlineError) as caught:
                    self.convert("box.unv", text.replace(old, new, 1))
                self.assertIn(message, str(caught.exception))
                self.assertNotIn("\n", str(caught.exception))
        cut = r"box.unv:\d+: the file is cut off: the dataset of line \d+ does not end"
        with self.assertRaisesRegex(MudlineError, cut):
            self.convert("box.unv", text[:-7])


class Import(MudlineCase):
    def convert(self, text, *words):
        self.write("box.inp", text)
        return subprocess.run([PROGRAM, "import", "box.inp", *words], capture_output=True, text=True, cwd=self.folder)

    def test_every_kind_of_cell(self):
        """Compressed between rollers it shortens by load times height over the constrained modulus."""
        for (dimension, size), family in itertools.product(CELLS, ("CPE", "C3D")):
            if (family == "C3D") != (dimension == 3):
                continue
            with self.subTest(cell=f"{family}{size}"):
                text, count = inp(dimension, size, family)
                done = self.convert(text)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn("region: soil\n", done.stdout)
                self.assertIn("node set: corner\n", done.stdout)
                axes = "xyz"[:dimension]
                fixed = {f"{side}": {"type": "fixed", "set": side, "components": side[0]} for axis in axes[:-1] for side in (axis + "0", axis + "1")}
                deck = self.write("box.xml", deck_text("box", {
                    "mesh": {"type": "gmsh", "geometry": "plane strain" if dimension == 2 else "three-dimensional", "file": "box.msh",
                             "order": 2 if CELLS[dimension, size].edges else 1},
                    "materials": {"soil": {"regions": ["soil"], "density": 1800.0, "skeleton": {
                        "type": "linear elastic", "Young's modulus": 1e7, "Poisson's ratio": 0.25}}},
                    "physics": {"ground": {"type": "solid"}},
                    "boundary conditions": {"base": {"type": "fixed", "set": "base"}, **fixed,
                                            "load": {"type": "pressure", "set": "top", "value": 100.0}},
                    "stages": {"load": {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 1.0}}},
                    "output": {"probes": {"top": [0.0] * (dimension - 1) + [HIGH]}}}))
                run = subprocess.run([PROGRAM, "run", deck], capture_output=True, text=True, cwd=self.folder)
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertIn(f"{count} elements, ", run.stdout + run.stderr)
                found = History(os.path.join(self.folder, "results", "box.csv"))[f"probe/top/displacement {axes[-1]}"][-1]
                self.assertAlmostEqual(found / (-100.0 * HIGH / 1.2e7), 1, delta=1e-4)  # finite strain of 1e-5
                os.remove(os.path.join(self.folder, "results", "box.csv"))

    def test_scale_and_name(self):
        text, _ = inp(2, 8, "CAX")
        self.assertEqual(self.convert(text, "-o", "small.msh", "--scale", "0.001").returncode, 0)
        with open(os.path.join(self.folder, "small.msh")) as file:
            self.assertIn(" 0.001 0.002 0.0\n", file.read())

    def test_part_and_instance(self):
        text, _ = inp(2, 3, "CPE")
        whole = "*Part, name=p\n" + text.replace("*Step\n*Static\n", "*End Part\n*Assembly, name=a\n*Instance, name=p-1, part=p\n*End Instance\n"
                                                 "*Nset, nset=picked, instance=p-1\n1, 2\n*End Assembly\n*Step\n")
        done = self.convert(whole)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("picked", done.stdout)
        for more, message in (("*Instance, name=q, part=p\n*End Instance\n", "several instances of parts"),):
            self.assertIn(message, self.convert(whole.replace("*End Assembly", more + "*End Assembly")).stderr)
        self.assertIn("an instance that is moved", self.convert(whole.replace("part=p\n", "part=p\n 1., 0., 0.\n")).stderr)

    def test_refused(self):
        text, _ = inp(2, 4, "CPE")
        line = {part: number for number, part in enumerate(text.splitlines(), 1)}
        for old, new, message in (
                ("type=CPE4R", "type=S4R", f"box.inp:{line['*Element, type=CPE4R, elset=all']}: elements of type 'S4R' are not read"),
                ("type=CPE4R", "type=CPE5", "there are no cells of 5 nodes"),
                ("1, 1, 2, 3, 4", "1, 1, 2, 3, 77", f"box.inp:{line['1, 1, 2, 3, 4']}: element 1 names node 77, which there is not"),
                ("1, 1, 2, 3, 4", "1, 1, 2, 3", "element 1 "), ("1, 1, 2, 3, 4", "2, 1, 2, 3, 4", "element 2 is given twice"),
                ("1, 0, 0", "1, 0, a", "is no node: expected its number and two or three coordinates"),
                ("2, S3", "2, S7", "element 2 has no face 7"), ("2, S3", "none, S3", "there is no element set 'none'"),
                ("elset=soil, material", "elset=sol, material", "there is no element set 'sol'"),
                ("1, 2, 1", "1, 1, 1", "element 2 is in no region"),
                ("*Step", "*Include, input=a.inp", "*INCLUDE of 'a.inp' is not followed"),
                ("*Heading", "Heading", "no Abaqus input file")):
            with self.subTest(new):
                self.assertIn(old, text)
                done = self.convert(text.replace(old, new, 1))
                self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
                self.assertIn(message, done.stderr)
        done = subprocess.run([PROGRAM, "import", "none.inp"], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (2, "error: none.inp: cannot be read: No such file or directory\n"))


if __name__ == "__main__":
    unittest.main()
