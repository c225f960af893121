"""What a restart accepts and refuses; restarts on another number of ranks; results of other runs in the folder; signals."""
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import time
import unittest

import h5py
import numpy as np
from mudline_case import MPIEXEC, PROGRAM, ROOT, History, MudlineCase, deck_text, program

sys.path.insert(0, os.path.join(ROOT, "tests", "verification", "contact"))
from sliding_blocks import SLIDE  # noqa: E402

BALL = os.path.join(ROOT, "tests", "mpi", "ball_in_clay.xml")
BLOCKS = os.path.join(ROOT, "inputs", "contact", "blocks.xml")
NODES = os.path.join(ROOT, "inputs", "contact", "node_to_segment.xml")
ANCHOR = os.path.join(ROOT, "inputs", "impact", "fall_and_pull_out.xml")
SMALL = "mesh/cells={4, 4}"
ROUNDING = 1e-8  # of the largest value of a column
FNV_PRIME, MASK = 1099511628211, 2**64 - 1


def sealed(content):
    """The bytes of a checkpoint with the checksum that belongs to them."""
    value = 14695981039346656037
    for byte in content[512:]:
        value = (value ^ byte) * FNV_PRIME & MASK
    title = content[:content.index(b"byte 512: ") + 10]
    return (title + b"%016x\n" % value).ljust(512, b"\0") + content[512:]


class RestartCase(MudlineCase):
    def result(self, name, ending):
        return os.path.join(self.folder, "results", name + ending)

    def mudline(self, *arguments, ranks=1):
        return program(["run", "-q", *arguments], ranks, self.folder)

    def runs(self, *arguments, ranks=1):
        done = self.mudline(*arguments, ranks=ranks)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def refused(self, expected, *arguments, ranks=1):
        """Exit code 2 and one line that matches."""
        done = self.mudline(*arguments, ranks=ranks)
        self.assertEqual(done.returncode, 2, done.stderr)
        errors = [line for line in done.stderr.splitlines() if line.startswith("error:")]
        self.assertEqual(len(errors), 1, done.stderr)
        if ranks == 1:  # mpiexec adds a frame of its own
            self.assertEqual([line for line in done.stderr.splitlines() if not line.startswith("warning:")], errors)
        self.assertIn(expected, errors[0])

    def content(self, name, ending=".csv"):
        with open(self.result(name, ending), "rb") as file:
            return file.read()

    def put(self, name, ending, content):
        with open(self.result(name, ending), "wb") as file:
            file.write(content)


def settings(*pairs):
    return [word for pair in pairs for word in ("--set", pair)]


class Model(RestartCase):
    """The checkpoint keeps the model that it belongs to."""

    def setUp(self):
        super().setUp()
        with open(BALL) as file:
            self.text = file.read()
        self.deck = self.write("ball.xml", self.text)
        self.runs(self.deck, "--steps", "3", *settings(SMALL))
        self.restart = [self.deck, "--restart", *settings(SMALL)]

    def test_every_path_that_differs_is_named(self):
        other = settings("materials/clay/skeleton/compression slope=0.21", "boundary conditions/surcharge/value=21e3")
        expected = ("results/ball.restart: the checkpoint is that of another model: materials/clay/skeleton/compression slope: "
                    "0.21, was 0.2; boundary conditions/surcharge/value: 21000, was 20000 (--accept-changes goes on all the same)")
        before = self.content("ball"), self.content("ball", ".restart")
        for ranks in (1, 2):
            self.refused(expected, *self.restart, *other, ranks=ranks)
        self.assertEqual((self.content("ball"), self.content("ball", ".restart")), before)
        done = self.runs(*self.restart, *other, "--accept-changes")
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertIn("warning: going on from the checkpoint of another model: materials/clay/", done.stderr)

    def test_mesh(self):
        for setting, expected in (("mesh/upper={0.3, 0.31}", "mesh/upper: {0.3, 0.31}, was {0.3, 0.3}"),
                                  ("mesh/grading={2, 0.5}", "mesh/grading: {2, 0.5}, was {3, 0.5}"),
                                  ("mesh/cells={4, 5}", "mesh/cells: {4, 5}, was {4, 4}"),
                                  ("bodies/ball/motion/velocity y=-2", "bodies/ball/motion/velocity y: -2, was -1"),
                                  ("contacts/ball on clay/quadrature degree=9", "contacts/ball on clay/quadrature degree: 9")):
            self.refused(expected, *self.restart, *settings(setting))
        self.refused("a mesh of 81 nodes and 16 elements, but this mesh has 99 nodes and 20", *self.restart, "--accept-changes",
                     *settings("mesh/cells={4, 5}"))
        self.refused("does not fit this deck: its array 'array/contact/ball on clay/points'", *self.restart, "--accept-changes",
                     *settings("contacts/ball on clay/quadrature degree=9"))

    def test_an_accepted_penalty_acts(self):
        """A tenth of the penalty lets the body into the surface by far more. The automatic one is a factor on the
        stiffness of the start."""
        with open(self.result("ball", ".restart"), "rb") as file:
            before = file.read()
        into = {}
        for entry in ("penalty factor=10", "penalty factor=100", "penalty=1e8", "penalty=1e9"):
            with open(self.result("ball", ".restart"), "wb") as file:
                file.write(before)
            self.runs(*self.restart, "--accept-changes", "--steps", "3", *settings("contacts/ball on clay/" + entry))
            into[entry] = History(self.result("ball", ".csv"))["contact/ball on clay/maximum penetration"][-1]
        self.assertGreater(into["penalty factor=10"], 5 * into["penalty factor=100"])
        self.assertGreater(into["penalty=1e8"], 5 * into["penalty=1e9"])

    def test_stages_solver_and_output_may_change(self):
        done = self.runs(*self.restart, *settings("stages/push/duration=0.002", "stages/push/time step/growth=1.0",
                                                  "solver/residual tolerance=1e-9", "output/field steps=3"))
        self.assertEqual(done.stderr, "")
        self.assertAlmostEqual(History(self.result("ball", ".csv")).time[-1], 0.002)

    def edited(self, *replacements):
        text = self.text
        for old, new in replacements:
            self.assertIn(old, text)
            text = text.replace(old, new)
        self.write("ball.xml", text)

    def test_a_stage_before_the_present_one(self):
        new = ('<ParameterList name="wait"><Parameter name="type" type="string" value="quasi-static"/><Parameter name="duration" '
               'type="double" value="1e-3"/><ParameterList name="time step"><Parameter name="initial" type="double" value="1e-3"/>'
               "</ParameterList></ParameterList>")
        push = '<ParameterList name="push">'
        self.edited((push, new + push))
        self.refused("the run began with the stages geostatic, push, but stage 2 cannot be 'push' any more: the deck has 'wait' there",
                     *self.restart)
        self.edited(('<ParameterList name="geostatic">', '<ParameterList name="balance">'))
        self.refused("stage 1 cannot be 'geostatic' any more: the deck has 'balance' there", *self.restart)
        # after the present one it may stand
        end = "  </ParameterList>\n  <!-- tight"
        self.edited((end, new + end))
        self.runs(*self.restart)
        self.assertAlmostEqual(History(self.result("ball", ".csv")).time[-1], 0.006)

    def test_a_duration_that_is_past(self):
        self.refused("stages/push/duration: 5e-04 s, but the checkpoint stands 0.00075 s into that stage", *self.restart[:2],
                     *settings(SMALL, "stages/push/duration=5e-4", "stages/push/time step/initial=1e-4"))
        self.edited(('"type" type="string" value="dynamic"', '"type" type="string" value="quasi-static"'),
                    ('value="generalised alpha"/>\n        <Parameter name="spectral radius" type="double" value="0.5"/>', 'value="theta"/>'))
        self.refused("stages/push/type: quasi-static, was dynamic, but that stage has begun", *self.restart)

    def test_a_stage_that_is_over(self):
        done = self.runs(*self.restart, *settings("stages/geostatic/balance tolerance=1e-5"))
        self.assertEqual(done.stderr, "warning: changes in stages that are over have no effect: stages/geostatic/balance tolerance: "
                         "1e-05, was 1e-06\n")


class Ranks(RestartCase):
    """A restart on another number of ranks gives the run without a stop to 1e-8."""

    def check(self, decks, name, steps, pairs, ignored=()):
        common = [*decks, *settings("output/name=" + name)]
        self.runs(*common)
        whole = History(self.result(name, ".csv"))
        for before, after in pairs:
            self.runs(*common, "--steps", str(steps), ranks=before)
            self.assertLess(len(History(self.result(name, ".csv")).time), len(whole.time))
            self.runs(*common, "--restart", ranks=after)
            parts = History(self.result(name, ".csv"))
            self.assertEqual(parts.data.shape, whole.data.shape)
            for i, column in enumerate(whole.header):
                if "/error" in column or "iterations" in column or "change of" in column or any(word in column for word in ignored):
                    continue
                alike = [np.abs(whole.data[:, k]).max() for k, other in enumerate(whole.header)
                         if other.split("[")[-1] == column.split("[")[-1]]
                scale = max(np.abs(whole.data[:, i]).max(), 1e-6 * max(alike))
                self.assertLessEqual(np.abs(whole.data[:, i] - parts.data[:, i]).max(), ROUNDING * scale,
                                     f"{column}: {before} to {after} ranks")

    def test_friction_and_mesh_motion(self):
        over = self.write("over.xml", deck_text("over", {
            "contacts": {"ball on clay": {"friction": {"type": "coulomb", "coefficient": 0.2}}},
            "mesh motion": {"boundary": {"focus": "ball", "size near focus": 0.05, "near distance": 0.1, "growth": 0.2}}}))
        # clay that drains within the steps: where no water leaves, its change is rounding
        drains = "materials/clay/permeability/hydraulic conductivity=1e-3"
        self.check([BALL, over, *settings("contacts/ball on clay/type=penalty", drains)], "ball", 10, ((1, 2), (3, 1)))

    def test_two_surfaces(self):
        slide = self.write("slide.xml", SLIDE)
        # steps that friction can follow: where Newton's iterates go to and fro, rounding decides on the next step
        softer = "contacts/face/friction/tangential penalty factor=0.1"  # stiffer ones round to 1e-8 of the force
        for laws, duration, step, more in (([], 0.35, 0.025, ()), ([NODES], 0.25, 0.005, (softer,))):
            calm = settings(f"stages/slide/duration={duration}", f"stages/slide/time step/initial={step}",
                            f"stages/slide/time step/maximum={step}", *more)
            # what multipliers leave of gap, penetration and stretch is rounding
            self.check([BLOCKS, *laws, slide, *calm], "blocks", 3, ((1, 3), (2, 1)), ("gap", "penetration", "stretch"))

    def test_free_body(self):
        self.check([ANCHOR, *settings("stages/pull-out/duration=10")], "anchor", 30, ((2, 1), (1, 2)))


class Files(RestartCase):
    """Damaged or missing files are never gone on with."""

    def setUp(self):
        super().setUp()
        self.start = [BALL, *settings(SMALL, "output/name=ball", "output/field steps=1")]
        self.runs(*self.start, "--steps", "4")
        self.rows = self.content("ball")

    def test_history(self):
        self.assertEqual(self.rows.count(b"\n"), 6)
        lines = self.rows.splitlines(keepends=True)
        way_out = "put a copy of it back, run without --restart, or go on with rows lost by --accept-changes"
        for content, found in ((None, "is missing"), (b"", "is empty"), (b"".join(lines[:4]), "was shortened"),
                               (b"".join(lines[:2] + lines[3:]), "was shortened"),
                               (self.rows.replace(b"e-06", b"e-05", 1), "was changed")):
            if content is None:
                os.remove(self.result("ball", ".csv"))
            else:
                self.assertNotEqual(content, self.rows)
                self.put("ball", ".csv", content)
            for ranks in (1, 2):
                self.refused(f"results/ball.csv: the file {found}, which should hold the 6 lines up to the checkpoint; {way_out}",
                             *self.start, "--restart", ranks=ranks)
        self.put("ball", ".csv", b"".join(lines[:4]))
        done = self.runs(*self.start, "--restart", "--accept-changes")
        self.assertIn("going on with 4 of the 6 lines", done.stderr)
        self.assertEqual(self.content("ball").count(b"\n"), 20)
        shutil.rmtree(os.path.join(self.folder, "results"))
        self.runs(*self.start, "--steps", "4")
        with open(self.result("ball", ".csv"), "ab") as file:
            file.write(b"0.5,1")  # of a step after the checkpoint, cut short
        self.runs(*self.start, "--restart")
        self.assertEqual(self.content("ball").count(b"\n"), 22)

    def test_fields(self):
        os.remove(self.result("ball", ".h5"))
        self.refused("results/ball.h5: the file is missing, which should lead to the 6 outputs up to the checkpoint", *self.start,
                     "--restart")
        self.runs(*self.start, "--restart", "--accept-changes")

    def test_a_bit_of_the_fields(self):
        for name in ("mesh", "000000", "000004"):
            ending = os.path.join(".fields", name + ".h5")
            good = self.content("ball", ending)
            for place in (20, len(good) // 3, len(good) - 40):
                self.put("ball", ending, good[:place] + bytes([good[place] ^ 4]) + good[place + 1:])
                self.refused(f"results/ball.fields/{name}.h5: the file was changed since the run wrote it; put a copy of it back, run "
                             "without --restart, or go on all the same by --accept-changes", *self.start, "--restart",
                             ranks=2 if place == 20 else 1)
            os.remove(self.result("ball", ending))
            self.refused(f"results/ball.fields/{name}.h5: the file is missing", *self.start, "--restart")
            self.put("ball", ending, good)
        # a number of the coordinates of a step, at which HDF5 has nothing to find fault with
        with h5py.File(self.result("ball", os.path.join(".fields", "000003.h5")), "r+") as file:
            file["coordinates"][0, 1] += 1e-6
        self.refused("000003.h5: the file was changed", *self.start, "--restart")
        done = self.runs(*self.start, "--restart", "--accept-changes")
        self.assertEqual(done.stderr, "warning: results/ball.fields/000003.h5: the file was changed since the run wrote it\n")

    def test_other_columns(self):
        probe = ["--set", "output/probes/side={0.3, 0.3}"]
        self.refused("other columns than this run", *self.start, *probe, "--restart")
        self.runs(*self.start, *probe, "--restart", "--accept-changes")
        self.assertEqual(self.content("ball.1"), self.rows)
        self.assertEqual(self.content("ball").count(b"\n"), 17)

    def test_checkpoint(self):
        good = self.content("ball", ".restart")
        self.assertEqual(sealed(good), good)
        for bad in (good[:-1], good[:3000], good[:100], b"", good[:5000] + bytes([good[5000] ^ 16]) + good[5001:]):
            self.put("ball", ".restart", bad)
            self.refused("results/ball.restart: ", *self.start, "--restart", ranks=1)
        self.refused("the checkpoint is damaged: its checksum does not fit its content", *self.start, "--restart", ranks=2)

    def test_impossible_values(self):
        for name, value, expected in (("stage", -1, "the value 'stage' = -1 is impossible"), ("stage", 7, "stands in stage 8"),
                                      ("stage open", 0.5, "'stage open' = 0.5 is impossible"),
                                      ("time", float("nan"), "'time' is not finite"), ("next dt", -1.0, "'next dt' = -1 is impossible")):
            with h5py.File(self.result("ball", ".restart"), "r+") as file:
                old = file["scalars"][name][0]
                file["scalars"][name][0] = value
            self.put("ball", ".restart", sealed(self.content("ball", ".restart")))
            self.refused(expected, *self.start, "--restart")
            with h5py.File(self.result("ball", ".restart"), "r+") as file:
                file["scalars"][name][0] = old

    def test_field_interval_far_below_the_step(self):
        for interval in ("1e-9", "1e-300"):
            self.runs(*self.start[:-2], *settings("output/name=often", f"output/field interval={interval}", "stages/push/duration=1e-3"))
            with h5py.File(self.result("often", ".h5"), "r") as file:
                self.assertEqual(len(file["steps"]), 6)  # start, geostatic, four steps


REST = """<ParameterList name="rest">
  <Parameter name="type" type="string" value="quasi-static"/>
  <Parameter name="duration" type="double" value="1e5"/>
  <Parameter name="conditions" type="Array(string)" value="{base, axis, far side, drained surface, surcharge}"/>
  <ParameterList name="motions"><ParameterList name="ball"><Parameter name="type" type="string" value="prescribed velocity"/>
    <Parameter name="velocity y" type="double" value="0.0"/></ParameterList></ParameterList>
  <ParameterList name="integrator"><Parameter name="type" type="string" value="theta"/></ParameterList>
  <ParameterList name="time step"><Parameter name="initial" type="double" value="20000"/></ParameterList>
</ParameterList>
</ParameterList>
<!-- tight"""


class Outputs(RestartCase):
    """What a run tells and writes at its ends, with and without a restart."""

    def test_set_up(self):
        with open(BALL) as file:
            text = file.read()
        self.assertIn("  </ParameterList>\n  <!-- tight", text)
        deck = self.write("ball.xml", text.replace("</ParameterList>\n  <!-- tight", REST))
        push = settings("mesh/cells={8, 8}", "mesh/grading={3, 0.3}", "stages/push/duration=0.03", "stages/push/time step/initial=1e-3", "solver/residual tolerance=1e-8")
        short = settings("mesh/cells={5, 5}", "stages/rest/duration=500", "stages/rest/time step/initial=125")
        for more, stream, expected in (
                ([], "stdout", r"  contact 'ball on clay': excess pore pressure on the wall \S+ -> \S+ kPa, \d+ % dissipated"),
                (short, "stderr", r"warning: contact 'ball on clay': excess pore pressure .* the mesh does not resolve its dissipation.*")):
            def told(*arguments):
                done = program(["run", deck, *push, *more, *arguments], folder=self.folder)
                self.assertEqual(done.returncode, 0, done.stderr)
                return [line for line in getattr(done, stream).splitlines() if "contact 'ball on clay': excess pore pressure" in line]

            whole = told()
            self.assertEqual(len(whole), 1)
            self.assertRegex(whole[0], "^" + expected + "$")
            self.assertEqual(told("--steps", "32"), [])
            self.assertEqual(told("--restart"), whole)

    def test_rows_are_few_and_the_last_is_there(self):
        deck = [BALL, *settings(SMALL, "output/name=ball")]
        self.runs(*deck)
        every = History(self.result("ball", ".csv"))
        for steps, count in ((7, 4), (1000000, 2)):  # the geostatic stage's, and of 21 steps the 7th, ..., the last
            self.runs(*deck, *settings(f"output/history steps={steps}"))
            few = History(self.result("ball", ".csv"))
            whole = self.content("ball")
            self.assertEqual((len(few.time), few.time[-1]), (count, every.time[-1]))
            row = [every.header.index(name) for name in few.header]
            rows = [np.where(every.time == time)[0][0] for time in few.time]
            np.testing.assert_array_equal(few.data, every.data[rows][:, row])
            # one that is stopped has its last row, too, and its continuation leaves what the whole run does
            self.runs(*deck, *settings(f"output/history steps={steps}"), "--steps", "9")
            self.assertEqual(History(self.result("ball", ".csv")).time[-1], every.time[9])
            self.runs(*deck, *settings(f"output/history steps={steps}"), "--restart")
            self.assertEqual(self.content("ball"), whole)

    def test_results_that_go_during_the_run(self):
        """Whatever of the results is not there at the end ends the run with an error."""
        moved = os.path.join(self.folder, "moved")
        csv, folder = self.result("ball", ".csv"), os.path.join(self.folder, "results")

        def copy_back():
            os.rename(csv, csv + ".old")
            shutil.copy(csv + ".old", csv)

        def replace_folder():
            os.rename(folder, moved)
            # the run removes its lock when it ends, which may be during the copy
            shutil.copytree(moved, folder, ignore=shutil.ignore_patterns("*.lock"))

        for what, lose, expected in (
                ("folder removed", lambda: shutil.rmtree(folder, ignore_errors=True), ""),
                ("folder moved", lambda: os.rename(folder, moved), ""),
                ("folder replaced", replace_folder, "ball.csv: the history was"),
                ("history removed", lambda: os.remove(csv), "ball.csv: the history was removed by another program"),
                ("history replaced", copy_back, "ball.csv: the history was re"),
                ("history emptied", lambda: open(csv, "w").close(), "ball.csv: the history was changed by another program"),
                ("step removed", lambda: os.remove(self.result("ball", ".fields/000001.h5")), "000001.h5: the file was removed"),
                ("mesh removed", lambda: os.remove(self.result("ball", ".fields/mesh.h5")), "mesh.h5: the file was removed")):
            for path in (folder, moved):
                shutil.rmtree(path, ignore_errors=True)
            running = subprocess.Popen([PROGRAM, "run", "-q", BALL, *settings(SMALL, "output/name=ball", "output/checkpoint steps=0",
                                                                                "stages/push/time step/initial=2.5e-5")],
                                       cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            deadline = time.monotonic() + 100
            while not (os.path.exists(csv) and self.content("ball").count(b"\n") > 3) and time.monotonic() < deadline:
                time.sleep(0.005)
            lose()
            out, errors = running.communicate(timeout=200)
            self.assertEqual(running.returncode, 1, what + out + errors)
            self.assertEqual(errors.count("\n"), 1, what + errors)
            self.assertTrue(errors.startswith("error: ") and expected in errors, what + errors)


class OldResults(RestartCase):
    """Results are not lost to another run."""

    def setUp(self):
        super().setUp()
        with open(BALL) as file:
            text = file.read()
        for folder in ("a", "b"):
            os.mkdir(os.path.join(self.folder, folder))
        self.deck = self.write("a/ball.xml", text)
        self.short = settings(SMALL, "stages/push/duration=5e-4")
        self.other = self.write("b/ball.xml", text.replace('value="1.2"', 'value="1.3"'))

    def test_another_deck_of_the_same_name(self):
        self.runs(self.deck, *self.short)
        before = self.content("ball"), self.content("ball", ".h5"), self.content("ball", ".restart")
        for ranks in (1, 2):
            self.refused(f"results/ball.*: there are results already, those of another deck, {os.path.realpath(self.deck)}; give another "
                         "output/name or output/folder, or replace them by --overwrite", self.other, *self.short, ranks=ranks)
        self.assertEqual((self.content("ball"), self.content("ball", ".h5"), self.content("ball", ".restart")), before)
        done = self.runs(self.other, *self.short, "--overwrite")
        self.assertIn("results are replaced: those of another deck", done.stderr)
        self.assertNotEqual(self.content("ball"), before[0])

    def test_the_same_deck(self):
        self.runs(self.deck, *self.short)
        first = self.content("ball")
        done = program(["run", self.deck, *self.short], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.count("replaces the results of an earlier run of this deck\n"), 1)
        self.assertEqual(self.content("ball"), first)
        done = program(["run", self.deck, *self.short, "--set", "stages/push/time step/initial=1e-4"], folder=self.folder)
        self.assertIn("an earlier run of this deck with other values: stages/push/time step/initial: 1e-04, was 0.00025\n", done.stdout)
        shutil.copy(self.deck, os.path.join(self.folder, "moved.xml"))  # moved, but the same
        self.runs("moved.xml", *self.short, *settings("stages/push/time step/initial=1e-4", "output/name=ball"))

    def test_results_of_unknown_origin(self):
        os.mkdir(os.path.join(self.folder, "results"))
        self.put("ball", ".csv", b"time [s]\n0\n")
        self.refused("there are results already, of unknown origin", self.deck, *self.short)
        self.assertEqual(self.content("ball"), b"time [s]\n0\n")

    def begin(self):
        running = subprocess.Popen([PROGRAM, "run", "-q", self.deck, *settings("stages/push/time step/initial=2e-6")], cwd=self.folder,
                                   stderr=subprocess.PIPE, text=True)
        for _ in range(6000):
            if os.path.exists(self.result("ball", ".csv")):
                return running
            time.sleep(0.01)
        self.fail("the run does not begin")

    def test_two_runs_at_once(self):
        running = self.begin()
        try:
            for arguments in ([], ["--restart"], ["--overwrite"]):
                self.refused(f"results/ball.lock: these results are being written by process {running.pid} on host {socket.gethostname()}; "
                             "wait for it, or give another output/name or output/folder", self.deck, *self.short, *arguments)
        finally:
            running.kill()
            running.communicate()
        self.assertTrue(os.path.exists(self.result("ball", ".lock")))
        self.runs(self.deck, *self.short)  # the lock of a dead process holds nobody
        self.assertFalse(os.path.exists(self.result("ball", ".lock")))

    def test_a_lock_of_another_host(self):
        os.mkdir(os.path.join(self.folder, "results"))
        self.put("ball", ".lock", b"elsewhere 17\n")
        self.refused("these results were begun by process 17 on host elsewhere, of which nothing is known here; once it has ended, "
                     "delete this file", self.deck, *self.short)
        os.remove(self.result("ball", ".lock"))
        self.runs(self.deck, *self.short)


class Stopping(RestartCase):
    """Signals, on one rank and through mpirun."""

    deck = [BALL, *settings("stages/push/time step/initial=1e-5", "output/checkpoint steps=0")]

    def steps(self):
        if not os.path.exists(self.result("ball_in_clay", ".csv")):
            return 0
        return self.content("ball_in_clay").count(b"\n")

    def until_steps(self, running, steps):
        deadline = time.monotonic() + 200
        while self.steps() < steps and running.poll() is None and time.monotonic() < deadline:
            time.sleep(0.01)
        self.assertIsNone(running.poll())

    def check_saved(self, running, code):
        out, errors = running.communicate(timeout=200)
        self.assertEqual(running.returncode, code, (out or "") + errors)
        self.assertRegex(errors, r"warning: stopped by a signal after step \d+; continue with --restart")
        done = self.steps()
        self.runs(*self.deck, "--restart", *settings("stages/push/duration=1e-3"))
        self.assertGreater(self.steps(), done)

    def start(self, command, **options):
        return subprocess.Popen(command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)

    def test_steps_that_fail_say_where(self):
        """The place is one of the mesh, and the same on one and two ranks."""
        places = []
        for ranks in (1, 2):
            deck = [ANCHOR, *settings(f"output/name=fails{ranks}")]
            self.runs(*deck, "--steps", "30", ranks=ranks)  # in the impact
            impatient = settings("solver/newton/maximum iterations=1", "solver/newton/damped retry=false",
                                 "stages/fall/time step/minimum=1e-3")
            done = self.mudline(*deck, "--restart", *impatient, ranks=ranks)
            self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
            found = re.search(r"error: .* no convergence in 1 iterations \(residual .* of its tolerance, most of it in "
                              r"'(displacement|pore pressure)' at \(([-.e0-9]+), ([-.e0-9]+)\)\); the step cannot be cut below", done.stderr)
            self.assertIsNotNone(found, done.stderr)
            places.append(found.groups())
        self.assertEqual(places[0], places[1])
        self.assertTrue(0 <= float(places[0][1]) <= 2 and -2 <= float(places[0][2]) <= 0.1, places)

    def test_sigusr1(self):
        running = self.start([PROGRAM, "run", "-q", *self.deck])
        self.until_steps(running, 4)
        running.send_signal(signal.SIGUSR1)
        running.send_signal(signal.SIGUSR1)  # a batch system may repeat it
        self.check_saved(running, 4)

    def test_sigusr1_through_mpirun(self):
        running = self.start([*MPIEXEC, "-n", "2", PROGRAM, "run", "-q", *self.deck])
        self.until_steps(running, 4)
        running.send_signal(signal.SIGUSR1)
        self.check_saved(running, 4)

    def wrapper(self):
        """The script ./mudline in a tree in which everything is built."""
        root = os.path.join(self.folder, "tree")
        os.makedirs(os.path.join(root, "build", "release", "apps", "mudline"))
        os.mkdir(os.path.join(root, "bin"))
        shutil.copy(os.path.join(ROOT, "mudline"), root)
        os.symlink(PROGRAM, os.path.join(root, "build", "release", "apps", "mudline", "mudline"))
        with open(os.path.join(root, "CMakePresets.json"), "w"):
            pass
        for name in ("build.ninja", ".configured"):
            with open(os.path.join(root, "build", "release", name), "w"):
                pass
        for name, script in (("ninja", "exit 0"), ("dpkg-query", 'shift 2; printf "%s:installed\\n" "$@"')):
            path = os.path.join(root, "bin", name)
            with open(path, "w") as file:
                file.write("#!/bin/sh\n" + script + "\n")
            os.chmod(path, 0o755)
        environment = dict(os.environ, PATH=os.path.join(root, "bin") + ":" + os.environ["PATH"])
        environment.pop("HWLOC_HIDE_ERRORS", None)  # the wrapper sees to it
        return [os.path.join(root, "mudline")], environment

    def test_ctrl_c_on_two_ranks(self):
        """Steps of more than the second that mpirun gives the ranks."""
        command, environment = self.wrapper()
        long_steps = settings("mesh/cells={40, 40}")
        running = self.start([*command, "-n", "2", "run", "-q", *self.deck, *long_steps], env=environment, start_new_session=True)
        self.until_steps(running, 3)
        time.sleep(0.2)
        os.killpg(running.pid, signal.SIGINT)  # as a terminal does
        out, errors = running.communicate(timeout=300)
        self.assertEqual(running.returncode, 4, out + errors)
        lines = [line for line in errors.splitlines() if "Forwarding signal" not in line]
        self.assertEqual(len(lines), 2, errors)
        self.assertEqual(lines[0], "mudline: stopping after the present step, with a checkpoint; once more: at once")
        self.assertRegex(lines[1], r"warning: stopped by a signal after step \d+; continue with --restart")
        self.assertTrue(os.path.exists(self.result("ball_in_clay", ".restart")))

    def test_sighup(self):
        """A terminal that is closed sends it, maybe twice, and takes no more text."""
        read, write = os.pipe()
        running = subprocess.Popen([PROGRAM, "run", *self.deck], cwd=self.folder, stdout=write, stderr=subprocess.PIPE, text=True)
        os.close(write)
        self.until_steps(running, 4)
        running.send_signal(signal.SIGHUP)
        running.send_signal(signal.SIGHUP)
        os.set_blocking(read, True)
        while os.read(read, 65536):
            pass
        os.close(read)
        self.check_saved(running, 4)

    def test_sighup_under_nohup(self):
        running = self.start(["nohup", PROGRAM, "run", "-q", *self.deck, "--steps", "40"])
        self.until_steps(running, 4)
        running.send_signal(signal.SIGHUP)
        out, errors = running.communicate(timeout=200)
        self.assertEqual(running.returncode, 0, out + errors)
        self.assertGreater(self.steps(), 40)

    def test_the_wrapper_passes_the_exit_code_on(self):
        command, environment = self.wrapper()
        done = subprocess.run([*command, "-n", "2", "run", "none.xml"], cwd=self.folder, env=environment, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (2, "error: none.xml: the deck does not exist or cannot be read\n"))


if __name__ == "__main__":
    unittest.main()
