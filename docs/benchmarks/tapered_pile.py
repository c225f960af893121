#!/usr/bin/env python3
"""Stresses and excess pore pressure on the wall of the tapered pile against undrained expansion of a cylindrical cavity: tables and figure.

    tapered_pile.py RESULTS/tapered FIGURE.png     after `mudline run inputs/pile/tapered.xml`: its results without ending
"""
import pathlib
import sys

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

for folder in ("support", "verification"):
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / folder))
from pile_in_clay import RADIUS, at_half_height, shares_of_cavity, wall  # noqa: E402

TAPER_IN = 2.4  # [m] depth of the tip from which the taper is in the ground


def main():
    with h5py.File(sys.argv[1] + ".h5", "r") as file:
        print("at half the taper's height\ntip [m]  total  effective  excess")
        for name in sorted(file["steps"]):
            depth, radius, *stresses = wall(file, file["steps"][name])
            if len(depth) and depth.max() > TAPER_IN:
                middle = [at_half_height(radius, share) for share in shares_of_cavity(depth, *stresses).values()]
                print(f"{depth.max():7.2f}" + "".join(f"{value:8.3f}" for value in middle))
    shares = shares_of_cavity(depth, *stresses)
    print("depth [m]  radius / that of the shaft  " + "  ".join(shares))
    for row in zip(depth, radius / RADIUS, *shares.values()):
        print("".join(f"{value:10.2f}" for value in row))
    axes = plt.subplots(figsize=(5.5, 5.5))[1]
    for name, share in shares.items():
        axes.plot(share, depth, ".-", label=name)
    axes.axvspan(0.9, 1.1, color="0.92")
    axes.axhline(depth[radius > 0.98 * RADIUS].max(), color="k", lw=0.8, ls=":")
    axes.axhline(depth[np.argmin(np.abs(radius - 0.5 * RADIUS))], color="k", lw=0.8, ls="--")
    axes.invert_yaxis()
    axes.set(xlim=(0, 2), xlabel="share of undrained cylindrical cavity expansion", ylabel="depth [m]; dashed: half the taper's height, dotted: shoulder")
    axes.legend(fontsize=8)
    plt.savefig(sys.argv[2], dpi=80, bbox_inches="tight")


if __name__ == "__main__":
    main()
