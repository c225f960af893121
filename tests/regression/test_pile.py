"""The pile deck, one and a half diameters deep on the mesh of inputs/pile/short_pile.xml: from the surface, the mesh moving against the clay, then three
years of set-up, load test, pull-out. Its figures are held against those of finer meshes (docs/benchmarks/mesh_convergence.md)."""
import os
import unittest

import h5py
import numpy as np

from mudline_case import ROOT, History, SharedRun, program

DECKS = [os.path.join(ROOT, "inputs", "pile", name) for name in ("clay.xml", "short_pile.xml")]
PUSH, LATE = 0.62, 0.01  # [s]; the pile is at 1 m/s times (t - 0.01 s)
SET_UP, LOAD_TEST = 1e8, 2.0  # [s]

# converged with the mesh, docs/benchmarks/mesh_convergence.md
RESISTANCE = {0.2: 5.76e3, 0.4: 8.34e3, 0.6: 10.36e3}  # [N] at a depth [m]
EXCESS_PRESSURE = {"half radius": 59.7e3, "below": 56.7e3}  # [Pa] at 0.6 m
SET_UP_RATIO = 1.130  # load test over push


class Pile(SharedRun):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.run_once(DECKS, name="short_pile")
        cls.file = h5py.File(os.path.join(cls.shared.folder, "results", "short_pile.h5"), "r")
        cls.pushing = (cls.history.time > 0) & (cls.history.time <= PUSH * (1 + 1e-9))

    @classmethod
    def tearDownClass(cls):
        cls.file.close()
        super().tearDownClass()

    def test_steps_are_easy(self):
        self.assertLessEqual(self.rejected, 0.05 * self.steps)
        self.assertLess(self.history["step/newton iterations"][self.pushing].mean(), 8.5)

    def test_the_mesh_stays_good_and_nothing_is_lost(self):
        self.assertGreater(self.history["mesh/quality"].min(), 0.2)
        self.assertLess(np.abs(self.history["mesh motion/change of solid"]).max(), 1e-10)
        self.assertLess(np.abs(self.history["mesh motion/change of water"]).max(), 1e-10)
        self.assertLess(np.abs(self.history["balance/water/error"]).max(), 1e-6)

    def test_what_is_installed_goes_on_in_space(self):
        """A quarter that starts with the state after the set-up is loaded as the load test loads it."""
        folder = self.shared.folder
        made = program(["mesh", "results/short_pile@set-up", "-o", "pile.msh"], folder=folder)
        self.assertEqual(made.returncode, 0, made.stderr)
        deck = os.path.join(ROOT, "inputs", "space", "installed_pile.xml")
        settings = {"mesh/plane/file": os.path.join(folder, "pile.msh"), "mesh/angle": 90, "mesh/layers": 3, "boundary conditions/end/components": "x",
                    "boundary conditions/axis/components": "x y", "bodies/pile/motion/velocity x": 0.0, "bodies/pile/motion/velocity z": -0.01}
        out = program(["run", "-q", deck, "--steps", 5] + [word for key, value in settings.items() for word in ("--set", f"{key}={value}")], folder=folder)
        self.assertEqual(out.returncode, 0, out.stdout + out.stderr)
        space = History(os.path.join(folder, "results", "installed_pile.csv"))
        for time, force in zip(space.time, 4 * space["contact/pile/reaction z"]):
            self.compare_values(f"reaction after {time} s", force,
                                self.history.at("contact/pile/reaction y", PUSH + SET_UP + time), 0.03)

    def test_resistance(self):
        depth = -self.history["body/pile/displacement y"][self.pushing]
        force = self.history["contact/pile/reaction y"][self.pushing]
        deep = depth > 0.06
        smooth = np.polyval(np.polyfit(depth[deep], force[deep], 3), depth[deep])
        self.assertLess(np.std(force[deep] - smooth) / force[deep].mean(), 0.01)
        for z, expected in RESISTANCE.items():
            self.compare_values(f"resistance at {z} m", np.interp(z, depth, force), expected, 0.03)

    def test_excess_pressure_under_the_face(self):
        for place, expected in EXCESS_PRESSURE.items():
            self.compare_values(f"excess pressure, {place}",
                                self.history.at(f"probe/{place}/excess pore pressure", 0.6 + LATE), expected, 0.05)

    def test_excess_pressure_is_highest_under_the_face_and_dissipates(self):
        names = sorted(self.file["steps"])
        times = np.array([self.file["steps"][name].attrs["time"] for name in names])
        pushed, rested = (self.file["steps"][names[int(np.argmin(np.abs(times - t)))]] for t in (PUSH, PUSH + SET_UP))
        x, pressure = pushed["coordinates"][:], pushed["nodal/excess_pore_pressure"][:].ravel()
        face = (x[:, 0] < 0.12) & (x[:, 1] > -PUSH - 0.03) & (x[:, 1] < -PUSH + 0.07)
        shaft = (x[:, 0] < 0.23) & (x[:, 1] > -0.07)
        self.assertGreater(np.median(pressure[face]), 2 * np.median(pressure[shaft]))
        self.assertLess(np.abs(rested["nodal/excess_pore_pressure"][:]).max(), 0.02 * pressure.max())
        # far away nothing has happened, although the nodes have moved
        far = (x[:, 0] > 2.5) | (x[:, 1] < -4)
        self.assertLess(np.abs(pressure[far]).max(), 0.02 * pressure.max())

    def test_set_up(self):
        time, force = self.history.time, self.history["contact/pile/reaction y"]
        pushed, held, loaded = (np.interp(t, time, force) for t in (PUSH, PUSH + SET_UP, PUSH + SET_UP + LOAD_TEST))
        self.assertLess(held, loaded)
        self.compare_values("set-up", loaded / pushed, SET_UP_RATIO, 0.05)

    def test_pull_out_turns_friction_round(self):
        friction = self.history["contact/pile/friction y"]
        self.assertGreater(friction[self.pushing][-1], 0)  # upwards on the pile that goes down
        self.assertGreater(np.interp(PUSH + SET_UP + LOAD_TEST, self.history.time, friction), 0)
        self.assertLess(friction[-1], 0)


if __name__ == "__main__":
    unittest.main()
