"""A geostatic stage with a balance tolerance always solves: the displacement shows an imbalance that is small beside the weight of a large box."""
import os
import unittest

from mudline_case import ROOT, MudlineCase, program


class GeostaticBalance(MudlineCase):
    """The tip's traction in the large box of clay.xml: its forces are small beside the weight of the box."""

    def geostatic(self, factor):
        tip = "boundary conditions/tip at rest/"
        settings = ("mesh/parameters/fine=0.2", f"{tip}y=-{factor}*7250.9*y*y/4.54755",
                    f"{tip}x={factor}*(0.6*(10e3-7250.9*y)-10e3)*(x+4.01255)/4.54755")
        arguments = ["run", os.path.join(ROOT, "inputs", "torpedo", "clay.xml"), "--steps", "1"]
        return program(arguments + [word for setting in settings for word in ("--set", setting)], folder=self.folder)

    def test_right_traction(self):
        done = self.geostatic(1.0)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])
        self.assertNotIn("balanced in 0 iterations", done.stdout)

    def test_wrong_traction(self):
        done = self.geostatic(1.1)
        self.assertEqual(done.returncode, 3, done.stdout[-2000:] + done.stderr[-2000:])
        self.assertIn("stages/geostatic/balance tolerance", done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
