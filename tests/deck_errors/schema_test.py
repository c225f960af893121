"""The RELAX NG schema of `mudline list --rng`: every shipped deck is valid against it, and of random typos it refuses
what the program would refuse."""
import glob
import os
import random
import re
import subprocess
import tempfile
import unittest

from lxml import etree
from mudline_case import PROGRAM, ROOT

TYPOS = 500
SEED = 34
FREE = {"variables", "parameters", "probes", "branches"}  # sections whose entries have names of one's own


def said(*arguments):
    return subprocess.run([PROGRAM, "list", *arguments], capture_output=True, text=True, check=True).stdout


def decks():
    """Every deck of the inputs and of the program, not sweeps and not those that need a plugin."""
    found = []
    for path in sorted(glob.glob(os.path.join(ROOT, "inputs", "**", "*.xml"), recursive=True) +
                       glob.glob(os.path.join(ROOT, "apps", "new", "decks", "*.xml"))):
        with open(path, encoding="utf-8") as file:
            text = file.read()
        if '<ParameterList name="plugins">' not in text and 'name="deck"' not in text:
            found.append((path, text))
    return found


def misspelt(word, dice):
    """The word with one slip of the fingers; never the word itself."""
    while True:
        at = dice.randrange(len(word))
        slip = dice.choice(("lose", "double", "swap", "other"))
        found = {"lose": word[:at] + word[at + 1:], "double": word[:at] + word[at] + word[at:],
                 "swap": word[:at] + word[at:at + 2][::-1] + word[at + 2:],
                 "other": word[:at] + dice.choice("abcdefghijklmnopqrstuvwxyz") + word[at + 1:]}[slip]
        if found != word:
            return found


class Schema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        text = said("--rng")
        cls.schema = etree.RelaxNG(etree.fromstring(text.encode()))
        # all that is documented, wherever it may stand
        xsd = etree.fromstring(said("--xsd").encode())
        words = {}
        for kind in xsd.iter("{*}simpleType"):
            words[kind.get("name")] = {word.get("value") for word in kind.iter("{*}enumeration")}
        cls.sections, cls.parameters, cls.values = (words[name] for name in ("section_name", "parameter_name", "value"))

    def refused(self, tree):
        return not self.schema.validate(tree)

    def test_shipped_decks_are_valid(self):
        found = decks()
        self.assertGreater(len(found), 100)
        for path, text in found:
            tree = etree.fromstring(text.encode())
            valid = self.schema.validate(tree)
            self.assertTrue(valid, f"{os.path.relpath(path, ROOT)}: {self.schema.error_log}")

    def with_values(self, name, kinds, values):
        """(value, text) of inputs/consolidation/terzaghi.xml with each of the values at the parameter of this name."""
        with open(os.path.join(ROOT, "inputs", "consolidation", "terzaghi.xml"), encoding="utf-8") as file:
            text = file.read()
        pattern = re.compile(f'(name="{name}" type="(?:{kinds})" value=)"[^"]*"')
        for value in values:
            changed, count = pattern.subn(lambda match: f'{match[1]}"{value}"', text)
            self.assertEqual(count, 1, name)
            yield value, changed

    def checked(self, text):
        """What `mudline check` answers to a deck."""
        path = os.path.join(self.folder.name, "deck.xml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return subprocess.run([PROGRAM, "check", path], capture_output=True, text=True)

    def test_ranges(self):
        """A plain number outside of the declared range is refused, by schema and program alike. A value with a unit, an
        expression and a number at a closed end are not."""
        good = ("1e-9 m/s", "2*k", "k", "1e-7", "0.5", "(1e-7)", "1 m/day")
        for name, within, outside in (("hydraulic conductivity", good, ("-1e-6", "-1")),
                                      ("Poisson's ratio", ("0", "0.49", "0.3 + nu"), ("0.5", "2.5", "-1", "25")),
                                      ("porosity", ("0.4", "n", "40 %"), ("40", "-0.4", "1")),
                                      ("theta", ("0.5", "1", "1/2"), ("0.49", "1.5", "5")),
                                      ("start-up steps", ("0", "8"), ("-8",)),
                                      ("duration", ("1 day", "3600", "1e9"), ("-1", "0")),
                                      ("y", ("-10", "-10 kPa", "-q"), ())):
            for value, changed in self.with_values(name, "double|int", within + outside):
                with self.subTest(f"{name} {value}"):
                    self.assertEqual(self.refused(etree.fromstring(changed.encode())), value in outside)
                    if value in outside:
                        done = self.checked(changed)
                        self.assertEqual((done.returncode, "out of range" in done.stderr), (2, True))

    def test_units(self):
        """A number with one unit of another dimension is refused, by schema and program alike; the right ones are
        not."""
        for name, right, wrong in (("duration", ("1 day", "2h", "3600 s"), ("1 kPa", "5 m", "5 K")),
                                   ("y", ("-10 kPa", "-1 N/m2", "-2*q"), ("-10 kN", "-3 s")),
                                   ("porosity", ("40 %",), ("0.4 m", "40 kPa")),
                                   ("Young's modulus", ("10 MPa", "10MPa", "10 N/mm2"), ("10 MN", "10 mpa", "10 psi"))):
            for value, changed in self.with_values(name, "double", right + wrong):
                with self.subTest(f"{name} {value}"):
                    self.assertEqual(self.refused(etree.fromstring(changed.encode())), value in wrong)
                    if "q" not in value:
                        done = self.checked(changed)
                        self.assertEqual(done.returncode, 2 if value in wrong else 0, done.stderr)

    def typos_of(self, tree):
        """[(what, element, attribute)] of a deck: words that the program knows, types, and values that are words."""
        found = []
        for element in tree.iter("Parameter", "ParameterList"):
            above = {one.get("name") for one in element.iterancestors()}
            if above & FREE or element.getparent() is None:
                continue
            if element.tag == "ParameterList":
                if element.get("name") in self.sections | FREE:
                    found.append(("section name", element, "name"))
                continue
            if element.get("name") in self.parameters:
                found.append(("parameter name", element, "name"))
                if element.get("value") in self.values | {"true", "false"}:
                    found.append(("word", element, "value"))
                elif element.get("type") in ("double", "int") and re.fullmatch(r"[-+0-9.e]+", element.get("value")):
                    found.append(("number", element, "value"))
            found.append(("type", element, "type"))
        return found

    def test_typos(self):
        """At least 90 per cent of the typos are refused, by the schema alone."""
        dice = random.Random(SEED)
        small = [(path, text) for path, text in decks() if len(text) < 6000]
        count, missed = {}, []
        for k in range(TYPOS):
            path, text = small[k % len(small)]
            tree = etree.fromstring(text.encode())
            typos = self.typos_of(tree)
            if not typos:
                continue
            kind = dice.choice(sorted({what for what, _, _ in typos}))
            _, element, attribute = dice.choice([typo for typo in typos if typo[0] == kind])
            word = element.get(attribute)
            if kind == "number":  # a letter in place of a figure; another figure is another number
                at = dice.randrange(len(word))
                wrong = word[:at] + dice.choice("oOlIb,;") + word[at + 1:]
            else:
                wrong = misspelt(word, dice)
            element.set(attribute, wrong)
            seen, caught = count.get(kind, (0, 0))
            refused = self.refused(tree)
            count[kind] = seen + 1, caught + refused
            if not refused:
                missed.append(f"{os.path.relpath(path, ROOT)}: {kind} '{word}' as '{wrong}'")
        tried, caught = (sum(column) for column in zip(*count.values()))
        told = ", ".join(f"{kind} {caught} of {seen}" for kind, (seen, caught) in sorted(count.items()))
        print(f"refused {caught} of {tried} typos: {told}")
        self.assertGreater(tried, 0.95 * TYPOS)
        self.assertGreaterEqual(caught / tried, 0.9, told + "\n" + "\n".join(missed))
        if os.environ.get("MUDLINE_SHOW_ERRORS"):
            print("\n".join(missed))


if __name__ == "__main__":
    unittest.main()
