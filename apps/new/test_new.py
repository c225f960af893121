"""`mudline new`: what it asks for, the decks that it writes, and what it refuses."""
import csv
import os
import pty
import subprocess
import sys
import unittest

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tests", "support"))
from mudline_case import PROGRAM, MudlineCase  # noqa: E402
from mudline_new import bases  # noqa: E402

KINDS = ["anchor", "column", "cpt", "footing", "pile", "plate", "t-bar"]


class New(MudlineCase):
    def new(self, *words, **more):
        return subprocess.run([PROGRAM, "new", *words], capture_output=True, text=True, cwd=self.folder, **more)

    def written(self, *words):
        done = self.new(*words)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(os.path.join(self.folder, f"my_{words[0].replace('-', '_')}.xml")) as file:
            return done.stdout, file.read()

    def refused(self, message, *words):
        done = self.new(*words)
        self.assertEqual((done.returncode, done.stderr), (2, f"error: {message}\n"))
        self.assertEqual(os.listdir(self.folder), [])

    def test_there_is_one_of_each_kind(self):
        self.assertEqual([base.name for base in bases()], KINDS)
        overview = self.new().stdout
        for base in bases():
            self.assertTrue(5 <= len(base.numbers) <= 12, base.name)
            self.assertIn(f"\n  {base.name} ", overview)

    def test_every_deck_is_short_and_valid(self):
        for kind in KINDS:
            with self.subTest(kind):
                said, text = self.written(kind)
                self.assertIn("the deck is valid", said)
                self.assertNotIn("warning", said)
                self.assertLess(text.count("\n"), 60)

    def test_the_numbers_reach_the_model(self):
        """The strength that the program tells is the one that was asked for, below and above the ratio at which the clay is
        overconsolidated."""
        for growth, overconsolidation in (("1.3 kPa/m", "OCR 1,"), ("3 kPa/m", "OCR 2.2")):
            said, text = self.written("pile", "--diameter", "0.5 m", "--su_top", "4 kPa", "--su_growth", growth, "--overwrite")
            self.assertIn('name="diameter" type="double" value="0.5 m"', text)
            self.assertIn("body 'pile': 0.5 m wide", said)
            self.assertIn("\n  mudline report results/my_pile results/my_pile_longer_rest\n", said)
            clay = next(line for line in said.splitlines() if "material 'clay'" in line)
            lowest, highest = (float(word) for word in clay.partition("s_u ")[2].partition(" kPa")[0].split(" to "))
            depth = 2 + 8 * 0.5
            self.assertAlmostEqual(lowest / 4, 1, delta=0.01)
            self.assertAlmostEqual(highest / (4 + float(growth.split()[0]) * depth), 1, delta=0.01)
            self.assertIn(overconsolidation, clay)

    def test_the_soil_can_be_remeshed(self):
        """A doubt of long sides or thick elements at the wall asks for this."""
        for kind in ("anchor", "cpt", "pile"):
            with self.subTest(kind):
                self.written(kind)
                done = subprocess.run([PROGRAM, "check", f"my_{kind}.xml", "--set", "mesh motion/remeshing/wall size=2 cm"],
                                      capture_output=True, text=True, cwd=self.folder)
                self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)

    def test_a_stiffer_clay_has_the_strength_that_was_asked_for(self):
        self.written("cpt", "--depth", "10 m", "--su_top", "2 kPa", "--su_growth", "2 kPa/m")
        told = []
        for swelling in ("0.04", "0.02"):
            said = subprocess.run([PROGRAM, "check", "my_cpt.xml", "--set", f"variables/swelling_slope={swelling}"],
                                  capture_output=True, text=True, cwd=self.folder).stdout
            clay = next(line for line in said.splitlines() if "material 'clay'" in line)
            told.append([float(clay.partition(f"{name} ")[2].split()[0]) for name in ("s_u", "G")])
        for strength, _ in told:
            self.assertAlmostEqual(strength / 22, 1, delta=0.01)
        self.assertAlmostEqual(told[1][1] / told[0][1], 2, delta=0.01)

    def test_a_column_consolidates_as_theory_says(self):
        """Its base has a tenth of the pressure left at T = 1.031."""
        self.written("column", "--height", "2 m", "--modulus", "3 MPa", "--conductivity", "2e-9 m/s")
        run = subprocess.run([PROGRAM, "run", "-q", "my_column.xml"], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(run.returncode, 0, run.stderr)
        with open(os.path.join(self.folder, "results", "my_column.results.csv"), newline="") as file:
            found = {row["quantity"]: float(row["value"]) for row in csv.DictReader(file) if row["of"] == "soil"}
        self.assertAlmostEqual(found["excess pore pressure nine tenths dissipated after"] / (1.031 * 2**2 / (2e-9 * 3e6 / 9810)), 1, delta=0.01)

    def test_asks_on_a_terminal(self):
        terminal, other_end = pty.openpty()
        with subprocess.Popen([PROGRAM, "new", "column"], stdin=other_end, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              cwd=self.folder) as asked:
            os.close(other_end)
            os.write(terminal, b"2 m\n\n3 MPa\n" + 4 * b"\n")
            said, questions = asked.communicate(timeout=60)
        os.close(terminal)
        self.assertEqual(asked.returncode, 0, questions)
        self.assertIn("  load: on its surface [10 kPa] ", questions)
        self.assertIn("the deck is valid", said)
        with open(os.path.join(self.folder, "my_column.xml")) as file:
            text = file.read()
        for name, value in (("height", "2 m"), ("load", "10 kPa"), ("modulus", "3 MPa"), ("share", "90 %")):
            self.assertIn(f'name="{name}" type="double" value="{value}"', text)

    def test_a_size_in_the_wrong_unit_is_doubted(self):
        """A pile of 50 m instead of 50 cm: one line with numbers; and what has no unit is said to count in SI units."""
        said, _ = self.written("pile", "--diameter", "50", "--su_top", "4 kPa")
        self.assertIn("\nwarning: body 'pile': its width is 50 m, usual is 50 mm to 12 m (plausibility/body width): give "
                      'lengths in m, or with a unit, as "50 cm"\n', said)
        self.assertIn("\nwithout a unit, so in SI units: --diameter 50\n", said)
        said, _ = self.written("pile", "--diameter", "50 cm", "--overwrite")
        self.assertNotIn("warning", said)
        self.assertNotIn("without a unit", said)

    def test_refused(self):
        self.refused("there is no 'pil' (did you mean 'pile'?)", "pil")
        self.refused("there is no 'x'; there are: " + ", ".join(KINDS), "x")
        self.refused("unrecognized arguments: --diamter 3 (did you mean '--diameter'?)", "pile", "--diamter", "3")
        self.refused("--diameter: 0,5: decimals need a point", "pile", "--diameter", "0,5")
        self.refused("unrecognized arguments: 0.5 6; numbers have names, and those with a unit quotation marks: "
                     '--diameter "0.4 m"', "pile", "0.5", "6")
        self.refused("unrecognized arguments: km; numbers have names, and those with a unit quotation marks: "
                     '--diameter "0.9 m"', "anchor", "--drop", "600", "km")
        self.refused("--diameter: -1 m is not above 0", "pile", "--diameter=-1 m")
        self.refused("--su_growth: 0 is not above 0", "pile", "--su_growth", "0")
        self.refused("--diameter: given '4 kg', which measures something else than '0.4 m', the value that it "
                     "replaces", "pile", "--diameter", "4 kg")
        self.refused("--unit_weight: 30 kN/m3 makes no model: materials/clay/void ratio: -0.44410000000000005 is out of "
                     "range; allowed: [0, inf)", "pile", "--diameter", "0.5 m", "--unit_weight", "30 kN/m3")
        self.refused("other/pile.xml: there is no folder 'other'", "pile", "-o", "other/pile.xml")
        _, before = self.written("column")
        done = self.new("column", "--height", "3 m")
        self.assertEqual((done.returncode, done.stderr), (2, "error: my_column.xml is there already; give another --output, or --overwrite\n"))
        with open(os.path.join(self.folder, "my_column.xml")) as file:
            self.assertEqual(file.read(), before)


class Based(MudlineCase):
    """A deck that is based on one of the program's own."""

    def test_replaces_any_entry(self):
        deck = self.write("own.xml", """<ParameterList name="own">
  <Parameter name="based on" type="string" value="column"/>
  <ParameterList name="mesh">
    <Parameter name="cells" type="Array(int)" value="{1, 7}"/>
  </ParameterList>
</ParameterList>""")
        check = subprocess.run([PROGRAM, "check", deck], capture_output=True, text=True)
        self.assertEqual(check.returncode, 0, check.stderr)
        self.assertIn("7 elements, ", check.stderr + check.stdout)

    def test_unknown(self):
        deck = self.write("own.xml", """<ParameterList name="own">
  <Parameter name="based on" type="string" value="colum"/>
</ParameterList>""")
        done = subprocess.run([PROGRAM, "check", deck], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (2, f"error: {deck}:2: based on: the program has no deck 'colum' (did you mean "
                                                             "'column'?)\n"))

    def test_is_printed(self):
        printed = subprocess.run([PROGRAM, "template", "clay"], capture_output=True, text=True).stdout
        self.assertIn('<ParameterList name="clay">', printed)
        self.assertIn('value="modified cam clay"', printed)


if __name__ == "__main__":
    unittest.main()
