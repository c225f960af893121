"""The strain path reference against what is known of it in closed form."""
import unittest

import numpy as np

from compared_case import ComparedCase, problem
from references.strain_path import SimplePile

CLAY = dict(M=1.0, slope=0.2, swelling=0.04, nu=0.3, v0=2.3)


@problem("exact", "closed forms of the strain path method, Baligh (1985)", "The strain path reference")
class StrainPath(ComparedCase):
    @classmethod
    def setUpClass(cls):
        cls.pile = SimplePile(**CLAY, start=(60.0, 60.0, 100.0), ocr=2.0)

    def test_volume_is_kept(self):
        """The annulus inside a particle keeps its area: r^2 = r0^2 + 1 far behind the tip."""
        begin = np.geomspace(0.02, 60.0, 160)
        self.compare_values("area of the annulus", self.pile.radii ** 2, begin ** 2 + 1, 2e-3)

    def test_far_away_it_is_elastic(self):
        """Hoop strain -1/(2 r^2), radial +1/(2 r^2): stress difference 2 G / r^2."""
        bulk = 2.3 * 220 / 3 / 0.04
        shear = 1.5 * 0.4 / 1.3 * bulk
        far = self.pile.radii > 15
        difference = self.pile.stress[far, 0] - self.pile.stress[far, 1]
        self.compare_values("stress difference far away", difference * self.pile.radii[far] ** 2 / (2 * shear), 1,
                            2e-2)

    def test_at_the_wall_the_state_is_critical(self):
        p, q2, _ = SimplePile.invariants(self.pile.stress[:1])
        size0 = 2.0 * (220 / 3 + 40.0 ** 2 / (220 / 3))
        # undrained: swelling ln(p/p0) + (slope - swelling) ln(pc/pc0) = 0, and pc = 2 p
        expected = np.exp((0.04 * np.log(220 / 3) + 0.16 * np.log(size0 / 2)) / 0.2)
        self.compare("mean stress at the wall", abs(p[0] / expected - 1), 5e-3)
        self.compare("stress ratio at the wall", abs(np.sqrt(q2[0]) / p[0] - 1.0), 5e-3)

    def test_step_and_particles(self):
        finer = SimplePile(**CLAY, start=(60.0, 60.0, 100.0), ocr=2.0, particles=320, largest_strain=1e-3)
        self.compare_values("wall, finer steps", finer.wall(), self.pile.wall(), 5e-3)


if __name__ == "__main__":
    unittest.main()
