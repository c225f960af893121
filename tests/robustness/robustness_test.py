"""How the program ends: exit codes 0, 3 and 4, what is left on the disc then; and its own help."""
import math
import os
import re
import resource
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree as tree

import h5py
import cpu_limit
from mudline_case import PROGRAM, ROOT, History, MudlineCase, deck_text, program
from own_lines import own_lines

BALL = os.path.join(ROOT, "tests", "mpi", "ball_in_clay.xml")
TERZAGHI = os.path.join(ROOT, "inputs", "consolidation", "terzaghi.xml")
COMMANDS = ("run", "check", "list", "explain", "template", "report", "version")


class Endings(MudlineCase):
    def result(self, name, ending):
        return os.path.join(self.folder, "results", name + ending)

    def test_no_convergence(self):
        """A load that no soil bears: the step is cut down to the minimum, then the last state is saved."""
        done = program(["run", "-q", TERZAGHI, "--set", "boundary conditions/load/y=-1e12", "--set", "mesh/cells={1, 4}",
                        "--set", "stages/consolidation/time step/minimum=1e-3"], folder=self.folder)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertRegex(done.stderr.splitlines()[-1], r"\Aerror: step 1, t = 0 s: .*; the step cannot be cut below 0.001 s\Z")
        with h5py.File(self.result("terzaghi", ".h5"), "r") as file:
            self.assertIn("displacement", file["steps"][sorted(file["steps"])[-1]]["nodal"])
        tree.parse(self.result("terzaghi", ".xdmf"))
        self.assertTrue(os.path.exists(self.result("terzaghi", ".restart")))

    def test_no_convergence_later(self):
        """Steps that were accepted before the failure are in the results, and a restart with a kinder deck goes on from them."""
        impatient = self.write("impatient.xml", '<ParameterList name="over"><ParameterList name="solver"><ParameterList name="newton">'
                               '<Parameter name="maximum iterations" type="int" value="1"/>'
                               '<Parameter name="damped retry" type="bool" value="false"/>'
                               '</ParameterList></ParameterList></ParameterList>')
        name = ["--set", "output/name=ball", "--set", "stages/push/time step/minimum=2e-4"]
        done = program(["run", "-q", BALL, impatient] + name, folder=self.folder)
        self.assertEqual(done.returncode, 3, done.stderr)
        accepted = History(self.result("ball", ".csv")).time
        self.assertGreater(len(accepted), 1)
        self.assertLess(accepted[-1], 0.005)
        done = program(["run", "-q", BALL, "--restart"] + name, folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        whole = History(self.result("ball", ".csv")).time
        self.assertEqual(list(whole[:len(accepted)]), list(accepted))
        self.assertAlmostEqual(whole[-1], 0.005)

    def test_a_load_that_is_no_number_for_a_while(self):
        """Between the times at which the checks look: the run names the load's entry, and keeps what it has."""
        load = "t > 53 && t < 70 ? sqrt(40 - t) : -20e3"
        entry = "boundary conditions/load/y"
        done = program(["run", "-q", TERZAGHI, "--set", "mesh/cells={1, 4}", "--set", f"{entry}={load}",
                        "--set", "stages/consolidation/time step/maximum=10"], folder=self.folder)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn(f"traction/load: --set {entry}={load}: {entry}: the value of '{load}' is not finite at t = 53",
                      done.stderr.splitlines()[-1])
        time = History(self.result("terzaghi", ".csv")).time
        self.assertGreater(len(time), 50)
        self.assertAlmostEqual(time[-1], 53, 3)
        self.assertTrue(os.path.exists(self.result("terzaghi", ".restart")))

    def test_text_that_nobody_takes(self):
        """Standard output on a full disk: exit code 1 and one line, whatever the command; what else was asked for is done."""
        small = ["--set", "mesh/cells={1, 4}", "--set", "stages/consolidation/duration=1.0"]
        ended = program(["run", "-q", TERZAGHI, *small], folder=self.folder)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        sweep = self.write("sweep.xml", deck_text("sweep", {
            "deck": TERZAGHI, "abscissa": "load [Pa]", "variables": {"load": [1e3, 2e3]}, "settings": {"boundary conditions/load/y": "-load"},
            "results": {"load [Pa]": "load", "end [s]": "last('time')"}}))
        for arguments in (["run", TERZAGHI, *small, "--overwrite"], ["check", TERZAGHI], ["list"], ["explain", "water"], ["template", "biot"], ["version"],
                          ["report", "results/terzaghi"], ["sweep", sweep, "--set", "stages/consolidation/duration=1.0"]):
            with open("/dev/full", "w") as full:
                done = subprocess.run([PROGRAM, *arguments], cwd=self.folder, stdout=full, stderr=subprocess.PIPE, text=True)
            self.assertEqual(done.returncode, 1, f"{arguments}: {done.stderr}")
            self.assertEqual(own_lines(done.stderr)[-1:], ["error: the text for the standard output could not be written; is the disk full?"], arguments)

    def test_lack_of_memory(self):
        """A mesh that no address space of 2 GiB holds: exit code 1, and how much there was."""
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30))

        for command in ("run", "check"):
            done = subprocess.run([PROGRAM, command, TERZAGHI, "--set", "mesh/cells={4000, 4000}"], cwd=self.folder, capture_output=True, text=True,
                                  preexec_fn=limit)
            self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
            self.assertRegex(own_lines(done.stderr)[-1], r"\Aerror: not enough memory for this model: this process held up to .*`ulimit -v` allows 2 GiB; a coarser mesh")

    def test_folded_mesh(self):
        """A ball that is pushed on through the soil folds its elements: the run says where, keeps that state and ends; a stage may go on."""
        deep = ["--set", "stages/push/duration=0.3", "--set", "mesh/cells={4, 4}", "--set", "stages/push/time step/initial=1e-3", "--set", "plausibility/drained hole={0, 2}", "--set", "plausibility/prescribed depth={0, 1}"]
        done = program(["run", "-q", BALL] + deep, folder=self.folder)
        self.assertEqual(done.returncode, 3, done.stderr)
        poor, folded = done.stderr.splitlines()
        self.assertRegex(poor, r"\Awarning: the mesh is poor: \d+ of 16 elements have a scaled Jacobian below 0.1, the smallest is 0.0\d+ at \(.*\) at t ")
        self.assertRegex(folded, r"\Aerror: the mesh is folded: .* at t .*stages/push/allow folded elements = true\Z")
        history = History(self.result("ball_in_clay", ".csv"))
        self.assertLessEqual(history["mesh/quality"][-1], 0)
        self.assertGreater(history["mesh/quality"][:-1].min(), 0)
        self.assertAlmostEqual(history["mesh/quality"][0], 1, 3)
        with h5py.File(self.result("ball_in_clay", ".h5"), "r") as file:
            self.assertEqual(file["steps"][sorted(file["steps"])[-1]].attrs["time"], history.time[-1])
        several = program(["run", "-q", BALL, "--set", "output/name=two"] + deep, 2, folder=self.folder)
        self.assertEqual(several.returncode, 3, several.stderr)
        self.assertIn("the mesh is folded: 2 of 16 elements", several.stderr)
        more = program(["run", "-q", BALL, "--restart", "--steps", "3", "--set", "stages/push/allow folded elements=true"] + deep, folder=self.folder)
        self.assertNotIn("the mesh is folded", more.stderr)
        self.assertEqual(more.returncode, 0, more.stderr)

    def test_a_body_that_is_not_borne(self):
        """A ball pressed into clay by a contact that is too soft: the run goes on, and says once in a stage, and at its end, that it means little."""
        push = ["run", "-q", BALL, "--overwrite", "--set", "stages/push/duration=0.01"]

        def warnings(*settings, ranks=1):
            done = program(push + [word for setting in settings for word in ("--set", setting)], ranks, folder=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            return [line for line in done.stderr.splitlines() if "penetration" in line]

        self.assertEqual(warnings(), [])  # the automatic penalty
        soft = "contacts/ball on clay/penalty=1e6"
        for ranks in (1, 2):
            first, last = warnings(soft, ranks=ranks)
            found = re.match(r"warning: contact 'ball on clay': its penetration, ([\d.]+) mm at t [\d.]+ s after a distance of ([\d.]+) mm in sides of ([\d.]+) mm, "
                             r"over the distance is ([\d.]+), usual is 0 to 0.15 \(plausibility/penetration of way\): the penalty of 1 MPa/m deforms, not the "
                             r"soil, whose stiffness over height is [\d.]+ MPa/m; give a 'penalty' of ([\d.]+ MPa/m) or more", first)
            self.assertIsNotNone(found, first)
            depth, way, side, share = (float(number) for number in found.groups()[:4])
            wanted = found[5]
            self.assertAlmostEqual(depth / way, share, delta=0.02)
            self.assertGreater(depth, 0.05 * side)
            self.assertGreater(float(wanted.split()[0]), 10)
            self.assertRegex(last, r"\Awarning: contact 'ball on clay' was too soft during the run: its penetration was [\d.]+ mm, 0.9\d* of the distance, at t ")
        # what it advises is enough; the ranges are the deck's
        self.assertEqual(warnings(f"contacts/ball on clay/penalty={wanted}"), [])
        patient = [soft, "plausibility/penetration of way={0, 1}"]
        self.assertIn("over the side is 0.", "".join(warnings(*patient, "plausibility/penetration of side={0, 0.1}")))
        self.assertIn("over the body's half width is 0.", "".join(warnings(*patient, "plausibility/penetration of width={0, 0.02}")))
        self.assertEqual(warnings(*patient, "plausibility/penetration of side={0, 1}"), [])

    def test_stretched_sides(self):
        """A mesh that keeps its topology: the run says once, at its end, how much the sides at the body were stretched."""
        push = ["run", "-q", BALL, "--overwrite", "--set", "stages/push/duration=0.01"]
        told = set()
        for ranks in (1, 2):
            done = program([*push, "--set", "plausibility/stretched sides={0, 1.0001}"], ranks, folder=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            line, = (line for line in done.stderr.splitlines() if "stretched sides" in line)
            found = re.match(r"warning: contact 'ball on clay': the length of the longest side at the body over that in the mesh at the start, "
                             r"([\d.]+) mm over ([\d.]+) mm at t [\d.]+ s on a mesh that keeps its topology, is ([\d.]+), usual is 0 to 1 \(", line)
            self.assertIsNotNone(found, line)
            now, before, ratio = (float(number) for number in found.groups())
            self.assertAlmostEqual(now / before, ratio, delta=0.01)
            self.assertIn("): pressures and friction along the wall are not to be read; give 'mesh motion/remeshing' a 'wall size'", line)
            told.add(line)
        self.assertEqual(len(told), 1)
        self.assertNotIn("stretched sides", program(push, folder=self.folder).stderr)

    def test_too_many_steps(self):
        done = program(["run", "-q", BALL, "--set", "stages/push/time step/maximum steps=3"], folder=self.folder)
        self.assertEqual(done.returncode, 3)
        self.assertIn("stages/push/time step/maximum steps", done.stderr)
        self.assertTrue(os.path.exists(self.result("ball_in_clay", ".restart")))

    def check_signal(self, number):
        # small steps, so that there is time to interrupt
        deck = ["run", "-q", BALL, "--set", "stages/push/time step/initial=2.5e-5", "--set", "solver/residual tolerance=1e-7",
                "--set", "solver/update tolerance=1e-5", "--set", "solver/linear tolerance=1e-9"]
        self.assertEqual(program(deck + ["--set", "output/name=whole"], folder=self.folder).returncode, 0)
        running = subprocess.Popen([PROGRAM] + deck + ["--set", "output/name=parts"], cwd=self.folder, stderr=subprocess.PIPE, text=True)
        for _ in range(3000):  # until some steps are done
            if os.path.exists(self.result("parts", ".csv")):
                with open(self.result("parts", ".csv")) as file:
                    if len(file.readlines()) > 20:
                        break
            time.sleep(0.01)
        running.send_signal(number)
        _, errors = cpu_limit.communicate(running, 60)
        self.assertEqual(running.returncode, 4, errors)
        self.assertRegex(errors, r"\Awarning: stopped by a signal after step \d+; continue with --restart\n\Z")
        with open(self.result("parts", ".csv")) as file:
            self.assertLess(len(file.readlines()), 202)
        self.assertEqual(program(deck + ["--set", "output/name=parts", "--restart"], folder=self.folder).returncode, 0)
        with open(self.result("whole", ".csv"), "rb") as whole, open(self.result("parts", ".csv"), "rb") as parts:
            self.assertEqual(whole.read(), parts.read())

    def test_processes_that_start_together(self):
        """Each is alone, and none takes a folder or a file of MPI away from another."""
        deck = os.path.join(ROOT, "inputs", "consolidation", "terzaghi.xml")
        alone = {name: value for name, value in os.environ.items() if not name.startswith("OMPI_MCA_")}
        for _ in range(4):
            started = [subprocess.Popen([PROGRAM, "run", "-q", deck, "--steps", "1", "--set", f"output/name=run {k}"],
                                        cwd=self.folder, env=alone, stderr=subprocess.PIPE, text=True)
                       for k in range(12)]
            for process in started:
                errors = [line for line in process.communicate()[1].splitlines() if not line.startswith("warning: ")]
                self.assertEqual((process.returncode, errors), (0, []))

    def test_sigterm(self):
        self.check_signal(signal.SIGTERM)

    def test_ctrl_c(self):
        self.check_signal(signal.SIGINT)


class Help(MudlineCase):
    def said(self, *arguments):
        done = program(arguments, folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "")
        return done.stdout

    def test_help(self):
        text = self.said("--help")
        self.assertNotIn("Kokkos", text)
        for command in COMMANDS:
            self.assertIn(f"  {command} ", text)
            self.assertRegex(self.said(command, "--help"), r"(?i)example|usage")

    def test_version(self):
        self.assertRegex(self.said("version"), r"\Amudline \d+\.\d+\.\d+\n")
        self.assertRegex(self.said("--version"), r"\Amudline \d+\.\d+\.\d+\n\Z")

    def test_without_arguments_it_says_what_it_can(self):
        self.assertEqual(self.said(), self.said("--help"))

    def test_a_name_of_every_kind_is_explained(self):
        """The unit test Documentation looks at all names."""
        kinds = {}
        for line in self.said("list").splitlines():
            if line.startswith("  "):
                kinds[kind].append(line[2:].split("  ")[0].strip())
            else:
                kind = line
                kinds[kind] = []
        self.assertGreater(sum(map(len, kinds.values())), 35)
        for kind, names in kinds.items():
            with self.subTest(kind=kind):
                self.assertIn(f"{names[-1]} ({kind})", self.said("explain", names[-1]))
                # comments and sections of the template are well-formed XML
                tree.fromstring(self.said("template", names[-1]))
                listed = self.said("list", kind)
                for name in names:
                    self.assertIn(name, listed)

    def test_template_deck(self):
        for physics in ("biot", "solid"):
            text = self.said("template", physics)
            self.assertEqual([s.get("name") for s in tree.fromstring(text).findall("ParameterList")],
                             ["mesh", "materials", "physics", "boundary conditions", "stages", "output"])
            self.said("run", self.write(physics + ".xml", text))
            # one-dimensional compression, q h / M with M = E (1 - nu)/((1 + nu)(1 - 2 nu)); as long as the base does not feel the
            # drainage, Terzaghi's settlement is 2 q/M sqrt(c t/pi)
            settlement = -History(os.path.join(self.folder, "results", physics + ".csv"))["probe/top/displacement y"][-1]
            modulus = 1e7 * 0.7 / (1.3 * 0.4)
            depth = 10 if physics == "solid" else 2 * (1e-5 * modulus / 9.81e3 * 100 / math.pi) ** 0.5
            self.assertAlmostEqual(settlement / (1e4 * depth / modulus), 1, delta=5e-3 if physics == "solid" else 0.1)

    def test_default_solver_needs_no_name(self):
        self.said("check", "-q", TERZAGHI, "--set", "solver/linear solver/reuse factorisation=false",
                  "--set", "stages/consolidation/time step/initial=0.02")  # nothing to doubt

    def test_reference(self):
        self.assertIn("## modified cam clay (skeleton)", self.said("list", "--markdown"))
        tree.fromstring(self.said("list", "--xsd"))


if __name__ == "__main__":
    unittest.main()
