"""Signals in a remeshing, and the loss of the process that meshes."""
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

import h5py
import numpy as np
from meshing_child import caught, children
from mudline_case import PROGRAM, ROOT, History, deck_text, program
from restart_test import RestartCase, settings

sys.path.insert(0, os.path.join(ROOT, "tests", "verification", "ale"))
from remeshed_ball import FOCUS, WALL, ball, remeshing  # noqa: E402


class Remeshing(RestartCase):
    """Signals while Gmsh makes a new mesh, in a process of its own, change no answer."""

    def setUp(self):
        super().setUp()
        plane = [self.write("ball.xml", ball()), self.write("over.xml", remeshing(4, WALL, FOCUS)), *settings("stages/push/duration=2.5e-3")]
        space = [os.path.join(ROOT, "inputs", "space", "ball.xml"), self.write("space.xml", deck_text("space", {"mesh motion": {
            "remeshing": {"when quality below": 0.0, "when side above": 0.1, "least steps": 2, "wall size": 0.25}}})),
            *settings("mesh/cells={5, 3, 3}", "mesh/distortion=0.3", "stages/push/duration=0.2")]
        self.decks = {"plane": plane, "space": space}

    def whole(self, name):
        arguments = [*self.decks[name], *settings("output/name=whole", "output/checkpoint steps=0")]
        self.runs(*arguments)
        self.assertGreaterEqual(History(self.result("whole", ".csv"))["mesh/remeshings"][-1], 2)
        return self.content("whole")

    def test_the_time_of_all_meshes_is_told(self):
        """Three of the eleven steps are on the last mesh: a tenth of the run, and all of them a third."""
        done = program(["run", *self.decks["plane"]], 1, self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        whole = float(re.search(r"done: .* rejected, ([0-9.]+) s;", done.stdout).group(1))
        names = ("residuals", "Jacobians", "linear solves", "mesh motion")
        times = re.search("time: " + ", ".join(name + r" ([0-9.]+) s" for name in names), done.stdout)
        *solves, motion = map(float, times.groups())
        self.assertGreater(sum(solves), 0.2 * whole)
        self.assertGreater(motion, 0.05 * whole)
        self.assertLessEqual(sum(solves) + motion, whole + 0.05)

    def test_a_run_starts_from_a_remeshed_state(self):
        """The mesh of that state is the first one of its files, which are whole."""
        on = self.write("on.xml", deck_text("on", {"stages": {"on": {"type": "dynamic", "duration": 5e-4, "time step": {"initial": 1e-4}}}}))
        decks = [self.decks["plane"][0], self.decks["plane"][1], on, *self.decks["plane"][2:]]
        self.runs(*decks, *settings("output/name=first"))
        self.runs(*decks, *settings("output/name=second", "start/from=results/first@push"))
        for name in ("first", "second"):
            with h5py.File(self.result(name, ".h5"), "r") as file:
                last = file["steps"][sorted(file["steps"])[-1]]
                self.assertEqual(file["mesh/coordinates"].shape == last["coordinates"].shape, name == "second")
        first, second = (History(self.result(name, ".csv")) for name in ("first", "second"))
        self.assertGreater(first["mesh/remeshings"][-1], 1)
        np.testing.assert_array_equal(first.data[-1], second.data[-1])

    def begin(self, name, result):
        self.arguments = [*self.decks[name], *settings("output/name=" + result, "output/checkpoint steps=0")]
        running = subprocess.Popen([PROGRAM, "run", "-q", *self.arguments], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True, start_new_session=True)
        while not os.path.exists(self.result(result, ".csv")) and running.poll() is None:
            time.sleep(0.001)
        self.of_mpi = children(running.pid)  # before the first remeshing
        return running

    def caught(self, running):
        """The process of a remeshing, which stands still; None where the run has ended."""
        return caught(running, self.of_mpi)

    def check_interrupted(self, name, numbers):
        whole = self.whole(name)
        for number in numbers:
            with self.subTest(deck=name, signal=number.name):
                running = self.begin(name, number.name)
                child = self.caught(running)
                self.assertIsNotNone(child, "no remeshing was seen")
                for process in (running.pid, child):  # as a batch system may do
                    os.kill(process, number)
                os.kill(child, signal.SIGCONT)
                out, errors = running.communicate(timeout=300)
                self.assertEqual(running.returncode, 4, out + errors)
                self.assertEqual(len(errors.splitlines()), 1, errors)
                self.assertRegex(errors, r"^warning: stopped by a signal after step \d+; continue with --restart")
                self.runs(*self.arguments, "--restart")
                self.assertEqual(self.content(number.name), whole)

    def test_signals_in_the_plane(self):
        self.check_interrupted("plane", (signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGUSR1))

    def test_signals_in_space(self):
        self.check_interrupted("space", (signal.SIGTERM, signal.SIGUSR1))

    def test_an_end_of_the_stage_after_a_remeshing(self):
        """The model on the new mesh knows the columns, and their units."""
        self.whole("plane")
        whole = History(self.result("whole", ".csv"))
        remeshed = int(np.argmax(whole["mesh/remeshings"] >= 2))
        self.assertLess(remeshed, len(whole.time) - 1)
        way = whole["body/ball/displacement y"][remeshed]
        over = self.write("end.xml", deck_text("end", {"stages": {"push": {"ends when": {"deep": {
            "type": "history", "column": "body/ball/displacement y", "falls to": 0.0}}}}}))
        done = program(["run", *self.decks["plane"], over, *settings(
            "output/name=ended", f"stages/push/ends when/deep/falls to={1000 * way:.17g} mm")], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"stage 'push' ends at t \S+ s, 'deep': body/ball/displacement y -\S+ m\n")
        ended = History(self.result("ended", ".csv"))
        self.assertEqual(ended["mesh/remeshings"][-1], 2)
        self.assertLessEqual(ended["body/ball/displacement y"][-1], way * (1 - 1e-12))
        self.assertTrue(np.array_equal(ended.data, whole.data[:len(ended.data)]))
        self.assertIn(len(ended.data), (remeshed + 1, remeshed + 2))  # the way is read from text

    def test_a_process_that_is_killed(self):
        """Once: it is tried again. As often as it begins: the run ends, and a restart is as if nothing had been."""
        for name in self.decks:
            with self.subTest(deck=name):
                whole = self.whole(name)
                running = self.begin(name, "once")
                os.kill(self.caught(running), signal.SIGKILL)
                out, errors = running.communicate(timeout=300)
                self.assertEqual((running.returncode, errors), (0, ""), out)
                self.assertEqual(self.content("once"), whole)
                running = self.begin(name, "often")
                while (child := self.caught(running)) is not None:
                    os.kill(child, signal.SIGKILL)
                out, errors = running.communicate(timeout=300)
                self.assertEqual(running.returncode, 1, out + errors)
                self.assertRegex(errors, r"^error: remeshing after step \d+: Gmsh was killed \(signal 9\); the run ends here with its state "
                                 r"saved, and --restart tries again\n$")
                self.runs(*self.arguments, "--restart")
                self.assertEqual(self.content("often"), whole)
                shutil.rmtree(os.path.join(self.folder, "results"))


if __name__ == "__main__":
    unittest.main()
