"""The sweep: formulas, wrong sweep decks, and a sweep of a small deck."""
import contextlib
import csv
import io
import math
import os
import sys
import tempfile
import unittest
from pathlib import Path

import mudline_sweep
from sweep_deck import Formula, SweepDeck, SweepError

PROGRAM = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 else ""
TERZAGHI = Path(__file__).resolve().parents[2] / "inputs" / "consolidation" / "terzaghi.xml"

SWEEP = """<ParameterList name="loads">
  <Parameter name="deck" type="string" value="{deck}"/>
  <ParameterList name="variables">
    <Parameter name="load" type="Array(double)" value="{{5e3, 10e3, 20e3}}"/>
  </ParameterList>
  <ParameterList name="settings">
    <Parameter name="boundary conditions/load/y" type="string" value="{load}"/>
    <Parameter name="stages/consolidation/duration" type="string" value="2 * 0.5"/>
  </ParameterList>
  <ParameterList name="results">
    <Parameter name="load [kPa]" type="string" value="load / 1e3"/>
    <Parameter name="pressure [-]" type="string" value="{result}"/>
  </ParameterList>
  <Parameter name="abscissa" type="string" value="{abscissa}"/>
</ParameterList>
"""


class Formulas(unittest.TestCase):
    def test_arithmetic_and_columns(self):
        columns = {"a/force y": [1.0, -4.0, 3.0]}
        self.assertAlmostEqual(Formula("2 * v ** 2 / pi + abs(-1)", "here").value({"v": 3.0}), 18 / math.pi + 1, places=14)
        self.assertEqual(Formula("largest('a/force y') - smallest('a/force y') + last('a/force y')", "here").value({}, columns), 10.0)
        self.assertEqual(Formula("mean('a/force y') + first('a/force y')", "here").value({}, columns), 1.0)

    def test_at_a_time(self):
        columns = {"time": [0.0, 1.0, 3.0], "a": [5.0, 7.0, 3.0]}
        self.assertEqual(Formula("at('a', 2 * v)", "here").value({"v": 1.0}, columns), 5.0)
        for text, message in (("at('a')", "takes one column in quotes and a time"), ("at('a', 3.1)", "from 0 to 3 s; asked was 3.1 s")):
            with self.subTest(text), self.assertRaisesRegex(SweepError, message):
                Formula(text, "here").value({}, columns)

    def test_settings_are_numbers_or_arrays(self):
        self.assertEqual(Formula("2 * v", "here").setting({"v": 1.5}), "3")
        self.assertEqual(Formula("{0, -v, min(v, 1)}", "here").setting({"v": 1.5}), "{0, -1.5, 1}")
        with self.assertRaisesRegex(SweepError, "did you mean 'v'"):
            Formula("{0, -vv}", "here").setting({"v": 1.5})
        with self.assertRaisesRegex(SweepError, "not allowed"):
            Formula("{0, v}", "here").value({"v": 1.5})

    def test_what_is_refused(self):
        for text, message in (
            ("velocty", "did you mean 'velocity'"),
            ("lst('a')", "did you mean 'last'"),
            ("last('b/forc')", "did you mean 'b/force'"),
            ("__import__('os')", "unknown function"),
            ("velocity.real", "not allowed"),
            ("1 / (velocity - velocity)", "division by zero"),
            ("1 +", "no formula"),
        ):
            with self.subTest(text), self.assertRaisesRegex(SweepError, message):
                Formula(text, "here").value({"velocity": 1.0}, {"b/force": [1.0]})
        with self.assertRaisesRegex(SweepError, "needs a run's history"):
            Formula("last('a')", "here").value({})


class Sweeps(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, load="-load", result="largest('probe/base/pore pressure') / load", abscissa="load [kPa]", deck=TERZAGHI):
        path = Path(self.folder.name) / "loads.xml"
        path.write_text(SWEEP.format(deck=deck, load=load, result=result, abscissa=abscissa))
        return path

    def sweep(self, path, *options):
        out, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
            code = mudline_sweep.main([str(path), "--folder", str(Path(self.folder.name) / "results"), *options])
        return code, out.getvalue(), errors.getvalue()

    def test_wrong_decks_get_one_line(self):
        for settings, message in (
            ({"abscissa": "load [kP]"}, "did you mean 'load [kPa]'"),
            ({"load": "lod"}, "settings/boundary conditions/load/y: unknown variable 'lod' (did you mean 'load'?)"),
            ({"deck": "nowhere.xml"}, "there is no file"),
            ({"result": "lst('a') / load"}, "results/pressure [-]: unknown function 'lst' (did you mean 'last'?)"),
            ({"result": "1 / lod"}, "results/pressure [-]: unknown variable 'lod' (did you mean 'load'?)"),
        ):
            with self.subTest(message):
                code, _, error = self.sweep(self.write(**settings))
                self.assertEqual(code, 2)
                self.assertIn(message, error)
                self.assertEqual(error.count("\n"), 1)

    @unittest.skipUnless(PROGRAM, "no program given")
    def test_a_linear_answer_and_a_failing_run(self):
        os.environ["MUDLINE_PROGRAM"] = PROGRAM
        code, out, error = self.sweep(self.write(), "--jobs", "2")
        self.assertEqual(code, 0, out + error)
        with open(Path(self.folder.name) / "results" / "loads.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([float(row["load [kPa]"]) for row in rows], [5.0, 10.0, 20.0])
        for row in rows:  # undrained: the water takes the whole load
            self.assertAlmostEqual(float(row["pressure [-]"]), 1.0, delta=0.05)
        self.assertGreater((Path(self.folder.name) / "results" / "loads.png").stat().st_size, 10000)
        # a number of the run's results
        result = "result('consolidation', 'soil', 'highest excess pore pressure') / load"
        code, out, error = self.sweep(self.write(result=result), "--gather")
        self.assertEqual(code, 0, out + error)
        with open(Path(self.folder.name) / "results" / "loads.csv", newline="") as file:
            shares = [float(row["pressure [-]"]) for row in csv.DictReader(file)]
        # anywhere in the soil: it oscillates where the surface drains, but is linear in the load
        self.assertTrue(1 < shares[0] < 1.06, shares)
        self.assertLess(max(shares) - min(shares), 1e-3)
        for wrong, message in ((result.replace("highest", "higest"), "the run has no result 'consolidation / soil / higest excess pore pressure' "
                                "(did you mean 'consolidation / soil / highest excess pore pressure'?)"),
                               ("result('soil')", "'result' takes stage, what it is of, and quantity, in quotes")):
            code, _, error = self.sweep(self.write(result=wrong), "--gather")
            self.assertEqual(code, 2)
            self.assertIn(message, error)
        code, out, error = self.sweep(self.write(), "--set", "solver/newton/maximum iteration=1")
        self.assertEqual(code, 2)
        self.assertIn("3 of 3 runs failed", error)
        self.assertIn("did you mean", out)

    @unittest.skipUnless(PROGRAM, "no program given")
    def test_the_table_has_the_runs_that_did_not_fail(self):
        os.environ["MUDLINE_PROGRAM"] = PROGRAM
        path = self.write()
        path.write_text(path.read_text().replace("2 * 0.5", "(7e3 - load) / 2e3"))  # s; only the first one is positive
        for options, what in (((), "2 of 3 runs failed"), (("--gather",), "2 of 3 cases have no history")):
            code, _, error = self.sweep(path, *options)
            self.assertEqual(code, 2)
            self.assertIn(what, error)
            self.assertIn("the table has the others", error)
            with open(Path(self.folder.name) / "results" / "loads.csv", newline="") as file:
                self.assertEqual([float(row["load [kPa]"]) for row in csv.DictReader(file)], [5.0])

    def test_a_variable_of_nothing(self):
        path = self.write()
        spare = '<Parameter name="spare" type="Array(double)" value="{1, 2, 3}"/>'
        path.write_text(path.read_text().replace("</ParameterList>", spare + "</ParameterList>", 1))
        with self.assertRaisesRegex(SweepError, "variables/spare: no setting and no result names this variable"):
            SweepDeck(path).check()

    def test_variables_must_fit(self):
        path = self.write()
        path.write_text(path.read_text().replace("</ParameterList>", '<Parameter name="k" type="Array(double)" value="{1}"/></ParameterList>', 1))
        with self.assertRaisesRegex(SweepError, "same number of values"):
            SweepDeck(path)


if __name__ == "__main__":
    unittest.main()
