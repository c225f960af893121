#!/usr/bin/env python3
"""Time per step and unknown of the 2-D dynamic footing, split into residual, Jacobian and linear solve.

    python3 docs/benchmarks/dynamic_footing.py PROGRAM [--cells 40 80 120 160] [--ranks 1 2]

Prints a markdown table with the settlement under the strip's centre; the converged values are in the verification test.
Wall-clock microseconds; compare ratios within one run, not figures of different days.
"""
import argparse
import csv
import os
import re
import subprocess
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
DECK = os.path.join(ROOT, "inputs", "footing", "dynamic_footing.xml")


def run(program, n, ranks):
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "run", DECK, "--set", "mesh/cells={%d, %d}" % (n, n // 2)]
        if ranks > 1:
            command = ["mpiexec", "--allow-run-as-root", "--oversubscribe", "--bind-to", "none", "-n", str(ranks)] + command
        environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
        text = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=True).stdout
        with open(os.path.join(folder, "results", "dynamic_footing.csv"), newline="") as file:
            rows = list(csv.DictReader(file))
    settlement = next((v for k, v in rows[-1].items() if "displacement y" in k), "nan")
    unknowns = int(re.search(r"(\d+) unknowns", text).group(1))
    steps = int(re.search(r"done: (\d+) steps", text).group(1))
    total = float(re.search(r"rejected, ([\d.]+) s", text).group(1))
    parts = [float(v) for v in re.search(r"time: residuals ([\d.]+) s, Jacobians ([\d.]+) s, linear solves ([\d.]+) s", text).groups()]
    newton = sum(float(r["step/newton iterations [-]"]) for r in rows) / len(rows)
    scale = 1e6 / (steps * unknowns)
    return unknowns, newton, total * scale, [p * scale for p in parts], float(settlement)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--cells", type=int, nargs="+", default=[40, 80, 120, 160])
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2])
    options = parser.parse_args()
    print("| n | ranks | unknowns | Newton per step | total | residual | Jacobian | linear solve | settlement at 0.5 s [m] |")
    print("|---|---|---|---|---|---|---|---|---|")
    for n in options.cells:
        for ranks in options.ranks:
            unknowns, newton, total, parts, settlement = run(options.program, n, ranks)
            print("| %d | %d | %d | %.2f | %.2f | %.2f | %.2f | %.2f | %.6e |" % (n, ranks, unknowns, newton, total, *parts, settlement), flush=True)


if __name__ == "__main__":
    main()
