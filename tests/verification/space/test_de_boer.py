"""The column of de Boer, Ehlers and Liu (1993) in space: sand with incompressible constituents under a harmonic load, with inertia."""
import re
import unittest

import numpy as np
from scipy.interpolate import CubicSpline

from dynamics.dynamics_case import DE_BOER, corner
from compared_case import problem
from mudline_case import ROOT
from references import porous_column as reference
from space_case import SpaceCase

TIMES = np.array([0.05, 0.1, 0.2])
CELLS, RATIO = 60, 0.2  # of the last to the first cell, upwards


@problem("exact", "de Boer, Ehlers and Liu (1993), modal sums", "De Boer's column in space")
class DeBoer(SpaceCase):
    def column(self, cell):
        """The plane deck with a third direction: upwards is z, and the column is as deep as it is wide."""
        with open(f"{ROOT}/inputs/dynamic_column/de_boer.xml") as file:
            text = file.read()
        text = text.replace('value="plane strain"', 'value="three-dimensional"').replace('value="quad9"', f'value="{cell}"')
        text = text.replace("{1, 100}", f"{{1, 1, {CELLS}}}").replace("{0.1, 10.0}", "{0.1, 0.1, 10.0}")
        text = text.replace('name="cells"', f'name="grading" type="Array(double)" value="{{1, 1, {RATIO}}}"/><Parameter name="cells"')
        text = text.replace('<Parameter name="y" type="string"', '<Parameter name="z" type="string"')
        text = re.sub(r'("(?:top|one metre|middle|base)" type="Array\(double\)" value=)"\{0.0, ([0-9.]+)\}"', r'\1"{0.0, 0.0, \2}"', text)
        sides = "".join(f'<ParameterList name="{name}"><Parameter name="type" type="string" value="fixed"/>'
                        f'<Parameter name="set" type="string" value="{name}"/><Parameter name="components" type="string" value="y"/></ParameterList>'
                        for name in ("front", "back"))
        return text.replace('<ParameterList name="drained surface">', sides + '<ParameterList name="drained surface">')

    def test_harmonic_load(self):
        near = corner(10.0, CELLS, RATIO, 1.0)
        u, p = DE_BOER.response([0, near, 10], TIMES, reference.one_minus_cosine(3.0, 75.0))
        for cell in ("hex27", "tet10"):
            with self.subTest(cell=cell):
                history = self.run_text("de_boer", self.column(cell), (
                    "stages/shaking/duration=0.21", "solver/linear solver/type=direct", f"output/probes/one metre={{0.0,0.0,{10 - near}}}"))
                at = lambda name: CubicSpline(history.time, history[name])(TIMES)
                self.compare_values(f"{cell}: u(0)", -at("probe/top/displacement z"), u[:, 0], 5e-3, u[:, 0].max())
                self.compare_values(f"{cell}: u(1)", -at("probe/one metre/displacement z"), u[:, 1], 5e-3,
                                    u[:, 1].max())
                self.compare_values(f"{cell}: p(1)", at("probe/one metre/pore pressure"), p[:, 1], 5e-3,
                                    p[:, 1].max())
                self.compare_values(f"{cell}: p(10)", at("probe/base/pore pressure"), p[:, 2], 5e-3, p[:, 2].max())
                for across in "xy":
                    self.compare(f"displacement {across}",
                                 np.abs(history[f"probe/middle/displacement {across}"]).max() / u.max(), 1e-6)


if __name__ == "__main__":
    unittest.main()
