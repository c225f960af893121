"""What the strength tests share."""
import os

from mudline_case import ROOT, MudlineCase

# Hochstetten sand, without intergranular strain: docs/materials.md says where its numbers come from
SAND = {"type": "hypoplasticity", "critical friction angle [deg]": 33.0, "granular hardness": 1e9,
        "compression exponent": 0.25, "densest void ratio": 0.55, "critical void ratio": 0.95,
        "loosest void ratio": 1.05, "peak exponent": 0.25, "stiffness exponent": 1.5}


class StrengthCase(MudlineCase):
    def deck(self, topic, name):
        return os.path.join(ROOT, "inputs", topic, name + ".xml")
