"""Draws docs/pictures/measured_sand.png and prints the table of docs/measurements/sand.md: laboratory tests on a sand beside
what `mudline point inputs/measurements/sand.xml` makes of them. An argument is the program, by default ./mudline."""
import csv
import os
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
DECK, DATA = (os.path.join(TOP, "inputs", "measurements", "sand" + ending) for ending in (".xml", ".csv"))
STRAIN, STRESS, VOLUME = "axial strain [%]", "deviatoric stress [kPa]", "volumetric strain [%]"
VERTICAL, VOID = "vertical stress [kPa]", "void ratio [-]"
TRIAXIAL, OEDOMETER = ("CD 100", "CD 200", "CD 300"), ("OE loose", "OE dense")
COLOURS = ("#0b5d8a", "#d1622b", "#3a8f5c")


def measured():
    """{test: {column: values}}"""
    tests = {}
    with open(DATA, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            for name, value in row.items():
                if name != "test" and value:
                    tests.setdefault(row["test"], {}).setdefault(name, []).append(float(value))
    return {test: {name: np.array(values) for name, values in columns.items()} for test, columns in tests.items()}


def computed(program):
    """The same columns of the same tests, as whole curves."""
    with tempfile.TemporaryDirectory() as folder:
        settings = ["--set", f"output/folder={folder}", "--set", "output/name=sand"]
        subprocess.run([program, "point", "-q", DECK, *settings], check=True)
        curves = {}
        for test in TRIAXIAL + OEDOMETER:
            with open(os.path.join(folder, f"sand_{test.replace(' ', '_')}.csv"), newline="", encoding="utf-8") as file:
                head, *rows = list(csv.reader(file))
            columns = dict(zip((name.rsplit(" [", 1)[0] for name in head), np.array(rows, dtype=float).T))
            curves[test] = {
                STRAIN: 100 * columns["engineering axial strain"],
                VOLUME: -100 * columns["engineering volumetric strain"],
                STRESS: 1e-3 * columns["deviatoric stress"],
                VERTICAL: 1e-3 * columns["effective stress yy"],
                VOID: columns["void ratio"],
            }
        return curves


def at(curve, test, over, what):
    """The curve's values at the measured points of a test."""
    return np.interp(test[over], curve[over], curve[what])


def main():
    tests, curves = measured(), computed(sys.argv[1] if len(sys.argv) > 1 else os.path.join(TOP, "mudline"))
    figure, axes = plt.subplots(1, 3, figsize=(11, 3.8), constrained_layout=True)
    for test, colour in zip(TRIAXIAL, COLOURS):
        for axis, what in zip(axes, (STRESS, VOLUME)):
            axis.plot(curves[test][STRAIN], curves[test][what], color=colour, label=test + " kPa")
            axis.plot(tests[test][STRAIN], tests[test][what], "o", color=colour, markersize=4)
            axis.set(xlabel=STRAIN, ylabel=what, xlim=(0, 10.2))
        for i, x in enumerate(tests[test][STRAIN]):
            q = at(curves[test], tests[test], STRAIN, STRESS)[i], tests[test][STRESS][i]
            v = at(curves[test], tests[test], STRAIN, VOLUME)[i], tests[test][VOLUME][i]
            miss = 100 * (q[0] / q[1] - 1)
            print(f"| {test} | {x:.3g} % | {q[1]:.0f} | {q[0]:.0f} | {miss:+.0f} % | {v[1]:+.2f} | {v[0]:+.2f} |")
    for test, colour in zip(OEDOMETER, COLOURS):
        axes[2].semilogx(curves[test][VERTICAL], curves[test][VOID], color=colour, label=test)
        axes[2].plot(tests[test][VERTICAL], tests[test][VOID], "o", color=colour, markersize=4)
        worst = np.abs(at(curves[test], tests[test], VERTICAL, VOID) - tests[test][VOID]).max()
        print(f"{test}: void ratio within {worst:.4f}")
    axes[2].set(xlabel=VERTICAL, ylabel=VOID)
    for axis in axes:
        axis.grid(color="#e3e3e3")
        axis.legend(fontsize=8, frameon=False)
    figure.savefig(os.path.join(TOP, "docs", "pictures", "measured_sand.png"), dpi=130)


if __name__ == "__main__":
    main()
