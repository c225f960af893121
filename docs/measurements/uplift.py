"""Draws docs/pictures/measured_uplift.png and prints the table of docs/measurements/uplift.md.

Arguments: the program, and a folder of histories; runs whose history is there are not repeated.
"""

import os
import subprocess
import sys
import tempfile

import numpy as np

import laboratory

sys.path.insert(0, os.path.join(laboratory.TOP, "tests", "support"))
from mudline_case import History  # noqa: E402

DIAMETER, SPEED = 10.0, 0.01  # [m], [m/s] of the deck
MEASURED = 1.0  # [-] peak uplift over compression of a sealed foundation, Mana and others (2013)
CASES = {"compression": ("film", -1), "uplift, film": ("film", 1), "uplift, open base": ("drained", 1)}


def run(program, folder, case):
    """Displacements [m] of a case, and by how much the soil's force has changed [N], in the sense of the motion."""
    drainage, sign = CASES[case]
    name = case.replace(", ", "_").replace(" ", "_")
    path = os.path.join(folder, name + ".csv")
    if not os.path.exists(path):
        changes = [f"variables/speed={sign * SPEED}", f"contacts/foundation/drainage={drainage}",
                   f"output/folder={folder}", f"output/name={name}"]
        settings = [word for change in changes for word in ("--set", change)]
        subprocess.run([program, "run", "-q", laboratory.input_file("uplift.xml"), *settings], check=True)
    history = History(path)
    force = history["contact/foundation/reaction y"]
    way = history["body/foundation/position y"]
    return sign * (way - way[0]), -sign * (force - force[0])


def ratio(up, down):
    """(displacement [m] of the peak in uplift, peak over the compression at that displacement)"""
    peak = np.argmax(up[1])
    return up[0][peak], up[1][peak] / np.interp(up[0][peak], *down)


def main():
    program = laboratory.program()
    scratch = tempfile.TemporaryDirectory()
    folder = sys.argv[2] if len(sys.argv) > 2 else scratch.name
    found = {case: run(program, folder, case) for case in CASES}
    for depth in (0.05, 0.1, 0.15, 0.2, 0.25, 0.3):
        forces = (f"{np.interp(depth, *found[case]) / 1e6:.2f}" for case in CASES)
        print(f"| {1e3 * depth:.0f} |", " | ".join(forces), "|")
    at, share = ratio(found["uplift, film"], found["compression"])
    end = found["uplift, film"][1].max() / found["compression"][1].max()
    print(f"peak at {at:.3f} m: {share:.3f} of the compression there, miss {100 * (share / MEASURED - 1):+.0f} %; "
          f"{end:.3f} of the largest compression, miss {100 * (end / MEASURED - 1):+.0f} %")
    figure, axis = laboratory.axes(1, 5.5)
    for case, colour in zip(CASES, laboratory.COLOURS):
        axis.plot(1e2 * found[case][0] / DIAMETER, found[case][1] / 1e6, color=colour, label=case)
    axis.set(xlabel="displacement [% of the width]", ylabel="change of the force [MN]", xlim=(0, 3), ylim=(0, None))
    laboratory.save(figure, "measured_uplift.png")


if __name__ == "__main__":
    main()
