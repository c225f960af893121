"""Draws docs/pictures/measured_fall_cone.png and prints the tables of docs/measurements/fall_cone.md.

Arguments: the program, and a folder of histories; runs whose history is there are not repeated. A run takes about
half a minute.
"""

import os
import subprocess
import sys
import tempfile

import numpy as np

import laboratory

sys.path.insert(0, os.path.join(laboratory.TOP, "tests", "support"))
from mudline_case import History  # noqa: E402

STRENGTH, GRAVITY, TIP = 1.57e3, 9.81, 0.5e-3  # [Pa], [m/s2], [m] as in the deck
MASS = {30: 0.08, 60: 0.06}  # [kg] of the cone with this apex angle [degrees]
BAND, USUAL = (0.5, 1.33), 0.8  # [-] cone factors of the 30 degree cone in the literature; the one often taken
SIZES = (1.4, 1.0, 0.5)  # [mm] of the sides along the cone
FROM, TO = 0.016, 0.03  # [m] of depth, between which the resistance is compared
# apex angle [degrees], rate law, roughness: shear stress on the cone over s_u
CASES = ((30, False, 0), (30, True, 0), (30, True, 0.5), (30, True, 1), (60, True, 0.5))


def run(program, folder, angle=30, rate=False, roughness=0, size=1.0):
    """The history of one fall; `size` in mm."""
    name = f"{angle}_{'rate' if rate else 'still'}_{roughness:g}_{size:g}"
    path = os.path.join(folder, name + ".csv")
    if not os.path.exists(path):
        decks = ["fall_cone.xml"] + (["fall_cone_rate.xml"] if rate else [])
        changes = {"variables/angle": angle, "variables/mass": MASS[angle], "variables/roughness": roughness,
                   "variables/size": size / 1e3, "output/folder": folder, "output/name": name}
        settings = [word for entry, value in changes.items() for word in ("--set", f"{entry}={value}")]
        subprocess.run([program, "run", "-q", *map(laboratory.input_file, decks), *settings], check=True)
    return History(path)


def depth(history, angle):
    """Depth of the sharp apex [m], which is deeper than the rounded tip."""
    return -history["body/cone/position y"] + TIP * (1 / np.sin(np.radians(angle / 2)) - 1)


def resistance(history, angle):
    """Resistance over s_u and the depth's square [-]."""
    return history["contact/cone/reaction y"] / STRENGTH / depth(history, angle) ** 2


def factor(history, angle):
    """The cone factor K [-]: s_u h^2 over the weight."""
    return STRENGTH * depth(history, angle).max() ** 2 / (MASS[angle] * GRAVITY)


def told(case):
    angle, rate, rough = case
    surface = {0: "smooth", 0.5: "half rough", 1: "rough"}[rough]
    return f"{angle} degrees, {surface}, {'rate law' if rate else 'no rate law'}"


def main():
    program = laboratory.program()
    scratch = tempfile.TemporaryDirectory()
    folder = sys.argv[2] if len(sys.argv) > 2 else scratch.name
    for size in SIZES:
        history = run(program, folder, size=size)
        deep = depth(history, 30)
        c = resistance(history, 30)[(deep > FROM) & (deep < TO)].mean()
        print(f"| {size} | {1e3 * deep.max():.2f} | {c:.3f} | {3 / c:.2f} |")
    found = {case: run(program, folder, *case) for case in CASES}
    for case, history in found.items():
        angle, k = case[0], factor(history, case[0])
        miss = f"{100 * (k / BAND[1] - 1):+.0f} % | {k / USUAL:.1f}" if angle == 30 else " | "
        print(f"| {told(case)} | {1e3 * depth(history, angle).max():.1f} | {k:.2f} | {miss} |")
    figure, (left, right) = laboratory.axes(2, 9)
    colours = dict(zip(CASES, laboratory.COLOURS))
    for case, history in found.items():
        left.plot(1e3 * history.time, 1e3 * depth(history, case[0]), color=colours[case], label=told(case))
        right.barh(told(case), factor(history, case[0]), color=colours[case], height=0.6)
    left.set(xlabel="time [ms]", ylabel="depth of the apex [mm]", xlim=(0, None), ylim=(64, 0))
    right.axvspan(*BAND, facecolor="#d6d6d6", edgecolor="#5c5c5c", zorder=0, label="30 degrees, literature")
    right.axvline(USUAL, color="#5c5c5c", ls="--", lw=1, label="80 g, 30 degrees, often taken")
    right.set(xlabel="cone factor K [-]", ylim=(6.4, -0.6))
    laboratory.save(figure, "measured_fall_cone.png")


if __name__ == "__main__":
    main()
