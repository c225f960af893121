"""What the strength tests share."""
import os

from mudline_case import ROOT, MudlineCase


class StrengthCase(MudlineCase):
    def deck(self, topic, name):
        return os.path.join(ROOT, "inputs", topic, name + ".xml")
