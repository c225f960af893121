"""Entries that mean nothing: what no stage lists, nothing names, or another entry overrules; and all of newton/nox."""
from wrong_deck import Wrong, parameter, section, whole

BOTH = (1, 2)
CONDITIONS = parameter("conditions", "Array(string)", "{base, axis, far side, drained surface, surcharge}")
GEOSTATIC = parameter("balance tolerance", "double", "1e-6")
DURATION = parameter("duration", "double", "0.001")
WATER = '        <Parameter name="type" type="string" value="water"/>\n'
METHOD = parameter("Method", "string", "Backtrack")
NOX = "solver/newton/nox/"
BALL = whole("ball")


def search(*entries):
    return '<ParameterList name="Backtrack">' + "".join(entries) + "</ParameterList>"


DECKS = [
    Wrong("condition of no stage", [(CONDITIONS, CONDITIONS.replace(", far side", "")),
                                    (GEOSTATIC, GEOSTATIC + CONDITIONS.replace(", far side", ""))],
          "boundary conditions/far side: no stage lists this condition in its 'conditions'", at=section("far side"), ranks=BOTH),
    Wrong("contact of no stage", (DURATION, DURATION + parameter("contacts", "Array(string)", "{none}")),
          "contacts/ball on clay: this contact acts in no stage; name it in the 'contacts' of one (absent: all, but in geostatic stages)",
          at=section("ball on clay"), ranks=BOTH),
    Wrong("body of nothing", (BALL, BALL + BALL.replace('name="ball"', 'name="second ball"')),
          "bodies/second ball: no contact, mesh motion or probe names this body, and no stage releases it", at=section("second ball")),
    Wrong("function of nothing", ('value="load history"', 'value="20e3"'), "functions/load history: no entry names this function",
          at=section("load history"), ranks=BOTH),
    Wrong("variable of nothing, by a setting", [],
          "--set variables/spare=1: variables/spare: no value names this variable (texts name it in braces, {spare})",
          line=False, settings=["variables/spare=1"], ranks=BOTH),
    Wrong("function of nothing, by settings", [],
          "--set functions/lod history/type=constant: functions/lod history: no entry names this function (did "
          "you mean 'load history'?)", line=False,
          settings=["functions/lod history/type=constant", "functions/lod history/value=3.0"]),
    Wrong("bulk modulus of an incompressible fluid", (WATER, WATER + parameter("incompressible", "bool", "true") +
                                                      parameter("bulk modulus", "double", "2e9")),
          "materials/clay/fluid/bulk modulus: has no effect beside 'incompressible' = true; remove one of them", at="incompressible"),
    Wrong("nox parameter", (METHOD, METHOD.replace("Method", "Methd")), NOX + "Line Search/Methd: unknown parameter (did you mean 'Method'?)"),
    Wrong("nox method", (METHOD, METHOD.replace("Backtrack", "Backtrak")),
          NOX + "Line Search/Method: 'Backtrak' is not a choice (did you mean 'Backtrack'?)", ranks=BOTH),
    Wrong("nox method with a slope", (METHOD, METHOD.replace("Backtrack", "Polynomial")),
          NOX + "Line Search/Method: 'Polynomial' is not a choice; allowed: Full Step, Backtrack"),
    Wrong("nox parameter of a method", (METHOD, METHOD + search(parameter("Minimum Stp", "double", "0.1"))),
          NOX + "Line Search/Backtrack/Minimum Stp: unknown parameter (did you mean 'Minimum Step'?)", at="Minimum Stp"),
    Wrong("nox parameter of another type", (METHOD, METHOD + search(parameter("Max Iters", "string", "few"))),
          NOX + "Line Search/Backtrack/Max Iters: expected an integer (int), given the string 'few'", at="Max Iters"),
    Wrong("nox parameter out of range", (METHOD, METHOD + search(parameter("Reduction Factor", "double", "1.5"))),
          NOX + "Line Search/Backtrack/Reduction Factor: 1.5 is out of range; allowed: (0, 1)", at="Reduction Factor"),
    Wrong("nox section of another method", (METHOD, METHOD.replace("Backtrack", "Full Step") + search(parameter("Max Iters", "int", "4"))),
          NOX + "Line Search/Backtrack: has no effect with another 'Method'", at='name="Backtrack"'),
    Wrong("nox section that is not supported", (section("Line Search"), section("Direction")),
          NOX + "Direction: unknown section; allowed: Line Search"),
    Wrong("halvings beside nox", (section("nox"), parameter("halvings", "int", "2") + section("nox")),
          "solver/newton/halvings: has no effect beside a line search of NOX (section 'nox')"),
]
