"""The notebooks of docs/notebooks: they run from the first to the last cell and find what their last cell asserts.

They are scripts with cells ("# %%"), which editors and Jupytext open as notebooks, and which plain Python runs. Two
go a shorter way here than a reader's, one on a coarser mesh, so that the tests stay quick.
"""
import os
import pathlib
import re
import subprocess
import sys
import unittest

from mudline_case import PROGRAM, ROOT, MudlineCase

FOLDER = pathlib.Path(ROOT, "docs", "notebooks")
SHORTER = {"own_cpt": ('"6*diameter"', '"0.2*diameter"'),
           "pile_set_up": ('"2 m", "diameter/20"', '"0.2 m", "diameter/6"')}


class Notebooks(MudlineCase):
    def run_notebook(self, name):
        text = (FOLDER / f"{name}.py").read_text(encoding="utf-8")
        cells = re.split(r"(?m)^# %%", text)
        self.assertEqual(cells[0], "")
        self.assertGreaterEqual(len(cells), 6)
        for cell in cells[1:]:
            if cell.startswith(" [markdown]"):
                self.assertRegex(cell, r"\A \[markdown\]\n(# .*\n)+\n\Z")
        if name in SHORTER:
            self.assertEqual(text.count(SHORTER[name][0]), 1)
            text = text.replace(*SHORTER[name])
        script = self.write(f"{name}.py", text)
        more = {"PYTHONPATH": os.path.join(ROOT, "python"), "MUDLINE_PROGRAM": PROGRAM, "MPLBACKEND": "Agg"}
        done = subprocess.run([sys.executable, "-B", "-W", "error", script], capture_output=True, text=True,
                              cwd=self.folder, env={**os.environ, **more})
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def test_there_are_these(self):
        self.assertEqual({path.stem for path in FOLDER.glob("*.py")}, {"terzaghi", "own_cpt", "pile_set_up"})

    def test_terzaghi(self):
        self.assertIn("% of the load", self.run_notebook("terzaghi"))

    def test_own_cpt(self):
        self.assertIn("N_kt", self.run_notebook("own_cpt"))

    def test_pile_set_up(self):
        self.assertIn("after 1 year: excess pore pressure ", self.run_notebook("pile_set_up"))


if __name__ == "__main__":
    unittest.main()
