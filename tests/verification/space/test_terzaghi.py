"""Terzaghi's column along x, y and z and along a slanting axis, in hexahedra and tetrahedra, against the series; loads scaled for
small strains."""
import re
import unittest

import numpy as np
from scipy.interpolate import CubicSpline

from compared_case import problem
from references import biot
from space_case import BoxMesh, SpaceCase, deck, quasi_static, rotation

TIMES = np.array([0.05, 0.1, 0.2, 0.5])
ENDS = {"x": ("left", "right"), "y": ("front", "back"), "z": ("bottom", "top")}
STAGE = "stages/consolidation/"
LONGEST = 2.5  # [s] a step, 3e-3 of the layer's time; its error is a tenth of what is allowed


def along(axis, text):
    """The deck, whose column stands along z, with the column along another axis: the axes change places in a circle."""
    turn = {"x": 2, "y": 1, "z": 0}[axis]  # x -> y -> z -> x, so often
    old = "xyz"
    new = {c: old[(old.index(c) - turn) % 3] for c in old}
    sides = {side: ENDS[new[c]][i] for c in old for i, side in enumerate(ENDS[c])}

    def tuple_of(match):
        values = [v.strip() for v in match.group(1).split(",")]
        moved = [None] * 3
        for c, value in zip(old, values):
            moved[old.index(new[c])] = value
        return "{" + ", ".join(moved) + "}"

    text = re.sub(r"\{([^{},]*,[^{},]*,[^{},]*)\}", tuple_of, text)
    text = re.sub(r'(name="set" type="string" value=")(\w+)"', lambda m: m.group(1) + sides[m.group(2)] + '"', text)
    text = re.sub(r'(name="components" type="string" value=")(\w)"', lambda m: m.group(1) + new[m.group(2)] + '"', text)
    return text.replace('<Parameter name="z" type="double" value="-10.0"/>', f'<Parameter name="{new["z"]}" type="double" value="-10.0"/>')


def graded(cells):
    """Moves even cells along z so that the last is a fifth of the first."""
    steps = 0.2 ** (np.arange(cells) / (cells - 1))
    ends = np.concatenate([[0], np.cumsum(steps)]) / steps.sum()
    return lambda x: np.column_stack([x[:, 0], x[:, 1], np.interp(x[:, 2], np.linspace(0, 1, cells + 1), ends)])


@problem("exact", "Terzaghi (1943)", "Terzaghi's column in space")
class Terzaghi(SpaceCase):
    def test_along_each_axis(self):
        column = biot.Column(biot.INCOMPRESSIBLE, load=10.0)
        with open(self.input("terzaghi")) as file:
            text = file.read()
        for axis, cell in (("z", "hex27"), ("y", "tet10"), ("x", "hex27")):
            with self.subTest(axis=axis, cell=cell):
                history = self.run_text("terzaghi", along(axis, text), (
                    "mesh/cell=" + cell, f"{STAGE}duration={column.time(0.5)}",
                    f"{STAGE}time step/maximum={LONGEST}"))
                t = column.time(TIMES)
                p, w = (CubicSpline(history.time, history[name])(t) for name in ("probe/base/pore pressure", f"probe/top/displacement {axis}"))
                self.compare_values(f"{axis} {cell}: p base", p, np.array([column.pressure(1.0, T) for T in TIMES]),
                                    1e-3, 10.0)
                self.compare_values("settlement", -w, np.array([column.settlement(T) for T in TIMES]), 1e-3)
                for other in set("xyz") - {axis}:
                    self.compare(f"displacement {other} [m]",
                                 np.abs(history[f"probe/top/displacement {other}"]).max(), 1e-14)
                self.assertLess(np.abs(history["balance/water/error"]).max(), 1e-12)
                force = history[f"reaction/base {axis}"][-1]
                self.compare_values("reaction of the base", force, 10.0 * 0.01, 1e-6)

    def test_along_a_slanting_axis(self):
        """Rollers on slanting sides are pressures that grow with the displacement outwards, so stiff that they are displaced by some 1e-4 of the settlement; the residual has
        the rounding of places times that stiffness."""
        load, turn = 1000.0, rotation()
        column = biot.Column(biot.INCOMPRESSIBLE, load=load)
        conditions = {
            "base": {"type": "fixed", "set": "bottom"}, "drained": {"type": "pore pressure", "set": "top"},
            "load": {"type": "traction", "set": "top", **{c: float(-load * turn[i, 2]) for i, c in enumerate("xyz")}}}
        stage = quasi_static(column.time(0.5), 0.01, 0.5, 8, growth=1.15, maximum=4.0)
        for cell, cells, width in (("hex27", 40, 0.2), ("tet10", 60, 0.1)):
            with self.subTest(cell=cell):
                for side, axis, way, place in (("left", 0, -1, 0), ("right", 0, 1, width), ("front", 1, -1, 0), ("back", 1, 1, width)):
                    outwards = " + ".join(f"({way * turn[i, axis]!r})*{c}" for i, c in enumerate("xyz"))
                    conditions["roller " + side] = {"type": "pressure", "set": side, "position": "present",
                                                    "value": f"{4e11 / width!r}*({outwards} - ({way * place!r}))"}
                mesh = BoxMesh(cell, (1, 1, cells), (width, width, 1.0), graded(cells)).turned(turn).write(f"{self.folder}/column.msh")
                output = {"probes": {"top": turn[:, 2].tolist(), "base": [0.0, 0.0, 0.0]}}
                history = self.run_text("slanting", deck("slanting", mesh, conditions, {"consolidation": stage}, "biot", output=output,
                                                         solver={"residual tolerance": 1e-4}))
                t = column.time(TIMES)
                moved = np.array([history["probe/top/displacement " + c] for c in "xyz"])
                p, w = (CubicSpline(history.time, found)(t) for found in (history["probe/base/pore pressure"], turn[:, 2] @ moved))
                self.compare_values(f"{cell}: p base", p, np.array([column.pressure(1.0, T) for T in TIMES]), 1e-3,
                                    load)
                self.compare_values("settlement", -w, np.array([column.settlement(T) for T in TIMES]), 1e-3)
                self.compare_values("aside", turn[:, :2].T @ moved, 0.0, 1e-4, column.settlement(0.5))
                self.assertLess(np.abs(history["balance/water/error"]).max(), 1e-12)
                force = [history[f"reaction/base {c}"][-1] for c in "xyz"]
                self.compare_values("reaction of the base", force, load * width ** 2 * turn[:, 2], 1e-4,
                                    load * width ** 2)


if __name__ == "__main__":
    unittest.main()
