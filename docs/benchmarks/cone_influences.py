#!/usr/bin/env python3
"""What N_kt, N_u and B_q of the undrained cone in kaolin depend on: the table of docs/benchmarks/cone_influences.md.

    cone_influences.py MUDLINE FOLDER [ROW ...]    runs the rows that FOLDER does not have yet; without names all
    cone_influences.py MUDLINE FOLDER --table      prints the table of what is there, and of the closed forms

Each row is inputs/cpt/clay.xml with inputs/measurements/kaolin_cone.xml on sides of 1.54 mm, and its own settings.
The strength is that of `mudline point` with the same settings: undrained triaxial compression from the deck's start
at one per cent an hour, the highest q/2.
"""
import json
import pathlib
import resource
import subprocess
import sys

import numpy as np

TOP = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(TOP / folder) for folder in ("tests/support", "tests/verification", "python")]
from mudline.fields import Fields  # noqa: E402
from mudline_case import History  # noqa: E402
from references.cavity import CamClayRates, Undrained  # noqa: E402
from references.strain_path import SimplePile  # noqa: E402

RADIUS = 0.01785  # [m]
LAST = 1.0  # [radii] of the end over which means are taken
DECKS = ("inputs/cpt/clay.xml", "inputs/measurements/kaolin_cone.xml")
SKELETON = "materials/clay/skeleton/"
START = "physics/ground/initial state/"
CONTACT = "contacts/cone/"
CONTOUR = "bodies/cone/contour/"
M, LAMBDA, KAPPA, VOLUME, VERTICAL, REST = 0.8985, 0.205, 0.044, 2.3216, 100e3, 0.6093  # VERTICAL [Pa]
WALL = (0.030, 0.033, 0.036, 0.040, 0.045, 0.055, 0.070, 0.090, 0.120)  # [m] further filters above the tip


def sides(size):
    return {"mesh/parameters/fine": size, "mesh motion/remeshing/wall size": size}


def elasticity(ratio, slope=KAPPA):
    return {SKELETON + "Poisson's ratio": ratio, SKELETON + "swelling slope": slope}


def at_rest(ratio):
    return {START + "effective stress xx": ratio * VERTICAL, START + "effective stress zz": ratio * VERTICAL}


def u2_at(height):
    return {"output/observers/sounding/u2": height}


def adhesion(share):
    """Shear stress up to a share of the soil's strength. The reaction in this deck does not contain the surcharge, so
    that a normal effective stress of the contact is none: the friction is on total stress, and its limit acts."""
    return {CONTACT + "type": "penalty", CONTACT + "friction/type": "coulomb", CONTACT + "friction/coefficient": 1,
            CONTACT + "friction/alpha": share, CONTACT + "friction/on": "total",
            CONTACT + "friction/tangential penalty factor": 0.02}


# soil out of which no water goes, to 1.6 radii: its void ratio must stay, and sheared long enough p' be critical
SEALED = {"materials/clay/permeability/hydraulic conductivity": 1e-14, "stages/push/duration": 1.4}


def natural(**numbers):
    return {SKELETON + "type": "s-clay1s", **{SKELETON + name.replace("_", " "): n for name, n in numbers.items()}}


ROWS = {  # name: settings; the first is what all others change
    "base": {},
    "sealed, smooth": SEALED,
    "sealed, alpha 0.5": {**SEALED, **adhesion(0.5)},
    "sealed, alpha 1": {**SEALED, **adhesion(1)},
    "G/s_u 200": elasticity(0.059),
    "alpha 1": adhesion(1),
    "G/s_u 50": elasticity(0.359),
    "K0 1": at_rest(1.0),
    "OCR 4": {START + "overconsolidation ratio": 4},
    "creep, C_alpha/C_c 0.029": natural(creep_slope=0.006),
    "bonding 3": natural(initial_bonding=3, bond_degradation_rate=8, bond_shear_weight=0.3),
    "G/s_u 500": elasticity(0.06, 0.0186),
    "spacing ratio 3": {SKELETON + "spacing ratio": 3},
    "half the step": {CONTACT + "advance limit": 0.2, "stages/push/time step/maximum": 0.04},
    "small-strain stiffness 5": {SKELETON + "small-strain stiffness/ratio": 5,
                                 SKELETON + "small-strain stiffness/reference strain": 2e-4},
    "implicit": {SKELETON + "integration": "implicit"},
    "shoulder 3 mm": {CONTOUR + "shoulder radius": 0.003},
    "twice as wide and deep": {"mesh/parameters/width": 0.72, "mesh/parameters/depth": 1.44},
    "remeshed at every tenth step": {"mesh motion/remeshing/when side above": 1.2},
    "fabric": natural(fabric_rotation_rate=30),
    "Lode angle": {SKELETON + "lode dependence": "sheng"},
    "sides of 2.2 mm": sides(0.0022),
    "cone 90 degrees": {CONTOUR + "apex angle [deg]": 90, **u2_at(0.0262)},
    "G/s_u 100": elasticity(0.242),
    "OCR 2": {START + "overconsolidation ratio": 2},
    "alpha 0.5": adhesion(0.5),
    "OCR 8": {START + "overconsolidation ratio": 8},
    "sides of 1.1 mm": sides(0.0011),
    "penalty / 3": {CONTACT + "penalty": 1e9},
}

CLOSED_FORMS = ("base", "G/s_u 50", "G/s_u 100", "G/s_u 200", "G/s_u 500", "K0 1", "OCR 2", "OCR 4", "OCR 8")


def arguments(settings):
    return [item for name, value in settings.items() for item in ("--set", f"{name}={value}")]


def filters():
    return {f"output/filters/{round(1e3 * at)}/{name}": value for at in WALL
            for name, value in (("body", "cone"), ("position", at))}


def folder_of(folder, name):
    return folder / "".join(letter if letter.isalnum() else "_" for letter in name)


def strength(program, folder, settings):
    """Highest q/2 [Pa] of undrained triaxial compression from the row's start, at one per cent an hour."""
    soil = {name: value for name, value in settings.items() if name.startswith("materials/")}
    start = {**at_rest(REST), START + "effective stress yy": VERTICAL}
    start = {name[len(START):]: value for name, value in {**start, **settings}.items() if name.startswith(START)}
    test = {"type": "triaxial undrained", "axial strain": "{0.3}", "strain rate": 0.01 / 3600, "steps": 600,
            **{"initial state/" + name: value for name, value in start.items()}}
    test = {"tests/compression/" + name: value for name, value in test.items()}
    output = {"output/folder": folder, "output/name": "strength"}
    subprocess.run([program, "point", "-q", *DECKS, *arguments({**soil, **test, **output})], cwd=TOP, check=True)
    return History(str(folder / "strength_compression.csv"))["deviatoric stress"].max() / 2


def run(program, folder, name):
    settings, place = ROWS[name], folder_of(folder, name)
    output = {"output/folder": place, "output/name": "cone", "output/field interval": 9}
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    code = subprocess.run([program, "run", "-q", *DECKS, *arguments(
        {**sides(0.00154), "stages/push/duration": 9, **filters(), **output, **settings})], cwd=TOP).returncode
    spent = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    (place / "facts.json").write_text(json.dumps({"code": code, "cpu": spent}))


def means(folder, name):
    """Of the last radius that a row went: resistance, u1 and u2 [Pa], and those at the further filters."""
    place = folder_of(folder, name)
    found = History(str(place / "cone.csv"))
    depth = -found["body/cone/position y"] / RADIUS
    even = np.linspace(depth[-1] - LAST, depth[-1], 200)

    def mean(column):
        return np.interp(even, depth, found[column]).mean()

    u = {f"u{i}": mean(f"cone/sounding/excess pore pressure u{i}") for i in (1, 2)}
    wall = [mean(f"filter/{round(1e3 * at)}/excess pore pressure") for at in WALL]
    q = mean("cone/sounding/net cone resistance")
    return {"depth": depth[-1], "q": q, **u, "wall": wall, "steps": len(depth)}


def theory(settings):
    """Over the strength of Modified Cam Clay, at the wall: excess pore pressure, and total radial stress beyond that
    of the start, for a cylindrical and a spherical cavity from nothing and for the simple pile of the strain path
    method. The sphere starts from the mean stress and the yield surface of the others."""
    swelling = settings.get(SKELETON + "swelling slope", KAPPA)
    poisson = settings.get(SKELETON + "Poisson's ratio", 0.3)
    clay = {"M": M, "slope": LAMBDA, "swelling": swelling, "nu": poisson, "v0": VOLUME}
    ocr = settings.get(START + "overconsolidation ratio", 1)
    rest = settings.get(START + "effective stress xx", REST * VERTICAL) / VERTICAL
    start, p, q = np.array((rest, rest, 1.0)) * VERTICAL, VERTICAL * (1 + 2 * rest) / 3, VERTICAL * (1 - rest)
    size = ocr * (p + (q / M) ** 2 / p)
    strength = 0.25 * M * size * (2 * p / size) ** (clay["swelling"] / LAMBDA)
    shear = 1.5 * (1 - 2 * clay["nu"]) / (1 + clay["nu"]) * VOLUME * p / clay["swelling"]
    found = {}
    for name, k, begin, ratio in (("cylinder", 1, start, ocr), ("sphere", 2, np.full(3, p), size / p)):
        stress, total = Undrained(CamClayRates(**clay, start=begin, ocr=ratio), k, 300.0).at(290.0)[:2]
        found[name] = (total - stress[0]) / strength, (total - begin[0]) / strength
    total, _, excess = SimplePile(**clay, start=start, ocr=ocr).wall()
    found["pile"] = excess / strength, (total - start[0]) / strength
    return shear / strength, found


def critical_stress():
    """p' [Pa] of the base row's clay at its critical state, at the void ratio of its start."""
    p, q = VERTICAL * (1 + 2 * REST) / 3, VERTICAL * (1 - REST)
    size = p + (q / M) ** 2 / p
    return 0.5 * size * (2 * p / size) ** (KAPPA / LAMBDA)


def along_face(folder, name):
    """Void ratio and mean effective stress [Pa] of the elements that touch the face, 5 to 25 mm above the tip."""
    fields = Fields(folder_of(folder, name) / "cone.h5")
    step = len(fields.steps) - 1
    cells = fields.mesh(step)["topology"][:].reshape(-1, 7)[:, 1:4].astype(int)
    found, points = fields.fields(step), fields.coordinates(step)
    height = points[cells, 1].mean(1) + 0.02 * fields.times[step]
    touching = (found["contact pressure cone"].values > 0)[cells].any(1)
    return (found[field].values[touching & (height > 0.005) & (height < 0.025)]
            for field in ("void ratio", "mean effective stress"))


def print_face(folder):
    print("| sealed | void ratio: mean, least, largest | p' [kPa]: mean, largest |")
    for name in (name for name in ROWS if name.startswith("sealed") and folder_of(folder, name).exists()):
        e, p = along_face(folder, name)
        p = p / 1e3
        print(f"| {name} | {e.mean():.4f}, {e.min():.4f}, {e.max():.4f} | {p.mean():.1f}, {p.max():.1f} |")


def print_theory():
    print("| row | G/s_u | N_u: cylinder, sphere, pile | radial stress: cylinder, sphere, pile |")
    for name in CLOSED_FORMS:
        index, found = theory(ROWS[name])
        columns = (", ".join(f"{pair[i]:.2f}" for pair in found.values()) for i in (0, 1))
        print(f"| {name} | {index:.0f} | " + " | ".join(columns) + " |")


def print_table(program, folder):
    print("| row | s_u [kPa] | N_kt | N_u | B_q | u1/s_u | CPU [s] | steps |")
    for name in ROWS:
        place = folder_of(folder, name)
        if name.startswith("sealed") or not (place / "facts.json").exists():
            continue
        facts, found = json.loads((place / "facts.json").read_text()), means(folder, name)
        s_u = strength(program, place, ROWS[name])
        q, u1, u2 = (found[quantity] / s_u for quantity in ("q", "u1", "u2"))
        stopped = "" if facts["code"] == 0 else f", stopped at {found['depth']:.1f} radii"
        print(f"| {name}{stopped} | {s_u / 1e3:.2f} | {q:.2f} | {u2:.2f} | {u2 / q:.2f} | {u1:.2f} | "
              f"{facts['cpu']:.0f} | {found['steps']} |", flush=True)
    wall = means(folder, "base")["wall"]
    s_u = strength(program, folder_of(folder, "base"), {})
    print("base, N_u at " + ", ".join(f"{1e3 * at:.0f} mm: {u / s_u:.2f}" for at, u in zip(WALL, wall)))


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    wanted = sys.argv[3:]
    if wanted == ["--table"]:
        print_table(program, folder)
        print_face(folder)
        return print_theory()
    for name in wanted or ROWS:
        if not (folder_of(folder, name) / "facts.json").exists():
            run(program, folder, name)


if __name__ == "__main__":
    main()
