"""A rigid body with six degrees of freedom, away from the soil: tops, a fall through water, loads at points, motions that are
prescribed of some directions, restart."""
import math
import os
import re
import unittest

import numpy as np
from compared_case import problem
from mudline_case import History, MudlineCase, program
from references import rigid_body as reference

DECK = os.path.join(os.path.dirname(os.path.abspath(__file__)), "body_in_space.xml")
MASS, INERTIA, G = 6.0, np.array([1.0, 2.0, 3.0]), 9.81  # of the deck
EXACT = ("solver/residual tolerance=1e-13", "solver/update tolerance=1e-12")
QUANTITIES = ("place", "rotation", "velocity", "spin")


def numbers(values):
    return "{" + ",".join(repr(float(v)) for v in values) + "}"


def motion(**entries):
    """Settings of the block's motion, their names with _ for blanks."""
    return tuple(f"bodies/block/motion/{name.replace('__', '/').replace('_', ' ')}={value}" for name, value in entries.items())


def steps(dt, duration):
    return (f"stages/turn/time step/initial={dt!r}", f"stages/turn/time step/maximum={dt!r}", f"stages/turn/duration={duration!r}")


class BodyInSpace(MudlineCase):
    def turn(self, settings, dt, duration):
        return self.run_deck(DECK, tuple(settings) + steps(dt, duration))

    def vectors(self, history, what):
        return np.stack([history[f"body/block/{what} {axis}"] for axis in "xyz"], axis=1)

    def turns(self, history):
        return reference.turns_of(self.vectors(history, "rotation"))

    def errors(self, history, exact):
        """Largest errors of the place [m], the rotation matrix, the velocity [m/s], the spin [rad/s] (in space)."""
        place, turn, velocity, spin = exact
        found = self.turns(history)
        return np.array([np.abs(self.vectors(history, "position") - place).max(), np.abs(found - turn).max(),
                         np.abs(self.vectors(history, "velocity") - velocity).max(),
                         np.abs(self.vectors(history, "spin") - np.einsum("tij,tj->ti", turn, spin)).max()])

    def converging(self, settings, sizes, duration, exact, least, quantities=range(4)):
        """exact(times) as reference.move gives it. Errors by size and quantity; orders of `quantities`, at least
        `least`."""
        errors = np.array([self.errors(history, exact(history.time))
                           for history in (self.turn(settings, dt, duration) for dt in sizes)])
        for quantity in quantities:
            self.compare_orders(f"order of the {QUANTITIES[quantity]}", errors[:, quantity], least)
        return errors


@problem("benchmark", "Euler's equations, integrated in references/rigid_body.py", "Tops")
class Tops(BodyInSpace):
    @problem("exact", "energy and angular momentum are kept")
    def test_torque_free(self):
        """100 turns about the axis of the intermediate moment of inertia, 30 about those of the smallest and the
        largest, with the default tolerances: energy and angular momentum stay, and about the intermediate axis the body
        tumbles (Dzhanibekov)."""
        for axis, turns in enumerate((30, 100, 30)):
            spin = np.full(3, 0.01)
            spin[axis] = 1.0
            history = self.turn(motion(initial_spin=numbers(spin)), 0.5, turns * 2 * math.pi)
            momentum = self.vectors(history, "angular momentum")
            self.compare("angular momentum", np.abs(momentum - INERTIA * spin).max() / np.linalg.norm(INERTIA * spin),
                         1e-6)
            energy = 0.5 * (INERTIA * spin**2).sum()
            self.compare("kinetic energy", np.abs(history["body/block/kinetic energy"] - energy).max() / energy, 1e-6)
            own = np.einsum("tji,tj->ti", self.turns(history), self.vectors(history, "spin"))[:, axis]
            self.compare("way of the centre", np.abs(self.vectors(history, "displacement")).max(), 1e-12)
            flips = np.count_nonzero(np.diff(np.sign(own)))
            if axis == 1:
                self.assertGreater(flips, 30)
            else:
                self.assertEqual(flips, 0)
                self.assertGreater(own.min(), 0.99)

    def test_against_eulers_equations(self):
        """Second order in the step, of a body with products of inertia, at both ends of the integrator's range."""
        tensor = np.array([[2.0, 0.3, -0.2], [0.3, 1.5, 0.4], [-0.2, 0.4, 1.0]])
        spin = np.array([0.3, -0.8, 0.5])
        settings = EXACT + motion(initial_spin=numbers(spin), moment_x="0.2*cos(t)", moment_z="-0.1*t") + (
            f"bodies/block/inertia tensor={numbers([2, 1.5, 1, 0.4, -0.2, 0.3])}",)
        exact = lambda times: reference.move(
            times, MASS, tensor, lambda t, x, turn, v, w: (np.zeros(3), turn.T @ [0.2 * math.cos(t), 0, -0.1 * t]),
            position=(0, 0, 20), spin=spin)
        for radius in (1.0, 0.5):
            spectral = (f"stages/turn/integrator/spectral radius={radius}",)
            errors = self.converging(settings + spectral, (0.05, 0.025), 6.0, exact, 1.9, (1, 3))
            self.compare("rotation", errors[-1, 1], 2e-3)

    @problem("exact", "steady precession of a heavy top")
    def test_heavy_top(self):
        """Held by a stiff spring at its tip, the top goes round steadily as that on a fixed point does."""
        height, tilt, fast, stiffness = 1.0, 0.3, 20.0, 1e6
        # a body starts with its axes along the model's: gravity is tilted
        inertia = np.array([2.0, 2.0, 4.0])
        about_tip = inertia[0] + MASS * height**2
        gravity = G * np.array([-math.sin(tilt), 0, -math.cos(tilt)])
        # steady: I cos(tilt) W^2 - J s W + m g h = 0, with s the spin along the axis
        a, b, c = about_tip * math.cos(tilt), -inertia[2] * fast, MASS * G * height
        around = (-b - math.sqrt(b * b - 4 * a * c)) / (2 * a)
        up = -gravity / G
        spin = around * up  # of the axis; along the axis itself in all: fast
        spin[2] = fast
        velocity = np.cross(spin, [0, 0, height])
        held = {f"loads__tip__force_{axis}": f"-{stiffness}*({axis}-{start})" for axis, start in zip("xyz", (0, 0, 20))}
        settings = EXACT + motion(gravity=numbers(gravity), initial_spin=numbers(spin), initial_velocity=numbers(velocity),
                                  loads__tip__point="{0,0,0}", **held) + (
            f"bodies/block/inertia tensor={numbers(inertia)}", f"bodies/block/centre of mass={numbers([0, 0, height])}",
            "stages/turn/integrator/spectral radius=0.5")
        history = self.turn(settings, 0.002, 2.0)
        axis = self.turns(history)[:, :, 2]
        self.compare("tilt", np.abs(axis @ up - math.cos(tilt)).max(), 1e-3)
        side = np.cross([0, 1, 0], up)  # in the plane across the vertical
        flat = axis - np.outer(axis @ up, up)
        angle = np.unwrap(np.arctan2(flat @ [0, 1, 0], flat @ side))
        rate = (angle[-1] - angle[0]) / history.time[-1]
        self.compare_values("precession [rad/s]", rate, around, 2e-3)
        self.assertLess(np.abs(self.vectors(history, "displacement")).max(), 3 * MASS * G / stiffness + 1e-3)


@problem("benchmark", "Kirchhoff's equations, integrated in references/rigid_body.py", "Body in water")
class Water(BodyInSpace):
    """Drag, added mass and buoyancy along the axes of a body that tumbles, and forces at its points."""
    DENSITY, VOLUME = 1000.0, 4e-3
    DRAG, AREAS, SPIN_DRAG = np.array([1.2, 0.8, 0.2]), np.array([0.02, 0.03, 0.01]), np.array([0.3, 0.2, 0.1])
    ADDED, ADDED_INERTIA = np.array([1.0, 0.6, 0.1]), np.array([0.2, 0.5, 0.0])
    CENTRE = np.array([0.0, 0.05, -0.2])  # of mass, below that of the volume
    EYE = np.array([0.1, 0.0, 0.7])

    def settings(self, **more):
        return EXACT + (f"bodies/block/volume={self.VOLUME}", f"bodies/block/centre of mass={numbers(self.CENTRE)}") + motion(
            gravity=numbers([0, 0, -G]), water__density=self.DENSITY, **more)

    def loads(self, drag=True, line=None):
        def act(t, x, turn, v, w):
            arm = -self.CENTRE  # of the centre of the volume
            buoyancy = turn.T @ [0, 0, G * self.DENSITY * self.VOLUME]
            force, moment = turn.T @ [0, 0, -MASS * G] + buoyancy, np.cross(arm, buoyancy)
            if drag:
                past = v + np.cross(w, arm)
                braking = -0.5 * self.DENSITY * self.DRAG * self.AREAS * np.linalg.norm(past) * past
                force, moment = force + braking, moment + np.cross(arm, braking) - self.SPIN_DRAG * np.abs(w) * w
            if line:
                pull = line(t, turn)
                force, moment = force + pull, moment + np.cross(self.EYE - self.CENTRE, pull)
            return force, moment
        return act

    def exact(self, times, line=None, drag=True, wet=True, velocity=(0, 0, 0), spin=(0, 0, 0)):
        added = self.DENSITY * self.VOLUME * self.ADDED if wet else np.zeros(3)
        centre, turn, v, w = reference.move(times, MASS, INERTIA, self.loads(drag, line), added, self.ADDED_INERTIA if wet else np.zeros(3),
                                            np.array([0, 0, 20]) + self.CENTRE, velocity, spin)
        # of the reference point
        arm = np.einsum("tij,j->ti", turn, -self.CENTRE)
        return centre + arm, turn, v + np.cross(np.einsum("tij,tj->ti", turn, w), arm), w

    def wet(self, **more):
        return self.settings(water__drag_coefficients=numbers(self.DRAG), water__drag_areas=numbers(self.AREAS),
                             water__drag_moments=numbers(self.SPIN_DRAG), water__added_mass_coefficients=numbers(self.ADDED),
                             water__added_moments_of_inertia=numbers(self.ADDED_INERTIA), **more)

    def test_tumbling_fall(self):
        velocity, spin = np.array([0.6, -0.3, -1.0]), np.array([0.5, 0.2, 0.3])
        settings = self.wet(initial_velocity=numbers(velocity), initial_spin=numbers(spin))
        for radius in (1.0, 0.5):
            spectral = (f"stages/turn/integrator/spectral radius={radius}",)
            errors = self.converging(settings + spectral, (0.04, 0.02), 4.0,
                                     lambda times: self.exact(times, velocity=velocity, spin=spin), 1.85)
            self.compare("largest error of the path", errors[-1].max(), 5e-3)

    def test_pull_at_an_eye(self):
        """Once along an axis of the model, once along one of the body, which turns: the body tilts as the ODE says."""
        for turns in (False, True):
            line = lambda t, turn: np.array([1, 0.5, 3.0]) * 10 * t if turns else turn.T @ [10 * t, 5 * t, 30 * t]
            settings = self.wet(initial_spin="{0,0,0}", loads__eye__point=numbers(self.EYE), loads__eye__force_x="10*t", loads__eye__force_y="5*t",
                                loads__eye__force_z="30*t", **{"loads__eye__turns_with_the_body": str(turns).lower()})
            errors = self.converging(settings, (0.02, 0.01), 2.0, lambda times: self.exact(times, line), 1.85)
            self.compare("largest error of the path", errors[-1].max(), 5e-3)

    @problem("exact", "compound pendulum")
    def test_energy_of_a_dry_pendulum(self):
        """Buoyancy far above the mass rights the body: it swings with the frequency of a compound pendulum, without loss."""
        settings = self.settings(freedom="{rotation x}", initial_spin="{0.001,0,0}")
        settings += ("bodies/block/centre of mass={0,0,-0.2}",)
        righting = G * self.DENSITY * self.VOLUME * 0.2
        frequency = math.sqrt(righting / INERTIA[0])
        history = self.turn(settings, 0.01, 6 * math.pi / frequency)
        expected = 0.001 / frequency * np.sin(frequency * history.time)
        self.compare("angle", np.abs(history["body/block/rotation x"] - expected).max() / expected.max(), 2e-3)
        lost = history["balance/energy/numerical dissipation"][-1]
        self.compare("energy lost", abs(lost), 1e-9 * 0.5 * INERTIA[0] * 0.001**2 + 1e-15)


@problem("exact", "the prescribed motion", "Prescribed motion of a body in space")
class Prescribed(BodyInSpace):
    def given(self, **entries):
        return tuple(f"stages/turn/motions/block/{name.replace('_', ' ')}={value}" for name, value in entries.items())

    def never_free(self):
        """The deck with a body that no stage sets free: it has no unknowns."""
        with open(DECK) as file:
            text, count = re.subn(r'<ParameterList name="motion">.*?</ParameterList>',
                                  '<ParameterList name="motion"><Parameter name="type" type="string" value="held"/></ParameterList>',
                                  file.read(), flags=re.DOTALL)
        self.assertEqual(count, 1)
        return self.write("never_free.xml", text)

    def test_each_of_the_six(self):
        """One direction as prescribed, the others rest: exactly, by both motions, of a body with and without unknowns."""
        for deck in (DECK, self.never_free()):
            for k in range(6):
                axis, turns = "xyz"[k % 3], k > 2
                for given in (self.given(type="prescribed velocity", **{f"spin_{axis}" if turns else f"velocity_{axis}": "0.6*t"}),
                              self.given(type="prescribed displacement", **{f"rotation_{axis}" if turns else axis: "0.3*t^2"})):
                    with self.subTest(deck=os.path.basename(deck), given=given):
                        history = self.run_deck(deck, given + steps(0.25, 1.0))
                        for what, moves in (("displacement", not turns), ("rotation", turns)):
                            expected = np.zeros((len(history.time), 3))
                            if moves:
                                expected[:, k % 3] = 0.3 * history.time**2
                            self.compare(what, np.abs(self.vectors(history, what) - expected).max(), 1e-12)

    def test_of_a_released_body(self):
        """Free in two directions, moved in the other four: the free ones depend on it by the turning inertia only."""
        free = EXACT + motion(freedom="{z,rotation z}", initial_spin="{0,0,0.4}", force_z=12.0, prescribed_velocity__velocity_x=0.5,
                              prescribed_velocity__velocity_y="-0.2*t")
        history = self.turn(free, 0.1, 2.0)
        t = history.time
        expected = np.stack([0.5 * t, -0.1 * t**2, 0.5 * 12 / MASS * t**2], axis=1)
        self.compare("displacement", np.abs(self.vectors(history, "displacement") - expected).max(), 1e-9)
        per_step = 2 * math.atan(0.5 * 0.4 * 0.1)  # Cayley's rotation of the spin over a step
        self.compare("rotation",
                     np.abs(self.vectors(history, "rotation") - np.outer(t, [0, 0, per_step / 0.1])).max(), 1e-9)

    @problem("benchmark", "Euler's equations, integrated in references/rigid_body.py")
    def test_spun_up_and_let_go(self):
        """A stage turns the body about a skew axis, the next lets it go: it keeps that spin, and tumbles as a free body does."""
        with open(DECK) as file:
            text = file.read()
        stage = text[text.index('<ParameterList name="turn">'):].rsplit("</ParameterList>", 2)[0]  # the last of the deck
        text = text.replace(stage, stage.replace('"turn"', '"spin up"') + stage)
        spin = np.array([0.3, -0.5, 0.4])
        given = tuple(f"stages/spin up/motions/block/{name}" for name in (
            "type=prescribed velocity", "spin x=0.3*t", "spin y=-0.5*t", "spin z=0.4*t"))
        text = re.sub(r'\s*<Parameter name="initial spin".*', "", text)
        dt = 0.01
        history = self.run_deck(self.write("two_stages.xml", text), EXACT + given + steps(dt, 2.0) + (
            f"stages/spin up/time step/initial={dt}", f"stages/spin up/time step/maximum={dt}"))
        free = history.time >= 1 - 1e-9
        turned = reference.turns_of(0.5 * spin)
        _, turn, _, own = reference.move(history.time[free] - 1, MASS, turned @ np.diag(INERTIA) @ turned.T, spin=spin)
        found = self.turns(history)[free]
        self.compare("rotation", np.abs(found - turn @ turned).max(), 1e-4)
        self.compare("spin", np.abs(self.vectors(history, "spin")[free] - np.einsum("tij,tj->ti", turn, own)).max(),
                     1e-4)


@problem("behaviour", title="Restart of a body in space")
class Restart(BodyInSpace):
    def test_bit_for_bit(self):
        settings = motion(initial_velocity="{0.1,0,0}", loads__eye__point="{0,0.3,1}", loads__eye__force_x="cos(t)",
                          loads__eye__turns_with_the_body="true", water__density=500.0, water__drag_coefficients="{1,2,3}")
        whole = self.turn(settings, 0.05, 3.0)
        arguments = [word for setting in settings + steps(0.05, 3.0) for word in ("--set", setting)]
        for extra in (["--steps", "23", "--overwrite"], ["--restart"]):
            done = program(["run", "-q", DECK, *arguments, *extra], folder=self.folder)
            self.assertIn(done.returncode, (0, 4), done.stderr)
        again = History(os.path.join(self.folder, "results", "body_in_space.csv"))
        self.assertEqual(again.data.shape, whole.data.shape)
        self.assertEqual(np.abs(again.data - whole.data).max(), 0)


if __name__ == "__main__":
    unittest.main()
