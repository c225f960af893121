"""Names and values that are no text, or that lead out of the folder of the results."""
import glob
import os
import subprocess
import unittest
import xml.etree.ElementTree as ElementTree

from mudline_case import PROGRAM, ROOT, MudlineCase, program

BALL = os.path.join(ROOT, "tests", "mpi", "ball_in_clay.xml")
SMALL = ["--set", "mesh/cells={4, 4}"]
LONG = 10_000_000
MSH = b"""$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
2 1 "s\xf6il"
$EndPhysicalNames
$Nodes
3
1 0 0 0
2 1 0 0
3 0 1 0
$EndNodes
$Elements
1
1 2 2 1 1 1 2 3
$EndElements
"""


class Names(MudlineCase):
    def setUp(self):
        super().setUp()
        with open(BALL, "rb") as file:
            self.text = file.read()

    def put(self, name, content):
        path = os.path.join(os.fsencode(self.folder), name)
        with open(path, "wb") as file:
            file.write(content)
        return path

    def refused(self, expected, *arguments):
        """Exit code 2 and one printable line."""
        done = subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True)
        self.assertEqual(done.returncode, 2, done.stderr[-500:])
        line = done.stderr.decode()  # raises where it is not UTF-8
        self.assertEqual(line.count("\n"), 1, line[:3000])
        self.assertTrue(line[:-1].isprintable(), line[:3000])
        self.assertLess(len(line), 2200)
        self.assertIn(expected, line)

    def test_latin_1(self):
        latin = self.text.replace(b'"clay"', b'"cl\xe9"')
        self.put(b"latin.xml", latin)
        self.refused("latin.xml:12: the deck holds the byte 0xe9, which is not UTF-8; a deck is plain text in UTF-8", "check", "latin.xml")
        self.refused("latin.xml:12: the deck holds", "check", BALL, "latin.xml")  # an overlay
        self.refused(r"argument 2, 'd\xe9ck.xml', holds the byte 0xe9", "check", self.put(b"d\xe9ck.xml", self.text)[len(self.folder) + 1:])
        self.refused("argument 4, 'output/name=caf\\xe9', holds", "check", BALL, "--set", b"output/name=caf\xe9")
        for byte in (b"\xc0\xaf", b"\xed\xa0\x80", b"\xf5\x80\x80\x80", b"\xe2\x82", b"\x80", b"\xef\xbf\xbf"):
            self.put(b"bad.xml", self.text.replace(b'"clay"', b'"' + byte + b'"'))
            self.refused("which is not UTF-8", "check", "bad.xml")

    def test_group_of_a_mesh(self):
        self.put(b"groups.msh", MSH)
        start, end = self.text.index(b'<ParameterList name="mesh">'), self.text.index(b'<ParameterList name="materials">')
        mesh = (b'<ParameterList name="mesh"><Parameter name="type" type="string" value="gmsh"/><Parameter name="file" type="string" '
                b'value="groups.msh"/><Parameter name="geometry" type="string" value="axisymmetric"/><Parameter name="order" type="int" value="1"/></ParameterList>\n')
        self.put(b"deck.xml", self.text[:start] + mesh + self.text[end:])
        self.refused("which holds the byte 0xf6, which is not UTF-8", "check", "deck.xml")

    def test_control_characters(self):
        for new in (b'"cl\x1b[31m"', b'"cl\x07"', b'"cl\xc2\x9b31m"', b'"cl\x7f"', b'"cl&#27;[31m"', b'"cl&#x9b;"', b'"cl\x00"'):
            self.put(b"terminal.xml", self.text.replace(b'"clay"', new))
            self.refused("holds the control character 0x", "check", "terminal.xml")
        self.put(b"terminal.xml", self.text.replace(b'value="1.2"', b'value="&#27;[2J"'))
        self.refused("the value holds the control character 0x1b", "check", "terminal.xml")
        self.refused("holds the control character 0x1b", "check", b"no\x1b[31m.xml")
        self.refused("holds the control character 0x1b", "check", BALL, "--set", "a/b\x1b[31m=1")

    def test_long_values(self):
        for old, new in ((b'value="1.2"', b'value="%s"'), (b'value="dynamic"', b'value="%s"'), (b'name="duration"', b'name="%s"'),
                         (b'<ParameterList name="output">', b'<%s name="output">'), (b'type="double"', b'type="%s"')):
            self.put(b"long.xml", self.text.replace(old, new % (b"A" * LONG), 1))
            self.refused("long.xml:", "check", "long.xml")
        self.refused("bytes left out", "check", BALL, "--set", "B" * 100000 + "=1")

    def test_names_of_results(self):
        for name in ("", " ", ".", "..", "../x", "a/b", "/elsewhere/x", "a:b", "a" * 201):
            self.refused("output/name: '", "check", BALL, "--set", "output/name=" + name, "--set", "output/folder=results")
        self.assertFalse(os.path.exists(os.path.join(self.folder, "x.csv")))

    def test_results_are_xml(self):
        name = "a&b <c> '\"é"
        with open(os.path.join(self.folder, name + ".xml"), "wb") as file:
            file.write(self.text.replace(b'"ball on clay"', b'"b&amp;&lt;&quot;&#246;"').replace(b'name="ball"', b'name="b&lt;&amp;&#228;"')
                       .replace(b'value="ball"', b'value="b&lt;&amp;&#228;"'))
        done = program(["run", "-q", name + ".xml", *SMALL], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        [path] = glob.glob(os.path.join(glob.escape(self.folder), "results", "*.xdmf"))
        items = [item.text for item in ElementTree.parse(path).iter("DataItem") if item.get("Format") == "HDF"]
        self.assertGreater(len(items), 5)
        for item in items:
            file = os.path.join(self.folder, "results", item.split(":")[0])
            self.assertTrue(os.path.exists(file), item)


if __name__ == "__main__":
    unittest.main()
