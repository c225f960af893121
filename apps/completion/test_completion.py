"""Completion in bash: what it offers for the beginnings of lines."""
import os
import subprocess
import sys
import tempfile
import unittest

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tests", "support"))
from mudline_case import PROGRAM, ROOT  # noqa: E402

ASK = """
source "$1"; shift
COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
_mudline; printf '%s\\n' "${COMPREPLY[@]}"
"""


class Completion(unittest.TestCase):
    def offers(self, *words, program=PROGRAM):
        script = os.path.join(ROOT, "apps", "completion", "mudline.bash")
        done = subprocess.run(["bash", "-c", ASK, "ask", script, program, *words], capture_output=True, text=True, check=True)
        self.assertEqual(done.stderr, "")
        return done.stdout.split("\n")[:-1]

    def test_commands(self):
        self.assertLessEqual({"run", "check", "explain", "report", "sweep", "version"}, set(self.offers("")))
        self.assertEqual(self.offers("r"), ["report", "run"])

    def test_options(self):
        self.assertLessEqual({"--restart", "--set", "--steps", "--quiet"}, set(self.offers("run", "deck.xml", "--")))
        self.assertEqual(self.offers("run", "--over"), ["--overwrite"])
        self.assertIn("--png", self.offers("report", "results/clay", "--"))

    def test_names(self):
        self.assertEqual(self.offers("explain", "modified"), ["modified\\ cam\\ clay"])
        self.assertIn("biot", self.offers("template", "b"))

    def test_files_are_left_to_the_shell(self):
        self.assertEqual(self.offers("run", "inp"), [""])

    def test_nothing_is_built(self):
        """In a clone that is not built the program is a script that would install packages."""
        with tempfile.TemporaryDirectory() as folder:
            script, trace = os.path.join(folder, "mudline"), os.path.join(folder, "called")
            with open(script, "w") as file:
                file.write(f"#!/bin/sh\ntouch {trace}\necho Subcommands:\necho '  run   a deck'\n")
            os.chmod(script, 0o755)
            self.assertEqual(self.offers("r", program=script), ["run"])
            self.assertTrue(os.path.exists(trace))
            os.remove(trace)
            open(os.path.join(folder, "CMakePresets.json"), "w").close()
            self.assertEqual(self.offers("r", program=script), [""])
            self.assertFalse(os.path.exists(trace))


if __name__ == "__main__":
    unittest.main()
