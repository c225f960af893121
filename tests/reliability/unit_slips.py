"""Every number of decks that are right, in another unit: a thousand times as large or as small (kPa for Pa, mm for m, g for kg).

No row has been looked at one by one: what share is doubted, refused or silent says how far the doubts reach where nobody aimed them.
Half of what is silent cannot be known: a layer may consolidate for a day or for three years.
"""

import collections
import copy
import os
import random
import sys

from fault import Outcome
from mudline_case import ROOT

sys.path.insert(0, os.path.join(ROOT, "tests", "plausibility"))
import bodies_test  # noqa: E402
import mistakes  # noqa: E402
from checked_decks import checked  # noqa: E402

TITLE = "every number of sound decks times or over 1000"
SAMPLE = 60
FACTORS = (1e3, 1e-3)


def bases():
    decks = {name: base(False) for name, base in mistakes.BASES.items()}
    return {**decks, **copy.deepcopy(bodies_test.BASES)}


def numbers(section, path=()):
    """Paths of the numbers other than zero that have a unit or could have one; whole numbers count something."""
    for key, value in section.items():
        if key == "plausibility":
            continue
        if isinstance(value, dict):
            yield from numbers(value, (*path, key))
        elif isinstance(value, float) and value != 0:
            yield (*path, key)
        elif isinstance(value, list) and any(isinstance(v, float) and v != 0 for v in value):
            yield (*path, key)


def slips():
    """(base, path, factor, deck)."""
    found = []
    for base, deck in bases().items():
        for path in numbers(deck):
            for factor in FACTORS:
                changed = copy.deepcopy(deck)
                inner = changed
                for key in path[:-1]:
                    inner = inner[key]
                value = inner[path[-1]]
                inner[path[-1]] = [factor * v for v in value] if isinstance(value, list) else factor * value
                found.append((base, "/".join(path), factor, changed))
    return found


FULL = len(slips())
_verdicts, _silent = collections.Counter(), collections.Counter()


def run(count, seed, folder):
    for name, text in mistakes.mesh_files().items():
        (folder / name).write_text(text)
    chosen = random.Random(seed).sample(slips(), count)
    for (base, path, factor, _), answer in zip(chosen, checked([slip[-1] for slip in chosen], folder)):
        verdict = "said" if answer.refused else "doubted" if answer.doubts else "silent"
        _verdicts[verdict] += 1
        if verdict == "silent":
            _silent[path.rpartition("/")[2]] += 1
        yield Outcome(f"{base}: {path} times {factor:g}", verdict, answer.refused or " | ".join(answer.doubts))


def remarks():
    count = sum(_verdicts.values())
    most = ", ".join(f"'{name}' {number}" for name, number in _silent.most_common(8))
    return [f"of {count} slips {_verdicts['doubted'] / count:.0%} are doubted, {_verdicts['said'] / count:.0%} refused, "
            f"{_verdicts['silent'] / count:.0%} silent, most of them of {most}"]
