#!/usr/bin/env python3
"""Every verification test says what it compares with, compares that, and has its row in docs/validation.md.

    check_validation.py ROOT CTEST BUILD    prints one line per fault and ends with 1 if there is any

A test without a level, source or title, one that compares although it is said not to (or the other way round), a test
that the page lacks, a row of a test that is gone, and a row whose command names no test of the build are faults.
"""
import ast
import collections
import functools
import pathlib
import re
import subprocess
import sys

ROW = re.compile(r"^(\| \[[^\]]+\]\(\.\./tests/verification/[^)]+\) \|).*\| `([^`]+)` \|$", re.M)


@functools.lru_cache(maxsize=None)
def calls_of(path):
    """{function: names that it calls as methods} of a file."""
    found = collections.defaultdict(set)
    for function in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(function, ast.FunctionDef):
            found[function.name] |= {call.func.attr for call in ast.walk(function)
                                     if isinstance(call, ast.Call) and isinstance(call.func, ast.Attribute)}
    return found


def comparing(comparisons, paths):
    """Names of the functions in these files that lead to one of the comparisons, also by other functions."""
    calls = collections.defaultdict(set)
    for path in paths:
        for function, called in calls_of(path).items():
            calls[function] |= called
    found = set(comparisons)
    while True:
        more = {name for name, called in calls.items() if called & found} - found
        if not more:
            return found
        found |= more


def faults(root, found, compared, comparisons, known, page):
    """found: the problems; compared: levels with a row; comparisons: calls that compare; known: names of the build's
    tests; page: its text."""
    folder = root / "tests" / "verification"
    shared = [root / "tests" / "support" / "mudline_case.py"]
    shared += [path for path in folder.glob("*/*.py") if path.name[:5] != "test_"]
    leading, heads = {}, collections.Counter(problem.row_head() for problem in found if problem.level in compared)
    for problem in found:
        where = f"{problem.file}: {problem.id}"
        if problem.level is None or not problem.title or problem.topic is None:
            yield f"{where} has no level, title or topic (@problem)"
            continue
        if problem.level in ("exact", "benchmark", "measured") and not problem.source:
            yield f"{where} does not name the source of its reference"
        if problem.file not in leading:
            leading[problem.file] = comparing(comparisons, [root / problem.file, *shared])
        compares = problem.id.split(".")[1] in leading[problem.file]
        if compares != (problem.level in compared):
            yield f"{where} is of level '{problem.level}', and {'compares' if compares else 'compares nothing'}"
    for head in (head for head, count in heads.items() if count > 1):
        yield f"several tests have the row {head}"
    rows = dict(ROW.findall(page))
    for head in heads.keys() - rows.keys():
        yield f"docs/validation.md lacks the row {head} (tests/verification/matrix.py --no-run writes it)"
    for head in rows.keys() - heads.keys():
        yield f"docs/validation.md has a row of no test: {head}"
    for command in sorted(set(rows.values()) - known):
        yield f"docs/validation.md: no test of the build is named {command}"


def main():
    root, ctest, build = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2], sys.argv[3]
    sys.path.insert(0, str(root / "tests" / "verification"))
    import matrix
    from compared_case import COMPARISONS

    listed = subprocess.run([ctest, "--test-dir", build, "-N"], capture_output=True, text=True, check=True).stdout
    known = set(re.findall(r"^ +Test +#\d+: (\S+)", listed, flags=re.M))
    page = (root / "docs" / "validation.md").read_text(encoding="utf-8")
    lines = list(faults(root, matrix.problems(), matrix.COMPARED, COMPARISONS, known, page))
    print("\n".join(lines) if lines else "every verification test has its row, and every row its test")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
