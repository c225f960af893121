"""The loop over active sets outside Newton's method: the same answers as without, the guard against chatter, ranks, errors."""
import os
import unittest

from contact_case import ContactCase
from mudline_case import program
from sliding_blocks import SLIDE

LOOP = "contacts/face/active set=outer loop"


class ActiveSet(ContactCase):
    def penalty_blocks(self):
        """The sliding blocks with nodes against segments by penalty."""
        def without_tolerance(text):
            return "".join(line + "\n" for line in text.splitlines() if "gap tolerance" not in line)

        with open(self.deck("blocks")) as file:
            text = without_tolerance(file.read()).replace("blocks.geo", os.path.join(os.path.dirname(self.deck("blocks")), "blocks.geo"))
        return [self.write("loose.xml", text), self.deck("node_to_segment"), self.write("slide.xml", without_tolerance(SLIDE))]

    def compare(self, what, decks, settings, columns, tolerance, ranks=(1,), name=None):
        inside = self.run_deck(decks, settings, name=name)
        for n in ranks:
            outside = self.run_deck(decks, settings + (LOOP,), ranks=n, name=name)
            for column in columns:
                self.assert_within(f"{what}, {n} ranks: {column}", outside["contact/face/" + column][-1], inside["contact/face/" + column][-1], tolerance)

    def test_hertz(self):
        for settings in ((), ("contacts/face/enforcement=augmented Lagrangian",)):
            self.compare("Hertz", self.deck("hertz_line"), ("stages/press/duration=0.2",) + settings,
                         ("reaction y", "contact area", "active points", "maximum penetration"), 1e-6)

    def test_sliding(self):
        self.compare("plate", self.deck("sliding_plate"), (), ("reaction x", "friction heat", "sliding points"), 1e-8, (1, 2))
        for settings in (("contacts/face/enforcement=penalty", "contacts/face/penalty factor=1"), ()):
            decks = self.penalty_blocks() if settings else [self.deck("blocks"), self.deck("node_to_segment"), self.write("slide.xml", SLIDE)]
            steps = ("solver/newton/damped retry=false",)  # which one strategy may need and the other not: heat depends on the steps
            self.compare("blocks", decks, settings + steps, ("force on slave x", "contact area", "friction heat"), 1e-5, (1, 2),
                         "loose" if settings else "blocks")

    def test_guard(self):
        """Points that may change once only: the guard holds some, the step is refused where they are off, and shorter ones leave no trace of it."""
        common = ("stages/press/duration=0.1", LOOP, "contacts/face/most active set changes=1")
        done = program(["run", "-v", self.deck("hertz_line")] + [x for s in common for x in ("--set", s)], 1, self.folder)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])
        log = done.stdout + done.stderr
        self.assertIn("1 held by the chatter guard", log)
        self.assertIn("the active set of contact 'face' chatters: 1 points that changed more than 1 times violate their condition", log)
        cut = self.run_deck(self.deck("hertz_line"), common)
        inside = self.run_deck(self.deck("hertz_line"), common[:1])
        self.assertGreater(len(cut.time), len(inside.time))
        for column in ("reaction y", "contact area", "maximum penetration"):
            self.assert_within("after cut steps: " + column, cut["contact/face/" + column][-1], inside["contact/face/" + column][-1], 1e-6)
        # a tolerance as large as the violation lets the point off
        loose = self.run_deck(self.deck("hertz_line"), common + ("contacts/face/gap tolerance=5e-6",))
        self.assertEqual(len(loose.time), len(inside.time))

    def test_too_few_updates(self):
        """The set of the first step of 0.1 s takes eight updates: with five it is cut, and the answer is the same."""
        common = ("stages/press/duration=0.1", LOOP)
        settings = common + ("contacts/face/most active set updates=5",)
        done = program(["run", self.deck("hertz_line")] + [x for s in settings for x in ("--set", s)], 1, self.folder)
        self.assertEqual(done.returncode, 0, done.stderr[-2000:])
        self.assertIn("the active set of contact 'face' does not settle in 5 updates", done.stdout)
        cut, whole = self.run_deck(self.deck("hertz_line"), settings), self.run_deck(self.deck("hertz_line"), common)
        self.assertGreater(len(cut.time), len(whole.time))
        for column in ("reaction y", "contact area", "maximum penetration"):
            self.assert_within("after cut steps: " + column, cut["contact/face/" + column][-1], whole["contact/face/" + column][-1], 1e-6)

    def test_errors(self):
        def message(deck, *settings):
            done = program(["check", self.deck(deck)] + [x for s in settings for x in ("--set", s)], 1, self.folder)
            self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
            return done.stderr

        self.assertIn("contacts/face/most active set changes: has a meaning only with 'active set' = outer loop",
                      message("hertz_line", "contacts/face/most active set changes=2"))
        self.assertIn("contacts/face/impact: conserving is for 'active set' = in newton", message("hertz_line", LOOP, "contacts/face/impact=conserving"))
        self.assertIn("contacts/face/active set", message("blocks", LOOP))  # the mortar method has none


if __name__ == "__main__":
    unittest.main()
