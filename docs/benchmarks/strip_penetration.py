#!/usr/bin/env python3
"""A strip footing pushed by one width into Tresca clay, with a mesh that moves against the soil and with one that goes with it, beside the
limit loads of the deformed geometry: figure and table. Needs scipy.

    strip_penetration.py PROGRAM FIGURE.png FOLDER      runs inputs/footing/tresca_penetration.xml twice in FOLDER; results there are used again
"""
import pathlib
import subprocess
import sys

import matplotlib
import numpy as np

from limit_load import limit_loads

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "support"))
from mudline_case import History  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
DECK = ROOT / "inputs" / "footing" / "tresca_penetration.xml"
HALF_WIDTH, STRENGTH = 0.5, 10e3
KINDS = {"ale": ("mesh moved against the soil", []), "lagrangian": ("mesh that goes with the soil", ["--set", "stages/push/mesh motion=false"])}


def run(program, name, settings, folder):
    """Depth over width, factor and smallest scaled Jacobian."""
    table = folder / "results" / f"{name}.csv"
    if not table.exists():  # the Lagrangian one ends in failure: its elements fold
        subprocess.run([program, "run", "-q", DECK, "--set", f"output/name={name}"] + settings, cwd=folder, check=name == "ale")
    history = History(table)
    return (-history["body/footing/displacement y"] / (2 * HALF_WIDTH), history["contact/footing/tip reaction y"] / (HALF_WIDTH * STRENGTH),
            history["mesh/quality"])


def main():
    program, figure, folder = str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[2], pathlib.Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    _, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.8))
    curves = {}
    for name, (label, settings) in KINDS.items():
        curves[name] = depth, factor, quality = run(program, name, settings, folder)
        left.plot(depth, factor, label=label, lw=1.5)
        right.plot(depth, quality, lw=1.5)
    loads = np.array([load[:2] for load in limit_loads(folder / "results" / "ale.h5") if load[0] > 0.05])
    left.plot(loads[:, 0] / (2 * HALF_WIDTH), loads[:, 1], "ko", ms=4, mfc="none", label="limit load of the deformed geometry")
    left.axhline(2 + np.pi, color="0.7", lw=0.8, label=r"$2 + \pi$")
    print("depth / width    N_c    limit load    Lagrangian")
    for depth, load in loads:
        at = depth / (2 * HALF_WIDTH)
        one, other = (np.interp(at, c[0], c[1], right=np.nan) for c in curves.values())
        print(f"{at:13.3f} {one:6.3f} {load:13.3f} {other:13.3f}")
    left.set_xlabel("depth / width")
    left.set_ylabel(r"resistance / (width $s_u$)")
    left.set_ylim(0, 8)
    left.legend(frameon=False, fontsize=8, loc="lower right")
    right.set_xlabel("depth / width")
    right.set_ylabel("smallest scaled Jacobian")
    right.axhline(0, color="0.7", lw=0.8)
    for axes in (left, right):
        axes.set_xlim(0, 1)
    plt.savefig(figure, dpi=130, bbox_inches="tight")


if __name__ == "__main__":
    main()
