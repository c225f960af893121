"""Two deformable surfaces in space: patch test, Coulomb's block, Hertz's two bodies, impact without energy won."""
import unittest

import numpy as np

from compared_case import problem
from space_case import BoxMesh, SpaceCase, deck, quasi_static, write_boxes

YOUNG, POISSON = 2e8, 0.3
STIFF = {"density": 1800.0, "skeleton": {"type": "linear elastic", "Young's modulus": YOUNG, "Poisson's ratio": POISSON}}


def moved(box, by):
    box.nodes = box.nodes + np.array(by)
    return box


def between(**more):
    return {"face": {"type": "point to face", "slave": "upper bottom", "master": "lower top", **more}}


class PairCase(SpaceCase):
    def run_pair(self, name, boxes, conditions, stages, contacts, ranks=1, **sections):
        """The blocks' cells are all of the same order; both are of the same soil."""
        order = 1 if boxes["upper"].cell in ("tet4", "hex8") else 2
        mesh = {"type": "gmsh", "file": write_boxes(f"{self.folder}/{name}.msh", boxes), "order": order}
        return self.run_text(name, deck(name, mesh, conditions, stages, material=STIFF, contacts=contacts, **sections), ranks=ranks)


@problem("exact", "the stress is uniform", "Two surfaces in space, patch test")
class Patch(PairCase):
    """One block pressed on another one, both free to widen: the stress is uniaxial."""

    def press(self, cell, lower, upper, name="patch"):
        conditions = {"base": {"type": "fixed", "set": "lower bottom", "components": "z"},
                      "push": {"type": "displacement", "set": "upper top", "z": "-2e-4*t"}}
        for box in ("lower", "upper"):
            for side, axis in (("left", "x"), ("front", "y")):
                conditions[f"{box} {side}"] = {"type": "fixed", "set": f"{box} {side}", "components": axis}
        boxes = {"lower": BoxMesh(cell, lower), "upper": moved(BoxMesh(cell, upper), (0, 0, 1))}
        history = self.run_pair(name, boxes, conditions, {"press": quasi_static(1, 1)}, between(), solver={"residual tolerance": 1e-12})
        stress = self.fields(name).cell["effective_stress"]  # xx xy xz yy yz zz
        return history, stress

    def test_matching(self):
        for cell in ("tet10", "hex27", "wedge15", "tet4", "hex8"):
            with self.subTest(cell=cell):
                history, stress = self.press(cell, (2, 2, 2), (2, 2, 2))
                upright = stress[:, 5]
                scale = np.abs(upright).max()
                self.assertGreater(scale, 1e4)
                self.compare("evenness of the stress", np.abs(upright - upright.mean()).max() / scale, 1e-9)
                self.compare("other stresses", np.abs(stress[:, :5]).max() / scale, 1e-9)
                self.compare_values(f"{cell}: force", history["contact/face/force on slave z"][-1], scale, 1e-3)

    def test_other_cells(self):
        """Points cannot see where the master's edges lie between them: the stress is even to 3 %, its mean exact."""
        for cell in ("tet10", "hex27"):
            with self.subTest(cell=cell):
                history, stress = self.press(cell, (2, 2, 2), (3, 3, 3), "other")
                upright = stress[:, 5]
                self.compare_values(f"{cell}: evenness", upright, upright.mean(), 0.03)
                self.compare_values(f"{cell}: force", history["contact/face/force on slave z"][-1], -upright.mean(),
                                    2e-3)


@problem("consistency", title="Two surfaces in space, multipliers")
class Multipliers(PairCase):
    """A block pressed on another one and pulled aslant so little that it sticks, with multipliers: the gap closes and nothing slips, soft as
    the penalty may be, on any number of ranks."""
    FORCES = [f"contact/face/force on slave {axis}" for axis in "xyz"]

    def pull(self, cell, penalty_factor, ranks=1):
        boxes = {"lower": BoxMesh(cell, (2, 2, 2)), "upper": moved(BoxMesh(cell, (3, 3, 2), (0.6, 0.6, 0.5)), (0.2, 0.2, 1))}
        conditions = {"base": {"type": "fixed", "set": "lower bottom"},
                      "push": {"type": "displacement", "set": "upper top", "x": "1e-5*max(t-1,0)", "y": "2e-5*max(t-1,0)", "z": "-1e-4*min(t,1)"}}
        pair = between(enforcement="augmented Lagrangian", **{"penalty factor": penalty_factor}, friction={"type": "coulomb", "coefficient": 5.0})
        history = self.run_pair("pull", boxes, conditions, {"pull": quasi_static(2, 0.5, maximum=0.5)}, pair, ranks=ranks)
        self.assertLess(history["contact/face/weighted gap"].max(), 1e-6 * 0.2)
        self.assertEqual(history["contact/face/sliding points"].max(), 0)
        return history

    def test_stiffness_of_the_penalty(self):
        for cell in ("tet10", "hex27"):
            with self.subTest(cell=cell):
                soft, stiff = (self.pull(cell, factor) for factor in (2.0, 20.0))
                for name in self.FORCES:
                    self.compare_values(f"{cell}: {name}", soft[name][-1], stiff[name][-1], 5e-3)

    @problem("consistency")
    def test_ranks(self):
        serial = self.pull("tet10", 10.0)
        self.assert_same_run(serial, self.pull("tet10", 10.0, 4), self.FORCES, "4 ranks", rounding=1e-6)


@problem("exact", "Coulomb's friction", "Two surfaces in space, dragged block")
class Coulomb(PairCase):
    """A small block pressed on a larger one and dragged aslant over the edges of its cells."""

    def test_block_is_dragged(self):
        boxes = {"lower": BoxMesh("hex27", (4, 4, 2), (2.0, 2.0, 1.0)), "upper": moved(BoxMesh("tet10", (3, 3, 2), (0.6, 0.6, 0.4)), (0.3, 0.2, 1.0))}
        top = {"type": "displacement", "set": "upper top", "z": "-1e-5*min(t,1)"}
        conditions = {"base": {"type": "fixed", "set": "lower bottom"}, "push": {**top, "x": "0.3*max(t-1,0)", "y": "0.4*max(t-1,0)"}}
        history = self.run_pair("drag", boxes, conditions, {"drag": quasi_static(2, 0.1, maximum=0.1)},
                                between(friction={"type": "coulomb", "coefficient": 0.2}))
        x, y, z = (history[f"contact/face/force on slave {axis}"][-1] for axis in "xyz")
        self.assertGreater(z, 500)
        self.compare_values("friction over normal force", np.hypot(x, y) / z, 0.2, 1e-3)
        self.compare_values("its direction", np.array([x, y]) / np.hypot(x, y), np.array([-0.6, -0.8]), 1e-3, 1.0)
        self.compare_values("both reactions", history["reaction/base x"][-1], -history["reaction/push x"][-1], 1e-5)
        late = history.time > 1.3
        normal = history["contact/face/force on slave z"][late]
        self.compare_values("over the edges", normal, normal.mean(), 0.02)


@problem("exact", "Hertz, after Johnson (1985)", "Two bodies of Hertz in space")
class Hertz(PairCase):
    """A paraboloid of radius 1 m on a flat block of the same soil, so little that strains stay small. A quarter, with Boussinesq's
    displacements of the same load on the far faces of both."""
    APPROACH = 2e-6

    def test_equal_bodies(self):
        modulus = YOUNG / (1 - POISSON**2) / 2
        load = 4 / 3 * modulus * self.APPROACH**1.5
        a, shear = np.sqrt(self.APPROACH), YOUNG / (2 * (1 + POISSON))
        size, cells = 10 * a, 8

        def graded(x):
            growth = 20 ** (1 / (cells - 1))
            ends = np.concatenate([[0], np.cumsum(growth ** np.arange(cells))])
            return np.interp(x, np.linspace(0, 1, cells + 1), size * ends / ends[-1])

        def lower(x):
            return np.column_stack([graded(x[:, 0]), graded(x[:, 1]), -graded(1 - x[:, 2])])

        def upper(x):
            flat = np.column_stack([graded(x[:, 0]), graded(x[:, 1]), graded(x[:, 2])])
            return flat + np.outer((flat[:, 0]**2 + flat[:, 1]**2) / 2 * (1 - flat[:, 2] / size), [0, 0, 1])

        boxes = {"lower": BoxMesh("hex27", (cells,) * 3, move=lower), "upper": BoxMesh("hex27", (cells,) * 3, move=upper, curved=True)}
        factor, rho = f"({load / (4 * np.pi * shear)!r}*t^1.5)", "sqrt(x^2+y^2+z^2)"
        conditions = {}
        for box, sign, away in (("lower", -1, "bottom"), ("upper", 1, "top")):
            depth = f"({sign}*z)"
            outwards = f"{factor}/{rho}*({depth}/({rho})^2-{1 - 2 * POISSON!r}/({rho}+{depth}))"
            sinks = f"{factor}/{rho}*({2 * (1 - POISSON)!r}+(z/{rho})^2)"
            far = {"type": "displacement", "x": f"x*({outwards})", "y": f"y*({outwards})",
                   "z": f"-{sinks}" if sign < 0 else f"{sinks}-{self.APPROACH!r}*t"}
            conditions.update({f"{box} {side}": {**far, "set": f"{box} {side}"} for side in ("right", "back", away)})
            conditions.update({f"{box} {side}": {"type": "fixed", "set": f"{box} {side}", "components": axis}
                               for side, axis in (("left", "x"), ("front", "y"))})
        history = self.run_pair("hertz", boxes, conditions, {"press": quasi_static(1, 1)},
                                between(**{"penalty factor": 100.0}))
        self.compare_values("load", 4 * history["contact/face/force on slave z"][-1], load, 0.01)
        self.assertLess(history["contact/face/maximum penetration"][-1], 0.01 * self.APPROACH)
        fields = self.fields("hertz")
        pressure = fields.nodal["contact_pressure_face"]
        self.compare_values("largest pressure", pressure.max(), 1.5 * load / (np.pi * a**2), 0.03)


@problem("exact", "energy is kept", "Impact of two blocks in space")
class Impact(PairCase):
    """A block falls aslant on a plate: the penalty spring gives back what it took."""

    def test_no_energy_is_won(self):
        boxes = {"lower": BoxMesh("hex27", (4, 4, 2), (1.0, 1.0, 0.3)), "upper": moved(BoxMesh("tet10", (2, 2, 2), (0.4, 0.4, 0.3)), (0.3, 0.25, 0.3005))}
        stage = {"type": "dynamic", "duration": 8e-3, "integrator": {"type": "generalised alpha", "spectral radius": 1.0},
                 "time step": {"initial": 1e-4, "maximum": 1e-4}}
        history = self.run_pair("impact", boxes, {"base": {"type": "fixed", "set": "lower bottom"}}, {"fall": stage}, between(),
                                more_physics={"gravity": [20.0, 0.0, -100.0]}, solver={"residual tolerance": 1e-9})
        force = history["contact/face/force on slave z"]
        self.assertEqual(force[0], 0)
        self.assertGreater(force.max(), 1e3)
        self.assertEqual(force[-1], 0)  # it came off again
        kinetic = history["balance/energy/kinetic"]
        self.compare_values("error of the energy", history["balance/energy/error"], 0.0, 1e-3, kinetic.max())
        # 0.06 with what the integrator interpolates instead of the force that does the work of the spring
        kept = history["balance/energy/contact/face"][-1]
        self.compare_values("what the spring kept", kept, 0.0, 1e-3, kinetic.max())


if __name__ == "__main__":
    unittest.main()
