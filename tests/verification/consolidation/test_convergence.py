"""Observed orders in element size and time step, on solutions that are smooth in the region or the time looked at."""
import unittest

import numpy as np

from compared_case import problem
from consolidation_case import ConsolidationCase
from references import biot
from references.norms import l2_error

STAGE = "stages/consolidation/"


@problem("exact", "Lamé's cylinder; Terzaghi's series", "Orders in space and time")
class Convergence(ConsolidationCase):
    def errors(self, stem, exact_displacement, component, exact_pressure=None):
        with self.fields(stem) as file:
            nodes, topology = file["mesh/coordinates"][:, :2], file["mesh/topology"][:]
            nodal = file[f"steps/{sorted(file['steps'])[-1]}/nodal"]
            u, p = nodal["displacement"][:, component], nodal["pore_pressure"][:]
        return (l2_error(nodes, topology, u, exact_displacement),
                l2_error(nodes, topology, p, exact_pressure, linear=True) if exact_pressure else None)

    def displacement_at(self, stem, place):
        """Displacement [m] of the node that started there."""
        with self.fields(stem) as file:
            nodes = file["mesh/coordinates"][:, :2]
            step = file[f"steps/{sorted(file['steps'])[-1]}/nodal"]
            node = np.argmin(np.hypot(*(nodes - place).T))
            self.assertLess(np.abs(nodes[node] - place).max(), 1e-9)
            return step["displacement"][node]

    def test_drained_displacement(self):
        """Thick cylinder (Lame) under inner pressure: third order, also on distorted cells."""
        inner, outer, load, young, poisson = 0.5, 1.0, 1.0, 1e7, 0.25
        factor = load * inner ** 2 * (1 + poisson) / (young * (outer ** 2 - inner ** 2))

        def exact(r, _):
            return factor * ((1 - 2 * poisson) * r + outer ** 2 / r)

        # each distorted mesh has a scatter of its own, so that the order between two of them is a rough one
        for cell, distortion, least in (("quad9", 0.0, 2.9), ("tri6", 0.0, 2.9), ("quad9", 0.2, 2.6), ("tri6", 0.2, 2.6)):
            with self.subTest(cell=cell, distortion=distortion):
                found, walls = [], []
                for n in (2, 4, 8):
                    self.run_deck(self.deck("thick_cylinder"), (
                        f"mesh/cells={{{2 * n}, {n}}}", "mesh/cell=" + cell, f"mesh/distortion={distortion}"))
                    found.append(self.errors("thick_cylinder", exact, 0)[0])
                    walls.append(self.displacement_at("thick_cylinder", (inner, 0.0))[0])
                self.compare_orders(f"{cell}, distortion {distortion}: displacement", found, least)
                if distortion == 0:  # distorted meshes are not nested
                    self.compare_meshes(f"{cell}: displacement of the inner wall", walls, exact(inner, 0), 3)

    def test_consolidating_column(self):
        """Second order for both fields: the linear pressure's rate of decay has an error of second order, and the settlement
        follows the pressure, however fine the displacement's own shapes are."""
        column = biot.Column(biot.INCOMPRESSIBLE, load=10.0)
        for cell in ("quad9", "tri6"):
            with self.subTest(cell=cell):
                u, p, tops = [], [], []
                for n in (4, 8, 16):
                    self.run_deck(self.deck("terzaghi"), (
                        "mesh/cell=" + cell, f"mesh/cells={{1, {n}}}", "mesh/grading={1, 1}", f"{STAGE}duration={column.time(0.5)}",
                        f"{STAGE}time step/maximum=2", f"{STAGE}time step/initial=0.05", f"{STAGE}time step/growth=1.05"))
                    errors = self.errors("terzaghi", lambda x, y: -column.settlement(0.5, depth=1 - y), 1,
                                         lambda x, y: column.pressure(1 - y, 0.5))
                    u.append(errors[0])
                    p.append(errors[1])
                    tops.append(-self.displacement_at("terzaghi", (0.0, 1.0))[1])
                self.compare_orders(f"{cell}: displacement", u, 1.9)
                self.compare_orders(f"{cell}: pressure", p, 1.9)
                self.compare_meshes(f"{cell}: settlement", tops, column.settlement(0.5), 2)

    @problem("consistency")
    def test_time(self):
        """Of the theta method after its start-up, from differences of runs with halved constant steps."""
        duration = 160.0
        for theta, expected in ((1.0, 1), (0.5, 2)):
            with self.subTest(theta=theta):
                results = []
                for steps in (20, 40, 80, 160):
                    h = duration / steps
                    history = self.run_deck(self.deck("terzaghi"), (
                        "mesh/cells={1, 10}", f"{STAGE}duration={duration}", f"{STAGE}integrator/theta={theta}",
                        f"{STAGE}integrator/start-up steps=4", f"{STAGE}time step/initial={h}", f"{STAGE}time step/maximum={h}",
                        f"{STAGE}time step/growth=1"))
                    self.assertEqual(len(history.time), steps)
                    results.append([history["probe/base/pore pressure"][-1], history["probe/top/displacement y"][-1]])
                for column, what in enumerate(("pressure", "displacement")):
                    differences = np.abs(np.diff(np.array(results)[:, column]))
                    self.compare_orders(f"theta {theta}: {what} in time", differences, expected - 0.15,
                                        expected + 0.15)


if __name__ == "__main__":
    unittest.main()
