"""Draws docs/pictures/measured_kaolin.png and prints the table of docs/measurements/kaolin.md.

An argument is the program."""

import laboratory
from laboratory import STRAIN, STRESS, at

TESTS = {"A7": "A7, OCR 1", "A8": "A8, OCR 1", "F2": "F2, OCR 1", "D3": "D3, OCR 3.8", "D1": "D1, OCR 15"}
LAWS = {"Cam Clay": (), "CASM": ("materials/kaolin/skeleton/spacing ratio=2.3",)}
LINES = {"Cam Clay": "--", "CASM": "-"}
PANELS = ((("A7", "A8", "F2"), 400), (("D3", "D1"), 700))  # tests, largest stress shown [kPa]
COLUMNS = {STRAIN: ("axial strain", 100), STRESS: ("deviatoric stress", 1e-3)}


def results(program):
    """Tests and curves, these by law."""
    return laboratory.measured("kaolin.csv"), {
        law: laboratory.computed(program, "kaolin.xml", TESTS, COLUMNS, changes) for law, changes in LAWS.items()
    }


def main():
    tests, curves = results(laboratory.program())
    figure, axes = laboratory.axes(2, 8.5)
    for axis, (shown, top) in zip(axes, PANELS):
        for test, colour in zip(shown, laboratory.COLOURS):
            for law, line in LINES.items():
                name = TESTS[test] if law == "CASM" else None
                axis.plot(curves[law][test][STRAIN], curves[law][test][STRESS], line, color=colour, label=name)
            axis.plot(tests[test][STRAIN], tests[test][STRESS], "o", color=colour, markersize=4)
        axis.set(xlabel=STRAIN, ylabel=STRESS, xlim=(0, 16), ylim=(0, top))
    for law, line in LINES.items():
        axes[0].plot([], [], line, color="black", label=law)
    for test, label in TESTS.items():
        for i in range(0, len(tests[test][STRAIN]), 6):
            at_end = i + 6 >= len(tests[test][STRAIN])
            k = len(tests[test][STRAIN]) - 1 if at_end else i
            q, peak = tests[test][STRESS][k], ", peak" if at_end else ""
            cells = [label, f"{tests[test][STRAIN][k]:.3g} %{peak}", f"{q:.0f}"]
            for law in LAWS:
                found = at(curves[law][test], tests[test], STRAIN, STRESS)[k]
                cells += [f"{found:.0f}", f"{100 * (found / q - 1):+.0f} %"]
            print("|", " | ".join(cells), "|")
    for law in LAWS:
        for test in TESTS:
            q, line = tests[test][STRESS], curves[law][test][STRESS]
            late = tests[test][STRAIN] >= 1.0
            miss = 100 * (at(curves[law][test], tests[test], STRAIN, STRESS) / q - 1)[late]
            print(f"{law}, {test}: from 1 % on {miss.min():+.1f} to {miss.max():+.1f} %", end="; ")
            print(f"largest stress {100 * (line.max() / q.max() - 1):+.1f} %")
    laboratory.save(figure, "measured_kaolin.png")


if __name__ == "__main__":
    main()
