"""Wrong decks of `mudline point`: point_base.xml with one thing spoilt."""
import os

from wrong_deck import HERE, Wrong, parameter, section

with open(os.path.join(HERE, "point_base.xml")) as _file:
    BASE = _file.read()

STRAINS = parameter("axial strain", "Array(double)", "{0.05, 0.04}")
MEAN = parameter("mean effective stress", "double", "100e3")
STRESSES = parameter("axial stress", "Array(double)", "{200e3}")


def wrong(*arguments, **more):
    return Wrong(*arguments, base=BASE, **more)


DECKS = [
    wrong("unknown section", ('name="functions"', 'name="function"'), "function: unknown section (did you mean 'functions'?)",
          at='name="function"'),
    wrong("misspelt tests", (section("tests"), section("test")), "test: unknown section (did you mean 'tests'?)"),
    wrong("no materials", (section("materials"), section("bodies")), "required section 'materials' is missing or empty",
          at='<ParameterList name="point">'),
    wrong("parameter among the tests", (section("tests"), section("tests") + parameter("steps", "int", "10")),
          "tests/steps: unknown parameter; none is allowed here"),
    wrong("unknown test type", ('value="triaxial drained"', 'value="triaxial draind"'),
          "tests/drained/type: unknown test type 'triaxial draind' (did you mean 'triaxial drained'?); known types: oedometer, isotropic "
          "compression, triaxial drained, triaxial undrained, plane strain, simple shear, path"),
    wrong("test without type", ('      <Parameter name="type" type="string" value="simple shear"/>\n', ""),
          "tests/shear: required parameter 'type' is missing; known test types: oedometer, isotropic compression, triaxial drained, "
          "triaxial undrained, plane strain, simple shear, path", at=section("shear")),
    wrong("parameter of another test", (STRAINS, STRAINS + parameter("shear strain", "Array(double)", "{0.1}")),
          "tests/drained/shear strain: unknown parameter (did you mean 'axial strain'?)"),
    wrong("misspelt parameter", ('name="steps"', 'name="step"'), "tests/drained/step: unknown parameter (did you mean 'steps'?)"),
    wrong("no target", (STRAINS, ""), "tests/drained: exactly one of 'axial strain' and 'stress difference' must be given", at=section("drained")),
    wrong("cycles of one target", (STRAINS, parameter("axial strain", "Array(double)", "{0.05}") + parameter("cycles", "int", "2")),
          "tests/drained/cycles: one target has no way back; cycles need two targets or more"),
    wrong("cycle that begins where it ends", (STRAINS, parameter("axial strain", "Array(double)", "{0.05, 0.02, 0.05}") + parameter("cycles", "int", "2")),
          "tests/drained/axial strain: target 1, 0.05, is where the soil is already"),
    wrong("empty target", (STRAINS, parameter("axial strain", "Array(double)", "{}")), "tests/drained/axial strain: at least one target is needed"),
    wrong("target that is reached already", (STRAINS, parameter("axial strain", "Array(double)", "{0.05, 0.05}")),
          "tests/drained/axial strain: target 2, 0.05, is where the soil is already"),
    wrong("nothing left of the soil", (STRAINS, parameter("axial strain", "Array(double)", "{1.0}")),
          "tests/drained/axial strain: an engineering strain of 1 leaves nothing of the soil; allowed: below 1"),
    wrong("a number for a list", (STRAINS, parameter("axial strain", "string", "much")),
          "tests/drained/axial strain: expected an array of numbers (Array(double)), given the string 'much'"),
    wrong("no steps", (parameter("steps", "int", "20"), parameter("steps", "int", "0")),
          "tests/drained/steps: 0 is out of range; allowed: [1, 1e+06]"),
    wrong("unknown measure", ('value="engineering"', 'value="engineer"'),
          "tests/drained/strain measure: 'engineer' is not a choice (did you mean 'engineering'?)"),
    wrong("unknown drainage", ('value="undrained"', 'value="undraind"'),
          "tests/shear/drainage: 'undraind' is not a choice (did you mean 'undrained'?)"),
    wrong("driven twice", (STRESSES, STRESSES + parameter("axial strain", "Array(double)", "{0.1}")),
          "tests/oedometer: exactly one of 'axial strain' and 'axial stress' must be given", at=section("oedometer")),
    wrong("idle rate", (parameter("stress rate", "double", "10"), parameter("strain rate", "double", "1e-3")),
          "tests/oedometer/strain rate: plays no role where 'axial stress' drives the test; remove it"),
    wrong("negative rate", (parameter("stress rate", "double", "10"), parameter("stress rate", "double", "-10")),
          "tests/oedometer/stress rate: -10 is out of range; allowed: (0, inf)"),
    wrong("unknown material", ('name="material" type="string" value="clay"', 'name="material" type="string" value="cly"'),
          "tests/drained/material: unknown material 'cly' (did you mean 'clay'?)"),
    wrong("which material", ('      <Parameter name="material" type="string" value="clay"/>\n', ""),
          "tests/drained: required parameter 'material' is missing; the deck has several: clay, plate", at=section("drained")),
    wrong("no initial stress", ("        " + MEAN + "\n", ""),
          "tests/drained/initial state: no initial stress: give one of 'mean effective stress', 'vertical effective stress', or "
          "components such as 'effective stress yy'", at='<ParameterList name="initial state">'),
    wrong("two initial stresses", (MEAN, MEAN + parameter("effective stress yy", "double", "1e5")),
          "tests/drained/initial state: contradictory: give one of 'mean effective stress', 'vertical effective stress', or components "
          "such as 'effective stress yy'", at='<ParameterList name="initial state">'),
    wrong("K0 beside components", (parameter("effective stress xx", "double", "60e3"), parameter("K0", "double", "0.6")),
          "tests/shear/initial state/K0: contradictory: components of the stress leave no room for 'K0'"),
    wrong("tensile start", (MEAN, parameter("mean effective stress", "double", "-100e3")),
          "tests/drained/initial state/mean effective stress: -1e+05 is out of range; allowed: [0, inf)"),
    wrong("a start that the law refuses", (parameter("overconsolidation ratio", "double", "1.5"),
                                           parameter("overconsolidation ratio", "double", "0.5")),
          "tests/drained/initial state: material 'clay' cannot start here: the overconsolidation ratio must be at least 1; it is 0.5",
          at='<ParameterList name="initial state">'),
    wrong("no void ratio", ('        <Parameter name="void ratio" type="double" value="0.6"/>\n', ""),
          "tests/squeeze/initial state: neither the material 'plate' nor the test has a 'void ratio'",
          at='<ParameterList name="initial state">\n        <Parameter name="mean effective stress" type="double" value="5e3"/>'),
    wrong("strain and stress of one component", (parameter("strain yy", "string", "push"), parameter("strain yy", "string", "push") +
                                                 parameter("effective stress yy", "double", "5e3")),
          "tests/squeeze/effective stress yy: contradictory: give 'strain yy' or 'effective stress yy', not both"),
    wrong("unknown function", ('value="push"', 'value="pusch"'),
          "tests/squeeze/strain yy: there is no function 'pusch' (did you mean 'push'?)"),
    wrong("wrong skeleton", ('value="modified cam clay"', 'value="modified cam"'),
          "materials/clay/skeleton/type: unknown skeleton type 'modified cam' (did you mean 'modified cam clay'?); known types: "
          "linear elastic, modified cam clay, mohr-coulomb, tresca, drucker-prager, neo-hookean, von mises, hypoplasticity, s-clay1s, umat"),
    wrong("wrong skeleton parameter", ('name="swelling slope"', 'name="sweling slope"'),
          "materials/clay/skeleton/sweling slope: unknown parameter (did you mean 'swelling slope'?)"),
    wrong("results of one name", (section("shear"), section("the shear") + parameter("a", "int", "1") + "</ParameterList>" + section("the_shear")),
          "tests/the shear: required parameter 'type' is missing; known test types: oedometer, isotropic compression, triaxial drained, "
          "triaxial undrained, plane strain, simple shear, path"),
    wrong("missing plugin", (section("functions"), section("plugins") + parameter("files", "Array(string)", "{none.so}") + "</ParameterList>" +
                             section("functions")),
          "plugins/files: plugin 'none.so' does not exist (looked for {folder}/none.so)"),
    wrong("setting outside the deck", [], "--set tests/draind/steps=5: tests/draind: the deck has no such section (did you mean 'drained'?)",
          line=False, settings=["tests/draind/steps=5"]),
]
