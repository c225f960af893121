#!/usr/bin/env python3
"""Writes docs/validation.md, the matrix of all verification and validation problems, and its picture.

    matrix.py                  runs all verification tests, then writes the page
    matrix.py --tests REGEX    runs only these; of the others the last records stand
    matrix.py --no-run         writes the page from the records that are there

The records are JSON lines that the tests write where MUDLINE_RECORD names a folder (tests/support/compared_case.py),
here build/release/records. `./mudline test` makes them too. What a row is called, and what it is compared with,
stands beside the test (`problem`). Every figure of the page comes from a record.
"""
import argparse
import importlib.util
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import unittest

FOLDER = pathlib.Path(__file__).resolve().parent
TOP = FOLDER.parents[1]
sys.path[:0] = [str(TOP / "tests" / "support"), str(FOLDER)]
from compared_case import COMPARED, LEVELS, described, record_file  # noqa: E402

RECORDS = TOP / "build" / "release" / "records"
PAGE, PICTURE = TOP / "docs" / "validation.md", TOP / "docs" / "pictures" / "validation.png"
MEASUREMENTS = ("kaolin", "sand", "kaolin_cone", "clay_sites", "fall_cone", "uplift", "anchors")

# folder: table of the page
TOPICS = {"consolidation": "consolidation and flow", "unsaturated soil": "unsaturated soil", "materials": "materials",
          "strength": "strength, cavities, initial states", "contact": "contact", "bodies": "rigid bodies and impact",
          "dynamics": "dynamics", "ale": "penetration and moving meshes", "heat": "heat", "space": "three dimensions",
          "error": "error estimates", "meshes": "meshes", "parameters": "parameters"}
COLOURS = {"exact": "#0b5d8a", "benchmark": "#d1622b", "measured": "#8a4f9e", "consistency": "#9a9a9a"}
SMALLEST = 1e-8  # [-] shares below are drawn here

NOT_FOUND = """
- The resistance of a cone in the sand of [the sand cone](benchmarks/sand_cone.md): the parameters of the law are
  published, a measured resistance is not. Nor the numbers of the published ratio of a cone's resistance to the limit
  pressure of a cavity in hypoplastic sand (Cudmani and Osinov 2001).
- Parameters of S-CLAY1S and Creep-SCLAY1S of Bothkennar, Murro, Gothenburg, POKO, Vanttila and Otaniemi clay
  ([materials](materials.md#10-s-clay1s-with-creep)).
- The parameters of the kaolin in which the piezocones of May (1987) were pushed, and which strength was measured: the
  abstract has neither ([piezocone](measurements/kaolin_cone.md)). Those of another kaolin are used.
- Points of cones that were pushed at several rates in a centrifuge, for the curve from undrained to drained
  resistance: abstracts and first pages only.
- The name of the sand of GA-cal and its parameters of the intergranular strain ([sand](measurements/sand.md)).
- Fall cone tests in a clay whose strength was measured at a stated rate, and the numbers of theoretical cone factors
  ([fall cone](measurements/fall_cone.md)).
- Geometry, mass, velocity, strength and depth of single anchors and free-falling penetrometers
  ([anchors](measurements/anchors.md)); sizes and strengths of the skirted foundations
  ([uplift](measurements/uplift.md)).
"""


class Problem:
    """One test of tests/verification, with what it says of itself and what its last run recorded."""

    def __init__(self, path, case, name):
        said = described(case, name)
        self.file = path.relative_to(TOP).as_posix()
        self.id = f"{case.__name__}.{name}"
        self.level, self.source = said.get("level"), said.get("source", "")
        self.title = said.get("title", "")
        self.topic = TOPICS.get(said.get("topic", path.parent.name))
        self.command = f"verification.{path.parent.name}.{path.stem[len('test_'):]}"
        self.comparisons, self.cpu, self.outcome = [], None, None

    def row_head(self):
        """The first cell of its row."""
        return f"| [{self.title}](../{self.file}) |"

    def read(self, records):
        """Takes what its last run recorded; returns the head of the record (date, processor), None without one."""
        path = pathlib.Path(record_file(records, self.file, self.id))
        lines = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()] if path.exists() else []
        if not lines or "outcome" not in lines[-1]:
            return None
        self.cpu, self.outcome = lines[-1]["cpu"], lines[-1]["outcome"]
        self.comparisons = [line for line in lines if "what" in line]
        return lines[0]

    def of(self, key):
        return [line for line in self.comparisons if key in line]

    def nearest(self):
        """The comparison that takes the largest share of what it is allowed; None where none has an error."""
        return max(self.of("allowed"), key=share, default=None)


def share(comparison):
    """Error over allowed error; 0 where none is made, whatever is allowed."""
    error, allowed = comparison["error"], comparison["allowed"]
    return 0.0 if error == 0 else math.inf if allowed == 0 else error / allowed


def problems():
    """All tests of tests/verification, in the order of files and lines."""
    found = []
    for path in sorted(FOLDER.glob("*/test_*.py")):
        sys.path.insert(0, str(path.parent))
        spec = importlib.util.spec_from_file_location(f"{path.parent.name}_{path.stem}", path)
        module = importlib.util.module_from_spec(spec)
        sys.modules[spec.name] = module
        spec.loader.exec_module(module)
        for case in vars(module).values():
            if isinstance(case, type) and issubclass(case, unittest.TestCase) and case.__module__ == spec.name:
                names = [name for name in dir(case) if name.startswith("test")]
                names.sort(key=lambda name: getattr(case, name).__code__.co_firstlineno)
                found += [Problem(path, case, name) for name in names]
        sys.path.remove(str(path.parent))
    return found


def number(value):
    """Two digits; 4.8e-4 for small and large ones."""
    if value == 0 or 0.001 <= abs(value) < 1000:
        return f"{value:.2g}"
    return re.sub(r"e([+-])0*(\d)", lambda match: "e" + match[1].strip("+") + match[2], f"{value:.1e}")


def compared(problem):
    """Cells: what is compared, error, allowed."""
    nearest = problem.nearest()
    more = len(problem.comparisons) - 1
    if nearest is not None:
        what = nearest["what"] + (f"; {more} more" if more else "")
        return what, number(nearest["error"]), number(nearest["allowed"])
    orders = problem.of("orders")
    if not orders:
        return "", "", ""
    worst = min(orders, key=lambda line: line["orders"][-1] - line["least"])
    most = "" if worst["most"] is None else f" to {number(worst['most'])}"
    return (worst["what"] + (f"; {more} more" if more else ""), f"order {worst['orders'][-1]:.2f}",
            f"{number(worst['least'])}{most or ' at least'}")


def convergence(problem):
    """Cell: number of meshes or steps, observed order, grid convergence index."""
    parts = []
    orders = problem.of("orders")
    if orders:
        found = [line["orders"][-1] for line in orders]
        span = f"{min(found):.2f}" + (f" to {max(found):.2f}" if len(found) > 1 else "")
        parts.append(f"{max(len(line['errors']) for line in orders)} meshes or steps, order {span}")
    for line in problem.of("gci"):
        parts.append(f"{line['what']}: order {line['order']:.2f}, GCI {number(line['gci'])}, "
                     f"error {number(line['true_error'])}")
    return "; ".join(parts)


def row(problem):
    level = problem.level + (f": {problem.source}" if problem.source else "")
    if problem.outcome is None:
        cells = [level, "not run on this page's date", "", "", "", ""]
    else:
        failed = "" if problem.outcome == "passed" else f"**{problem.outcome}**, "
        what, error, allowed = compared(problem)
        cells = [level, failed + what, error, allowed, convergence(problem), f"{problem.cpu:.1f}"]
    cells = [cell.replace("|", "\\|") + " |" for cell in cells]
    return " ".join([problem.row_head(), *cells, f"`{problem.command}` |"])


def summary(rows):
    lines = ["| level | compared with | rows | with a figure | failed | largest share of the allowed error |",
             "|---|---|---|---|---|---|"]
    for level in COMPARED:
        mine = [problem for problem in rows if problem.level == level]
        shares = [(share(problem.nearest()), problem) for problem in mine if problem.nearest()]
        largest = max(shares, key=lambda pair: pair[0], default=None)
        told = f"{100 * largest[0]:.0f} %: {largest[1].title}, {largest[1].nearest()['what']}" if largest else ""
        ran = sum(problem.outcome in ("passed", "failed") for problem in mine)
        failed = sum(problem.outcome == "failed" for problem in mine)
        lines.append(f"| {level} | {LEVELS[level]} | {len(mine)} | {ran} | {failed} | {told} |")
    return lines


def table_rows(text):
    """(head, rows) of the Markdown tables of a text, as lists of cells."""
    cells = lambda line: [cell.strip() for cell in line.strip().strip("|").split("|")]
    for block in re.findall(r"(?:^\|.*\n?)+", text, flags=re.M):
        lines = block.strip().splitlines()
        yield cells(lines[0]), [cells(line) for line in lines[2:]]


def misses(page):
    """Lines of a table: least and largest miss in per cent of every test of a page of docs/measurements."""
    lines = []
    for head, rows in table_rows((TOP / "docs" / "measurements" / (page + ".md")).read_text(encoding="utf-8")):
        for column in (i for i, name in enumerate(head) if name == "miss"):
            by_test = {}
            for cells in rows:
                by_test.setdefault(cells[0], []).append(float(re.match(r"([+-]?[\d.]+) %", cells[column])[1]))
            for test, found in by_test.items():
                span = f"{min(found):+.0f} %" if len(found) == 1 else f"{min(found):+.0f} to {max(found):+.0f} %"
                link = f"[{page.replace('_', ' ')}](measurements/{page}.md)"
                what = head[column - 1].replace("measured", "computed")
                lines.append(f"| {link} | {test} | {what} | {len(found)} | {span} |")
    return lines


def draw(rows, path):
    """Error over allowed error, by topic and level."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    topics = [topic for topic in TOPICS.values() if any(problem.topic == topic for problem in rows)]
    figure, axes = plt.subplots(figsize=(8.5, 0.42 * len(topics) + 1.3), constrained_layout=True)
    for level in reversed(COMPARED):
        points = [(max(share(line), SMALLEST), topics.index(problem.topic)) for problem in rows
                  if problem.level == level for line in problem.of("allowed")]
        offset = 0.27 - 0.18 * COMPARED.index(level)
        axes.plot([x for x, _ in points], [y - offset for _, y in points], "o", ms=3.5, alpha=0.55, mew=0,
                  color=COLOURS[level], label=level)
    axes.axvline(1, color="#b02020", lw=1.2)
    axes.set_xscale("log")
    axes.set_xlim(0.6 * SMALLEST, 3)
    axes.set_yticks(range(len(topics)), topics)
    axes.set_ylim(len(topics) - 0.5, -0.5)
    axes.grid(axis="x", color="#e3e3e3")
    for y in range(1, len(topics)):
        axes.axhline(y - 0.5, color="#e3e3e3", lw=0.8)
    axes.set_xlabel("error over allowed error (at the left end: less)")
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(handles[::-1], labels[::-1], loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=4, frameon=False)
    figure.savefig(path, dpi=130)


def page(found, heads):
    rows = [problem for problem in found if problem.level in COMPARED]
    lines = [
        "# Verification and validation", "",
        "All problems by which the program is checked, one row for each. The page is written by", "",
        "    /usr/bin/python3 tests/verification/matrix.py", "",
        "which runs the tests and reads what they record; after `./mudline test` the same with `--no-run` is enough.",
        "A row is repeated by", "",
        "    ctest --test-dir build/release -R NAME", "",
        "with the name in its last column; with `MUDLINE_SHOW_ERRORS=1` and `-V` all of its errors are shown.", "",
        "![Error over allowed error of all comparisons, by topic](pictures/validation.png)", "",
        "## Summary", "", *summary(rows), ""]
    behaviour = sum(problem.level == "behaviour" for problem in found)
    comparisons = sum(len(problem.comparisons) for problem in rows)
    lines += [f"{len(rows)} rows, {comparisons} comparisons. {behaviour} more tests compare no figure (messages,",
              "restarts bit for bit, what moves and what does not) and have no row.", ""]
    dates = sorted({head["date"] for head in heads})
    machines = sorted({head["processor"] for head in heads})
    if heads:
        when = " to ".join(dict.fromkeys((dates[0], dates[-1])))
        lines += [f"Run on {when}. CPU times are seconds, user and system, of the test and all that it starts, on",
                  f"one machine ({', '.join(machines)}, with other work beside).",
                  "A run that several tests of a class use counts for the first.", ""]
    missing = [problem for problem in rows if problem.outcome is None]
    if missing:
        names = ", ".join(f"`{name}`" for name in sorted({problem.command for problem in missing}))
        lines += [f"{len(missing)} rows have no figure (not run on this page's date), of: {names}.", ""]
    lines += [
        "## How to read the tables", "",
        "The row shows, of all comparisons of the test, the one that takes the largest share of what it is allowed.",
        "Errors are relative to the reference or to its largest value, or in SI units; the test says which. What is",
        "allowed is the test's tolerance. Of measurements the error is the miss, and what is allowed is the largest",
        "that the test lets pass. Where no error is bounded but its order, the order stands there.", "",
        "Where a quantity is computed on three nested meshes, each twice as fine as the one before, with values",
        "$f_3$, $f_2$, $f_1$ from coarse to fine, the observed order and the grid convergence index are", "",
        "$$ p = \\ln\\frac{f_3 - f_2}{f_2 - f_1} / \\ln 2, \\qquad "
        "\\mathrm{GCI} = 1.25\\,\\left|\\frac{f_2 - f_1}{f_1}\\right| \\frac{1}{2^p - 1} $$", "",
        "(P. J. Roache, Perspective: a method for uniform reporting of grid refinement studies, J. Fluids Eng. 116,",
        "405-413, 1994). An observed order more than a tenth above the formal one (values at nodes may converge",
        "faster than the field) is not trusted: the formal order is taken instead, and 3 for 1.25 (Roache, J. Fluids",
        "Eng. 133, 115501, 2011). The exact value is known, and the test asks the index to cover the error of the",
        "finest mesh.", ""]
    for topic in dict.fromkeys(TOPICS.values()):
        mine = [problem for problem in rows if problem.topic == topic]
        if mine:
            lines += [f"## {topic[0].upper()}{topic[1:]}", "",
                      "| problem | level and reference | nearest to its bound | error | allowed | meshes, order, GCI "
                      "| CPU [s] | `ctest -R` |", "|---|---|---|---|---|---|---|---|", *map(row, mine), ""]
    lines += ["## Held against measurements", "",
              "Misses in per cent of the measured value, least and largest over the points of a test, as the pages",
              "have them.", "",
              "| page | test | what | points | miss |", "|---|---|---|---|---|",
              *(line for name in MEASUREMENTS for line in misses(name)), ""]
    unmeasured = [topic for topic in dict.fromkeys(TOPICS.values())
                  if not any(problem.topic == topic and problem.level == "measured" for problem in rows)]
    lines += ["Pushed cones and anchors are compared on their pages only, no test repeats them. No test compares with a",
              "measurement in " + "; ".join(unmeasured) + ".", "", "## Looked for and not found", "", NOT_FOUND.strip(), ""]
    return "\n".join(lines)


def run(tests, records):
    environment = dict(os.environ, MUDLINE_RECORD=str(records))
    records.mkdir(parents=True, exist_ok=True)
    command = ["ctest", "--test-dir", str(TOP / "build" / "release"), "-R", tests, "-j2", "--output-on-failure"]
    return subprocess.run(command, env=environment).returncode


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--tests", default="^verification", metavar="REGEX", help="which tests to run")
    arguments.add_argument("--no-run", action="store_true", help="take the records that are there")
    arguments.add_argument("--records", type=pathlib.Path, default=RECORDS, metavar="FOLDER", help="their folder")
    given = arguments.parse_args()
    code = 0 if given.no_run else run(given.tests, given.records.resolve())
    found = problems()
    heads = [head for head in (problem.read(given.records) for problem in found) if head]
    if not heads:
        sys.exit(f"{given.records}: no records there")
    PAGE.write_text(page(found, heads), encoding="utf-8")
    draw([problem for problem in found if problem.level in COMPARED], PICTURE)
    print(f"{PAGE.relative_to(TOP)} and {PICTURE.relative_to(TOP)} are written")
    return code


if __name__ == "__main__":
    sys.exit(main())
