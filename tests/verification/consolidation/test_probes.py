"""Probes that are no nodes: interpolated at a place, or at a point that travels with a body."""
import os
import unittest

import numpy as np

from compared_case import problem
from mudline_case import ROOT, MudlineCase, deck_text, program


def probes(entries):
    return deck_text("probes", {"output": {"probes": entries}})


@problem("consistency", title="Probes")
class Probes(MudlineCase):
    def test_a_place_is_interpolated_in_its_element(self):
        deck = os.path.join(ROOT, "inputs", "consolidation", "terzaghi.xml")
        overlay = self.write("probes.xml", probes({
            "middle node": [0.0, 0.5], "at node": {"point": [0.0, 0.5], "moves with": "nothing"},
            "between": {"point": [0.02, 0.5125], "moves with": "nothing"},
            "above": {"point": [0.0, 1.0], "moves with": "nothing"}}))
        settings = ("stages/consolidation/duration=100", "mesh/grading={1.0, 1.0}", "mesh/cells={1, 20}",
                    "boundary conditions/load/y=-10.0")  # small strain: places and nodes stay together
        history = self.run_deck([deck, overlay], settings)
        for field in ("pore pressure", "displacement y"):
            node, place = history[f"probe/middle node/{field}"], history[f"probe/at node/{field}"]
            self.assertGreater(np.abs(node).max(), 0)
            self.compare(field, np.abs(node - place).max() / (np.abs(node).max()), 2e-5)
        # a quarter of a cell higher: between the node and the drained top, by the pressure's own slope
        lower, between = history["probe/middle node/pore pressure"][-1], history["probe/between/pore pressure"][-1]
        self.assertLess(between, lower)
        self.assertGreater(between, lower * 0.97)
        self.assertEqual(history["probe/between/position y"][-1], 0.5125)
        self.assertEqual(np.abs(history["probe/above/pore pressure"][1:]).max(), 0)  # outside once the top has sunk: the nearest point

    @problem("behaviour")
    def test_a_point_of_a_body_goes_with_it(self):
        deck = os.path.join(ROOT, "inputs", "impact", "free_fall.xml")
        with open(deck) as file:
            body = file.read().split('<ParameterList name="bodies">')[1].split('name="')[1].split('"')[0]
        overlay = self.write("probes.xml", probes({"side": {"point": [0.3, 0.7], "moves with": body}}))
        history = self.run_deck([deck, overlay])
        fallen = history[f"body/{body}/displacement y"]
        self.assertLess(fallen[-1], -1e-3)
        np.testing.assert_allclose(history["probe/side/position y"], 0.7 + fallen, rtol=0, atol=1e-12)
        self.assertTrue((history["probe/side/position x"] == 0.3).all())

    def test_ranks_agree(self):
        """Inside, on the boundary between two ranks' parts or near it, and outside the soil; with the error of the pressure."""
        deck = os.path.join(ROOT, "inputs", "consolidation", "terzaghi.xml")
        overlay = self.write("probes.xml", probes({
            f"at {y}": {"point": [0.03, y], "moves with": "nothing"} for y in (0.13, 0.37, 0.5, 0.52, 0.77, 1.0)}))
        settings = ("stages/consolidation/duration=100", "mesh/grading={1.0, 1.0}", "mesh/cells={2, 20}", "output/error estimate=true")
        one = self.run_deck([deck, overlay], settings)
        two = self.run_deck([deck, overlay], settings, ranks=2, extra=["--overwrite"])
        names = [name for name in one.columns if name.startswith("probe/at ")]
        self.assertEqual(len(names), 6 * (2 + 2 + 2 * 2))  # position, displacement, two pressures with an error each
        for name in names:
            scale = max(np.abs(one[name]).max(), 1e-9)
            self.compare(name, np.abs(one[name] - two[name]).max() / scale, 1e-8)
        self.assertGreater(one["probe/at 0.52/pore pressure error"][-1], 0)

    @problem("behaviour")
    def test_wrong_probes_get_one_message(self):
        deck = os.path.join(ROOT, "inputs", "impact", "free_fall.xml")
        for entry, message in (({"point": [0.0, 0.0], "moves with": "bdy"}, "unknown body 'bdy'"),
                               ({"point": [0.0, 0.0]}, "'moves with' is missing"),
                               ({"point": [1e3, 0.0], "moves with": "nothing"}, "lies outside the mesh")):
            done = program(["run", deck, self.write("probes.xml", probes({"side": entry}))], folder=self.folder)
            self.assertEqual(done.returncode, 2)
            self.assertIn(message, done.stderr)
            self.assertEqual(done.stderr.strip().count("\n"), 0)


if __name__ == "__main__":
    unittest.main()
