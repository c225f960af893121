#!/usr/bin/env python3
"""Random decks of contact, friction, yielding and sudden loads that should have a solution, run by defaults.

    random_decks.py [SEED ...] [--only SITUATION] [--folder DIR] [--limit SECONDS] [--jobs N] [--write PAGE]

Deck number SEED is the same whatever else is run; without one 1 to 100 are run. The environment variable MUDLINE
names the program. A soil, its cells and its numbers are drawn, and one of these situations:

footing    a rigid body is pushed down by up to a tenth of its width;
laid       a rough body is put down by a share of the force that the soil bears, at once or slowly, and left alone;
slid       such a body is then drawn to and fro by less than its friction bears;
dragged    a body is pressed in a little and dragged to and fro by up to a fifth of its width;
loaded     many times its preload are put at once on saturated soil that cannot yield aside, which then drains;
strip      a share of the load that the soil bears is put at once on a strip of it, which then drains;
impact     a body falls on the soil;
pressed    a pile or a cone is pushed in by up to half its width, with a moving mesh.

The run has failed if it does not end with exit code 0 within the limit of CPU time. Exit code 1 when a deck failed.
"""
import argparse
import collections
import concurrent.futures
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))

import mudline  # noqa: E402

WIDTH = 1.0  # of the body [m]
BOX = 6.0  # width of the ground [m]


def log_uniform(rng, low, high):
    """A number between both whose logarithm is spread evenly, to three figures."""
    return float(f"{low * (high / low) ** rng.random():.3g}")


def uniform(rng, low, high):
    return float(f"{rng.uniform(low, high):.3g}")


class Soil:
    """A drawn soil: its skeleton's numbers, the uniform vertical effective stress [Pa] and the void ratio that it
    starts from, its overconsolidation ratio (or none), the horizontal over the vertical stress, and a mean pressure
    [Pa] that a strip on it surely bears in addition to that stress."""

    def __init__(self, skeleton, stress, bears, void_ratio=0.8, overconsolidation=None):
        self.skeleton, self.stress, self.bears = skeleton, stress, bears
        self.void_ratio, self.overconsolidation, self.at_rest = void_ratio, overconsolidation, 1.0


def elastic(rng, _):
    modulus = log_uniform(rng, 1e6, 1e8)
    skeleton = {"type": "linear elastic", "Young's modulus": modulus, "Poisson's ratio": uniform(rng, 0.0, 0.45)}
    return Soil(skeleton, 0.0, 0.005 * modulus)


def von_mises(rng, _):
    strength = log_uniform(rng, 5e3, 1e5)
    skeleton = {"type": "von mises", "Young's modulus": strength * log_uniform(rng, 100, 1000),
                "Poisson's ratio": uniform(rng, 0.3, 0.49), "yield stress": strength}
    return Soil(skeleton, 0.0, 5.14 * strength / 3 ** 0.5)


def tresca(rng, _):
    strength = log_uniform(rng, 2e3, 5e4)
    skeleton = {"type": "tresca", "undrained strength": strength, "rigidity index": log_uniform(rng, 50, 500),
                "Poisson's ratio": uniform(rng, 0.45, 0.495)}
    if rng.random() < 0.3:
        skeleton |= {"sensitivity": uniform(rng, 1.5, 4), "ductility": uniform(rng, 10, 30)}
        strength /= skeleton["sensitivity"]
    elif rng.random() < 0.3:
        skeleton |= {"rate law": "logarithmic", "rate coefficient": 0.1, "reference strain rate": 1e-5}
    return Soil(skeleton, 0.0, 5.14 * strength)


def frictional(rng, kind, preload):
    angle = uniform(rng, 18, 40)
    dilation = rng.choice([angle, uniform(rng, 0, 0.4 * angle), 0.0])
    cohesion = log_uniform(rng, 1e3, 2e4)
    modulus = log_uniform(rng, 5e6, 1e8)
    skeleton = {"type": kind, "Young's modulus": modulus, "Poisson's ratio": uniform(rng, 0.15, 0.35),
                "cohesion": cohesion, "friction angle [deg]": angle, "dilation angle [deg]": dilation}
    # Davis (1968) for a dilation below the friction; the least factors that fit, those of 15 degrees.
    return Soil(skeleton, preload, 8.0 * cohesion + 2.0 * preload)


def mohr_coulomb(rng, preload):
    return frictional(rng, "mohr-coulomb", preload)


def drucker_prager(rng, preload):
    soil = frictional(rng, "drucker-prager", preload)
    soil.skeleton["match"] = rng.choice(["plane strain", "compression"])
    return soil


def clay_numbers(rng):
    compression = uniform(rng, 0.1, 0.4)
    return {"critical stress ratio": uniform(rng, 0.8, 1.4), "compression slope": compression,
            "swelling slope": compression * uniform(rng, 0.1, 0.25), "Poisson's ratio": uniform(rng, 0.2, 0.35)}


def undrained_strength(numbers, stress, overconsolidation):
    """In plane strain, at least: that of Cam Clay at 0.7 of its critical stress ratio [Pa]."""
    plastic = 1.0 - numbers["swelling slope"] / numbers["compression slope"]
    return 0.7 * 0.5 * numbers["critical stress ratio"] * stress * (overconsolidation / 2) ** plastic


def cam_clay(rng, preload):
    numbers, ratio = clay_numbers(rng), uniform(rng, 1.1, 8)
    return Soil({"type": "modified cam clay"} | numbers, preload, 5.14 * undrained_strength(numbers, preload, ratio),
                uniform(rng, 0.9, 2.2), ratio)


def natural_clay(rng, preload):
    numbers, ratio = clay_numbers(rng), uniform(rng, 1.2, 4)
    skeleton = {"type": "s-clay1s"} | numbers
    if rng.random() < 0.7:
        skeleton["fabric rotation rate"] = uniform(rng, 5, 40)
    if rng.random() < 0.5:
        skeleton |= {"initial bonding": uniform(rng, 1, 6), "bond degradation rate": uniform(rng, 4, 10),
                     "bond shear weight": 0.3}
    return Soil(skeleton, preload, 4.0 * undrained_strength(numbers, preload, ratio), uniform(rng, 1.0, 2.0), ratio)


def sand(rng, preload):
    skeleton = {"type": "hypoplasticity", "critical friction angle [deg]": uniform(rng, 29, 35),
                "granular hardness": log_uniform(rng, 1e9, 1e10), "compression exponent": uniform(rng, 0.25, 0.35),
                "densest void ratio": 0.55, "critical void ratio": 0.95, "loosest void ratio": 1.1,
                "peak exponent": uniform(rng, 0.12, 0.25), "stiffness exponent": uniform(rng, 1.0, 1.5)}
    return Soil(skeleton, preload, 3.0 * preload, uniform(rng, 0.62, 0.85))


TOTAL_STRESS = [elastic, von_mises, tresca]
EFFECTIVE_STRESS = [mohr_coulomb, drucker_prager, cam_clay, natural_clay, sand]


def draw_soil(rng, laws):
    soil = rng.choice(laws)(rng, log_uniform(rng, 5e3, 1e5))
    soil.at_rest = uniform(rng, 0.65, 0.95)
    return soil


def put(deck, path, values):
    for name, value in values.items():
        deck[f"{path}/{name}"] = value


def ground(rng, deck, soil, saturated):
    """Material, physics and a surcharge that holds the initial stress; the box is fixed below, on rollers beside."""
    deck["materials/soil/void ratio"] = soil.void_ratio
    put(deck, "materials/soil/skeleton", soil.skeleton)
    if saturated:
        put(deck, "materials/soil/fluid", {"type": "water", "incompressible": rng.random() < 0.5})
        conductivity = log_uniform(rng, 1e-10, 1e-5)
        put(deck, "materials/soil/permeability", {"type": "constant", "hydraulic conductivity": conductivity})
    deck["physics/ground/type"] = "biot" if saturated else "solid"
    if soil.stress:
        deck["physics/ground/initial state/type"] = "uniform"
        for component in ("xx", "yy", "zz"):
            at_rest = 1.0 if component == "yy" else soil.at_rest
            deck[f"physics/ground/initial state/effective stress {component}"] = float(f"{at_rest * soil.stress:.6g}")
        if soil.overconsolidation:
            deck["physics/ground/initial state/overconsolidation ratio"] = soil.overconsolidation
        put(deck, "boundary conditions/surcharge", {"type": "pressure", "set": "top", "value": soil.stress})
    put(deck, "boundary conditions/base", {"type": "fixed", "set": "bottom"})
    for side in ("left", "right"):
        put(deck, f"boundary conditions/{side}", {"type": "fixed", "set": side, "components": "x"})
    if saturated:
        put(deck, "boundary conditions/drained", {"type": "pore pressure", "set": "top"})


def box(rng, deck, width, depth, cells):
    axisymmetric = rng.random() < 0.5
    deck["mesh/type"] = "box"
    deck["mesh/geometry"] = "axisymmetric" if axisymmetric else "plane strain"
    deck["mesh/cell"] = rng.choice(["quad9", "quad9", "tri6"])
    deck["mesh/cells"] = [int(round(n * rng.choice([0.7, 1.0, 1.4]))) for n in cells]
    deck["mesh/lower"] = [0.0, -depth]
    deck["mesh/upper"] = [width, 0.0]
    deck["mesh/grading"] = [6.0, 0.2]
    return axisymmetric


def friction(rng, deck, soil, path="contacts/touch/friction"):
    kind = rng.choice(["none", "coulomb", "coulomb", "adhesion", "alpha"])
    if kind == "alpha" and soil.skeleton["type"] not in ("tresca", "modified cam clay"):
        kind = "coulomb"
    if kind == "none":
        return
    deck[f"{path}/type"] = "coulomb"
    if kind == "coulomb":
        deck[f"{path}/coefficient"] = uniform(rng, 0.05, 0.8)
    elif kind == "adhesion":
        deck[f"{path}/coefficient"] = uniform(rng, 0.0, 0.3)
        deck[f"{path}/adhesion"] = float(f"{soil.bears * rng.uniform(0.01, 0.1):.3g}")
    else:
        deck[f"{path}/coefficient"] = uniform(rng, 0.3, 0.8)
        deck[f"{path}/alpha"] = uniform(rng, 0.3, 1.0)


def body(rng, deck, kinds=("strip", "sphere")):
    """A body whose lowest point touches the surface, and its contact."""
    kind = rng.choice(kinds)
    deck["bodies/body/position"] = [0.0, 0.0]
    deck["bodies/body/contour/type"] = kind
    if kind == "strip":
        corner = uniform(rng, 0.03, 0.15)
        put(deck, "bodies/body/contour", {"width": WIDTH, "thickness": 0.4, "corner radius": corner})
    else:
        deck["bodies/body/contour/diameter"] = 2.0 * WIDTH
    deck["contacts/touch/type"] = "penalty"
    deck["contacts/touch/body"] = "body"
    deck["contacts/touch/surface"] = "top"
    return kind


def area(axisymmetric):
    """Of the body's base in the half that is meshed: per metre, or the full circle [m2]."""
    return 3.1416 * WIDTH ** 2 / 4 if axisymmetric else WIDTH / 2


def stage(deck, name, duration, first, kind="quasi-static"):
    deck[f"stages/{name}/type"] = kind
    deck[f"stages/{name}/duration"] = duration
    deck[f"stages/{name}/time step/initial"] = first


def pushed(rng, deck, least, most):
    """Pushes the body down by between these shares of its width; returns the time that it takes [s]."""
    duration = log_uniform(rng, 10, 1e5)
    speed = WIDTH * uniform(rng, least, most) / duration
    put(deck, "bodies/body/motion", {"type": "prescribed velocity", "velocity y": -float(f"{speed:.4g}")})
    return duration


def footing(rng, deck):
    saturated = rng.random() < 0.5
    soil = draw_soil(rng, EFFECTIVE_STRESS if saturated or rng.random() < 0.6 else TOTAL_STRESS)
    box(rng, deck, BOX, 5.0, (14, 10))
    ground(rng, deck, soil, saturated)
    body(rng, deck)
    friction(rng, deck, soil)
    duration = pushed(rng, deck, 0.01, 0.1)
    stage(deck, "push", duration, float(f"{duration / rng.choice([20, 40, 80]):.4g}"))


def laid(rng, deck):
    saturated = rng.random() < 0.4
    soil = draw_soil(rng, EFFECTIVE_STRESS if saturated or rng.random() < 0.4 else TOTAL_STRESS)
    axisymmetric = box(rng, deck, BOX, 5.0, (14, 10))
    ground(rng, deck, soil, saturated)
    body(rng, deck, ("strip",))
    friction(rng, deck, soil)
    force = float(f"{rng.uniform(0.1, 0.6) * soil.bears * area(axisymmetric):.4g}")
    at_once = rng.random() < 0.5
    put(deck, "bodies/body/motion", {"type": "force", "force y": -force if at_once else f"-{force}*min(t/10, 1)"})
    stage(deck, "lay down", 20.0, 20.0 / rng.choice([4, 10, 20]))


def slid(rng, deck):
    soil = draw_soil(rng, TOTAL_STRESS + [mohr_coulomb, drucker_prager])
    deck["mesh/type"] = "box"
    deck["mesh/geometry"] = "plane strain"
    deck["mesh/cell"] = rng.choice(["quad9", "tri6", "quad4"])
    deck["mesh/cells"] = [rng.choice([16, 24, 32]), rng.choice([4, 6])]
    deck["mesh/lower"] = [-3.0, -1.5]
    deck["mesh/upper"] = [3.0, 0.0]
    ground(rng, deck, soil, False)
    body(rng, deck, ("strip",))
    deck["bodies/body/contour/extent"] = "full"
    deck["contacts/touch/friction/type"] = "coulomb"
    deck["contacts/touch/friction/coefficient"] = uniform(rng, 0.1, 0.6)
    force = float(f"{rng.uniform(0.05, 0.3) * soil.bears * WIDTH:.4g}")
    put(deck, "bodies/body/motion", {"type": "force", "freedom": ["y"], "force y": f"-{force}*min(t, 1)"})
    stage(deck, "lay down", 1.0, rng.choice([0.1, 0.25, 1.0]))
    stage(deck, "draw", 4.0, rng.choice([0.05, 0.1, 0.2]))
    drawn = float(f"{force * deck['contacts/touch/friction/coefficient'] * rng.uniform(0.3, 0.9):.4g}")
    put(deck, "stages/draw/motions/body", {"type": "force", "freedom": ["x", "y"], "force y": -force,
                                           "force x": f"{drawn}*sin(pi/2*t)"})


def dragged(rng, deck):
    slid(rng, deck)
    deck["contacts/touch/friction/coefficient"] = uniform(rng, 0.1, 0.6)
    depth, way = uniform(rng, 0.001, 0.02), uniform(rng, 0.01, 0.2)
    del deck["bodies/body/motion/freedom"], deck["bodies/body/motion/force y"]
    put(deck, "bodies/body/motion", {"type": "prescribed displacement", "y": f"-{depth}*min(t, 1)"})
    del deck["stages/draw/motions"]
    put(deck, "stages/draw/motions/body", {"type": "prescribed displacement", "x": f"{way}*sin(pi/2*t)"})


def drains(rng, deck, way, growth, steps):
    """A stage in which the load is put at once and drains, as long as water takes for `way` [m] at a gradient of one;
    the steps grow by `growth` at least, to one of so many of equal length."""
    duration = float(f"{way / deck['materials/soil/permeability/hydraulic conductivity']:.4g}")
    stage(deck, "consolidation", duration, float(f"{duration * log_uniform(rng, 1e-5, 1e-2):.4g}"))
    deck["stages/consolidation/time step/growth"] = uniform(rng, growth, 1.5)
    deck["stages/consolidation/time step/maximum"] = duration / steps


def loaded(rng, deck):
    soil = draw_soil(rng, [cam_clay, natural_clay, sand, mohr_coulomb, elastic])
    deck["mesh/type"] = "box"
    deck["mesh/cell"] = rng.choice(["quad9", "tri6"])
    deck["mesh/cells"] = [1, rng.choice([6, 10, 16])]
    deck["mesh/upper"] = [0.4, 1.6]
    deck["mesh/grading"] = [1.0, 0.2]
    ground(rng, deck, soil, True)
    load = float(f"{max(soil.stress, 0.2 * soil.bears) * log_uniform(rng, 1, 20):.4g}")
    put(deck, "boundary conditions/load", {"type": "pressure", "set": "top", "value": load})
    drains(rng, deck, 3e-2, 1.05, 40)


def strip(rng, deck):
    soil = draw_soil(rng, [cam_clay, natural_clay, mohr_coulomb, drucker_prager, sand])
    axisymmetric = box(rng, deck, BOX, 5.0, (12, 10))
    deck["mesh/cell"] = rng.choice(["quad9", "tri6"])
    ground(rng, deck, soil, True)
    load = float(f"{rng.uniform(0.2, 0.6) * soil.bears:.4g}")
    across = "r" if axisymmetric else "x"
    value = f"{across} < {WIDTH / 2} ? {load} : 0"
    put(deck, "boundary conditions/load", {"type": "pressure", "set": "top", "value": value})
    drains(rng, deck, 1e-1, 1.1, 20)


def impact(rng, deck):
    saturated = rng.random() < 0.4
    soil = draw_soil(rng, EFFECTIVE_STRESS if saturated or rng.random() < 0.3 else TOTAL_STRESS)
    axisymmetric = box(rng, deck, BOX, 5.0, (14, 10))
    ground(rng, deck, soil, saturated)
    body(rng, deck)
    friction(rng, deck, soil)
    deck["bodies/body/position"] = [0.0, 0.005]
    speed = uniform(rng, 0.2, 3.0)
    # The body comes to rest within a twentieth of its width under twice the load that the soil bears.
    mass = float(f"{2 * (0.5 * soil.bears) * area(axisymmetric) * 0.05 * WIDTH / speed ** 2:.4g}")
    deck["bodies/body/mass"] = max(mass, 1.0)
    put(deck, "bodies/body/motion", {"type": "free", "initial velocity": [0.0, -speed]})
    duration = float(f"{min(0.3 * WIDTH / speed, 0.2):.4g}")
    stage(deck, "fall", duration, duration / rng.choice([40, 100]), "dynamic")
    put(deck, "stages/fall/integrator", {"type": "generalised alpha", "spectral radius": uniform(rng, 0.5, 0.9)})


def pressed(rng, deck):
    saturated = rng.random() < 0.4
    soil = draw_soil(rng, [cam_clay] if saturated else TOTAL_STRESS[1:])
    deck["mesh/type"] = "gmsh"
    deck["mesh/geometry"] = rng.choice(["axisymmetric", "plane strain"])
    deck["mesh/file"] = str(ROOT / "inputs/pile/pile.geo")
    put(deck, "mesh/parameters", {"diameter": WIDTH, "fine": 0.06, "coarse": 0.7, "width": 4.0, "depth": 4.0})
    ground(rng, deck, soil, saturated)
    names = {"bottom": "base", "left": "axis", "right": "far side", "top": "surface"}
    for condition in ("surcharge", "base", "left", "right", "drained"):
        if f"boundary conditions/{condition}/set" in deck:
            deck[f"boundary conditions/{condition}/set"] = names[deck[f"boundary conditions/{condition}/set"]]
    kind = rng.choice(["flat pile", "cone"])
    deck["bodies/body/position"] = [0.0, 0.0]
    put(deck, "bodies/body/contour", {"type": kind, "diameter": WIDTH, "shaft length": 2.0})
    if kind == "flat pile":
        deck["bodies/body/contour/corner radius"] = 0.1
    else:
        put(deck, "bodies/body/contour", {"apex angle [deg]": rng.choice([60.0, 90.0, 120.0]), "tip radius": 0.08,
                                          "shoulder radius": 0.1})
    put(deck, "contacts/touch", {"type": "penalty", "body": "body", "surface": "surface"})
    friction(rng, deck, soil)
    duration = pushed(rng, deck, 0.1, 0.5)
    put(deck, "mesh motion/boundary",
        {"focus": "body", "size near focus": 0.06, "near distance": 0.6, "growth": 0.15})
    stage(deck, "push", duration, float(f"{duration / 200:.4g}"))


SITUATIONS = {kind.__name__: kind for kind in (footing, laid, slid, dragged, loaded, strip, impact, pressed)}


def make(seed, only=None):
    """(situation, soil's law, deck) of this number."""
    rng = random.Random(seed)
    name = rng.choice(sorted(SITUATIONS))
    name = only or name
    deck = mudline.Deck(f"{name} {seed}")
    SITUATIONS[name](rng, deck)
    return name, deck["materials/soil/skeleton/type"], deck


PREFACE = """
A hundred decks of contact, friction, yielding, sudden loads and impacts, run by defaults, without a solver's setting.
What was drawn, and how, stands in `tests/robustness/random_decks.py`. Repeat it, with `MUDLINE` naming the program, by

    tests/robustness/random_decks.py --write docs/benchmarks/random_decks.md

Iterations are those of the steps that were taken, with the tries before. The most is that of one deck.
"""

Outcome = collections.namedtuple("Outcome", "seed situation law code steps rejected iterations seconds line")


def run(seed, only, folder, limit):
    name, law, deck = make(seed, only)
    path = folder / f"{name}_{seed}.xml"
    deck.write(path)
    done = subprocess.run(["bash", "-c", f'ulimit -t {limit}; TIMEFORMAT="cpu %U"; time "$0" run "$1" --overwrite',
                           os.environ["MUDLINE"], path.name],
                          cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    (folder / f"{name}_{seed}.log").write_text(done.stdout, encoding="utf-8")
    iterations = [int(n) for n in re.findall(r"^  step .* newton (\d+)", done.stdout, re.MULTILINE)]
    error = re.search(r"error: (.*)", done.stdout)
    return Outcome(seed, name, law, done.returncode, len(iterations),
                   len(re.findall(r"^  step \d+ rejected", done.stdout, re.MULTILINE)), sum(iterations),
                   float(re.search(r"cpu ([\d.]+)", done.stdout)[1]), error[1] if error else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("seeds", type=int, nargs="*", default=range(1, 101))
    parser.add_argument("--only", choices=sorted(SITUATIONS))
    parser.add_argument("--folder", type=pathlib.Path)
    parser.add_argument("--limit", type=int, default=300)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--write", type=pathlib.Path)
    options = parser.parse_args()
    folder = options.folder or pathlib.Path(tempfile.mkdtemp(prefix="mudline_random_decks_"))
    folder.mkdir(parents=True, exist_ok=True)
    outcomes = []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for o in pool.map(lambda seed: run(seed, options.only, folder, options.limit), options.seeds):
            outcomes.append(o)
            print(f"{o.seed:5d} {o.situation:8s} {o.law:18s} exit {o.code}  {o.steps:4d} steps {o.rejected:3d} "
                  f"rejected {o.iterations:5d} iterations {o.seconds:6.1f} s  {o.line[:200]}", flush=True)
    failed = [o for o in outcomes if o.code != 0]
    print(f"{len(failed)} of {len(outcomes)} failed; decks and logs are in {folder}")
    if options.write:
        options.write.write_text(page(outcomes), encoding="utf-8")
    return 1 if failed else 0


def page(outcomes):
    """The document: a row for each situation and each law, and the decks that failed."""
    lines = ["# Random decks", "", *PREFACE.strip().splitlines(), ""]
    for title, key in (("situation", lambda o: o.situation), ("soil", lambda o: o.law)):
        lines += [f"| {title} | decks | failed | steps | rejected | iterations a step | most | CPU time [s] |",
                  "|---|---|---|---|---|---|---|---|"]
        for name in sorted(set(map(key, outcomes))) + ["all"]:
            rows = [o for o in outcomes if name in (key(o), "all")]
            steps = sum(o.steps for o in rows)
            most = max(o.iterations / max(o.steps, 1) for o in rows)
            lines.append(f"| {name} | {len(rows)} | {sum(o.code != 0 for o in rows)} | {steps} | "
                         f"{sum(o.rejected for o in rows)} | {sum(o.iterations for o in rows) / max(steps, 1):.1f} | "
                         f"{most:.1f} | {sum(o.seconds for o in rows):.0f} |")
        lines.append("")
    failed = [o for o in outcomes if o.code != 0]
    lines += [f"- Deck {o.seed}, {o.situation}, {o.law}: exit code {o.code}, {o.line or 'stopped at the time limit'}"
              for o in failed] or ["No deck failed."]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    sys.exit(main())
