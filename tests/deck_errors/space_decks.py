"""Wrong decks in three dimensions: space_base.xml with one thing spoilt."""
import os

from wrong_deck import HERE, Wrong, parameter, section, whole

with open(os.path.join(HERE, "space_base.xml")) as _file:
    BASE = _file.read()

BOTH = (1, 2)
GEOMETRY = parameter("geometry", "string", "three-dimensional")
CELL = parameter("cell", "string", "tet10")
CELLS = parameter("cells", "Array(int)", "{2, 2, 2}")
UPPER = parameter("upper", "Array(double)", "{2.0, 2.0, 2.0}")
GRAVITY = parameter("gravity", "Array(double)", "{0.0, 0.0, -9.81}")
PROBE = parameter("centre", "Array(double)", "{0.0, 0.0, 2.0}")


def wrong(*arguments, **more):
    return Wrong(*arguments, base=BASE, **more)


def before(name, text):
    return (section(name), text + section(name))


def beside(old, *new):
    return (old, old + "".join(new))


def with_mesh(*entries):
    plane = section("plane") + parameter("type", "string", "box") + parameter("cells", "Array(int)", "{2, 2}")
    plane += parameter("upper", "Array(double)", "{1.0, 1.0}") + "</ParameterList>"
    return (whole("mesh", BASE), "  " + section("mesh") + "\n" + "\n".join(entries) + GEOMETRY + plane + "\n  </ParameterList>\n")


def with_section(name, inner, *entries):
    return before("boundary conditions", section(name) + section(inner) + "".join(entries) + "</ParameterList></ParameterList>\n  ")


DECKS = [
    wrong("gravity of two numbers", (GRAVITY, parameter("gravity", "Array(double)", "{0.0, -9.81}")),
          "physics/ground/gravity: expected 3 numbers, as the mesh's 'geometry' is 'three-dimensional'; given 2", ranks=BOTH),
    wrong("gravity of one number", (GRAVITY, parameter("gravity", "double", "9.81")),
          "physics/ground/gravity: expected an array of numbers (Array(double)), given the number 9.81"),
    wrong("cells of two numbers", (CELLS, parameter("cells", "Array(int)", "{2, 2}")),
          "mesh/cells: expected 3 numbers, given 2"),
    wrong("upper corner of two numbers", (UPPER, parameter("upper", "Array(double)", "{2.0, 2.0}")),
          "mesh/upper: expected 3 numbers, given 2"),
    wrong("probe of two numbers", (PROBE, parameter("centre", "Array(double)", "{0.0, 2.0}")),
          "output/probes/centre: expected 3 numbers, as the mesh's 'geometry' is 'three-dimensional'; given 2"),
    wrong("probe above the ground", (PROBE, parameter("centre", "Array(double)", "{0.0, 0.0, 2.5}")),
          "output/probes/centre: z = 2.5 lies outside the mesh, which reaches from 0 to 2", ranks=BOTH),
    wrong("probe beside the ground", (PROBE, parameter("centre", "Array(double)", "{0.0, -1.0, 2.0}")),
          "output/probes/centre: y = -1 lies outside the mesh, which reaches from 0 to 2"),
    wrong("moving probe", (PROBE, section("centre") + parameter("point", "Array(double)", "{0.0, 0.0, 2.0}") + parameter("moves with", "string", "nothing") + "</ParameterList>"),
          "output/probes/centre: a probe that is no node is not available in three dimensions yet; give the place of a node"),
    wrong("cell of the plane", (CELL, parameter("cell", "string", "tri6")),
          "mesh/cell: 'tri6' is a cell of the plane, and the geometry is 'three-dimensional'; allowed: hex27, tet10, hex8, tet4"),
    wrong("unknown cell", (CELL, parameter("cell", "string", "tet11")),
          "mesh/cell: 'tet11' is not a choice (did you mean 'tet10'?)"),
    wrong("linear tetrahedra", (CELL, parameter("cell", "string", "tet4")),
          "physics/ground/type: linear tet4 cells give an unstable displacement and pore-pressure pair; use quadratic cells (tet10 or hex27, in Gmsh: order 2), or give 'pressure' = 'equal order'", at=parameter("type", "string", "biot"), ranks=BOTH),
    wrong("linear hexahedra", (CELL, parameter("cell", "string", "hex8")),
          "physics/ground/type: linear hex8 cells give an unstable displacement and pore-pressure pair; use quadratic cells (tet10 or hex27, in Gmsh: order 2), or give 'pressure' = 'equal order'", at=parameter("type", "string", "biot")),
    wrong("equal order on quadratic cells", beside(parameter("type", "string", "biot"), parameter("pressure", "string", "equal order")),
          "physics/ground/pressure: equal order is for linear cells; the mesh has tet10"),
    wrong("misspelt equal order", beside(parameter("type", "string", "biot"), parameter("pressure", "string", "equal-order")),
          "physics/ground/pressure: 'equal-order' is not a choice (did you mean 'equal order'?)"),
    wrong("axisymmetric hexahedra", [(GEOMETRY, parameter("geometry", "string", "axisymmetric")), (CELL, parameter("cell", "string", "hex27"))],
          "output/probes/centre: expected 2 numbers, as the mesh's 'geometry' is not 'three-dimensional'; given 3", at=PROBE),
    wrong("misspelt geometry", [(GEOMETRY, parameter("geometry", "string", "3d")), (PROBE, ""), (GRAVITY, "")],
          "mesh/geometry: '3d' is not a choice; allowed: plane strain, axisymmetric, three-dimensional"),
    wrong("quadrature beyond tetrahedra", beside(GRAVITY, parameter("quadrature degree", "int", "7")),
          "physics/ground/type: the physics cannot be used: tetrahedron quadrature exists for the degrees 1 to 6, not 7", at=parameter("type", "string", "biot")),
    wrong("component of a radius", (parameter("components", "string", "x"), parameter("components", "string", "r")),
          "boundary conditions/sides in x/components: 'r' is not a choice; allowed: x, y, x y, z, x z, y z, x y z"),
    wrong("displacement without components", (parameter("y", "double", "0.0"), ""),
          "boundary conditions/front: at least one of 'x', 'y' and 'z' must be given", at=section("front")),
    wrong("fourth direction", (parameter("z", "string", "patch"), parameter("w", "string", "patch")),
          "boundary conditions/load/w: unknown parameter; allowed: type, set, x, y, z"),
    wrong("expression of a radius", ("(x &lt; 1)", "(r &lt; 1)"),
          "functions/patch/value: invalid expression '-1e3*(r < 1)*(y < 1)': unexpected token 'r' found at position 6; variables: t, x, y, z"),
    wrong("expression of an unknown variable", ("(y &lt; 1)", "(q &lt; 1)"),
          "functions/patch/value: invalid expression '-1e3*(x < 1)*(q < 1)': unexpected token 'q' found at position 14; variables: t, x, y, z"),
    wrong("set that no box has", (parameter("set", "string", "front"), parameter("set", "string", "lower")),
          "boundary conditions/front/set: unknown mesh set 'lower'; allowed: back, bottom, front, left, right, top"),
    wrong("misspelt side", (parameter("set", "string", "bottom"), parameter("set", "string", "botom")),
          "boundary conditions/base/set: unknown mesh set 'botom' (did you mean 'bottom'?)"),
    wrong("geostatic start without gravity", (GRAVITY, ""),
          "physics/ground/initial state/type: a geostatic start needs gravity: give the physics a 'gravity'", at=parameter("type", "string", "geostatic")),
    wrong("region that no box has", beside(parameter("porosity", "double", "0.4"), parameter("regions", "Array(string)", "{clay}")),
          "materials/soil/regions: unknown mesh region 'clay'; allowed: soil"),
    wrong("bodies in space", with_section("bodies", "pile", parameter("mass", "double", "1.0")),
          "bodies: not available in three dimensions yet", ranks=BOTH),
    wrong("contacts in space", with_section("contacts", "face", parameter("type", "string", "penalty")),
          "contacts: not available in three dimensions yet"),
    wrong("mesh motion in space", with_section("mesh motion", "interior", parameter("type", "string", "elastic")),
          "mesh motion: not available in three dimensions yet"),
    wrong("shear stress by another name", beside(parameter("type", "string", "geostatic"), parameter("shear stress zx", "double", "1.0")),
          "physics/ground/initial state/shear stress zx: unknown parameter (did you mean 'shear stress xz'?)"),
    wrong("extrusion without a length", with_mesh(parameter("type", "string", "extruded")),
          "mesh: required parameter 'length' is missing", at=section("mesh")),
    wrong("revolution of more than a turn", with_mesh(parameter("type", "string", "revolved"), parameter("angle", "double", "400.0"), parameter("layers", "int", "2")),
          "mesh/angle: 400 is out of range; allowed: (0, 360]", at=parameter("angle", "double", "400.0")),
]
