"""Many decks in one start of the program: what `mudline check --each` says of each."""

import re
from dataclasses import dataclass, field

from fault import start
from mudline_case import deck_text

AT_ONCE = 100


@dataclass
class Answer:
    """Why a deck is refused, "" where it is valid, and what is doubted of it."""

    refused: str = ""
    doubts: list = field(default_factory=list)


def checked(decks, folder):
    """Answers of decks (nested dictionaries), in their order."""
    result = []
    for first in range(0, len(decks), AT_ONCE):
        names = []
        for k, deck in enumerate(decks[first:first + AT_ONCE]):
            names.append(f"deck_{k}.xml")
            (folder / names[-1]).write_text(deck_text(f"deck_{k}", deck), encoding="utf-8")
        ended = start(["check", "--each", *names], folder, limit=600)
        answers = ended.stdout.splitlines()
        if ended.timed_out or len(answers) != len(names):
            raise RuntimeError(f"{len(answers)} answers for {len(names)} decks: {ended.stderr[-300:]}")
        doubts = {}
        for line in ended.stderr.splitlines():
            doubt = re.fullmatch(r"warning: (deck_\d+\.xml): (.*)", line)
            if doubt:
                doubts.setdefault(doubt[1], []).append(doubt[2])
        for name, answer in zip(names, answers):
            valid = answer == f"{name}: the deck is valid"
            result.append(Answer("" if valid else answer, doubts.get(name, [])))
    return result
