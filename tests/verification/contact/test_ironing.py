"""A cylinder dragged over a coarse mesh without friction: the drag that remains is the contour's and the mesh's doing."""
import unittest

import numpy as np

from compared_case import problem
from contact_case import ContactCase

ELEMENT = 0.25


@problem("consistency", title="Ironing, smooth contours")
class Ironing(ContactCase):
    def drag(self, approximation):
        settings = [f"bodies/die/contour/approximation={approximation}"]
        if approximation != "exact":
            settings.append(f"bodies/die/contour/chord length={ELEMENT}")
        history = self.run_deck(self.deck("ironing"), settings)
        steady = history.time > 1.2  # the first elements turn from pressing to dragging
        self.assertGreater(np.ptp(history["body/die/displacement x"][history.time > 1]), 19 * ELEMENT)
        self.assertLessEqual(history["step/newton iterations"].max(), 8)
        normal = history["contact/face/reaction y"][steady]
        return np.ptp(history["contact/face/reaction x"][steady]) / normal.mean(), normal

    def test_smooth_contours_ripple_ten_times_less(self):
        (exact, normal), (bezier, smoothed), (facets, _) = (self.drag(kind) for kind in ("exact", "bezier", "facets"))
        self.assertLess(exact, 0.006)
        self.assertGreater(facets, 10 * exact)
        self.assertGreater(facets, 10 * bezier)
        # the smoothed curve is the cylinder's to 1e-3
        self.compare_values("normal force", smoothed, normal, 1e-3)


if __name__ == "__main__":
    unittest.main()
