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


def in_the_plane(*entries):
    """The same without its geometry."""
    old, new = with_mesh(*entries)
    return old, new.replace(GEOMETRY, "")


def with_section(name, inner, *entries):
    return before("boundary conditions", section(name) + section(inner) + "".join(entries) + "</ParameterList></ParameterList>\n  ")


SPHERE = parameter("type", "string", "sphere")
MOTION = section("motion") + parameter("type", "string", "prescribed displacement")
CONTACT = parameter("type", "string", "penalty")
BODY = parameter("body", "string", "ball")
POSITION = parameter("position", "Array(double)", "{1.0, 1.0, 2.0}")
REVOLVED = section("surface") + parameter("type", "string", "revolved") + section("contour") + SPHERE + parameter("diameter", "double", "2.0") + "</ParameterList></ParameterList>"


def with_ball(name, changes, message, surface=REVOLVED, more="", **where):
    """A ball on the ground, with something changed."""
    lines = [section("bodies"), section("ball"), parameter("position", "Array(double)", "{1.0, 1.0, 2.0}"), surface, more,
             MOTION, "</ParameterList>", "</ParameterList>", "</ParameterList>", section("contacts"), section("face"), CONTACT, BODY,
             parameter("surface", "string", "top"), "</ParameterList>", "</ParameterList>"]
    text = "\n".join(line for line in lines if line)
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    return wrong(name, before("boundary conditions", text.replace("><", ">\n<") + "\n  "), message, **where)


FREE = parameter("type", "string", "free")
MASS = parameter("mass", "double", "1e3")
INERTIA = parameter("inertia tensor", "Array(double)", "{1.0, 1.0, 1.0, 0.0, 0.0, 0.0}")
CUP = REVOLVED.replace(SPHERE, parameter("type", "string", "polyline") + parameter("x", "Array(double)", "{0.0, 1.0}") + parameter("y", "Array(double)", "{0.0, 1.0}")).replace(parameter("diameter", "double", "2.0"), "")


def with_free(name, entries, message, mass=MASS, at=None, **where):
    """The ball set free, with entries of its motion more."""
    return with_ball(name, [(MOTION, mass + "\n" + section("motion") + FREE + "".join(entries))], message, at=at or entries[0], **where)


def with_pair(name, entry, message, more=()):
    """Top and bottom of the box as two surfaces, with one entry more, and what else it takes."""
    both = parameter("slave", "string", "top") + parameter("master", "string", "bottom")
    lines = [section("contacts"), section("face"), parameter("type", "string", "point to face"), both, entry, *more,
             "</ParameterList>", "</ParameterList>"]
    return wrong(name, before("boundary conditions", "\n".join(lines) + "\n  "), message, at=entry)


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
    wrong("moving probe of two numbers", (PROBE, section("centre") + parameter("point", "Array(double)", "{0.0, 2.0}") + parameter("moves with", "string", "nothing") + "</ParameterList>"),
          "output/probes/centre/point: expected 3 numbers, as the mesh's 'geometry' is 'three-dimensional'; given 2"),
    wrong("cell of the plane", (CELL, parameter("cell", "string", "tri6")),
          "mesh/cell: 'tri6' is a cell of the plane, and the geometry is 'three-dimensional'; allowed: hex27, tet10, hex8, tet4, wedge15, wedge18, wedge6"),
    wrong("unknown cell", (CELL, parameter("cell", "string", "tet11")),
          "mesh/cell: 'tet11' is not a choice (did you mean 'tet10'?)"),
    wrong("linear tetrahedra", (CELL, parameter("cell", "string", "tet4")),
          "physics/ground/type: linear tet4 cells give an unstable displacement and pore-pressure pair; use quadratic cells (tet10, wedge15 or hex27, in Gmsh: order 2), or give 'pressure' = 'equal order'", at=parameter("type", "string", "biot"), ranks=BOTH),
    wrong("linear hexahedra", (CELL, parameter("cell", "string", "hex8")),
          "physics/ground/type: linear hex8 cells give an unstable displacement and pore-pressure pair; use quadratic cells (tet10, wedge15 or hex27, in Gmsh: order 2), or give 'pressure' = 'equal order'", at=parameter("type", "string", "biot")),
    wrong("equal order on quadratic cells", beside(parameter("type", "string", "biot"), parameter("pressure", "string", "equal order")),
          "physics/ground/pressure: equal order is for linear cells; the mesh has tet10"),
    wrong("misspelt equal order", beside(parameter("type", "string", "biot"), parameter("pressure", "string", "equal-order")),
          "physics/ground/pressure: 'equal-order' is not a choice (did you mean 'equal order'?)"),
    wrong("axisymmetric hexahedra", [(GEOMETRY, parameter("geometry", "string", "axisymmetric")), (CELL, parameter("cell", "string", "hex27"))],
          "mesh/cell: 'hex27' is a cell of space, and the geometry is one of the plane; allowed: quad9, tri6, quad4, tri3", at=parameter("cell", "string", "hex27")),
    wrong("probe of three numbers", [(GEOMETRY, parameter("geometry", "string", "plane strain")), (CELL, parameter("cell", "string", "quad9")), (CELLS, parameter("cells", "Array(int)", "{2, 2}")),
                                     (UPPER, parameter("upper", "Array(double)", "{2.0, 2.0}"))],
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
          "functions/patch/value: invalid expression '-1e3*(r < 1)*(y < 1)': unexpected token 'r' found at position 6; variables: t, x, y, z; those of the deck stand in braces, {D}"),
    wrong("expression of an unknown variable", ("(y &lt; 1)", "(q &lt; 1)"),
          "functions/patch/value: invalid expression '-1e3*(x < 1)*(q < 1)': unexpected token 'q' found at position 14; variables: t, x, y, z; those of the deck stand in braces, {D}"),
    wrong("set that no box has", (parameter("set", "string", "front"), parameter("set", "string", "lower")),
          "boundary conditions/front/set: unknown mesh set 'lower'; allowed: back, bottom, front, left, right, top"),
    wrong("misspelt side", (parameter("set", "string", "bottom"), parameter("set", "string", "botom")),
          "boundary conditions/base/set: unknown mesh set 'botom' (did you mean 'bottom'?)"),
    wrong("geostatic start without gravity", (GRAVITY, ""),
          "physics/ground/initial state/type: a geostatic start needs gravity: give the physics a 'gravity'", at=parameter("type", "string", "geostatic")),
    wrong("region that no box has", beside(parameter("porosity", "double", "0.4"), parameter("regions", "Array(string)", "{clay}")),
          "materials/soil/regions: unknown mesh region 'clay'; allowed: soil"),
    with_ball("body without a surface", [], "bodies/ball/surface: required parameter 'type' is missing; known surface types: revolved, box, union, triangulation", surface="", at=section("ball"), ranks=BOTH),
    with_ball("contour in space", [], "bodies/ball/contour: a body in space has a 'surface'; a contour is turned into one by the type 'revolved'",
              more=section("contour") + parameter("type", "string", "sphere") + parameter("diameter", "double", "1.0") + "</ParameterList>", surface="", at=section("contour")),
    with_ball("place of a body in the plane", [("{1.0, 1.0, 2.0}", "{1.0, 2.0}")],
              "bodies/ball/position: expected 3 numbers, as the mesh's 'geometry' is 'three-dimensional'; given 2", at=parameter("position", "Array(double)", "{1.0, 2.0}")),
    with_ball("cylinder that lies in space", [(SPHERE, parameter("type", "string", "cylinder"))],
              "bodies/ball/surface/contour/type: 'cylinder' lies across the plane, and turned around an axis it is another body; a sphere is called so, a disc is a 'flat pile' or a 'polyline', a bar a 'box'", at=parameter("type", "string", "cylinder")),
    with_ball("misspelt surface", [("revolved", "revolfed")], "bodies/ball/surface/type: unknown surface type 'revolfed' (did you mean 'revolved'?); known types: revolved, box, union, triangulation", at=parameter("type", "string", "revolfed")),
    with_ball("displacement that does not change", [(MOTION, MOTION + parameter("z", "double", "-0.1"))],
              "bodies/ball/motion/z: is constant, and only its changes count: give a function of time, such as -0.01*t", at=parameter("z", "double", "-0.1")),
    with_ball("rotation that does not change", [(MOTION, MOTION + parameter("rotation y", "string", "pi/8"))],
              "bodies/ball/motion/rotation y: is constant, and only its changes count: give a function of time, such as -0.01*t", at=parameter("rotation y", "string", "pi/8")),
    with_free("free body without a mass", [], "bodies/ball/motion/type: a free body needs a 'mass' greater than 0", at=FREE, mass="", ranks=BOTH),
    with_free("unknown freedom in space", [parameter("freedom", "Array(string)", "{x, rotation}")],
              "bodies/ball/motion/freedom: unknown direction 'rotation'; known: x, y, z, rotation x, rotation y, rotation z"),
    with_free("no freedom in space", [parameter("freedom", "Array(string)", "{}")],
              "bodies/ball/motion/freedom: a body without a free direction has the motion 'held'"),
    with_free("moment on a body that does not turn", [parameter("moment y", "double", "1.0"), parameter("freedom", "Array(string)", "{x, y, z}")],
              "bodies/ball/motion/moment y: the body does not move in this direction (its 'freedom' lacks rotation y)"),
    with_free("force on a body that does not yield", [parameter("force z", "double", "1.0"), parameter("freedom", "Array(string)", "{x, y}")],
              "bodies/ball/motion/force z: the body does not move in this direction (its 'freedom' lacks z)"),
    with_free("moment of the plane in space", [parameter("moment", "double", "1.0")],
              "bodies/ball/motion/moment: unknown parameter (did you mean 'moment x'?)"),
    with_free("spin of a body that does not turn", [parameter("initial spin", "Array(double)", "{0.0, 1.0, 0.0}"), parameter("freedom", "Array(string)", "{z}")],
              "bodies/ball/motion/initial spin: the body does not move in this direction (its 'freedom' lacks rotation x)"),
    with_free("spin of one number", [parameter("initial spin", "double", "1.0")],
              "bodies/ball/motion/initial spin: expected an array of numbers (Array(double)), given the number 1"),
    with_free("initial velocity of the plane", [parameter("initial velocity", "Array(double)", "{0.0, 1.0}")],
              "bodies/ball/motion/initial velocity: expected 3 numbers, as the mesh's 'geometry' is 'three-dimensional'; given 2"),
    with_free("prescribed spin of a body that turns freely", [section("prescribed velocity"), parameter("spin y", "double", "1.0"), "</ParameterList>"],
              "bodies/ball/motion/prescribed velocity: the body rotates freely about all of its axes: it takes no prescribed spin", at=section("prescribed velocity")),
    with_free("prescribed velocity of a body that moves freely", [section("prescribed velocity"), parameter("velocity z", "double", "1.0"), "</ParameterList>"],
              "bodies/ball/motion/prescribed velocity/velocity z: the body moves freely in this direction", at=parameter("velocity z", "double", "1.0")),
    with_free("load without a point", [section("loads"), section("eye"), parameter("force x", "double", "1.0"), "</ParameterList>", "</ParameterList>"],
              "bodies/ball/motion/loads/eye: required parameter 'point' is missing", at=section("eye")),
    with_free("load at a point of the plane", [section("loads"), section("eye"), parameter("point", "Array(double)", "{0.0, 1.0}"), "</ParameterList>", "</ParameterList>"],
              "bodies/ball/motion/loads/eye/point: expected 3 numbers, as the mesh's 'geometry' is 'three-dimensional'; given 2", at=parameter("point", "Array(double)", "{0.0, 1.0}")),
    with_free("load by a wrong name", [section("loads"), section("eye"), parameter("point", "Array(double)", "{0.0, 0.0, 1.0}"), parameter("forces x", "double", "1.0"), "</ParameterList>", "</ParameterList>"],
              "bodies/ball/motion/loads/eye/forces x: unknown parameter (did you mean 'force x'?)", at=parameter("forces x", "double", "1.0")),
    with_free("loads without a name", [section("loads"), parameter("force x", "double", "1.0"), "</ParameterList>"],
              "bodies/ball/motion/loads/force x: unknown parameter; none is allowed here", at=parameter("force x", "double", "1.0")),
    with_free("drag by axis and for all", [section("water"), parameter("density", "double", "1e3"), parameter("drag coefficient", "double", "1.0"), parameter("drag coefficients", "Array(double)", "{1.0, 1.0, 1.0}"), "</ParameterList>"],
              "bodies/ball/motion/water/drag coefficients: there is a 'drag coefficient' for all directions", at=parameter("drag coefficients", "Array(double)", "{1.0, 1.0, 1.0}")),
    with_free("drag along two axes", [section("water"), parameter("density", "double", "1e3"), parameter("drag coefficients", "Array(double)", "{1.0, 1.0}"), "</ParameterList>"],
              "bodies/ball/motion/water/drag coefficients: needs three numbers, along the body's x, y and z axes", at=parameter("drag coefficients", "Array(double)", "{1.0, 1.0}")),
    with_free("drag areas without drag", [section("water"), parameter("density", "double", "1e3"), parameter("drag areas", "Array(double)", "{1.0, 1.0, 1.0}"), "</ParameterList>"],
              "bodies/ball/motion/water/drag areas: without 'drag coefficients' it does nothing", at=parameter("drag areas", "Array(double)", "{1.0, 1.0, 1.0}")),
    with_free("added mass along two axes", [section("water"), parameter("density", "double", "1e3"), parameter("added mass coefficients", "Array(double)", "{1.0, 1.0}"), "</ParameterList>"],
              "bodies/ball/motion/water/added mass coefficients: needs three numbers, along the body's x, y and z axes", at=parameter("added mass coefficients", "Array(double)", "{1.0, 1.0}")),
    with_free("added inertia without water", [section("water"), parameter("added moments of inertia", "Array(double)", "{1.0, 1.0, 1.0}"), "</ParameterList>"],
              "bodies/ball/motion/water/added moments of inertia: there is no water: its 'density' is 0 or missing", at=parameter("added moments of inertia", "Array(double)", "{1.0, 1.0, 1.0}")),
    with_free("drag moments without water", [section("water"), parameter("drag moments", "Array(double)", "{1.0, 1.0, 1.0}"), "</ParameterList>"],
              "bodies/ball/motion/water/drag moments: there is no water: its 'density' is 0 or missing", at=parameter("drag moments", "Array(double)", "{1.0, 1.0, 1.0}")),
    with_free("mudline in space", [section("water"), parameter("density", "double", "1e3"), parameter("mudline", "double", "2.0"), "</ParameterList>"],
              "bodies/ball/motion/water/mudline: a body in space is wholly in the water: it takes no 'mudline'", at=parameter("mudline", "double", "2.0")),
    with_free("water in an open cup", [section("water"), parameter("density", "double", "1e3"), "</ParameterList>"],
              "bodies/ball/motion/water/density: the body's surface is open: its buoyancy needs a 'volume' of the body", at=parameter("density", "double", "1e3"), surface=CUP, mass=MASS + INERTIA),
    with_free("open cup without an inertia tensor", [], "bodies/ball/motion/freedom: the body's surface is open: a body that may rotate needs an 'inertia tensor'", at=section("motion"), surface=CUP),
    with_ball("misspelt rotation", [(MOTION, MOTION + parameter("rotation w", "double", "1.0"))],
              "bodies/ball/motion/rotation w: unknown parameter (did you mean 'rotation x'?)", at=parameter("rotation w", "double", "1.0")),
    with_ball("body in the ground", [("{1.0, 1.0, 2.0}", "{1.0, 1.0, 1.0}")],
              "contacts/face/body: body 'ball' overlaps the surface by 1 m at (1, 1, 2) at the start, more than half of its shortest side, 1 m; move its 'position'", at=BODY),
    with_ball("body under the ground", [("{1.0, 1.0, 2.0}", "{1.0, 1.0, -8.0}")],
              "contacts/face/body: body 'ball' lies below the surface: its top is at -6 m, the surface reaches down to 2 m; move its 'position'", at=BODY),
    with_ball("contact at nodes in space", [(BODY, BODY + parameter("method", "string", "nodes"))],
              "contacts/face/method: nodes has no tributary areas on quadratic triangles; allowed in space: surface quadrature", at=parameter("method", "string", "nodes")),
    with_ball("quadrature beyond triangles", [(BODY, BODY + parameter("quadrature degree", "int", "9"))],
              "contacts/face/quadrature degree: on triangles the largest 'quadrature degree' is 8, given 9", at=parameter("quadrature degree", "int", "9")),
    with_ball("pair in space", [(CONTACT, parameter("type", "string", "mortar")), (BODY, parameter("slave", "string", "top") + parameter("master", "string", "bottom")), (parameter("surface", "string", "top"), "")],
              "contacts/face/type: is for the plane; allowed in space for two deformable surfaces: point to face", at=parameter("type", "string", "mortar")),
    with_ball("closing distance in space", [(BODY, BODY + parameter("closing distance", "double", "0.1"))],
              "contacts/face/closing distance: has a meaning only with 'initial gap' = closed or in-situ stress; here it is as placed",
              at=parameter("closing distance", "double", "0.1")),
    with_pair("closing distance of a pair", parameter("closing distance", "double", "0.1"),
              "contacts/face/closing distance: has a meaning only with 'initial gap' = closed or in-situ stress; here it is as placed"),
    with_ball("share of a strength that the soil does not have",
              [(BODY, BODY + section("friction") + parameter("type", "string", "coulomb")
                + parameter("coefficient", "double", "1.0") + parameter("alpha", "double", "0.5") + "</ParameterList>")],
              "contacts/face/friction/type: this law reads the undrained strength of the soil at 'top'; the law "
              "'linear elastic' of material 'soil' has none; 'coulomb' takes such soil with a 'drained coefficient'",
              at=parameter("type", "string", "coulomb"), ranks=BOTH),
    with_ball("full adhesion of none",
              [(BODY, BODY + section("friction") + parameter("type", "string", "coulomb")
                + parameter("coefficient", "double", "0.5") + parameter("full adhesion at", "double", "1e3")
                + "</ParameterList>")],
              "contacts/face/friction/full adhesion at: has a meaning only together with an 'adhesion'",
              at=parameter("full adhesion at", "double", "1e3")),
    with_pair("heat share without friction", parameter("slave heat share", "double", "0.5"),
              "contacts/face/slave heat share: has a meaning only with 'friction', which makes the heat"),
    with_pair("heat share without temperature", parameter("slave heat share", "double", "0.5"),
              "contacts/face/slave heat share: needs a model with the field 'temperature'",
              more=[section("friction"), parameter("type", "string", "coulomb"),
                    parameter("coefficient", "double", "0.3"), "</ParameterList>"]),
    with_pair("conductance of a pair", parameter("conductance", "double", "1e-9"), "contacts/face/conductance: has a meaning only with 'drainage' = leaky"),
    with_pair("pair of too high a degree", parameter("quadrature degree", "int", "9"), "contacts/face/quadrature degree: 9 is out of range; allowed: [1, 8]"),
    with_pair("pair without a master", parameter("mster", "string", "bottom"), "contacts/face/mster: unknown parameter (did you mean 'master'?)"),
    with_ball("unknown body in space", [(BODY, parameter("body", "string", "bal"))], "contacts/face/body: unknown body 'bal' (did you mean 'ball'?)", at=parameter("body", "string", "bal")),
    wrong("sliding boundary", with_section("mesh motion", "boundary", parameter("material sides", "Array(string)", "{tops}")),
          "mesh motion/boundary/material sides: unknown side set 'tops' (did you mean 'top'?)", ranks=BOTH),
    wrong("remeshing of hexahedra", [with_section("mesh motion", "remeshing", parameter("least steps", "int", "5")), (CELL, parameter("cell", "string", "hex27"))],
          "mesh motion/remeshing: the mesh has cells hex27; only meshes of triangles (tri3, tri6) and tetrahedra (tet4, tet10) can be remeshed"),
    wrong("remeshing of wedges", [with_section("mesh motion", "remeshing", parameter("least steps", "int", "5")), (CELL, parameter("cell", "string", "wedge15"))],
          "mesh motion/remeshing: the mesh has cells wedge15; only meshes of triangles (tri3, tri6) and tetrahedra (tet4, tet10) can be remeshed; "
          "a swept mesh has such with 'triangles become' = tetrahedra"),
    wrong("remeshing by an error in space", with_section("mesh motion", "remeshing", parameter("size", "string", "source")),
          "mesh motion/remeshing/size: is for meshes of the plane; sizes in space are those of the source",
          at=parameter("size", "string", "source"), ranks=BOTH),
    wrong("a node as a probe where space is remeshed", with_section("mesh motion", "remeshing", parameter("wall size", "double", "0.1")),
          "output/probes/centre: a node is lost when the mesh is remeshed ('mesh motion/remeshing'); give the probe 'moves with' a body or nothing",
          at=PROBE, ranks=BOTH),
    wrong("shear stress by another name", beside(parameter("type", "string", "geostatic"), parameter("shear stress zx", "double", "1.0")),
          "physics/ground/initial state/shear stress zx: unknown parameter (did you mean 'shear stress xz'?)"),
    wrong("extrusion without a length", with_mesh(parameter("type", "string", "extruded")),
          "mesh: required parameter 'length' is missing", at=section("mesh")),
    wrong("revolution of more than a turn", with_mesh(parameter("type", "string", "revolved"), parameter("angle", "double", "400.0"), parameter("layers", "int", "2")),
          "mesh/angle: 400 is out of range; allowed: (0, 360]", at=parameter("angle", "double", "400.0")),
    wrong("revolution without a geometry", in_the_plane(parameter("type", "string", "revolved"), parameter("angle", "double", "90.0"), parameter("layers", "int", "2")),
          "mesh/type: a revolved mesh is one of space: give the geometry 'three-dimensional'", at=parameter("type", "string", "revolved"), ranks=BOTH),
    wrong("extrusion without a geometry", in_the_plane(parameter("type", "string", "extruded"), parameter("length", "double", "1.0"), parameter("layers", "int", "2")),
          "mesh/type: an extruded mesh is one of space: give the geometry 'three-dimensional'", at=parameter("type", "string", "extruded")),
    with_ball("rotation of one number in space", [(POSITION, POSITION + "\n" + parameter("rotation", "Array(double)", "{30.0}"))],
              "bodies/ball/rotation: expected 3 numbers, a rotation vector in degrees, given 1", at=parameter("rotation", "Array(double)", "{30.0}")),
]
