#!/usr/bin/python3
"""Writes a deck from a few numbers. The deck is based on one of the program's own, which `mudline template` prints.

mudline new                                        # what there is
mudline new pile --diameter "0.5 m" --depth "6 m"  # a deck, my_pile.xml; numbers that are not given have a default
mudline new pile                                   # on a terminal: asks for the numbers
mudline new pile --help                            # the numbers
"""

import argparse
import difflib
import os
import re
import subprocess
import sys
import tempfile
import textwrap
from pathlib import Path
from xml.etree import ElementTree
from xml.sax.saxutils import escape, quoteattr

sys.path.append(str(Path(__file__).resolve().parent.parent / "support"))
from standard_output import after_output  # noqa: E402

DECKS = Path(__file__).resolve().parent / "decks"
GIVEN, FOLLOW = "<!-- These are given. -->", re.compile(r"<!-- Th(ese|is) follow")
NUMBER = re.compile(r'<Parameter name="(\w+)" type="(\w+)" value="([^"]*)"/>\s*<!-- (.*) -->')


class NewError(Exception):
    """One line that says what is wrong."""


class Number:
    """A number, or a word, that a deck is made from."""

    def __init__(self, name, kind, value, meaning):
        self.name, self.kind, self.value, self.meaning = name, kind, value, meaning

    def check(self, value):
        """NewError for a number that is negative, or 0 where its meaning does not speak of that."""
        found = re.match(r"\s*[-+]?[0-9.]+([eE][-+]?[0-9]+)?", value)
        number = float(found[0]) if self.kind != "string" and found and found[0].strip(" +-.") else None
        may_be_zero = re.search(r"\b0\b", self.meaning)
        if re.match(r"\s*[-+]?[0-9]+,[0-9]", value):
            raise NewError(f"--{self.name}: {value}: decimals need a point")
        if number is not None and (number < 0 or (number == 0 and not may_be_zero)):
            raise NewError(f"--{self.name}: {value} is not {'0 or more' if may_be_zero else 'above 0'}")

    @property
    def has_unit(self):
        return self.kind != "string" and re.search(r"[0-9.] *[A-Za-z%]", self.value)

    def line(self, value):
        return f'    <Parameter name="{self.name}" type="{self.kind}" value={quoteattr(value)}/>'


class Base:
    """One of the program's own decks that asks for numbers."""

    def __init__(self, path):
        self.name = path.stem
        text = path.read_text(encoding="utf-8")
        self.about = " ".join(text[text.index("<!--") + 4:text.index("-->")].split())
        given = text.partition(GIVEN)[2]
        end = FOLLOW.search(given)
        branches = ElementTree.fromstring(text).iterfind("*[@name='branches']/*")
        self.branches = [branch.get("name") for branch in branches]
        self.numbers = [Number(*found.groups()) for found in NUMBER.finditer(given[:end.start()] if end else given)]

    @property
    def first_sentence(self):
        return self.about.partition(". ")[0].rstrip(".")


def bases():
    return [base for base in (Base(path) for path in sorted(DECKS.glob("*.xml"))) if base.numbers]


def overview():
    return "\n".join(f"  {base.name:8}  " + textwrap.fill(base.first_sentence, 96, subsequent_indent=" " * 12) for base in bases())


def find(name):
    for base in bases():
        if base.name == name:
            return base
    names = [base.name for base in bases()]
    near = difflib.get_close_matches(name, names, 1)
    raise NewError(f"there is no '{name}'" + (f" (did you mean '{near[0]}'?)" if near else "; there are: " + ", ".join(names)))


def ask(base):
    """The answers on a terminal; an empty one takes the default."""
    print(f"{base.about}\n\nNumbers are in SI units, or with a unit: 35.7 mm, 2 kPa, 1 day. Enter keeps what is in brackets.", file=sys.stderr)
    answers = {}
    for number in base.numbers:
        print(f"  {number.name}: {number.meaning} [{number.value}] ", end="", file=sys.stderr, flush=True)
        answer = sys.stdin.readline()
        if not answer:
            raise NewError("the answers ended before the last number")
        if answer.strip():
            answers[number.name] = answer.strip()
    return answers


def deck(base, values, title):
    """Text of a deck on `base`, with all of its numbers."""
    lines = [number.line(values.get(number.name, number.value)) for number in base.numbers]
    width = max(len(line) for line in lines)
    about = (f"<!-- {base.first_sentence}. This deck gives the numbers; `mudline template {base.name}` prints the deck that it is based "
             "on. Any entry of that may be replaced here, in the section in which it stands there. -->")
    return "\n".join([
        textwrap.fill(about, 112, subsequent_indent=" " * 5, break_on_hyphens=False),
        f"<ParameterList name={quoteattr(title)}>",
        f'  <Parameter name="based on" type="string" value="{base.name}"/>',
        '  <ParameterList name="variables">',
        *(f"{line:{width}}  <!-- {escape(number.meaning)} -->" for line, number in zip(lines, base.numbers)),
        "  </ParameterList>",
        "</ParameterList>", ""])


def check(text, path):
    """What `mudline check` says about the deck, and its error, "" where it finds none."""
    with tempfile.TemporaryDirectory(dir=path.parent) as folder:
        file = Path(folder) / path.name
        file.write_text(text, encoding="utf-8")
        done = subprocess.run([os.environ.get("MUDLINE_PROGRAM", "mudline"), "check", file], capture_output=True, text=True)
    said = (done.stdout + done.stderr).replace(str(file), str(path))
    errors = [line[len("error: "):] for line in said.splitlines() if line.startswith("error: ")]
    return said, "" if done.returncode == 0 else errors[0] if errors else f"the deck cannot be checked:\n{said}"


def told_by_option(error, base, values, title, path):
    """The error of a deck as one of the option from which it comes: of the number that it names, or else of the first
    one whose default would mend it."""
    named = re.match(rf"{re.escape(str(path))}:\d+: variables/(\w+): ", error)
    if named and named[1] in (number.name for number in base.numbers):
        return f"--{named[1]}: {error[named.end():]}"
    error = re.sub(r"^.*?:\d+: ", "", error)  # a line of the program's own deck
    for name, value in values.items():
        others = {other: given for other, given in values.items() if other != name}
        if not check(deck(base, others, title), path)[1]:
            return f"--{name}: {value} makes no model: {error}"
    return f"these numbers together make no model: {error}"


def options_of(base, words):
    parser = argparse.ArgumentParser(prog=f"mudline new {base.name}", description=base.about, allow_abbrev=False,
                                     formatter_class=lambda prog: argparse.HelpFormatter(prog, max_help_position=34, width=110))
    for number in base.numbers:
        parser.add_argument("--" + number.name, metavar="X", help=f"{number.meaning} [{number.value}]".replace("%", "%%"))
    parser.add_argument("-o", "--output", default=f"my_{base.name.replace('-', '_')}.xml", help="the deck's file [%(default)s]")
    parser.add_argument("--overwrite", action="store_true", help="replace a file that is there")

    def fail(message):
        unknown = re.match(r"unrecognized arguments: --(\w+)", message)
        near = unknown and difflib.get_close_matches(unknown[1], [number.name for number in base.numbers], 1)
        if near:
            raise NewError(f"{message} (did you mean '--{near[0]}'?)")
        if unknown or "unrecognized" not in message:
            raise NewError(f"{message} (see mudline new {base.name} --help)")
        first = base.numbers[0]
        raise NewError(f"{message}; numbers have names, and those with a unit quotation marks: "
                       f'--{first.name} "{first.value}"')

    parser.error = fail
    return parser.parse_args(words)


def main():
    words = sys.argv[1:]
    if not words or words[0] in ("-h", "--help"):
        print(f"{__doc__.strip()}\n\n{overview()}")
        return 0
    try:
        base = find(words[0])
        options = options_of(base, words[1:])
        path = Path(options.output)
        if path.exists() and not options.overwrite:
            raise NewError(f"{path} is there already; give another --output, or --overwrite")
        if not path.parent.is_dir():
            raise NewError(f"{path}: there is no folder '{path.parent}'")
        values = {number.name: getattr(options, number.name) for number in base.numbers if getattr(options, number.name) is not None}
        if not values and sys.stdin.isatty():
            values = ask(base)
        for number in base.numbers:
            number.check(values.get(number.name, number.value))
        title = path.stem.replace("_", " ")
        text = deck(base, values, title)
        said, error = check(text, path)
        if error:
            raise NewError(told_by_option(error, base, values, title, path))
        print(said, end="")
        plain = [f"--{number.name} {values[number.name]}" for number in base.numbers
                 if number.has_unit and re.fullmatch(r"[-+0-9.eE ]+", values.get(number.name, ""))]
        if plain:
            print("without a unit, so in SI units: " + ", ".join(plain))
        path.write_text(text, encoding="utf-8")
        results = [path.stem, *(f"{path.stem}_{branch.replace(' ', '_')}" for branch in base.branches)]
        print(f"\n{path} is written. Next:\n  mudline run {path}\n  mudline report " +
              " ".join(f"results/{result}" for result in results))
        return 0
    except NewError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(after_output(main))
