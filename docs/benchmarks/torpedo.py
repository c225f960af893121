#!/usr/bin/env python3
"""Torpedo anchors against a model of one body, how fast their pore pressures dissipate, and a picture of one: figures and table.

    torpedo.py FALLS CLAY FIGURE.png PICTURE.png     FALLS: folder of `mudline sweep inputs/torpedo/impact_velocity.xml`, CLAY: results of
                                                     inputs/torpedo/clay.xml without ending
    torpedo.py CLAY PICTURE.png                      the picture alone; the anchor must rest, the set-up may be missing
"""
import pathlib
import sys

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

for folder in ("support", "verification"):
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / folder))
from mudline_case import History  # noqa: E402
from references import falling_body  # noqa: E402

MASS, DIAMETER, LENGTH = 98e3, 1.07, 15.0
SECTION = np.pi * DIAMETER ** 2 / 4
BEARING, ADHESION, DRAG = 12.0, 0.4, 0.63  # of the model
SPEEDS = (5, 10, 15, 20, 25)
DAY = 86400.0


def rate_none(speed, strength):
    return 1.0


def rate_power(speed, strength):
    return max(1.0, speed / DIAMETER / 0.1) ** 0.07


def rate_true(speed, strength):
    return 4 / (1 + 1 / np.sqrt(1915 * max(speed, 0.0) / (strength * DIAMETER) + 0.11))


RATES = {"no rate effect": rate_none, "power law, as the deck": rate_power, "True's": rate_true}


def one_body(speed, rate):
    """Time, depth of the tip and velocity of a body that clay of 5 kPa + 2 kPa/m stops (True 1976): end bearing, friction on the buried shaft,
    drag of the soil; weight in water, buoyancy of the displaced soil."""

    def force(z, v):
        buried, top = min(z, LENGTH), max(z - LENGTH, 0.0)
        at_tip, mean = 5e3 + 2e3 * z, 5e3 + 1e3 * (z + top)
        resistance = rate(v, at_tip) * BEARING * at_tip * SECTION + rate(v, mean) * ADHESION * mean * np.pi * DIAMETER * buried
        weight = 9.81 * (MASS - 1025 * SECTION * LENGTH) - 6e3 * SECTION * buried
        return weight - resistance - 0.5 * 1600 * DRAG * SECTION * v * abs(v)

    return falling_body.stopped(0.0, speed, MASS, force)


def even_deceleration(time, velocity):
    """At sixty even moments."""
    even = np.linspace(time[0], time[-1], 60)
    return even, -np.gradient(np.interp(even, time, velocity), even)


def fall(history):
    """Depth of the tip, velocity and deceleration down to the first rest, the impact's first metre left out."""
    time, depth, velocity = history.time, -history["body/anchor/position y"], -history["body/anchor/velocity y"]
    moving = (time > 0) & (np.arange(len(time)) <= np.argmax(depth))
    time, depth, velocity = time[moving], depth[moving], velocity[moving]
    even, deceleration = even_deceleration(time, velocity)
    return depth, velocity, np.interp(even, time, depth), deceleration


def dissipation(file, history):
    """Time since rest and the mean excess pressure within one diameter of the shaft's middle, over its largest."""
    depth = -history["body/anchor/position y"]
    rest, middle = history.time[np.argmax(depth)], depth.max() - 0.5 * LENGTH
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


def draw(file, history, picture):
    """Excess pore pressure at three depths, velocity and resistance over depth."""
    figure, axes = plt.subplots(1, 5, figsize=(12.5, 5.6), sharey=True, layout="constrained", gridspec_kw=dict(width_ratios=(1, 1, 1, 1.4, 1.4)))
    names = sorted(file["steps"])
    tips = np.array([file["steps"][name]["bodies/anchor/coordinates"][:, 1].min() for name in names])
    for panel, depth in zip(axes, (7.0, 18.0, -tips.min())):
        step = file["steps"][names[int(np.argmin(np.abs(tips + depth)))]]
        x, excess = step["coordinates"][:, :2], step["nodal/excess_pore_pressure"][()] * 1e-3
        mesh = step["mesh"] if "mesh" in step else file["mesh"]
        corners = mesh["topology"][()].reshape(-1, 7)[:, 1:4].astype(int)
        colours = panel.tripcolor(x[:, 0], x[:, 1], corners, excess, shading="gouraud", vmin=-50, vmax=400, cmap="RdYlBu_r")
        panel.triplot(x[:, 0], x[:, 1], corners, lw=0.25, color="k")
        contour = step["bodies/anchor/coordinates"][:, :2]
        panel.fill(contour[:, 0], contour[:, 1], color="0.7", ec="k", lw=1)
        panel.set(xlim=(0, 7), xlabel="r [m]", title=f"{step.attrs['time']:.2f} s")
    figure.colorbar(colours, ax=list(axes), location="bottom", shrink=0.35, anchor=(0.1, 0), label="excess pore pressure [kPa]")
    end = np.argmin(history["body/anchor/position y"]) + 1
    depth = -history["body/anchor/position y"][:end]
    deep = depth > depth[0] + 0.5  # without the first touch
    axes[3].plot(-history["body/anchor/velocity y"][:end][deep], -depth[deep], "k")
    axes[3].set_xlabel("velocity [m/s]")
    axes[4].plot(history["contact/anchor/reaction y"][:end][deep] * 1e-3, -depth[deep], "k", label="resistance")
    axes[4].plot(history["contact/anchor/friction y"][:end][deep] * 1e-3, -depth[deep], "r", label="of it friction")
    axes[4].set_xlabel("force [kN]")
    axes[4].legend(fontsize=8)
    axes[0].set(ylim=(1.05 * tips.min(), 5), ylabel="height [m]")
    for panel in axes[3:]:
        panel.grid(alpha=0.3)
    figure.savefig(picture, dpi=80, bbox_inches="tight")


def read(stem):
    return h5py.File(stem + ".h5", "r"), History(stem + ".csv")


def main():
    if len(sys.argv) == 3:
        draw(*read(sys.argv[1]), sys.argv[2])
        return
    folder, stem, figure, picture = pathlib.Path(sys.argv[1]), *sys.argv[2:5]
    falls, axes = plt.subplots(1, 4, figsize=(15, 4.4))
    print("impact [m/s]  depth [m]  one body: no rate, power law, True   mean deceleration while it slows down [m/s2]  its spread  that of one body  energy error / first kinetic energy")
    depths = []
    for i, speed in enumerate(SPEEDS):
        history = History(folder / f"{i + 1:02d}" / "impact_velocity.csv")
        depth, velocity, at, deceleration = fall(history)
        axes[0].plot(velocity, depth, f"C{i}", label=f"{speed} m/s")
        models = [one_body(speed, rate) for rate in RATES.values()]
        model_time, model_depth, model_velocity = models[list(RATES.values()).index(rate_power)]
        axes[0].plot(model_velocity, model_depth, f"C{i}--", lw=0.8)
        axes[1].plot(deceleration, at, f"C{i}", label=f"{speed} m/s")
        stops = [z[-1] for _, z, _ in models]
        depths.append([depth[-1]] + stops)
        _, model = even_deceleration(model_time, model_velocity)
        values, model = (a[a > 0] for a in (deceleration, model))  # while it slows down
        print(f"{speed:12} {depth[-1]:10.1f}  {stops[0]:8.1f} {stops[1]:8.1f} {stops[2]:8.1f} {values.mean():24.2f} {values.std() / values.mean():12.2f} {model.std() / model.mean():12.2f}"
              f"{np.abs(history['balance/energy/error']).max() / (0.5 * MASS * speed ** 2):20.1e}")
    for panel, label in zip(axes, ("velocity [m/s]", "deceleration [m/s2]")):
        panel.invert_yaxis()
        panel.set_xlabel(label)
    axes[0].set_ylabel("depth of the tip [m]")
    axes[0].set_title("dashed: one body, power law", fontsize=9)
    axes[1].legend(fontsize=8, loc="lower left")
    depths = np.array(depths)
    axes[2].plot(SPEEDS, depths[:, 0], "ko-", label="mudline")
    for k, name in enumerate(RATES):
        axes[2].plot(SPEEDS, depths[:, k + 1], "--", lw=1, label="one body, " + name)
    axes[2].set_ylim(62, 16)
    axes[2].set(xlabel="impact velocity [m/s]", ylabel="final depth of the tip [m]")
    axes[2].legend(fontsize=8, loc="lower left")
    file, clay = read(stem)
    times, share = dissipation(file, clay)
    draw(file, clay, picture)
    axes[3].semilogx(np.maximum(times, 1) / DAY, share, "k.-")
    axes[3].set(xlabel="time since rest [days]", ylabel="excess pressure near the shaft / its largest", ylim=(0, 1.05))
    falling = np.argmax(share)
    tenth = np.interp(-0.1, -share[falling:], times[falling:])
    print(f"clay.xml: 90 % dissipated within one diameter after {tenth / DAY:.0f} days")
    falls.tight_layout()
    falls.savefig(figure, dpi=80)


if __name__ == "__main__":
    main()
