#!/usr/bin/env python3
"""Dynamic response to a cylinder dragged over soil, faceted against smooth contour, contact at nodes and at quadrature points:
figure and table.

    dynamic_ironing.py PROGRAM FIGURE.png FOLDER      runs inputs/contact/dynamic_ironing.xml six times in FOLDER; results there are used again
"""
import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "support"))
from dynamic_ironing import METHODS, SLOWEST, Response, settings  # noqa: E402
from mudline_case import History  # noqa: E402

DECKS = pathlib.Path(__file__).resolve().parents[2] / "inputs" / "contact"
CONTOURS = {"facets": "facets of one element length", "bezier": "smoothed through their corners", "exact": "exact"}


def run(program, method, contour, folder):
    name = f"{method} {contour}".replace(" ", "_")
    table = folder / "results" / f"{name}.csv"
    command = [program, "run", "-q", DECKS / "ironing.xml", DECKS / "dynamic_ironing.xml", "--set", f"output/name={name}"]
    for setting in settings(method, contour):
        command += ["--set", setting]
    if not table.exists():
        subprocess.run(command, cwd=folder, check=True)
    return Response(History(table))


def main():
    program, figure, folder = str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[2], pathlib.Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    whole, axes = plt.subplots(2, 3, figsize=(12.5, 6.0))
    print(f"above {SLOWEST:g} Hz: drag and normal force [% of the mean normal force], soil's acceleration [m/s2]; strongest frequency of the drag [Hz]")
    for row, method in zip(axes, METHODS):
        for contour, label in CONTOURS.items():
            r = run(program, method, contour, folder)
            spectrum, fast = r.spectrum(r.drag), r.frequency > SLOWEST
            strongest = r.frequency[fast][spectrum[fast].argmax()]
            print(f"{method:20s} {contour:8s} {100 * r.ripple(r.drag):7.2f} {100 * r.ripple(r.normal):7.2f} {r.ripple(r.acceleration):7.2f} {strongest:6.1f}")
            if contour == "exact":
                continue  # on top of the smoothed one
            row[0].plot(r.time - r.time[0], 100 * r.drag, lw=1.0, label=label if method == METHODS[0] else None)
            row[1].semilogy(r.frequency, 100 * spectrum, lw=1.0)
            row[2].semilogy(r.frequency, r.spectrum(r.acceleration), lw=1.0)
        row[0].set_ylabel(f"{method}: drag [%]")
        row[0].margins(x=0)
        row[1].set_ylabel("amplitude of the drag [%]")
        row[2].set_ylabel("soil's acceleration [m/s$^2$]")
        row[1].set_ylim(1e-3, 10)
        row[2].set_ylim(1e-3, 100)
        for axis, label in zip(row, ("time [s]", "frequency [Hz]", "frequency [Hz]")):
            axis.set_xlabel(label)
        for axis in row[1:]:
            axis.set_xlim(0, 100)
    whole.legend(loc="upper center", frameon=False, ncol=2)
    plt.tight_layout(rect=(0, 0, 1, 0.95))
    plt.savefig(figure, dpi=110)


if __name__ == "__main__":
    main()
