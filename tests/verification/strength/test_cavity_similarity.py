"""Expansion of spherical cavities in Modified Cam Clay, and of both kinds in Mohr-Coulomb soil, against exact similarity solutions."""
import unittest

import numpy as np

from cavity_case import AREA, DRAINED, CavityCase, clay, sand
from compared_case import problem
from mudline_case import deck_text
from references.cavity import Drained, HypoplasticRates, Undrained
from references.hypoplasticity import HOCHSTETTEN
from strength_case import SAND


@problem("exact", "similarity solutions after Yu and Houlsby (1991), Collins and Yu (1996)", "Cavities")
class Similarity(CavityCase):
    def test_sphere_in_clay(self):
        for settings, solution, tolerances in (([], Undrained(clay((100.0,) * 3, 2.0), 2, 4.001), (2e-3, 1e-2)),
                                               ([DRAINED, "mesh/parameters/sectors=4"], Drained(clay((100.0,) * 3, 2.0), 2, 4.001), (2e-3,))):
            history = self.run_deck(self.deck("cavity_expansion", "clay_sphere"), settings)
            self.compare_pressures(type(solution).__name__, history, 2, solution, *tolerances)

    def test_sand(self):
        for name, k in (("cylinder", 1), ("sphere", 2)):
            history = self.run_deck(self.deck("cavity_expansion", "sand_" + name))
            self.compare_pressures(name, history, k, Drained(sand(k), k, 4.001), 2e-3)

    @problem("exact", "similarity solution in hypoplastic sand, after Osinov and Cudmani (2001)")
    def test_hypoplastic_sand(self):
        for shape, k, tolerance in (("cylinder", 1, 2e-3), ("sphere", 2, 5e-3)):
            with open(self.deck("cavity_expansion", "sand_" + shape), encoding="utf-8") as file:
                text = file.read()
            text = text.replace('"sphere.geo"', f'"{self.deck("cavity_expansion", "sphere")[:-4]}.geo"')
            text = text.replace('<Parameter name="density" type="double" value="1800"/>',
                                '<Parameter name="void ratio" type="double" value="0.65"/>')
            start = text.index('<ParameterList name="skeleton">')
            end = text.index("</ParameterList>", start) + len("</ParameterList>")
            name = "hypoplastic_" + shape
            deck = self.write(name + ".xml", text[:start] + deck_text("skeleton", SAND) + text[end:])
            law = HypoplasticRates(HOCHSTETTEN, 0.65, (100e3,) * 3)
            history = self.run_deck(deck, ["output/name=" + name], name=name)
            solution = Drained(law, k, 4.001)
            radius = 1 + 3 * history.time ** 2
            pressure = history["reaction/cavity x"] / AREA[k](radius)
            for a in (1.2, 2.0, 4.0):
                self.compare_values(f"{name}, pressure at {a:g} radii", np.interp(a, radius, pressure),
                                    solution.at(a)[0][0], tolerance)


if __name__ == "__main__":
    unittest.main()
