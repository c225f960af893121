"""What mesh motion and remap change beside a wall: a cone of 60 degrees and 0.4 m, wished in place 1.6 m deep in the clay of
inputs/pile/clay.xml, is pushed by 0.16 m with and without mesh motion; pile_wall.md has the figures.

python3 material_mesh.py [sides on the cone in m] prints means of the ratio moving over material mesh, and in brackets its root mean
square difference from one. MUDLINE names the program. Needs h5py and scipy."""
import csv
import os
import subprocess
import sys
import xml.etree.ElementTree as tree

import h5py
import numpy as np
from scipy.interpolate import LinearNDInterpolator

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
RADIUS, DEPTH, HALF_ANGLE = 0.2, 1.6, np.pi / 6
SHOULDER = DEPTH - RADIUS / np.tan(HALF_ANGLE)
TRAVELS = (0.09, 0.14)


def section(parent, path):
    for name in path.split("/"):
        found = [child for child in parent if child.get("name") == name]
        parent = found[0] if found else tree.SubElement(parent, "ParameterList", name=name)
    return parent


def put(deck, path, value):
    folder, name = path.rsplit("/", 1)
    kind = "Array(string)" if str(value).startswith("{") else {int: "int", float: "double", str: "string"}[type(value)]
    parent = section(deck, folder)
    for child in [child for child in parent if child.get("name") == name]:
        parent.remove(child)
    tree.SubElement(parent, "Parameter", name=name, type=kind, value=str(value))


def write_deck(path, sides, moves):
    deck = tree.parse(os.path.join(ROOT, "inputs", "pile", "clay.xml")).getroot()
    stages = section(deck, "stages")
    for name in ("set-up", "load test", "pull-out"):
        stages.remove(section(stages, name))
    start = section(deck, "physics/ground/initial state")
    for child in [child for child in start if child.get("name") == "water level"]:
        start.remove(child)
    put(deck, "physics/ground/pore pressure", "excess")
    put(deck, "mesh/file", os.path.join(ROOT, "inputs", "cpt", "cone.geo"))
    for name, value in (("diameter", 2 * RADIUS), ("tip_radius", 0.04), ("shoulder_radius", 0.08), ("start", DEPTH), ("fine", sides),
                        ("wall", 0.03), ("coarse", 0.5), ("width", 4.0), ("depth", 6.0)):
        put(deck, "mesh/parameters/" + name, value)
    contour = section(deck, "bodies/pile/contour")
    for child in list(contour):
        contour.remove(child)
    for name, value in (("type", "cone"), ("diameter", 2 * RADIUS), ("apex angle [deg]", 60.0), ("tip radius", 0.04),
                        ("shoulder radius", 0.08), ("shaft length", 3.0)):
        put(deck, "bodies/pile/contour/" + name, value)
    position = section(deck, "bodies/pile")
    [child for child in position if child.get("name") == "position"][0].set("value", f"{{0.0, {-DEPTH}}}")
    for condition in ("drained surface", "surcharge"):
        put(deck, f"boundary conditions/{condition}/set", "seabed")
    put(deck, "contacts/pile/initial gap", "in-situ stress")
    put(deck, "stages/geostatic/contacts", "{pile}")
    put(deck, "stages/geostatic/balance tolerance", 1e-3)
    put(deck, "stages/push/duration", 0.16)
    put(deck, "mesh motion/boundary/size near focus", sides)
    put(deck, "mesh motion/every", 1 if moves else 1000000)
    put(deck, "output/field interval", 0.05)
    tree.ElementTree(deck).write(path)


def run(name, sides, moves):
    write_deck(name + ".xml", sides, moves)
    program = os.environ.get("MUDLINE", os.path.join(ROOT, "build", "release", "apps", "mudline", "mudline"))
    subprocess.run([program, "run", "-q", name + ".xml", "--overwrite"], check=True)
    with open(f"results/{name}.csv", newline="") as file:
        rows = list(csv.reader(file))
    return {column: np.array([float(row[i]) for row in rows[1:]]) for i, column in enumerate(rows[0])}


def cells(name, travel):
    """Centre by height over the shoulder and distance from the body, and the state, of the fields nearest to a travel."""
    with h5py.File(f"results/{name}.fields/mesh.h5") as file:
        nodes = file["mesh/topology"][:]
        corners = np.array([nodes[k + 1:k + 4] for k in file["mesh/offset"][:]])  # nodes[k]: type of the cell
    found = None
    for entry in sorted(os.listdir(f"results/{name}.fields")):
        if entry == "mesh.h5":
            continue
        with h5py.File(f"results/{name}.fields/{entry}") as file:
            gone = -file["bodies/pile"].attrs["displacement"][1]
            if found is not None and abs(gone - travel) >= abs(found["travel"] - travel):
                continue
            centre = file["coordinates"][:][corners].mean(axis=1)
            height = centre[:, 1] + SHOULDER + gone
            wall = np.clip(RADIUS + np.minimum(height, 0) * np.tan(HALF_ANGLE), 0, None)
            found = {"travel": gone, "height": height, "away": centre[:, 0] - wall, "p'": file["cell/mean_effective_stress"][:],
                     "p_c": file["cell/preconsolidation_pressure"][:], "radial": -file["cell/effective_stress"][:, 0]}
    return found


def main(sides=0.02):
    histories = [run(name, sides, moves) for name, moves in (("moving", True), ("material", False))]
    for travel in TRAVELS:
        both = [cells(name, travel) for name in ("moving", "material")]
        print(f"travel {both[0]['travel']:.4f} and {both[1]['travel']:.4f} m; moving over material mesh")
        for column in ("contact/pile/reaction y [N]", "contact/pile/tip reaction y [N]", "contact/pile/friction y [N]"):
            now = [np.interp(travel, -history["body/pile/displacement y [m]"], history[column]) for history in histories]
            print(f"  {column}: {now[0]:.0f}, {now[1]:.0f}, ratio {now[0] / now[1]:.4f}")
        there = np.column_stack([both[1]["height"], both[1]["away"]])
        here = np.column_stack([both[0]["height"], both[0]["away"]])
        ratios = {key: both[0][key] / LinearNDInterpolator(there, both[1][key])(here) for key in ("p'", "p_c", "radial")}
        for nearest, farthest in ((0, 0.0125), (0.0125, 0.03), (0.03, 0.1)):
            for low, high, where in ((0.25, 0.95, "shaft"), (0.05, 0.25, "behind the shoulder"), (-0.08, 0.05, "at the shoulder"),
                                     (-0.25, -0.08, "flank")):
                inside = (here > (low, nearest)).all(axis=1) & (here < (high, farthest)).all(axis=1) & np.isfinite(ratios["p'"])
                if inside.any():
                    told = ", ".join(f"{key} {ratio[inside].mean():.3f} ({np.sqrt(((ratio[inside] - 1) ** 2).mean()):.3f})"
                                     for key, ratio in ratios.items())
                    print(f"  {1e3 * nearest:3.0f} to {1e3 * farthest:3.0f} mm, {where}, {inside.sum()} elements: {told}")


main(*map(float, sys.argv[1:]))
