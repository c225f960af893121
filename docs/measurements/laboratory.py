"""Laboratory tests and the curves that `mudline point` makes of them, in the same columns."""

import csv
import os
import subprocess
import sys
import tempfile

import numpy as np

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
COLOURS = ("#0b5d8a", "#d1622b", "#3a8f5c", "#8a4f9e", "#b8902a", "#5c5c5c")
STRAIN, STRESS = "axial strain [%]", "deviatoric stress [kPa]"


def input_file(name):
    """A file of inputs/measurements."""
    return os.path.join(TOP, "inputs", "measurements", name)


def program():
    """The program: the script's argument, or ./mudline."""
    return sys.argv[1] if len(sys.argv) > 1 else os.path.join(TOP, "mudline")


def measured(name):
    """{test: {column: values}} of a CSV file whose first column is the test; an empty cell is no value."""
    tests = {}
    with open(input_file(name), newline="", encoding="utf-8") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            for column, value in row.items():
                if column != "test" and value:
                    tests.setdefault(row["test"], {}).setdefault(column, []).append(float(value))
    return {test: {column: np.array(values) for column, values in columns.items()} for test, columns in tests.items()}


def computed(path, deck, tests, columns, changes=()):
    """{test: {column: values}} of whole curves. `columns`: {column: (that of the program's file, factor)}. `changes`:
    entries of the deck with other values, as for --set."""
    with tempfile.TemporaryDirectory() as folder:
        changes = [f"output/folder={folder}", "output/name=test", *changes]
        settings = [word for change in changes for word in ("--set", change)]
        subprocess.run([path, "point", "-q", input_file(deck), *settings], check=True)
        curves = {}
        for test in tests:
            with open(os.path.join(folder, f"test_{test.replace(' ', '_')}.csv"), newline="", encoding="utf-8") as file:
                head, *rows = list(csv.reader(file))
            found = dict(zip((name.rsplit(" [", 1)[0] for name in head), np.array(rows, dtype=float).T))
            curves[test] = {column: factor * found[name] for column, (name, factor) in columns.items()}
        return curves


def at(curve, test, over, what):
    """The curve's values at the measured points of a test."""
    return np.interp(test[over], curve[over], curve[what])


def axes(count, width):
    """A figure with so many axes side by side."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, found = plt.subplots(1, count, figsize=(width, 3.8), constrained_layout=True)
    for axis in np.atleast_1d(found):
        axis.grid(color="#e3e3e3")
    return figure, found


def save(figure, name):
    for axis in figure.axes:
        axis.legend(fontsize=8, frameon=False)
    figure.savefig(os.path.join(TOP, "docs", "pictures", name), dpi=130)
