"""A smooth contour avoids severe oscillations of the dynamic response (Sabetamal, Nazem, Carter and Sloan 2014): a cylinder
dragged over soil with inertia, faceted and smooth, contact checked at nodes and at quadrature points."""
import unittest

from compared_case import problem
from contact_case import ContactCase
from dynamic_ironing import METHODS, Response, settings


@problem("behaviour", title="Dynamic ironing, smooth contours")
class DynamicIroning(ContactCase):
    def test_smooth_contour_calms_the_response(self):
        smooth = {}
        for method in METHODS:
            found = {}
            for contour in ("facets", "bezier"):
                history = self.run_deck([self.deck("ironing"), self.deck("dynamic_ironing")], settings(method, contour), name="ironing")
                self.assertGreater(history["body/die/displacement x"][-1], 2.9)
                found[contour] = Response(history)
            with self.subTest(method):
                for what in ("drag", "acceleration"):
                    faceted, calm = (r.ripple(getattr(r, what)) for r in (found["facets"], found["bezier"]))
                    self.assertGreater(faceted, 5 * calm, what)
            smooth[method] = found["bezier"].ripple(found["bezier"].drag)
        # what smoothing leaves is the mesh's: points spread over the sides see less of it than nodes
        self.assertLess(smooth["surface quadrature"], 0.005)
        self.assertLess(smooth["nodes"], 0.02)
        self.assertLess(2 * smooth["surface quadrature"], smooth["nodes"])


if __name__ == "__main__":
    unittest.main()
