"""Full disks, signals, and two runs at once."""

import contextlib
import os
import random
import shutil
import signal
import subprocess
import sys
import time

import cpu_limit
from fault import Ended, Outcome, judge, launcher, program, start
from mudline_case import ROOT

TITLE = "full disks, SIGINT, SIGTERM, SIGHUP, SIGUSR1, two runs at once; 1 and 2 ranks"
FULL = 70
SAMPLE = 9

DECK = os.path.join(ROOT, "tests", "mpi", "ball_in_clay.xml")
SETTINGS = ["mesh/cells={4, 4}", "output/name=run", "output/checkpoint steps=4", "output/field steps=4"]
RUN = ["run", "-q", DECK] + [word for setting in SETTINGS for word in ("--set", setting)]
MANY_STEPS = ["--set", "stages/push/time step/initial=5e-6"]


@contextlib.contextmanager
def small_disk(folder, kilobytes):
    """results/ as a disk of its own, where this process may mount one; yields whether it could."""
    place = folder / "results"
    place.mkdir()
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={kilobytes}k", "tmpfs", place], capture_output=True).returncode == 0
    try:
        yield mounted
    finally:
        if mounted:
            subprocess.run(["umount", "-l", place], check=True)
        shutil.rmtree(place)


def begin(arguments, folder, ranks):
    hearing = signal.signal(signal.SIGHUP, signal.SIG_DFL)  # below nohup a run would inherit that it is ignored
    try:
        return subprocess.Popen([*launcher(ranks), program(), *arguments], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                text=True, errors="replace", start_new_session=True)
    finally:
        signal.signal(signal.SIGHUP, hearing)


def end(running, limit=120):
    try:
        out, errors = cpu_limit.communicate(running, limit)
        return Ended(running.returncode, False, out, errors)
    except subprocess.TimeoutExpired as late:
        return Ended(running.returncode, True, late.output, late.stderr)


def rows(folder):
    path = folder / "results" / "run.csv"
    return path.read_bytes().count(b"\n") if path.exists() else 0


def wait_for_rows(running, folder, wanted):
    while rows(folder) < wanted and running.poll() is None:
        time.sleep(0.005)


def disk_too_small(folder, generator, ranks):
    kilobytes = generator.randint(20, 500)
    with small_disk(folder, kilobytes) as mounted:
        ended = start(RUN, folder, ranks) if mounted else None
    fault = f"a disk of {kilobytes} kB on {ranks} rank(s)"
    return judge(fault, ended) if mounted else Outcome(fault, "unchanged", "not tried: no mount permitted")


def disk_that_fills(folder, generator, ranks):
    """Something else takes what is left of the disk while the run goes on."""
    moment = generator.randint(3, 30)
    fault = f"a disk that fills after {moment} lines on {ranks} rank(s)"
    with small_disk(folder, 4000) as mounted:
        if not mounted:
            return Outcome(fault, "unchanged", "not tried: no mount permitted")
        running = begin([*RUN, *MANY_STEPS], folder, ranks)
        wait_for_rows(running, folder, moment)
        with contextlib.suppress(OSError), open(folder / "results" / "other", "wb", buffering=0) as other:
            while True:
                other.write(b"x" * 4096)
        return judge(fault, end(running))


def stopped(number, moment_of):
    def fault_of(folder, generator, ranks):
        moment = moment_of(generator)
        running = begin([*RUN, *MANY_STEPS], folder, ranks)
        wait_for_rows(running, folder, moment)
        running.send_signal(number)
        ended = end(running)
        fault = f"{signal.Signals(number).name} after {moment} lines on {ranks} rank(s)"
        if ended.code != 4 or "stopped by a signal" not in ended.stderr:
            return Outcome(fault, "crash", f"exit code {ended.code}: {ended.stderr[-300:]}")
        left = rows(folder)
        again = start([*RUN, *MANY_STEPS, "--restart", "--steps", "2"], folder, ranks)
        if again.code != 0 or rows(folder) != left + 2:
            return Outcome(fault, "several lines", f"not continued: {again.stderr[-300:]}")
        return Outcome(fault, "survived")
    return fault_of


def second_run(folder, generator, ranks):
    running = begin([*RUN, *MANY_STEPS], folder, ranks)
    wait_for_rows(running, folder, 3)
    outcome = judge(f"a second run of the same name on {ranks} rank(s)",
                    start(RUN + generator.choice([[], ["--restart"], ["--overwrite"]]), folder, ranks))
    running.terminate()
    end(running)
    return outcome


FAULTS = [
    disk_too_small,
    disk_that_fills,
    stopped(signal.SIGINT, lambda generator: generator.randint(2, 40)),
    stopped(signal.SIGTERM, lambda generator: generator.randint(2, 40)),
    stopped(signal.SIGHUP, lambda generator: generator.randint(2, 40)),
    stopped(signal.SIGUSR1, lambda generator: generator.randint(2, 40)),
    second_run,
]
# mpirun answers SIGINT, SIGTERM and SIGHUP by killing the ranks; on several it is SIGUSR1 that asks them to stop
TWO_RANKS = [disk_too_small, disk_that_fills, FAULTS[5], second_run]


def run(count, seed, folder):
    generator = random.Random(seed)
    for k in range(count):
        two = k % 3 == 2
        fault = TWO_RANKS[k // 3 % len(TWO_RANKS)] if two else FAULTS[(k - k // 3) % len(FAULTS)]
        yield fault(folder, generator, 2 if two else 1)
        shutil.rmtree(folder / "results", ignore_errors=True)
        print(f"\r{k + 1} of {count}", end="", file=sys.stderr)
