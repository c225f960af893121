#!/usr/bin/env python3
"""How smooth the pore pressures at the filters of a cone are, over the radii that it has gone.

    cone_pore_pressure.py HISTORY.csv ...     histories of runs of inputs/cpt/clay.xml

For each: u2 and its error by depth; the root mean square of u1, u2 and the resistance about their trends from eight radii on.
"""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "support"))
from mudline_case import History  # noqa: E402

RADIUS = 0.01785  # [m]
DEPTHS = (6, 8, 10, 12, 14, 16, 18, 20)  # [radii]
FIRST = 8
COLUMNS = {"q": "net cone resistance", "u1": "excess pore pressure u1", "u2": "excess pore pressure u2", "u2 error": "excess pore pressure u2 error"}


def about_trend(depth, values):
    """Root mean square and largest distance of values from a cubic in the depth, over their mean; on even steps of depth."""
    even = np.linspace(depth[0], depth[-1], 400)
    shown = np.interp(even, depth, values)
    off = shown - np.polyval(np.polyfit(even - even.mean(), shown, 3), even - even.mean())
    return np.sqrt(np.mean(off ** 2)) / abs(shown.mean()), np.abs(off).max() / abs(shown.mean())


def main(paths):
    for path in paths:
        history = History(path)
        depth = -history["body/cone/position y"] / RADIUS
        values = {name: history[f"cone/sounding/{column}"] for name, column in COLUMNS.items()}
        print(f"{pathlib.Path(path).stem}: {len(depth)} rows to {depth[-1]:.1f} radii, smallest quality {history['mesh/quality'].min():.2f}")
        for wanted in DEPTHS:
            if wanted <= depth[-1] + 0.01:
                at = {name: np.interp(wanted, depth, column) / 1e3 for name, column in values.items()}
                print(f"  {wanted:2d} radii: q {at['q']:6.1f}, u1 {at['u1']:6.1f}, u2 {at['u2']:6.1f} +- {at['u2 error']:.2f} kPa")
        far = depth >= FIRST
        for name in ("q", "u1", "u2"):
            if depth[-1] > FIRST + 1:
                rms, most = about_trend(depth[far], values[name][far])
                print(f"  {name} about its trend from {FIRST} radii: rms {100 * rms:.2f} %, at most {100 * most:.2f} %")


if __name__ == "__main__":
    main(sys.argv[1:])
