#!/usr/bin/env python3
"""The drag on a cylinder that is pulled over a coarse mesh, with exact, faceted and smoothed contour: figure and table.

    ironing.py PROGRAM FIGURE.png      runs inputs/contact/ironing.xml three times in a scratch folder
"""
import pathlib
import subprocess
import sys
import tempfile

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "support"))
from mudline_case import History  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
DECK = ROOT / "inputs" / "contact" / "ironing.xml"
ELEMENT = 0.25  # [m] of the deck's mesh
KINDS = {"facets": "facets of one element length", "bezier": "smoothed through the facets' corners", "exact": "exact"}


def run(program, kind, folder):
    """Displacement in elements, drag and normal force of the steady part."""
    settings = ["--set", f"bodies/die/contour/approximation={kind}", "--set", f"output/name={kind}"]
    if kind != "exact":
        settings += ["--set", f"bodies/die/contour/chord length={ELEMENT}"]
    subprocess.run([program, "run", "-q", DECK] + settings, cwd=folder, check=True)
    history = History(pathlib.Path(folder) / "results" / f"{kind}.csv")
    steady = history.time > 1.2
    return (history["body/die/displacement x"][steady] / ELEMENT, -history["contact/face/reaction x"][steady],
            history["contact/face/reaction y"][steady])


def main():
    program, figure = str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[2]
    axes = plt.subplots(figsize=(8, 3.6))[1]
    print("contour    drag, peak to peak / mean normal force    normal force, peak to peak / mean    without its slow change along the slab")
    with tempfile.TemporaryDirectory() as folder:
        for kind, label in KINDS.items():
            way, drag, normal = run(program, kind, folder)
            ripple = normal - np.polyval(np.polyfit(way, normal, 4), way)
            print(f"{kind:10s} {np.ptp(drag) / normal.mean():.5f} {np.ptp(normal) / normal.mean():33.5f} {np.ptp(ripple) / normal.mean():33.5f}")
            axes.plot(way, 100 * drag / normal.mean(), label=label, lw=2.2 if kind == "bezier" else 1.1)
    axes.set_xlabel("way of the cylinder [elements]")
    axes.set_ylabel("drag / normal force [%]")
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), frameon=False, ncol=3)
    axes.margins(x=0)
    axes.figure.savefig(figure, dpi=130, bbox_inches="tight")


if __name__ == "__main__":
    main()
