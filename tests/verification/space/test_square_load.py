"""Consolidation of a layer under a square load (Booker 1974): settlement and pore pressure in time against Fourier series in plan and the
closed form in depth; and these against Giroud's corner of a rectangle on a half space."""
import unittest

import numpy as np
from scipy.interpolate import CubicSpline

from compared_case import problem
from references import biot
from references.layer import Layer, giroud_corner
from space_case import BoxMesh, SpaceCase, deck, quasi_static

SOIL = biot.INCOMPRESSIBLE
WIDTH, LOAD = 4.0, 10.0  # [m] of the quarter, and its depth; [Pa]: scaled by 1e-3 for small strains
INSIDE, BESIDE, DOWN = 4, 3, 10  # cells along the half width of the load, beside it, through the depth
FACTORS = np.array([0.05, 0.1, 0.3, 1.0, 3.0, 12.0])  # c t/a^2
MODES = 80


def refined(x):
    """Even cells under the load, cells beside it and downwards that grow as they go."""
    even = np.linspace(0, WIDTH, INSIDE + BESIDE + 1)
    growth = 1.8 ** np.arange(BESIDE)
    places = np.concatenate([np.linspace(0, 1, INSIDE + 1), 1 + (WIDTH - 1) * np.cumsum(growth) / growth.sum()])
    deep = 1.25 ** np.arange(DOWN)
    depths = np.concatenate([[0], WIDTH * np.cumsum(deep) / deep.sum()])
    return np.column_stack([np.interp(x[:, 0], even, places), np.interp(x[:, 1], even, places),
                            -np.interp(WIDTH - x[:, 2], np.linspace(0, WIDTH, DOWN + 1), depths)])


def quarter(mesh):
    conditions = {side: {"type": "fixed", "set": side, "components": c} for side, c in zip(("left", "right", "front", "back"), "xxyy")}
    conditions.update({"base": {"type": "fixed", "set": "bottom"}, "drained": {"type": "pore pressure", "set": "top"},
                       "load": {"type": "traction", "set": "top", "z": f"1 > x &amp;&amp; 1 > y ? -{LOAD} : 0"}})
    probes = {"centre": [0.0, 0.0, 0.0], "corner": [1.0, 1.0, 0.0], "below centre": [0.0, 0.0, -1.0], "below corner": [1.0, 1.0, -1.0]}
    stage = quasi_static(FACTORS[-1] / SOIL.diffusivity, 2.0, 0.5, 4, growth=1.4, maximum=2500.0)
    return deck("quarter", mesh, conditions, {"loading": stage}, "biot", output={"probes": probes},
                solver={"linear solver": {"type": "direct"}})


@problem("exact", "Booker (1974)", "Consolidation under a square load")
class SquareLoad(SpaceCase):
    @problem("exact", "Giroud (1968)")
    def test_reference(self):
        """Half spaces from layers of 8 and 16 half widths, whose walls and base count as their reciprocal; drained and undrained."""
        for what, time, young, poisson in (("drained", 1e9, SOIL.young, SOIL.poisson), ("undrained", 1e-3, 3 * SOIL.shear, 0.5)):
            near, far = (Layer(SOIL, width, width, 1.0, LOAD, 15 * width).at(time, [0.0])[0][0] for width in (8, 16))
            self.compare_values(what, 2 * far - near, 4 * giroud_corner(1.0, 1.0, LOAD, young, poisson), 5e-3)

    def test_settlement_and_pressure(self):
        mesh = BoxMesh("hex27", (INSIDE + BESIDE, INSIDE + BESIDE, DOWN), (WIDTH,) * 3, refined).write(f"{self.folder}/quarter.msh")
        history = self.run_text("quarter", quarter(mesh))
        times = FACTORS / SOIL.diffusivity
        layer = Layer(SOIL, WIDTH, WIDTH, 1.0, LOAD, MODES)
        height = -self.corner_near(-1.0)
        exact = [layer.at(t, [0.0, 1.0], height) for t in times]
        final = layer.at(1e9, [0.0])[0][0]
        for i, place in enumerate(("centre", "corner")):
            w = -CubicSpline(history.time, history[f"probe/{place}/displacement z"])(times)
            self.compare_values(f"{place}: settlement", w, [settlement[i] for settlement, _ in exact], 1e-2, final)
            p = CubicSpline(history.time, history[f"probe/below {place}/pore pressure"])(times)
            self.compare_values(f"{place}: pressure", p, [pressure[i] for _, pressure in exact], 1e-2, LOAD)
        self.assertLess(np.abs(history["balance/water/error"]).max(), 1e-12)

    def corner_near(self, z):
        """Height of the cell corner nearest to a height: a probe there shows that corner's pore pressure."""
        found = self.fields("quarter")
        heights = found.nodes[found.vertices, 2]
        return heights[np.abs(heights - z).argmin()]


if __name__ == "__main__":
    unittest.main()
