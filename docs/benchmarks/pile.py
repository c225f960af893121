#!/usr/bin/env python3
"""The README's first picture: excess pore pressure around a pushed pile at three depths, and its resistance.

    pile.py RESULTS/clay PICTURE.png     after `mudline run inputs/pile/clay.xml`: its results without ending
"""
import pathlib
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
from mudline import Result  # noqa: E402

DEPTHS = (1.2, 3.0, 5.0)  # of the foot [diameters]
KPA = 1e-3


def contour(fields, step):
    """The outline of the pile in an output [m]."""
    (outline,) = fields.bodies(step).values()
    return outline


def excess_pressure(fields, step):
    """At the nodes of an output [kPa]."""
    return fields.fields(step)["excess pore pressure"].values * KPA


def draw_field(panel, fields, step, scale):
    """Excess pore pressure with the mesh, and the pile. Returns the colours."""
    mesh, (x, y) = fields.mesh(step), fields.coordinates(step).T
    corners = mesh["topology"][:].reshape(-1, 7)[:, 1:4].astype(int)
    colours = panel.tripcolor(x, y, corners, excess_pressure(fields, step), shading="gouraud",
                              vmin=-scale, vmax=scale, cmap="RdBu_r")
    panel.triplot(x, y, corners, lw=0.25, color="k")
    panel.fill(*contour(fields, step).T, color="0.75", ec="k", lw=1)
    return colours


def main():
    stem, picture = sys.argv[1:3]
    result = Result(stem)
    fields, history = result.fields, result.history
    pushed = [step for step, stage in enumerate(fields.stages) if stage == "push"]
    feet = -np.array([contour(fields, step)[:, 1].min() for step in pushed])
    diameter = 2 * contour(fields, 0)[:, 0].max()
    drawn = [pushed[int(np.argmin(np.abs(feet - depth * diameter)))] for depth in DEPTHS]
    scale = 10 * np.ceil(0.1 * max(np.abs(excess_pressure(fields, step)).max() for step in drawn))
    figure, axes = plt.subplots(1, 4, figsize=(10, 5.2), layout="constrained",
                                gridspec_kw={"width_ratios": (1, 1, 1, 1.35)})
    for panel, depth, step in zip(axes, DEPTHS, drawn):
        colours = draw_field(panel, fields, step, scale)
        panel.set(xlim=(0, 2.5 * diameter), ylim=(-6.8 * diameter, 0.6 * diameter), aspect="equal", xlabel="r [m]",
                  title=f"{depth:g} diameters")
        panel.title.set_fontsize(10)
    for panel in axes[1:3]:
        panel.set_yticklabels([])
    axes[0].set_ylabel("height [m]")
    figure.colorbar(colours, ax=list(axes[:3]), location="bottom", shrink=0.6, label="excess pore pressure [kPa]")
    push = history["time"] <= fields.times[pushed[-1]]
    depth = -history["body/pile/displacement y"][push] / diameter
    for column, style, label in (("reaction y", "k", "resistance"), ("shaft reaction y", "C3", "of it shaft friction")):
        axes[3].plot(history[f"contact/pile/{column}"][push] * KPA, depth, style, label=label)
    axes[3].invert_yaxis()
    axes[3].set(xlabel="force [kN]", ylabel="depth of the foot [diameters]")
    axes[3].grid(alpha=0.3)
    axes[3].legend(fontsize=8)
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main()
