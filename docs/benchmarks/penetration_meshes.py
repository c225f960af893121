#!/usr/bin/env python3
"""The meshes around bodies that went down the axis, in three ways of opening it, and the mesh quality of all penetration decks over depth.

    penetration_meshes.py PROGRAM MESHES.png QUALITY.png FOLDER      runs the decks in FOLDER (three quarters of an hour); results there are used again
"""
import pathlib
import subprocess
import sys

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
from mudline_case import History  # noqa: E402

CONE = 0.0357
# name: deck, diameter [m], label
DECKS = {
    "cone": ("cpt/tresca.xml", CONE, "cone in clay, boundary path from the surface"),
    "cone_deep": ("cpt/deep_tresca.xml", CONE, "cone, wished in place"),
    "cone_tube": ("cpt/guide_tube.xml", CONE, "cone, guide tube"),
    "pile_clay": ("pile/clay.xml", 0.4, "pile in clay"),
    "pile_sand": ("pile/sand.xml", 0.4, "pile in sand"),
    "torpedo_tresca": ("torpedo/tresca.xml", 1.07, "torpedo, Tresca clay"),
    "torpedo_clay": ("torpedo/clay.xml", 1.07, "torpedo, Modified Cam Clay"),
    "penetrometer": ("free_fall_penetrometer/tresca.xml", 0.04, "free-falling penetrometer"),
}
MESHES = ("cone", "cone_deep", "cone_tube")


class Run:
    def __init__(self, program, name, folder):
        deck, self.diameter, self.label = DECKS[name]
        stem = folder / "results" / name
        if not stem.with_suffix(".csv").exists():
            subprocess.run([program, "run", "-q", ROOT / "inputs" / deck, "--set", f"output/name={name}"], cwd=folder, check=True)
        self.history = History(stem.with_suffix(".csv"))
        self.file = h5py.File(stem.with_suffix(".h5"), "r")
        self.body = next(iter(self.file["bodies"]))

    def quality(self):
        """Depth over diameter and smallest scaled Jacobian, while the body goes down."""
        y = self.history[f"body/{self.body}/position y"]
        end = np.argmin(y) + 1
        return -y[:end] / self.diameter, self.history["mesh/quality"][:end]

    def draw(self, axes, centre, half):
        """The mesh of the last output and the body's contour in the square about `centre`; lengths over the body's radius."""
        radius = 0.5 * self.diameter
        step = self.file["steps"][max(self.file["steps"])]
        x = step["coordinates"][:, :2] / radius
        corners = self.file["mesh/topology"][()].reshape(-1, 7)[:, 1:4].astype(int)
        axes.triplot(x[:, 0], x[:, 1], corners, lw=0.5, color="0.3")
        contour = step[f"bodies/{self.body}/coordinates"][:, :2] / radius
        axes.fill(contour[:, 0], contour[:, 1], color="C0", alpha=0.3, lw=0)
        axes.set_aspect("equal")
        axes.set_xlim(0, 2 * half)
        axes.set_ylim(centre - half, centre + half)


def main():
    program, folder = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[4])
    folder.mkdir(parents=True, exist_ok=True)
    runs = {name: Run(program, name, folder) for name in DECKS}

    _, panels = plt.subplots(2, len(MESHES), figsize=(11, 7.6))
    for name, (mudline, tip) in zip(MESHES, panels.T):
        run = runs[name]
        y = run.history[f"body/{run.body}/position y"][-1] / (0.5 * run.diameter)
        run.draw(mudline, -1.2, 2)
        run.draw(tip, y + 1.2, 2)
        mudline.set_title(run.label.split(", ")[1], fontsize=10)
        tip.set_xlabel("radius / that of the cone")
    panels[0, 0].set_ylabel("height / radius of the cone: mudline")
    panels[1, 0].set_ylabel("tip")
    plt.savefig(sys.argv[2], dpi=100, bbox_inches="tight")

    _, (left, right) = plt.subplots(1, 2, figsize=(10.5, 3.8), sharey=True)
    print(f"{'deck':35} {'depth / diameter':>16} {'smallest scaled Jacobian':>25}")
    for name, run in runs.items():
        depth, quality = run.quality()
        (right if "torpedo" in name else left).plot(depth, quality, lw=1.3, label=run.label)
        print(f"{DECKS[name][0]:35} {depth[-1]:16.1f} {quality.min():25.3f}")
    for axes in (left, right):
        axes.axhline(0.2, color="k", lw=0.8, ls=":")
        axes.set_xlabel("depth of the body / its diameter")
        axes.set_ylim(0, 1)
        axes.legend(frameon=False, fontsize=8)
    left.set_ylabel("smallest scaled Jacobian")
    plt.savefig(sys.argv[3], dpi=100, bbox_inches="tight")


if __name__ == "__main__":
    main()
