"""Signals while Gmsh remeshes the region, to the run, to Gmsh's process and to both; and that process killed."""

import os
import random
import shutil
import signal
import sys
import time

from disks_and_signals import begin, end
from fault import Outcome, arguments_of, start
from meshing_child import caught, children
from mudline_case import ROOT, deck_text

TITLE = "signals in a remeshing, to the run, to Gmsh's process or both, then `--restart`; that process killed; in the plane and in space"
FULL = 28
SAMPLE = 6

sys.path.insert(0, os.path.join(ROOT, "tests", "verification", "ale"))
from remeshed_ball import FOCUS, WALL, ball, remeshing  # noqa: E402

ALWAYS = {"when quality below": 0.0, "when side above": 0.1, "least steps": 2, "wall size": 0.25}
SPACE = os.path.join(ROOT, "inputs", "space", "ball.xml")
# name: text of the deck or its file, overlay, settings
DECKS = {
    "plane": (ball, remeshing(4, WALL, FOCUS), ["stages/push/duration=2.5e-3"]),
    "space": (SPACE, deck_text("over", {"mesh motion": {"remeshing": ALWAYS}}),
              ["mesh/cells={5, 3, 3}", "mesh/distortion=0.3", "stages/push/duration=0.2"]),
}


class Case:
    """A deck in a folder of its own, and the history of its undisturbed run."""

    def __init__(self, name, folder):
        deck, overlay, settings = DECKS[name]
        self.name = name
        self.folder = folder / name
        self.arguments = arguments_of(self.folder, deck, overlay, [*settings, "output/checkpoint steps=0", "output/name=run"])
        ended = start(self.arguments, self.folder)
        assert ended.code == 0, ended.stderr
        self.whole = self.history()

    def history(self):
        return (self.folder / "results" / "run.csv").read_bytes()

    def begin(self):
        """The run, and its children before the first remeshing."""
        shutil.rmtree(self.folder / "results")
        running = begin(self.arguments, self.folder, 1)
        while not (self.folder / "results" / "run.csv").exists() and running.poll() is None:
            time.sleep(0.001)
        return running, children(running.pid)

    def continued(self, fault):
        """The verdict on a restart."""
        again = start([*self.arguments, "--restart"], self.folder)
        if again.code != 0:
            return Outcome(fault, "several lines", f"not continued: {again.stderr[-300:]}")
        return Outcome(fault, "survived") if self.history() == self.whole else Outcome(fault, "other numbers", "after the restart")


def nth(running, of_mpi, count):
    """Gmsh's process in the remeshing of this number, as it stands still; None where there are fewer."""
    for _ in range(count - 1):
        child = caught(running, of_mpi)
        if child is None:
            return None
        of_mpi.append(child)
        os.kill(child, signal.SIGCONT)
    return caught(running, of_mpi)


def begin_and_catch(case, count, attempts=20):
    """A run, and Gmsh's process in its remeshing of this number. On a busy machine one may be over before it is seen."""
    for _ in range(attempts):
        running, of_mpi = case.begin()
        child = nth(running, of_mpi, count)
        if child is not None:
            return running, child
        end(running)
    raise RuntimeError(f"remeshing {count} of the deck in {case.name} was never seen")


def interrupted(case, number, to, count):
    fault = f"{signal.Signals(number).name} to {to} in remeshing {count}, {case.name}"
    running, child = begin_and_catch(case, count)
    for process in {"the run": [running.pid], "Gmsh": [child], "both": [running.pid, child]}[to]:
        os.kill(process, number)
    os.kill(child, signal.SIGCONT)
    ended = end(running)
    if to == "Gmsh":  # it ignores what asks it to end
        if ended.code != 0 or ended.stderr:
            return Outcome(fault, "crash", f"exit code {ended.code}: {ended.stderr[-300:]}")
        return Outcome(fault, "unchanged") if case.history() == case.whole else Outcome(fault, "other numbers")
    if ended.code != 4 or "stopped by a signal" not in ended.stderr or len(ended.stderr.splitlines()) != 1:
        return Outcome(fault, "crash", f"exit code {ended.code}: {ended.stderr[-300:]}")
    return case.continued(fault)


def killed_once(case, count):
    fault = f"SIGKILL to Gmsh in remeshing {count}, {case.name}"
    running, child = begin_and_catch(case, count)
    os.kill(child, signal.SIGKILL)
    ended = end(running)
    if ended.code != 0 or ended.stderr:
        return Outcome(fault, "crash", f"exit code {ended.code}: {ended.stderr[-300:]}")
    return Outcome(fault, "unchanged") if case.history() == case.whole else Outcome(fault, "other numbers")


def killed_always(case):
    fault = f"SIGKILL to Gmsh as often as it begins, {case.name}"
    running, of_mpi = case.begin()
    while (child := caught(running, of_mpi)) is not None:
        os.kill(child, signal.SIGKILL)
    ended = end(running)
    if ended.code != 1 or "Gmsh was killed" not in ended.stderr or len(ended.stderr.splitlines()) != 1:
        return Outcome(fault, "several lines", f"exit code {ended.code}: {ended.stderr[-300:]}")
    return case.continued(fault)


def run(count, seed, folder):
    rng = random.Random(seed)
    cases = {}
    signals = [signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGUSR1]
    faults = [("signal", number, to) for to in ("both", "the run", "Gmsh") for number in signals] + [("once",), ("always",)]
    for k in range(count):
        name = "space" if k % 4 == 3 else "plane"
        case = cases.setdefault(name, None) or Case(name, folder)
        cases[name] = case
        kind, *how = faults[k % len(faults)]
        remeshing_number = rng.randint(1, 2)
        yield (interrupted(case, *how, remeshing_number) if kind == "signal"
               else killed_once(case, remeshing_number) if kind == "once" else killed_always(case))
        print(f"\r{k + 1} of {count}", end="", file=sys.stderr)
