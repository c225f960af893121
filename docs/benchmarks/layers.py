#!/usr/bin/env python3
"""A cone through layers against each layer alone and against the filter of Boulanger and DeJong (2018): table and picture.

    layers.py LAYERS.csv TOPS LEVELS PICTURE.png [ALONE.csv [OTHER_MESH.csv]]

TOPS: depths of the interfaces [m] with commas; LEVELS: resistance of each layer alone [kPa] with commas, one more; ALONE: history of the
uppermost soil alone; OTHER_MESH: history of the same run on another mesh, compared at equal depth.
"""
import csv
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

RADIUS = 0.01785
DIAMETER = 2 * RADIUS


def history(name):
    """Depth of the tip [m], its resistance over the section [kPa], all columns."""
    with open(name, newline="") as file:
        names = next(csv.reader(file))
    data = dict(zip(names, np.genfromtxt(name, delimiter=",", skip_header=1).T))
    return -data["body/cone/position y [m]"], data["contact/cone/tip reaction y [N]"] / (np.pi * RADIUS**2) * 1e-3, data


def filtered(depth, q):
    """What a cone would measure in soil whose layers alone have the resistances q at even depths, by the weights of Boulanger and DeJong
    (2018): z' = distance from the tip over the diameter, z50 = 4.2 at equal resistance (0.8 of it above the tip), m50 = 0.5, mq = 2, mz = 3."""
    result = np.empty_like(q)
    for i, at in enumerate(depth):
        z, ratio = (depth - at) / DIAMETER, q[i] / q  # of the soil at the tip over that there
        below = z >= 0
        c1 = np.where(below, 1.0, np.where(z < -4, 0.5, 1 + z / 8))
        z50 = 1 + 2 * (np.where(below, 1.0, 0.8) * 4.2 - 1) * (1 - 1 / (1 + ratio**0.5))
        weight = c1 / (1 + np.abs(z / z50) ** 3) * np.sqrt(2 / (1 + ratio**-2.0))
        result[i] = np.sum(weight * q) / np.sum(weight)
    return result


def first(depth, inside):
    """Depth from which a condition holds to the end."""
    outside = np.flatnonzero(~inside)
    return depth[0] if not outside.size else depth[outside[-1] + 1] if outside[-1] + 1 < depth.size else np.nan


def transitions(name, depth, q, tops, levels):
    """Where the change of the resistance at an interface has done 5, 50 and 95 per cent, and from where on it is within 3 per cent of the new
    layer's level, in diameters from the interface, negative above it; half of the layers on both sides is searched."""
    print(f"{name}: interface [m], 5, 50 and 95 % of the change, within 3 % of the new level [diameters from the interface]")
    middles = [tops[0] - 4 * DIAMETER, *(0.5 * (tops[1:] + tops[:-1])), depth[-1]]
    for k, top in enumerate(tops):
        span = (depth > middles[k]) & (depth < middles[k + 1])
        if depth[-1] < top + DIAMETER:
            continue
        before, after = q[span][0] if k == 0 else levels[k], levels[k + 1]  # in the uppermost layer the resistance still rises
        z, share = (depth[span] - top) / DIAMETER, (q[span] - before) / (after - before)
        marks = [first(z, share > s) for s in (0.05, 0.5, 0.95)]
        print(f"  {top:.3f}  " + "  ".join(f"{m:6.2f}" for m in marks) + f"  {first(z, np.abs(q[span] / after - 1) < 0.03):6.2f}")


def compared(depth, q, other_depth, other_q, tops):
    """Resistance on another mesh over this one's at equal depth: within a diameter of the interfaces, and farther from them in each layer."""
    z = np.arange(DIAMETER, min(depth[-1], other_depth[-1]), DIAMETER / 20)
    ratio = np.interp(z, other_depth, other_q) / np.interp(z, depth, q) - 1
    near = np.abs(z[:, None] - tops).min(axis=1) < DIAMETER
    for k in range(tops.size + 1):
        layer = (np.searchsorted(tops, z) == k) & ~near
        print(f"other mesh over this one, layer {k}: mean {ratio[layer].mean():+.4f}, from {ratio[layer].min():+.4f} to {ratio[layer].max():+.4f}")
    print(f"  within a diameter of interfaces: from {ratio[near].min():+.4f} to {ratio[near].max():+.4f}")


def main():
    name, tops, levels, picture = sys.argv[1], *(np.array([float(v) for v in a.split(",")]) for a in sys.argv[2:4]), sys.argv[4]
    depth, q, data = history(name)
    even = np.arange(-40 * DIAMETER, depth[-1] + 40 * DIAMETER, DIAMETER / 20)
    model = filtered(even, levels[np.searchsorted(tops, even)])
    for z in np.arange(0.02, depth[-1], 0.02):
        near = np.abs(depth - z) < 0.003
        print(f"{z:.2f}  {np.interp(z, depth, q):8.2f} kPa  over level {np.interp(z, depth, q) / levels[np.searchsorted(tops, z)]:.3f}"
              f"  ripple {np.std(q[near] - np.polyval(np.polyfit(depth[near], q[near], 1), depth[near])) / q[near].mean():.4f}  filter {np.interp(z, even, model):8.2f}")
    transitions("computed", depth, q, tops, levels)
    inside = (even > depth[0]) & (even < depth[-1])
    transitions("filter", even[inside], model[inside], tops, levels)
    for column in data:
        if column.startswith("balance/grains/"):
            kept = data[column][np.isfinite(data[column])]
            print(f"{column}: {kept[0]:.6g}, changes by {np.abs(kept / kept[0] - 1).max():.1e}")
        if column.startswith("mesh motion/"):
            print(f"{column}: {data[column][-1]:.3g}, largest {np.abs(data[column]).max():.3g}")
    print(f"steps {depth.size - 1}, quality above {data['mesh/quality [-]'].min():.3f}, remeshings {data['mesh/remeshings [-]'][-1]:.0f}, elements {data['mesh/elements [-]'][-1]:.0f}")
    figure, axes = plt.subplots(figsize=(5.2, 6), layout="constrained")
    axes.plot(q, depth / DIAMETER, "k", lw=1, label="mudline")
    axes.plot(model[inside], even[inside] / DIAMETER, "C0--", lw=1, label="filter of Boulanger and DeJong")
    edges = np.array([0, *tops, depth[-1]]) / DIAMETER
    axes.plot(np.repeat(levels, 2), np.repeat(edges, 2)[1:-1], "0.6", lw=1, label="each layer alone, deep")
    if len(sys.argv) > 5:
        alone = history(sys.argv[5])
        axes.plot(alone[1], alone[0] / DIAMETER, "C3:", lw=1, label="the uppermost soil alone")
    if len(sys.argv) > 6:
        other = history(sys.argv[6])
        compared(depth, q, other[0], other[1], tops)
        axes.plot(other[1], other[0] / DIAMETER, "C1--", lw=1, label="another mesh")
    axes.set(xscale="log", xlim=(0.3 * levels.min(), 1.5 * levels.max()), xlabel="resistance of the tip [kPa]", ylabel="depth of the tip / diameter")
    axes.invert_yaxis()
    axes.grid(alpha=0.3, which="both")
    axes.legend(fontsize=8)
    figure.savefig(picture, dpi=80)


if __name__ == "__main__":
    main()
