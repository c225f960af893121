#!/usr/bin/env python3
"""Pulls the torpedo anchor of inputs/space/torpedo.xml at its padeye at 0, 45 and 90 degrees to the horizontal, without and with fins, and draws forces over ways.

    torpedo_capacity.py MUDLINE FOLDER PICTURE    runs what FOLDER/results lacks, prints the capacities, writes the picture
"""
import csv
import math
import pathlib
import subprocess
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parents[2] / "inputs" / "space"
SPEED = 0.006  # [m/s] of the padeye


def history(program, folder, fins, angle):
    name = f"{'fins' if fins else 'bare'}_{angle}"
    result = folder / "results" / f"{name}.csv"
    if not result.exists():
        motion = "bodies/anchor/motion/prescribed velocity/velocity"
        decks = [HERE / "torpedo.xml"] + ([HERE / "torpedo_fins.xml"] if fins else [])
        subprocess.run([program, "run", "-q", *decks, "--set", f"output/name={name}",
                        "--set", f"{motion} x={SPEED * math.cos(math.radians(angle))}",
                        "--set", f"{motion} z={SPEED * math.sin(math.radians(angle))}"], cwd=folder, check=True)
    with open(result, newline="") as file:
        rows = list(csv.reader(file))
    column = {head.split(" [")[0]: [float(row[i]) for row in rows[1:]] for i, head in enumerate(rows[0])}
    # the whole anchor
    return [1e3 * SPEED * t for t in column["time"]], [[-2e-3 * f for f in column[f"contact/hull/reaction {axis}"]] for axis in "xz"]


def main():
    program, folder, picture = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), constrained_layout=True)
    for fins, colour in ((False, "#0b5d8a"), (True, "#d1622b")):
        ends = []
        for angle, style in ((0, "-"), (45, "--"), (90, ":")):
            way, (along, up) = history(program, folder, fins, angle)
            total = [math.hypot(x, z) for x, z in zip(along, up)]
            left.plot(way, total, style, color=colour, label=f"{'fins' if fins else 'no fins'}, {angle}°")
            ends.append((along[-1], up[-1]))
            print(f"{'fins' if fins else 'bare'} {angle}: horizontal {along[-1]:.0f}, vertical {up[-1]:.0f}, together {total[-1]:.0f} kN")
        right.plot(*zip(*ends), "o-", color=colour, label="fins" if fins else "no fins")
    left.set(xlabel="way of the padeye [mm]", ylabel="force [kN]")
    right.set(xlabel="horizontal force [kN]", ylabel="vertical force [kN]", xlim=(-10, None), ylim=(-10, None))
    for axes in (left, right):
        axes.legend(frameon=False, ncol=2, fontsize=8, loc="lower right" if axes is left else "upper right")
        axes.grid(alpha=0.3)
    figure.savefig(picture, dpi=130)


if __name__ == "__main__":
    main()
