"""Comparisons with a reference: one call asserts, tells and records them.

A test says with `problem` what it compares with. `compare` and what stands on it print the errors where
MUDLINE_SHOW_ERRORS is set, and write them as JSON lines to the folder that MUDLINE_RECORD names, one file for every
test, which holds its last run. tests/verification/matrix.py makes docs/validation.md of these records.
"""
import inspect
import json
import os
import platform
import re
import time
import unittest

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

LEVELS = {
    "exact": "a closed form, a manufactured or a semi-analytical solution",
    "benchmark": "a published or an independent numerical solution",
    "measured": "measurements",
    "consistency": "another run of the program, which must agree",
    "behaviour": "no figure: messages, restarts bit for bit, what moves and what does not",
}
COMPARED = ("exact", "benchmark", "measured", "consistency")  # levels that are rows of the matrix

COMPARISONS = {"compare", "compare_values", "compare_range", "compare_orders", "compare_meshes"}

SAFETY, CAUTIOUS = 1.25, 3.0  # [-] factors of the grid convergence index: usual, without a trusted order

_spent = 0.0  # [s] CPU time of the tests of this process that have ended
_started = set()  # files of records that this process has begun


def problem(level=None, source=None, title=None, topic=None):
    """Says of a class of tests, or of one test, what its answer is compared with. What a test does not say is that of
    its class. level: one of LEVELS. source: of the reference, for `exact`, `benchmark` and `measured`; it belongs to
    the level beside it. title: by default the class's, and the test's name. topic: the table of the page, by default
    the folder's."""
    if level is not None and level not in LEVELS:
        raise ValueError(f"level '{level}' is none of {', '.join(LEVELS)}")
    entries = {"level": level, "source": source, "title": title, "topic": topic}

    def mark(test):
        test.problem = {name: value for name, value in entries.items() if value is not None}
        return test
    return mark


def described(case, name):
    """{level, source, title, topic} of the test `name` of a class, as far as they are said."""
    of_class, of_test = getattr(case, "problem", {}), getattr(getattr(case, name), "problem", {})
    found = {**of_class, **of_test}
    if "level" in of_test:
        found["source"] = of_test.get("source", "")
    if "title" in of_class and "title" not in of_test:
        tests = [test for test in dir(case) if test.startswith("test")]
        words = name[len("test_"):].replace("_", " ")
        found["title"] = of_class["title"] + (": " + words if len(tests) > 1 else "")
    return found


def test_file(case):
    """The file of a class of tests, from the root of the tree."""
    return os.path.relpath(os.path.abspath(inspect.getfile(case)), ROOT)


def record_file(folder, source, test):
    """The file in which a test (Class.name) of a file of the tree is recorded."""
    return os.path.join(folder, f"{source.replace(os.sep, '.')}.{test}.jsonl")


def grid_convergence(values, formal, ratio=2.0):
    """(observed order p, relative grid convergence index of the finest mesh) of a value on three nested meshes,
    coarse to fine, each `ratio` times as fine as the one before: p = ln((f3 - f2)/(f2 - f1))/ln r,
    GCI = F |(f2 - f1)/f1|/(r^p - 1), with f1 on the finest mesh and F = 1.25. An observed order more than a tenth
    above the formal one is not trusted: the formal order is taken instead, and F = 3. (P. J. Roache, J. Fluids Eng.
    116, 405-413, 1994, and 133, 115501, 2011.) (nan, nan) where the values do not converge monotonically."""
    coarse, middle, fine = values[-3:]
    quotient = (middle - coarse) / (fine - middle)
    if not quotient > 1:
        return float("nan"), float("nan")
    order = np.log(quotient) / np.log(ratio)
    taken, safety = (formal, CAUTIOUS) if order > 1.1 * formal else (order, SAFETY)
    return float(order), float(safety * abs((middle - fine) / fine) / (ratio ** taken - 1))


class ComparedCase(unittest.TestCase):
    """A test whose comparisons are asserted, told and recorded."""

    def __init_subclass__(cls, **options):
        super().__init_subclass__(**options)
        hidden = COMPARISONS & vars(cls).keys()
        if hidden:
            raise TypeError(f"{cls.__name__} hides {', '.join(sorted(hidden))} of ComparedCase")

    def run(self, result=None):
        result = result if result is not None else self.defaultTestResult()
        before = len(result.failures) + len(result.errors), len(result.skipped)
        super().run(result)
        after = len(result.failures) + len(result.errors), len(result.skipped)
        outcome = "failed" if after[0] > before[0] else "skipped" if after[1] > before[1] else "passed"
        global _spent
        total = sum(os.times()[:4])
        self._record(outcome=outcome, cpu=round(total - _spent, 2))
        _spent = total
        return result

    def compare(self, what, error, allowed):
        """The error is at most what is allowed; both in one unit, or relative."""
        error, allowed = float(error), float(allowed)
        self._tell(f"{what}: {error:.2e} (allowed {allowed:.2g})")
        self._record(what=what, error=error, allowed=allowed)
        self.assertLessEqual(error, allowed, what)

    def compare_values(self, what, value, exact, tolerance, scale=None):
        """Largest |value - exact| within tolerance * |scale|, by default of the exact value itself."""
        size = np.abs(exact if scale is None else scale)
        self.compare(what, np.max(np.abs(np.asarray(value) - exact) / size), tolerance)

    def compare_range(self, what, value, low, high, expected=None):
        """low <= value <= high. The error is the distance from what is expected, by default the middle; what is
        allowed is the distance of the end on this side, of the farther end where both are on it."""
        expected = 0.5 * (low + high) if expected is None else expected
        end = high if value > expected else low
        self._tell(f"{what}: {value:.5g} (allowed {low:.5g} to {high:.5g})")
        self._record(what=what, error=float(abs(value - expected)), allowed=float(abs(end - expected)))
        self.assertGreaterEqual(value, low, what)
        self.assertLessEqual(value, high, what)

    def compare_orders(self, what, errors, least, most=np.inf, ratio=2.0, all_orders=False):
        """Observed order of errors, each on a mesh or step `ratio` times as fine as the one before: that of the last
        two, or all, lies between `least` and `most`. Returns the orders."""
        errors = np.asarray(errors, dtype=float)
        orders = np.log(errors[:-1] / errors[1:]) / np.log(ratio)
        self._tell(f"{what}: errors {' '.join(f'{e:.2e}' for e in errors)}, orders {np.round(orders, 2)}")
        self._record(what=what, errors=errors.tolist(), orders=orders.tolist(), least=float(least),
                     most=None if np.isinf(most) else float(most))
        for order in orders if all_orders else orders[-1:]:
            self.assertGreaterEqual(order, least, what)
            self.assertLessEqual(order, most, what)
        return orders

    def compare_meshes(self, what, values, exact, formal, ratio=2.0):
        """A value on three nested meshes, coarse to fine, with the formal order of the method: the grid convergence
        index covers the error of the finest."""
        order, index = grid_convergence(values, formal, ratio)
        error = float(abs(exact / values[-1] - 1))
        self._tell(f"{what}: {' '.join(f'{value:.8g}' for value in values)}, order {order:.2f}, GCI {index:.1e}, "
                   f"error {error:.1e}")
        self._record(what=what, values=[float(value) for value in values], order=order, gci=index, true_error=error)
        self.assertLessEqual(error, index, what)

    def _tell(self, line):
        if os.environ.get("MUDLINE_SHOW_ERRORS"):
            print(f"{self._testMethodName}: {line}", flush=True)

    def _record(self, **entries):
        folder = os.environ.get("MUDLINE_RECORD")
        if not folder:
            return
        path = record_file(folder, test_file(type(self)), f"{type(self).__name__}.{self._testMethodName}")
        os.makedirs(folder, exist_ok=True)
        with open(path, "a" if path in _started else "w", encoding="utf-8") as file:
            if path not in _started:
                _started.add(path)
                file.write(json.dumps({"date": time.strftime("%Y-%m-%d"), "processor": processor()}) + "\n")
            file.write(json.dumps(entries) + "\n")


def processor():
    """What the processor calls itself."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            names = re.findall(r"^model name\s*: (.*)$", file.read(), flags=re.M)
    except OSError:
        names = []
    return names[0] if names else platform.machine()
