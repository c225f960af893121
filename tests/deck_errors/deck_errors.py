"""Every wrong deck gives exactly one line, on any number of ranks, at once, and exit code 2."""
import os
import subprocess
import tempfile
import unittest

import bad_bodies
import bad_files
import bad_values
import mesh_motion
import misspelt
import point_decks
import space_decks
import unused
from mudline_case import PROGRAM, MudlineCase, program
from own_lines import own_lines
from wrong_deck import BASE

TIMEOUT = 60  # [s] a deck that hangs fails
DECKS = misspelt.DECKS + bad_values.DECKS + bad_bodies.DECKS + bad_files.DECKS + mesh_motion.DECKS + space_decks.DECKS + unused.DECKS


def answers(decks):
    """{(name, ranks): the line that `mudline check --each` says of each wrong deck}: one start of the program per number of ranks."""
    said = {}
    with tempfile.TemporaryDirectory() as folder:
        for i, wrong in enumerate(decks):
            own = os.path.join(folder, str(i))
            os.mkdir(own)
            for name, content in [("deck.xml", wrong.text), *wrong.files]:
                with open(os.path.join(own, name), "w") as file:
                    file.write(content)
        for ranks in sorted({ranks for wrong in decks for ranks in wrong.ranks}):
            chosen = [i for i, wrong in enumerate(decks) if ranks in wrong.ranks and not wrong.settings]
            done = program(["check", "--each"] + [f"{i}/deck.xml" for i in chosen], ranks, folder)
            lines = done.stdout.splitlines()
            assert len(lines) == len(chosen) and done.returncode == 2 and not own_lines(done.stderr), (done.stdout, done.stderr)
            for i, line in zip(chosen, lines):
                line = line.replace(f"{os.path.realpath(folder)}/{i}", "{folder}").replace(f"{i}/deck.xml:", "deck.xml:")
                said[decks[i].name, ranks] = line
    return said


class Answering(MudlineCase):
    maxDiff = None
    decks = ()

    @classmethod
    def setUpClass(cls):
        cls.said = answers(cls.decks) if cls.decks else {}

    def wrong(self, wrong, ranks):
        if wrong.settings:
            self.answer_of("check", wrong, ranks)
        else:
            self.assertEqual(self.said[wrong.name, ranks], wrong.expected)

    def answer(self, arguments, expected, ranks=1, warned=""):
        """The line that ends the program, after a line that holds `warned` where that is given."""
        try:
            done = program(arguments, ranks, self.folder, TIMEOUT)
        except subprocess.TimeoutExpired:
            self.fail(f"hangs on {ranks} rank(s); expected: {expected}")
        *before, last = own_lines(done.stderr)
        self.assertEqual(last, expected.replace("{folder}", os.path.realpath(self.folder)))
        self.assertEqual(len(before), 1 if warned else 0, before)
        self.assertTrue(all(line.startswith("warning: ") and warned in line for line in before), before)
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
    decks = DECKS

    def test_the_base_is_valid(self):
        self.write("deck.xml", BASE)
        self.assertEqual(program(["check", "deck.xml"], folder=self.folder).returncode, 0)
        done = program(["run", "deck.xml"], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_names_are_unique(self):
        self.assertEqual(len({w.name for w in DECKS}), len(DECKS))

    def test_check_without_each(self):
        for name in ("section", "unstable pair", "contradicting conditions"):
            (wrong,) = [w for w in DECKS if w.name == name]
            self.answer_of("check", wrong, 2)

    def test_the_command_line_may_overrule(self):
        self.write("deck.xml", BASE)
        some = "conditions={base, axis, drained surface, surcharge}"
        fluid = "materials/clay/fluid/"
        for settings in (["stages/push/contacts={none}"], ["boundary conditions/surcharge/value=20e3"], ["stages/push/" + some, "stages/geostatic/" + some],
                         [fluid + "bulk modulus=2e9", fluid + "incompressible=true"]):
            arguments = [word for setting in settings for word in ("--set", setting)]
            self.assertEqual(program(["check", "deck.xml", *arguments], folder=self.folder).returncode, 0)

    def test_each_goes_on_after_an_error(self):
        for name, text in (("good.xml", BASE), ("bad.xml", "<ParameterList/>"), ("over.xml", BASE)):
            self.write(name, text)
        done = program(["check", "--each", "good.xml", "bad.xml", "none.xml", "over.xml"], folder=self.folder)
        self.assertEqual(done.stdout.splitlines(), ["good.xml: the deck is valid", "error: bad.xml:1: required section 'mesh' is missing",
                                                    "error: none.xml: the deck does not exist or cannot be read",
                                                    "over.xml: the deck is valid"])
        self.assertEqual((done.returncode, done.stderr), (2, ""))

    def test_run_answers_like_check(self):
        self.write("deck.xml", misspelt.DECKS[0].text)
        self.answer(["run", "deck.xml"], misspelt.DECKS[0].expected)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "results")))


class PointErrors(Answering):
    """Decks of `mudline point`."""
    decks = point_decks.DECKS

    def test_the_base_is_valid(self):
        self.write("deck.xml", point_decks.BASE)
        for command in ("check", "point"):
            done = program([command, "deck.xml"], folder=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_names_are_unique(self):
        self.assertEqual(len({w.name for w in point_decks.DECKS}), len(point_decks.DECKS))

    def test_point_answers_like_check(self):
        for name in ("unknown test type", "a start that the law refuses", "unknown function"):
            (wrong,) = [w for w in point_decks.DECKS if w.name == name]
            self.answer_of("point", wrong, 1)
            self.assertFalse(os.path.exists(os.path.join(self.folder, "results")))

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
        self.answer(["run", "deck.xml", "--step", "1"],
                    "error: The following argument was not expected: --step (did you mean '--steps'?)")
        self.answer(["run", "deck.xml", "--slowly", "1"],
                    "error: The following argument was not expected: --slowly (see mudline --help)")

    def test_ranks_for_the_program(self):
        for option in ("-n", "-np", "--ranks=2"):
            line = program(["run", "deck.xml", option, "2"], folder=self.folder).stderr.strip()
            self.assertTrue(line.endswith("; ranks are those of the launcher: ./mudline -n 2 run, or mpirun -n 2 "
                                          "mudline run"), line)

    def test_a_setting_without_equals(self):
        self.answer(["run", "deck.xml", "--set", "mesh/cells", "{4, 4}"],
                    "error: --set mesh/cells: expected section/parameter=value, such as stages/push/duration=2.0")

    def test_a_deck_without_its_ending(self):
        for ranks in (1, 2):
            self.answer(["check", "deck"],
                        "error: deck: the deck does not exist or cannot be read (did you mean 'deck.xml'?)", ranks)

    def test_a_deck_given_twice(self):
        self.answer(["check", "deck.xml", "deck.xml"], "error: deck.xml: given twice; the files after the deck are overlays, which replace "
                    "parts of it")

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

    def test_split(self):
        split = ["split", "-q", "deck.xml", "--ranks"]
        self.answer(["split", "deck.xml"], "error: --ranks is required (see mudline --help)")
        self.answer(split + ["0"], "error: --ranks: Value 0 not in range 1 to 1000000 (see mudline --help)")
        self.answer(split + ["10"], "error: deck.xml:3: mesh: the mesh has 9 elements, fewer than the 10 ranks; use fewer ranks or a finer mesh")
        self.answer(split + ["2"], "error: split makes the whole mesh on one process: start it without mpirun", 2)
        self.answer(split + ["2", "--set", "mesh/celss={4, 4}"],
                    "error: --set mesh/celss={4, 4}: mesh/celss: unknown parameter (did you mean 'cells'?)")
        self.assertEqual(os.listdir(self.folder), ["deck.xml"])

    def test_mesh_parts(self):
        check = ["check", "-q", "deck.xml", "--mesh-parts"]
        for ranks in (1, 2):
            self.answer(check + ["none.h5"], "error: none.h5: there is no such file of mesh parts; `mudline split` writes one", ranks)
            self.answer(check + ["deck.xml"], "error: deck.xml: the mesh parts cannot be read: cannot open 'deck.xml' as an HDF5 file", ranks)
        self.assertEqual(program(["split", "-q", "deck.xml", "--ranks", "2", "-o", "two.h5"], folder=self.folder).returncode, 0)
        self.answer(check + ["two.h5"], "error: two.h5: the mesh was split for 2 ranks, but the run has 1; start it on 2, or run "
                    "`mudline split` again with --ranks 1")
        self.assertEqual(program(check + ["two.h5"], 2, self.folder).returncode, 0)
        self.answer(check + ["two.h5", "--set", "mesh/cells={3, 4}"], "error: two.h5: the parts are those of another mesh: mesh/cells: {3, 4}, was "
                    "{3, 3}; run `mudline split` again", 2)
        self.assertEqual(program(["run", "-q", "deck.xml", "--steps", "1"], folder=self.folder).returncode, 0)
        self.answer(["check", "-q", "deck.xml", "--mesh-parts", "results/deck.h5"],
                    "error: results/deck.h5: no file of mesh parts, as `mudline split` writes it")

    def test_unknown_names(self):
        self.answer(["explain", "modifed cam clay"],
                    "error: nothing is called 'modifed cam clay', and no text of the reference holds it (did you mean 'modified cam clay'?)")
        self.answer(["template", "cam clay"], "error: nothing is called 'cam clay' (did you mean 'modified cam clay'?)")
        self.answer(["template", "bio"], "error: nothing is called 'bio' (did you mean 'biot'?)")
        self.answer(["list", "physic"], "error: unknown kind 'physic' (did you mean 'physics'?)")


class Restart(Answering):
    def test_restart(self):
        self.write("deck.xml", BASE)
        missing = "there is no such checkpoint; --restart continues a run of the same deck that left one"
        os.makedirs(os.path.join(self.folder, "results"))
        self.write("results/deck.csv", "results without a checkpoint")
        for ranks in (1, 2):
            self.answer(["run", "-q", "deck.xml", "--restart"], f"error: results/deck.restart: {missing}", ranks)
        os.remove(os.path.join(self.folder, "results", "deck.csv"))
        self.assertEqual(program(["run", "-q", "deck.xml", "--steps", "2"], folder=self.folder).returncode, 0)
        restart = ["run", "-q", "deck.xml", "--restart"]
        for ranks in (1, 2):
            self.answer(restart + ["--set", "mesh/cells={4, 4}"],
                        "error: results/deck.restart: the checkpoint is that of another model: mesh/cells: {4, 4}, was {3, 3} "
                        "(--accept-changes goes on all the same)", ranks)
        accept = restart + ["--accept-changes"]
        self.answer(accept + ["--set", "mesh/cells={4, 4}"],
                    "error: results/deck.restart: checkpoint belongs to a mesh of 49 nodes and 9 elements, "
                    "but this mesh has 81 nodes and 16 elements", warned="mesh/cells: {4, 4}, was {3, 3}")
        self.answer(accept + ["--set", "contacts/ball on clay/quadrature degree=9"],
                    "error: results/deck.restart: the checkpoint does not fit this deck: "
                    "its array 'array/contact/ball on clay/points' is missing, or has other rows", warned="quadrature degree")
        self.answer(["run", "-q", "deck.xml", "--accept-changes"], "error: --accept-changes requires --restart (see mudline --help)")
        self.write("results/deck.restart", "rubbish")
        self.answer(restart, "error: results/deck.restart: the checkpoint is cut short, or cannot be read")


def add_tests():
    for case, decks in ((DeckErrors, DECKS), (PointErrors, point_decks.DECKS)):
        for wrong in decks:
            for ranks in wrong.ranks:
                name = "test " + wrong.name + ("" if ranks == 1 else f" on {ranks} ranks")
                setattr(case, name, lambda self, wrong=wrong, ranks=ranks: self.wrong(wrong, ranks))


if __name__ == "__main__":
    add_tests()
    unittest.main()
