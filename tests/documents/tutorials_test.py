"""The commands of the tutorials, one after the other as a reader types them, and what is shown below them.

A run of more than a few seconds is replaced by its --dry-run. Numbers are left out of the comparison: they differ
from machine to machine. tests/plugins builds and runs the plugins; here their files must be there.
"""
import os
import pathlib
import re
import shlex
import unittest

from mudline_case import ROOT, MudlineCase, program

FOLDER = pathlib.Path(ROOT, "docs", "tutorials")
COPY = re.compile(r"cp -r inputs/plugins/(\w+) \.")


def steps(text):
    """[(command, lines shown below it)] of a page; what is shown stands in a block of text after the command."""
    found = []
    for block in re.findall(r"^```text\n(.*?)^```|^    ((?:mudline|cp) [^\n]*)$", text, re.DOTALL | re.MULTILINE):
        if block[1]:
            found.append((block[1], []))
        else:
            found[-1][1].extend(block[0].splitlines())
    return found


def plain(line):
    """A line without its numbers and units of time, which differ from machine to machine."""
    return re.sub(r"# (?:s|ms|min|h|MB|GB)\b", "# .", re.sub(r"-?\d[\d.]*(?:e[-+]?\d+)?", "#", line)).strip()


class Tutorials(MudlineCase):
    def setUp(self):
        super().setUp()
        os.symlink(os.path.join(ROOT, "inputs"), os.path.join(self.folder, "inputs"))

    def shown(self, shown, output):
        """Every line that is shown is one of the output; one that ends with ... is the beginning of one."""
        lines = [plain(line) for line in output.splitlines()]
        for line in shown:
            if line.strip() == "...":
                continue
            begins = line.endswith(" ...")
            wanted = plain(line[:-4] if begins else line)
            self.assertTrue(any(has == wanted or begins and has.startswith(wanted) for has in lines),
                            f"not printed: {line}\n{output}")

    def plugin(self, folder, command):
        """A command in the copy of an example of a plugin: what it names is there, or is built."""
        source = pathlib.Path(ROOT, "inputs", "plugins", folder)
        for word in shlex.split(command):
            if word.endswith(".xml"):
                self.assertTrue((source / word).exists(), command)
            elif word.endswith(".so"):
                self.assertIn(f"mudline_add_plugin({pathlib.Path(word).stem} ",
                              (source / "CMakeLists.txt").read_text())

    def walk(self, name):
        """Carries out a page; returns how many commands it has."""
        folder, count = "", 0
        for command, shown in steps((FOLDER / f"{name}.md").read_text(encoding="utf-8")):
            count += 1
            copied = COPY.match(command)
            if copied:
                folder = copied[1]
            elif folder:
                self.plugin(folder, command)
            elif not command.startswith("mudline report"):  # it needs the result of a whole run
                words = shlex.split(command)[1:]
                whole = words[0] != "run" or "--dry-run" in words
                done = program(words + ([] if whole else ["--dry-run"]), folder=self.folder)
                self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}{done.stderr}")
                if whole:
                    self.shown(shown, done.stdout + done.stderr)
        return count

    def test_what_is_not_printed_is_found(self):
        self.shown(["a 3 b", "...", "time: 3 ..."], "a 4.5e-3 b\ntime: 9 of all")
        self.assertRaises(AssertionError, self.shown, ["a 3 c"], "a 4 b")
        self.assertRaises(AssertionError, self.shown, ["a 3 ..."], "b a 3 c")

    def test_every_page_is_walked(self):
        walked = {name[len("test_page_"):] for name in dir(self) if name.startswith("test_page_")}
        self.assertEqual(walked, {path.stem for path in FOLDER.glob("*.md")})

    def test_page_anchor(self):
        self.assertGreaterEqual(self.walk("anchor"), 5)

    def test_page_cpt(self):
        self.assertGreaterEqual(self.walk("cpt"), 4)

    def test_page_pile(self):
        self.assertGreaterEqual(self.walk("pile"), 5)

    def test_page_soil_law(self):
        self.assertGreaterEqual(self.walk("soil_law"), 8)

    def test_page_calibration(self):
        self.assertGreaterEqual(self.walk("calibration"), 6)

    def test_page_friction_law(self):
        self.assertGreaterEqual(self.walk("friction_law"), 5)

    def test_page_physics(self):
        self.assertGreaterEqual(self.walk("physics"), 4)

    def test_page_cluster(self):
        self.assertGreaterEqual(self.walk("cluster"), 3)


if __name__ == "__main__":
    unittest.main()
