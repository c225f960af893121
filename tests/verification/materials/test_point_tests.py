"""The tests of `mudline point` on linear elastic soil, whose answers are known in closed form, and against each other."""
import os
import unittest

import numpy as np

import h5py
from compared_case import problem
from mudline_case import ROOT, MudlineCase, point_deck

E, NU = 2e7, 0.25
K, G = E / (3 * (1 - 2 * NU)), E / (2 * (1 + NU))
LAME = K - 2 * G / 3
ELASTIC = {"type": "linear elastic", "Young's modulus": E, "Poisson's ratio": NU}
CLAY = {"type": "modified cam clay", "critical stress ratio": 1.0, "compression slope": 0.2, "swelling slope": 0.04,
        "Poisson's ratio": 0.25, "lode dependence": "sheng", "stress tolerance": 1e-7}
START = {"mean effective stress": 1e5}


def side(name):
    return f"""<ParameterList name="{name}"><Parameter name="type" type="string" value="displacement"/>
      <Parameter name="set" type="string" value="{name}"/><Parameter name="x" type="string" value="4*t*y"/>
      <Parameter name="y" type="double" value="0.0"/></ParameterList>"""


BLOCK = """<ParameterList name="block">
  <ParameterList name="mesh"><Parameter name="type" type="string" value="box"/><Parameter name="cell" type="string" value="quad9"/>
    <Parameter name="cells" type="Array(int)" value="{1, 1}"/><Parameter name="upper" type="Array(double)" value="{1.0, 1.0}"/></ParameterList>
  MATERIALS
  <ParameterList name="physics"><ParameterList name="ground"><Parameter name="type" type="string" value="solid"/>
    <ParameterList name="initial state"><Parameter name="type" type="string" value="uniform"/>
      <Parameter name="effective stress xx" type="double" value="6e4"/><Parameter name="effective stress yy" type="double" value="1e5"/>
      <Parameter name="effective stress zz" type="double" value="6e4"/></ParameterList></ParameterList></ParameterList>
  <ParameterList name="boundary conditions">""" + "".join(map(side, ("left", "right", "top", "bottom"))) + """</ParameterList>
  <ParameterList name="stages"><ParameterList name="shear"><Parameter name="type" type="string" value="quasi-static"/>
    <Parameter name="duration" type="double" value="1.0"/>
    <ParameterList name="time step"><Parameter name="initial" type="double" value="0.0125"/>
      <Parameter name="maximum" type="double" value="0.0125"/></ParameterList></ParameterList></ParameterList>
  <ParameterList name="solver"><Parameter name="residual tolerance" type="double" value="1e-10"/></ParameterList>
</ParameterList>
"""


@problem("exact", "linear elasticity in closed form", "Point tests of linear elastic soil")
class PointTests(MudlineCase):
    def point(self, tests, skeleton=ELASTIC, void_ratio=0.8, extra=""):
        return self.run_point(self.write("soil.xml", point_deck(skeleton, tests, void_ratio, extra)))

    def test_simple_shear_follows_jaumann(self):
        """tau = G sin(gamma), normal stresses +-G (1 - cos(gamma)), to gamma = 5; the error falls with the square of the step."""
        errors = []
        for steps in (50, 100, 200, 400, 3200):
            history = self.point({"shear": {"type": "simple shear", "shear strain": [5.0], "steps": steps, "initial state": START}})["shear"]
            gamma = history["shear strain xy"]
            self.compare("shear strain", abs(gamma[-1] - 5.0), 1e-12)
            exact = {"shear stress xy": G * np.sin(gamma), "effective stress xx": 1e5 - G * (1 - np.cos(gamma)),
                     "effective stress yy": 1e5 + G * (1 - np.cos(gamma)), "effective stress zz": 1e5 + 0 * gamma}
            errors.append(max(np.abs(history[name] - value).max() for name, value in exact.items()) / G)
            self.compare_values("void ratio", history["void ratio"], 0.8, 1e-13)
            np.testing.assert_allclose(history["excess pore pressure"], 1e5 - exact["effective stress yy"], atol=2 * errors[-1] * G)
        self.compare_orders("order in the increment", errors[:4], 2 - 0.05, 2 + 0.05, all_orders=True)
        self.compare("stress, 3200 steps", errors[-1], 2e-6)

    @problem("consistency")
    def test_finite_elements_turn_alike(self):
        """The same steps of simple shear in a finite element and in a point: the same stresses and void ratio."""
        start = {"effective stress xx": 6e4, "effective stress yy": 1e5, "effective stress zz": 6e4}
        stiff = dict(ELASTIC, **{"small-strain stiffness": {"ratio": 5.0, "reference strain": 0.05}})
        for name, skeleton, gamma, steps in (("elastic", ELASTIC, 4.0, 80), ("clay", CLAY, 0.5, 160), ("strings", stiff, 1.0, 80)):
            test = {"type": "simple shear", "shear strain": [-gamma], "steps": steps, "initial state": start}
            point = self.point({"shear": test}, skeleton)["shear"]
            text = point_deck(skeleton, {}, 0.8)
            material = text[text.index('<ParameterList name="materials">'):text.index('<ParameterList name="tests">')]
            deck = self.write("block.xml", BLOCK.replace("MATERIALS", material))
            pace = [f"stages/shear/time step/{word}={gamma / 4 / steps!r}" for word in ("initial", "maximum")]
            history = self.run_deck(deck, pace + [f"stages/shear/duration={gamma / 4!r}"])
            self.assertEqual(len(history.time), steps)
            with h5py.File(os.path.join(self.folder, "results", "block.h5"), "r") as file:
                step = file["steps"][sorted(file["steps"])[-1]]
                xx, xy, _, yy, _, zz = -step["cell/effective_stress"][0]
                void_ratio = step["cell/void_ratio"][0]
            size = np.abs([xx, yy, zz, xy]).max()
            for component, value in (("effective stress xx", xx), ("effective stress yy", yy), ("effective stress zz", zz),
                                     ("shear stress xy", xy)):
                self.compare(f"{name}: {component}", abs(point[component][-1] / size - (value / size)), 1e-8)
            self.compare(f"{name}: void ratio", abs(point["void ratio"][-1] - void_ratio), 1e-10)

    @problem("behaviour")
    def test_tests_beside_a_full_run(self):
        """Tests as an overlay of the deck of a run: its soil, its overconsolidation, nothing else of it."""
        tests = {"CU": {"type": "triaxial undrained", "axial strain": [0.1], "initial state": {"vertical effective stress": 2e4}}}
        text = point_deck({}, tests)
        overlay = self.write("tests.xml", '<ParameterList name="tests">' + text[text.index('<ParameterList name="tests">'):])
        for decks in (["penetration/cone_indentation"], ["cpt/clay"], ["cpt/clay", "cpt/short_cone"]):
            paths = [os.path.join(ROOT, "inputs", deck + ".xml") for deck in decks]
            history = self.run_point([*paths, overlay], name=os.path.basename(decks[-1]))["CU"]
            self.assertEqual(history["void ratio"][0], 1.3)

    def test_drained_simple_shear_keeps_the_vertical_stress(self):
        shear = {"type": "simple shear", "drainage": "drained", "shear strain": [1.0, -0.5], "steps": 400,
                 "initial state": {"vertical effective stress": 1e5}}
        history = self.point({"shear": shear}, CLAY)["shear"]
        self.compare_values("effective stress yy", history["effective stress yy"], 1e5, 1e-9)
        self.compare_values("void ratio", 1 + history["void ratio"], 1.8 * np.exp(-history["volumetric strain"]),
                            1e-12)
        self.assertGreater(history["volumetric strain"][-1], 0.02)
        self.assertNotIn("excess pore pressure", history.columns)

    def test_elastic_closed_forms(self):
        """Rate form in logarithmic strain: linear."""
        axial = 0.02
        tests = {"cd": {"type": "triaxial drained", "axial strain": [axial]}, "cu": {"type": "triaxial undrained", "axial strain": [-axial]},
                 "oedometer": {"type": "oedometer", "axial strain": [axial]},
                 "isotropic": {"type": "isotropic compression", "volumetric strain": [axial]},
                 "biaxial": {"type": "plane strain", "axial strain": [axial]},
                 "biaxial_cu": {"type": "plane strain", "drainage": "undrained", "axial strain": [axial]}}
        for test in tests.values():
            test.update({"steps": 7, "initial state": START})
        h = self.point(tests)
        end = lambda test, name: h[test][name][-1]
        expected = [("cd", "effective stress yy", 1e5 + E * axial), ("cd", "volumetric strain", (1 - 2 * NU) * axial),
                    ("cu", "stress difference", -3 * G * axial), ("cu", "excess pore pressure", -G * axial),
                    ("oedometer", "effective stress yy", 1e5 + (LAME + 2 * G) * axial),
                    ("oedometer", "effective stress zz", 1e5 + LAME * axial),
                    ("isotropic", "mean effective stress", 1e5 + K * axial),
                    ("biaxial", "effective stress yy", 1e5 + E / (1 - NU ** 2) * axial),
                    ("biaxial", "effective stress zz", 1e5 + NU * E / (1 - NU ** 2) * axial),
                    ("biaxial", "strain xx", -NU / (1 - NU) * axial), ("biaxial", "strain zz", 0.0),
                    ("biaxial_cu", "stress difference", 4 * G * axial), ("biaxial_cu", "excess pore pressure", 2 * G * axial)]
        for test, name, value in expected:
            self.compare(f"{test}: {name}", abs(end(test, name) - value) / (max(abs(value), 1e-3)), 1e-9)

    def test_strain_measures_and_time(self):
        tests = {"log": {"type": "oedometer", "axial strain": [0.2, 0.1], "strain rate": 1e-3, "steps": 10, "initial state": START},
                 "engineering": {"type": "oedometer", "axial strain": [0.2, 0.1], "strain measure": "engineering", "steps": 10,
                                 "initial state": START}}
        h = self.point(tests)
        self.compare("axial strain", abs(h["log"]["axial strain"][10] - 0.2), 1e-13)
        self.compare("engineering axial strain", abs(h["log"]["engineering axial strain"][10] - (1 - np.exp(-0.2))),
                     1e-13)
        self.compare("engineering axial strain", abs(h["engineering"]["engineering axial strain"][10] - 0.2), 1e-13)
        self.compare("engineering volumetric strain",
                     abs(h["engineering"]["engineering volumetric strain"][20] - 0.1), 1e-13)
        self.compare("axial strain", abs(h["engineering"]["axial strain"][20] + np.log(0.9)), 1e-13)
        times = np.concatenate((np.linspace(0, 200, 11), np.linspace(210, 300, 10)))
        np.testing.assert_allclose(h["log"].time, times, rtol=1e-12)
        self.compare_values("void ratio", 1 + h["log"]["void ratio"], 1.8 * np.exp(-h["log"]["volumetric strain"]),
                            1e-13)

    def test_void_ratio_from_law(self):
        """v = N - lambda ln(pc/1 kPa) + kappa ln(pc/p'); a void ratio of the test itself goes before."""
        skeleton = dict(CLAY, **{"normal compression volume": 2.9})
        start = {"mean effective stress": 1e5, "overconsolidation ratio": 2.0}
        test = {"type": "triaxial undrained", "axial strain": [0.01], "initial state": start}
        text = point_deck(skeleton, {"law": test}).replace('<Parameter name="void ratio" type="double" value="1.0"/>',
                                                           '<Parameter name="void ratio from law" type="bool" value="true"/>')
        history = self.run_point(self.write("law.xml", text))["law"]
        self.compare("void ratio", abs(history["void ratio"][0] - (2.9 - 0.2 * np.log(200) + 0.04 * np.log(2) - 1)),
                     1e-12)
        self.compare("preconsolidation pressure", abs(history["preconsolidation pressure"][0] - 2e5), 1e-4)
        history = self.run_point(self.write("given.xml", text), ["tests/law/initial state/overconsolidation ratio=1", "tests/law/initial state/void ratio=0.8"])["law"]
        self.assertEqual(history["void ratio"][0], 0.8)
        self.compare("preconsolidation pressure",
                     abs(history["preconsolidation pressure"][0]
                         - (1e3 * np.exp((2.9 - 1.8 - 0.04 * np.log(100)) / 0.16))), 1e-4)

    @problem("consistency")
    def test_path_repeats_the_others(self):
        """Strains and stresses as functions of time give what the named tests give."""
        functions = """<ParameterList name="functions"><ParameterList name="down"><Parameter name="type" type="string" value="table"/>
          <Parameter name="times" type="Array(double)" value="{0, 10, 15}"/>
          <Parameter name="values" type="Array(double)" value="{0, 0.1, 0.08}"/></ParameterList></ParameterList>"""
        start = {"vertical effective stress": 1e5, "K0": 0.7, "overconsolidation ratio": 1.3}
        tests = {"cd": {"type": "triaxial drained", "axial strain": [0.1, 0.08], "steps": 200, "initial state": start},
                 "path cd": {"type": "path", "duration": 15.0, "steps": 300, "strain yy": "down", "effective stress xx": 7e4,
                             "effective stress zz": 7e4, "initial state": start},
                 "oedometer": {"type": "oedometer", "axial stress": [4e5], "steps": 100, "initial state": start},
                 "path oedometer": {"type": "path", "duration": 3.0, "steps": 100, "effective stress yy": "1e5*(1+t)", "initial state": start}}
        h = self.point(tests, CLAY, extra=functions)
        for name in ("effective stress yy", "void ratio", "preconsolidation pressure", "strain xx"):
            self.compare(f"triaxial, {name}",
                         abs(h["cd"][name][200] - h["path_cd"][name][200]) / abs(h["cd"][name][200]), 1e-4)
            np.testing.assert_allclose(h["oedometer"][name], h["path_oedometer"][name], rtol=1e-8)

    def test_cyclic_shear_by_stress(self):
        """All six components: shear stresses prescribed, normal stresses kept, Newton on the full tangent."""
        test = {"type": "path", "duration": 4.0, "steps": 400, "shear stress xy": "8e3*sin(2*pi*t)", "shear stress yz": "5e3*sin(2*pi*t)",
                "effective stress xx": 1e5, "effective stress yy": 1e5, "effective stress zz": 1e5, "shear stress xz": 0.0,
                "initial state": dict(START, **{"overconsolidation ratio": 1.5})}
        h = self.point({"cyclic": test}, CLAY)["cyclic"]
        np.testing.assert_allclose(h["shear stress xy"], 8e3 * np.sin(2 * np.pi * h.time), atol=1e-4)
        self.compare_values("mean effective stress", h["mean effective stress"], 1e5, 1e-9)

    @problem("behaviour")
    def test_report_and_picture(self):
        """--png draws all tests; the report of one test is an HTML page."""
        from mudline_case import program
        tests = {"a b": {"type": "triaxial undrained", "axial strain": [0.1], "initial state": START},
                 "c": {"type": "simple shear", "shear strain": [0.2], "initial state": START}}
        self.write("soil.xml", point_deck(CLAY, tests))
        done = program(["point", "soil.xml", "--png", "pictures/soil.png"], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(os.path.join(self.folder, "pictures", "soil.png"), "rb") as file:
            self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")
        done = program(["report", "results/soil_a_b.csv"], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(os.path.join(self.folder, "results", "soil_a_b_report.html")) as file:
            self.assertIn('<h2 id="test">', file.read())

    @problem("behaviour")
    def test_end_of_the_law(self):
        """Mean stress beyond what the soil can follow: what was reached stays, exit code 3."""
        from mudline_case import program
        loosening = {"type": "path", "duration": 1.0, "steps": 20, "effective stress yy": "1e5*(1-2*t)", "effective stress xx": 1e5,
                     "effective stress zz": 1e5, "initial state": START}
        self.write("soil.xml", point_deck(CLAY, {"loosening": loosening}))
        done = program(["point", "soil.xml"], folder=self.folder)
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertIn("warning: test 'loosening' ends early", done.stderr)
        self.assertIn("cuts", done.stdout)


if __name__ == "__main__":
    unittest.main()
