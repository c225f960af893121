"""Golden histories: short runs of every shipped deck and of those in decks/, every column of them, to compare another
program with.

    golden.py record [NAME ...]      runs the decks and writes tests/regression/golden/NAME.csv
    golden.py compare [NAME ...]     runs them again and says which columns differ

NAME is a deck's path below inputs/ without ".xml", say pile/clay. The decks that `mudline new` stands on are new/NAME,
with their defaults. Decks of tests/regression/decks are regression/NAME; they cover what no shipped deck does within
its first steps, and run to their end. The program is that of the environment variable MUDLINE. A refactoring keeps them to 1e-9. A change of a default that changes answers
is compared with the old setting by --set, and the decks are recorded anew with a note of the figure.

A deck of inputs/ runs for as many steps as about five seconds allow, decided when it is first recorded and kept in
the file's first line, also when it is recorded again, on a busier machine say (`--anew` decides again). At most
twelve rows are kept, spread over the run. A second run on two ranks tells what rounding does to each column (the row
`noise`): what is a difference of large numbers cannot be kept to 1e-9. Ten times that is allowed for.
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import resource
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "support"))
sys.path.insert(0, str(HERE.parent / "plausibility"))

import numpy as np  # noqa: E402
from mudline_case import History, program, unit_of  # noqa: E402
from shipped_decks import shipped_decks  # noqa: E402

GOLDEN = HERE / "golden"
DECKS = HERE / "decks"
NEW = HERE.parent.parent / "apps" / "new" / "decks"
LAID_OVER = re.compile(r"Laid over (\S+\.xml)")  # at the head of an overlay in DECKS: a path from that folder
SECONDS = 5.0   # of a deck
ROWS = 12
MOST = 1500  # steps
# steps before Newton's iterates wander about, where rounding decides what becomes of a step
CALM = {"footing/tresca_penetration": 14, "cpt/guide_tube": 12}
DIFFERENCES = re.compile(r"^balance/.*(change|error|outflow)")  # of sums over the mesh: their last digits are rounding
TIMES = re.compile(r"wall|cpu", re.IGNORECASE)  # columns that no program repeats


def all_decks():
    """{name: files} of the shipped decks, of those in DECKS and of those of `mudline new`."""
    decks = shipped_decks()
    for path in sorted(DECKS.glob("*.xml")):
        text = path.read_text()
        below = LAID_OVER.search(text[:text.index("-->")])
        decks["regression/" + path.stem] = ([str(DECKS / below[1])] if below else []) + [str(path)]
    for path in sorted(NEW.glob("*.xml")):
        if "<!-- These are given. -->" in path.read_text():
            decks["new/" + path.stem] = [str(path)]
    return decks


class PointTests:
    """The tests of material points of a deck, each with as many rows, side by side as the columns "test/column"."""

    def __init__(self, paths):
        tests = {path.stem.split("_", 1)[1]: History(path) for path in paths}
        self.header = [f"{test}/{column}" for test, history in tests.items() for column in history.header]
        self.data = np.hstack([history.data for history in tests.values()])


def is_of_points(files):
    return '<ParameterList name="tests">' in pathlib.Path(files[-1]).read_text()


def run(files, steps, folder, settings=(), ranks=1):
    """History of so many steps of a deck, all of its rows, and whether it was over by then. Material points run to
    their end."""
    points = is_of_points(files)
    arguments = ["point", *files] if points else ["run", "-q", *files, "--steps", steps]
    done = program(arguments + [word for s in settings for word in ("--set", s)], ranks, folder, timeout=300)
    results = sorted(path for path in pathlib.Path(folder, "results").glob("*.csv") if not path.name.endswith(".results.csv"))
    if done.returncode not in (0, 4) or not (results if points else len(results) == 1):
        raise RuntimeError((done.stdout + done.stderr)[:600])
    if points:
        return PointTests(results), True
    history = History(results[0])
    return history, len(history.data) < steps


def is_extra(files):
    return pathlib.Path(files[-1]).parent == DECKS


def find_steps(files):
    """As many steps as take about SECONDS, and their history; all steps of a deck in DECKS, which is short."""
    if is_extra(files):
        with tempfile.TemporaryDirectory() as folder:
            history, _ = run(files, MOST, folder)
        return len(history.data), history
    steps = 4
    while True:
        with tempfile.TemporaryDirectory() as folder:
            start = time.monotonic()
            history, finished = run(files, steps, folder)
            spent = time.monotonic() - start
        if finished or spent > 0.5 * SECONDS or steps >= MOST:
            return steps, history
        steps = int(min(max(2, 0.9 * SECONDS / max(spent, 0.1)), 12) * steps)


def path_of(name):
    return GOLDEN / (name.replace("/", "-") + ".csv")


def rounding(files, steps, history):
    """Largest difference of each column on two ranks; None where the steps go another way. A deck in DECKS must not
    stop before what it covers: there the rows before that tell it."""
    if is_of_points(files):
        return np.zeros(len(history.header))
    with tempfile.TemporaryDirectory() as folder:
        try:
            other, _ = run(files, steps, folder, ranks=2)
        except RuntimeError as error:
            if "fewer than the 2 ranks" in str(error):
                return np.zeros(len(history.header))
            raise
    way = "step/newton iterations"
    rows = min(len(other.data), len(history.data))
    same = np.append(other[way][:rows] == history[way][:rows], False).argmin()
    if not is_extra(files) and same < max(len(other.data), len(history.data)):
        return None
    columns = [other.header.index(column) for column in history.header]
    return np.abs(other.data[:same, columns] - history.data[:same]).max(axis=0, initial=0)


def recorded_steps(name):
    """Of the file that is there; None without one."""
    path = path_of(name)
    return int(path.read_text().split(maxsplit=2)[1]) if path.exists() else None


def record(name, files, anew=False):
    steps, history = recorded_steps(name), None
    if anew or steps is None:
        steps, history = find_steps(files)
    noise, limit = None, CALM.get(name, steps)
    while noise is None:
        if limit < steps or history is None:
            steps = limit
            with tempfile.TemporaryDirectory() as folder:
                history, _ = run(files, steps, folder)
        noise = rounding(files, steps, history)
        limit = max(1, steps * 2 // 3)
        if noise is None and steps == 1:
            raise RuntimeError("one step differs between one rank and two")
    keep = np.unique(np.linspace(0, len(history.data) - 1, ROWS).round().astype(int))
    with open(path_of(name), "w") as out:
        out.write(f"# {steps} steps\n")
        out.write(",".join(["row"] + history.header) + "\n")
        out.write(",".join(["noise"] + [f"{v:.1e}" for v in noise]) + "\n")
        for row in keep:
            out.write(",".join([str(row)] + [f"{v:.12g}" for v in history.data[row]]) + "\n")
    return f"{steps} steps, {len(keep)} rows of {len(history.header)} columns"


def compare(name, files, tolerance, settings=(), ranks=1):
    """List of differences; empty where the histories agree."""
    if not path_of(name).exists():
        return ["no history is recorded"]
    lines = path_of(name).read_text().splitlines()
    header = lines[1].split(",")[1:]
    noise = [float(v) for v in lines[2].split(",")[1:]]
    golden = np.array([[float(v) for v in line.split(",")] for line in lines[3:]])
    rows, golden = golden[:, 0].astype(int), golden[:, 1:]
    with tempfile.TemporaryDirectory() as folder:
        history, _ = run(files, int(lines[0].split()[1]), folder, settings, ranks)
    if rows[-1] != len(history.data) - 1:
        return [f"{len(history.data)} rows, {rows[-1] + 1} expected"]
    found = {column: history.data[rows, i] for i, column in enumerate(history.header)}
    problems = [f"column '{c}' is missing" for c in header if c not in found]
    problems += [f"column '{c}' is new" for c in found if c not in header]
    largest = {}
    for i, column in enumerate(header):
        largest[unit_of(column)] = max(largest.get(unit_of(column), 0.0), np.abs(golden[:, i]).max())
    for i, column in enumerate(header):
        if column not in found or TIMES.search(column):
            continue
        share = max(tolerance, 0.1) if DIFFERENCES.search(column) else tolerance
        allowed = share * np.abs(golden[:, i]).max() + 0.1 * tolerance * largest[unit_of(column)] + 10 * noise[i] + 1e-20
        worst = np.abs(found[column] - golden[:, i]).max()
        if not worst <= allowed:
            problems.append(f"'{column}' differs by {worst:.2e}, its largest value is {np.abs(golden[:, i]).max():.4g}")
    return problems


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("command", choices=("record", "compare"))
    parser.add_argument("names", nargs="*")
    parser.add_argument("--tolerance", type=float, default=1e-9, help="of a column's largest value")
    parser.add_argument("--set", action="append", default=[], dest="settings", help="as of the program")
    parser.add_argument("--anew", action="store_true", help="record: decide again how many steps a deck runs for")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    GOLDEN.mkdir(exist_ok=True)
    decks = all_decks()
    unknown = [name for name in arguments.names if name not in decks]
    if unknown:
        parser.error(f"no deck '{unknown[0]}'; there are {', '.join(decks)}")
    names = arguments.names or [n for n in decks if arguments.command == "record" or path_of(n).exists()]

    def work(name):
        try:
            if arguments.command == "record":
                return name, record(name, decks[name], arguments.anew), True
            problems = compare(name, decks[name], arguments.tolerance, arguments.settings, arguments.ranks)
            return name, "\n    ".join(problems[:6]) if problems else "equal", not problems
        except RuntimeError as error:
            return name, str(error), False

    failed = 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for name, text, good in pool.map(work, names):
            failed += not good
            print(f"{name}: {text}", flush=True)
    spent = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"{len(names) - failed} of {len(names)} decks, {spent.ru_utime:.0f} s CPU")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
