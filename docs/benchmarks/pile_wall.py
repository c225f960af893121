#!/usr/bin/env python3
"""Stresses and pore pressures around the deep pile against cavity expansion, the strain path method and radial consolidation.

    pile_wall.py RESULTS/deep FIGURE.png     after `mudline run inputs/pile/clay.xml inputs/pile/deep.xml`: its results
                                             without ending
"""
import pathlib
import sys

import h5py
import matplotlib
import numpy as np
from scipy.integrate import solve_ivp

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

for folder in ("support", "verification"):
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / folder))
from mudline_case import History  # noqa: E402
from pile_in_clay import CLAY, CONDUCTIVITY, GAMMA_WATER, K0, OCR, RADIUS, START, cavity, vertical  # noqa: E402
from references.strain_path import SimplePile  # noqa: E402

MID = 1.6  # [m]
PUSH = 3.21  # [s]


def strain_path():
    """Total radial stress beyond hydrostatic and excess pore pressure on the wall of the simple pile, over the vertical effective stress."""
    total, _, excess = SimplePile(**CLAY, start=START, ocr=OCR).wall()
    return total, excess


class Field:
    """Wall and cells of one written step."""

    def __init__(self, file, name):
        step = file["steps"][name]
        self.x = step["coordinates"][:, :2]
        mesh = step["mesh"] if "mesh" in step else file["mesh"]
        cells = mesh["topology"][()].reshape(-1, 7)[:, 1:4].astype(int)
        self.excess = step["nodal/excess_pore_pressure"][()] * 1e-3
        radial = -step["cell/effective_stress"][:, 0] * 1e-3
        self.centres, self.cell_excess = self.x[cells].mean(axis=1), self.excess[cells].mean(axis=1)
        self.radial = radial
        sides = np.sort(np.concatenate([cells[:, [0, 1]], cells[:, [1, 2]], cells[:, [2, 0]]]), axis=1)
        unique, count = np.unique(sides, axis=0, return_counts=True)
        boundary = np.unique(unique[count == 1])
        wall = [i for i in boundary if 0.95 * RADIUS < self.x[i, 0] < 1.1 * RADIUS]
        self.wall = np.array(sorted(wall, key=lambda i: self.x[i, 1]))
        self.wall_radial = np.array([radial[(cells == i).any(axis=1)].mean() for i in self.wall])

    def across(self, depth, half):
        """Cells about a depth, by radius: radius, effective radial stress, excess pressure."""
        near = np.nonzero(np.abs(self.centres[:, 1] + depth) < half)[0]
        near = near[np.argsort(self.centres[near, 0])]
        return self.centres[near, 0], self.radial[near], self.cell_excess[near]


def consolidation(radius, excess, c, times):
    """Excess pressure at the wall: linear radial consolidation from a profile, impervious wall, none at 30 radii."""
    x = np.linspace(0, np.log(30), 121)
    r = RADIUS * np.exp(x)
    start = np.interp(r, radius, excess)
    start[-1] = 0

    def rate(_, u):
        curvature = np.zeros_like(u)
        curvature[1:-1] = u[2:] - 2 * u[1:-1] + u[:-2]
        curvature[0] = 2 * (u[1] - u[0])
        curvature[-1] = 0
        return c * curvature / (x[1] * r) ** 2

    return solve_ivp(rate, (0, times[-1]), start, "BDF", times, rtol=1e-6, atol=1e-6).y[0]


def time_of(share, times, values):
    """First time at which values have fallen to a share of the first of them."""
    below = np.nonzero(values < share * values[0])[0]
    return times[below[0]] if len(below) else np.nan


def main():
    stem, figure = sys.argv[1:3]
    with h5py.File(stem + ".h5", "r") as file:
        names = [name for name in sorted(file["steps"]) if file["steps"][name].attrs["time"] <= PUSH * (1 + 1e-9)]
        field = Field(file, names[-1])
    z = -field.x[field.wall, 1]
    print("depth [m]  total / cavity  / strain path   excess pressure [kPa]  cavity  strain path")
    columns = []
    by_cavity, by_path = np.array(cavity()), np.array(strain_path())
    for depth, effective, u in zip(z, field.wall_radial, field.excess[field.wall]):
        if depth < 0.3:
            continue
        total, cavity_u = vertical(depth) * by_cavity
        path_total, path_u = vertical(depth) * by_path
        columns.append((depth, effective + u, u, total, cavity_u, path_total, path_u))
        print(f"{depth:9.2f} {(effective + u) / total:12.2f} {(effective + u) / path_total:12.2f} {u:20.1f} {cavity_u:14.1f} {path_u:10.1f}")
    depth, stress, u, total, cavity_u, path_total, path_u = np.array(columns).T

    axes = plt.subplots(1, 3, figsize=(13, 5))[1]
    for values, style in ((stress, "k.-"), (total, "C0--"), (path_total, "C3--")):
        axes[0].plot(values, depth, style, label={"k.-": "mudline", "C0--": "cavity expansion", "C3--": "strain path"}[style])
    axes[0].invert_yaxis()
    axes[0].set(xlabel="total radial stress at the wall\nbeyond hydrostatic [kPa]", ylabel="depth [m]")
    axes[0].legend()
    r, radial, excess = field.across(MID, 0.15)
    axes[1].semilogx(r / RADIUS, excess, "k.", label="excess pore pressure")
    axes[1].semilogx(r / RADIUS, radial + excess - K0 * vertical(MID), "C1.", label="increase of total radial stress")
    axes[1].set(xlabel="radius / that of the pile", ylabel="mid depth [kPa]", xlim=(1, 25))
    axes[1].legend()

    run = History(stem + ".csv")
    later = run["time"] >= PUSH
    times = run["time"][later] - PUSH
    measured = run["probe/wall/pore pressure"][later] * 1e-3
    keep = (times < 3e8) & (np.maximum.accumulate(times) <= times)
    times, measured = times[keep], measured[keep]
    fine = np.r_[0, np.geomspace(1e3, 3e8, 200)]
    order = np.argsort(r)
    start = np.interp(RADIUS * np.exp(np.linspace(0, np.log(30), 121)), r[order], excess[order])
    grid = RADIUS * np.exp(np.linspace(0, np.log(30), 121))
    p = np.interp(MID, z[::-1], field.wall_radial[::-1])
    for what, slope, style in (("swelling", CLAY["swelling"], "C0--"), ("compression", CLAY["slope"], "C3--")):
        c = CONDUCTIVITY * CLAY["v0"] * p / slope / GAMMA_WATER
        u = consolidation(grid, start, c, fine)
        axes[2].semilogx(fine[1:], u[1:] / u[0], style, label=f"radial, {what} slope: c = {c:.1e} m2/s")
        print(f"{what}: c {c:.2e} m2/s, half dissipated after {time_of(0.5, fine, u):.2e} s, 90 % after {time_of(0.1, fine, u):.2e} s")
    axes[2].semilogx(times[1:], measured[1:] / measured[0], "k-", label="mudline, wall at mid depth")
    print(f"mudline: half dissipated after {time_of(0.5, times, measured):.2e} s, 90 % after {time_of(0.1, times, measured):.2e} s")
    axes[2].set(xlabel="time since the push [s]", ylabel="excess pressure / that at the end of the push", xlim=(1e3, 3e8))
    axes[2].legend(fontsize=8)
    plt.tight_layout()
    plt.savefig(figure, dpi=80)


if __name__ == "__main__":
    main()
