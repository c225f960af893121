"""Two deformable surfaces: contact patch test, two cylinders, friction, ranks, restart, errors."""
import os
import unittest

import h5py
import numpy as np

from compared_case import problem
from contact_case import PRESSURE
from mudline_case import deck_text, program
from references import contact as reference
from sliding_blocks import FORCES, HEAT_OF_STEPS, SLIDE, SlidingBlocks


@problem("exact", "Hertz, after Johnson (1985); uniform stress", "Two deformable surfaces, mortar")
class Pairs(SlidingBlocks):
    def top(self, level=1.0):
        """Displacements of the nodes that started at y = level, and the contact pressures that are not 0."""
        with h5py.File(os.path.join(self.folder, "results", "blocks.h5"), "r") as file:
            step = file["steps"][sorted(file["steps"])[-1]]
            start = file["mesh/coordinates"][:]
            at = np.abs(start[:, 1] - level) < 1e-9
            pressure = np.asarray(step["nodal"][PRESSURE])
            return (step["coordinates"][:] - start)[at, 1], pressure[pressure != 0]

    def test_patch(self):
        """Uniform stress through meshes that do not match, at strains of a per cent."""
        for slave, master in (("upper bottom", "lower top"), ("lower top", "upper bottom")):
            self.run_deck(self.deck("blocks"), (f"contacts/face/slave={slave}", f"contacts/face/master={master}",
                                                "contacts/face/gap tolerance=1e-12", "boundary conditions/load/value=1e5"))
            way, pressure = self.top()
            self.assertGreater(len(pressure), 6)
            self.compare_values("pressure", pressure, 1e5, 1e-8)
            self.compare_values("level of the top", way, way.mean(), 1e-8)

    def test_patch_in_water(self):
        """The same in steady pore pressure, with friction on the effective traction."""
        porous = {"porosity": 0.4, "fluid": {"type": "water"},
                  "permeability": {"type": "constant", "hydraulic conductivity": 1.0}}
        water = self.write("water.xml", deck_text("water", {
            "materials": {"lower": porous, "upper": porous}, "physics": {"blocks": {"type": "biot"}},
            "boundary conditions": {f"water {name}": {"type": "pore pressure", "set": name, "value": 4e4}
                                    for name in ("base", "lower top", "upper bottom", "top")},
            "contacts": {"face": {"friction": {"type": "coulomb", "coefficient": 0.3}}}}))
        for slave, master in (("upper bottom", "lower top"), ("lower top", "upper bottom")):
            self.run_deck([self.deck("blocks"), water], (
                f"contacts/face/slave={slave}", f"contacts/face/master={master}", "contacts/face/gap tolerance=1e-12",
                "boundary conditions/load/value=1e5", "stages/press/duration=1e6",
                "stages/press/time step/initial=1e6"))
            way, pressure = self.top()
            self.assertGreater(len(pressure), 6)
            self.compare_values("pressure", pressure, 1e5, 1e-8)
            self.compare_values("level of the top", way, way.mean(), 1e-8)

    def test_patch_against_linear_elasticity(self):
        self.run_deck(self.deck("blocks"))
        self.compare_values("confined", self.top()[0], -1.192857142857e-5, 1e-4)
        # a free side ends where the blocks part by 3e-6 of their width
        self.run_deck(self.deck("blocks"), ("stages/press/conditions={base, left side, load}",))
        self.compare_values("free sides", self.top()[0], -1.39e-5, 1e-4)

    def test_two_cylinders(self):
        history = self.run_deck(self.deck("cylinders"))
        load = 2 * history["contact/face/force on slave y"][-1]
        a, p0 = reference.hertz_line(load, 0.5, 0.5 * reference.plane_modulus(2e8, 0.3))
        with h5py.File(os.path.join(self.folder, "results", "cylinders.h5"), "r") as file:
            step = file["steps"][sorted(file["steps"])[-1]]
            pressure, x = np.asarray(step["nodal"][PRESSURE]), step["coordinates"][:, 0]
        touching = np.flatnonzero(pressure)
        touching = touching[np.argsort(x[touching])]
        x, pressure = x[touching], pressure[touching]
        self.compare_values("largest pressure", pressure[0], p0, 0.02)
        self.compare_values("half width", history["contact/face/contact area"][-1], a,
                            0.1)  # 0.0016 m sides: a tenth of it
        for fraction in (0.25, 0.5, 0.8):
            self.compare_values(f"pressure at {fraction} a", np.interp(fraction * a, x, pressure),
                                reference.hertz_pressure(fraction * a, a, p0), 0.02, p0)
        self.assertLess(history["contact/face/weighted gap"][-1], 1.3e-9)

    @problem("consistency")
    def test_friction_restart_and_ranks(self):
        history = self.check_sliding_blocks()
        self.compare_values("what slides", history["contact/face/sliding length"][-1],
                            history["contact/face/contact area"][-1], 1e-4)
        # where rounding decides a step's size the comparison of ranks goes on; a larger first step stands for it
        other = self.table([os.path.join(self.folder, "slide.xml")], "--set", "stages/slide/time step/initial=0.0625")[1]
        self.assertNotEqual(len(history.time), len(other.time))
        self.assert_same_run(history, other, FORCES, "other steps", steps=HEAT_OF_STEPS)

    @problem("exact", "Coulomb: shear stress is the coefficient after the path slid times the pressure")
    def test_coefficient_that_falls_with_the_slip(self):
        """The path slid follows from the heat. The blocks are so stiff that they slide everywhere alike, and a step
        takes the coefficient of its start."""
        first, residual, length = 0.3, 0.15, 5e-5
        stiff = {"skeleton": {"Young's modulus": 1e9}}
        weaker = self.write("weaker.xml", deck_text("weaker", {
            "materials": {"lower": stiff, "upper": stiff},
            "contacts": {"face": {"friction": {"residual coefficient": residual, "residual slip": length}}},
            "stages": {"slide": {"time step": {"initial": 0.03125, "maximum": 0.03125}}}}))
        _, history = self.table([self.write("slide.xml", SLIDE), weaker])
        drag, force = -history["contact/face/force on slave x"], history["contact/face/force on slave y"]
        heat = np.diff(history["contact/face/friction heat"], prepend=0.0)
        path = np.cumsum(np.divide(heat, drag, out=np.zeros_like(heat), where=heat > 0))
        late = np.flatnonzero(history.time > 1.5)  # all slides
        exact = residual + (first - residual) * np.exp(-path[late - 1] / length)
        self.compare_values("coefficient", (drag / force)[late], exact, 0.02)
        self.assertGreater(path[-1], 2 * length)
        self.assertLess(drag[-1] / force[-1], 0.6 * first)

    @problem("behaviour")
    def test_errors(self):
        def message(*settings):
            done = program(["check", self.deck("blocks")] + [x for s in settings for x in ("--set", s)], 1, self.folder)
            self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
            return done.stderr

        self.assertIn("contacts/face/slave: unknown side set 'uper bottom' (did you mean 'upper bottom'?)", message("contacts/face/slave=uper bottom"))
        self.assertIn("a surface does not touch itself", message("contacts/face/master=upper bottom"))
        self.assertIn("shares nodes with the slave", message("contacts/face/master=right", "mesh/cracks={upper bottom}"))
        self.assertIn("only with 'enforcement' = augmented Lagrangian", message("contacts/face/enforcement=penalty"))
        with open(os.path.join(os.path.dirname(self.deck("blocks")), "blocks.geo")) as file:
            geometry = file.read()
        named = self.write("named.geo", geometry + 'Physical Curve("sole") = {5};\n')
        for slave, master in (("lower top", "upper bottom"), ("sole", "lower top")):
            twin = self.write("twin.xml", deck_text("twin", {"contacts": {"twin": {
                "type": "mortar", "slave": slave, "master": master, "gap tolerance": 1e-14}}}))
            done = program(["check", self.deck("blocks"), twin, "--set", f"mesh/file={named}"], 1, self.folder)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(f"twin.xml:3: contacts/twin: presses surface '{slave}' with surface '{master}' in stage "
                          "'press', as contact 'face' does on some of the same sides, surface 'upper bottom' with "
                          "surface 'lower top': the traction would count twice; allowed: one of them in a stage", done.stderr)
        sunk = self.write("sunk.geo", geometry.replace("{0, 0, 0, 1.1", "{0, -0.2, 0, 1.1").replace("{1, 0, 0, 0.9", "{1, -0.2, 0, 0.9"))
        self.assertIn("the mesh lies over itself", message(f"mesh/file={sunk}"))
        apart = self.write("apart.geo", geometry.replace("{0, 0, 0, 1.1", "{0, 0.001, 0, 1.1").replace("{1, 0, 0, 0.9", "{1, 0.001, 0, 0.9"))
        press = self.write("press.xml", """<ParameterList name="press"><ParameterList name="boundary conditions"><ParameterList name="press">
  <Parameter name="type" type="string" value="displacement"/>
  <Parameter name="set" type="string" value="top"/>
  <Parameter name="y" type="string" value="-0.002*t"/>
</ParameterList></ParameterList></ParameterList>
""")
        done = program(["run", self.deck("blocks"), press, "--set", f"mesh/file={apart}", "--set", "contacts/face/reach=1e-6", "--set",
                        "stages/press/time step/minimum=0.9"], 1, self.folder)
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertIn("farther apart at the start than its 'reach'", done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
