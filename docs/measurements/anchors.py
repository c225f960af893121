"""Draws docs/pictures/measured_anchors.png and prints the depths of docs/measurements/anchors.md, of the runs that
docs/benchmarks/torpedo.md tells (mudline sweep inputs/torpedo/impact_velocity.xml)."""

import os
import re

import laboratory

LENGTH = 15.0  # [m] of the anchor of the sweep
# tip embedment over length; impact velocity [m/s] where it is told
MEASURED = {"no flukes, centrifuge": ((2.0, 3.0), (27, 30)), "field, 1:20": ((1.5, 2.6), None),
            "plate anchor, centrifuge": ((1.6, 2.8), None), "fish anchor, field, 1:15": ((1.17, 2.40), (5.89, 9.55))}


def computed():
    """[(impact velocity [m/s], depth of the tip [m])] of the sweep."""
    with open(os.path.join(laboratory.TOP, "docs", "benchmarks", "torpedo.md"), encoding="utf-8") as page:
        rows = re.findall(r"^\| (\d+) \| ([\d.]+) \| [\d.]+ \|", page.read(), flags=re.M)
    return [(float(speed), float(depth)) for speed, depth in rows]


def main():
    figure, axis = laboratory.axes(1, 6)
    for (name, ((low, high), speeds)), colour in zip(MEASURED.items(), laboratory.COLOURS[1:]):
        if speeds:
            axis.fill_between(speeds, low, high, color=colour, alpha=0.35, label=name)
        else:
            axis.axhspan(low, high, color=colour, alpha=0.12, label=name + " (velocity not told)")
    points = computed()
    for speed, depth in points:
        print(f"{speed:g} m/s: {depth / LENGTH:.2f} lengths")
    speeds, depths = zip(*points)
    axis.plot(speeds, [depth / LENGTH for depth in depths], "o-", color=laboratory.COLOURS[0],
              label="computed, 98 t, s_u = 5 kPa + 2 kPa/m")
    axis.set(xlabel="impact velocity [m/s]", ylabel="depth of the tip [anchor lengths]", xlim=(0, 32), ylim=(3.5, 0))
    laboratory.save(figure, "measured_anchors.png")


if __name__ == "__main__":
    main()
