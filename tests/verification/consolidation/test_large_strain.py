"""One-dimensional consolidation by a quarter of the height, with three laws of permeability, against finite volumes in
material coordinates. The skeleton is M ln J; porosity n = 1 - (1 - n0)/J follows from incompressible grains."""
import unittest

import numpy as np

from compared_case import ComparedCase, problem
from consolidation_case import ConsolidationCase, between
from references import biot, finite_strain

MODULUS, LOAD, MOBILITY, POROSITY, INDEX = 12e6, 3452184.8694, 1e-10, 0.4, 0.5
TIMES = np.array([10.0, 20.0, 50.0, 100.0, 200.0, 400.0, 700.0, 1000.0])
TOLERANCE = 3e-3
PERMEABILITY = "materials/soil/permeability/"


def void_ratio(ratio):
    return ratio / (1 - POROSITY) - 1


def constant(ratio):
    return MOBILITY * np.ones_like(ratio)


def kozeny_carman(ratio):
    e, start = void_ratio(ratio), void_ratio(1.0)
    return MOBILITY * (e / start) ** 3 * (1 + start) / (1 + e)


def log_linear(ratio):
    return MOBILITY * 10 ** ((void_ratio(ratio) - void_ratio(1.0)) / INDEX)


LAWS = {"constant": (constant, ()), "kozeny-carman": (kozeny_carman, (PERMEABILITY + "type=kozeny-carman",)),
        "log-linear": (log_linear, (PERMEABILITY + "type=log-linear", f"{PERMEABILITY}permeability index={INDEX}"))}


@problem("exact", "Xie and Leo (2004): linear case", "Finite volumes at large strain")
class Reference(ComparedCase):
    def test_linear_case(self):
        """Mobility proportional to J^2: Terzaghi's degree of consolidation, at any strain."""
        found = finite_strain.Consolidation(MODULUS, LOAD, lambda ratio: MOBILITY * ratio ** 2, TIMES)
        column = biot.Column(biot.INCOMPRESSIBLE)
        degree = np.array([column.settlement(t / column.time(1.0)) for t in TIMES]) / column.final_settlement
        self.compare("settlement", np.abs(found.settlement() / (found.final_settlement() * degree) - 1).max(), 1e-4)


@problem("benchmark", "Gibson, England and Hussey (1967), finite volumes in references/finite_strain.py",
         "Consolidation at large strain")
class LargeStrain(ConsolidationCase):
    def test_consolidation(self):
        for law, (mobility, settings) in LAWS.items():
            for cell in ("quad9", "tri6"):
                with self.subTest(law=law, cell=cell):
                    self.check(f"{law}, {cell}", mobility, settings + ("mesh/cell=" + cell,))

    def check(self, name, mobility, settings):
        exact = finite_strain.Consolidation(MODULUS, LOAD, mobility, TIMES)
        history = self.run_deck(self.deck("large_strain"), settings + (
            "stages/consolidation/duration=1000", "stages/consolidation/time step/maximum=8", "mesh/cells={1, 60}",
            "mesh/grading={1, 0.05}",
            "solver/residual tolerance=1e-8"))  # the water balance closes as far as Newton goes
        self.compare_values(f"{name}: settlement", -between(history, "probe/top/displacement y", TIMES),
                            exact.settlement(), TOLERANCE)
        for probe, height in (("base", 0.0), ("middle", 0.5)):
            exact_pressure = exact.pressure(self.corner_near("large_strain", 0.0, height)[1])
            self.compare_values(f"{name}: p {probe}", between(history, f"probe/{probe}/pore pressure", TIMES),
                                exact_pressure, TOLERANCE, scale=LOAD)
        error = np.abs(history["balance/water/error"]).max()
        self.compare_values(f"{name}: water balance", error, 0.0, 1e-8, scale=1.0)

    @problem("exact", "M ln J and the void ratio at rest")
    def test_final_settlement(self):
        history = self.run_deck(self.deck("large_strain"), (
            "stages/consolidation/duration=6000", "stages/consolidation/time step/maximum=100"))
        self.compare_values("final settlement", -history["probe/top/displacement y"][-1], 1 - np.exp(-LOAD / MODULUS),
                            1e-4)
        with self.fields("large_strain") as file:
            last = sorted(file["steps"])[-1]
            cells = file[f"steps/{last}/cell"]
            errors = np.abs(cells["void_ratio"][:] / void_ratio(0.75) - 1)
            stress = cells["effective_stress"][:, 3]  # yy of XDMF's xx, xy, xz, yy, yz, zz
        # the drained surface takes its whole strain in the first step, where the increment's logarithm is that of the midpoint rule
        self.compare_values("final void ratio, mean", np.mean(errors), 0.0, 1.5e-4, scale=1.0)
        self.compare_values("final void ratio, worst", np.max(errors), 0.0, 4e-3, scale=1.0)
        self.compare_values("final effective stress", np.abs(stress), LOAD, 5e-4)


if __name__ == "__main__":
    unittest.main()
