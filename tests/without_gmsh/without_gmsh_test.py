"""The program that is built without Gmsh: what it runs, and what it refuses in one line."""
import os
import shutil
import subprocess
import tempfile
import unittest

import mudline_case
from mudline_case import ROOT, MudlineCase

NEEDS = "needs Gmsh, and this program was built without it (MUDLINE_GMSH=OFF)"
BASE = os.path.join(ROOT, "tests", "deck_errors", "base.xml")
BOX = '<Parameter name="type" type="string" value="box"/>'
NO_BOX = [(f'    <Parameter name="{name}" type="{kind}" value="{value}"/>\n', "") for name, kind, value in (
    ("cell", "string", "quad9"), ("cells", "Array(int)", "{3, 3}"), ("upper", "Array(double)", "{0.3, 0.3}"))]
SPHERE = '<Parameter name="type" type="string" value="sphere"/>'


def square():
    """The box of the base deck as a file of Gmsh's format 2.2, of quadrilaterals of 8 nodes."""
    places = [(i, j) for j in range(7) for i in range(7) if i % 2 == 0 or j % 2 == 0]
    number = {place: k + 1 for k, place in enumerate(places)}
    names = {"bottom": lambda k: (k, 0), "right": lambda k: (6, k), "top": lambda k: (k, 6), "left": lambda k: (0, k)}
    elements = [(8, tag, [number[at(k)], number[at(k + 2)], number[at(k + 1)]])
                for tag, at in enumerate(names.values(), start=1) for k in (0, 2, 4)]
    around = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)]
    elements += [(16, 5, [number[i + a, j + b] for a, b in around]) for j in (0, 2, 4) for i in (0, 2, 4)]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "5"]
    lines += [f'1 {tag} "{name}"' for tag, name in enumerate(names, start=1)] + ['2 5 "soil"', "$EndPhysicalNames"]
    lines += ["$Nodes", str(len(places))] + [f"{k + 1} {i / 20!r} {j / 20!r} 0" for k, (i, j) in enumerate(places)] + ["$EndNodes"]
    lines += ["$Elements", str(len(elements))]
    lines += [f"{k} {kind} 2 {tag} 1 {' '.join(map(str, nodes))}" for k, (kind, tag, nodes) in enumerate(elements, start=1)]
    return "\n".join([*lines, "$EndElements", ""])


def setUpModule():
    global SCRATCH
    SCRATCH = tempfile.mkdtemp()  # the program alone, without the library that stands beside it
    mudline_case.PROGRAM = shutil.copy(mudline_case.PROGRAM, SCRATCH)


def tearDownModule():
    shutil.rmtree(SCRATCH)


class WithoutGmsh(MudlineCase):
    def deck(self, *changes):
        with open(BASE, encoding="utf-8") as file:
            text = file.read()
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new, 1)
        path = os.path.join(self.folder, "deck.xml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def refused(self, *changes):
        ended = mudline_case.program(["check", self.deck(*changes)], folder=self.folder)
        self.assertEqual(ended.returncode, 2, ended.stderr)
        errors = [line for line in ended.stderr.splitlines() if line.startswith("error: ")]
        self.assertEqual(len(errors), 1, ended.stderr)
        return errors[0]

    def test_it_has_no_gmsh(self):
        libraries = subprocess.run(["ldd", mudline_case.PROGRAM], capture_output=True, text=True, check=True).stdout
        self.assertNotIn("libgmsh", libraries)
        self.assertIn("gmsh:    no", mudline_case.program(["version"]).stdout)

    def test_a_box_runs(self):
        ended = mudline_case.program(["run", self.deck()], folder=self.folder)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertIn("done: ", ended.stdout)

    def test_what_needs_gmsh_is_refused(self):
        shutil.copy(os.path.join(ROOT, "packages", "discretisation", "tests", "data", "cone.geo"), self.folder)
        file = '<Parameter name="file" type="string" value="cone.geo"/>'
        mesh = [(BOX, BOX.replace("box", "gmsh") + file), *NO_BOX]
        self.assertIn(f"mesh/file: 'cone.geo' {NEEDS}; allowed: mesh files (.msh) of the formats 1 to 2.2", self.refused(*mesh))
        shutil.copy(os.path.join(ROOT, "packages", "discretisation", "tests", "data", "cone_41.msh"), self.folder)
        mesh[0] = (BOX, BOX.replace("box", "gmsh") + file.replace("cone.geo", "cone_41.msh"))
        self.assertIn(f"mesh/file: 'cone_41.msh' {NEEDS}", self.refused(*mesh))
        self.assertIn(f"bodies/ball/contour/type: 'gmsh curve' {NEEDS}", self.refused((SPHERE, SPHERE.replace("sphere", "gmsh curve") + file)))

    def test_a_mesh_file_of_an_old_format_runs(self):
        with open(os.path.join(self.folder, "square.msh"), "w", encoding="utf-8") as file:
            file.write(square())
        file = '<Parameter name="file" type="string" value="square.msh"/>'
        ended = mudline_case.program(["run", self.deck((BOX, BOX.replace("box", "gmsh") + file), *NO_BOX)], folder=self.folder)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertIn("mesh: 9 quadrilaterals of 8 nodes in 'square.msh' made complete", ended.stdout)
        self.assertIn("done: ", ended.stdout)

    def test_it_lists_its_types(self):
        ended = mudline_case.program(["list"])
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertEqual(ended.stdout.count("not in this build"), 2, ended.stdout)


if __name__ == "__main__":
    unittest.main()
