"""Mistakes of practice: decks that are right with one entry as engineers get it wrong, from the tables of tests/plausibility."""

import os
import random
import sys

from fault import Outcome
from mudline_case import ROOT

sys.path.insert(0, os.path.join(ROOT, "tests", "plausibility"))
import bodies_test  # noqa: E402
import mistakes  # noqa: E402
from checked_decks import checked  # noqa: E402

TITLE = "mistakes of practice (soil, water, units, loads, steps, meshes in the plane and in space; bodies and contacts), each with its own doubt"
FULL = 2 * len(mistakes.MISTAKES) + len(bodies_test.MISTAKES)
SAMPLE = 40


def rows():
    """(what was done, deck, what must be told)."""
    found = []
    for space in (False, True):
        for base, changes, name in mistakes.MISTAKES:
            where = "in space" if space else "in the plane"
            found.append((f"{base}, {where}: {changes}", mistakes.changed(mistakes.BASES[base](space), changes, space), f"(plausibility/{name})"))
    for base, edits, name in bodies_test.MISTAKES:
        found.append((f"{base}: {edits}", bodies_test.edited(base, edits), f"(plausibility/{name})" if name else "moves away"))
    return found


def run(count, seed, folder):
    for name, text in mistakes.mesh_files().items():
        (folder / name).write_text(text)
    chosen = random.Random(seed).sample(rows(), count)
    for (what, _, told), answer in zip(chosen, checked([deck for _, deck, _ in chosen], folder)):
        if answer.refused:
            yield Outcome(what, "said", answer.refused)
        else:
            own = [line for line in answer.doubts if told in line]
            yield Outcome(what, "doubted" if own else "silent", " | ".join(own or answer.doubts))
