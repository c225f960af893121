"""Every deck of inputs/materials runs to its end: a law that cannot get through its own example is no use to anybody."""
import glob
import os
import unittest

from mudline_case import ROOT, MudlineCase

DECKS = sorted(glob.glob(os.path.join(ROOT, "inputs", "materials", "*.xml")))


class MaterialDecks(MudlineCase):
    def test_every_deck_reaches_its_end(self):
        self.assertGreaterEqual(len(DECKS), 7)
        for deck in DECKS:
            with self.subTest(deck=os.path.basename(deck)):
                history = self.run_deck(deck)
                self.assertGreater(len(history.time), 2)


if __name__ == "__main__":
    unittest.main()
