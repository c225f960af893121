"""Mistakes in the section "mesh motion"."""
from wrong_deck import Wrong, parameter, section

BOTH = (1, 2)


def motion(inside):
    return (section("stages"), f'<ParameterList name="mesh motion">{inside}</ParameterList>\n  ' + section("stages"))


def boundary(*parameters):
    return motion('<ParameterList name="boundary">' + "".join(parameters) + "</ParameterList>")


def part(name, kind):
    return motion(f'<ParameterList name="{name}">' + parameter("type", "string", kind) + "</ParameterList>")


def part_of(name, *parameters):
    return motion(f'<ParameterList name="{name}">' + "".join(parameters) + "</ParameterList>")


DECKS = [
    Wrong("mesh motion type", part("interior", "optimization"),
          "mesh motion/interior/type: unknown mesh motion type 'optimization' (did you mean 'optimisation'?); "
          "known types: optimisation, elastic", ranks=BOTH),
    Wrong("mesh motion of old", part("interior", "Winslow"),
          "mesh motion/interior/type: unknown mesh motion type 'Winslow'; known types: optimisation, elastic"),
    Wrong("remap type", part("remap", "convektion"),
          "mesh motion/remap/type: unknown remap type 'convektion' (did you mean 'convection'?); known types: convection"),
    Wrong("mesh motion part", motion('<ParameterList name="boundry"/>'), "mesh motion/boundry: unknown section (did you mean 'boundary'?)"),
    Wrong("mesh motion parameter", motion(parameter("evry", "int", "2")), "mesh motion/evry: unknown parameter (did you mean 'every'?)"),
    Wrong("lowest quality", motion(parameter("lowest quality", "double", "1.5")),
          "mesh motion/lowest quality: 1.5 is out of range; allowed: (0, 1)"),
    Wrong("focus", boundary(parameter("focus", "string", "bal"), parameter("size near focus", "double", "0.1")),
          "mesh motion/boundary/focus: unknown body 'bal' (did you mean 'ball'?)", ranks=BOTH),
    Wrong("support of a mesh that moves", [
        motion(""), (section("boundary conditions"), section("boundary conditions") + section("hole") + parameter("type", "string", "in-situ support") +
                     parameter("set", "string", "top") + "</ParameterList>"),
        ('value="{base, axis, far side, drained surface, surcharge}"', 'value="{base, axis, far side, drained surface, surcharge, hole}"')],
        "stages/push/conditions: 'hole' holds nodes, which must not move against the soil: leave it out of this stage, or give the stage "
        "'mesh motion' = false", at='surcharge, hole}"', ranks=BOTH),
    Wrong("focus without size", boundary(parameter("focus", "string", "ball")),
          "mesh motion/boundary/size near focus: must be positive where a focus is given"),
    Wrong("corner set", boundary(parameter("corners", "Array(string)", "{edge}")),
          "mesh motion/boundary/corners: unknown point set 'edge'; none is allowed here", ranks=BOTH),
    Wrong("material side", boundary(parameter("material sides", "Array(string)", "{tip}")),
          "mesh motion/boundary/material sides: unknown side set 'tip' (did you mean 'top'?)"),
    Wrong("remeshing parameter", part_of("remeshing", parameter("wall sise", "double", "0.1")),
          "mesh motion/remeshing/wall sise: unknown parameter (did you mean 'wall size'?)"),
    Wrong("remeshing quality", part_of("remeshing", parameter("when quality below", "double", "1.0")),
          "mesh motion/remeshing/when quality below: 1 is out of range; allowed: [0, 1)"),
    Wrong("remeshing of quadrilaterals", part_of("remeshing"),
          "mesh motion/remeshing: the mesh has cells quad9; only meshes of triangles (tri3, tri6) and tetrahedra (tet4, tet10) can be remeshed", ranks=BOTH),
]
