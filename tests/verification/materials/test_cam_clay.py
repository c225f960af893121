"""Modified Cam Clay through `mudline point`, against closed forms and quadrature (references/cam_clay.py)."""
import os
import unittest

import numpy as np
from scipy.optimize import brentq

from compared_case import problem
from mudline_case import ROOT, MudlineCase, point_deck
from references.cam_clay import CamClay

KPA = 1e3
TOLERANCE = 1e-5
AXIAL = [0.01, 0.05, 0.1, 0.2]
STEPS = 2000  # between two targets
CLAY = {"type": "modified cam clay", "critical stress ratio": 1.2, "compression slope": 0.15, "swelling slope": 0.03,
        "Poisson's ratio": 0.3, "stress tolerance": 1e-7}

# The figures as another program of the same theory printed them: OCR, eps_a, CD p', q, eps_v, CU p', q.
PRINTED = """1 0.01 111.3095 33.9285 0.01185736 77.32633 57.13161
1 0.05 131.917 95.75087 0.04028306 57.73844 68.82964
1 0.1 145.9596 137.8789 0.05900265 57.43695 68.92129
1 0.2 159.4484 178.3452 0.07527226 57.43492 68.9219
2 0.01 130.491 91.47299 0.004 100 92.30769
2 0.05 147.0917 141.2752 0.01720381 100 120
2 0.1 155.3336 166.0007 0.02683505 100 120
2 0.2 162.9782 188.9346 0.03520967 100 120
5 0.01 130.491 91.47299 0.004 100 92.30769
5 0.05 188.8744 266.6232 0.003255294 188.4471 254.2962
5 0.1 178.1484 234.4453 -0.005859574 207.9941 249.8091
5 0.2 169.9318 209.7955 -0.01339125 208.1383 249.766"""


def triaxial(kind, ocr):
    return {"type": "triaxial " + kind, "axial strain": AXIAL, "steps": STEPS,
            "initial state": {"mean effective stress": 100 * KPA, "overconsolidation ratio": float(ocr)}}


@problem("exact", "Wood (1990), Peric and Ayari (2002), by quadrature", "Modified Cam Clay")
class CamClayTests(MudlineCase):
    def point(self, tests, clay=CLAY):
        return self.run_point(self.write("clay.xml", point_deck(clay, tests)))

    def close(self, what, value, exact, tolerance=TOLERANCE):
        self.compare(what, np.max(np.abs(np.asarray(value) / np.asarray(exact) - 1)), tolerance)

    @problem("benchmark", "printed values in the test")
    def test_the_reference_is_that_of_others(self):
        for line in PRINTED.splitlines():
            ocr, axial, *printed = map(float, line.split())
            soil = CamClay(ocr=ocr)
            self.compare_values(f"OCR {ocr}, {axial} of axial strain", soil.drained(axial) + soil.undrained(axial),
                                printed, 1e-6)

    def test_triaxial(self):
        histories = self.point({f"{kind} {ocr}": triaxial(kind, ocr) for kind in ("drained", "undrained") for ocr in (1, 2, 5)})
        for ocr in (1, 2, 5):
            soil = CamClay(ocr=ocr)
            for i, axial in enumerate(AXIAL):
                row = (i + 1) * STEPS
                p, q, volume = soil.drained(axial)
                cd, cu = histories[f"drained_{ocr}"], histories[f"undrained_{ocr}"]
                name = f"OCR {ocr}, {axial:g}"
                self.compare("axial strain", abs(cd["axial strain"][row] - axial), 1e-12)
                self.close(f"CD {name}: p'", cd["mean effective stress"][row], p * KPA)
                self.close(f"CD {name}: q", cd["deviatoric stress"][row], q * KPA)
                self.close(f"CD {name}: volume", cd["volumetric strain"][row], volume)
                self.close(f"CD {name}: void ratio", cd["void ratio"][row], 2 * np.exp(-volume) - 1)
                p, q = soil.undrained(axial)
                self.close(f"CU {name}: p'", cu["mean effective stress"][row], p * KPA)
                self.close(f"CU {name}: q", cu["deviatoric stress"][row], q * KPA)
                # total radial stress kept: u = 100 kPa - (p' - q/3)
                self.compare("excess pore pressure [Pa]",
                             abs(cu["excess pore pressure"][row] - ((100 - p + q / 3) * KPA)), 5)
                self.compare("void ratio", abs(cu["void ratio"][row] - 1.0), 1e-12)

    def test_implicit(self):
        """Two hundred increments to 20 % axial strain: 0.1 % over the whole path; the error is of second order."""
        implicit = dict({name: value for name, value in CLAY.items() if name != "stress tolerance"}, integration="implicit")
        worst = {}
        for steps in (200, 400):
            histories = self.point({f"{kind} {ocr}": dict(triaxial(kind, ocr), **{"axial strain": [0.2], "steps": steps})
                                    for kind in ("drained", "undrained") for ocr in (1, 2, 5)}, implicit)
            worst[steps] = 0
            for name, h in histories.items():
                kind, ocr = name.split("_")
                solution = getattr(CamClay(ocr=float(ocr)), kind)
                for row in np.arange(10, 201, 10) * steps // 200:
                    p, q = solution(h["axial strain"][row])[:2]
                    errors = h["mean effective stress"][row] / (p * KPA) - 1, h["deviatoric stress"][row] / (q * KPA) - 1
                    worst[steps] = max(worst[steps], np.abs(errors).max())
        self.compare("stress, 200 increments", worst[200], 1e-3)
        self.compare_orders("order in the increment", (worst[200], worst[400]), 2 - 0.15, 2 + 0.15)

    def test_there_and_back(self):
        """Drained from one critical state to the other, however long the increments: q = -+M p', p' = p0 + q/3."""
        end = 100 / (1 + 1.2 / 3)
        for integration in ("implicit", "modified euler", "runge-kutta-dormand-prince"):
            clay = dict({name: value for name, value in CLAY.items() if name != "stress tolerance"}, integration=integration)
            histories = self.point({f"{ocr} {steps}": {"type": "triaxial drained", "axial strain": [0.3, -0.3], "steps": steps,
                                                        "initial state": {"mean effective stress": 100 * KPA, "overconsolidation ratio": float(ocr)}}
                                    for ocr in (1, 3, 20) for steps in (5, 20, 100)}, clay)
            for name, h in histories.items():
                self.close(f"{integration} {name}", h["mean effective stress"][-1], end * KPA, 5e-4)

    def test_undrained_cycles_by_stress(self):
        """Stress difference up and down at constant volume. Inside the yield surface p' stays, strain = q/(3 G), u = q/3. Beyond first
        yield the first quarter follows the virgin path; what comes after is elastic, about the p' that was reached."""
        p0, ocr, cycles, steps = 100.0, 1.5, 5, 50
        soil = CamClay(ocr=ocr)
        first = float(1.2 * p0 * np.sqrt(ocr - 1))
        shear = lambda p: soil.g * soil.v0 * p / soil.swelling
        start = {"mean effective stress": p0 * KPA, "overconsolidation ratio": ocr}
        test = {"type": "triaxial undrained", "steps": steps, "cycles": cycles, "initial state": start}
        within, beyond = 0.999 * first, 88.0
        axial = brentq(lambda e: soil.undrained(e)[1] - beyond, first / (3 * shear(p0)), 0.03, xtol=1e-15)
        p_end = soil.undrained(axial)[0]
        histories = self.point({"within": dict(test, **{"stress difference": [within * KPA, -within * KPA]}),
                                "strain": dict(test, **{"axial strain": [within / (3 * shear(p0)), -within / (3 * shear(p0))]}),
                                "beyond": dict(test, **{"stress difference": [beyond * KPA, -beyond * KPA], "steps": 400}),
                                "drained": dict(test, **{"type": "triaxial drained", "stress difference": [20 * KPA, -20 * KPA]}),
                                "biaxial": dict(test, **{"type": "plane strain", "drainage": "undrained",
                                                         "stress difference": [60 * KPA, -60 * KPA]})})
        for name in ("within", "strain"):
            h = histories[name]
            q = h["stress difference"] / KPA
            self.assertEqual(len(q), 2 * cycles * steps + 1)
            self.close(name + ": extremes", q[steps::2 * steps], within, 1e-9)
            self.close(name + ": extremes", q[2 * steps::2 * steps], -within, 1e-9)
            self.close(name + ": p'", h["mean effective stress"], p0 * KPA, 1e-12)
            np.testing.assert_allclose(h["axial strain"], q / (3 * shear(p0)), atol=1e-12)
            np.testing.assert_allclose(h["excess pore pressure"], q / 3 * KPA, atol=1e-4)
            np.testing.assert_array_equal(h["plastic shear strain"], 0)
            self.compare_values("void ratio", h["void ratio"], 1.0, 1e-13)
        h = histories["beyond"]
        for row in (399, 400):
            self.close("beyond: virgin path", h["mean effective stress"][row], soil.undrained(h["axial strain"][row])[0] * KPA)
        self.close("beyond: strain", h["axial strain"][400], axial)
        self.close("beyond: p' from there on", h["mean effective stress"][400:], p_end * KPA)
        q = h["stress difference"][400:] / KPA
        np.testing.assert_allclose(h["axial strain"][400:] - h["axial strain"][400], (q - q[0]) / (3 * shear(p_end)), atol=1e-6 * axial)
        h = histories["drained"]
        self.compare_values("effective stress xx", h["effective stress xx"], p0 * KPA, 1e-9)
        self.close("drained: extremes", h["stress difference"][[steps, 2 * steps]], [20 * KPA, -20 * KPA], 1e-9)
        swell = soil.swelling * np.log(h["mean effective stress"] / (p0 * KPA))
        self.compare_values("void ratio", 1 + h["void ratio"], 2 - swell, 1e-9)
        h = histories["biaxial"]
        np.testing.assert_allclose(h["axial strain"], h["stress difference"] / KPA / (4 * shear(p0)), atol=1e-12)

    def test_undrained_cyclic_shear_by_stress(self):
        """Simple shear at constant volume between shear stresses; small strain: gamma = tau/G inside the yield surface."""
        test = {"type": "simple shear", "shear stress": [10 * KPA, -10 * KPA], "cycles": 3, "steps": 40,
                "initial state": {"mean effective stress": 100 * KPA, "overconsolidation ratio": 2.0}}
        h = self.point({"cyclic": test})["cyclic"]
        soil = CamClay(ocr=2)
        gamma = 10 / (soil.g * soil.v0 * 100 / soil.swelling)
        self.close("extremes", h["shear stress xy"][40::80], 10 * KPA, 1e-8)
        self.close("extremes", h["shear stress xy"][80::80], -10 * KPA, 1e-8)
        self.close("strain", h["shear strain xy"][40::80], gamma, 2 * gamma ** 2)  # rotation: second order
        self.compare_values("mean effective stress", h["mean effective stress"], 100 * KPA, 1e-9)

    def test_first_yield(self):
        """The row where plastic strain begins."""
        soils = {ocr: CamClay(ocr=ocr) for ocr in (2, 5)}
        histories = self.point({f"{kind} {ocr}": triaxial(kind, ocr) for kind in ("drained", "undrained") for ocr in (2, 5)})
        for ocr, soil in soils.items():
            for kind, q_yield in (("drained", soil.first_yield_drained()), ("undrained", 120 * np.sqrt(ocr - 1))):
                history = histories[f"{kind}_{ocr}"]
                row = int(np.argmax(history["plastic shear strain"] > 0))
                self.assertLess(history["deviatoric stress"][row - 1], q_yield * KPA * (1 + 1e-6))
                self.close(f"{kind} {ocr}", history["deviatoric stress"][row], q_yield * KPA, 2e-3)  # one step beyond

    def test_extension(self):
        """Without dependence on the Lode angle extension mirrors compression."""
        down = dict(triaxial("undrained", 1), **{"axial strain": [-a for a in AXIAL]})
        history = self.point({"extension": down})["extension"]
        for i, axial in enumerate(AXIAL):
            p, q = CamClay().undrained(axial)
            self.close("q", -history["stress difference"][(i + 1) * STEPS], q * KPA)
            self.close("p'", history["mean effective stress"][(i + 1) * STEPS], p * KPA)

    def test_oedometer(self):
        history = self.point({"K0": {"type": "oedometer", "axial strain": AXIAL, "steps": 500,
                                     "initial state": {"mean effective stress": 100 * KPA}}})["K0"]
        for i, axial in enumerate(AXIAL):
            vertical, radial = CamClay().oedometer(axial)
            self.close("vertical", history["effective stress yy"][(i + 1) * 500], vertical * KPA)
            self.close("radial", history["effective stress xx"][(i + 1) * 500], radial * KPA)

    def test_oedometer_starts_on_the_k0_line(self):
        """From the law's own K0 the ratio of stresses stays, and by stress the void ratio follows lambda."""
        history = self.point({"K0": {"type": "oedometer", "axial stress": [400 * KPA], "steps": 200,
                                     "initial state": {"vertical effective stress": 100 * KPA}}})["K0"]
        ratio = history["effective stress xx"] / history["effective stress yy"]
        self.close("K0", ratio, 0.647629, 2e-6)
        self.close("void ratio", 1 + history["void ratio"][-1], 2 - 0.15 * np.log(4), 1e-6)

    def test_work_of_an_elastic_loop(self):
        """Compressed, sheared, expanded and sheared back inside the yield surface. With a constant Poisson's ratio the loop of strains
        gives back 3/2 (G2 - G1) eps_q^2 more than it took, and leaves a shear stress; the other way round it takes as much. With a
        constant shear modulus it leaves nothing. docs/materials.md tells the figure."""
        volume, shear, steps = 0.006, 0.01, 1000

        def there(k):
            return f"(min(max(t-{k},0),1)-min(max(t-{k + 2},0),1))"  # up in the second k, down two seconds later

        works, left = {}, {}
        for name, elasticity in (("ratio", {"Poisson's ratio": 0.3}), ("modulus", {"shear modulus": 4e6})):
            clay = dict({key: value for key, value in CLAY.items() if key != "Poisson's ratio"}, **elasticity)
            tests = {}
            for way, (first, second) in {"there": (0, 1), "back": (1, 0)}.items():
                ev, eq = f"{volume}*{there(first)}", f"{shear}*{there(second)}"
                tests[way] = {"type": "path", "duration": 4.0, "steps": 4 * steps, "strain yy": f"{ev}/3+{eq}",
                              **{f"strain {axis}": f"{ev}/3-{eq}/2" for axis in ("xx", "zz")},
                              "initial state": {"mean effective stress": 100 * KPA, "overconsolidation ratio": 4.0}}
            for way, h in self.point(tests, clay).items():
                np.testing.assert_array_equal(h["plastic shear strain"], 0)
                self.compare("strain of the loop", max(abs(h[f"strain {axis}"][-1]) for axis in ("xx", "yy", "zz")),
                             1e-15)
                works[name, way] = sum(np.sum(0.5 * (h[f"effective stress {axis}"][1:] + h[f"effective stress {axis}"][:-1]) * np.diff(h[f"strain {axis}"]))
                                       for axis in ("xx", "yy", "zz"))
                left[name, way] = h["stress difference"][-1]
        soil = CamClay()
        v = soil.v0 * np.exp(-volume)
        p = 100 * KPA * np.exp((soil.v0 - v) / soil.swelling)
        stiffer = soil.g / soil.swelling * (v * p - soil.v0 * 100 * KPA)
        self.close("work", works["ratio", "there"], -1.5 * stiffer * shear ** 2, 1e-4)
        self.close("work, the other way", works["ratio", "back"], 1.5 * stiffer * shear ** 2, 1e-4)
        self.close("stress left", left["ratio", "there"], 3 * stiffer * shear, 1e-4)
        for way in ("there", "back"):
            self.compare(f"work, constant modulus, {way}", abs(works["modulus", way]), 1e-3)
            self.compare(f"stress left, constant modulus, {way}", abs(left["modulus", way]), 1e-3)
        with open(os.path.join(ROOT, "docs", "materials.md")) as file:
            self.assertIn(f"{abs(works['ratio', 'there']):.0f} J/m", file.read())

    def test_isotropic(self):
        start = {"mean effective stress": 100 * KPA, "overconsolidation ratio": 2.0}
        histories = self.point({
            "strain": {"type": "isotropic compression", "volumetric strain": [0.015, 0.03, 0.06], "steps": 10, "initial state": start},
            "stress": {"type": "isotropic compression", "mean stress": [400 * KPA, 150 * KPA, 600 * KPA], "steps": 10,
                       "initial state": start}})
        for i, volume in enumerate([0.015, 0.03, 0.06]):
            p, v = CamClay(ocr=2).isotropic(volume)
            self.close("p'", histories["strain"]["mean effective stress"][10 * (i + 1)], p * KPA, 1e-6)
            self.close("v", 1 + histories["strain"]["void ratio"][10 * (i + 1)], v, 1e-6)
        virgin = lambda p: 2 - 0.03 * np.log(2) - 0.15 * np.log(p / 200)
        expected = [virgin(400), virgin(400) + 0.03 * np.log(400 / 150), virgin(600)]
        self.close("loading, unloading, reloading", 1 + histories["stress"]["void ratio"][[10, 20, 30]], expected, 1e-6)


if __name__ == "__main__":
    unittest.main()
