"""Runs the program in tests: python's unittest on decks, on any number of ranks, and reads what it wrote.

The program comes from the environment variable MUDLINE, mpiexec from MUDLINE_MPIEXEC (ctest sets both).
"""
import csv
import os
import re
import shlex
import tempfile

import numpy as np

import cpu_limit
from compared_case import ROOT, ComparedCase

PROGRAM = os.environ.get("MUDLINE", os.path.join(ROOT, "build", "release", "apps", "mudline", "mudline"))
MPIEXEC = shlex.split(os.environ.get("MUDLINE_MPIEXEC", "mpiexec --allow-run-as-root --oversubscribe --bind-to none"))


def program(arguments, ranks=1, folder=None, timeout=300):
    """Runs `mudline arguments`; returns the completed process (returncode, stdout, stderr). timeout: CPU seconds per rank."""
    command = [PROGRAM] + [str(a) for a in arguments]
    if ranks > 1:
        command = MPIEXEC + ["-n", str(ranks)] + command
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    return cpu_limit.run(command, timeout * ranks, cwd=folder, env=environment)


# Columns that are a difference of two sums over the mesh, before and after something
CHANGE = re.compile(r"/(change|outflow|impulse)\b")


def unit_of(column):
    """The unit in the head of a column; "" where it has none."""
    found = re.search(r"\[([^\]]*)\]$", column)
    return found.group(1) if found else ""


class History:
    """The CSV of a run: columns by name without unit, as arrays."""

    def __init__(self, path):
        with open(path, newline="") as file:
            rows = list(csv.reader(file))
        self.header = rows[0]
        data = np.array(rows[1:], dtype=float)
        names = [re.sub(r" \[[^\]]*\]$", "", name) for name in rows[0]]
        self.columns = {name: data[:, i] for i, name in enumerate(names)}
        self.units = {name: unit_of(column) for name, column in zip(names, rows[0])}
        self.data = data
        self.time = self.columns["time"]

    def __getitem__(self, name):
        return self.columns[name]

    def size(self, name):
        """What the rounding of a column is measured by: its largest value. A change is a difference of sums that are larger
        than itself: the largest value with its unit."""
        alike = [other for other in self.columns if self.units[other] == self.units[name]] if CHANGE.search(name) else [name]
        return max(np.abs(self.columns[other]).max() for other in alike)

    def at(self, name, time):
        """Linear interpolation in time."""
        return np.interp(time, self.time, self.columns[name])

    def common_times(self, other):
        """Times that both histories have a row for, to rounding."""
        nearest = other.time[np.abs(other.time[:, None] - self.time).argmin(axis=0)]
        return self.time[np.abs(nearest - self.time) <= 1e-9 * self.time[-1]]


class MudlineCase(ComparedCase):
    """A test with a scratch folder of its own."""

    def setUp(self):
        self._scratch = tempfile.TemporaryDirectory()
        self.folder = self._scratch.name

    def tearDown(self):
        self._scratch.cleanup()

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w") as file:
            file.write(text)
        return path

    def run_deck(self, decks, settings=(), ranks=1, extra=(), timeout=300, name=None):
        """Runs deck(s), fails the test unless the exit code is 0, and returns the History."""
        decks = [decks] if isinstance(decks, str) else list(decks)
        arguments = ["run", "-q"] + decks + list(extra)
        for setting in settings:
            arguments += ["--set", setting]
        done = program(arguments, ranks, self.folder, timeout)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])
        stem = name or os.path.splitext(os.path.basename(decks[0]))[0]
        return History(os.path.join(self.folder, "results", stem + ".csv"))

    def results(self, name):
        """Values of a run's results by stage, what they are of, and quantity."""
        with open(os.path.join(self.folder, "results", name + ".results.csv"), newline="", encoding="utf-8") as file:
            return {(row["stage"], row["of"], row["quantity"]): float(row["value"]) for row in csv.DictReader(file)}

    def assert_same_run(self, one, other, names, what, rounding=1e-8, steps=2e-2):
        """Two runs of one deck that differ by rounding only, as on other numbers of ranks: the named columns are equal to
        `rounding` of their size. Rounding may also decide the size of a step, say by a Newton iteration more;
        then they are equal at the common times, the stages' ends among them, to the error of the steps, `steps`."""
        same_steps = one.time.shape == other.time.shape and np.allclose(one.time, other.time, rtol=1e-9, atol=0)
        times = one.common_times(other)
        self.assertEqual(times[-1:].tolist(), one.time[-1:].tolist(), f"{what}: the runs do not end at the same time")
        for name in names:
            values = (one[name], other[name]) if same_steps else (one.at(name, times), other.at(name, times))
            size = one.size(name)  # 0: both are exactly 0
            self.compare(f"{what}: {name}", np.abs(values[0] - values[1]).max() / (size or 1),
                         (rounding if same_steps else steps) if size > 0 else 0)

    def run_point(self, decks, settings=(), timeout=300, name=None):
        """Runs `mudline point`, fails the test unless the exit code is 0; returns {test: History} in the deck's order."""
        decks = [decks] if isinstance(decks, str) else list(decks)
        arguments = ["point"] + decks
        for setting in settings:
            arguments += ["--set", setting]
        done = program(arguments, 1, self.folder, timeout)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])
        files = re.findall(r"(\S+\.csv)\)$", done.stdout, flags=re.M)
        stem = name or os.path.splitext(os.path.basename(decks[0]))[0]
        return {os.path.basename(file)[len(stem) + 1:-4]: History(os.path.join(self.folder, file)) for file in files}


class SharedRun(MudlineCase):
    """Tests of one run: a subclass's setUpClass calls this one's, then run_once. shared: a case with the run's folder."""

    @classmethod
    def setUpClass(cls):
        cls.shared = MudlineCase()
        cls.shared.setUp()

    @classmethod
    def tearDownClass(cls):
        cls.shared.tearDown()

    @classmethod
    def run_once(cls, decks, settings=(), timeout=380, name=None):
        """Sets history, and steps and rejected as the program counts them."""
        arguments = ["run"] + list(decks) + [word for setting in settings for word in ("--set", setting)]
        done = program(arguments, folder=cls.shared.folder, timeout=timeout)
        assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
        cls.steps, cls.rejected = map(int, re.search(r"done: (\d+) steps, (\d+) rejected", done.stdout).groups())
        stem = name or os.path.splitext(os.path.basename(decks[0]))[0]
        cls.history = History(os.path.join(cls.shared.folder, "results", stem + ".csv"))


def point_deck(skeleton, tests, void_ratio=1.0, extra=""):
    """A deck for `mudline point`: `skeleton` and each of `tests` {name: {...}} as nested dictionaries of numbers and texts."""
    material = {"void ratio": void_ratio, "skeleton": skeleton}
    return ('<ParameterList name="point">\n' + extra + _section("materials", {"soil": material}) + _section("tests", tests) +
            "</ParameterList>\n")


def deck_text(name, entries):
    """A deck from nested dictionaries of numbers, texts, truth values and lists."""
    return _section(name, entries)


def _section(name, entries):
    text = f'<ParameterList name="{name}">\n'
    for key, value in entries.items():
        if isinstance(value, dict):
            text += _section(key, value)
        elif isinstance(value, (list, tuple)):
            kind = {str: "string", int: "int", float: "double"}[type(value[0])] if value else "double"
            text += f'<Parameter name="{key}" type="Array({kind})" value="{{{", ".join(str(v) for v in value)}}}"/>\n'
        else:
            kind = {str: "string", int: "int", float: "double", bool: "bool"}[type(value)]
            value = str(value).lower() if kind == "bool" else value
            text += f'<Parameter name="{key}" type="{kind}" value="{value}"/>\n'
    return text + "</ParameterList>\n"
