"""Terzaghi's column along x, y and z, in hexahedra and tetrahedra, against the series; loads scaled by 1e-3 for small strains."""
import re
import unittest

import numpy as np
from scipy.interpolate import CubicSpline

from references import biot
from space_case import SpaceCase

TIMES = np.array([0.05, 0.1, 0.2, 0.5])
ENDS = {"x": ("left", "right"), "y": ("front", "back"), "z": ("bottom", "top")}
STAGE = "stages/consolidation/"


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


class Terzaghi(SpaceCase):
    def test_along_each_axis(self):
        column = biot.Column(biot.INCOMPRESSIBLE, load=10.0)
        with open(self.input("terzaghi")) as file:
            text = file.read()
        for axis, cell in (("z", "hex27"), ("y", "tet10"), ("x", "hex27")):
            with self.subTest(axis=axis, cell=cell):
                history = self.run_text("terzaghi", along(axis, text), ("mesh/cell=" + cell, f"{STAGE}duration={column.time(0.5)}"))
                t = column.time(TIMES)
                p, w = (CubicSpline(history.time, history[name])(t) for name in ("probe/base/pore pressure", f"probe/top/displacement {axis}"))
                self.assert_near(f"{axis} {cell}: p base", p, np.array([column.pressure(1.0, T) for T in TIMES]), 1e-3, 10.0)
                self.assert_near("settlement", -w, np.array([column.settlement(T) for T in TIMES]), 1e-3)
                for other in set("xyz") - {axis}:
                    self.assertLess(np.abs(history[f"probe/top/displacement {other}"]).max(), 1e-14)
                self.assertLess(np.abs(history["balance/water/error"]).max(), 1e-12)
                force = history[f"reaction/base {axis}"][-1]
                self.assert_near("reaction of the base", force, 10.0 * 0.01, 1e-6)


if __name__ == "__main__":
    unittest.main()
