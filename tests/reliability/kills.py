"""Runs that are killed at a random moment and continued from their checkpoint."""

import os
import random
import shutil
import signal
import subprocess
import sys
import time

import cpu_limit
import h5py
import numpy as np
from fault import Outcome, arguments_of, launcher, program, start
from mudline_case import ROOT, deck_text

TITLE = "kill -9 at a random moment, then `--restart`; contact, friction, mesh motion, free bodies, remeshing; 1 and 2 ranks"
FULL = 100
SAMPLE = 4

sys.path.insert(0, os.path.join(ROOT, "tests", "verification", "contact"))
sys.path.insert(0, os.path.join(ROOT, "tests", "verification", "ale"))
from remeshed_ball import ADAPTIVE, ESTIMATE, FOCUS, WALL, ball, remeshing  # noqa: E402
from sliding_blocks import SLIDE  # noqa: E402

BALL = os.path.join(ROOT, "tests", "mpi", "ball_in_clay.xml")
ANCHOR = os.path.join(ROOT, "inputs", "impact", "fall_and_pull_out.xml")
BLOCKS = os.path.join(ROOT, "inputs", "contact", "blocks.xml")
OFTEN = ["output/checkpoint steps=2", "output/field steps=2"]
FRICTION = {"contacts": {"ball on clay": {"friction": {"type": "coulomb", "coefficient": 0.2}}}}
MOTION = {"mesh motion": {"boundary": {"focus": "ball", "size near focus": 0.05, "near distance": 0.1, "growth": 0.2}}}
PENALTY = "contacts/ball on clay/type=penalty"
# name: deck or what makes its text, overlay, settings
CASES = {
    "contact": (BALL, deck_text("over", {}), ["mesh/cells={5, 5}"]),
    "friction": (BALL, deck_text("over", FRICTION), ["mesh/cells={5, 5}", PENALTY]),
    "mesh motion": (BALL, deck_text("over", MOTION), []),
    "friction and mesh motion": (BALL, deck_text("over", {**FRICTION, **MOTION}), [PENALTY]),
    "free body": (ANCHOR, deck_text("over", {}), []),
    "two surfaces": (BLOCKS, SLIDE, []),
    "remeshing": (ball, remeshing(5, WALL, FOCUS), []),
    "remeshing, sizes from the error": (ball, remeshing(5, {**WALL, **ADAPTIVE}, FOCUS, ESTIMATE), []),
}


class Case:
    """A deck in a folder of its own, and what an undisturbed run of it leaves."""

    def __init__(self, name, ranks, folder):
        deck, overlay, settings = CASES[name]
        self.ranks = ranks
        self.folder = folder / f"{name} {ranks}".replace(" ", "_").replace(",", "")
        self.arguments = arguments_of(self.folder, deck, overlay, [*settings, *OFTEN, "output/name=run"])
        ended = start(self.arguments, self.folder, ranks)
        assert ended.code == 0, ended.stderr
        self.rows = self.lines()
        self.whole = self.results()
        shutil.rmtree(self.folder / "results")

    def lines(self):
        path = self.folder / "results" / "run.csv"
        return path.read_bytes().count(b"\n") if path.exists() else 0

    def results(self):
        """The history, and the displacements of all steps."""
        folder = self.folder / "results"
        with h5py.File(folder / "run.h5", "r") as file:
            fields = [step["nodal/displacement"][:] for step in file["steps"].values()]
        return (folder / "run.csv").read_bytes(), (folder / "run.xdmf").read_bytes(), fields

    def changed(self):
        history, index, fields = self.results()
        if history != self.whole[0]:
            return "another history"
        if index != self.whole[1] or len(fields) != len(self.whole[2]):
            return "other outputs"
        return "" if all(np.array_equal(a, b) for a, b in zip(fields, self.whole[2])) else "other displacements"

    def kill(self, generator):
        """Kills the run once it has written a random number of rows; says after how many."""
        moment = generator.randint(1, self.rows - 1)
        running = subprocess.Popen([*launcher(self.ranks), program(), *self.arguments], cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, start_new_session=True)
        while self.lines() < moment and running.poll() is None:
            time.sleep(0.002)
        time.sleep(generator.uniform(0, 0.05))
        # the ranks have sessions of their own under mpirun; which of all dies first is chance
        processes = list(cpu_limit.family(running.pid))
        generator.shuffle(processes)
        for process in processes:
            try:
                os.kill(process, signal.SIGKILL)
            except ProcessLookupError:
                pass
        running.wait()
        return self.lines()

    def attempt(self, name, generator):
        rows = self.kill(generator)
        fault = f"{name} on {self.ranks} rank(s), killed after {rows} of {self.rows} lines"
        saved = (self.folder / "results" / "run.restart").exists()
        ended = start([*self.arguments, "--restart"] if saved else self.arguments, self.folder, self.ranks)
        if ended.timed_out:
            outcome = Outcome(fault, "hang")
        elif ended.code < 0 or ended.code > 4:
            outcome = Outcome(fault, "crash", ended.stderr[-300:])
        elif ended.code != 0:
            outcome = Outcome(fault, "several lines", f"not continued: {ended.stderr[-300:]}")
        else:
            changed = self.changed()
            outcome = Outcome(fault, "other numbers" if changed else "survived", changed)
        shutil.rmtree(self.folder / "results")
        return outcome


def run(count, seed, folder):
    generator = random.Random(seed)
    cases = {}
    wanted = [(name, ranks) for ranks in (1, 2) for name in CASES]
    if count < len(wanted):  # a sample has a case or two of each kind
        wanted = [("friction and mesh motion", 1), ("contact", 2), ("remeshing, sizes from the error", 1), ("remeshing", 2)]
    for k in range(count):
        key = wanted[k % len(wanted)]
        if key not in cases:
            cases[key] = Case(*key, folder)
        yield cases[key].attempt(key[0], generator)
        print(f"\r{k + 1} of {count}", end="", file=sys.stderr)
