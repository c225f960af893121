"""Water through a body: a column under a leaky plate against the series solution, and the surface when the plate is lifted."""
import unittest

from compared_case import problem
from contact_case import ContactCase
from mudline_case import program
from references import biot


@problem("exact", "Carslaw and Jaeger (1959), section 3.11", "Leaky plate")
class Drainage(ContactCase):
    def test_leaky_plate(self):
        history = self.run_deck(self.deck("leaky_plate"))
        for factor in (0.05, 0.1, 0.2, 0.5):  # of time
            now = factor / 0.0012
            for name, height in (("base", 0.0), ("top", 1.0)):
                exact = biot.leaky_column(height, factor, 1.0)
                self.compare_values(f"{name} at T = {factor}",
                                    history.at(f"probe/{name}/pore pressure", now + 1e-3) / 10, exact, 1e-3, 1.0)
        # lifted, the surface drains again; no water is lost or made by the switching
        self.assertEqual(history["probe/top/pore pressure"][-1], 0.0)
        self.compare_values("water balance", history["balance/water/error"], 0.0, 1e-8, 1.0)

    def test_limits(self):
        """Hardly any conductance seals, a large one drains; water at rest outside is what the pore pressure tends to."""
        short = ("stages/load/duration=41.666666666666667", "stages/lift/duration=0.1")
        sealed = self.run_deck(self.deck("leaky_plate"), short + ("contacts/face/conductance=1e-18",))
        self.compare_values("sealed", sealed.at("probe/top/pore pressure", 41.6), 10.0, 1e-6)
        drained = self.run_deck(self.deck("leaky_plate"), short + ("contacts/face/conductance=1e-4",))
        self.compare_values("drained", drained.at("probe/top/pore pressure", 41.6), 0.0, 1e-4, 10.0)
        water = self.run_deck(self.deck("leaky_plate"), short + ("contacts/face/conductance=1e-4", "contacts/face/outside pressure=4"))
        self.compare_values("outside", water.at("probe/top/pore pressure", 41.6), 4.0, 1e-4, 10.0)

    @problem("behaviour")
    def test_errors(self):
        for settings, message in ((("contacts/face/conductance=0",), "contacts/face/conductance: a leaky contact needs a conductance greater than 0"),
                                  (("contacts/face/drainage=sealed",), "contacts/face/conductance: has a meaning only with 'drainage' = leaky")):
            done = program(["check", self.deck("leaky_plate")] + [x for s in settings for x in ("--set", s)], 1, self.folder)
            self.assertEqual(done.returncode, 2)
            self.assertIn(message, done.stderr)


if __name__ == "__main__":
    unittest.main()
