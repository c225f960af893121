"""What a UMAT has besides its arguments: utility routines against NumPy, SDVINI, SIGINI, stress units."""
import glob
import os
import unittest

import numpy as np

from mudline_case import History, point_deck, program
from umat_case import BLOCK, E, EXAMPLES, HERE, NU, START, UmatCase, as_xml

UTILITIES = os.path.join(HERE, "utilities.f90")
STARTS = os.path.join(HERE, "starts.f90")
ROUTINES = 1e-12  # of the tensor's norm
UNITS = 1e-12  # of a column's largest value
ONE_STEP = {"cd": {"type": "triaxial drained", "axial strain": [1e-4], "steps": 1, "initial state": START}}
INITIAL = '<ParameterList name="initial state">'
UNIFORM = BLOCK[BLOCK.index(INITIAL):BLOCK.index("</ParameterList></ParameterList></Par")]
BY_LAW = INITIAL + '<Parameter name="type" type="string" value="by law"/>\n    '
SPACE = ('<ParameterList name="mesh"><Parameter name="type" type="string" value="box"/>'
         '<Parameter name="geometry" type="string" value="three-dimensional"/>'
         '<Parameter name="cell" type="string" value="tet10"/>'
         '<Parameter name="cells" type="Array(int)" value="{1, 1, 2}"/>'
         '<Parameter name="lower" type="Array(double)" value="{0.0, 0.0, -1.0}"/>'
         '<Parameter name="upper" type="Array(double)" value="{1.0, 1.0, 0.0}"/></ParameterList>\n  ')


def matrix(six, direct, shear, factor):
    """The tensor whose first components are given, with the others 0."""
    full = np.diag(np.append(six[:direct], np.zeros(3 - direct)))
    for value, (i, j) in zip(six[direct:direct + shear], ((0, 1), (0, 2), (1, 2))):
        full[i, j] = full[j, i] = value / factor
    return full


def components(full, direct, shear, factor):
    return np.append(np.diag(full)[:direct], [factor * full[i] for i in ((0, 1), (0, 2), (1, 2))[:shear]])


def rotation(random):
    q = np.linalg.qr(random.normal(size=(3, 3)))[0]
    return q * np.linalg.det(q)


class Utilities(UmatCase):
    def asking(self, what, *more, **entries):
        return dict(self.umat(UTILITIES, **entries), properties=[E, NU, float(what), *more])

    def utilities_of(self, tensor, turn, direct, shear):
        """The 44 numbers that utilities.f90 puts into STATEV."""
        law = self.asking(1, float(direct), float(shear), *tensor, *turn.flatten(order="F"), state_variables=44)
        history = self.points(law, ONE_STEP, "routines")["cd"]
        return np.array([history[f"statev {i}"][-1] for i in range(1, 45)])

    def test_routines(self):
        """SINV, SPRINC, SPRIND, ROTSIG: general tensors, equal and nearly equal principal values, few components."""
        random = np.random.default_rng(7)
        turn = rotation(random)
        equal = turn @ np.diag([2e5, -1e5, 2e5]) @ turn.T
        near = turn @ np.diag([1e5, 1e5 * (1 + 1e-9), 3e5]) @ turn.T
        tensors = [random.normal(size=6) * 1e5 for _ in range(3)]
        tensors += [components(full, 3, 3, 1) for full in (equal, near)] + [np.array([-5e4] * 3 + [0] * 3)]
        few = ((3, 1), (2, 1), (3, 2), (1, 0), (2, 3))
        cases = [(t, 3, 3) for t in tensors] + [(tensors[0], n, k) for n, k in few]
        for tensor, direct, shear in cases:
            found = self.utilities_of(tensor, turn, direct, shear)
            full = {1: matrix(tensor, direct, shear, 1), 2: matrix(tensor, direct, shear, 2)}
            bound = ROUTINES * np.linalg.norm(tensor)

            def check(values, expected):
                what = f"{tensor} {direct} {shear}"
                np.testing.assert_allclose(values, expected, rtol=0, atol=bound, err_msg=what)

            deviator = full[1] - np.trace(full[1]) / 3 * np.eye(3)
            check(found[:2], [np.trace(full[1]) / 3, np.sqrt(1.5 * np.sum(deviator**2))])
            for lstr, first, both, turned in ((1, 2, 8, 32), (2, 5, 20, 38)):
                expected = np.linalg.eigvalsh(full[lstr])
                check(found[first:first + 3], expected)
                check(found[both:both + 3], expected)
                axes = found[both + 3:both + 12].reshape(3, 3, order="F")  # AN(K, I): direction K in its row
                np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-13)
                self.assertAlmostEqual(np.linalg.det(axes), 1, delta=1e-13)
                check(axes @ full[lstr] @ axes.T, np.diag(expected))
                rotated = components(turn @ full[lstr] @ turn.T, direct, shear, lstr)
                check(found[turned:turned + direct + shear], rotated)
                np.testing.assert_array_equal(found[turned + direct + shear:turned + 6], 0)

    def test_own_routines_stay(self):
        """A library with a SINV of its own keeps it beside one that has mudline's, in either order; what it lacks it
        gets."""
        own = self.umat(os.path.join(HERE, "own_sinv.f90"), properties=[1e7], state_variables=5)
        tensor, turn = np.array([1e5, 2e5, 3e5, 0, 0, 0]), np.eye(3)
        ours = self.asking(1, 3.0, 3.0, *tensor, *turn.flatten(), state_variables=44)
        for first, second in (("own", "ours"), ("ours", "own")):
            text = point_deck({"own": own, "ours": ours}[first], {}, 0.8)
            material = text[text.index('<ParameterList name="soil">'):text.index('<ParameterList name="tests">')]
            other = material.replace('"soil"', '"other"').replace(
                as_xml({"own": own, "ours": ours}[first]), as_xml({"own": own, "ours": ours}[second]))
            tests = {name: dict(ONE_STEP["cd"], material=name) for name in ("soil", "other")}
            text = point_deck({"own": own, "ours": ours}[first], tests, 0.8)
            text = text.replace('<ParameterList name="soil">\n', other[:other.rindex("</ParameterList>")] +
                                '<ParameterList name="soil">\n', 1)
            found = self.run_point(self.write("both.xml", text))
            of = {first: found["soil"], second: found["other"]}
            self.assertEqual([of["own"][f"statev {i}"][-1] for i in range(1, 6)], [-1, -2, 1, 2, 3])
            self.assertAlmostEqual(of["ours"]["statev 1"][-1], 2e5, delta=1e-6)

    def block(self, skeleton, name, **replaced):
        text = BLOCK.replace("GEOMETRY", "plane strain").replace("SHEAR", "0.1").replace("SKELETON", as_xml(skeleton))
        for old, new in replaced.values():
            self.assertIn(old, text)
            text = text.replace(old, new)
        return self.write(name + ".xml", text)

    def test_end_of_the_run(self):
        """XIT and LOP = -3: one line with law and library, exit code 1, and the steps before are kept."""
        who = "law 'Soft clay' of the library 'utilities.so', element "
        for what, words in ((2, "it ends the run by XIT"), (3, "it ends the run: no more of soft, ")):
            law = self.asking(what, material_name="Soft clay")
            for ranks in (1, 2):
                for file in glob.glob(os.path.join(self.folder, "results", "*")):
                    if os.path.isfile(file):
                        os.remove(file)
                done = program(["run", self.block(law, "ends")], ranks, self.folder)
                self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
                lines = [line for line in done.stderr.splitlines() if line.startswith("error: ")]
                self.assertEqual(len(lines), 1, done.stderr)
                self.assertIn(who, lines[0])
                self.assertIn(words, lines[0])
                if ranks == 1:
                    self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                kept = History(os.path.join(self.folder, "results", "ends.csv"))
                np.testing.assert_allclose(kept.time, np.arange(1, 5) / 8)
                self.assertAlmostEqual(kept["probe/middle/displacement y"][-1], -0.025, delta=0.002)
                fields = self.cell_values("ends", ["effective stress"], 0)  # the file can be read
                np.testing.assert_allclose(fields["effective stress"][:, 3], -1e5)
            test = {"oed": {"type": "oedometer", "axial strain": [0.1], "strain rate": 0.1, "steps": 10,
                            "initial state": START}}
            done = program(["point", self.write("p.xml", point_deck(law, test, 0.8))], folder=self.folder)
            self.assertEqual(done.returncode, 1)
            self.assertIn(who + "1, point 1: " + words, done.stderr)
            self.assertEqual(len(History(os.path.join(self.folder, "results", "p_oed.csv")).time), 6)

    def test_messages(self):
        """%I, %R and %S are filled; messages go to standard output, warnings and errors to the other one, counted."""
        law = self.asking(4)
        for command, deck in (("run", self.block(law, "told")),
                              ("point", self.write("p.xml", point_deck(law, ONE_STEP, 0.8)))):
            done = program([command, deck], folder=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            who = "law 'UMAT' of the library 'utilities.so', element 1, point 1: "
            self.assertIn(who + "element 1 has 0.5 and -0.002\n", done.stdout)
            self.assertEqual(done.stderr.splitlines()[-4:],
                             [f"warning: {who}soft clay: 5 % of 1, 42", f"warning: {who}error 1: not found",
                              f"warning: {who}error 2: nor found again",
                              "warning: UMATs reported errors by STDB_ABQERR: 2"])

    def test_many_messages(self):
        """A law that complains in every call fills no disk: 200 lines; the errors of all ranks are counted."""
        counted = {}
        for ranks in (1, 2):
            done = program(["run", self.block(self.asking(6), "many")], ranks, self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            if ranks == 1:
                self.assertEqual(done.stderr.count(": again\n"), 200)
                self.assertEqual(done.stderr.count("no more messages of UMATs are shown"), 1)
            counted[ranks] = int(done.stderr.splitlines()[-1].split(": ")[-1])
        self.assertGreaterEqual(counted[1], 2 * 8 * 36)  # twice at least in each of 8 steps, at each of 36 points
        self.assertEqual(counted[1] % 36, 0)
        self.assertEqual(counted[2], counted[1])

    def test_wrong_calls(self):
        for what, words in ((5, "it calls SPRINC with LSTR = 3; allowed: 1 for stresses, 2 for strains"),
                            (7, "it calls STDB_ABQERR with LOP = 2; allowed: 1, -1, -2, -3")):
            law = self.asking(what, state_variables=3)
            done = program(["point", self.write("p.xml", point_deck(law, ONE_STEP, 0.8))], folder=self.folder)
            self.assertEqual(done.returncode, 1)
            who = "law 'UMAT' of the library 'utilities.so', element 1, point 1: "
            self.assertEqual(done.stderr, f"error: {who}{words}\n")

    def test_what_mudline_does_not_have(self):
        with open(UTILITIES) as file:
            text = file.read().replace("call xit", "call getvrm")
        law = self.umat(self.write("lacks.f90", text))
        done = program(["check", self.write("p.xml", point_deck(law, ONE_STEP, 0.8))], folder=self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn(": materials/soil/skeleton/library: the library cannot be loaded: it calls 'getvrm_', which it "
                      "does not have; mudline supplies sinv_, sprinc_, sprind_, rotsig_, xit_, stdb_abqerr_",
                      done.stderr)

    def test_conformance(self):
        law = self.asking(0)
        done = program(["point", "--conformance", self.write("p.xml", point_deck(law, {}, 0.8))], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        law = self.umat(STARTS, state_variables=7)
        done = program(["point", "--conformance", self.write("p.xml", point_deck(law, {}, 0.8))], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_initial_state_of_a_point(self):
        """SDVINI is told the test's place; SIGINI is not asked, for the test gives the stress."""
        start = dict(START, place=[3.0, -4.0])
        tests = {"cd": dict(ONE_STEP["cd"], **{"initial state": start})}
        history = self.points(self.umat(STARTS, state_variables=7), tests, "start")["cd"]
        self.assertEqual([history[f"statev {i}"][0] for i in range(1, 8)], [3, -4, 0, 7, 2, 1, 1])
        self.assertEqual(history["effective stress yy"][0], 1e5)

    def test_initial_stress(self):
        """Stress and STATEV of a block at its start are those of SIGINI and SDVINI: plane, space, kPa."""
        for geometry in ("plane", "space"):
            for unit, scale in (("Pa", 1.0), ("kPa", 1e3)):
                for count in (6,) if geometry == "space" else (6, 4):
                    law = self.umat(STARTS, state_variables=7, stress_unit=unit, components=count)
                    law["properties"] = [E / scale, NU]
                    more = {"start": (UNIFORM, BY_LAW)}
                    if geometry == "space":
                        begin = BLOCK.index('<ParameterList name="mesh">')
                        mesh = BLOCK[begin:BLOCK.index('<ParameterList name="mat')]
                        more["mesh"] = (mesh.replace("GEOMETRY", "plane strain"), SPACE)
                        more["middle"] = ("{0.5, 0.5}", "{0.5, 0.5, -0.5}")
                        more["side"] = ("{1.0, 0.5}", "{1.0, 0.5, -0.5}")
                    else:
                        more["place"] = ('name="upper" type="Array(double)" value="{1.0, 1.0}"',
                                         'name="upper" type="Array(double)" value="{1.0, 0.0}"/>\n    <Parameter '
                                         'name="lower" type="Array(double)" value="{0.0, -1.0}"')
                        more["middle"] = ("{0.5, 0.5}", "{0.5, -0.5}")
                        more["side"] = ("{1.0, 0.5}", "{1.0, -0.5}")
                    self.run_deck(self.block(law, "starts", **more))
                    names = ["effective stress"] + [f"statev {i}" for i in range(1, 8)]
                    found = self.cell_values("starts", names, 0)
                    depth = -found["statev 3" if geometry == "space" else "statev 2"]
                    stress = found["effective stress"]  # xx xy xz yy yz zz, tension positive
                    up = 5 if geometry == "space" else 3
                    expected = np.zeros_like(stress)
                    expected[:, [0, 3, 5]] = -4.5 * scale * depth[:, None]
                    expected[:, up] *= 2
                    if geometry == "space":
                        expected[:, 2] = 0.2 * scale * depth
                    np.testing.assert_allclose(stress, expected, atol=1e-10 * scale)
                    self.assertLess(abs(np.mean(depth) - 0.5), 1e-12)
                    np.testing.assert_allclose(found["statev 4"], 7)
                    np.testing.assert_allclose(found["statev 5"], 3 if geometry == "space" else 2)
                    elements = len(depth)
                    np.testing.assert_allclose(sorted(found["statev 6"]), np.arange(1, elements + 1))
                    self.assertGreater(found["statev 7"].min(), 1.5)  # a mean of 1, 2, ...

    def test_water_level(self):
        """Stresses of SIGINI in balance with the buoyant weight: a geostatic stage finds them so."""
        with open(os.path.join(HERE, "weight.xml")) as file:
            text = file.read()
        law = self.umat(STARTS, stress_unit="kPa")
        law["properties"] = [E / 1e3, NU]
        self.write("weight.xml", text.replace("SKELETON", as_xml(law)))
        done = program(["run", "weight.xml"], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.write("wrong.xml", text.replace("SKELETON", as_xml(dict(law, **{"stress unit": "Pa"}))))
        done = program(["run", "wrong.xml"], folder=self.folder)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("more than the allowed 1e-09 m", done.stderr)

    def test_stress_units(self):
        """A law that thinks in kPa or MPa gives the histories of the same law in Pa."""
        strength, hardening = 60e3, 5e5
        tests = {"cd": {"type": "triaxial drained", "axial strain": [0.05, 0.03]},
                 "cu": {"type": "triaxial undrained", "axial strain": [0.05]},
                 "shear": {"type": "simple shear", "shear strain": [0.2]}}
        for test in tests.values():
            test.update({"steps": 40, "initial state": START})
        points, runs = {}, {}
        for unit, scale in (("Pa", 1), ("kPa", 1e3), ("MPa", 1e6)):
            law = self.umat(os.path.join(EXAMPLES, "von_mises.f90"), state_variables=1, stress_unit=unit)
            law["properties"] = [E / scale, NU, strength / scale, hardening / scale]
            points[unit] = self.points(law, tests, unit)
            runs[unit] = self.run_deck(self.block(law, "run_" + unit))
        stress = {unit: self.cell_values("run_" + unit, ["effective stress"])["effective stress"] for unit in runs}
        for unit in ("kPa", "MPa"):
            error = np.abs(stress["Pa"] - stress[unit]).max() / np.abs(stress["Pa"]).max()
            self.compare(f"{unit} run effective stress", error, UNITS)
            pairs = [(points["Pa"][name], points[unit][name], name) for name in tests]
            pairs.append((runs["Pa"], runs[unit], "run"))
            for one, other, what in pairs:
                self.assertGreaterEqual(len(one.time), 8)
                for name in one.columns:
                    if what == "run" and not name.startswith("probe/"):
                        continue
                    alike = max(one.size(n) for n in one.columns if one.units[n] == one.units[name])
                    error = np.abs(one[name] - other[name]).max()
                    if one.size(name) > 1e-9 * alike:  # others are zero but for rounding
                        self.compare(f"{unit} {what} {name}", error / one.size(name), UNITS)

    def test_refused(self):
        laws = {"starts": self.umat(STARTS, state_variables=7), "plain": self.umat(UTILITIES)}
        law = "the law 'umat' of material 'soil' gives "
        with_stress = law + "the initial stress (SIGINI); allowed then: 'by law', 'from result'"
        no_stress = law + "no initial stress; a 'umat' does whose library has a SIGINI"
        K0 = BY_LAW + '<Parameter name="K0" type="double" value="0.5"/>'
        levels = BY_LAW + ('<Parameter name="water level" type="double" value="0"/>'
                           '<Parameter name="pore pressure" type="double" value="1e3"/>')
        water = BY_LAW + '<Parameter name="water level" type="double" value="0"/>'
        cases = [("starts", {}, UNIFORM, "physics/ground/initial state/type: " + with_stress),
                 ("starts", {}, INITIAL, "physics/ground/initial state/type: " + with_stress),
                 ("plain", {}, BY_LAW, "physics/ground/initial state/type: " + no_stress),
                 ("starts", {}, K0, "initial state/K0: with 'type' = 'by law' the law gives the stress"),
                 ("starts", {}, levels, "pore pressure: give either this or 'water level', not both"),
                 ("starts", {}, water, "water level: the pressure of water at rest needs gravity"),
                 ("starts", {"initial state": [0.0] * 7}, BY_LAW, "soil/skeleton/initial state: the SDVINI of the "
                  "library 'starts.so' gives STATEV at the start; give one of the two"),
                 ("plain", {"stress unit": "bar"}, UNIFORM, "soil/skeleton/stress unit: 'bar' is not a choice"),
                 ("plain", {"stress unit": "kpa"}, UNIFORM, "'kpa' is not a choice (did you mean 'kPa'?)")]
        for name, change, start, message in cases:
            deck = self.block(dict(laws[name], **change), "wrong", start=(UNIFORM, start))
            done = program(["check", deck], folder=self.folder)
            self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertIn(message, done.stderr)


if __name__ == "__main__":
    unittest.main()
