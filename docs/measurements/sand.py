"""Draws docs/pictures/measured_sand.png and prints the table of docs/measurements/sand.md.

An argument is the program."""

import numpy as np

import laboratory
from laboratory import STRAIN, STRESS, at

VOLUME, VERTICAL, VOID = "volumetric strain [%]", "vertical stress [kPa]", "void ratio [-]"
TRIAXIAL, OEDOMETER = ("CD 100", "CD 200", "CD 300"), ("OE loose", "OE dense")
COLUMNS = {
    STRAIN: ("engineering axial strain", 100),
    VOLUME: ("engineering volumetric strain", -100),
    STRESS: ("deviatoric stress", 1e-3),
    VERTICAL: ("effective stress yy", 1e-3),
    VOID: ("void ratio", 1),
}


def results(program):
    """Tests and curves."""
    return laboratory.measured("sand.csv"), laboratory.computed(program, "sand.xml", TRIAXIAL + OEDOMETER, COLUMNS)


def main():
    tests, curves = results(laboratory.program())
    figure, axes = laboratory.axes(3, 11)
    for test, colour in zip(TRIAXIAL, laboratory.COLOURS):
        for axis, what in zip(axes, (STRESS, VOLUME)):
            axis.plot(curves[test][STRAIN], curves[test][what], color=colour, label=test + " kPa")
            axis.plot(tests[test][STRAIN], tests[test][what], "o", color=colour, markersize=4)
            axis.set(xlabel=STRAIN, ylabel=what, xlim=(0, 10.2))
        for i, x in enumerate(tests[test][STRAIN]):
            q = at(curves[test], tests[test], STRAIN, STRESS)[i], tests[test][STRESS][i]
            v = at(curves[test], tests[test], STRAIN, VOLUME)[i], tests[test][VOLUME][i]
            miss = 100 * (q[0] / q[1] - 1)
            print(f"| {test} | {x:.3g} % | {q[1]:.0f} | {q[0]:.0f} | {miss:+.0f} % | {v[1]:+.2f} | {v[0]:+.2f} |")
    for test, colour in zip(OEDOMETER, laboratory.COLOURS):
        axes[2].semilogx(curves[test][VERTICAL], curves[test][VOID], color=colour, label=test)
        axes[2].plot(tests[test][VERTICAL], tests[test][VOID], "o", color=colour, markersize=4)
        worst = np.abs(at(curves[test], tests[test], VERTICAL, VOID) - tests[test][VOID]).max()
        print(f"{test}: void ratio within {worst:.4f}")
    axes[2].set(xlabel=VERTICAL, ylabel=VOID)
    laboratory.save(figure, "measured_sand.png")


if __name__ == "__main__":
    main()
