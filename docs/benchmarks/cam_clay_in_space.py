#!/usr/bin/env python3
"""Iterations of 'block amg' where Cam Clay yields undrained in space: a box of clay under a square footing.

    python3 docs/benchmarks/cam_clay_in_space.py PROGRAM [--cells 12 14 20] [--ratio 1] [--set KEY=VALUE ...]

Prints a markdown table over mesh and load. Clay of the given overconsolidation ratio under its weight and 10 kPa, whose
surface drains, loaded in two steps of 100 s, in which nothing flows. Iterations per linear solve are those to 1e-8
('largest forcing' 0), the mean of all solves of the step.
"""
import argparse
import re

import block_amg_in_space as box

SKELETON = """<Parameter name="void ratio" type="double" value="1.3"/>
      <Parameter name="grain density" type="double" value="2700"/>
      <ParameterList name="skeleton">
        <Parameter name="type" type="string" value="modified cam clay"/>
        <Parameter name="critical stress ratio" type="double" value="1.0"/>
        <Parameter name="compression slope" type="double" value="0.2"/>
        <Parameter name="swelling slope" type="double" value="0.04"/>
        <Parameter name="Poisson's ratio" type="double" value="0.3"/>
      </ParameterList>"""
PHYSICS = """<Parameter name="type" type="string" value="biot"/>
      <Parameter name="gravity" type="Array(double)" value="{0.0, 0.0, -9.81}"/>
      <ParameterList name="initial state">
        <Parameter name="type" type="string" value="geostatic"/>
        <Parameter name="water level" type="double" value="10.0"/>
        <Parameter name="surcharge" type="double" value="10e3"/>
        <Parameter name="K0" type="double" value="0.6"/>
        <Parameter name="overconsolidation ratio" type="double" value="RATIO"/>
      </ParameterList>"""
SURCHARGE = """<ParameterList name="surcharge">
      <Parameter name="type" type="string" value="pressure"/>
      <Parameter name="set" type="string" value="top"/>
      <Parameter name="value" type="double" value="10e3"/>
    </ParameterList>
    <ParameterList name="load">"""


def deck(cells, load, ratio):
    text = box.DECK.replace("SIDES", box.SIDES)
    text = re.sub(r'<Parameter name="porosity".*?</ParameterList>', lambda _: SKELETON, text, count=1, flags=re.DOTALL)
    text = text.replace('<Parameter name="type" type="string" value="biot"/>', PHYSICS)
    text = text.replace('<ParameterList name="load">', SURCHARGE)
    text = text.replace("-1e3*(x", "-%g*t/100*(x" % (load / 2))
    text = text.replace('name="duration" type="double" value="STEP"', 'name="duration" type="double" value="200"')
    values = {"CELLS": cells, "CELL": "tet10", "HEIGHT": 10.0, "CONDUCTIVITY": 1e-12, "STAGE": "quasi-static", "STEP": 100.0,
              "FORCING": 0, "SOLVER": "block amg", "RATIO": ratio}
    return box.filled(text, values)


def run(options, cells, load):
    """Unknowns, and (Newton iterations, linear iterations) of each step."""
    done = box.run_deck(options.program, deck(cells, load, options.ratio), options.set)
    if done.status != 0 or not done.steps:
        raise SystemExit(done.output)
    return done.unknowns, done.steps


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--cells", type=int, nargs="+", default=[12, 14, 20])
    parser.add_argument("--loads", type=float, nargs="+", default=[10e3, 20e3], help="on the footing at the end [Pa]")
    parser.add_argument("--ratio", type=float, default=1, help="overconsolidation ratio")
    parser.add_argument("--set", nargs="+", default=[], help="further settings of the deck")
    options = parser.parse_args()
    print("| unknowns | load [kPa] | Newton, two steps | iterations per solve, two steps |")
    print("|---|---|---|---|")
    for cells in options.cells:
        for load in options.loads:
            unknowns, steps = run(options, cells, load)
            print("| %d | %g | %s | %s |" % (unknowns, load / 1e3, ", ".join(str(n) for n, _ in steps),
                                             ", ".join("%.1f" % (m / n) for n, m in steps)), flush=True)


if __name__ == "__main__":
    main()
