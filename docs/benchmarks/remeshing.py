#!/usr/bin/env python3
"""The wall of a torpedo anchor: how smooth friction, reaction and the pressures at the vertices of the shaft are, and how two runs compare.

    remeshing.py SINCE RESULT [RESULT ...]     results without ending; SINCE: depth of the tip [m] from which the forces are judged
"""
import pathlib
import sys
import xml.etree.ElementTree as ElementTree

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "support"))
from mudline_case import History  # noqa: E402

SLOWEST = 2.0  # [m/s]: below it the anchor comes to rest and forces fall
DEGREE = 4     # of the trend


def contour(file):
    """Diameter, and lengths of the tip, of the tail and of the whole anchor [m], of the deck that the results keep."""
    deck = ElementTree.fromstring(file["metadata/deck"][()])
    of = {entry.get("name"): entry.get("value") for entry in deck.find(".//ParameterList[@name='contour']")}
    return [float(of[name]) for name in ("diameter", "tip length", "tail length", "length")]


def forces(stem, since):
    """Depth of the tip [m] while the anchor goes down, friction and reaction [N]."""
    history = History(stem + ".csv")
    end = np.argmin(history["body/anchor/position y"]) + 1
    depth, speed = -history["body/anchor/position y"][:end], -history["body/anchor/velocity y"][:end]
    taken = (depth > since) & (speed > SLOWEST)
    return depth[taken], {name: history[f"contact/anchor/{name} y"][:end][taken] for name in ("friction", "reaction")}, history, end


def ripple(depth, force):
    """Deviation from a polynomial over the depth, over the mean: rms and largest; at even depths, so that short steps do not weigh more."""
    even = np.linspace(depth[0], depth[-1], 2000)
    values = np.interp(even, depth, force)
    centre = even - even.mean()
    off = (values - np.polyval(np.polyfit(centre, values, DEGREE), centre)) / values.mean()
    return np.sqrt(np.mean(off**2)), np.abs(off).max()


def wall(file, step, diameter, tip_length, tail, length):
    """Vertices on the straight shaft, from the shoulder up: height over the tip [m], contact pressure and excess pore pressure [Pa]."""
    x, tip = step["coordinates"][:, :2], step["bodies/anchor/coordinates"][:, 1].min()
    corners = np.unique((step if "mesh" in step else file)["mesh/topology"][()].reshape(-1, 7)[:, 1:4].astype(int))
    pressure = step["nodal/contact_pressure_anchor"][()]
    above = x[:, 1] - tip
    mine = corners[(pressure[corners] > 0) & (np.abs(x[corners, 0] - 0.5 * diameter) < 0.03 * diameter)
                   & (above[corners] > tip_length) & (above[corners] < length - tail)]
    mine = mine[np.argsort(above[mine])]
    excess = step["nodal/excess_pore_pressure"][()] if "nodal/excess_pore_pressure" in step else np.zeros_like(pressure)
    return above[mine], pressure[mine], excess[mine]


def off_neighbours(values):
    """Deviation of each value from the mean of its two neighbours, over that mean."""
    means = 0.5 * (values[2:] + values[:-2])
    return np.abs(values[1:-1] - means) / np.maximum(np.abs(means), 1e-300)


def main():
    since, stems = float(sys.argv[1]), sys.argv[2:]
    runs = [forces(stem, since) for stem in stems]
    for stem, (depth, named, history, end) in zip(stems, runs):
        print(f"{stem}: {end} steps to {-history['body/anchor/position y'].min():.3f} m, {history['mesh/remeshings'][end - 1]:.0f} meshes anew, "
              f"{history['mesh/elements'][0]:.0f} to {history['mesh/elements'][end - 1]:.0f} elements, quality above {history['mesh/quality'][:end].min():.3f}")
        for name, force in named.items():
            rms, largest = ripple(depth, force)
            print(f"  {name} from {depth[0]:.1f} to {depth[-1]:.1f} m about its trend: rms {rms:.4f}, largest {largest:.4f} of its mean {force.mean() * 1e-3:.0f} kN")
        for column in ("mesh motion/change of solid", "mesh motion/change of water", "balance/water/error"):
            if column in history.columns:
                print(f"  {column}: {np.abs(history[column][:end]).max():.1e}")
        with h5py.File(stem + ".h5", "r") as file:
            shape = contour(file)
            diameter, tip_length = shape[:2]
            spoken = []
            for name in sorted(file["steps"]):
                step = file["steps"][name]
                if not 0 < step.attrs["time"] <= history.time[end - 1]:
                    continue
                height, contact, excess = wall(file, step, *shape)
                if height.size < 5 or height[-1] - height[0] < 3 * diameter:
                    continue
                inner = (height > tip_length + diameter) & (height < height[-1] - diameter)
                spoken.append((step.attrs["time"], height.size, diameter / np.diff(height).max(), off_neighbours(contact[inner]), off_neighbours(excess[inner]), height, contact, excess))
            for time, count, dense, contact, excess, *_ in spoken:
                if contact.size:
                    print(f"  {time:.2f} s: {count} vertices, longest side 1/{dense:.1f} diameter; contact pressure off its neighbours' mean by {contact.max():.3f} at most "
                          f"(median {np.median(contact):.4f}), excess pore pressure {excess.max():.3f} ({np.median(excess):.4f})")
            if spoken:
                *_, height, contact, excess = spoken[-1]
                print("  at the last: height over the tip [m], contact pressure, excess pore pressure [kPa]: "
                      + "; ".join(f"{h:.2f} {c * 1e-3:.0f} {e * 1e-3:.0f}" for h, c, e in zip(height, contact, excess)))
    for stem, (depth, named, *_) in list(zip(stems, runs))[1:]:
        first, other = runs[0][0], depth
        even = np.linspace(max(first[0], other[0]), min(first[-1], other[-1]), 200)
        for name in named:
            ratio = np.interp(even, other, named[name]) / np.interp(even, first, runs[0][1][name])
            print(f"{stem} over {stems[0]}, {name} at equal depth: {ratio.min():.4f} to {ratio.max():.4f}, mean {ratio.mean():.4f}")


if __name__ == "__main__":
    main()
