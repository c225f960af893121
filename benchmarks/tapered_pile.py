#!/usr/bin/env python3
"""Stresses and excess pore pressure on the wall of the tapered pile against undrained expansion of a cylindrical cavity: table and figure.

    tapered_pile.py RESULTS/tapered FIGURE.png     after `mudline run inputs/pile/tapered.xml`: its results without ending
"""
import sys

import h5py
import matplotlib.pyplot as plt
import numpy as np

from pile_wall import GAMMA_WATER, RADIUS, SURCHARGE, cavity, vertical


def wall(file):
    """Depth, radius, total radial stress beyond hydrostatic, effective radial stress, excess pressure at the nodes that touch the pile, from the tip up."""
    step = file["steps"][max(file["steps"])]
    x = step["coordinates"][:, :2]
    cells = file["mesh/topology"][()].reshape(-1, 7)[:, 1:4].astype(int)
    contact, excess = step["nodal/contact_pressure_pile"][()] * 1e-3, step["nodal/excess_pore_pressure"][()] * 1e-3
    radial = -step["cell/effective_stress"][:, 0] * 1e-3
    touching = sorted((i for i in np.unique(cells) if contact[i] > 0), key=lambda i: x[i, 1])
    # the surcharge presses on the soil beside and under the pile like a heavy fluid, apart from the contact
    return np.array([(-x[i, 1], x[i, 0], contact[i] + SURCHARGE + GAMMA_WATER * x[i, 1], radial[(cells == i).any(axis=1)].mean(), excess[i]) for i in touching]).T


def main():
    total_cavity, excess_cavity = cavity()
    with h5py.File(sys.argv[1] + ".h5", "r") as file:
        depth, radius, total, effective, excess = wall(file)
    scale = vertical(depth)
    shares = {
        "total radial stress, from the contact": total / scale / total_cavity,
        "effective radial stress": effective / scale / (total_cavity - excess_cavity),
        "excess pore pressure": excess / scale / excess_cavity,
    }
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
