#!/usr/bin/env python3
"""The resistance of a cone pushed into clay with tip and shoulder as arcs and as chords of one element length: figure and ripple.

    faceted_cone.py PROGRAM FIGURE.png FOLDER      runs inputs/cpt/deep_tresca.xml twice in FOLDER; results there are used again
"""
import pathlib
import subprocess
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "support"))
from mudline_case import History  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
DECKS = ROOT / "inputs" / "cpt"
RADIUS, STRENGTH = 0.01785, 10e3
KINDS = {"faceted": ("chords of one element length", [DECKS / "faceted.xml"]), "exact": ("arcs", [])}
WAY = 5.0  # radii
FROM = 2.0  # radii from which the ripple is measured


def run(program, name, overlays, folder):
    """Way in radii and cone factor."""
    table = folder / "results" / f"{name}.csv"
    if not table.exists():
        subprocess.run([program, "run", "-q", DECKS / "deep_tresca.xml"] + overlays +
                       ["--set", f"output/name={name}", "--set", f"stages/push/duration={WAY * RADIUS / 0.02}"], cwd=folder, check=True)
    history = History(table)
    way = -history["body/cone/displacement y"] / RADIUS
    factor = history["contact/cone/tip reaction y"] / (np.pi * RADIUS**2 * STRENGTH)
    return way[way < WAY + 1e-6], factor[way < WAY + 1e-6]


def ripple(way, factor):
    """What is left of the resistance [%] without its trend, a cubic."""
    late = way > FROM
    trend = np.polyval(np.polyfit(way[late], factor[late], 3), way[late])
    return way[late], 100 * (factor[late] / trend - 1)


def main():
    program, figure, folder = str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[2], pathlib.Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    _, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.6))
    print("contour     factor at the end    ripple, standard deviation and peak to peak [%]")
    for name, (label, overlays) in KINDS.items():
        way, factor = run(program, name, overlays, folder)
        left.plot(way, factor, lw=1.2, label=label)
        at, rest = ripple(way, factor)
        right.plot(at, rest, lw=0.8)
        print(f"{name:10s} {factor[-1]:18.3f} {rest.std():13.3f} {np.ptp(rest):8.3f}")
    left.set_xlabel("way [radii]")
    left.set_ylabel(r"tip resistance / (section $s_u$)")
    left.set_ylim(0)
    left.legend(frameon=False)
    right.set_xlabel("way [radii]")
    right.set_ylabel("resistance less its trend [%]")
    plt.tight_layout()
    plt.savefig(figure, dpi=130)


if __name__ == "__main__":
    main()
