#!/usr/bin/env python3
"""Iterations of 'block amg' under a rigid plate that is pressed on soil in space, smooth and rough.

    python3 docs/benchmarks/contact_in_space.py PROGRAM [--cells 9 14 20] [--soils elastic tresca] [--set KEY=VALUE ...]

Prints a markdown table over mesh, soil and roughness. A quarter of a plate of 5 m x 5 m goes into the saturated box of
block_amg_in_space.py in equal steps of 100 s, in which nothing flows; the contact's penalty is a thousand constrained
moduli over the height of an element. Iterations per linear solve are those to 1e-8 ('largest forcing' 0), the mean of all
solves of the step. Newton's steps are halved where the residual grows ('largest growth' 1.2): full steps go round in
circles under a rough plate, with a direct solver as well. '--solver direct' gives the Newton iterations with exact solves; a step is never cut ('failed' says so).
"""
import argparse
import re

import block_amg_in_space as box

NUMBER = '<Parameter name="%s" type="double" value="%s"/>'
SOILS = {
    "elastic": ("linear elastic", {"Young's modulus": 1e7, "Poisson's ratio": 0.3}),
    "tresca": ("tresca", {"shear modulus": 1e7 / 2.6, "Poisson's ratio": 0.3, "undrained strength": 1e4}),
    "mohr-coulomb": ("mohr-coulomb", {"Young's modulus": 1e7, "Poisson's ratio": 0.3, "cohesion": 5e3, "friction angle [deg]": 25.0}),
    "drucker-prager": ("drucker-prager", {"Young's modulus": 1e7, "Poisson's ratio": 0.3, "cohesion": 5e3, "friction angle [deg]": 25.0}),
}
BODY = """<ParameterList name="bodies">
    <ParameterList name="plate">
      <Parameter name="position" type="Array(double)" value="{0.0, 0.0, 10.0}"/>
      <ParameterList name="surface">
        <Parameter name="type" type="string" value="box"/>
        <Parameter name="length x" type="double" value="5.0"/>
        <Parameter name="length y" type="double" value="5.0"/>
        <Parameter name="length z" type="double" value="1.0"/>
        <Parameter name="position" type="Array(double)" value="{0.0, 0.0, 0.5}"/>
      </ParameterList>
      <ParameterList name="motion">
        <Parameter name="type" type="string" value="prescribed displacement"/>
        <Parameter name="z" type="string" value="-ADVANCE*t/100"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="contacts">
    <ParameterList name="plate on soil">
      <Parameter name="type" type="string" value="penalty"/>
      <Parameter name="body" type="string" value="plate"/>
      <Parameter name="surface" type="string" value="top"/>
      <Parameter name="penalty factor" type="double" value="PENALTY"/>
      FRICTION
    </ParameterList>
  </ParameterList>
  <ParameterList name="boundary conditions">"""
FRICTION = """<ParameterList name="friction">
        <Parameter name="type" type="string" value="coulomb"/>
        <Parameter name="coefficient" type="double" value="%g"/>
      </ParameterList>"""


def deck(options, cells, soil, friction):
    text = box.DECK.replace("SIDES", box.SIDES)
    kind, numbers = SOILS[soil]
    skeleton = '<Parameter name="type" type="string" value="%s"/>' % kind + "".join(NUMBER % item for item in numbers.items())
    text = re.sub(r'<Parameter name="type" type="string" value="linear elastic"/>.*?(?=</ParameterList>)', lambda _: skeleton, text, count=1,
                  flags=re.DOTALL)
    text = re.sub(r'<ParameterList name="load">.*?</ParameterList>', "", text, flags=re.DOTALL)
    text = text.replace('<ParameterList name="boundary conditions">', BODY.replace("FRICTION", FRICTION % friction if friction else ""))
    text = text.replace('name="duration" type="double" value="STEP"', 'name="duration" type="double" value="%g"' % (100 * options.advances))
    values = {"CELLS": cells, "CELL": options.cell, "HEIGHT": float(options.height), "CONDUCTIVITY": options.mobility * 1e4, "STAGE": "quasi-static",
              "STEP": 100.0, "FORCING": 0, "SOLVER": options.solver, "ADVANCE": options.advance, "PENALTY": options.penalty}
    return box.filled(text, values)


def run(options, cells, soil, friction):
    """Unknowns, and (Newton iterations, linear iterations) of each step; fewer steps where one failed."""
    settings = ["stages/loading/time step/minimum=100", "solver/newton/largest growth=1.2", "solver/newton/maximum iterations=25",
                "solver/linear solver/maximum iterations=600"]
    done = box.run_deck(options.program, deck(options, cells, soil, friction), settings + options.set)
    if options.log:
        print(done.output)
    if done.unknowns is None:
        raise SystemExit(done.output)
    return done.unknowns, done.steps


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--cells", type=int, nargs="+", default=[9, 14, 20])
    parser.add_argument("--soils", nargs="+", default=list(SOILS), choices=list(SOILS))
    parser.add_argument("--friction", type=float, nargs="+", default=[0, 0.3], help="coefficients; 0 is smooth")
    parser.add_argument("--advance", type=float, default=0.01, help="of the plate per step [m]")
    parser.add_argument("--advances", type=int, default=4, help="steps")
    parser.add_argument("--penalty", type=float, default=1e3, help="multiple of constrained modulus over height")
    parser.add_argument("--mobility", type=float, default=1e-12, help="[m2/(Pa s)]")
    parser.add_argument("--height", type=float, default=10, help="of the box, 10 m wide: 1 stretches the elements")
    parser.add_argument("--cell", default="tet10")
    parser.add_argument("--solver", default="block amg")
    parser.add_argument("--set", nargs="+", default=[], help="further settings of the deck")
    parser.add_argument("--log", action="store_true", help="print the program's own output too")
    options = parser.parse_args()
    print("| unknowns | soil | friction | Newton, by step | iterations per solve, by step |")
    print("|---|---|---|---|---|")
    for cells in options.cells:
        for soil in options.soils:
            for friction in options.friction:
                unknowns, steps = run(options, cells, soil, friction)
                failed = ["failed"] if len(steps) < options.advances else []
                print("| %d | %s | %g | %s | %s |" % (unknowns, soil, friction, ", ".join([str(n) for n, _ in steps] + failed),
                                                      ", ".join("%.1f" % (m / n) for n, m in steps)), flush=True)


if __name__ == "__main__":
    main()
