"""Checkpoints with a bit flipped, or cut short."""

import os
import random

from fault import Outcome, judge, start
from mudline_case import ROOT

TITLE = "one flipped bit in a checkpoint (every tenth: cut short at a random byte), then `--restart`"
FULL = 120
SAMPLE = 12

DECK = os.path.join(ROOT, "tests", "mpi", "ball_in_clay.xml")


def run(count, seed, folder):
    generator = random.Random(seed)
    arguments = ["run", "-q", DECK, "--set", "mesh/cells={3, 3}", "--set", "output/name=run"]
    begun = start([*arguments, "--steps", "3"], folder)
    assert begun.code == 0, begun.stderr
    checkpoint, history = folder / "results" / "run.restart", folder / "results" / "run.csv"
    good, rows = checkpoint.read_bytes(), history.read_bytes()
    for k in range(count):
        if k % 10 == 9:
            length = generator.randrange(len(good))
            bad, fault = good[:length], f"cut to {length} of {len(good)} bytes"
        else:
            byte, bit = generator.randrange(len(good)), generator.randrange(8)
            bad = bytearray(good)
            bad[byte] ^= 1 << bit
            fault = f"bit {bit} of byte {byte}"
        checkpoint.write_bytes(bad)
        outcome = judge(fault, start([*arguments, "--restart"], folder, 1 if k % 20 else 2))
        if outcome.verdict == "said" and history.read_bytes() != rows:
            outcome = Outcome(fault, "other numbers", "refused, but the history was changed")
        yield outcome
        history.write_bytes(rows)
