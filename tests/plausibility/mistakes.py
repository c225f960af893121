"""Mistakes of practice about soils, water, units, loads, steps and meshes: small changes of decks that are right.

A row: the base deck, the changes ({path: value}; None takes an entry away), the name of the doubt that must appear."""
import copy

FOOTING = """SetFactory("Built-in");
W = {half}; L = {width}; H = {depth}; n = {cells};
Point(1) = {{0, -H, 0, 1}}; Point(2) = {{L, -H, 0, 1}}; Point(3) = {{L, 0, 0, 1}}; Point(4) = {{W, 0, 0, 1}}; Point(5) = {{0, 0, 0, 1}};
Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 5}}; Line(5) = {{5, 1}};
Transfinite Curve {{1}} = 4; Transfinite Curve {{2, 5}} = 4; Transfinite Curve {{3}} = 4; Transfinite Curve {{4}} = n + 1;
Curve Loop(1) = {{1, 2, 3, 4, 5}}; Plane Surface(1) = {{1}};
Physical Surface("soil") = {{1}}; Physical Curve("bottom") = {{1}}; Physical Curve("right") = {{2}}; Physical Curve("top") = {{3}};
Physical Curve("footing") = {{4}}; Physical Curve("left") = {{5}};
"""
# name: half width, width and depth of the mesh [m], cells below the footing
FILES = {"footing": (1, 12, 8, 6), "narrow": (1, 2, 8, 6), "shallow": (1, 12, 0.5, 6), "coarse": (1, 12, 8, 2)}


def mesh_files():
    """{file name: text} of the geometries that decks of the tables name."""
    return {f"{name}.geo": FOOTING.format(half=half, width=width, depth=depth, cells=cells)
            for name, (half, width, depth, cells) in FILES.items()}


CLAY = {"type": "modified cam clay", "critical stress ratio": 1.0, "compression slope": 0.2, "swelling slope": 0.04, "Poisson's ratio": 0.3}
SAND = {"type": "mohr-coulomb", "Young's modulus": 4e7, "Poisson's ratio": 0.3, "cohesion": 1e3, "friction angle [deg]": 32.0,
        "dilation angle [deg]": 4.0}
ELASTIC = {"type": "linear elastic", "Young's modulus": 1e7, "Poisson's ratio": 0.3}
UNDRAINED = {"type": "tresca", "undrained strength": 2e4, "shear modulus": 2e6, "Poisson's ratio": 0.47}


def mesh(space, cells=(2, 4), cell=None, **more):
    """2 m wide, 4 m deep, the surface at 0."""
    result = {"type": "box", "geometry": "three-dimensional" if space else "plane strain",
              "cells": [cells[0], 1, cells[1]] if space else list(cells), "lower": [0.0, 0.0, -4.0] if space else [0.0, -4.0],
              "upper": [2.0, 1.0, 0.0] if space else [2.0, 0.0]}
    if cell:
        result["cell"] = {"quad4": "hex8", "tri3": "tet4", "tri6": "tet10"}[cell] if space else cell
    return dict(result, **more)


def vector(space, down):
    return [0.0, 0.0, down] if space else [0.0, down]


def supports(space, bottom="bottom"):
    up = "z" if space else "y"
    result = {"base": {"type": "fixed", "set": bottom, "components": up},
              "left": {"type": "fixed", "set": "left", "components": "x"},
              "right": {"type": "fixed", "set": "right", "components": "x"}}
    if space:
        result.update({"front": {"type": "fixed", "set": "front", "components": "y"},
                       "back": {"type": "fixed", "set": "back", "components": "y"}})
    return result


def saturated(law, conductivity, void_ratio):
    return {"void ratio": void_ratio, "grain density": 2650.0, "skeleton": copy.deepcopy(law), "fluid": {"type": "water"},
            "permeability": {"type": "constant", "hydraulic conductivity": conductivity}}


def steps(kind, duration, initial, **more):
    return {"type": kind, "duration": duration, "time step": dict({"initial": initial}, **more)}


def consolidation(law, conductivity, void_ratio, duration, initial):
    """A loaded layer under water, drained at the top."""
    def deck(space):
        return {"mesh": mesh(space), "materials": {"soil": saturated(law, conductivity, void_ratio)},
                "physics": {"ground": {"type": "biot", "gravity": vector(space, -9.81),
                                       "initial state": {"type": "geostatic", "K0": 0.6, "surcharge": 1e4, "water level": 0.0}}},
                "boundary conditions": dict(supports(space), **{
                    "surcharge": {"type": "pressure", "set": "top", "value": 1e4},
                    "fill": {"type": "pressure", "set": "top", "value": 3e4},
                    "drained": {"type": "pore pressure", "set": "top", "value": 0.0}}),
                "stages": {"start": {"type": "geostatic", "conditions": ["base", "left", "right", "surcharge"] + (["front", "back"] if space else [])},
                           "wait": steps("quasi-static", duration, initial)}}
    return deck


def column(space):
    """Waves of a load on single-phase soil."""
    return {"mesh": mesh(space), "materials": {"soil": {"density": 1800.0, "skeleton": dict(ELASTIC)}},
            "physics": {"ground": {"type": "solid"}},
            "boundary conditions": dict(supports(space), **{
                "blast": {"type": "pressure", "set": "top", "value": "5e4 * sin(20 * pi * t)"}}),
            "stages": {"shake": steps("dynamic", 0.5, 2e-3)}}


def block(space):
    """Clay in total stress under a plate that is pressed in."""
    component = "z" if space else "y"
    return {"mesh": mesh(space), "materials": {"soil": {"density": 1800.0, "skeleton": dict(UNDRAINED)}},
            "physics": {"ground": {"type": "solid"}},
            "boundary conditions": dict(supports(space), plate={"type": "displacement", "set": "top", component: "-0.02 * t"}),
            "stages": {"press": steps("quasi-static", 1.0, 0.1)}}


def fallen(space):
    """Dry sand that has its weight from the start, and a load on it."""
    return {"mesh": mesh(space), "materials": {"soil": {"density": 1700.0, "skeleton": dict(SAND)}},
            "physics": {"ground": {"type": "solid", "gravity": vector(space, -9.81),
                                   "initial state": {"type": "geostatic", "K0": 0.5, "surcharge": 1e4}}},
            "boundary conditions": dict(supports(space), surcharge={"type": "pressure", "set": "top", "value": 1e4}),
            "stages": {"start": {"type": "geostatic"}, "rest": steps("quasi-static", 1.0, 1.0)}}


def dropped(space):
    """Elastic soil that gets its weight slowly."""
    deck = fallen(space)
    deck["materials"]["soil"]["skeleton"] = dict(ELASTIC)
    deck["physics"]["ground"] = {"type": "solid", "gravity": vector(space, -9.81), "gravity factor": "min(1, t)"}
    del deck["boundary conditions"]["surcharge"]
    deck["stages"] = {"fall": steps("dynamic", 2.0, 2e-2)}
    return deck


def footing(space):
    """A strip on undrained clay, half of it."""
    deck = block(space)
    plane = {"type": "gmsh", "file": "footing.geo"}
    deck["mesh"] = dict({"type": "extruded", "geometry": "three-dimensional", "along": "y", "length": 1.0, "layers": 1, "plane": plane}
                        if space else dict(plane, geometry="plane strain"))
    deck["boundary conditions"]["plate"]["set"] = "footing"
    if space:
        deck["boundary conditions"]["front"]["set"], deck["boundary conditions"]["back"]["set"] = "start", "end"
    return deck


def pounded(space):
    """The same, loaded in a dynamic stage, with an absorbing side."""
    deck = footing(space)
    deck["materials"]["soil"]["skeleton"] = dict(ELASTIC)
    deck["boundary conditions"]["plate"] = {"type": "pressure", "set": "footing", "value": "2e4 * sin(20 * pi * t)"}
    del deck["boundary conditions"]["right"]
    deck["boundary conditions"]["far"] = {"type": "absorbing", "set": "right"}
    deck["stages"] = {"shake": steps("dynamic", 0.5, 2e-3)}
    return deck


def heated(space):
    """A layer whose surface is warmed."""
    deck = consolidation(ELASTIC, 1e-7, 0.8, 1e6, 1e5)(space)
    deck["materials"]["soil"]["heat"] = {"conductivity": 1.5, "grain heat capacity": 800.0, "grain expansion": 3e-5}
    deck["physics"]["ground"] = {"type": "thermo-hydro-mechanical", "reference temperature": 10.0, "initial temperature": 10.0,
                                 "water heat capacity": 4186.0}
    deck["boundary conditions"] = dict(supports(space), **{
        "warm": {"type": "value", "field": "temperature", "set": "top", "value": 30.0},
        "drained": {"type": "pore pressure", "set": "top"}})
    deck["stages"] = {"warm": steps("quasi-static", 1e6, 1e5)}
    return deck


BASES = {"clay": consolidation(CLAY, 1e-9, 1.2, 1e8, 5e6), "sand": consolidation(SAND, 1e-5, 0.7, 1e4, 1e2),
         "elastic": consolidation(ELASTIC, 1e-8, 0.8, 1e7, 1e6), "column": column, "block": block, "dry sand": fallen, "weight": dropped,
         "footing": footing, "pounded": pounded, "heat": heated}

M, P, B, S = "materials/soil/", "physics/ground/", "boundary conditions/", "stages/"
LAW, START = M + "skeleton/", P + "initial state/"

MISTAKES = [
    # densities
    ("elastic", {M + "grain density": 2.65}, "grain density"),
    ("elastic", {M + "grain density": 26.5}, "grain density"),
    ("sand", {M + "grain density": 2650e3}, "grain density"),
    ("clay", {M + "grain density": 1700.0}, "grain density"),
    ("column", {M + "density": 1.8}, "density"),
    ("column", {M + "density": 18.0}, "density"),
    ("dry sand", {M + "density": 18000.0}, "density"),
    ("clay", {M + "fluid/density": 1.0, M + "fluid/unit weight": 9810.0}, "water density"),
    ("sand", {M + "fluid/density": 9.81, M + "fluid/unit weight": 9810.0}, "water density"),
    ("elastic", {M + "fluid/density": 9810.0}, "water density"),
    ("clay", {M + "fluid/bulk modulus": 2.2e6}, "water bulk modulus"),
    ("sand", {M + "fluid/bulk modulus": 2.2}, "water bulk modulus"),
    ("sand", {M + "fluid/unit weight": 9.81}, "water unit weight"),
    ("sand", {M + "fluid/unit weight": 1000.0}, "water unit weight"),
    # gravity
    ("dry sand", {P + "gravity": -9810.0}, "gravity"),
    ("dry sand", {P + "gravity": -981.0}, "gravity"),
    ("dry sand", {P + "gravity": -1.0}, "gravity"),
    ("weight", {P + "gravity": 9.81}, "gravity direction"),
    ("weight", {P + "gravity": "aside"}, "gravity direction"),
    ("weight", {P + "gravity factor": 9.81}, "gravity"),
    ("weight", {P + "gravity factor": 1.0}, "sudden weight"),
    ("sand", {P + "gravity": 0.0, P + "initial state": None, B + "drained": {"type": "hydrostatic pressure", "set": "top", "water level": 0.0}},
     "gravity"),
    ("block", {P + "mass damping": 0.1}, "damping of inertia"),
    ("block", {S + "press/reset displacements": True, S + "again": steps("quasi-static", 1.0, 0.1)},
     "displacement after reset"),
    # strength
    ("dry sand", {LAW + "friction angle [deg]": 0.56, LAW + "dilation angle [deg]": 0.0, START + "K0": 0.995}, "friction angle"),
    ("dry sand", {LAW + "friction angle [deg]": 0.62, LAW + "dilation angle [deg]": 0.0, START + "K0": 0.995}, "friction angle"),
    ("dry sand", {LAW + "friction angle [deg]": 55.0}, "friction angle"),
    ("dry sand", {LAW + "dilation angle [deg]": 0.07}, "dilation angle"),
    ("dry sand", {LAW + "friction angle [deg]": 36.0, LAW + "dilation angle [deg]": 36.0}, "dilation angle"),
    ("dry sand", {LAW + "cohesion": 5.0}, "cohesion"),
    ("dry sand", {LAW + "cohesion": 50.0}, "cohesion"),
    ("dry sand", {LAW + "cohesion gradient": 2.0}, "cohesion gradient"),
    ("dry sand", {LAW + "tensile strength": 5.0}, "tensile strength"),
    ("block", {LAW + "undrained strength": 20.0}, "undrained strength"),
    ("block", {LAW + "undrained strength gradient": 1.5}, "strength gradient"),
    ("block", {LAW + "rate law": "logarithmic", LAW + "rate coefficient": 10.0}, "rate coefficient"),
    ("block", {LAW + "rate law": "power", LAW + "rate exponent": 0.5}, "rate exponent"),
    ("block", {LAW + "rate law": "power", LAW + "reference strain rate": 1e-10}, "reference strain rate"),
    ("block", {LAW + "sensitivity": 300.0}, "sensitivity"),
    ("block", {LAW + "sensitivity": 3.0, LAW + "ductility": 0.1}, "ductility"),
    ("block", {LAW + "small-strain stiffness": {"ratio": 5.0, "reference strain": 0.015}}, "small-strain reference"),
    ("block", {LAW + "small-strain stiffness": {"ratio": 50.0, "reference strain": 1e-4}}, "small-strain ratio"),
    ("clay", {LAW + "critical stress ratio": 0.4, START + "K0": 0.8}, "critical stress ratio"),
    ("clay", {LAW + "critical stress ratio": 2.5}, "critical stress ratio"),
    ("clay", {LAW + "minimum mean stress": 4e4, START + "surcharge": 1e5}, "minimum mean stress"),
    # stiffness
    ("block", {LAW + "shear modulus": 2e3}, "shear modulus"),
    ("block", {LAW + "shear modulus": 1e5}, "rigidity index"),
    ("block", {LAW + "shear modulus": None, LAW + "rigidity index": 2.0}, "rigidity index"),
    ("column", {LAW + "Young's modulus": 1e4}, "shear modulus"),
    ("dry sand", {LAW + "Young's modulus": 8e4}, "weight over stiffness"),
    ("block", {LAW + "Poisson's ratio": 0.3}, "undrained Poisson's ratio"),
    ("elastic", {LAW + "Poisson's ratio": 0.49}, "drained Poisson's ratio"),
    ("dry sand", {LAW + "stiffness exponent": 0.5, LAW + "reference pressure": 100.0}, "reference pressure"),
    ("elastic", {M + "grain bulk modulus": 3.6e7}, "grain compressibility"),
    ("elastic", {M + "Biot coefficient": 0.5}, "grain compressibility"),
    # compression and void ratio
    ("clay", {LAW + "compression slope": 0.46}, "compression slope"),
    ("clay", {LAW + "swelling slope": 0.092}, "swelling ratio"),
    ("clay", {LAW + "swelling slope": 0.004}, "swelling ratio"),
    ("clay", {M + "void ratio": 0.545}, "compression by void ratio"),
    ("clay", {M + "void ratio": None, M + "porosity": 0.83}, "porosity"),
    ("clay", {M + "void ratio": 120.0}, "void ratio"),
    # conductivity
    ("clay", {M + "permeability/hydraulic conductivity": 1e-16}, "clay conductivity"),
    ("clay", {M + "permeability/hydraulic conductivity": 8.64e-5}, "clay conductivity"),
    ("clay", {M + "permeability/hydraulic conductivity": 3e-2}, "clay conductivity"),
    ("sand", {M + "permeability/hydraulic conductivity": 1e-12}, "sand conductivity"),
    ("sand", {M + "permeability/hydraulic conductivity": 0.864}, "sand conductivity"),
    ("sand", {M + "permeability/hydraulic conductivity": 8.0}, "hydraulic conductivity"),
    ("clay", {M + "permeability/type": "log-linear", M + "permeability/permeability index": 5.0}, "permeability index"),
    # the start
    ("clay", {START + "surcharge": 10.0}, "surcharge"),
    ("clay", {START + "preoverburden pressure": 50.0}, "preoverburden pressure"),
    ("elastic", {START + "K0": 50.0}, "K0"),
    ("elastic", {START + "K0": 0.1}, "K0"),
    ("clay", {START + "K0": None, START + "K0 friction angle [deg]": 0.44}, "K0 friction angle"),
    ("elastic", {START + "K0": None, START + "K0 friction angle [deg]": 30.0, START + "overconsolidation ratio": 90.0},
     "overconsolidation"),
    ("elastic", {START + "water level": -3.0, B + "drained/value": -29430.0}, "suction"),
    ("elastic", {M + "retention": {"type": "van genuchten", "reference suction": 10.0}}, "reference suction"),
    ("elastic", {START + "water level": -3.0, M + "retention": {"type": "exponential", "reference suction": 500.0}},
     "drying cells"),
    ("elastic", {START + "water level": None}, "water at rest"),
    ("elastic", {START + "water level": 4.0}, "drawdown"),
    ("sand", {P + "gravity": 0.0, P + "initial state": {"type": "uniform", "effective stress yy": 100.0, "effective stress zz": 100.0}},
     "initial stress"),
    ("elastic", {P + "gravity": 0.0, P + "initial state": {"type": "uniform", "effective stress yy": -1e5, "effective stress zz": -1e5}},
     "initial stress"),
    # heat
    ("heat", {P + "reference temperature": 283.0}, "temperature"),
    ("heat", {P + "initial temperature": 293.0}, "temperature"),
    ("heat", {B + "warm/value": 303.0}, "temperature"),
    ("heat", {P + "water heat capacity": 4.186}, "water heat capacity"),
    ("heat", {P + "water expansion": 0.02}, "water expansion"),
    ("heat", {M + "heat/grain heat capacity": 0.8}, "grain heat capacity"),
    ("heat", {M + "heat/grain expansion": 30.0}, "grain expansion"),
    ("heat", {M + "heat/conductivity": 1500.0}, "heat conductivity"),
    # loads
    ("clay", {B + "fill/value": 30.0}, "load"),
    ("elastic", {B + "fill/value": 3e7}, "load over stiffness"),
    ("elastic", {B + "fill/value": -3e4}, "load direction"),
    ("elastic", {B + "fill": "traction up"}, "load direction"),
    ("elastic", {B + "fill/value": "3e4 * (t > 1e9)"}, "load at all"),
    ("elastic", {B + "drained/value": 50.0}, "prescribed pore pressure"),
    ("elastic", {B + "drained/value": 5e4}, "drawdown"),
    ("elastic", {B + "inflow": {"type": "flux", "set": "bottom", "value": -1e-3}}, "hydraulic gradient"),
    ("elastic", {B + "base water": {"type": "hydrostatic pressure", "set": "bottom", "water level": 0.0, "unit weight": 9.81}},
     "hydrostatic unit weight"),
    ("block", {B + "plate": "20 mm"}, "prescribed displacement"),
    # times
    ("column", {B + "blast/value": "5e4 * sin(2000 * pi * t)"}, "load steps"),
    ("column", {B + "blast/value": "5e4 * min(1, t / 1e-4)"}, "load steps"),
    ("column", {S + "shake/time step/initial": 0.25}, "wave step"),
    ("elastic", {S + "wait/duration": 10.0, S + "wait/time step/initial": 1.0}, "consolidation time"),
    ("sand", {S + "wait/duration": 1e9, S + "wait/time step/initial": 1e7}, "consolidation time"),
    ("elastic", {B + "drained": None}, "drained nodes"),
    ("elastic", {S + "wait/time step/initial": 1.0, S + "wait/duration": 1e8}, "steps"),
    ("column", {P + "mass damping": 80.0}, "damping ratio"),
    ("column", {P + "stiffness damping": 0.05}, "damping ratio"),
    ("column", {P + "mass damping": 500.0}, "mass damping"),
    ("column", {"solver/residual tolerance": 0.05}, "residual tolerance"),
    ("column", {"solver/update tolerance": 0.2}, "update tolerance"),
    # meshes
    ("column", {"mesh": {"cell": "quad4"}, LAW + "Poisson's ratio": 0.49, "physics/ground/volume strain": "at points"}, "linear cells"),
    ("column", {"mesh": {"cell": "tri3"}, LAW + "Poisson's ratio": 0.49}, "linear cells"),
    ("block", {"mesh": {"cell": "tri3"}, LAW + "Poisson's ratio": 0.45}, "yielding linear cells"),
    ("column", {"mesh": {"scale": 1000.0}}, "mesh size"),
    ("footing", {"mesh": {"geometry file": "coarse.geo"}}, "cells under a load"),
    ("footing", {"mesh": {"geometry file": "narrow.geo"}}, "domain width"),
    ("footing", {"mesh": {"geometry file": "shallow.geo"}}, "domain depth"),
    ("footing", {LAW: "sand"}, "domain width"),
    ("pounded", {"mesh": {"geometry file": "narrow.geo"}}, "absorbing distance"),
]


def changed(deck, changes, space):
    """The deck with the changes of a row."""
    deck = copy.deepcopy(deck)
    for path, value in changes.items():
        if path == LAW and value == "sand":
            deck["materials"]["soil"]["skeleton"] = dict(SAND, **{"friction angle [deg]": 40.0})
            continue
        if path == "mesh":
            deck["mesh"] = changed_mesh(deck["mesh"], value, space)
            continue
        *sections, name = path.split("/")
        inner = deck
        for section in sections:
            inner = inner.setdefault(section, {})
        if name == "gravity":
            value = ([9.81, 0.0] + ([0.0] if space else [])) if value == "aside" else vector(space, value)
        elif value == "traction up":
            value = {"type": "traction", "set": "top", "z" if space else "y": 3e4}
        elif value == "20 mm":
            value = {"type": "displacement", "set": "top", "z" if space else "y": "-20 * t"}
        if value is None:
            del inner[name]
        else:
            inner[name] = value
    return deck


def changed_mesh(old, change, space):
    if "geometry file" in change:
        new = copy.deepcopy(old)
        (new["plane"] if space else new)["file"] = change["geometry file"]
        return new
    if "scale" in change:
        return dict(old, lower=[change["scale"] * x for x in old["lower"]], upper=[change["scale"] * x for x in old["upper"]])
    return mesh(space, cells=change.get("cells", (2, 4)), cell=change.get("cell"))
