"""Values of the wrong type, out of range, missing, or against one another."""
from wrong_deck import Wrong, parameter, section, whole

BOTH = (1, 2)
UPPER = parameter("upper", "Array(double)", "{0.3, 0.3}")
SKELETON = whole("skeleton")
HEAT = """<ParameterList name="heat">
        <Parameter name="conductivity" type="double" value="1.2"/>
        <Parameter name="grain heat capacity" type="double" value="800"/>
      </ParameterList>
"""


def without(text):
    return (text, "")


TOUCHED = parameter("surface", "string", "top")


def with_film(name, entry, message, **where):
    """The contact with a film of water, and an entry more."""
    return Wrong(name, (TOUCHED, TOUCHED + parameter("drainage", "string", "film") + entry), message, at=entry, **where)


GEOSTATIC = parameter("surcharge", "double", "20e3")


START = whole("initial state")
ONE_PHASE = [('value="biot"', 'value="solid"'), (whole("fluid"), ""), (whole("permeability"), "")]


def start_of(kind, *entries):
    """Another initial state, of that type with these entries alone."""
    lines = "".join(parameter(*entry) + "\n" for entry in entries)
    return (START, section("initial state") + "\n" + parameter("type", "string", kind) + "\n" + lines +
            "</ParameterList>\n")


def without_meaning(entry, kind, meaning, value="10e3", **where):
    """An entry of the initial state that its type does not read."""
    return Wrong(f"{entry} with {kind}", start_of(kind, (entry, "double", value)),
                 f"physics/ground/initial state/{entry}: has a meaning only with 'type' = {meaning}",
                 at=parameter(entry, "double", value), **where)


def changing(name, change, entry, kind="string"):
    """A number of the start that depends on the time."""
    return Wrong(f"{name} that changes", change,
                 f"{entry}: '1.5 + t' depends on the time; this number may depend on the place only",
                 at=parameter(name, kind, "1.5 + t"))


PROFILE = section("ratio") + "\n" + parameter("type", "string", "profile") + "\n" + \
    parameter("file", "string", "sounding.csv") + "\n{}\n</ParameterList>\n"


ODD = "; it holds '{}' ({}); numbers and units are written in plain ASCII, such as -1, m2, um, deg"
UNITS = ("%, GPa, J, K, MJ, MN, MPa, Mg, N, Pa, W, a, bar, cm, d, day, days, deg, degC, g, h, hour, hours, kJ, kN, kPa, kW, kg, km, m, min, mm, "
         "month, months, ms, rad, s, t, um, us, week, weeks, year, years")


def with_sounding(name, depth, value, message, at, rows="0,1.5\n10,1.2\n", **where):
    """The overconsolidation by two columns of a file."""
    columns = parameter("depth column", "string", depth) + "\n" + parameter("value column", "string", value)
    return Wrong(name, [(section("functions"), section("functions") + "\n" + PROFILE.format(columns)),
                        (parameter("overconsolidation ratio", "double", "1.5"),
                         parameter("overconsolidation ratio", "string", "ratio"))], message, at=at,
                 files=(("sounding.csv", f"{depth},{value}\n{rows}"),), **where)


def number(name, given, written, path, why, **where):
    """A number of the deck, written in a way that is none."""
    return Wrong(name, (f'type="double" value="{given}"', f'type="double" value="{written}"'),
                 f"{path}: expected a number (double), given '{written}'{why}", **where)


def with_variables(name, variables, value, message, at, **where):
    """The deck with variables, and a surcharge that may name them."""
    entries = "".join(parameter(*entry) + "\n" for entry in variables)
    return Wrong(name, [(section("mesh"), section("variables") + "\n" + entries + "</ParameterList>\n" + section("mesh")),
                        (GEOSTATIC, parameter("surcharge", "double", value))], message, at=at, **where)


PUSHED = parameter("duration", "double", "0.001")


def with_end(name, entries, message, at, **where):
    """The deck with something that ends the push early."""
    end = section("ends when") + section("enough") + "\n" + "".join(parameter(*entry) + "\n" for entry in entries) + \
        "</ParameterList></ParameterList>\n"
    return Wrong(name, (PUSHED, PUSHED + end), message, at=at, **where)


REDUCTION = section("strength reduction")
LARGEST = parameter("largest factor", "double", "2")


def with_reduction(name, message, at, entries=LARGEST, kind="quasi-static", step=parameter("initial", "double", "1e-4"),
                   skeleton=None, **where):
    """The deck whose push reduces the strength of `skeleton`, (type, entries...) in place of the clay's law."""
    push = section("push") + "\n" + parameter("type", "string", kind) + "\n" + PUSHED + "\n" + REDUCTION + "\n" + \
        entries + "</ParameterList>\n" + section("time step") + "\n" + step + "</ParameterList></ParameterList>\n"
    law = SKELETON
    if skeleton:
        entries_of_law = "".join(parameter(*entry) + "\n" for entry in skeleton)
        law = section("skeleton") + "\n" + entries_of_law + "</ParameterList>\n"
    return Wrong(name, [(whole("push"), push), (SKELETON, law)], message, at=at, **where)


ELASTIC = [("type", "string", "linear elastic"), ("Young's modulus", "double", "1e7"),
           ("Poisson's ratio", "double", "0.3")]
ELASTIC_LAW = section("skeleton") + "".join(parameter(*entry) for entry in ELASTIC) + "</ParameterList>\n"
PRESSED = section("pressed") + parameter("type", "string", "pressure") + parameter("set", "string", "right") + \
    parameter("value", "string", "1e3 * sqrt(t - 1)") + "</ParameterList>\n"
VELOCITY = parameter("velocity y", "double", "-0.5")
SPEEDING = parameter("velocity y", "string", "log(t - 1)")
RESTING = parameter("K0", "string", "-0.1 + 0 * x")
PULLED = parameter("gravity", "Array(double)", "{0.0, -9.81}")
SWINGING = parameter("gravity factor", "string", "log(t - 1)")
NOWHERE = section("nowhere") + parameter("type", "string", "displacement") + parameter("set", "string", "right") + \
    parameter("y", "string", "log(t - 1)") + "</ParameterList>\n"
CONE = [("type", "string", "mohr-coulomb"), *ELASTIC[1:], ("cohesion", "double", "5e3"),
        ("friction angle [deg]", "double", "25")]
LAWS_OF_STRENGTH = "mohr-coulomb, drucker-prager, tresca, von mises"


STRINGS = section("small-strain stiffness")


def with_strings(name, entries, message, at, law=(), **where):
    """The deck with small-strain stiffness of the clay, or of another law."""
    skeleton = section("skeleton") + "\n" + "".join(parameter(*entry) + "\n" for entry in law) if law else \
        SKELETON[:SKELETON.rindex("</ParameterList>")]
    small = STRINGS + "\n" + "".join(parameter(*entry) + "\n" for entry in entries) + "</ParameterList>\n"
    return Wrong(name, (SKELETON, skeleton + small + "</ParameterList>\n"), message, at=at, **where)


LAW = "materials/clay/skeleton/"
RATIO, STRAIN = ("ratio", "double", "5"), ("reference strain", "double", "1e-4")


def around_body(name, body, message, at, more="", **where):
    """The deck with a mesh around a body in place of the box."""
    mesh = "".join(parameter(*entry) + "\n" for entry in (
        ("type", "string", "penetration"), ("geometry", "string", "axisymmetric"), ("body", "string", body), ("width", "double", "0.3"),
        ("depth", "double", "0.3"), ("size near body", "double", "0.02")))
    return Wrong(name, (whole("mesh"), section("mesh") + "\n" + mesh + more + "</ParameterList>"), message, at=at, **where)


MUD_TOP = parameter("top", "double", "{}")


def layers(of_mud, change=None, more=""):
    """The clay over mud of the same kind, a layer by what `of_mud` says; `change`: (old, new) in the mud; `more`: of the clay."""
    mud = whole("clay").replace(section("clay"), section("mud") + of_mud + "\n")
    if change:
        mud = mud.replace(*change)
    return whole("clay"), whole("clay").replace(section("clay"), section("clay") + more) + mud


def filter_of(body, position="0.01", more=""):
    place = parameter("position", "double", position) if position else ""
    own = section("u2") + "\n" + parameter("body", "string", body) + "\n" + place + "\n" + more + "</ParameterList>"
    return [(section("output"), section("output") + "\n" + section("filters") + "\n" + own + "</ParameterList>\n")]


DECKS = [
    with_strings("small-strain ratio", [("ratio", "double", "0.5"), STRAIN],
                 LAW + "small-strain stiffness/ratio: 0.5 is out of range; allowed: (1, 100)", at='name="ratio"'),
    with_strings("no reference strain", [RATIO], LAW + "small-strain stiffness: required parameter 'reference strain' is missing", at=STRINGS),
    with_strings("reference strain", [RATIO, ("reference strain", "double", "0")],
                 LAW + "small-strain stiffness/reference strain: 0 is out of range; allowed: (0, 0.1)", at='name="reference strain"'),
    with_strings("strings of a law without", [RATIO, STRAIN], LAW + "small-strain stiffness: unknown section; none is allowed here", at=STRINGS,
                 law=[("type", "string", "neo-hookean"), *ELASTIC[1:]]),
    with_strings("strings with energy", [RATIO, STRAIN],
                 LAW + "small-strain stiffness: contradictory with a 'shear modulus ratio', whose energy its strings "
                 "would not keep; remove one of them, or give the 'shear modulus'",
                 at=STRINGS, law=[("type", "string", "modified cam clay"), ("critical stress ratio", "double", "1"),
                                  ("compression slope", "double", "0.2"), ("swelling slope", "double", "0.04"),
                                  ("shear modulus ratio", "double", "30")]),
    with_strings("strings with creep", [RATIO, STRAIN],
                 LAW + "small-strain stiffness: contradictory with a 'creep slope', whose strain it would make smaller; remove one of them",
                 at=STRINGS, law=[("type", "string", "s-clay1s"), ("critical stress ratio", "double", "1"), ("compression slope", "double", "0.2"),
                                  ("swelling slope", "double", "0.04"), ("Poisson's ratio", "double", "0.3"), ("creep slope", "double", "0.005")]),
    # a film of water
    with_film("film with multipliers", parameter("enforcement", "string", "augmented Lagrangian"),
              "contacts/ball on clay/enforcement: a film has no multipliers; allowed with it: penalty", ranks=BOTH),
    with_film("film that conserves energy", parameter("impact", "string", "conserving"),
              "contacts/ball on clay/impact: a film takes energy; allowed with it: automatic, interpolated"),
    with_film("film with damping", parameter("damping", "double", "0.1"), "contacts/ball on clay/damping: a film damps by itself; it takes no 'damping'"),
    with_film("film that is open", parameter("conductance", "double", "1e-9"),
              "contacts/ball on clay/conductance: has a meaning only with 'drainage' = leaky"),
    with_film("film without an aperture", parameter("residual aperture", "double", "0"),
              "contacts/ball on clay/residual aperture: 0 is out of range; allowed: (0, inf)"),
    with_film("film of nothing", parameter("film viscosity", "double", "-1e-3"),
              "contacts/ball on clay/film viscosity: -0.001 is out of range; allowed: (0, inf)"),
    Wrong("cavitation without a film", (TOUCHED, TOUCHED + parameter("cavitation pressure", "double", "-1e5")),
          "contacts/ball on clay/cavitation pressure: has a meaning only with 'drainage' = film"),
    Wrong("gap that seals nothing", (TOUCHED, TOUCHED + parameter("drainage", "string", "drained") +
                                     parameter("sealing gap", "double", "0.1")),
          "contacts/ball on clay/sealing gap: has no meaning with 'drainage' = drained, which seals nothing"),
    Wrong("sealing gap without pore water", [*ONE_PHASE, (whole("drained surface"), ""), (", drained surface,", ","),
                                             (TOUCHED, TOUCHED + parameter("sealing gap", "double", "2"))],
          "contacts/ball on clay/sealing gap: has a meaning only in a model with the field 'pore pressure'",
          at=parameter("sealing gap", "double", "2")),
    Wrong("two penalties", (TOUCHED, TOUCHED + parameter("penalty", "double", "1e8") + parameter("penalty factor", "double", "5")),
          "contacts/ball on clay/penalty factor: scales the penalty that follows from the soil's stiffness, but 'penalty' gives one; "
          "take one out", at=parameter("penalty factor", "double", "5")),
    # gaps at the start
    Wrong("closing distance without closing", (TOUCHED, TOUCHED + parameter("closing distance", "double", "1e-3")),
          "contacts/ball on clay/closing distance: has a meaning only with 'initial gap' = closed or in-situ stress; here it is as placed", ranks=BOTH),
    Wrong("closing distance below nothing", (TOUCHED, TOUCHED + parameter("initial gap", "string", "closed") + parameter("closing distance", "double", "-1e-3")),
          "contacts/ball on clay/closing distance: -0.001 is out of range; allowed: [0, inf)"),
    Wrong("initial gap by another name", (TOUCHED, TOUCHED + parameter("initial gap", "string", "in situ stress")),
          "contacts/ball on clay/initial gap: 'in situ stress' is not a choice (did you mean 'in-situ stress'?)"),
    # variables and units
    with_variables("variable by another name", [("load", "double", "20 kPa")], "2*laod",
                   "physics/ground/initial state/surcharge: there is no variable 'laod' (did you mean 'load'?)", 'value="2*laod"', ranks=BOTH),
    with_variables("variable that is not used", [("load", "double", "20 kPa")], "20e3",
                   "variables/load: no value names this variable (texts name it in braces, {load})", 'name="load" type="double"'),
    with_variables("variables in a circle", [("a", "double", "b"), ("b", "double", "2*a")], "a",
                   "variables/a: the variable is defined by itself: a, by b, by a", 'name="a" type="double"'),
    with_variables("variable of another unit", [("size", "double", "20 cm")], "size",
                   "physics/ground/initial state/surcharge: '20 cm' is no value in Pa", 'value="size"', ranks=BOTH),
    with_end("end without a type", (), "stages/push/ends when/enough: required parameter 'type' is missing; known stage end types: at rest, "
             "dissipated, history", section("enough")),
    with_end("end of another name", [("type", "string", "at rst")],
             "stages/push/ends when/enough/type: unknown stage end type 'at rst' (did you mean 'at rest'?); known types: at rest, dissipated, history",
             parameter("type", "string", "at rst")),
    with_end("end at rest of no body", [("type", "string", "at rest"), ("body", "string", "bal"), ("speed", "double", "1 mm/s")],
             "stages/push/ends when/enough/body: unknown body 'bal' (did you mean 'ball'?)", parameter("body", "string", "bal")),
    with_end("end at rest at no speed", [("type", "string", "at rest"), ("body", "string", "ball"), ("speed", "double", "0")],
             "stages/push/ends when/enough/speed: 0 is out of range; allowed: (0, inf)", parameter("speed", "double", "0")),
    with_end("end by more than all", [("type", "string", "dissipated"), ("share", "double", "90")],
             "stages/push/ends when/enough/share: 90 is out of range; allowed: (0, 1)", parameter("share", "double", "90")),
    with_end("end by a column without a value", [("type", "string", "history"), ("column", "string", "mesh/quality")],
             "stages/push/ends when/enough: needs one of 'rises to', 'falls to' and 'falls by'", section("enough")),
    with_end("end by a column with two values", [("type", "string", "history"), ("column", "string", "mesh/quality"), ("rises to", "double", "1"),
                                                 ("falls by", "double", "0.1")],
             "stages/push/ends when/enough: needs one of 'rises to', 'falls to' and 'falls by'; it has 'rises to' and 'falls by'",
             section("enough")),
    with_reduction("strengths of a law that does not name them",
                   "stages/push/strength reduction: the law 'modified cam clay' of material 'clay' has no strengths that "
                   f"could be divided by a factor; allowed: {LAWS_OF_STRENGTH}, and elastic laws beside them", REDUCTION, ranks=BOTH),
    with_reduction("strengths of elastic soil",
                   "stages/push/strength reduction: no soil of the deck has a strength; needed: a material with one of "
                   + LAWS_OF_STRENGTH,
                   REDUCTION, skeleton=ELASTIC),
    with_reduction("strengths with inertia",
                   "stages/push/type: a stage with a strength reduction looks for equilibrium: its type must be "
                   "'quasi-static'; given 'dynamic'", parameter("type", "string", "dynamic"), kind="dynamic",
                   skeleton=CONE),
    with_reduction("strengths without a factor",
                   "stages/push/strength reduction: required parameter 'largest factor' is missing", REDUCTION,
                   entries="", skeleton=CONE),
    with_reduction("strengths by a factor of 1",
                   "stages/push/strength reduction/largest factor: 1 is out of range; allowed: (1, 1000)",
                   parameter("largest factor", "double", "1"), entries=parameter("largest factor", "double", "1"),
                   skeleton=CONE),
    with_reduction("strengths with a smallest step",
                   "stages/push/time step/minimum: the smallest step of a strength reduction follows from its "
                   "'resolution'",
                   parameter("minimum", "double", "1e-6"), skeleton=CONE,
                   step=parameter("initial", "double", "1e-4") + "\n" + parameter("minimum", "double", "1e-6")),
    with_reduction("strengths in small steps",
                   "stages/push/time step/initial: the factor of the strength reduction grows by 0.001 in the first "
                   "step; allowed: its resolution of 0.005 or more", parameter("initial", "double", "1e-6"),
                   skeleton=CONE, step=parameter("initial", "double", "1e-6")),
    around_body("mesh around no body", "bal", "mesh/body: unknown body 'bal' (did you mean 'ball'?)", parameter("body", "string", "bal"), ranks=BOTH),
    around_body("mesh around a body with sides that are too small", "ball",
                "mesh/size near body: 0.02 is more than the largest size, 0.01", parameter("size near body", "double", "0.02"),
                more=parameter("largest size", "double", "0.01")),
    Wrong("end of a geostatic stage", (section("geostatic"), section("geostatic") + section("ends when") + "</ParameterList>"),
          "stages/geostatic/ends when: a geostatic stage takes no time and has no steps", at=section("ends when")),
    Wrong("value of another unit", (GEOSTATIC, parameter("surcharge", "double", "20 kN")),
          "physics/ground/initial state/surcharge: '20 kN' is no value in Pa"),
    Wrong("unit by another name", (GEOSTATIC, parameter("surcharge", "double", "20 kpa")),
          "physics/ground/initial state/surcharge: expected a number (double), given '20 kpa'; 'kpa' is no unit (did you mean 'kPa'?)"),
    Wrong("setting of another unit", (), "--set physics/ground/initial state/surcharge=2 m: physics/ground/initial state/surcharge: '2 m' is no value in Pa", line=False,
          settings=["physics/ground/initial state/surcharge=2 m"]),
    # wrong types
    Wrong("text for numbers", (parameter("cells", "Array(int)", "{3, 3}"), parameter("cells", "string", "many")),
          "mesh/cells: expected an array of numbers (Array(double)), given the string 'many'"),
    Wrong("ten thousand million cells", ("{3, 3}", "{100000, 100000}"), "mesh/cells: expected at most 2e+07 cells in all, given 1e+10"),
    Wrong("one number for two", ("{3, 3}", "{3}"), "mesh/cells: expected 2 numbers, given 1"),
    Wrong("fraction of a cell", (parameter("cells", "Array(int)", "{3, 3}"), parameter("cells", "Array(double)", "{3, 2.5}")),
          "mesh/cells: expected whole numbers, given 2.5"),
    Wrong("number for a vector", (parameter("gravity", "Array(double)", "{0.0, -9.81}"), parameter("gravity", "double", "9.81")),
          "physics/ground/gravity: expected an array of numbers (Array(double)), given the number 9.81", ranks=BOTH),
    Wrong("vector of three", ("{0.0, -9.81}", "{0.0, 0.0, -9.81}"), "physics/ground/gravity: expected 2 numbers, as the mesh's 'geometry' is not 'three-dimensional'; given 3"),
    Wrong("double for int", (parameter("maximum iterations", "int", "15"), parameter("maximum iterations", "double", "15")),
          "solver/newton/maximum iterations: expected an integer (int), given the number 15"),
    Wrong("probe that is no point", (parameter("tip", "Array(double)", "{0.0, 0.3}"), parameter("tip", "string", "top")),
          "output/probes/tip: expected an array of numbers (Array(double)), given the string 'top'"),
    Wrong("decimal comma", (parameter("void ratio", "double", "1.2"), parameter("void ratio", "double", "1,2")),
          "materials/clay/void ratio: expected a number (double), given '1,2'; decimals need a point"),
    Wrong("not a number", (parameter("void ratio", "double", "1.2"), parameter("void ratio", "double", "nan")),
          "materials/clay/void ratio: expected a finite number, given 'nan'"),
    Wrong("parameter for a section", (whole("fluid"), "      " + parameter("fluid", "string", "water") + "\n"),
          "materials/clay/fluid: expected a section (ParameterList), given the string 'water'"),
    # out of range
    Wrong("no cells", ("{3, 3}", "{3, 0}"), "mesh/cells: 0 (entry 2) is out of range; allowed: [1, 1e+06]"),
    Wrong("negative cells", ("{3, 3}", "{3, -3}"), "mesh/cells: -3 (entry 2) is out of range; allowed: [1, 1e+06]", ranks=BOTH),
    Wrong("mesh upside down", ("{0.3, 0.3}", "{0.3, -0.3}"), "mesh/upper: must lie above and right of 'lower' (0, 0), given (0.3, -0.3)"),
    Wrong("negative grading", (UPPER, UPPER + parameter("grading", "Array(double)", "{1, -1}")),
          "mesh/grading: must be positive, given -1"),
    Wrong("Poisson's ratio", ('value="0.3"/>', 'value="0.5"/>'),
          "materials/clay/skeleton/Poisson's ratio: 0.5 is out of range; allowed: [0, 0.5)"),
    Wrong("negative permeability", ('value="1e-8"', 'value="-1e-8"'),
          "materials/clay/permeability/hydraulic conductivity: -1e-08 is out of range; allowed: [0, inf)"),
    Wrong("negative ramp", (parameter("ramp time", "double", "0.001"), parameter("ramp time", "double", "-0.001")), "bodies/ball/motion/ramp time: -0.001 is out of range; allowed: [0, inf)"),
    Wrong("penalty of nothing", (parameter("surface", "string", "top"), parameter("surface", "string", "top") +
                                 parameter("penalty factor", "double", "0")),
          "contacts/ball on clay/penalty factor: 0 is out of range; allowed: (0, inf)"),
    Wrong("spectral radius", (parameter("spectral radius", "double", "0.5"), parameter("spectral radius", "double", "1.5")),
          "stages/push/integrator/spectral radius: 1.5 is out of range; allowed: [0, 1]"),
    Wrong("shrinking growth", (parameter("growth", "double", "1.2"), parameter("growth", "double", "0.5")),
          "stages/push/time step/growth: 0.5 is out of range; allowed: [1, 10]"),
    Wrong("tolerance zero", ('tolerance" type="double" value="1e-6"/>\n    <ParameterList name="linear',
                             'tolerance" type="double" value="0"/>\n    <ParameterList name="linear'),
          "solver/residual tolerance: 0 is out of range; allowed: (0, 1)"),
    Wrong("no iterations", (parameter("maximum iterations", "int", "15"), parameter("maximum iterations", "int", "0")),
          "solver/newton/maximum iterations: 0 is out of range; allowed: [1, 1000]"),
    Wrong("history never", (parameter("history steps", "int", "1"), parameter("history steps", "int", "0")),
          "output/history steps: 0 is out of range; allowed: [1, 1e+09]"),
    Wrong("target of no estimate", (parameter("history steps", "int", "1"), parameter("target error", "double", "0.1")),
          "output/target error: has no effect without 'error estimate' = true"),
    Wrong("target beyond all", (parameter("history steps", "int", "1"), parameter("error estimate", "bool", "true") + "\n" +
                                parameter("target error", "double", "1.5")),
          "output/target error: 1.5 is out of range; allowed: (0, 1)", at='name="target error"'),
    Wrong("estimate that is no truth value", (parameter("history steps", "int", "1"), parameter("error estimate", "string", "stress")),
          "output/error estimate: expected true or false (bool), given the string 'stress'"),
    Wrong("probe outside", (parameter("tip", "Array(double)", "{0.0, 0.3}"), parameter("tip", "Array(double)", "{0.0, 0.4}")),
          "output/probes/tip: y = 0.4 lies outside the mesh, which reaches from 0 to 0.3", ranks=BOTH),
    Wrong("filter of no body", filter_of("bal"), "output/filters/u2/body: unknown body 'bal' (did you mean 'ball'?)", at=parameter("body", "string", "bal"), ranks=BOTH),
    Wrong("filter above its body", filter_of("ball", position="0.25"),
          "output/filters/u2/position: no surface of body 'ball' lies between 0.2475 and 0.2525 m above its reference point; it reaches from 0 to 0.2 m", at=parameter("position", "double", "0.25"), ranks=BOTH),
    Wrong("filter of negative height", filter_of("ball", more=parameter("height", "double", "-0.005")),
          "output/filters/u2/height: -0.005 is out of range; allowed: (0, inf)", at=parameter("height", "double", "-0.005")),
    Wrong("filter at no place", filter_of("ball", position=None), "output/filters/u2: required parameter 'position' is missing", at=section("u2")),
    Wrong("filter that is a point", (section("output"), section("output") + section("filters") + parameter("u2", "Array(double)", "{0.1, 0.3}") + "</ParameterList>"),
          "output/filters/u2: unknown parameter; none is allowed here"),
    Wrong("component", ('value="x"', 'value="z"'), "boundary conditions/axis/components: 'z' is not a choice; allowed: x, y, x y"),
    # space
    Wrong("mesh and points of the plane in space", ('value="axisymmetric"', 'value="three-dimensional"'),
          "mesh/cell: 'quad9' is a cell of the plane, and the geometry is 'three-dimensional'; allowed: hex27, tet10, hex8, tet4, wedge15, wedge18, wedge6", at='name="cell"', ranks=BOTH),
    Wrong("two cells in space", [('value="axisymmetric"', 'value="three-dimensional"'), (parameter("tip", "Array(double)", "{0.0, 0.3}"), parameter("tip", "Array(double)", "{0.0, 0.0, 0.3}"))],
          "mesh/cell: 'quad9' is a cell of the plane, and the geometry is 'three-dimensional'; allowed: hex27, tet10, hex8, tet4, wedge15, wedge18, wedge6",
          at='name="cell"'),
    Wrong("cell of space", ('value="quad9"', 'value="hex27"'),
          "mesh/cell: 'hex27' is a cell of space, and the geometry is one of the plane; allowed: quad9, tri6, quad4, tri3"),
    # missing
    Wrong("no mesh", without(whole("mesh")), "required section 'mesh' is missing", at='<ParameterList name="base">'),
    Wrong("no stages", without(whole("stages")), "required section 'stages' is missing", at='<ParameterList name="base">'),
    Wrong("no physics", without(whole("ground")), "physics: at least one physics is needed; known physics types: biot, solid, thermo-hydro-mechanical",
          at=section("physics"), ranks=BOTH),
    Wrong("no upper corner", without(UPPER), "mesh: required parameter 'upper' is missing", at=section("mesh")),
    Wrong("no type", without("    " + parameter("type", "string", "box") + "\n"),
          "mesh: required parameter 'type' is missing; known mesh types: box, gmsh, extruded, revolved, penetration", at=section("mesh")),
    Wrong("no pores", (parameter("void ratio", "double", "1.2"), parameter("porosity", "double", "0")),
          "materials/clay/porosity: a saturated soil has pores: must be greater than 0"),
    Wrong("no void ratio", without(parameter("void ratio", "double", "1.2")),
          "materials/clay: required parameter 'void ratio' (or 'porosity', or 'void ratio from law') is missing", at=section("clay")),
    Wrong("no swelling slope", without(parameter("swelling slope", "double", "0.04")),
          "materials/clay/skeleton: required parameter 'swelling slope' is missing", at=section("skeleton")),
    Wrong("no skeleton", without(SKELETON), "materials/clay: required section 'skeleton' is missing", at=section("clay")),
    Wrong("no set", without(parameter("set", "string", "bottom")), "boundary conditions/base: required parameter 'set' is missing",
          at='    <ParameterList name="base">'),
    Wrong("no contour", without(whole("contour")),
          "bodies/ball/contour: required parameter 'type' is missing; known contour types: cone, flat pile, sphere, cone penetrometer, torpedo, cylinder, strip, path, gmsh curve, polyline", at=section("ball")),
    Wrong("no duration", without(parameter("duration", "double", "0.001")), "stages/push: required parameter 'duration' is missing",
          at=section("push")),
    Wrong("no time step", without(whole("time step")), "stages/push: required section 'time step' is missing", at=section("push")),
    Wrong("no first step", without(parameter("initial", "double", "2.5e-4")),
          "stages/push/time step: required parameter 'initial' is missing", at=section("time step")),
    # against one another
    Wrong("unstable pair", ("quad9", "quad4"),
          "physics/ground/type: linear quad4 cells give an unstable displacement and pore-pressure pair; use quadratic cells "
          "(tri6 or quad9, in Gmsh: order 2), or give 'pressure' = 'equal order'", at='<Parameter name="type" type="string" value="biot"/>', ranks=BOTH),
    Wrong("biot without fluid", [without(whole("fluid")), without(whole("permeability"))],
          "materials/clay: material 'clay' needs the sections 'fluid' and 'permeability' in a physics of saturated soil", at=section("clay"), ranks=BOTH),
    Wrong("heat that nothing uses", (whole("permeability"), whole("permeability") + HEAT),
          "materials/clay/heat: no physics of this model uses these properties", at=section("heat"), ranks=BOTH),
    Wrong("warm soil without heat", ('value="biot"', 'value="thermo-hydro-mechanical"'),
          "materials/clay: required section 'heat' is missing: a physics of this model needs it", at=section("clay"), ranks=BOTH),
    Wrong("heat misspelt", [('value="biot"', 'value="thermo-hydro-mechanical"'), (whole("permeability"), whole("permeability") + HEAT.replace("heat", "haet", 1))],
          "materials/clay/haet: unknown section (did you mean 'heat'?)", at=section("haet")),
    Wrong("fluid without permeability", without(whole("permeability")),
          "materials/clay: a saturated soil needs a section 'permeability' beside its 'fluid'", at=section("clay")),
    Wrong("permeability without fluid", without(whole("fluid")),
          "materials/clay: a section 'permeability' needs a section 'fluid' beside it", at=section("clay")),
    Wrong("grains without water",
          [*ONE_PHASE, (section("clay"), section("clay") + parameter("Biot coefficient", "double", "0.9"))],
          "materials/clay/Biot coefficient: has a meaning only beside a 'fluid', whose pressure acts on the grains",
          at=parameter("Biot coefficient", "double", "0.9")),
    Wrong("height without a gradient",
          (SKELETON, section("skeleton") + "\n" + "".join(parameter(*entry) + "\n" for entry in CONE) +
           parameter("reference elevation", "double", "3") + "\n</ParameterList>\n"),
          "materials/clay/skeleton/reference elevation: has a meaning only together with 'cohesion gradient'",
          at=parameter("reference elevation", "double", "3")),
    Wrong("solid with fluid", ('value="biot"', 'value="solid"'),
          "materials/clay: material 'clay' has a pore fluid, but physics 'solid' is single-phase; remove 'fluid' and 'permeability', "
          "or use physics 'biot'", at=section("clay")),
    Wrong("region without material", without(whole("clay")),
          "materials: mesh region 'soil' has no material; name it in the 'regions' of one", at=section("materials")),
    Wrong("region with two materials", (whole("clay"), whole("clay") + whole("clay").replace('"clay"', '"mud"')),
          "materials: mesh region 'soil' has two materials, 'clay' and 'mud'; as layers all but the uppermost one need a 'top'",
          at=section("materials"), ranks=BOTH),
    Wrong("layer outside the region", layers(MUD_TOP.format(-0.1)),
          "materials/mud/top: no soil is made of 'mud': no point of its regions lies below this and above the next lower 'top'",
          at=MUD_TOP.format(-0.1), ranks=BOTH),
    Wrong("soil above all layers", (section("clay"), section("clay") + parameter("top", "double", "0.2")),
          "materials: no material at (0.0112702, 0.21127): it lies above the 'top' of every material of mesh region 'soil'; the uppermost "
          "one needs none", at=section("materials")),
    Wrong("layers with one top", layers(MUD_TOP.format(0.4), more=MUD_TOP.format(0.4) + "<!-- -->"),
          "materials/mud/top: the layers 'clay' and 'mud' of mesh region 'soil' have the same top", at=MUD_TOP.format(0.4) + "\n"),
    Wrong("layers with two waters", layers(MUD_TOP.format(0.1), (section("fluid"), section("fluid") + parameter("density", "double", "1025"))),
          "materials/mud/fluid: the layers 'clay' and 'mud' of mesh region 'soil' have different pore fluids: water does not stay with the "
          "layer; give both the same", at=section("fluid") + parameter("density", "double", "1025")),
    Wrong("a layer without heat", [layers(MUD_TOP.format(0.1)), (whole("permeability"), whole("permeability") + HEAT),
                                   ('value="biot"', 'value="thermo-hydro-mechanical"')],
          "materials/mud: required section 'heat' is missing: a physics of this model needs it", at=section("mud")),
    Wrong("inclined layers at rest", layers(parameter("top", "string", "0.1 + x")),
          "physics/ground/initial state/type: the 'top' of a material of mesh region 'soil' varies with the place; use a stage of type "
          "'geostatic' from a uniform state", at=parameter("type", "string", "geostatic")),
    Wrong("two physics of one field", (section("ground"), section("twin") + parameter("type", "string", "biot") + "</ParameterList>" +
                                       section("ground")),
          "physics/ground: only one physics may own the displacements"),
    Wrong("void ratio and porosity", (parameter("void ratio", "double", "1.2"), parameter("void ratio", "double", "1.2") +
                                      parameter("porosity", "double", "0.4")),
          "materials/clay/porosity: contradictory: give 'void ratio' or 'porosity', not both"),
    Wrong("two elastic constants", (parameter("Poisson's ratio", "double", "0.3"), parameter("Poisson's ratio", "double", "0.3") +
                                    parameter("shear modulus", "double", "1e6")),
          "materials/clay/skeleton: exactly one of 'Poisson's ratio', 'shear modulus' and 'shear modulus ratio' must be "
          "given",
          at=section("skeleton")),
    Wrong("shear modulus ratio of nothing",
          (parameter("Poisson's ratio", "double", "0.3"), parameter("shear modulus ratio", "double", "0")),
          "materials/clay/skeleton/shear modulus ratio: the ratio must be positive", at='name="shear modulus ratio"'),
    Wrong("energy and a critical state line",
          (parameter("Poisson's ratio", "double", "0.3"),
           parameter("shear modulus ratio", "double", "30") + parameter("critical state volume", "double", "2.5")),
          "materials/clay/skeleton/critical state volume: with a 'shear modulus ratio' shear dilates elastically, so "
          "that the critical state line is no fixed distance away; give 'normal compression volume'"),
    Wrong("swelling above compression", ('value="0.04"', 'value="0.4"'),
          "materials/clay/skeleton/swelling slope: the swelling slope must be smaller than the compression slope"),
    Wrong("clay without stress", start_of("stress free"),
          "physics/ground/initial state: material 'clay' cannot start at (0.0112702, 0.0112702): Modified Cam Clay needs a compressive "
          "initial stress; the mean effective stress here is -0 Pa", at=section("initial state")),
    without_meaning("K0", "uniform", "geostatic", "0.6"),
    without_meaning("surcharge", "uniform", "geostatic", ranks=BOTH),
    without_meaning("water level", "uniform", "geostatic or by law"),
    without_meaning("K0", "stress free", "geostatic", "0.6"),
    without_meaning("overconsolidation ratio", "stress free", "uniform, geostatic or by law", "2"),
    without_meaning("effective stress yy", "stress free", "uniform"),
    without_meaning("effective stress yy", "geostatic", "uniform"),
    without_meaning("pore pressure", "geostatic", "uniform or by law"),
    Wrong("a water level without water",
          [*ONE_PHASE, (whole("drained surface"), ""), (", drained surface,", ",")],
          "physics/ground/initial state/water level: this physics has one phase and no pore pressure; 'biot' has one",
          at=parameter("water level", "double", "0.3")),
    changing("K0", (parameter("K0", "double", "0.6"), parameter("K0", "string", "1.5 + t")),
             "physics/ground/initial state/K0"),
    changing("overconsolidation ratio", (parameter("overconsolidation ratio", "double", "1.5"),
                                         parameter("overconsolidation ratio", "string", "1.5 + t")),
             "physics/ground/initial state/overconsolidation ratio"),
    Wrong("a temperature of the start that changes",
          [(whole("permeability"), whole("permeability") + HEAT), ('value="biot"', 'value="thermo-hydro-mechanical"'),
           (section("ground"), section("ground") + parameter("initial temperature", "string", "20 + t"))],
          "physics/ground/initial temperature: '20 + t' depends on the time; this number may depend on the place only",
          at=parameter("initial temperature", "string", "20 + t")),
    changing("top", (section("clay"), section("clay") + parameter("top", "string", "1.5 + t")), "materials/clay/top"),
    with_sounding("a sounding in kPa", "depth [m]", "OCR [kPa]",
                  "functions/ratio/value column: 'OCR [kPa]' needs a 'factor', 1000 by this unit",
                  at=parameter("value column", "string", "OCR [kPa]"), ranks=BOTH),
    with_sounding("depths in kPa", "depth [kPa]", "OCR [-]",
                  "functions/ratio/depth column: 'depth [kPa]' is no value in m",
                  at=parameter("depth column", "string", "depth [kPa]")),
    with_sounding("depths in a unit that is none", "depth [ft]", "OCR [-]",
                  "functions/ratio/depth column: [ft] is no unit; a column of depths is in [m], [cm], [mm] or [km]",
                  at=parameter("depth column", "string", "depth [ft]")),
    with_sounding("values in a unit that is none", "depth [m]", "OCR [psf]",
                  "functions/ratio/value column: [psf] is no unit that is known: give a 'factor', 1 for numbers as they are",
                  at=parameter("value column", "string", "OCR [psf]")),
    with_sounding("elevations for depths", "depth [m]", "OCR [-]",
                  "functions/ratio/file: depths are counted down from the surface, as positive numbers; given -10 to 0, all "
                  "above it", at=parameter("file", "string", "sounding.csv"), rows="-10,1.5\n0,1.2\n"),
    Wrong("a table of two measures", ("{20e3, 21e3, 21e3}", "{20 kPa, 21e3 m, 21e3}"),
          "functions/load history/values: '21e3 m' measures something else than '20 kPa'"),
    Wrong("a table of another measure", ("{20e3, 21e3, 21e3}", "{20 m, 21 m, 21e3}"),
          "boundary conditions/surcharge/value: function 'load history': '20 m' is no value in Pa",
          at=parameter("value", "string", "load history"), ranks=BOTH),
    Wrong("a water level beside pore pressures in excess of it",
          [(section("ground"), section("ground") + parameter("pore pressure", "string", "excess")),
           (whole("drained surface"), whole("drained surface").replace("pore pressure", "hydrostatic pressure").replace(
               "</ParameterList>", parameter("water level", "double", "0.3") + "</ParameterList>"))],
          "boundary conditions/drained surface/type: pore pressures are in excess of water at rest, which a water level "
          "gives: use a 'pore pressure' of 0", at=parameter("type", "string", "hydrostatic pressure")),
    Wrong("gravity that is off at a geostatic start",
          (section("ground"), section("ground") + parameter("gravity factor", "string", "min(1, 100*t)")),
          "physics/ground/initial state/type: the 'gravity factor' is 0 at t = 0, when this start takes gravity",
          at=parameter("type", "string", "geostatic")),
    with_sounding("heights for depths", "depth [m]", "OCR [-]",
                  "functions/ratio/file: depths must increase strictly: -10 after 0 (row 2); they are counted down from the surface, as "
                  "positive numbers", at=parameter("file", "string", "sounding.csv"), rows="0,1.5\n-10,1.2\n"),
    number("a long minus sign", "-0.5", "\u22120.5", "bodies/ball/motion/velocity y", ODD.format("\u2212", "U+2212")),
    number("a superscript", "20e3", "20 kN/m\u00b2", "physics/ground/initial state/surcharge", ODD.format("\u00b2", "U+00B2"), ranks=BOTH),
    number("a no-break space", "20e3", "20\u00a0kPa", "physics/ground/initial state/surcharge", ODD.format("\u00a0", "U+00A0")),
    number("a degree sign", "0.6", "0.6\u00b0", "physics/ground/initial state/K0", ODD.format("\u00b0", "U+00B0")),
    number("a foreign unit", "20e3", "3 psi", "physics/ground/initial state/surcharge",
           "; 'psi' is no unit: 1 psi is 6.894757 kPa"),
    number("another spelling of a unit", "20e3", "3 tonnes/m2", "physics/ground/initial state/surcharge",
           "; 'tonnes' is no unit (did you mean 't'?)"),
    number("a unit of two letters", "20e3", "3 xx", "physics/ground/initial state/surcharge",
           "; 'xx' is no unit; allowed: " + UNITS),
    Wrong("largest step below the first", (parameter("growth", "double", "1.2"), parameter("maximum", "double", "0.1 ms")),
          "stages/push/time step/maximum: the maximum step, 0.1 ms, must not be below the initial one, 0.25 ms"),
    Wrong("balance of a dynamic stage", (PUSHED, PUSHED + parameter("balance tolerance", "double", "1e-3")),
          "stages/push/balance tolerance: only a geostatic stage finds a balance; given 'dynamic'"),
    Wrong("rates of a geostatic stage", (parameter("balance tolerance", "double", "1e-6"),
                                         parameter("initial rates", "string", "zero")),
          "stages/geostatic/initial rates: only a dynamic stage starts with rates; given 'geostatic'"),
    Wrong("a geostatic stage that keeps displacements", (parameter("balance tolerance", "double", "1e-6"),
                                                         parameter("reset displacements", "bool", "false")),
          "stages/geostatic/reset displacements: a geostatic stage always sets the displacements to zero"),
    Wrong("underconsolidated", ('value="1.5"', 'value="0.5"'),
          "physics/ground/initial state/overconsolidation ratio: 0.5 is out of range; allowed: [1, inf)",
          at=parameter("overconsolidation ratio", "double", "0.5")),
    Wrong("overconsolidation that nothing follows", (SKELETON, ELASTIC_LAW),
          "physics/ground/initial state/overconsolidation ratio: no law of this model follows it, and without a "
          "'K0 friction angle [deg]' the earth pressure at rest does not either",
          at=parameter("overconsolidation ratio", "double", "1.5"), ranks=BOTH),
    Wrong("a value that is no number at some time", (section("far side"), NOWHERE + section("far side")),
          "boundary conditions/nowhere/y: the value of 'log(t - 1)' is not finite at t = 0 s; allowed: finite numbers",
          at=parameter("y", "string", "log(t - 1)"), ranks=BOTH),
    Wrong("a load that is no number at some time", (section("far side"), PRESSED + section("far side")),
          "boundary conditions/pressed/value: the value of '1e3 * sqrt(t - 1)' is not finite at t = 0 s; allowed: "
          "finite numbers",
          at=parameter("value", "string", "1e3 * sqrt(t - 1)"), ranks=BOTH),
    Wrong("a motion that is no number at some time", (VELOCITY, SPEEDING),
          "bodies/ball/motion/velocity y: the value of 'log(t - 1)' is not finite at t = 3.47159e-07 s; allowed: "
          "finite numbers",
          at=SPEEDING, ranks=BOTH),
    Wrong("an earth pressure that is negative somewhere", (parameter("K0", "double", "0.6"), RESTING),
          "physics/ground/initial state/K0: the value of '-0.1 + 0 * x' is -0.1 at (0.0112702, 0.0112702); allowed: "
          "[0, inf)",
          at=RESTING),
    Wrong("gravity that is no number", (PULLED, PULLED + SWINGING),
          "physics/ground/gravity factor: the value of 'log(t - 1)' is not finite at t = 0 s; allowed: finite numbers",
          at=SWINGING, ranks=BOTH),
    Wrong("geostatic without gravity", without("      " + parameter("gravity", "Array(double)", "{0.0, -9.81}") + "\n"),
          "physics/ground/initial state/type: a geostatic start needs gravity: give the physics a 'gravity'",
          at=parameter("type", "string", "geostatic")),
    Wrong("contradicting conditions", (section("surcharge") + '\n      <Parameter name="type" type="string" value="pressure"/>',
                                       section("surcharge") + '\n      <Parameter name="type" type="string" value="pore pressure"/>'),
          "boundary conditions/surcharge: contradicts 'drained surface' on a shared node: pore pressure is prescribed as 0 and as 20000 "
          "in stage 'geostatic'", ranks=BOTH),
    Wrong("body in the soil", ("{0.0, 0.3}", "{0.0, 0.2}"),
          "contacts/ball on clay/body: body 'ball' overlaps the surface by 0.1 m at (0, 0.3) at the start, more than half of its "
          "shortest side, 0.1 m; move its 'position'", at=parameter("body", "string", "ball"), ranks=BOTH),
    Wrong("quasi-static with inertia", ('value="dynamic"', 'value="quasi-static"'),
          "stages/push/integrator/type: a quasi-static stage takes the integrator 'theta'", at=parameter("type", "string", "generalised alpha")),
    Wrong("dynamic without inertia", (parameter("type", "string", "generalised alpha") + "\n        " +
                                      parameter("spectral radius", "double", "0.5"), parameter("type", "string", "theta")),
          "stages/push/integrator/type: a dynamic stage needs an integrator with inertia (generalised alpha, newmark, hht alpha)"),
    Wrong("geostatic with steps", (parameter("balance tolerance", "double", "1e-6"), section("time step") +
                                   parameter("initial", "double", "1") + "</ParameterList>"),
          "stages/geostatic/time step: a geostatic stage takes no time and has no steps"),
    Wrong("first step too long", ("2.5e-4", "2.5e-2"),
          "stages/push/time step/initial: the first step, 25 ms, must not be longer than the stage's duration, 1 ms"),
    Wrong("minimum above first step", (parameter("growth", "double", "1.2"), parameter("minimum", "double", "1e-3")),
          "stages/push/time step/minimum: the minimum step, 1 ms, must not be above the initial one, 0.25 ms"),
    Wrong("table runs backwards", ("{0.0, 0.001, 0.01}", "{0.0, 0.01, 0.001}"),
          "functions/load history/times: 'times' must increase strictly, but 0.001 follows 0.01", ranks=BOTH),
    Wrong("table of two lengths", ("{0.0, 0.001, 0.01}", "{0.0, 0.001}"),
          "functions/load history/values: 'times' and 'values' must be of the same length, given 2 and 3", at='name="values"'),
    Wrong("unknown function in an expression", ('value="load history"', 'value="20e3*sinn(t)"'),
          "boundary conditions/surcharge/value: invalid expression '20e3*sinn(t)': unexpected token 'sinn' found at position 5 "
          "(did you mean 'sin'?); functions of the deck: load history"),
    Wrong("open parenthesis", ('value="load history"', 'value="20e3*(1+t"'),
          "boundary conditions/surcharge/value: invalid expression '20e3*(1+t': missing parenthesis; functions of the deck: load history"),
]
