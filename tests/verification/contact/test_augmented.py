"""Augmented Lagrangian: what a soft penalty leaves, multipliers take."""
import os
import unittest

import numpy as np

from compared_case import problem
from contact_case import PRESSURE, ContactCase
from mudline_case import History, program
from references import contact as reference

AUGMENTED = ("contacts/face/enforcement=augmented Lagrangian",)


@problem("exact", "Hertz, after Johnson (1985); equilibrium", "Augmented Lagrangian")
class Augmented(ContactCase):
    def test_patch(self):
        """Uniform pressure from the automatic penalty, which differs from side to side."""
        history = self.run_deck(self.deck("patch"), AUGMENTED + ("contacts/face/penalty=0", "contacts/face/gap tolerance=1e-13"))
        _, pressure = self.surface("patch", 0.5, PRESSURE)
        self.compare_values("pressure", pressure, pressure.mean(), 1e-8)
        # confined: M times the strain, in the deformed state
        modulus = 1e7 * 0.7 / (1.3 * 0.4)
        self.compare_values("mean pressure", pressure.mean(), modulus * 1e-4 / 0.5, 3e-4)
        self.assertLessEqual(history["contact/face/weighted gap"][-1], 1e-13)

    def test_hertz_with_a_soft_penalty(self):
        """A penalty that alone lets the cylinder sink in by 24 of 600 micrometres."""
        soft = ("contacts/face/penalty factor=0.5",)
        alone = self.run_deck(self.deck("hertz_line"), soft)["contact/face/maximum penetration"][-1]
        self.assertGreater(alone, 2e-5)
        history = self.run_deck(self.deck("hertz_line"), AUGMENTED + soft)
        self.assertTrue(np.all(history["contact/face/weighted gap"] <= 1.6e-9))
        self.assertLessEqual(history["contact/face/maximum penetration"][-1], 0.02 * alone)
        load = 2 * history["contact/face/reaction y"][-1]
        a, p0 = reference.hertz_line(load, 1.0, reference.plane_modulus(2e8, 0.3))
        x, pressure = self.surface("hertz_line", 0.0, PRESSURE)
        self.compare_values("largest pressure", pressure[0], p0, 0.02)
        for fraction in (0.5, 0.8):
            self.compare_values(f"pressure at {fraction} a", np.interp(fraction * a, x, pressure),
                                reference.hertz_pressure(fraction * a, a, p0), 0.02, p0)

    @problem("consistency")
    def test_block_sticks_where_it_stands(self):
        """Pushed below its friction a block moves with the ground only, not by the stretch of the penalty's spring."""
        push = ("materials/soil/skeleton/Young's modulus=1e9", "stages/slide/motions/block/force x=2000*min(5*(t-1),1)",
                "stages/slide/motions/block/initial velocity={0.0,0.0}")
        way = {}
        for name, settings in {"soft": AUGMENTED + ("contacts/face/gap tolerance=1e-10",), "spring": (),
                               "stiff": ("contacts/face/penalty=1e12",)}.items():
            history = self.run_deck(self.deck("sliding_block"), push + settings + ("solver/residual tolerance=1e-7",))
            # no step fails on the rounding of positions, which times the stiff penalty is more than 1e-7 of the first loads
            self.assertEqual(len(history["time"]), 101, name)
            way[name] = history["body/block/displacement x"][-1]
        self.assertGreater(way["spring"], way["stiff"] + 0.9e-6)
        self.compare_values("way", way["soft"], way["stiff"] - 2000 / (2 * 1e12),
                            1e-3)  # less the stiff spring's own stretch

    @problem("consistency")
    def test_rejected_steps_and_restarts_leave_nothing(self):
        deck = self.deck("sliding_plate")
        settings = AUGMENTED + ("contacts/face/penalty factor=2", "contacts/face/gap tolerance=1e-9", "contacts/face/most augmentations=8")

        def table(first, *extra, ranks=1):
            done = program(["run", "-v", deck] + [x for s in settings + (f"stages/pull/time step/initial={first}",) for x in ("--set", s)]
                           + list(extra), ranks, self.folder)
            self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])
            with open(os.path.join(self.folder, "results", "sliding_plate.csv")) as file:
                return file.read(), done.stdout

        direct, log = table(0.25)
        self.assertNotIn("rejected: ", log)
        after, log = table(0.5)  # which needs nine augmentations
        self.assertIn("gap tolerance of 1e-09 m after 8 augmentations", log)
        # the step that was repeated; then the steps grow back
        self.assertEqual(after.split("\n")[6], direct.split("\n")[6], "a rejected step")
        table(0.25, "--steps", "6")
        restarted, _ = table(0.25, "--restart")
        self.assertEqual(restarted, direct, "a restart")
        table(0.25, ranks=2)
        two = History(os.path.join(self.folder, "results", "sliding_plate.csv"))
        table(0.25)
        one = History(os.path.join(self.folder, "results", "sliding_plate.csv"))
        self.assert_same_run(one, two, [f"contact/face/{name}" for name in ("reaction x", "reaction y", "friction heat")], "2 ranks")


if __name__ == "__main__":
    unittest.main()
