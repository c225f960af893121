"""Draws the ground over the depth.

Run by `mudline point --profile --png FILE` as: mudline_report.py --ground FILE ground.csv
"""

import csv
from pathlib import Path

import numpy as np

import report_pictures as pictures
from report_result import MudlineError

TOGETHER = ("vertical effective stress", "horizontal effective stress", "pore pressure")
OWN = (
    "undrained strength",
    "K0",
    "overconsolidation ratio",
    "strength ratio",
    "rigidity index",
    "saturation",
    "void ratio",
    "shear modulus",
    "hydraulic conductivity",
)
MOST = 8  # panels


def read(path):
    """{name: (unit, values)}; a value that a law does not have is NaN."""
    with open(path, newline="", encoding="utf-8") as file:
        head, *rows = list(csv.reader(file))
    columns = {}
    for i, title in enumerate(head[:-1]):
        name, unit = title[:-1].rsplit(" [", 1)
        columns[name] = (unit, np.array([float(row[i]) if row[i] else np.nan for row in rows]))
    if "depth" not in columns or not rows:
        raise MudlineError(f"{path}: not a profile of `mudline point --profile`")
    return columns


def largest(column):
    return np.nanmax(np.abs(column[1]))


def span(column):
    return np.nanmax(column[1]) - np.nanmin(column[1])


def readable(unit, size):
    """(factor, unit) of an axis; a number that is far from 1 in its unit has a power of ten before it."""
    factor, unit = pictures.scaled(unit, size)
    if size == 0 or 1e-2 <= size * factor < 1e5:
        return factor, unit
    exponent = int(np.floor(np.log10(size * factor)))
    return factor * 10.0**-exponent, f"1e{exponent}" if unit == "-" else f"1e{exponent} {unit}"


def panels(columns):
    """Lists of names that share a panel: stresses, then what varies over the depth, then the rest."""
    stresses = [name for name in TOGETHER if name in columns]
    known = [name for name in OWN if name in columns]
    placed = TOGETHER + OWN + ("depth", "height")
    others = [name for name in columns if name not in placed and largest(columns[name]) > 0]
    varies = [name for name in known + others if span(columns[name]) > 1e-9 * largest(columns[name])]
    rest = [name for name in known if name not in varies and np.isfinite(columns[name][1]).any()]
    return [stresses] + [[name] for name in (varies + rest)[: MOST - 1]]


def figure_of(columns):
    groups = panels(columns)
    depth = columns["depth"][1]
    down = -(-len(groups) // 4)
    across = -(-len(groups) // down)
    with pictures.plt.rc_context(pictures.STYLE):
        figure, axes = pictures.plt.subplots(
            down, across, figsize=(2.5 * across, 3.8 * down), constrained_layout=True, squeeze=False, sharey=True
        )
        for ax in axes.flat[len(groups) :]:
            ax.set_visible(False)
        for ax, names in zip(axes.flat, groups):
            factor, unit = readable(columns[names[0]][0], max(largest(columns[name]) for name in names))
            for name in names:
                ax.plot(columns[name][1] * factor, depth, label=name)
            title = "stress" if len(names) > 1 else names[0]
            ax.set_xlabel(title if unit == "-" else f"{title} [{unit}]")
            low, high = ax.get_xlim()
            constant = high - low < 0.12 * high  # matplotlib shows a tenth around a constant
            if constant:
                ax.set_xlim(0, 1.4 * high)
            elif 0 < low < 0.5 * high:
                ax.set_xlim(left=0)
            ax.xaxis.set_major_locator(pictures.ticks(4))
            if len(names) > 1:
                ax.legend(fontsize=7)
        for ax in axes[:, 0]:
            ax.set_ylabel("depth [m]")
        axes[0, 0].invert_yaxis()
    return figure


def draw(arguments):
    """Writes the PNG file."""
    target, path = arguments
    figure = figure_of(read(path))
    Path(target).parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(target, dpi=160, format="png", facecolor="white")
    pictures.plt.close(figure)
    return target
