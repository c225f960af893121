#!/usr/bin/env python3
"""Torpedo anchors against a model of one body, and how fast their pore pressures dissipate: figure and table.

    torpedo.py FALLS CLAY FIGURE.png     FALLS: folder of `mudline sweep inputs/torpedo/impact_velocity.xml`, CLAY: results of inputs/torpedo/clay.xml
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

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tests" / "support"))
from mudline_case import History  # noqa: E402

MASS, DIAMETER, LENGTH = 98e3, 1.07, 15.0
SECTION = np.pi * DIAMETER ** 2 / 4
SPEEDS = (5, 10, 15, 20, 25)
DAY, YEAR = 86400.0, 365.25 * 86400.0


def rate_none(speed, strength):
    return 1.0


def rate_power(speed, strength):
    return max(1.0, speed / DIAMETER / 0.1) ** 0.07


def rate_true(speed, strength):
    return 4 / (1 + 1 / np.sqrt(1915 * max(speed, 0.0) / (strength * DIAMETER) + 0.11))


RATES = {"no rate effect": rate_none, "power law, as the deck": rate_power, "True's": rate_true}


def one_body(speed, rate, start=0.0, alpha=0.4, factor=12.0, drag=0.63):
    """Depth of the tip and velocity, of a body that clay of 5 kPa + 2 kPa/m stops (True 1976): end bearing, friction on the buried shaft,
    drag of the soil; weight in water, buoyancy of the displaced soil."""

    def slope(_, state):
        z, v = state
        buried, top = min(z, LENGTH), max(z - LENGTH, 0.0)
        at_tip, mean = 5e3 + 2e3 * z, 5e3 + 1e3 * (z + top)
        resistance = rate(v, at_tip) * factor * at_tip * SECTION + rate(v, mean) * alpha * mean * np.pi * DIAMETER * buried
        weight = 9.81 * (MASS - 1025 * SECTION * LENGTH) - 6e3 * SECTION * buried
        return [v, (weight - resistance - 0.5 * 1600 * drag * SECTION * v * abs(v)) / MASS]

    def stops(_, state):
        return state[1]

    stops.terminal, stops.direction = True, -1
    return solve_ivp(slope, (0, 60), [start, speed], events=stops, rtol=1e-8, atol=1e-8, max_step=0.02).y


def fall(history):
    """Depth of the tip, velocity and deceleration down to the first rest, the impact's first metre left out."""
    time, depth, velocity = history.time, -history["body/anchor/position y"], -history["body/anchor/velocity y"]
    moving = (time > 0) & (depth <= depth.max()) & (np.arange(len(time)) <= np.argmax(depth))
    time, depth, velocity = time[moving], depth[moving], velocity[moving]
    even = np.linspace(time[0], time[-1], 60)
    smooth = np.interp(even, time, velocity)
    return depth, velocity, np.interp(even, time, depth), -np.gradient(smooth, even)


def dissipation(file, history):
    """Time since rest and the mean excess pressure within one diameter of the shaft's middle, over its largest."""
    rest = history.time[np.argmax(-history["body/anchor/position y"])]
    tip = np.max(-history["body/anchor/position y"])
    middle = tip - 0.5 * LENGTH
    times, means = [], []
    for name in sorted(file["steps"]):
        step = file["steps"][name]
        time = step.attrs["time"]
        if time < rest:
            continue
        x, excess = step["coordinates"][:, :2], step["nodal/excess_pore_pressure"][()]
        near = (x[:, 0] < 0.5 * DIAMETER + DIAMETER) & (np.abs(x[:, 1] + middle) < 2)
        times.append(time - rest)
        means.append(excess[near].mean())
        if time > rest + 0.9 * 3e8:
            break
    return np.array(times), np.array(means) / max(means)


def main():
    folder, stem, figure = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3]
    _, axes = plt.subplots(1, 4, figsize=(15, 4.4))
    print("impact [m/s]  depth [m]  one body: no rate, power law, True   mean deceleration while it slows down [m/s2]  its spread")
    depths = []
    for i, speed in enumerate(SPEEDS):
        history = History(folder / f"{i + 1:02d}" / "impact_velocity.csv")
        depth, velocity, at, deceleration = fall(history)
        axes[0].plot(velocity, depth, f"C{i}", label=f"{speed} m/s")
        axes[0].plot(*one_body(speed, rate_power)[::-1], f"C{i}--", lw=0.8)
        axes[1].plot(deceleration, at, f"C{i}")
        slowing = deceleration > 0
        stops = [one_body(speed, rate)[0][-1] for rate in RATES.values()]
        depths.append([depth[-1]] + stops)
        values = deceleration[slowing]
        print(f"{speed:12} {depth[-1]:10.1f}  {stops[0]:8.1f} {stops[1]:8.1f} {stops[2]:8.1f} {values.mean():24.2f} {values.std() / values.mean():12.2f}")
    for panel, label in zip(axes, ("velocity [m/s]", "deceleration [m/s2]")):
        panel.invert_yaxis()
        panel.set_xlabel(label)
    axes[0].set_ylabel("depth of the tip [m]")
    axes[0].legend(fontsize=8, title="dashed: one body, power law", title_fontsize=8)
    depths = np.array(depths)
    axes[2].plot(SPEEDS, depths[:, 0], "ko-", label="mudline")
    for k, name in enumerate(RATES):
        axes[2].plot(SPEEDS, depths[:, k + 1], "--", lw=1, label="one body, " + name)
    axes[2].invert_yaxis()
    axes[2].set(xlabel="impact velocity [m/s]", ylabel="final depth of the tip [m]")
    axes[2].legend(fontsize=8)
    with h5py.File(stem + ".h5", "r") as file:
        times, share = dissipation(file, History(stem + ".csv"))
    axes[3].semilogx(np.maximum(times, 1) / DAY, share, "k.-")
    axes[3].set(xlabel="time since rest [days]", ylabel="mean excess pressure within a diameter of the shaft, over its largest", ylim=(0, 1.05))
    axes[3].yaxis.label.set_size(8)
    tenth = np.interp(-0.1, -share[np.argmax(share):], times[np.argmax(share):])
    print(f"clay.xml: 90 % dissipated within one diameter after {tenth / DAY:.0f} days")
    plt.tight_layout()
    plt.savefig(figure, dpi=80)


if __name__ == "__main__":
    main()
