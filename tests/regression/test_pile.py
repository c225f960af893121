"""The pile deck, its push shortened to three eighths of a diameter: from the surface, the mesh moving against the clay."""
import os
import unittest

import h5py
import numpy as np

from mudline_case import ROOT, SharedRun

DECK = os.path.join(ROOT, "inputs", "pile", "clay.xml")
PUSH, DIAMETER = 0.16, 0.4


class Pile(SharedRun):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        overlay = ('<ParameterList name="short"><ParameterList name="stages"><ParameterList name="set-up">'
                   '<Parameter name="duration" type="double" value="1e6"/><ParameterList name="time step">'
                   '<Parameter name="maximum" type="double" value="1e6"/></ParameterList></ParameterList>'
                   '<ParameterList name="load test"><Parameter name="duration" type="double" value="0.2"/></ParameterList>'
                   '<ParameterList name="pull-out"><Parameter name="duration" type="double" value="0.8"/></ParameterList>'
                   '</ParameterList></ParameterList>')
        short = cls.shared.write("short.xml", overlay)
        cls.run_once([DECK, short], [f"stages/push/duration={PUSH}"])
        cls.file = h5py.File(os.path.join(cls.shared.folder, "results", "clay.h5"), "r")
        cls.pushing = (cls.history.time > 0) & (cls.history.time <= PUSH * (1 + 1e-9))

    @classmethod
    def tearDownClass(cls):
        cls.file.close()
        super().tearDownClass()

    def test_steps_are_easy(self):
        self.assertLessEqual(self.rejected, 0.05 * self.steps)
        self.assertLess(self.history["step/newton iterations"][self.pushing].mean(), 8.5)

    def test_the_mesh_stays_good_and_nothing_is_lost(self):
        self.assertGreater(self.history["mesh motion/quality"].min(), 0.2)
        self.assertLess(np.abs(self.history["mesh motion/change of solid"]).max(), 1e-10)
        self.assertLess(np.abs(self.history["mesh motion/change of water"]).max(), 1e-10)
        self.assertLess(np.abs(self.history["balance/water/error"]).max(), 1e-6)

    def test_resistance_is_smooth(self):
        depth = -self.history["body/pile/displacement y"][self.pushing]
        force = self.history["contact/pile/reaction y"][self.pushing]
        deep = depth > 0.06
        smooth = np.polyval(np.polyfit(depth[deep], force[deep], 3), depth[deep])
        self.assertLess(np.std(force[deep] - smooth) / force[deep].mean(), 0.01)
        # undrained bearing: six to twelve times the strength, and the surcharge that the reaction leaves out
        self.assertTrue(20e3 < force[-1] / (np.pi * DIAMETER ** 2 / 4) < 60e3, force[-1])

    def test_excess_pressure_is_highest_under_the_face_and_dissipates(self):
        names = sorted(self.file["steps"])
        times = [self.file["steps"][name].attrs["time"] for name in names]
        pushed = self.file["steps"][names[int(np.argmin(np.abs(np.array(times) - PUSH)))]]
        x, pressure = pushed["coordinates"][:], pushed["nodal/excess_pore_pressure"][:].ravel()
        face = (x[:, 0] < 0.12) & (x[:, 1] > -PUSH - 0.03)
        shaft = (x[:, 0] < 0.23) & (x[:, 1] > -0.07)
        self.assertGreater(np.median(pressure[face]), 2 * np.median(pressure[shaft]))
        self.assertGreater(np.median(pressure[face]), 15e3)
        rest = [self.file["steps"][name] for name, t in zip(names, times) if PUSH + 9e5 < t < PUSH + 1e6 + 1e-3]
        self.assertTrue(rest)
        self.assertLess(rest[-1]["nodal/excess_pore_pressure"][:].max(), 0.5 * pressure.max())
        # far away nothing has happened, although the nodes have moved
        far = (x[:, 0] > 2.5) | (x[:, 1] < -4)
        self.assertLess(np.abs(pressure[far]).max(), 0.02 * pressure.max())

    def test_a_load_test_finds_more_than_the_push_left(self):
        time, force = self.history.time, self.history["contact/pile/reaction y"]
        held, loaded = (np.interp(PUSH + 1e6 + after, time, force) for after in (0.0, 0.2))
        self.assertGreater(loaded, 1.05 * held)
        self.assertGreater(np.interp(PUSH + 1e6 + 0.2, time, self.history["contact/pile/friction y"]), 0)

    def test_pull_out_turns_friction_round(self):
        self.assertGreater(self.history["contact/pile/friction y"][self.pushing][-1], 0)  # upwards on the pile that goes down
        self.assertLess(self.history["contact/pile/friction y"][-1], 0)


if __name__ == "__main__":
    unittest.main()
