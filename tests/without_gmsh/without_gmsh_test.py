"""The program that is built without Gmsh: what it runs, and what it refuses in one line."""
import os
import shutil
import subprocess
import unittest

import mudline_case
from mudline_case import ROOT, MudlineCase

mudline_case.PROGRAM = os.environ["MUDLINE_WITHOUT_GMSH"]
NEEDS = "needs Gmsh, and this program was built without it (MUDLINE_GMSH=OFF)"
BASE = os.path.join(ROOT, "tests", "deck_errors", "base.xml")
BOX = '<Parameter name="type" type="string" value="box"/>'
SPHERE = '<Parameter name="type" type="string" value="sphere"/>'


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
        self.assertIn(f"mesh/type: 'gmsh' {NEEDS}", self.refused((BOX, BOX.replace("box", "gmsh") + file)))
        self.assertIn(f"bodies/ball/contour/type: 'gmsh curve' {NEEDS}", self.refused((SPHERE, SPHERE.replace("sphere", "gmsh curve") + file)))

    def test_it_lists_its_types(self):
        ended = mudline_case.program(["list"])
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertEqual(ended.stdout.count("not in this build"), 2, ended.stdout)


if __name__ == "__main__":
    unittest.main()
