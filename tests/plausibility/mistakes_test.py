"""Mistakes of practice are doubted by name, in the plane and in space; the decks that they were made of are not."""
import collections
import re
import unittest

from mistakes import BASES, M, MISTAKES, changed, mesh_files
from mudline_case import MudlineCase, deck_text, program


class Mistakes(MudlineCase):
    def setUp(self):
        super().setUp()
        for name, text in mesh_files().items():
            self.write(name, text)

    def doubts(self, decks, ranks=1):
        """{name: [line]} of {name: deck}, all in one start of the program."""
        for name, deck in decks.items():
            self.write(name + ".xml", deck_text(name, deck))
        done = program(["check", "--each"] + [name + ".xml" for name in decks], ranks, self.folder)
        self.assertEqual(done.returncode, 0, "\n".join(line for line in done.stdout.splitlines() if "is valid" not in line))
        found = collections.defaultdict(list)
        for line in done.stderr.splitlines():
            doubt = re.fullmatch(r"warning: (\w+)\.xml: (.*)", line)
            found[doubt[1] if doubt else "others"].append(doubt[2] if doubt else line)
        return found

    def test_right_decks_are_not_doubted(self):
        decks = {f"{name} {space}".replace(" ", "_"): base(space) for name, base in BASES.items() for space in (False, True)}
        self.assertEqual(dict(self.doubts(decks)), {})

    def test_a_value_that_misses_its_range_by_rounding_is_not_doubted(self):
        decks = {name: changed(BASES["sand"](False), {M + "permeability/hydraulic conductivity": 1e-9,
                                                      "plausibility": {"sand conductivity": [least, 0.1]}}, False)
                 for name, least in (("rounding", 1.0000000000001e-9), ("less", 1.001e-9))}
        doubted = {name for name, lines in self.doubts(decks).items()
                   if any("(plausibility/sand conductivity)" in line for line in lines)}
        self.assertEqual(doubted, {"less"})

    def test_mistakes_are_doubted(self):
        self.assertGreaterEqual(len(MISTAKES), 60)
        for space in (False, True):
            decks = {f"row_{i}": changed(BASES[base](space), changes, space) for i, (base, changes, _) in enumerate(MISTAKES)}
            found = self.doubts(decks)
            for i, (base, changes, name) in enumerate(MISTAKES):
                with self.subTest(base=base, changes=changes, space=space):
                    self.assertTrue(any(f"(plausibility/{name})" in doubt for doubt in found[f"row_{i}"]), found[f"row_{i}"])

    def test_two_ranks_doubt_the_same(self):
        """Every seventh mistake, in turn in the plane and in space; figures agree in the digits that are told."""
        rows = MISTAKES[::7]
        decks = {f"row_{i}": changed(BASES[base](i % 2 == 1), changes, i % 2 == 1) for i, (base, changes, _) in enumerate(rows)}
        one, two = self.doubts(decks), self.doubts(decks, ranks=2)
        self.assertEqual(one, two)
        self.assertEqual(len(one), len(rows))


if __name__ == "__main__":
    unittest.main()
