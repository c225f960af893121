"""A cone four radii deep in Tresca clay, pushed by 0.6 radii: what roughness adds to the resistance, the ripple that chords instead of arcs
bring, and the price in iterations and rejected steps."""
import os
import unittest

import numpy as np

from compared_case import problem
from mudline_case import ROOT, MudlineCase

DECKS = os.path.join(ROOT, "inputs", "cpt")
RADIUS, STRENGTH = 0.01785, 10e3
WAY = 0.6  # radii


@problem("consistency", title="Deep cone in Tresca clay, chords instead of arcs")
class DeepCone(MudlineCase):
    def push(self, *overlays):
        history = self.run_deck([os.path.join(DECKS, deck) for deck in ("deep_tresca.xml",) + overlays],
                                (f"stages/push/duration={WAY * RADIUS / 0.02}", "output/name=cone"), name="cone")
        way = -history["body/cone/displacement y"] / RADIUS
        factor = history["contact/cone/tip reaction y"] / (np.pi * RADIUS**2 * STRENGTH)
        return history, way, factor

    @staticmethod
    def ripple(way, factor):
        late = way > 0.25
        return np.std(factor[late] / np.polyval(np.polyfit(way[late], factor[late], 3), way[late]))

    def show(self, *what):
        if os.environ.get("MUDLINE_SHOW_ERRORS"):
            print(*what)

    def test_rough_and_faceted_against_smooth(self):
        history, way, smooth = self.push()
        rough = self.push("rough.xml")[2][-1]
        chords = self.push("faceted.xml")[1:]
        ripples = [self.ripple(way, smooth), self.ripple(*chords)]
        iterations = history["step/newton iterations"].mean()
        self.show("smooth, rough:", smooth[-1], rough, "ripple of arcs, chords:", ripples, len(way), "steps", iterations)
        self.assertGreater(rough - smooth[-1], 1.0)
        self.assertLess(rough - smooth[-1], 2.4)
        self.assertLess(ripples[0], 2e-3)
        self.assertGreater(ripples[1], 2 * ripples[0])
        self.compare("resistance with chords against arcs", abs(chords[1][-1] / smooth[-1] - 1), 0.02)
        self.assertLess(iterations, 7)


if __name__ == "__main__":
    unittest.main()
