"""Runs the program in tests: python's unittest on decks, on any number of ranks, and reads what it wrote.

The program comes from the environment variable MUDLINE, mpiexec from MUDLINE_MPIEXEC (ctest sets both).
"""
import csv
import os
import re
import shlex
import subprocess
import tempfile
import unittest

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PROGRAM = os.environ.get("MUDLINE", os.path.join(ROOT, "build", "release", "apps", "mudline", "mudline"))
MPIEXEC = shlex.split(os.environ.get("MUDLINE_MPIEXEC", "mpiexec --allow-run-as-root --oversubscribe --bind-to none"))


def program(arguments, ranks=1, folder=None, timeout=300):
    """Runs `mudline arguments`; returns the completed process (returncode, stdout, stderr)."""
    command = [PROGRAM] + [str(a) for a in arguments]
    if ranks > 1:
        command = MPIEXEC + ["-n", str(ranks)] + command
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=timeout)


class History:
    """The CSV of a run: columns by name without unit, as arrays."""

    def __init__(self, path):
        with open(path, newline="") as file:
            rows = list(csv.reader(file))
        self.header = rows[0]
        data = np.array(rows[1:], dtype=float)
        self.columns = {re.sub(r" \[[^\]]*\]$", "", name): data[:, i] for i, name in enumerate(rows[0])}
        self.data = data
        self.time = self.columns["time"]

    def __getitem__(self, name):
        return self.columns[name]

    def at(self, name, time):
        """Linear interpolation in time."""
        return np.interp(time, self.time, self.columns[name])


class MudlineCase(unittest.TestCase):
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
    def run_once(cls, decks, settings=(), timeout=380):
        """Sets history, and steps and rejected as the program counts them."""
        arguments = ["run"] + list(decks) + [word for setting in settings for word in ("--set", setting)]
        done = program(arguments, folder=cls.shared.folder, timeout=timeout)
        assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
        cls.steps, cls.rejected = map(int, re.search(r"done: (\d+) steps, (\d+) rejected", done.stdout).groups())
        stem = os.path.splitext(os.path.basename(decks[0]))[0]
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
