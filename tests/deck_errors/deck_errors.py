"""Every wrong deck gives exactly one line, on any number of ranks, at once, and exit code 2."""
import os
import subprocess
import unittest

import bad_bodies
import bad_files
import bad_values
import mesh_motion
import misspelt
import point_decks
from mudline_case import PROGRAM, MudlineCase, program
from wrong_deck import BASE

TIMEOUT = 60  # [s] a deck that hangs fails
DECKS = misspelt.DECKS + bad_values.DECKS + bad_bodies.DECKS + bad_files.DECKS + mesh_motion.DECKS


def own_lines(stderr):
    """What the program wrote: mpiexec adds a notice of its own about the exit code, framed by dashes."""
    lines, framed = [], False
    for line in stderr.splitlines():
        if line.startswith("-----"):
            framed = not framed
        elif not framed and line.strip():
            lines.append(line)
    return lines


class Answering(MudlineCase):
    maxDiff = None

    def answer(self, arguments, expected, ranks=1):
        try:
            done = program(arguments, ranks, self.folder, TIMEOUT)
        except subprocess.TimeoutExpired:
            self.fail(f"hangs on {ranks} rank(s); expected: {expected}")
        self.assertEqual(own_lines(done.stderr), [expected.replace("{folder}", os.path.realpath(self.folder))])
        self.assertEqual(done.returncode, 2)

    def answer_of(self, command, wrong, ranks):
        self.write("deck.xml", wrong.text)
        for name, content in wrong.files:
            self.write(name, content)
        arguments = [command, "deck.xml"]
        for text in wrong.settings:
            arguments += ["--set", text]
        self.answer(arguments, wrong.expected, ranks)


class DeckErrors(Answering):
    def wrong(self, wrong, ranks):
        self.answer_of("check", wrong, ranks)

    def test_the_base_is_valid(self):
        self.write("deck.xml", BASE)
        self.assertEqual(program(["check", "deck.xml"], folder=self.folder).returncode, 0)
        done = program(["run", "deck.xml"], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_names_are_unique(self):
        self.assertEqual(len({w.name for w in DECKS}), len(DECKS))

    def test_run_answers_like_check(self):
        self.write("deck.xml", misspelt.DECKS[0].text)
        self.answer(["run", "deck.xml"], misspelt.DECKS[0].expected)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "results")))


class PointErrors(Answering):
    """Decks of `mudline point`."""

    def wrong(self, wrong, ranks):
        self.answer_of("point", wrong, ranks)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "results")))

    def test_the_base_is_valid(self):
        self.write("deck.xml", point_decks.BASE)
        for command in ("check", "point"):
            done = program([command, "deck.xml"], folder=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_names_are_unique(self):
        self.assertEqual(len({w.name for w in point_decks.DECKS}), len(point_decks.DECKS))

    def test_check_answers_like_point(self):
        for name in ("unknown test type", "a start that the law refuses", "unknown function"):
            (wrong,) = [w for w in point_decks.DECKS if w.name == name]
            self.write("deck.xml", wrong.text)
            self.answer(["check", "deck.xml"], wrong.expected)

    def test_run_points_to_point(self):
        self.write("deck.xml", point_decks.BASE)
        line = point_decks.BASE[:point_decks.BASE.index('<ParameterList name="tests">')].count("\n") + 1
        self.answer(["run", "deck.xml"], f"error: deck.xml:{line}: tests: tests of material points are no part of a run; "
                    "`mudline point` runs them")

    def test_several_ranks(self):
        self.write("deck.xml", point_decks.BASE)
        self.answer(["point", "deck.xml"], "error: a material point cannot be shared: run `mudline point` on one rank", 2)

    def test_a_run_has_no_tests(self):
        self.write("deck.xml", BASE)
        self.answer(["point", "deck.xml"], "error: deck.xml:2: required section 'tests' is missing; see `mudline list test`")

    def test_conformance_draws_nothing(self):
        self.write("deck.xml", point_decks.BASE)
        self.answer(["point", "deck.xml", "--conformance", "--png", "a.png"],
                    "error: --conformance draws nothing; give --png without it")

    def test_results_folder_cannot_be_made(self):
        self.write("deck.xml", point_decks.BASE)
        self.answer(["point", "deck.xml", "--set", "output/folder=deck.xml/results"],
                    "error: --set output/folder=deck.xml/results: output/folder: the folder 'deck.xml/results' cannot be made: "
                    "Not a directory")


class CommandLine(Answering):
    def setUp(self):
        super().setUp()
        self.write("deck.xml", BASE)

    def test_deck_missing(self):
        for ranks in (1, 2):
            self.answer(["run", "none.xml"], "error: none.xml: the deck does not exist or cannot be read", ranks)

    def test_deck_is_a_folder(self):
        self.answer(["run", "."], "error: .: the deck does not exist or cannot be read")

    def test_no_deck(self):
        self.answer(["run"], "error: deck is required (see mudline --help)")

    def test_misspelt_command(self):
        self.answer(["chek", "deck.xml"], "error: unknown command 'chek' (did you mean 'check'?)")

    def test_misspelt_option(self):
        self.answer(["run", "deck.xml", "--step", "1"], "error: The following argument was not expected: --step (see mudline --help)")

    def test_negative_steps(self):
        self.answer(["run", "deck.xml", "--steps", "-1"],
                    "error: --steps: Value -1 not in range 1 to 1000000000 (see mudline --help)")

    def test_overlay_replaces_a_section_by_a_parameter(self):
        self.write("over.xml", '<ParameterList name="over">\n  <Parameter name="mesh" type="string" value="box"/>\n</ParameterList>\n')
        self.answer(["check", "deck.xml", "over.xml"],
                    "error: over.xml:2: mesh: a parameter cannot replace the section given at deck.xml:3")

    def test_error_of_an_overlay_names_the_overlay(self):
        self.write("over.xml", '<ParameterList name="over">\n  <ParameterList name="mesh">\n'
                   '    <Parameter name="cell" type="string" value="quad8"/>\n  </ParameterList>\n</ParameterList>\n')
        self.answer(["check", "deck.xml", "over.xml"], "error: over.xml:3: mesh/cell: 'quad8' is not a choice (did you mean 'quad9'?)")

    def test_results_folder_cannot_be_made(self):
        self.answer(["run", "deck.xml", "--set", "output/folder=deck.xml/results"],
                    "error: --set output/folder=deck.xml/results: output/folder: the folder 'deck.xml/results' cannot be made: "
                    "Not a directory")

    def test_unknown_names(self):
        self.answer(["explain", "modified cam"], "error: nothing is called 'modified cam' (did you mean 'modified cam clay'?)")
        self.answer(["template", "bio"], "error: nothing is called 'bio' (did you mean 'biot'?)")
        self.answer(["list", "physic"], "error: unknown kind 'physic' (did you mean 'physics'?)")


class Restart(Answering):
    def test_restart(self):
        self.write("deck.xml", BASE)
        missing = "there is no such checkpoint; --restart continues a run of the same deck that left one"
        for ranks in (1, 2):
            self.answer(["run", "-q", "deck.xml", "--restart"], f"error: results/deck.restart: {missing}", ranks)
        self.assertEqual(program(["run", "-q", "deck.xml", "--steps", "2"], folder=self.folder).returncode, 0)
        restart = ["run", "-q", "deck.xml", "--restart"]
        self.answer(restart, "error: results/deck.restart: checkpoint was written on 1 rank; run it on 1 rank", 2)
        self.answer(restart + ["--set", "mesh/cells={4, 4}"],
                    "error: results/deck.restart: checkpoint belongs to a mesh of 49 nodes and 9 elements, "
                    "but this mesh has 81 nodes and 16 elements")
        self.answer(restart + ["--set", "contacts/ball on clay/quadrature degree=9"],
                    "error: results/deck.restart: the checkpoint does not fit this deck: "
                    "its array 'array/contact/ball on clay/points' is missing or of another size")
        self.write("results/deck.restart", "rubbish")
        self.answer(restart, "error: results/deck.restart: the checkpoint cannot be read: "
                    "cannot open 'results/deck.restart' as an HDF5 file")


def add_tests():
    for case, decks in ((DeckErrors, DECKS), (PointErrors, point_decks.DECKS)):
        for wrong in decks:
            for ranks in wrong.ranks:
                name = "test " + wrong.name + ("" if ranks == 1 else f" on {ranks} ranks")
                setattr(case, name, lambda self, wrong=wrong, ranks=ranks: self.wrong(wrong, ranks))


if __name__ == "__main__":
    add_tests()
    unittest.main()
