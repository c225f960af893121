"""The manual page has every command with its options, and the exit codes; what it holds is no command of roff.

    test_man_page.py PROGRAM ROOT
"""
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

import man_page

PROGRAM, ROOT = sys.argv.pop(1), pathlib.Path(sys.argv.pop(1))


class ManPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.page = man_page.page(PROGRAM, (ROOT / "docs" / "user_guide.md").read_text(encoding="utf-8"))

    def test_every_command_has_its_options(self):
        named = [name for name, _ in man_page.commands(man_page.help_of(PROGRAM))]
        self.assertGreaterEqual(len(named), 13)
        for name in named:
            section = re.search(rf"^\.SH {name.upper()}$(.*?)^\.SH ", self.page, re.DOTALL | re.MULTILINE)[1]
            section = section.replace("\\-", "-")
            options = set(re.findall(r"--[a-z][a-z-]+", man_page.help_of(PROGRAM, name)))
            self.assertEqual({option for option in options if option not in section}, set(), name)

    def test_exit_codes(self):
        section = self.page[self.page.index(".SH EXIT STATUS"):]
        self.assertEqual(re.findall(r"^\.B (\d)$", section, re.MULTILINE), ["0", "1", "2", "3", "4"])

    def test_only_its_own_commands_of_roff(self):
        begins = {line.split()[0] for line in self.page.splitlines() if line[:1] in (".", "'")}
        self.assertEqual(begins, {".TH", ".SH", ".B", ".PP", ".nf", ".fi", ".TP"})
        self.assertEqual(man_page.plain(".a\n'b\nc\\d"), "\\&.a\n\\&'b\nc\\ed")

    @unittest.skipUnless(shutil.which("groff"), "groff is not installed")
    def test_groff_has_no_doubts(self):
        done = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-rLL=200n"], input=self.page, capture_output=True,
                              text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("exit codes: 0 done, 2 input error", done.stdout)


if __name__ == "__main__":
    unittest.main()
