#!/usr/bin/python3
"""Runs a deck for several values of something and gathers what comes out: a table (.csv) and a plot (.png).

mudline sweep inputs/cpt/backbone.xml            # results/backbone.{csv,png} and the runs in results/backbone/
mudline sweep inputs/cpt/backbone.xml --jobs 2   # two runs at a time
mudline sweep inputs/cpt/backbone.xml --gather   # only reads the runs that are there
"""

import argparse
import csv
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

from sweep_deck import Formula, SweepDeck, SweepError

sys.path[1:1] = [str(place / "python") for place in Path(__file__).resolve().parents[1:3]]
from mudline import MudlineError, Result  # noqa: E402

sys.path.append(str(Path(__file__).resolve().parent.parent / "support"))
from standard_output import after_output  # noqa: E402


def outcome(stem):
    """The columns of a run's history by name, without unit, and its results by (stage, of, quantity)."""
    result = Result(stem)
    if not len(result.history.time):
        raise SweepError(f"{result.history.path}: no step was finished")
    return {**result.history.by_name(), **(result.results.all() if result.results else {})}


def run(sweep, index, folder, program, extra):
    """Exit code of one case; what it prints goes to a log beside its results."""
    case = folder / f"{index + 1:02d}"
    case.mkdir(parents=True, exist_ok=True)
    command = [program, "run", *sweep.files]
    for setting in sweep.settings_of(index) + [f"output/folder={case}", f"output/name={sweep.path.stem}"] + extra:
        command += ["--set", setting]
    values = ", ".join(f"{name} = {value:g}" for name, value in sweep.case(index).items())
    print(f"  case {index + 1} of {sweep.cases}: {values}", flush=True)
    with open(case / "log.txt", "w") as log:
        code = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT).returncode
    last = [line for line in (case / "log.txt").read_text().splitlines() if line.strip()][-1:]
    print(f"  case {index + 1}: " + ("done" if code == 0 else f"ended with exit code {code}: {last[0] if last else 'no output'}"), flush=True)
    return code


def history_of(sweep, index, folder):
    return folder / f"{index + 1:02d}" / f"{sweep.path.stem}.csv"


def gather(sweep, folder, cases):
    """One row per case: variables, then results."""
    table = []
    for index in cases:
        columns = outcome(history_of(sweep, index, folder))
        case = sweep.case(index)
        row = dict(case)
        for name, formula in sweep.results.items():
            row[name] = Formula(formula, f"{sweep.path}: results/{name}, case {index + 1}").value(case, columns)
        table.append(row)
    return table


def draw(sweep, table, path):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    ordinates = [name for name in sweep.results if name != sweep.abscissa]
    figure, axes = plt.subplots(1, max(len(ordinates), 1), figsize=(5.2 * max(len(ordinates), 1), 4.2), squeeze=False)
    order = np.argsort([row[sweep.abscissa] for row in table])
    for axis, name in zip(axes[0], ordinates):
        axis.plot([table[i][sweep.abscissa] for i in order], [table[i][name] for i in order], "o-", color="#0b5d8a")
        if sweep.logarithmic:
            axis.set_xscale("log")
        axis.set_xlabel(sweep.abscissa)
        axis.set_ylabel(name)
        axis.grid(alpha=0.3)
    figure.suptitle(sweep.name)
    figure.tight_layout()
    figure.savefig(path, dpi=150)


def main(arguments):
    parser = argparse.ArgumentParser(prog="mudline sweep", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("deck", help="deck of the sweep")
    parser.add_argument("--folder", default="results", help="folder of the results (default: results)")
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time")
    parser.add_argument("--gather", action="store_true", help="run nothing, only read what earlier runs left")
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE", help="replace one parameter in every run")
    options = parser.parse_args(arguments)
    try:
        if options.jobs < 1:
            raise SweepError(f"--jobs wants a positive number, not {options.jobs}")
        for setting in options.set:
            if "=" not in setting:
                raise SweepError(f"--set {setting}: expected section/parameter=value, such as stages/push/duration=2.0")
        sweep = SweepDeck(options.deck)
        sweep.check()
        folder = Path(options.folder) / sweep.path.stem
        if not options.gather:
            program = os.environ.get("MUDLINE_PROGRAM")
            if not program:
                raise SweepError("start the sweep by `mudline sweep`, which knows the program")
            with ThreadPoolExecutor(options.jobs) as pool:
                codes = list(pool.map(lambda i: run(sweep, i, folder, program, options.set), range(sweep.cases)))
            done = [index for index, code in enumerate(codes) if code == 0]
            lost = f"{sweep.cases - len(done)} of {sweep.cases} runs failed; their logs are in {folder}"
        else:
            done = [index for index in range(sweep.cases) if history_of(sweep, index, folder).is_file()]
            lost = f"{sweep.cases - len(done)} of {sweep.cases} cases have no history in {folder}"
        if not done:
            raise SweepError(lost)
        table = gather(sweep, folder, done)
        stem = Path(options.folder) / sweep.path.stem
        with open(f"{stem}.csv", "w", newline="") as file:
            writer = csv.DictWriter(file, table[0].keys())
            writer.writeheader()
            writer.writerows(table)
        draw(sweep, table, f"{stem}.png")
    except (SweepError, MudlineError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    width = max(len(name) for name in table[0])
    for name in table[0]:
        print(f"{name:>{width}}  " + "  ".join(f"{row[name]:12.5g}" for row in table))
    print(f"done: {len(table)} runs; results in {stem}.{{csv,png}}")
    if len(done) == sweep.cases:
        return 0
    print(f"error: {lost}; the table has the others", file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(after_output(lambda: main(sys.argv[1:])))
