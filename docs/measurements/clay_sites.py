"""Draws docs/pictures/measured_clay_sites.png and prints the table of docs/measurements/clay_sites.md.

Arguments: the program, and the table of `mudline sweep inputs/measurements/clay_sites.xml`; without it the sweep is
run, which takes some twelve minutes.
"""

import csv
import os
import subprocess
import sys
import tempfile

import numpy as np

import laboratory

RATIO, SLOPE, Q, BQ = "overconsolidation ratio [-]", "critical stress ratio [-]", "Q [-]", "B_q [-]"
EFFECTIVE = "(q_t - u2)/sigma'_v [-]"
CLAYS = {0.8985: "kaolin of the piezocone", 0.803: "Kaolin K1", 0.95: "Weald clay"}  # by critical stress ratio


def sweep():
    """{column: values} of the sweep's table, one run per row, ordered by clay and ratio."""
    with tempfile.TemporaryDirectory() as folder:
        path = sys.argv[2] if len(sys.argv) > 2 else os.path.join(folder, "clay_sites.csv")
        if len(sys.argv) <= 2:
            deck = laboratory.input_file("clay_sites.xml")
            subprocess.run([laboratory.program(), "sweep", deck, "--folder", folder], check=True)
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
    table = {name: np.array([float(row[name]) for row in rows]) for name in (RATIO, SLOPE, Q, BQ)}
    # (q_t - u2) = (q_t - sigma_v) (1 - B_q) + sigma'_v
    table[EFFECTIVE] = table[Q] * (1 - table[BQ]) + 1
    return table


def main():
    sites, runs = laboratory.measured("clay_sites.csv"), sweep()
    figure, axes = laboratory.axes(3, 11)
    between = {}  # of each quantity: logarithms of the middles of the classes, the sites' medians there
    for axis, name, top in zip(axes, (Q, BQ, EFFECTIVE), (48, 1, 22)):
        low, middle, high = (np.array([site[name.replace(" [-]", f" {share} [-]")][0] for site in sites.values()])
                             for share in (10, 50, 90))
        begin, end = (np.array([site[edge][0] for site in sites.values()])
                      for edge in ("overconsolidation ratio from [-]", "to [-]"))
        at = np.sqrt(begin * end)
        between[name] = np.log(at), middle
        axis.errorbar(at, middle, [middle - low, high - middle], [at - begin, end - at], "o", color="#5c5c5c",
                      label="31 sites: median, 80 % of the depths", capsize=2)
        for slope, colour in zip(CLAYS, laboratory.COLOURS):
            mine = np.isclose(runs[SLOPE], slope)
            axis.plot(runs[RATIO][mine], runs[name][mine], "s-", color=colour, markersize=4, label=CLAYS[slope])
        axis.set(xlabel=RATIO, ylabel=name, xscale="log", xlim=(0.8, 11), ylim=(0, top))
        axis.set_xticks([1, 2, 4, 8], ["1", "2", "4", "8"])
        axis.minorticks_off()
    for slope, clay in CLAYS.items():
        for row in np.flatnonzero(np.isclose(runs[SLOPE], slope)):
            ratio, cells = runs[RATIO][row], []
            for name, (at, middle) in between.items():
                found, median = runs[name][row], np.interp(np.log(ratio), at, middle)
                cells.append(f"{found:.2f} | {median:.2f} | {100 * (found / median - 1):+.0f} %")
            print(f"| {clay} | {ratio:.0f} | " + " | ".join(cells) + " |")
    laboratory.save(figure, "measured_clay_sites.png")


if __name__ == "__main__":
    main()
