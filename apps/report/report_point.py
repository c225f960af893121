"""Draws tests of `mudline point`: q over p', q and u over axial (or shear) strain, e over log p'.

Run by `mudline point --png FILE` as: mudline_report.py --point FILE test.csv [test.csv ...]
"""

import itertools
from pathlib import Path

import numpy as np
from matplotlib.ticker import LogFormatter

import report_pictures as pictures
from report_result import History, MudlineError


def is_point(history):
    """True when the history is that of a material point."""
    needed = (("", "axial strain", "-"), ("", "stress difference", "Pa"))
    return all(column in history.columns for column in needed)


class PointCurves:
    """What the four plots need, in kPa and percent."""

    def __init__(self, history):
        columns = {name: values for (_, name, _), values in history.columns.items()}
        self.mean = columns["mean effective stress"] * 1e-3
        self.void_ratio = columns["void ratio"]
        self.shear = np.ptp(columns["shear strain xy"]) > 2 * np.ptp(columns["axial strain"])
        self.strain = 100 * columns["shear strain xy" if self.shear else "axial strain"]
        radial = columns["effective stress zz"] - columns["effective stress xx"]
        # Where two stresses are equal their distance from the third has a sign: extension then lies below.
        cylindrical = np.abs(radial).max() <= 1e-6 * np.abs(columns["mean effective stress"]).max()
        shearing = np.ptp(columns["shear stress xy"]) > 0
        signed = cylindrical and not shearing
        self.deviator = columns["stress difference" if signed else "deviatoric stress"] * 1e-3
        pressure = columns.get("excess pore pressure")
        self.pressure = None if pressure is None else pressure * 1e-3


def point_figure(tests):
    """Four plots of {name: history}."""
    with pictures.plt.rc_context(pictures.STYLE):
        figure, axes = pictures.plt.subplots(2, 2, figsize=(9.2, 7.2), constrained_layout=True)
        curves = {name: PointCurves(history) for name, history in tests.items()}
        kinds = {c.shear for c in curves.values()}
        strain = {frozenset([True]): "shear strain [%]", frozenset([False]): "axial strain [%]"}.get(
            frozenset(kinds), "axial or shear strain [%]"
        )
        for style, (name, c) in zip(itertools.cycle(pictures.plt.rcParams["axes.prop_cycle"]), curves.items()):
            pairs = [(c.mean, c.deviator), (c.strain, c.deviator), (c.mean, c.void_ratio), (c.strain, c.pressure)]
            for ax, (x, y) in zip(axes.flat, pairs):
                if y is None:  # drained
                    continue
                ax.plot(x, y, label=name, **style)
                ax.plot(x[:1], y[:1], "o", markersize=3.5, color=style["color"])
        labels = [
            ("p' [kPa]", "q [kPa]"),
            (strain, "q [kPa]"),
            ("p' [kPa], logarithmic", "e [-]"),
            (strain, "excess pore pressure [kPa]"),
        ]
        for ax, (x, y) in zip(axes.flat, labels):
            ax.set_xlabel(x)
            ax.set_ylabel(y)
            ax.yaxis.set_major_locator(pictures.ticks(6))
        axes[1, 0].set_xscale("log")
        for axis_formatter in (axes[1, 0].xaxis.set_major_formatter, axes[1, 0].xaxis.set_minor_formatter):
            axis_formatter(LogFormatter(labelOnlyBase=False, minor_thresholds=(2, 0.8)))
        if all(c.pressure is None for c in curves.values()):
            axes[1, 1].text(0.5, 0.5, "drained", transform=axes[1, 1].transAxes, ha="center", color="#777777")
        if len(curves) > 1:
            axes[0, 0].legend(fontsize=7.5)
        else:
            figure.suptitle(next(iter(curves)))
    return figure


def names_of(paths):
    """File names without what they have in common at their beginning: the deck's name."""
    stems = [Path(path).stem for path in paths]
    shared = 0
    if len(stems) > 1:
        while all(len(s) > shared and s[shared] == stems[0][shared] for s in stems):
            shared += 1
        shared = stems[0][:shared].rfind("_") + 1
    return [stem[shared:].replace("_", " ") for stem in stems]


def draw(arguments):
    """Writes the PNG file."""
    target, *paths = arguments
    tests = {name: History(path) for name, path in zip(names_of(paths), paths)}
    for path, history in zip(paths, tests.values()):
        if not is_point(history):
            raise MudlineError(f"{path}: not a test of `mudline point`")
    Path(target).parent.mkdir(parents=True, exist_ok=True)
    figure = point_figure(tests)
    figure.savefig(target, dpi=160, format="png", facecolor="white")
    pictures.plt.close(figure)
    return target
