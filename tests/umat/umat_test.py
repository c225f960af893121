"""The skeleton type "umat": Fortran subroutines against the native law and closed forms, in points and finite elements."""
import os
import shutil
import unittest

import numpy as np

from mudline_case import point_deck, program
from umat_case import BLOCK, E, EXAMPLES, HERE, NU, START, UmatCase, as_xml

NATIVE = {"type": "linear elastic", "Young's modulus": E, "Poisson's ratio": NU}
COMPARED = 1e-10


class Umat(UmatCase):
    def assert_same(self, ours, theirs, names=None):
        for name in names or ours.columns:
            scale = max(np.abs(ours[name]).max(), 1e-3)  # strains and stresses that are zero may hold rounding
            scale = max(scale, 1e3) if "stress" in name else scale
            self.assertLess(np.abs(ours[name] - theirs[name]).max() / scale, COMPARED, name)

    def test_elastic_points(self):
        tests = {"cd": {"type": "triaxial drained", "axial strain": [0.1, -0.05]}, "oedometer": {"type": "oedometer", "axial stress": [4e5]},
                 "shear": {"type": "simple shear", "shear strain": [3.0]},
                 "drained_shear": {"type": "simple shear", "drainage": "drained", "shear strain": [0.3]},
                 "biaxial": {"type": "plane strain", "axial strain": [0.1]}}
        for test in tests.values():
            test.update({"steps": 50, "initial state": START})
        native = self.points(NATIVE, tests, "native")
        for components in (4, 6):
            umat = self.points(self.umat(os.path.join(EXAMPLES, "elastic.f90"), components=components), tests, f"umat{components}")
            for name in tests:
                self.assert_same(native[name], umat[name])

    def test_six_components(self):
        path = {"path": {"type": "path", "duration": 1.0, "steps": 20, "shear strain yz": "0.01*t", "shear stress xz": "2e3*t",
                         "strain xx": "0.02*t", "effective stress zz": "6e4+1e4*t", "initial state": START}}
        native = self.points(NATIVE, path, "native")["path"]
        self.assert_same(native, self.points(self.umat(os.path.join(EXAMPLES, "elastic.f90")), path, "umat")["path"])
        self.write("four.xml", point_deck(self.umat(os.path.join(EXAMPLES, "elastic.f90"), components=4), path, 0.8))
        done = program(["point", "four.xml"], folder=self.folder)  # four components know no shear out of the plane
        self.assertEqual(done.returncode, 3, done.stdout)

    def test_elastic_elements(self):
        """A block that is compressed and sheared by 40 %, in plane strain; compressed in axisymmetry."""
        for geometry, shear in (("plane strain", "0.4"), ("axisymmetric", "0")):
            text = BLOCK.replace("GEOMETRY", geometry).replace("SHEAR", shear)
            if geometry == "axisymmetric":
                text = text.replace('value="{1.0, 1.0}"/>\n', 'value="{1.0, 1.0}"/><Parameter name="lower" type="Array(double)" value="{0.2, 0.0}"/>\n')
            native = self.run_deck(self.write("native.xml", text.replace("SKELETON", as_xml(NATIVE))))
            for components in (4, 6):
                skeleton = self.umat(os.path.join(EXAMPLES, "elastic.f90"), components=components, state_variables=1)
                umat = self.run_deck(self.write("umat.xml", text.replace("SKELETON", as_xml(skeleton))))
                self.assert_same(native, umat, [n for n in native.columns if n.startswith("probe/") and np.abs(native[n]).max() > 1e-9])
                np.testing.assert_array_equal(native.time, umat.time)

    def test_von_mises(self):
        """q along E, then along E H/(E + H); elastic unloading; conformance."""
        shutil.copy(os.path.join(EXAMPLES, "triaxial.xml"), self.folder)
        self.library(os.path.join(EXAMPLES, "von_mises.f90"))
        histories = self.run_point("triaxial.xml")
        h, young, hardening, strength = histories["drained"], 2e7, 5e5, 60e3
        strain = h["axial strain"]
        yielding = strength + young * hardening / (young + hardening) * (strain - strength / young)
        np.testing.assert_allclose(h["deviatoric stress"], np.where(strain < strength / young, young * strain, yielding), rtol=1e-9, atol=1e-3)
        np.testing.assert_allclose(h["statev 1"][-1], (h["deviatoric stress"][-1] - strength) / hardening, rtol=1e-9)
        done = program(["point", "triaxial.xml", "--conformance"], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(done.stdout.count(" ok "), 8, done.stdout)

    def test_conformance_in_the_plane(self):
        """Four components: checked without shear out of the plane. A hidden memory is found."""
        source = os.path.join(EXAMPLES, "elastic.f90")
        for name, skeleton, code in (("plane", self.umat(source, components=4), 0), ("memory", self.forgetful(source), 1)):
            self.write(name + ".xml", point_deck(skeleton, {}, 0.8))
            done = program(["point", "--conformance", name + ".xml"], folder=self.folder)
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)
            self.assertEqual("shear in the plane only" in done.stdout, name == "plane", done.stdout)
            self.assertEqual("purity          FAILED" in done.stdout, name == "memory", done.stdout)

    def forgetful(self, source):
        with open(source) as file:
            text = file.read().replace("  integer :: i\n", "  integer :: i\n  double precision, save :: calls = 0\n")
        text = text.replace("  stress = stress + matmul(ddsdde, dstran)\n", "  calls = calls + 1\n  stress = stress + matmul(ddsdde, dstran) * (1 + 1d-9 * calls)\n")
        return self.umat(self.write("memory.f90", text))

    def test_what_the_subroutine_is_given(self):
        """The subroutine fails where an argument is not as promised; the rotated tensors are checked to a shear of 2."""
        skeleton = self.umat(os.path.join(HERE, "echo.f90"), symbol="echo_", material_name="Echo clay", properties=[E, NU, 1e9],
                             state_variables=15, initial_state=[0.0] * 14 + [7.0], tensor_state=[2.0, 8.0])
        tests = {"shear": {"type": "simple shear", "drainage": "drained", "shear strain": [2.0], "steps": 100, "initial state": START},
                 "path": {"type": "path", "duration": 10.0, "steps": 10, "shear strain yz": "0.01*t", "shear strain xz": "0.02*t",
                          "strain xx": "0.03*t", "initial state": START}}
        given = self.points(skeleton, tests, "echo")
        self.assertEqual(given["shear"]["statev 15"][0], 7.0)
        self.assertEqual(given["shear"]["statev 15"][-1], ord("E"))
        self.assertEqual(given["shear"]["statev 14"][-1], 100)
        self.assertEqual(given["path"]["statev 1"][-1], 10.0)
        for c in ("xx", "yz", "xz"):  # tensors come back in mudline's order
            kind = "effective stress " if c == "xx" else "shear stress "
            np.testing.assert_allclose(given["path"]["statev 2 " + c][1:], -given["path"][kind + c][1:], rtol=1e-12)
        native = self.points(NATIVE, tests, "native")
        for name in tests:
            self.assert_same(native[name], given[name], native[name].columns)

    # what the subroutine asks for beside stress and strain: asks.f90
    def asking(self, what, *more, **entries):
        entries = dict({"symbol": "asks_"}, **entries)
        skeleton = self.umat(os.path.join(HERE, "asks.f90"), **entries)
        return dict(skeleton, properties=[E, NU, float(what), *more])

    def test_first_increment(self):
        """A yield stress that is set at KSTEP = KINC = 1, in points and in elements, there over two stages, a restart and
        a moving mesh."""
        strength, hardening = 60e3, 5e5
        law = dict(self.asking(1, strength, hardening), **{"state variables": 1})
        test = {"cd": {"type": "triaxial drained", "axial strain": [0.03, 0.02], "steps": 50, "initial state": {"mean effective stress": 1e5}}}
        h = self.points(law, test, "first")["cd"]
        strain = h["axial strain"]
        expected = strength + E * hardening / (E + hardening) * (strain - strength / E)
        yields = (strain > strength / E) & (strain >= np.maximum.accumulate(strain))
        np.testing.assert_allclose(h["deviatoric stress"][yields], expected[yields], rtol=1e-9)
        stored = self.umat(os.path.join(EXAMPLES, "von_mises.f90"), properties=[E, NU, strength, hardening], state_variables=1)
        text = BLOCK.replace("GEOMETRY", "plane strain").replace("SHEAR", "0.1")
        text = text.replace('<ParameterList name="load">', '<ParameterList name="first"><Parameter name="type" type="string" value="quasi-static"/>'
                            '<Parameter name="duration" type="double" value="0.5"/><ParameterList name="time step"><Parameter name="initial" type="double" value="0.125"/>'
                            '</ParameterList></ParameterList><ParameterList name="load">').replace('name="duration" type="double" value="1.0"', 'name="duration" type="double" value="0.5"')
        runs = {}
        for name, skeleton in (("stored", stored), ("first", law)):
            self.write(name + ".xml", text.replace("SKELETON", as_xml(skeleton)))
            runs[name] = self.run_deck(name + ".xml")
        columns = [n for n in runs["stored"].columns if n.startswith("probe/") and np.abs(runs["stored"][n]).max() > 1e-9]
        self.assert_same(runs["stored"], runs["first"], columns)
        self.write("broken.xml", text.replace("SKELETON", as_xml(law)))
        self.run_deck("broken.xml", extra=["--steps", "2"])
        self.assert_same(runs["stored"], self.run_deck("broken.xml", extra=["--restart"]), columns)

    def test_deformation_gradient(self):
        """A neo-Hookean law in oedometer and simple shear against its closed form, at a point and in elements."""
        mu, lam = E / (2 * (1 + NU)), E * NU / ((1 + NU) * (1 - 2 * NU))
        point = self.points(self.asking(2), {"oed": {"type": "oedometer", "axial strain": [0.05], "steps": 20, "initial state": {"mean effective stress": 1e5}}}, "hyper")["oed"]
        j = np.exp(-point["axial strain"][1:])
        np.testing.assert_allclose(-point["effective stress yy"][1:], mu / j * (j**2 - 1) + lam * np.log(j) / j, rtol=1e-9)
        for shear, height in (("0", "-0.1*t*y"), ("0.4*t*y", "0.0")):
            text = BLOCK.replace("GEOMETRY", "plane strain").replace("SKELETON", as_xml(self.asking(2)))
            begin, end = text.index('<ParameterList name="boundary conditions">'), text.index('<ParameterList name="stages">')
            sides = "".join(f'<ParameterList name="{s}"><Parameter name="type" type="string" value="displacement"/><Parameter name="set" type="string" value="{s}"/>'
                            f'<Parameter name="x" type="string" value="{shear}"/><Parameter name="y" type="string" value="{height}"/></ParameterList>'
                            for s in ("left", "right", "bottom", "top"))
            self.run_deck(self.write("hyper.xml", text[:begin] + '<ParameterList name="boundary conditions">' + sides + "</ParameterList>\n  " + text[end:]))
            k, stretch = (0.4, 1.0) if height == "0.0" else (0.0, 0.9)
            stress = {"xx": mu / stretch * k**2 + lam * np.log(stretch) / stretch, "xy": mu / stretch * k * stretch,
                      "yy": mu / stretch * (stretch**2 - 1) + lam * np.log(stretch) / stretch}
            found = self.cell_values("hyper", ["effective stress"])["effective stress"]  # xx xy xz yy yz zz, tension positive
            for c, slot in (("xx", 0), ("xy", 1), ("yy", 3)):
                np.testing.assert_allclose(found[:, slot], stress[c], atol=1e-8 * mu, err_msg=f"{c} {shear} {height}")

    def test_place(self):
        """A stiffness that grows with the depth by COORDS(2): the settlement of a loaded column is q/(0.1 M) ln 2."""
        with open(os.path.join(HERE, "place.xml")) as file:
            text = file.read()
        history = self.run_deck(self.write("place.xml", text.replace("SKELETON", as_xml(self.asking(3)))))
        modulus = E * (1 - NU) / ((1 + NU) * (1 - 2 * NU))
        settlement = 1e4 / (0.1 * modulus) * np.log(2)
        self.assertAlmostEqual(-history["probe/top/displacement y"][-1] / settlement, 1, delta=1e-3)

    def test_rotation_and_gradients_go_on(self):
        """DROT turns what the law keeps as mudline turns the stress; DFGRD0 is DFGRD1 of the step before."""
        text = BLOCK.replace("GEOMETRY", "plane strain").replace("SHEAR", "0.4")
        steps = len(self.run_deck(self.write("native.xml", text.replace("SKELETON", as_xml(NATIVE)))).time)
        for what, state in ((9, 6), (13, 9)):
            law = self.asking(what, state_variables=state)
            history = self.run_deck(self.write("asks.xml", text.replace("SKELETON", as_xml(law))))
            self.assertEqual(len(history.time), steps)  # a refusal would cut steps
        turned = {"shear": {"type": "simple shear", "drainage": "drained", "shear strain": [0.5], "steps": 50, "initial state": START}}
        for what, state in ((9, 6), (13, 9)):
            self.write("turned.xml", point_deck(self.asking(what, state_variables=state), turned, 0.8))
            done = program(["point", "turned.xml"], folder=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("(50 steps, results", done.stdout)

    def test_numbers(self):
        """KSTEP, KINC, NOEL, NPT, TIME, CELENT, COORDS of a run with two stages."""
        law = self.asking(10, state_variables=9)
        text = BLOCK.replace("GEOMETRY", "plane strain").replace("SHEAR", "0.1").replace("SKELETON", as_xml(law))
        text = text.replace('<ParameterList name="load">', '<ParameterList name="first"><Parameter name="type" type="string" value="quasi-static"/>'
                            '<Parameter name="duration" type="double" value="0.5"/><ParameterList name="time step"><Parameter name="initial" type="double" value="0.125"/>'
                            '</ParameterList></ParameterList><ParameterList name="load">')
        self.run_deck(self.write("numbers.xml", text))
        values = self.cell_values("numbers", ["statev %d" % i for i in range(1, 10)])
        np.testing.assert_allclose(values["statev 1"], 2.0)
        np.testing.assert_allclose(values["statev 2"], 8.0)
        np.testing.assert_allclose(sorted(values["statev 3"]), [1.0, 2.0, 3.0, 4.0])
        np.testing.assert_allclose(values["statev 4"], 5.0)  # mean of 1 to 9
        np.testing.assert_allclose(values["statev 5"], 0.875)
        np.testing.assert_allclose(values["statev 6"], 1.375)
        self.assertTrue(np.all(np.abs(values["statev 7"] - 0.25) < 0.03), values["statev 7"])
        self.assertTrue(np.all((values["statev 8"] > 0.2) & (values["statev 8"] < 0.95)))

    def test_temperature(self):
        """TEMP is that of the model: 1 kPa per degree and step of the law, in soil at 30 degC."""
        with open(os.path.join(HERE, "warm.xml")) as file:
            text = file.read()
        history = self.run_deck(self.write("warm.xml", text.replace("SKELETON", as_xml(self.asking(12)))))
        self.assertEqual(len(history.time), 2)
        found = self.cell_values("warm", ["effective stress"])["effective stress"]
        np.testing.assert_allclose(found[:, [0, 3, 5]], 2 * 3e4, rtol=1e-9)

    def test_what_cannot_be_told_is_no_number(self):
        """The place of a point test, PREDEF, and a temperature that the model does not have."""
        test = {"cd": {"type": "triaxial drained", "axial strain": [0.01], "steps": 5, "initial state": START}}
        for what in (3, 11, 12):
            self.write("unknown.xml", point_deck(self.asking(what), test, 0.8))
            done = program(["point", "unknown.xml"], folder=self.folder)
            self.assertEqual(done.returncode, 3, done.stdout)
            self.assertIn("it returns a number that is not finite", done.stderr)
        warm = dict(self.asking(12), temperature=0.0)
        self.assert_same(self.points(NATIVE, test, "native")["cd"], self.points(warm, test, "warm")["cd"])

    def test_writing_outside_is_the_laws_fault(self):
        """Named with the array, on the first occasion; far outside it is a crash of the library's."""
        test = {"cd": {"type": "triaxial drained", "axial strain": [0.05], "steps": 10, "initial state": {"mean effective stress": 1e5}}}
        said = {4: "writes past the end of STATEV, whose size is 1;", 5: "writes past the end of STRESS, whose size is 6;",
                6: "writes past the end of DDSDDE, whose size is 36;", 7: "writes before the begin of STATEV;", 8: "the library 'asks.so' crashed (invalid memory access"}
        block = BLOCK.replace("GEOMETRY", "plane strain").replace("SHEAR", "0.1")
        for what, words in said.items():
            skeleton = self.asking(what, state_variables=1)
            self.write("point.xml", point_deck(skeleton, test, 0.8))
            self.write("run.xml", block.replace("SKELETON", as_xml(skeleton)))
            for command in ("point", "run"):
                done = program([command, command + ".xml"], folder=self.folder)
                self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
                self.assertIn(words, done.stderr)
                self.assertIn("library 'asks.so'", done.stderr)

    def test_pnewdt_cuts(self):
        """Steps longer than the subroutine wants are cut, in points and in finite elements."""
        skeleton = self.umat(os.path.join(HERE, "echo.f90"), symbol="echo_", material_name="Echo clay", properties=[E, NU, 0.03],
                             state_variables=15, tensor_state=[2.0, 8.0])
        test = {"cut": {"type": "oedometer", "axial strain": [0.1], "strain rate": 0.1, "steps": 10, "initial state": START}}
        self.write("cut.xml", point_deck(skeleton, test, 0.8))
        done = program(["point", "cut.xml"], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("10 steps, 30 cuts", done.stdout)
        text = BLOCK.replace("GEOMETRY", "plane strain").replace("SHEAR", "0.1").replace("SKELETON", as_xml(skeleton))
        history = self.run_deck(self.write("block.xml", text))
        self.assertLessEqual(np.diff(history.time).max(), 0.03 * (1 + 1e-9))

    def test_errors(self):
        good = self.umat(os.path.join(EXAMPLES, "elastic.f90"), state_variables=7)
        test = {"cd": {"type": "triaxial drained", "axial strain": [0.1], "initial state": START}}
        with open(os.path.join(self.folder, "rubbish.so"), "w") as file:
            file.write("no library")
        cases = [({"library": "none.so"}, "library", "the file 'none.so' does not exist"),
                 ({"library": "rubbish.so"}, "library", "the library cannot be loaded: "),
                 ({"symbol": "umat"}, "symbol", "the library 'elastic.so' holds no subroutine 'umat'; compilers usually write UMAT as umat_"),
                 ({"components": 5}, "components", "5 is no number of stress components; allowed: 4, 6"),
                 ({"initial state": [1.0]}, "initial state", "expected 7 numbers (see 'state variables'), given 1"),
                 ({"tensor state": [3.0]}, "tensor state", "no six components from 3 among 7 state variables"),
                 ({"statev": 3}, "statev", "unknown parameter")]
        for change, entry, message in cases:
            self.write("wrong.xml", point_deck(dict(good, **change), test, 0.8))
            done = program(["check", "wrong.xml"], folder=self.folder)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertIn(f": materials/soil/skeleton/{entry}: {message}", done.stderr)


if __name__ == "__main__":
    unittest.main()
