"""One-character mutations of names and words, over all valid decks of inputs/ (without those of its plugins, which must be built first).

A letter is replaced, inserted, left out or swapped with its neighbour in the name of a parameter or section, or in a word
that means something to the program (a type, a choice, a set, a body, a function, ...). Names that the author chooses freely
stay as they are: there a mutation is another name, no mistake. So do mutations that give another known word.
"""
import pathlib
import random
import re
import shutil
import string
from collections import Counter

import fault

TITLE = "a letter wrong in a deck"
FULL, SAMPLE = 2000, 200

ROOT = pathlib.Path(__file__).resolve().parents[2]
AT_ONCE = 100  # decks per start of the program
# what stands in these is named by the author
COLLECTIONS = {"materials", "physics", "bodies", "boundary conditions", "contacts", "stages", "functions",
               "output/probes", "output/observers", "tests"}
FREE_WORDS = {"output/name", "output/folder"}
TAG = re.compile(r'<(?P<end>/?)(?P<kind>ParameterList|Parameter)\b(?P<rest>[^>]*?)(?P<closed>/?)>')
NAME = re.compile(r'\bname="([^"]*)"')
VALUE = re.compile(r'\btype="(?:string|Array\(string\))"\s+value="([^"]*)"')
WORD = re.compile(r"[A-Za-z][A-Za-z' -]+[A-Za-z]")
FORMULA = re.compile(r"[*+/^()0-9]")


def without_comments(text):
    """The same text with blanks for comments, so that positions stay."""
    return re.sub(r"<!--.*?-->", lambda comment: re.sub(r"[^\n]", " ", comment.group()), text, flags=re.S)


def targets(text):
    """[(begin, end)] of the names and words whose letters mean something."""
    found, path = [], []
    for tag in TAG.finditer(without_comments(text)):
        if tag["end"]:
            path.pop()
            continue
        name = NAME.search(tag["rest"])
        parent, start = "/".join(path[1:]), tag.start("rest")
        own = "/".join([*path[1:], name.group(1)]) if path else ""
        if path and parent not in COLLECTIONS and re.search("[A-Za-z]{3}", name.group(1)):
            found.append((start + name.start(1), start + name.end(1)))
        value = VALUE.search(tag["rest"])
        if value and own not in FREE_WORDS and not FORMULA.search(value.group(1)):
            found += [(start + value.start(1) + word.start(), start + value.start(1) + word.end())
                      for word in WORD.finditer(value.group(1))]
        if tag["kind"] == "ParameterList" and not tag["closed"]:
            path.append(name.group(1) if name else "")
    return found


def mutated(word, rng):
    """The word with one letter wrong."""
    at = rng.choice([i for i, letter in enumerate(word) if letter.isalpha()])
    letter = rng.choice(string.ascii_lowercase)
    kind = rng.choice(["replace", "insert", "leave out", "swap"])
    if kind == "swap" and at + 1 < len(word):
        return word[:at] + word[at + 1] + word[at] + word[at + 2:]
    if kind == "insert":
        return word[:at] + letter + word[at:]
    return word[:at] + (letter if kind == "replace" else "") + word[at + 1:]


def known_words(folder):
    """Every name and choice of the reference: a mutation into one of them is another deck, not a misspelt one."""
    reference = fault.start(["list", "--markdown"], folder).stdout
    return {word.replace("\\", "").strip() for cell in re.split(r" \| |[|\n]", reference) for word in [cell, *cell.split(", ")]}


def check_each(paths, folder):
    """The line that the program says of each deck; None of one that ended the program."""
    said, rest = [], list(paths)
    while rest:
        ended = fault.start(["check", "--each", *rest[:AT_ONCE]], folder, limit=30 * AT_ONCE)
        lines = ended.stdout.splitlines()[:len(rest[:AT_ONCE])]
        said += lines
        rest = rest[len(lines):]
        if rest and len(lines) < AT_ONCE:
            said.append(None)
            rest = rest[1:]
    return said


def run(count, seed, folder):
    rng = random.Random(seed)
    shutil.copytree(ROOT / "inputs", folder / "inputs", ignore=shutil.ignore_patterns("plugins"))
    decks = sorted(path.relative_to(folder) for path in (folder / "inputs").rglob("*.xml"))
    decks = [deck for deck, line in zip(decks, check_each(decks, folder)) if line and line.endswith(": the deck is valid")]
    known = known_words(folder)
    cases = []
    while len(cases) < count:
        deck = rng.choice(decks)
        text = (folder / deck).read_text()
        begin, end = rng.choice(targets(text))
        word, wrong = text[begin:end], mutated(text[begin:end], rng)
        if wrong == word or wrong.strip() != wrong or wrong in known or f'"{wrong}"' in text:
            continue
        path = deck.with_name(f"mutation_{len(cases)}.xml")
        (folder / path).write_text(text[:begin] + wrong + text[end:])
        cases.append((path, text.count("\n", 0, begin) + 1, word, wrong))
    rates.clear()
    for (path, line, word, wrong), said in zip(cases, check_each([case[0] for case in cases], folder)):
        yield judge(path, line, word, wrong, said)


rates = Counter()


def judge(path, line, word, wrong, said):
    what = f"{path}:{line}: '{word}' as '{wrong}'"
    if said is None:
        return fault.Outcome(what, "crash")
    rates["all"] += 1
    if not said.startswith("error: "):
        rates["silent"] += 1
        return fault.Outcome(what, "other numbers", said)
    rates["named"] += said.startswith(f"error: {path}:{line}: ")
    rates["suggested"] += f"did you mean '{word}'" in said
    return fault.Outcome(what, "said", said)


def remarks():
    """What the table does not show; after run()."""
    share = {name: 100 * rates[name] / max(1, rates["all"]) for name in ("named", "suggested", "silent")}
    return [f"of {rates['all']} mutations {share['named']:.1f} % are named at their own line, the right word is suggested for "
            f"{share['suggested']:.1f} %, {share['silent']:.1f} % are accepted in silence"]
