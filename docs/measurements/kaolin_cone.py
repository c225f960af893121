"""Draws docs/pictures/measured_kaolin_cone.png and prints the table of docs/measurements/kaolin_cone.md.

Arguments: the program, and the history of a run of the deck; without it the deck is run, which takes some
minutes.
"""

import os
import subprocess
import sys
import tempfile

import numpy as np

import laboratory

sys.path.insert(0, os.path.join(laboratory.TOP, "tests", "support"))
from mudline_case import History  # noqa: E402

RADIUS = 0.01785  # [m]
MEASURED = {"N_kt": (10.3, 1.9), "N_u": (8.25, 1.0)}  # May (1987): mean and scatter
FIRST, DEPTHS = 10.0, (6, 8, 10, 12, 14)  # [radii] from where the mean is taken; of the table


def strength():
    """Undrained strength [Pa] of the deck's clay in triaxial compression from its start: Modified Cam Clay at the
    critical state, at the void ratio of the start."""
    ratio, compression, swelling, vertical, horizontal = 0.8985, 0.205, 0.044, 100e3, 60.93e3
    p, q = (vertical + 2 * horizontal) / 3, vertical - horizontal
    half = 0.5 * p * (1 + (q / p / ratio) ** 2)
    return 0.5 * ratio * half * (p / half) ** (swelling / compression)


def history():
    if len(sys.argv) > 2:
        return History(sys.argv[2])
    decks = [os.path.join(laboratory.TOP, "inputs", "cpt", "clay.xml"), laboratory.input_file("kaolin_cone.xml")]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([laboratory.program(), "run", "-q", *decks, "--set", f"output/folder={folder}"], check=True)
        return History(os.path.join(folder, "kaolin_cone.csv"))


def main():
    found, s_u = history(), strength()
    depth = -found["body/cone/position y"] / RADIUS
    curves = {"N_kt": found["cone/sounding/net cone resistance"] / s_u,
              "N_u": found["cone/sounding/excess pore pressure u2"] / s_u}
    curves["N_u"][curves["N_u"] == 0] = np.nan  # no soil touches the filter yet
    print(f"s_u {s_u / 1e3:.2f} kPa")
    for at in DEPTHS:
        n_kt, n_u = (np.interp(at, depth, curves[name]) for name in curves)
        print(f"| {at} | {n_kt:.2f} | {n_u:.2f} | {n_u / n_kt:.2f} |")
    figure, axes = laboratory.axes(2, 8)
    for axis, name, colour in zip(axes, curves, laboratory.COLOURS):
        mean, scatter = MEASURED[name]
        far = curves[name][depth >= FIRST].mean()
        print(f"{name}: {far:.2f}, measured {mean} +- {scatter}, miss {100 * (far / mean - 1):+.0f} %")
        axis.axhspan(mean - scatter, mean + scatter, color=colour, alpha=0.15, label="measured")
        axis.plot(depth, curves[name], color=colour, label="computed")
        axis.set(xlabel="depth [radii]", ylabel=f"{name} [-]", xlim=(0, depth[-1]), ylim=(0, 13))
    laboratory.save(figure, "measured_kaolin_cone.png")


if __name__ == "__main__":
    main()
