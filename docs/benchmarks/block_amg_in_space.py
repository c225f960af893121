#!/usr/bin/env python3
"""Iterations, processor time and memory of one step of an elastic saturated box under a square footing, in space.

    python3 docs/benchmarks/block_amg_in_space.py PROGRAM [--cells 9 14 20 25] [--height 10] [--cell tet10]

Prints a markdown table over mesh, time step and mobility. Iterations per linear solve are those to 1e-8 ('largest
forcing' 0); the other columns are of a step with default settings. Memory is that of the whole process.
"""
import argparse
import collections
import os
import re
import subprocess
import tempfile

DECK = """<ParameterList name="footing">
  <ParameterList name="mesh">
    <Parameter name="type" type="string" value="box"/>
    <Parameter name="geometry" type="string" value="three-dimensional"/>
    <Parameter name="cell" type="string" value="CELL"/>
    <Parameter name="cells" type="Array(int)" value="{CELLS, CELLS, CELLS}"/>
    <Parameter name="upper" type="Array(double)" value="{10.0, 10.0, HEIGHT}"/>
  </ParameterList>
  <ParameterList name="materials">
    <ParameterList name="soil">
      <Parameter name="porosity" type="double" value="0.4"/>
      <Parameter name="grain density" type="double" value="2666.7"/>
      <ParameterList name="skeleton">
        <Parameter name="type" type="string" value="linear elastic"/>
        <Parameter name="Young's modulus" type="double" value="1e7"/>
        <Parameter name="Poisson's ratio" type="double" value="0.3"/>
      </ParameterList>
      <ParameterList name="fluid">
        <Parameter name="type" type="string" value="water"/>
        <Parameter name="unit weight" type="double" value="1e4"/>
      </ParameterList>
      <ParameterList name="permeability">
        <Parameter name="type" type="string" value="constant"/>
        <Parameter name="hydraulic conductivity" type="double" value="CONDUCTIVITY"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="physics">
    <ParameterList name="ground">
      <Parameter name="type" type="string" value="biot"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="boundary conditions">
    <ParameterList name="base">
      <Parameter name="type" type="string" value="fixed"/>
      <Parameter name="set" type="string" value="bottom"/>
    </ParameterList>
    SIDES
    <ParameterList name="drained surface">
      <Parameter name="type" type="string" value="pore pressure"/>
      <Parameter name="set" type="string" value="top"/>
    </ParameterList>
    <ParameterList name="load">
      <Parameter name="type" type="string" value="traction"/>
      <Parameter name="set" type="string" value="top"/>
      <Parameter name="z" type="string" value="-1e3*(x&lt;2.5)*(y&lt;2.5)"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="stages">
    <ParameterList name="loading">
      <Parameter name="type" type="string" value="STAGE"/>
      <Parameter name="duration" type="double" value="STEP"/>
      <ParameterList name="time step">
        <Parameter name="initial" type="double" value="STEP"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="solver">
    <ParameterList name="linear solver">
      <Parameter name="type" type="string" value="SOLVER"/>
    </ParameterList>
    <ParameterList name="newton">
      <Parameter name="largest forcing" type="double" value="FORCING"/>
    </ParameterList>
  </ParameterList>
</ParameterList>
"""
SIDE = """<ParameterList name="%s side">
      <Parameter name="type" type="string" value="fixed"/>
      <Parameter name="set" type="string" value="%s"/>
      <Parameter name="components" type="string" value="%s"/>
    </ParameterList>
    """
SIDES = "".join(SIDE % (s, s, c) for s, c in (("left", "x"), ("right", "x"), ("front", "y"), ("back", "y")))


Result = collections.namedtuple("Result", "status output unknowns steps usage")


def filled(text, values):
    """The text with its capital words replaced by numbers."""
    for key in sorted(values, key=len, reverse=True):
        text = re.sub(r"\b%s\b" % key, str(values[key]), text)
    return text


def run_deck(program, text, settings=()):
    """Runs a deck in a folder of its own. steps: (Newton iterations, linear iterations) of each; unknowns: None without a model."""
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "deck.xml"), "w") as file:
            file.write(text)
        command = [os.path.abspath(program), "run", "deck.xml"]
        for setting in settings:
            command += ["--set", setting]
        environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
        with open(os.path.join(folder, "log"), "w+") as log:
            process = subprocess.Popen(command, cwd=folder, env=environment, stdout=log, stderr=log)
            _, status, usage = os.wait4(process.pid, 0)
            log.seek(0)
            output = log.read()
    unknowns = re.search(r"(\d+) unknowns", output)
    steps = [(int(a), int(b)) for a, b in re.findall(r"newton +(\d+) +linear +(\d+)", output)]
    return Result(status, output, int(unknowns.group(1)) if unknowns else None, steps, usage)


def run(options, cells, step, mobility, forcing):
    """(unknowns, Newton iterations, linear iterations, user seconds, MB) of one step."""
    values = {"CELLS": cells, "CELL": options.cell, "HEIGHT": float(options.height), "CONDUCTIVITY": mobility * 1e4,
              "STAGE": "dynamic" if step < 1 else "quasi-static", "STEP": float(step), "FORCING": forcing, "SOLVER": options.solver}
    done = run_deck(options.program, filled(DECK.replace("SIDES", SIDES), values))
    if done.status != 0 or not done.steps:
        raise SystemExit(done.output)
    newton, linear = done.steps[0]
    return done.unknowns, newton, linear, done.usage.ru_utime, done.usage.ru_maxrss / 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--cells", type=int, nargs="+", default=[9, 14, 20, 25])
    parser.add_argument("--steps", type=float, nargs="+", default=[1e-4, 0.1, 100])
    parser.add_argument("--mobilities", type=float, nargs="+", default=[1e-12, 1e-8, 1e-6])
    parser.add_argument("--height", type=float, default=10, help="of the box, 10 m wide: 1 stretches the elements")
    parser.add_argument("--cell", default="tet10")
    parser.add_argument("--solver", default="block amg")
    options = parser.parse_args()
    print("| unknowns | time step [s] | mobility [m2/(Pa s)] | iterations per solve | Newton | linear | CPU [s] | memory [MB] |")
    print("|---|---|---|---|---|---|---|---|")
    for cells in options.cells:
        for step in options.steps:
            for mobility in options.mobilities:
                _, newton, linear, _, _ = run(options, cells, step, mobility, 0)
                full = linear / newton
                unknowns, newton, linear, seconds, memory = run(options, cells, step, mobility, 0.1)
                print("| %d | %g | %.0e | %.1f | %d | %d | %.1f | %.0f |" % (unknowns, step, mobility, full, newton, linear, seconds, memory), flush=True)


if __name__ == "__main__":
    main()
