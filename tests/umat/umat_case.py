"""What the tests of UMATs share: compiled libraries, their sections of a deck, a block under prescribed motion."""
import os
import shutil
import subprocess
import unittest

import h5py
import numpy as np

from mudline_case import ROOT, MudlineCase, point_deck

HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLES = os.path.join(ROOT, "inputs", "plugins", "umat")
E, NU = 2e7, 0.25
START = {"vertical effective stress": 1e5, "K0": 0.6}

# a block in the plane whose base is fixed and whose top moves by SHEAR*t and -0.1*t
BLOCK = """<ParameterList name="block">
  <ParameterList name="mesh">
    <Parameter name="type" type="string" value="box"/>
    <Parameter name="cell" type="string" value="quad9"/>
    <Parameter name="cells" type="Array(int)" value="{2, 2}"/>
    <Parameter name="upper" type="Array(double)" value="{1.0, 1.0}"/>
    <Parameter name="geometry" type="string" value="GEOMETRY"/>
  </ParameterList>
  <ParameterList name="materials"><ParameterList name="soil"><Parameter name="density" type="double" value="1800"/>
    <Parameter name="void ratio" type="double" value="0.8"/>SKELETON</ParameterList></ParameterList>
  <ParameterList name="physics"><ParameterList name="ground"><Parameter name="type" type="string" value="solid"/>
    <ParameterList name="initial state">
      <Parameter name="type" type="string" value="uniform"/>
      <Parameter name="effective stress xx" type="double" value="6e4"/>
      <Parameter name="effective stress yy" type="double" value="1e5"/>
      <Parameter name="effective stress zz" type="double" value="6e4"/>
    </ParameterList></ParameterList></ParameterList>
  <ParameterList name="boundary conditions">
    <ParameterList name="base">
      <Parameter name="type" type="string" value="fixed"/>
      <Parameter name="set" type="string" value="bottom"/>
    </ParameterList>
    <ParameterList name="top">
      <Parameter name="type" type="string" value="displacement"/>
      <Parameter name="set" type="string" value="top"/>
      <Parameter name="x" type="string" value="SHEAR*t"/>
      <Parameter name="y" type="string" value="-0.1*t"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="stages"><ParameterList name="load"><Parameter name="type" type="string" value="quasi-static"/>
    <Parameter name="duration" type="double" value="1.0"/>
    <ParameterList name="time step"><Parameter name="initial" type="double" value="0.125"/></ParameterList>
  </ParameterList></ParameterList>
  <ParameterList name="output"><ParameterList name="probes">
    <Parameter name="middle" type="Array(double)" value="{0.5, 0.5}"/>
    <Parameter name="side" type="Array(double)" value="{1.0, 0.5}"/>
  </ParameterList></ParameterList>
</ParameterList>
"""


def as_xml(skeleton):
    text = point_deck(skeleton, {})
    end = "</ParameterList>\n"
    return text[text.index('<ParameterList name="skeleton">'):text.index(end) + len(end)]


@unittest.skipUnless(shutil.which("gfortran"), "gfortran is not installed")
class UmatCase(MudlineCase):
    """Compiles Fortran sources and names them in decks."""

    def library(self, source):
        name = os.path.splitext(os.path.basename(source))[0] + ".so"
        output = os.path.join(self.folder, name)
        subprocess.run(["gfortran", "-O2", "-shared", "-fPIC", "-I", HERE, source, "-o", output], check=True)
        return name

    def umat(self, source, **more):
        entries = {"type": "umat", "library": self.library(source), "properties": [E, NU],
                   "bulk modulus": E / (3 * (1 - 2 * NU)), "shear modulus": E / (2 * (1 + NU))}
        entries.update({name.replace("_", " "): value for name, value in more.items()})
        return entries

    def points(self, skeleton, tests, name):
        return self.run_point(self.write(name + ".xml", point_deck(skeleton, tests, 0.8)))

    def cell_values(self, stem, names, which=-1):
        """The values of cells by name, the last ones or others."""
        with h5py.File(os.path.join(self.folder, "results", stem + ".h5"), "r") as file:
            step = file["steps"][sorted(file["steps"])[which]]
            return {name: np.array(step["cell/" + name.replace(" ", "_")]) for name in names}
