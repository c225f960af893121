"""A slice of a pile pushed sideways through Tresca clay, a quarter of it in ten-node tetrahedra, or 15-node wedges: rough, and smooth by a pressure that grows
with the displacement into the pile. Randolph and Houlsby (1984); for the smooth one also Martin and Randolph (2006)."""
import os
import re
import unittest

import numpy as np

from compared_case import problem
from mudline_case import ROOT
from space_case import SpaceCase

STRENGTH, THICKNESS = 10e3, 0.25
# of the pile at the time t, on both sides; its 1e14 Pa/m let 1e-9 m of 4e-4 m through
SMOOTH = '''<ParameterList name="pile">
      <Parameter name="type" type="string" value="pressure"/>
      <Parameter name="set" type="string" value="pile"/>
      <Parameter name="position" type="string" value="present"/>
      <Parameter name="value" type="string" value="1e14*(1 - sqrt((x - 4e-4*t)^2 + y*y))"/>
    </ParameterList>'''


@problem("exact", "Randolph and Houlsby (1984), Martin and Randolph (2006)", "Slice of a pile in Tresca clay")
class PileSegment(SpaceCase):
    def assert_collapse(self, what, deck, low, high, *settings):
        history = self.run_deck(deck, settings)
        factor = -4 * history["reaction/far side x"] / (2 * THICKNESS * STRENGTH)
        self.compare_values(what, factor[-1], (low + high) / 2, (high - low) / 2, 1.0)
        self.compare_values(what + ", growth at the end", factor[-1] / np.interp(0.9, history.time, factor) - 1, 0.0,
                            0.01, 1.0)

    def test_rough(self):
        self.assert_collapse("rough", self.input("pile_segment"), 11.94, 1.02 * 11.94)

    def test_rough_in_wedges(self):
        self.assert_collapse("rough, wedges", self.input("pile_segment"), 11.94, 1.02 * 11.94, "mesh/triangles become=wedges")

    def test_smooth(self):
        with open(self.input("pile_segment")) as file:
            text = file.read()
        changed = re.sub(r'<ParameterList name="pile">.*?</ParameterList>', SMOOTH, text, flags=re.DOTALL)
        self.assertNotEqual(text, changed)
        geometry = os.path.join(ROOT, "inputs", "space", "pile_segment.geo")
        self.assert_collapse("smooth", self.write("smooth.xml", changed.replace("pile_segment.geo", geometry)), 0.98 * 9.14, 1.02 * 9.20)


if __name__ == "__main__":
    unittest.main()
