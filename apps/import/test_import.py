"""Meshes of Abaqus input files: every kind of cell under a load that has an exact answer, groups, and what is refused."""
import itertools
import os
import subprocess
import sys
import unittest

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, "..", "..", "python"), os.path.join(HERE, "..", "..", "tests", "support")]
from mudline.abaqus import CELLS  # noqa: E402
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
