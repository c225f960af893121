"""What the strength tests share."""
import os

from mudline_case import ROOT, MudlineCase


class StrengthCase(MudlineCase):
    def deck(self, topic, name):
        return os.path.join(ROOT, "inputs", topic, name + ".xml")

    def assert_between(self, what, value, low, high):
        if os.environ.get("MUDLINE_SHOW_ERRORS"):
            print(f"{self.id().split('.')[-1]}: {what}: {value:.5g} (allowed {low:.5g} to {high:.5g})", flush=True)
        self.assertGreaterEqual(value, low, what)
        self.assertLessEqual(value, high, what)
