"""Every deck of inputs/materials runs to its end: a law that cannot get through its own example is no use to anybody."""
import glob
import os
import unittest

import numpy as np

from mudline_case import ROOT, MudlineCase

DECKS = sorted(glob.glob(os.path.join(ROOT, "inputs", "materials", "*.xml")))


class MaterialDecks(MudlineCase):
    def test_every_deck_reaches_its_end(self):
        self.assertGreaterEqual(len(DECKS), 7)
        for deck in DECKS:
            with self.subTest(deck=os.path.basename(deck)):
                history = self.run_deck(deck)
                self.assertGreater(len(history.time), 2)

    def test_tresca_follows_rate_and_softening(self):
        """Half the stress difference is s_u R(rate) S(plastic shear strain), with gamma = 2 ln(H0/H) in plane strain."""
        history = self.run_deck(os.path.join(ROOT, "inputs", "materials", "tresca.xml"))
        height = 1 - 0.01 * history.time
        yielded = history.time > 1.5
        measured = 0.5 * (-history["reaction/platen y"] * height - 50e3)[yielded]
        rate = 1 + 0.1 * np.log10(0.02 / height / 1e-5)
        plastic = -2 * np.log(height) - 10e3 * rate / 1e6  # G = 100 s_u
        strength = (10e3 * rate * (1 / 3 + 2 / 3 * np.exp(-3 * plastic / 10)))[yielded]
        np.testing.assert_allclose(measured, strength, rtol=2e-3)  # 0.1 %: Poisson's ratio of 0.49
        self.assertLess(measured[-1] / measured[0], 0.95)


if __name__ == "__main__":
    unittest.main()
