"""Nodes against segments: patch test, two cylinders, friction, smoothed and faceted masters, ranks, restart, errors."""
import os
import unittest

import h5py
import numpy as np

from compared_case import problem
from contact_case import PRESSURE
from mudline_case import deck_text, program
from references import contact as reference
from sliding_blocks import SLIDE, SlidingBlocks
from swinging_mesh import swinging_mesh

MOTION = deck_text("motion", swinging_mesh(0.1, 0.7))

# a fine part of the outer boundaries that travels along with a body that nothing touches
FOCUS = """<ParameterList name="focus">
  <ParameterList name="bodies"><ParameterList name="point">
    <ParameterList name="contour">
      <Parameter name="type" type="string" value="cylinder"/>
      <Parameter name="diameter" type="double" value="0.02"/>
      <Parameter name="extent" type="string" value="full"/>
    </ParameterList>
    <Parameter name="position" type="Array(double)" value="{-0.5, 0.3}"/>
    <ParameterList name="motion">
      <Parameter name="type" type="string" value="prescribed velocity"/>
      <Parameter name="velocity x" type="string" value="1"/>
    </ParameterList>
  </ParameterList></ParameterList>
  <ParameterList name="mesh motion"><ParameterList name="boundary">
    <Parameter name="focus" type="string" value="point"/>
    <Parameter name="size near focus" type="double" value="0.05"/>
    <Parameter name="growth" type="double" value="0.5"/>
    <Parameter name="material sides" type="Array(string)" value="{upper bottom, lower top}"/>
  </ParameterList></ParameterList>
</ParameterList>
"""


@problem("exact", "Hertz, after Johnson (1985); equilibrium", "Nodes against segments")
class Nodes(SlidingBlocks):
    overlay = property(lambda self: self.deck("node_to_segment"))

    def last_step(self, stem):
        with h5py.File(os.path.join(self.folder, "results", stem + ".h5"), "r") as file:
            step = file["steps"][sorted(file["steps"])[-1]]
            return file["mesh/coordinates"][:], step["coordinates"][:], np.asarray(step["nodal"][PRESSURE])

    def patch(self, *settings, ranks=1):
        """Least and largest contact pressure over the load; spread of the top's displacement over its mean."""
        with open(self.deck("blocks")) as file:
            text = "".join(line for line in file if "gap tolerance" not in line)
        blocks = self.write("loose.xml", text.replace("blocks.geo", os.path.join(os.path.dirname(self.deck("blocks")), "blocks.geo")))
        self.run_deck([blocks, self.overlay], settings, ranks=ranks)
        start, now, pressure = self.last_step("loose")
        way = (now - start)[np.abs(start[:, 1] - 1) < 1e-9, 1]
        pressure = pressure[pressure != 0] / 100
        if os.environ.get("MUDLINE_SHOW_ERRORS"):
            print(f"patch {settings}: pressure {pressure.min():.3f} to {pressure.max():.3f}, level {np.ptp(way) / abs(way.mean()):.1e}")
        self.compare_values("confined", way.mean(), -1.192857142857e-5, 0.02)
        return max(pressure.max() - 1, 1 - pressure.min()), np.ptp(way) / abs(way.mean())

    def test_patch(self):
        """Meshes that do not match: the pressure is not uniform, as is known of node to segment."""
        for order, slave, master in ((1, "upper bottom", "lower top"), (2, "upper bottom", "lower top"), (2, "lower top", "upper bottom")):
            stress, level = self.patch(f"mesh/order={order}", f"contacts/face/slave={slave}", f"contacts/face/master={master}",
                                       "contacts/face/master surface=sides")
            self.assertLess(stress, 0.2)
            self.assertGreater(stress, 0.01)  # else the documents are wrong
            self.assertLess(level, 1e-3)
        pressed = ("mesh/order=1", "contacts/face/master surface=sides", "contacts/face/enforcement=penalty")
        self.compare_values("2 ranks", self.patch(*pressed, ranks=2), self.patch(*pressed), 1e-6, 1.0)

    def test_patch_of_meshes_that_match(self):
        with open(os.path.join(os.path.dirname(self.deck("blocks")), "blocks.geo")) as file:
            text = file.read().replace("1.1 / upper_cells", "1 / lower_cells").replace("0.9 / upper_cells", "0.8 / lower_cells")
        mesh = self.write("matching.geo", text)
        for surface in ("sides", "hermite"):
            self.run_deck([self.deck("blocks"), self.overlay], (f"mesh/file={mesh}", f"contacts/face/master surface={surface}"))
            pressure = self.last_step("blocks")[2]
            self.assertGreater(np.count_nonzero(pressure), 6)
            self.compare_values(surface, pressure[pressure != 0], 100, 1e-6)

    def cylinders(self, *settings):
        """Distance from the centre, in half widths, and contact pressure over Hertz' largest, of the nodes that touch."""
        history = self.run_deck([self.deck("cylinders"), self.overlay], settings)
        a, p0 = reference.hertz_line(2 * history["contact/face/force on slave y"][-1], 0.5, 0.5 * reference.plane_modulus(2e8, 0.3))
        _, now, pressure = self.last_step("cylinders")
        touching = np.flatnonzero(pressure)
        touching = touching[np.argsort(now[touching, 0])]
        self.assertLess(history["contact/face/weighted gap"][-1], 1.3e-9)
        return now[touching, 0] / a, pressure[touching] / p0

    def test_two_cylinders(self):
        # quadratic elements with their own sides, linear elements with smoothed ones
        for what, settings, largest, rest in (("quadratic", ("contacts/face/master surface=sides",), 0.03, 0.1),
                                              ("linear, hermite", ("mesh/order=1",), 0.1, 0.1)):
            x, pressure = self.cylinders(*settings)
            exact = reference.hertz_pressure(x, 1.0, 1.0)
            inside = (x < 0.8) & (x > 0)
            self.compare_values(what + ": largest pressure", pressure[0], 1.0, largest)
            self.compare_values(what + ": inside", pressure[inside], exact[inside], rest, 1.0)

    def ripple(self, surface):
        history = self.run_deck(self.deck("rotating_die"), (f"contacts/face/master surface={surface}",))
        turning = history.time > 1.0 + 1e-9
        self.assertGreater(turning.sum(), 70)
        force, drag = (history["contact/face/force on slave " + axis][turning] for axis in "yx")
        if os.environ.get("MUDLINE_SHOW_ERRORS"):
            print(f"{surface}: normal force swings by {np.ptp(force) / abs(force.mean()):.2e}, drag by {np.ptp(drag) / abs(force.mean()):.2e}; "
                  f"Newton iterations {history['step/newton iterations'].max():.0f}")
        return np.ptp(force) / abs(force.mean()), np.ptp(drag) / abs(force.mean())

    @problem("behaviour")
    def test_smoothed_master_ripples_ten_times_less(self):
        facets = self.ripple("linear")
        for surface in ("hermite", "bezier"):
            for smooth, rough in zip(self.ripple(surface), facets):
                self.assertLess(10 * smooth, rough)

    @problem("consistency")
    def test_friction_restart_and_ranks(self):
        self.check_sliding_blocks(self.overlay)

    @problem("consistency")
    def test_friction_on_a_moving_mesh(self):
        """The inside of both blocks swings, or their outer sides slide, transfer after transfer: stick, slip and the path slid are those of the
        material mesh. Nodes of the surfaces stay where they are here; convection_test.cpp tests the transfer of history when they slide."""
        slide = self.write("slide.xml", SLIDE)
        motion, focus = self.write("motion.xml", MOTION), self.write("focus.xml", FOCUS)
        for kind, overlays in (("mortar", []), ("node to segment", [self.overlay])):
            decks = [self.deck("blocks")] + overlays + [slide]
            # the same steps on all meshes: a retry that one of them needs lets the steps grow otherwise
            settings = ("solver/newton/damped retry=false",) + (("contacts/face/master surface=sides",) if overlays else ())
            still, moved, slid = (self.run_deck(d, settings) for d in (decks, decks + [motion], decks + [focus]))
            self.compare_values("path of what nothing touches", slid["body/point/displacement x"], slid.time, 1e-12)
            for name, history in (("swings", moved), ("slides", slid)):
                self.assertGreater(np.ptp(history["mesh/quality"]), 0.05)  # it does move
                for time in (1.25, 1.5, 1.75, 2.0):
                    drag = -still.at("contact/face/force on slave x", time)
                    self.compare_values(f"{kind}, {name}: drag at {time}",
                                        -history.at("contact/face/force on slave x", time), drag, 3e-3, 30)
                self.compare_values(f"{kind}, {name}: load", history["contact/face/force on slave y"], 100, 1e-8)
                self.compare_values(f"{kind}, {name}: heat", history["contact/face/friction heat"][-1],
                                    still["contact/face/friction heat"][-1], 0.01)

    @problem("behaviour")
    def test_errors(self):
        def message(*settings):
            done = program(["check", self.deck("blocks"), self.overlay] + [x for s in settings for x in ("--set", s)], 1, self.folder)
            self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
            return done.stderr

        self.assertIn("contacts/face/two-pass: unknown parameter", message("contacts/face/two-pass=true"))
        self.assertIn("contacts/face/master surface", message("contacts/face/master surface=spline"))
        self.assertIn("only with a smooth 'master surface'; allowed with it: hermite, bezier",
                      message("contacts/face/master surface=linear", "contacts/face/corner angle [deg]=30"))
        self.assertIn("only with 'enforcement' = augmented Lagrangian", message("contacts/face/enforcement=penalty"))
        self.assertIn("only with 'enforcement' = penalty", message("contacts/face/impact=conserving"))
        self.assertIn("contacts/face/slave: unknown side set 'uper bottom' (did you mean 'upper bottom'?)", message("contacts/face/slave=uper bottom"))


if __name__ == "__main__":
    unittest.main()
