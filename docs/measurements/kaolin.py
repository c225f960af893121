"""Draws docs/pictures/measured_kaolin.png and prints the table of docs/measurements/kaolin.md.

An argument is the program."""

import laboratory
from laboratory import STRAIN, STRESS, at

TESTS = {"A7": "A7, OCR 1", "A8": "A8, OCR 1", "F2": "F2, OCR 1", "D3": "D3, OCR 3.8", "D1": "D1, OCR 15"}
COLUMNS = {STRAIN: ("axial strain", 100), STRESS: ("deviatoric stress", 1e-3)}


def results(program):
    """Tests and curves."""
    return laboratory.measured("kaolin.csv"), laboratory.computed(program, "kaolin.xml", TESTS, COLUMNS)


def main():
    tests, curves = results(laboratory.program())
    figure, axes = laboratory.axes(2, 8.5)
    for axis, shown in zip(axes, (("A7", "A8", "F2"), ("D3", "D1"))):
        for test, colour in zip(shown, laboratory.COLOURS):
            axis.plot(curves[test][STRAIN], curves[test][STRESS], color=colour, label=TESTS[test])
            axis.plot(tests[test][STRAIN], tests[test][STRESS], "o", color=colour, markersize=4)
        axis.set(xlabel=STRAIN, ylabel=STRESS, xlim=(0, 16), ylim=(0, None))
    for test, label in TESTS.items():
        for i in range(0, len(tests[test][STRAIN]), 6):
            at_end = i + 6 >= len(tests[test][STRAIN])
            k = len(tests[test][STRAIN]) - 1 if at_end else i
            q, found = tests[test][STRESS][k], at(curves[test], tests[test], STRAIN, STRESS)[k]
            peak = ", peak" if at_end else ""
            miss = 100 * (found / q - 1)
            print(f"| {label} | {tests[test][STRAIN][k]:.3g} %{peak} | {q:.0f} | {found:.0f} | {miss:+.0f} % |")
    laboratory.save(figure, "measured_kaolin.png")


if __name__ == "__main__":
    main()
