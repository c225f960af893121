"""The same deck on 1, 2 and 4 ranks, and a run continued from its checkpoint; plasticity and contact active."""
import os
import re
import unittest

import h5py
import numpy as np
from mudline_case import ROOT, MudlineCase, deck_text, program

DECK = os.path.join(ROOT, "tests", "mpi", "ball_in_clay.xml")
BLOCKS = os.path.join(ROOT, "inputs", "space", "sliding_blocks.xml")
BALL = os.path.join(ROOT, "inputs", "space", "ball.xml")
CYLINDERS = os.path.join(ROOT, "inputs", "contact", "cylinders.xml")
IN_SPACE = os.path.join(ROOT, "tests", "mpi", "footing_in_space.xml")
DIRECT = []
REUSE = ["solver/linear solver/reuse factorisation=true"]
BLOCK_AMG = ["solver/linear solver/type=block amg"]
# The solver's memory is tidied whenever a checkpoint is written: a run that is to be met exactly by one that stops after
# 10 steps (step 11 with the geostatic one) writes a checkpoint there too.
CHECKPOINT = ["output/checkpoint steps=11"]


class Mpi(MudlineCase):
    overlay = None

    def history(self, name, settings, ranks, extra=()):
        return self.run_deck([DECK] + ([self.overlay] if self.overlay else []), settings=[f"output/name={name}"] + settings, ranks=ranks, extra=extra, name=name)

    def content(self, name):
        with open(os.path.join(self.folder, "results", name + ".csv"), "rb") as file:
            return file.read()

    def assert_close(self, one, many, ranks):
        self.assertEqual(one.header, many.header)
        kept = ("mesh motion/change of solid", "mesh motion/change of water")  # up to rounding
        for name in kept:
            if name in one.columns:
                self.assertLess(max(np.abs(one[name]).max(), np.abs(many[name]).max()), 1e-12, name)
        # not rounding itself, nor a count
        own = [name for name in one.columns if name not in kept and not re.search("/error|iterations", name)]
        self.assert_same_run(one, many, own, f"{ranks} ranks")

    def check_ranks(self, settings):
        one = self.history("one", settings, 1)
        self.assertGreater(one["contact/ball on clay/active points"][-1], 2)
        for ranks in (2, 4):
            self.assert_close(one, self.history(f"on{ranks}", settings, ranks), ranks)
        return one

    def test_ranks_direct(self):
        self.check_ranks(DIRECT)
        # the clay is plastic
        with h5py.File(os.path.join(self.folder, "results", "one.h5"), "r") as file:
            steps = file["steps"]
            size = [np.array(steps[s]["cell"]["preconsolidation_pressure"])
                    for s in (sorted(steps)[0], sorted(steps)[-1])]
        self.assertGreater((np.abs(size[1] - size[0]) > 1e-3 * size[0]).sum(), 3)

    def test_ranks_block_amg(self):
        self.check_ranks(BLOCK_AMG)

    def test_ranks_film(self):
        """Water between ball and clay, the mesh moving."""
        self.move_the_mesh({"contacts": {"ball on clay": {"drainage": "film"}}})
        one = self.check_ranks(DIRECT)
        self.assertGreater(one["contact/ball on clay/film water"][-1], 0)
        self.check_restart(DIRECT, 2)

    def move_the_mesh(self, also={}):
        """From here on the mesh moves against the clay."""
        self.overlay = self.write("ale.xml", deck_text("ale", {"mesh motion": {"boundary": {
            "focus": "ball", "size near focus": 0.05, "near distance": 0.1, "growth": 0.2}}, **also}))

    def test_ranks_ale(self):
        self.move_the_mesh()
        one = self.check_ranks(DIRECT)
        self.assertGreater(np.ptp(one["mesh/quality"]), 1e-3)

    def test_restart_ale(self):
        self.move_the_mesh()
        self.check_restart(DIRECT, 1)

    def test_restart_ale_2(self):
        self.move_the_mesh()
        self.check_restart(DIRECT, 2)

    def check_restart(self, settings, ranks):
        settings = settings + CHECKPOINT
        self.history("whole", settings, ranks)
        self.history("parts", settings, ranks, ["--steps", "10"])
        self.assertNotEqual(self.content("parts"), self.content("whole"))
        self.history("parts", settings, ranks, ["--restart"])
        self.assertEqual(self.content("parts"), self.content("whole"))

    def test_restart_direct(self):
        self.check_restart(DIRECT, 1)

    def test_restart_reuse(self):
        self.check_restart(REUSE, 1)

    def test_restart_block_amg(self):
        self.check_restart(BLOCK_AMG, 1)

    def test_free_body_with_block_amg(self):
        """A ball that falls on clay: its motion borders the multigrid blocks."""
        deck = os.path.join(ROOT, "inputs", "impact", "ball_on_clay.xml")
        tight = ["solver/linear tolerance=1e-10", "solver/residual tolerance=1e-8"]
        direct = self.run_deck(deck, tight, extra=("--steps", "40"))
        for ranks in (1, 2):
            amg = self.run_deck(deck, tight + BLOCK_AMG, ranks=ranks, extra=("--steps", "40"))
            self.assert_same_run(direct, amg, ("body/ball/displacement y", "contact/seabed/reaction y"), f"{ranks} ranks", rounding=1e-6)

    def test_ranks_in_space(self):
        exact = ["solver/newton/largest forcing=0", "solver/linear tolerance=1e-11", "solver/residual tolerance=1e-10"]
        columns = ("displacement z", "displacement x", "reaction/base z", "reaction/left side x")
        one = self.run_deck(IN_SPACE, exact + ["solver/linear solver/type=direct"])
        for solver in ("direct", "block amg"):
            for ranks in (2, 4) if solver == "direct" else (1, 2, 4):
                many = self.run_deck(IN_SPACE, exact + ["solver/linear solver/type=" + solver], ranks=ranks)
                names = [name for name in one.columns if any(part in name for part in columns)]
                self.assertEqual(len(names), 4)
                self.assert_same_run(one, many, names, f"{solver}, {ranks} ranks")
        self.assertIn("linear solver: block amg", program(["run", IN_SPACE, "--overwrite"], 1, self.folder, 300).stdout)
        small = ["run", IN_SPACE, "--overwrite", "--set", "mesh/cells={2, 2, 2}"]
        self.assertIn("linear solver: direct", program(small, 1, self.folder, 300).stdout)

    def test_restart_in_space(self):
        settings = ["output/checkpoint steps=2", "stages/loading/duration=0.6"]
        whole = self.run_deck(IN_SPACE, settings + ["output/name=whole"], name="whole")
        self.run_deck(IN_SPACE, settings + ["output/name=parts"], extra=("--steps", "2"), name="parts")
        self.run_deck(IN_SPACE, settings + ["output/name=parts"], extra=("--restart",), name="parts")
        self.assertEqual(self.content("parts"), self.content("whole"))
        self.assertEqual(len(whole.time), 6)

    def test_mesh_motion_in_space(self):
        """The footing pressed in so far that the inside of the mesh has to follow, on 1 and 2 ranks and from a checkpoint."""
        self.overlay = self.write("ale.xml", deck_text("ale", {"mesh motion": {"every": 1}}))
        settings = ["mesh/cells={4, 4, 4}", "boundary conditions/load/z=-1e6*(x<2.5)*(y<2.5)", "output/checkpoint steps=2", "stages/loading/duration=0.6",
                    "solver/newton/largest forcing=0", "solver/linear tolerance=1e-11", "solver/residual tolerance=1e-10"]

        def run(name, ranks, *extra):
            return self.run_deck([IN_SPACE, self.overlay], settings + [f"output/name={name}"], ranks=ranks, extra=extra, name=name)

        one, two = run("one", 1), run("two", 2)
        self.assertGreater(np.ptp(one["mesh/quality"]), 1e-2)
        rounding = re.compile("/error|iterations|change of solid|change of water")
        self.assert_same_run(one, two, [name for name in one.columns if not rounding.search(name)], "2 ranks")
        for of, allowed in (("solid", 1e-12), ("water", 1e-6)):  # water: the volume of curved tetrahedra by quadrature
            self.assertLess(max(np.abs(run["mesh motion/change of " + of]).max() for run in (one, two)), allowed, of)
        for ranks, whole in ((1, "one"), (2, "two")):
            run("parts", ranks, "--steps", "2", "--overwrite")
            run("parts", ranks, "--restart")
            self.assertEqual(self.content("parts"), self.content(whole))

    def check_contact_in_space(self, deck, exact, columns, steps):
        """Columns of a deck's contact over the ranks, and after a restart on one and two."""
        exact = exact + ["solver/newton/largest forcing=0", "solver/linear tolerance=1e-11"]
        one = self.run_deck(deck, exact)
        names = [name for name in one.columns if name.startswith("contact/") and "points" not in name]
        self.assertEqual(len([name for name in names if "friction" in name or "reaction" in name or "force" in name]), columns)
        for ranks in (2, 4):
            many = self.run_deck(deck, exact, ranks=ranks)
            self.assert_same_run(one, many, names, f"{ranks} ranks")
        for ranks in (1, 2):
            self.run_deck(deck, exact + ["output/name=parts"], ranks=ranks, extra=("--steps", str(steps), "--overwrite"), name="parts")
            again = self.run_deck(deck, exact + ["output/name=parts"], ranks=ranks, extra=("--restart",), name="parts")
            self.assert_same_run(one, again, names, f"restart on {ranks} ranks")
        return one

    def test_ranks_contact_in_space(self):
        """A rough ball pressed into clay and pushed sideways."""
        exact = ["solver/residual tolerance=1e-10", "mesh/cells={6, 3, 2}", "stages/push/duration=1.4", "stages/push/time step/initial=0.2",
                 "stages/push/time step/maximum=0.2"]
        one = self.check_contact_in_space(BALL, exact, 9, 7)
        self.assertGreater(-one["contact/ball on soil/friction x"][-1], 100)

    def test_ranks_pair_in_space(self):
        """A block dragged over another one."""
        one = self.check_contact_in_space(BLOCKS, ["solver/residual tolerance=1e-10", "mesh/parameters/size=0.4", "stages/drag/duration=1.5"], 4, 12)
        self.assertGreater(-one["contact/face/force on slave x"][-1], 100)

    def test_split(self):
        """A run that reads its parts from the file of `mudline split` is the run that cuts its mesh, bit for bit, in the plane and in space, with bodies and
        with two surfaces in contact; and either may continue the other."""
        for deck in (DECK, BALL, CYLINDERS):
            name = os.path.splitext(os.path.basename(deck))[0]
            for ranks in (2, 3):
                parts = os.path.join(self.folder, f"{name}.{ranks}.parts.h5")
                done = program(["split", deck, "--ranks", str(ranks)], 1, self.folder, 300)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertTrue(os.path.isfile(parts), done.stdout)
                start = ["--overwrite", "--steps"]
                self.run_deck(deck, ["output/name=plain"], ranks, start + ["3"], name="plain")
                self.run_deck(deck, ["output/name=parts"], ranks, start + ["3", "--mesh-parts", parts], name="parts")
                self.assertEqual(self.content("parts"), self.content("plain"), f"{name} on {ranks} ranks")
            self.run_deck(deck, ["output/name=parts"], ranks, ["--restart", "--steps", "1"], name="parts")
            self.run_deck(deck, ["output/name=plain"], ranks, ["--restart", "--steps", "1", "--mesh-parts", parts], name="plain")
            self.assertEqual(self.content("parts"), self.content("plain"), f"{name}, continued")

    def test_restart_direct_2(self):
        self.check_restart(DIRECT, 2)

    def test_restart_reuse_2(self):
        self.check_restart(REUSE, 2)

    def test_restart_block_amg_2(self):
        self.check_restart(BLOCK_AMG, 2)


if __name__ == "__main__":
    unittest.main()
