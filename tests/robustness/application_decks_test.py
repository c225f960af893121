"""The decks of the applications, each shortened to some tens of steps over all of its stages: the same history on one and two ranks,
and a run that is killed or stopped at a random moment and continued ends with the same file as one that was left alone."""
import os
import random
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np
import cpu_limit
from mudline_case import PROGRAM, ROOT, History, MudlineCase, program

SHORT = {
    "cpt/clay": {"push/duration": 0.2},
    "cpt/guide_tube": {"push/duration": 0.05, "push/time step/growth": 1.0},
    "cpt/tresca": {"push/duration": 0.04, "push/time step/growth": 1.0},
    # growing steps meet the edge of convergence here, where rounding decides
    "free_fall_penetrometer/tresca": {"impact/duration": 4.8e-4, "impact/time step/growth": 1.0},
    "pile/clay": {"push/duration": 0.01, "set-up/duration": 3.0, "load test/duration": 0.02, "pull-out/duration": 0.02},
    "pile/sand": {"push/duration": 0.004, "rest/duration": 0.004, "load test/duration": 0.02, "pull-out/duration": 0.02},
    "t_bar/smooth": {"push/duration": 8.0},
    "torpedo/clay": {"penetration/duration": 4e-3, "set-up/duration": 50.0, "pull-out/duration": 0.5},
    "torpedo/tresca": {"penetration/duration": 0.02},
}
# decks that stop Newton's method at 1e-5 give ranks that agree to that
TIGHT = {deck: ["solver/residual tolerance=1e-9"] for deck in ("cpt/guide_tube", "pile/sand")}
TIGHT["cpt/tresca"] = ["solver/residual tolerance=1e-7"]  # at 1e-9 rounding decides on the last iteration
TIGHT["free_fall_penetrometer/tresca"] = ["solver/residual tolerance=1e-8"]
# fields often, so that many of the random moments are within their writing
OUTPUT = ["output/checkpoint steps=4", "output/field steps=2"]
RANKS = 1e-6  # of the largest value of a column
# [m3] rounding of the difference of two contents, 1e-13 of them: 1.4e6, 860, at most some 100 m3
WATER = {"torpedo/clay": 1e-7, "pile/sand": 1e-10}
SOME_WATER = 1e-11


class ApplicationDecks(MudlineCase):
    def arguments(self, deck, name):
        settings = [f"stages/{key}={value}" for key, value in SHORT[deck].items()] + TIGHT.get(deck, []) + OUTPUT + [f"output/name={name}"]
        result = ["run", "-q", os.path.join(ROOT, "inputs", deck + ".xml")]
        for setting in settings:
            result += ["--set", setting]
        return result

    def file(self, name):
        return os.path.join(self.folder, "results", name + ".csv")

    def lines(self, name):
        if not os.path.exists(self.file(name)):
            return 0
        with open(self.file(name)) as file:
            return len(file.readlines())

    def content(self, name):
        with open(self.file(name), "rb") as file:
            return file.read()

    def fields(self, name):
        """What ParaView is told of the run's steps, and their displacements."""
        stem = self.file(name)[:-len(".csv")]
        with open(stem + ".xdmf") as file:
            text = file.read().replace(name + ".fields", "fields")
        with h5py.File(stem + ".h5", "r") as file:
            return text, [step["nodal/displacement"][:] for step in file["steps"].values()]

    def whole(self, deck, name, ranks=1):
        done = program(self.arguments(deck, name), ranks, self.folder)
        self.assertEqual(done.returncode, 0, done.stderr[-2000:])
        return History(self.file(name))

    def check(self, deck):
        one = self.whole(deck, "whole")
        self.assertGreater(len(one.time), 16)  # else there is no moment to interrupt it
        with self.subTest("ranks"):
            self.compare_runs(one, self.whole(deck, "two", 2), WATER.get(deck, SOME_WATER))
        for number, code in ((signal.SIGKILL, -signal.SIGKILL), (signal.SIGTERM, 4)):
            moment = random.randint(7, len(one.time) - 6)
            with self.subTest(signal=number, steps=len(one.time), moment=moment):
                self.interrupt(deck, number, code, moment)

    def compare_runs(self, one, two, water):
        self.assertEqual(one.header, two.header)
        self.assertEqual(one.data.shape, two.data.shape)
        for i, column in enumerate(one.header):
            if "/error" in column or "iterations" in column or "/change of" in column:  # rounding itself, and a count
                continue
            # a reaction that is rounding (on an axis, along it) is measured by the others
            alike = [np.abs(one.data[:, k]).max() for k, other in enumerate(one.header) if other.split("[")[-1] == column.split("[")[-1]]
            scale = max(np.abs(one.data[:, i]).max(), 1e-6 * max(alike))
            allowed = max(RANKS * scale, water if column == "balance/water/change [m3]" else 0)
            self.assertLessEqual(np.abs(one.data[:, i] - two.data[:, i]).max(), allowed, column)

    def interrupt(self, deck, number, code, moment):
        if self.lines("parts"):
            os.remove(self.file("parts"))
        running = subprocess.Popen([PROGRAM] + self.arguments(deck, "parts"), cwd=self.folder, stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 250
        while self.lines("parts") < moment and running.poll() is None and time.monotonic() < deadline:
            time.sleep(0.01)
        running.send_signal(number)
        _, errors = cpu_limit.communicate(running, 100)
        self.assertEqual(running.returncode, code, errors)
        left = self.lines("parts")
        done = program(self.arguments(deck, "parts") + ["--restart"], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr[-2000:])
        self.assertLess(left, self.lines("parts"))
        self.assertEqual(self.content("parts"), self.content("whole"))
        (parts, moved), (whole, expected) = self.fields("parts"), self.fields("whole")
        self.assertEqual(parts, whole)
        np.testing.assert_array_equal(moved, expected)


for DECK in SHORT:
    setattr(ApplicationDecks, "test_" + DECK.replace("/", "_"), lambda self, deck=DECK: self.check(deck))

if __name__ == "__main__":
    unittest.main()
