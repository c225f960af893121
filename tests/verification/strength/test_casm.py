"""Modified Cam Clay with the yield surface of CASM: triaxial tests against quadrature (references/casm.py), and the
expansion of a cavity in overconsolidated clay against the exact similarity solution."""
import unittest

import numpy as np

from cavity_case import DRAINED, KPA, CavityCase
from compared_case import problem
from mudline_case import point_deck
from references.casm import Casm
from references.cavity import CasmRates, Drained, Undrained

TOLERANCE = 5e-3  # set before the first run
M, SLOPE, SWELLING = 0.9, 0.16, 0.05
CLAY = {"type": "modified cam clay", "critical stress ratio": M, "compression slope": SLOPE, "swelling slope": SWELLING,
        "Poisson's ratio": 0.3}
SHAPES = {"kaolin": (2.3, 2.0), "blunt": (2.7, 4.5)}
AXIAL = [0.005, 0.02, 0.05, 0.1, 0.2]
STEPS = 100  # between two targets


def surface(r, n):
    return {"spacing ratio": r, "stress state coefficient": n}


def test(kind, ocr, **more):
    return {"type": "triaxial " + kind, "axial strain": AXIAL, "steps": STEPS,
            "initial state": {"mean effective stress": 100 * KPA, "overconsolidation ratio": float(ocr)}, **more}


@problem("exact", "Yu (1998), by quadrature", "Cam Clay with the surface of CASM", topic="materials")
class Triaxial(CavityCase):
    def point(self, tests, law):
        return self.run_point(self.write("clay.xml", point_deck(law, tests)))

    def close(self, what, value, exact, tolerance=TOLERANCE):
        self.compare_values(what, value, exact, tolerance)

    def soil(self, shape, ocr):
        return Casm(M, SLOPE, SWELLING, *SHAPES[shape], ocr=float(ocr))

    def test_paths(self):
        cases = [("undrained", 1), ("undrained", 4), ("undrained", 15), ("drained", 1), ("drained", 10)]
        for shape, (r, n) in SHAPES.items():
            for method in ("runge-kutta-dormand-prince", "implicit"):
                histories = self.point({f"{kind} {ocr}": test(kind, ocr) for kind, ocr in cases},
                                       {**CLAY, **surface(r, n), "integration": method})
                for kind, ocr in cases:
                    soil, h = self.soil(shape, ocr), histories[f"{kind}_{ocr}"]
                    for i, axial in enumerate(AXIAL):
                        row, name = (i + 1) * STEPS, f"{shape}, {method}, {kind}, OCR {ocr}, {axial:g}"
                        p, q, *volume = getattr(soil, kind)(axial)
                        self.close(name + ": p'", h["mean effective stress"][row], p * KPA)
                        self.close(name + ": q", h["deviatoric stress"][row], q * KPA)
                        for v in volume:
                            self.compare("volume strain", abs(h["volumetric strain"][row] - v) / 0.02, TOLERANCE)

    def test_drained_softening_ends_at_the_critical_state(self):
        """OCR 10: a peak, then q = M p' on p' = p'0 + q/3, at the volume of pc = r p'."""
        r, n = SHAPES["kaolin"]
        one = test("drained", 10, **{"axial strain": [1.5], "steps": 1500})
        h = self.point({"soft": one}, {**CLAY, **surface(r, n)})["soft"]
        p, q = h["mean effective stress"][-1] / KPA, h["deviatoric stress"] / KPA
        self.close("p'", p, 100 / (1 - M / 3), 1e-3)
        self.assertGreater(q.max(), 1.2 * q[-1])
        soil = self.soil("kaolin", 10)
        critical = 2.0 - SWELLING * np.log(p / 100) - (SLOPE - SWELLING) * np.log(r * p / soil.pc0)
        self.close("v", 1 + h["void ratio"][-1], critical, 1e-4)

    def test_undrained_strength_is_what_the_law_says(self):
        """`mudline point --profile` and the plausibility checks show it: M/2 p' (pc/(r p'))^(1 - kappa/lambda)."""
        for shape, (r, n) in SHAPES.items():
            far = {"axial strain": [1.0], "steps": 400}
            tests = {str(ocr): test("undrained", ocr, **far) for ocr in (1, 4, 15)}
            h = self.point(tests, {**CLAY, **surface(r, n)})
            for ocr in (1, 4, 15):
                exact = self.soil(shape, ocr).critical_undrained() * KPA
                self.close(f"{shape}, OCR {ocr}", h[str(ocr)]["deviatoric stress"][-1], exact, 1e-4)

    def test_one_dimensional_compression_keeps_the_k0_of_the_law(self):
        """K0 follows from the flow, which is that of Modified Cam Clay, and so does the K0 line; v falls by lambda."""
        start = {"vertical effective stress": 100 * KPA}
        one = {"type": "oedometer", "axial stress": [400 * KPA], "steps": 200, "initial state": start}
        ratios = []
        for law in (CLAY, {**CLAY, **surface(2.3, 2.0)}, {**CLAY, **surface(2.7, 4.5)}):
            h = self.point({"K0": one}, law)["K0"]
            ratio = h["effective stress xx"] / h["effective stress yy"]
            self.compare_values("ratio of stresses", ratio, ratio[0], 1e-5)
            self.close("void ratio", 1 + h["void ratio"][-1], 2 - SLOPE * np.log(4), 1e-6)
            ratios.append(ratio[0])
        self.compare_values("ratio of stresses at the start", ratios, ratios[0], 1e-12)

    def test_near_zero_stress(self):
        """Loosened to the minimum stress and loaded again: nothing fails, for any integration."""
        start = {"mean effective stress": 2 * KPA, "overconsolidation ratio": 1.2}
        path = {"type": "triaxial drained", "axial strain": [-0.1, 0.6], "steps": 40, "initial state": start}
        for method in ("modified euler", "runge-kutta-dormand-prince", "implicit"):
            for r, n in SHAPES.values():
                law = {**CLAY, **surface(r, n), "integration": method}
                h = self.point({"back": path}, law)["back"]
                self.assertTrue(np.isfinite(h["deviatoric stress"]).all())
                self.close(method, h["deviatoric stress"][-1], M * h["mean effective stress"][-1], 0.05)


@problem("exact", "similarity solution after Chen and Abousleiman (2012, 2013)",
         "Cavity in overconsolidated clay, CASM")
class Cavity(CavityCase):
    """A cylindrical cavity in clay of OCR 4, drained and undrained, against the exact solution."""

    def test_cylinder(self):
        r, n = 2.5, 3.0
        law = CasmRates(r, n, 4.0, M=1.2, slope=0.15, swelling=0.03, nu=0.3, v0=2.0, start=(100.0, 100.0, 100.0))
        skeleton = "materials/soil/skeleton/"
        settings = [skeleton + f"spacing ratio={r}", skeleton + f"stress state coefficient={n}",
                    "physics/ground/initial state/overconsolidation ratio=4"]
        history = self.run_deck(self.deck("cavity_expansion", "clay_cylinder"), settings)
        self.compare_pressures("undrained", history, 1, Undrained(law, 1, 4.001), 2e-3, 4e-3)
        self.assertLessEqual(history["step/newton iterations"].max(), 5)
        history = self.run_deck(self.deck("cavity_expansion", "clay_cylinder"), settings + [DRAINED])
        self.compare_pressures("drained", history, 1, Drained(law, 1, 4.001), 2e-3)
        self.assertLessEqual(history["step/newton iterations"].max(), 5)


if __name__ == "__main__":
    unittest.main()
