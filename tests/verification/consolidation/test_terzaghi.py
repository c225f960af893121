"""Terzaghi's column: pressures and settlement against the series, loads scaled by 1e-3 for small strains."""
import re
import unittest

import numpy as np

from compared_case import problem
from consolidation_case import COMPRESSIBLE, ConsolidationCase, between
from references import biot

TIMES = np.array([0.05, 0.1, 0.2, 0.5, 1.0])
SOILS = {"incompressible": (biot.INCOMPRESSIBLE, ()), "compressible": (biot.COMPRESSIBLE, COMPRESSIBLE)}
MESHES = {"quad9, plane": (), "tri6, plane": ("mesh/cell=tri6",), "quad9, axisymmetric": ("mesh/geometry=axisymmetric",),
          "tri6, axisymmetric": ("mesh/geometry=axisymmetric", "mesh/cell=tri6")}
STAGE = "stages/consolidation/"


@problem("exact", "Terzaghi (1943)", "Terzaghi's column")
class Terzaghi(ConsolidationCase):
    def check(self, history, column, name, tolerance, stem="terzaghi"):
        middle = 1 - self.corner_near(stem, 0.0, 0.5)[1]
        t = column.time(TIMES)
        exact = np.array([[column.pressure(1.0, T), column.pressure(middle, T), column.settlement(T)] for T in TIMES]).T
        values = [between(history, "probe/base/pore pressure", t), between(history, "probe/middle/pore pressure", t),
                  -between(history, "probe/top/displacement y", t)]
        for what, value, expected in zip(("p base", "p middle", "settlement"), values, exact):
            self.compare_values(f"{name}: {what}", value, expected, tolerance)

    def test_consolidation(self):
        for soil_name, (soil, settings) in SOILS.items():
            column = biot.Column(soil, load=10.0)
            for mesh, changes in MESHES.items():
                with self.subTest(soil=soil_name, mesh=mesh):
                    history = self.run_deck(self.deck("terzaghi"), settings + changes + (
                        "output/probes/middle={0.0, 0.5}", f"{STAGE}duration={column.time(1.0)}", f"{STAGE}time step/maximum=4"))
                    self.check(history, column, f"{soil_name}, {mesh}", 1e-3)
                    # drainage has not reached the base after the first step
                    self.compare("first pressure",
                                 abs(history["probe/base/pore pressure"][0] / column.initial_pressure - 1), 1e-6)
                    self.assertLess(np.abs(history["balance/water/error"]).max(), 1e-12)

    def test_undrained_response(self):
        """One step with the surface sealed: the pressure everywhere and the settlement at t = 0+."""
        conditions = f"{STAGE}conditions={{base, left side, right side, load}}"
        column = biot.Column(biot.COMPRESSIBLE, load=1.0)
        history = self.run_deck(self.deck("terzaghi"), COMPRESSIBLE + (
            "boundary conditions/load/y=-1.0", conditions, f"{STAGE}duration=0.01"))
        for probe in ("base", "top"):
            self.compare_values(f"p0 {probe}", history[f"probe/{probe}/pore pressure"][-1], column.initial_pressure,
                                1e-6)
        self.compare_values("w(0+)", -history["probe/top/displacement y"][-1], column.initial_settlement, 1e-6)

    def test_dynamic_integrator_at_late_times(self):
        """With inertia, at times long against height over wave speed (13 ms). The first step is as long as a wave takes:
        accelerations consistent with the sudden load would be extrapolated over it as if they lasted, so they start from zero."""
        with open(self.deck("terzaghi")) as file:
            text = file.read().replace('value="quasi-static"', 'value="dynamic"')
        integrator = """<ParameterList name="integrator">
          <Parameter name="type" type="string" value="generalised alpha"/>
          <Parameter name="spectral radius" type="double" value="0.5"/>
        </ParameterList>"""
        deck = self.write("dynamic.xml", re.sub(r'<ParameterList name="integrator">.*?</ParameterList>', integrator, text, flags=re.S))
        for soil_name, (soil, settings) in SOILS.items():
            column = biot.Column(soil, load=10.0)
            with self.subTest(soil=soil_name):
                history = self.run_deck(deck, settings + (
                    "output/probes/middle={0.0, 0.5}", f"{STAGE}duration={column.time(1.0)}", f"{STAGE}time step/maximum=4",
                    f"{STAGE}initial rates=zero"))
                self.check(history, column, f"{soil_name}, generalised alpha", 1e-3, "dynamic")


if __name__ == "__main__":
    unittest.main()
