"""The Python package: decks, runs and results."""
import os
import re
import subprocess
import sys
import unittest
from unittest import mock

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "tests", "support")]
import mudline  # noqa: E402
from mudline_case import PROGRAM, ROOT, MudlineCase  # noqa: E402

TERZAGHI = os.path.join(ROOT, "inputs", "consolidation", "terzaghi.xml")
SHORT = {"mesh/cells": [1, 8], "stages/consolidation/duration": 50.0}


class Decks(MudlineCase):
    def test_values_by_path(self):
        deck = mudline.Deck.read(TERZAGHI)
        self.assertEqual(deck["mesh/type"], "box")
        self.assertEqual(deck["stages"], ["consolidation"])
        self.assertIn("mesh/cells", deck)
        self.assertNotIn("mesh/cell s", deck)
        self.assertIsInstance(deck["mesh/cells"], list)
        with self.assertRaises(KeyError):
            deck["mesh/no such entry"]
        deck["stages/consolidation/duration"] = 3  # stays a double
        deck["output/error estimate"] = True
        deck["output/name"] = "other"
        deck["variables/height"] = "35.7 mm"
        deck["variables/twice"] = mudline.Expression("2*height")
        for line in ('<Parameter name="duration" type="double" value="3"', '<Parameter name="error estimate" type="bool" value="true"',
                     '<Parameter name="name" type="string" value="other"', '<Parameter name="height" type="double" value="35.7 mm"',
                     '<Parameter name="twice" type="double" value="2*height"'):
            self.assertIn(line, deck.text())
        path = self.write("copy.xml", deck.text())
        again = mudline.Deck.read(path)
        self.assertEqual(again.text(), deck.text())
        self.assertEqual((again["output/error estimate"], again["stages/consolidation/duration"]), (True, 3.0))
        del again["variables/twice"]
        self.assertNotIn("variables/twice", again)

    def test_comments_stay(self):
        text = "<ParameterList name='d'>\n  <!-- kept -->\n  <ParameterList name='mesh'/>\n</ParameterList>"
        self.assertIn("<!-- kept -->", mudline.Deck.read(self.write("d.xml", text)).text())

    def test_what_is_refused(self):
        deck = mudline.Deck.read(TERZAGHI)
        for path, value, message in (("mesh", 3, "a section; only parameters can be set"), ("mesh/type/x", 3, "'type' is a parameter"),
                                     ("mesh/x", None, "None is no value of a deck")):
            with self.assertRaisesRegex(mudline.MudlineError, message):
                deck[path] = value
        for name, text, message in (("a.xml", "no", "no XML"), ("b.xml", "<a/>", "no deck")):
            with self.assertRaisesRegex(mudline.MudlineError, message):
                mudline.Deck.read(self.write(name, text))
        with self.assertRaisesRegex(mudline.MudlineError, "nowhere.xml: cannot be read"):
            mudline.Deck.read("nowhere.xml")


class Units(MudlineCase):
    def test_a_history_in_readable_units(self):
        path = self.write("pile.csv", "time [s],body/pile/force y [N],body/pile/displacement y [m],n [-]\n"
                                      "0,0,0,1\n86400,-42100,0.004,nan\n259200,20000,0.005,3\n")
        history = mudline.History(path)
        for name, unit, last in (("time", "days", 3), ("body/pile/force y", "kN", 20), ("n", "-", 3),
                                 ("body/pile/displacement y", "mm", 5)):
            values, found = history.readable(name)
            self.assertEqual(found, unit)
            self.assertAlmostEqual(values[-1], last, places=12)
        table = os.path.join(self.folder, "table.csv")
        history.write(table)
        with open(table) as file:
            self.assertEqual(file.readline(), "time [days],body/pile/force y [kN],body/pile/displacement y [mm],n [-]\n")
            self.assertEqual([float(word) for word in file.readlines()[1].split(",")[:2]], [1, -42.1])


@mock.patch.dict(os.environ, {"MUDLINE_PROGRAM": PROGRAM, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"})
class Runs(MudlineCase):
    def run_deck(self, *decks, **more):
        return mudline.run(*decks, folder=os.path.join(self.folder, "results"), **more)

    def test_a_deck_of_a_file(self):
        result = self.run_deck(TERZAGHI, settings=SHORT, name="column")
        self.assertEqual(result.name, "column")
        time = result.history.time
        self.assertAlmostEqual(time[-1], 50, places=9)
        pressure = result.history["probe/base/pore pressure"]
        self.assertEqual(pressure.shape, time.shape)
        self.assertEqual(result.history.unit("probe/base/pore pressure"), "Pa")
        self.assertAlmostEqual(result.history.at("probe/base/pore pressure", 0.5 * (time[3] + time[4])), 0.5 * (pressure[3] + pressure[4]), places=6)
        self.assertEqual(result.results.stages, ["consolidation"])
        self.assertAlmostEqual(result.results.value("stage", "duration", "consolidation"), 50, places=9)
        self.assertIsNone(result.results.value("stage", "length", "consolidation"))
        field = result.fields.fields(-1)["pore pressure"]
        self.assertEqual((field.unit, len(field.values)), ("Pa", len(result.fields.coordinates(-1))))
        self.assertAlmostEqual(field.values.max(), pressure[-1], delta=0.1 * pressure[-1])
        with self.assertRaisesRegex(mudline.MudlineError, r"no column 'probe/base/pore presure' \(did you mean 'probe/base/pore pressure'\?\)"):
            result.history["probe/base/pore presure"]

    def test_a_deck_that_is_changed_and_one_that_is_made(self):
        deck = mudline.Deck.read(TERZAGHI)
        for path, value in SHORT.items():
            deck[path] = value
        by_hand = self.run_deck(TERZAGHI, settings=SHORT, name="one")
        changed = self.run_deck(deck, name="two")
        np.testing.assert_array_equal(changed.history["probe/base/pore pressure"], by_hand.history["probe/base/pore pressure"])
        self.assertEqual([name for name in os.listdir(os.path.dirname(TERZAGHI)) if name.startswith(".")], [])
        made = mudline.Deck.based_on("column", height="2 m", modulus=3e6)
        for load in ("10 kPa", "20 kPa"):  # the second replaces the results of the first
            made["variables/load"] = load
            result = self.run_deck(made, name="made")
            self.assertAlmostEqual(result.history["probe/base/pore pressure"].max() / (1e3 * float(load.split()[0])), 1, delta=0.02)
        overlay = mudline.Deck()
        overlay["stages/consolidation/duration"] = "1 h"
        self.assertAlmostEqual(self.run_deck(made, overlay, name="short").history.time[-1], 3600, places=6)

    def test_ranks(self):
        one, two = (self.run_deck(TERZAGHI, settings={**SHORT, "mesh/cells": [2, 8]}, name=f"on{n}", ranks=n) for n in (1, 2))
        np.testing.assert_allclose(two.history["probe/base/pore pressure"], one.history["probe/base/pore pressure"], rtol=1e-6)

    def test_errors_are_those_of_the_program(self):
        with self.assertRaisesRegex(mudline.MudlineError, r"did you mean 'duration'\?\) \(exit code 2\)"):
            self.run_deck(TERZAGHI, settings={"stages/consolidation/duratio": 3.0}, name="x")
        with self.assertRaisesRegex(mudline.MudlineError, "there is no such result"):
            mudline.Result(os.path.join(self.folder, "nothing"))

    def test_the_manual(self):
        """The examples of docs/python.md, one after the other."""
        with open(os.path.join(ROOT, "docs", "python.md")) as file:
            examples = re.findall(r"^```python\n(.*?)^```", file.read(), re.DOTALL | re.MULTILINE)
        self.assertEqual(len(examples), 3)
        code = "import os, sys; sys.path.insert(0, sys.argv[1]); os.chdir(sys.argv[2])\n" + "\n".join(examples)
        done = subprocess.run([sys.executable, "-c", code, HERE, self.folder], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("consolidation, ", done.stdout)

    def test_other_packages(self):
        """pandas and pyvista, where they are installed."""
        result = self.run_deck(TERZAGHI, settings=SHORT, name="column")
        try:
            frame = result.history.frame()
            self.assertEqual(frame["probe/base/pore pressure [Pa]"].iloc[-1], result.history["probe/base/pore pressure"][-1])
            self.assertEqual(set(result.results.frame()["stage"]), {"consolidation", ""})
        except ModuleNotFoundError as error:
            self.assertEqual(error.name, "pandas")
        try:
            grid = result.fields.grid(-1)
            self.assertEqual(grid.n_cells, 8)
            self.assertAlmostEqual(grid.point_data["pore pressure"].max(), result.fields.fields(-1)["pore pressure"].values.max())
            self.assertTrue(np.all(grid.compute_cell_sizes()["Area"] > 0))
        except ModuleNotFoundError as error:
            self.assertEqual(error.name, "pyvista")


if __name__ == "__main__":
    unittest.main()
