"""Water between the soil's surface and a body: a plate pulled off an elastic layer, with and without cavitation; a film that is
squeezed out between two plates."""
import math
import unittest

import numpy as np

from compared_case import problem
from contact_case import ContactCase
from mudline_case import deck_text, program
from references.suction import PulledPlate

HEIGHT, WIDTH, UNIT_WEIGHT = 1.0, 0.1, 1e4
PLATE = {"type": "polyline", "extent": "full", "x": [-3.0, 3.0], "y": [0.0, 0.0]}


def soil(young, conductivity):
    return {"soil": {"porosity": 0.4, "skeleton": {"type": "linear elastic", "Young's modulus": young, "Poisson's ratio": 0.25},
                     "fluid": {"type": "water", "incompressible": True, "unit weight": UNIT_WEIGHT},
                     "permeability": {"type": "constant", "hydraulic conductivity": conductivity}}}


def held(**components):
    return {f"held {name}": {"type": "fixed", "set": name, "components": which} for name, which in components.items()}


@problem("exact", "series solution in references/suction.py", "Plate pulled off a saturated layer")
class PulledOff(ContactCase):
    def pull(self, young, conductivity, velocity, stress, duration, **contact):
        """A column with a drained base under a wide plate; pressed until `stress` is reached at rest, then pulled."""
        modulus = 1.2 * young
        time = HEIGHT**2 * UNIT_WEIGHT / (modulus * conductivity)
        stages = {}
        if stress > 0:
            stages["press"] = {"type": "quasi-static", "duration": 20 * time,
                               "motions": {"plate": {"type": "prescribed displacement", "y": f"{-stress * HEIGHT / modulus}*min(t/{time},1)"}},
                               "time step": {"initial": 0.01 * time, "growth": 1.5}}
        stages["pull"] = {"type": "quasi-static", "duration": duration * time,
                          "motions": {"plate": {"type": "prescribed velocity", "velocity y": velocity}},
                          "integrator": {"type": "theta", "theta": 0.5, "start-up steps": 8},
                          "time step": {"initial": 1e-5 * time, "growth": 1.2, "maximum": 0.04 * time}}
        history = self.run_deck(self.write("pull.xml", deck_text("pull", {
            "mesh": {"type": "box", "cell": "quad9", "cells": [1, 40], "upper": [WIDTH, HEIGHT],
                     "grading": [1.0, 8.0]},
            "materials": soil(young, conductivity),
            "physics": {"ground": {"type": "biot"}},
            "bodies": {"plate": {"position": [0.0, HEIGHT], "contour": PLATE, "motion": {"type": "held"}}},
            "boundary conditions": {
                **held(bottom="x y", left="x", right="x"),
                "drained base": {"type": "pore pressure", "set": "bottom"},
                "drained top": {"type": "pore pressure", "set": "top"}},
            "contacts": {"face": {"type": "penalty", "body": "plate", "surface": "top", "drainage": "film",
                                  "penalty factor": 1e4, "residual aperture": 1e-11, **contact}},
            "stages": stages})))
        pulled = history.time > (20 * time if stress > 0 else 0) * (1 + 1e-9)
        exact = PulledPlate(HEIGHT, modulus, conductivity / UNIT_WEIGHT, velocity, stress, contact.get("cavitation pressure", -np.inf))
        return history, pulled, history.time[pulled] - (20 * time if stress > 0 else 0), exact

    def test_at_three_rates(self):
        """The plate touches, then parts from the layer, and the water's suction rises to that of steady flow."""
        for final, duration in ((5.0, 3.5), (20.0, 1.5), (80.0, 1.0)):
            history, pulled, times, exact = self.pull(1e7, 1e-6, final * 1e-10 / HEIGHT, 10.0, duration)
            name = f"{final} Pa in the end"
            total = [exact.total(t) for t in times]
            self.assertLess(exact.parts, 0.8 * duration)
            self.compare_values(f"{name}: pressure of the plate", history["contact/face/reaction y"][pulled] / WIDTH,
                                total, 5e-3, scale=np.max(np.abs(total)))
            gap = np.array([exact.gap(t) for t in times])
            self.compare_values(f"{name}: water in the gap", history["contact/face/film water"][pulled] / WIDTH, gap,
                                5e-3, scale=gap.max())
            self.assertEqual(np.abs(history["contact/face/film vapour"]).max(), 0)

    def test_no_contact_stress(self):
        """Without contact stress the suction starts with the motion; its film is all that acts on the plate."""
        history, _, times, exact = self.pull(1e7, 1e-6, 2e-9, 0.0, 1.0)
        total = [exact.total(t) for t in times]
        self.compare_values("pressure of the plate", history["contact/face/reaction y"] / WIDTH, total, 5e-3,
                            scale=20)
        self.compare_values("of the film", history["contact/face/film force y"] / WIDTH, total, 5e-3, scale=20)

    def test_cavitation(self):
        """The suction stays at that of cavitation; what the soil does not give is vapour."""
        history, _, times, exact = self.pull(1e9, 1e-6, 4e-5, 0.0, 1.0, **{"cavitation pressure": -100e3})
        self.assertLess(exact.vapour_from, 0.3)
        # 500 Pa are what turns water into vapour
        self.compare_values("pressure of the plate", history["contact/face/reaction y"] / WIDTH,
                            [exact.total(t) for t in times], 8e-3, scale=100e3)
        vapour = np.array([exact.vapour(t) for t in times])
        self.assertGreater(vapour.max(), 0.3 * exact.gap(times[-1]))
        self.compare_values("vapour", history["contact/face/film vapour"] / WIDTH, vapour, 1e-2, scale=vapour.max())


    @problem("behaviour")
    def test_needs_pore_water(self):
        text = deck_text("dry", {
            "mesh": {"type": "box", "cell": "quad9", "cells": [1, 1], "upper": [1.0, 1.0]},
            "materials": {"soil": {"porosity": 0.4, "skeleton": soil(1e7, 1e-6)["soil"]["skeleton"]}},
            "physics": {"ground": {"type": "solid"}},
            "bodies": {"plate": {"position": [0.0, HEIGHT], "contour": PLATE, "motion": {"type": "held"}}},
            "boundary conditions": held(bottom="x y"),
            "contacts": {"face": {"type": "penalty", "body": "plate", "surface": "top", "drainage": "film"}},
            "stages": {"rest": {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 1.0}}}})
        done = program(["check", self.write("dry.xml", text)], 1, self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("contacts/face/drainage: has a meaning only in a model with the field 'pore pressure'",
                      done.stderr)


@problem("exact", "Reynolds' equation", "Film squeezed out between plates")
class Squeezed(ContactCase):
    """A film of 1 mm between a plate and stiff tight soil, open at the soil's edge, closed at a given speed."""
    SPEED, VISCOSITY, FILM = 1e-4, 1e-3, 1e-3

    def squeeze(self, geometry, cell, cells, upper, body, conditions):
        up = len(upper) - 1
        plate = {"position": [0.0] * up + [upper[up] + self.FILM], **body,
                 "motion": {"type": "prescribed velocity", "velocity " + "xyz"[up]: -self.SPEED}}
        history = self.run_deck(self.write("squeeze.xml", deck_text("squeeze", {
            "mesh": {"type": "box", "geometry": geometry, "cell": cell, "cells": cells, "upper": upper},
            "materials": soil(1e12, 1e-18),
            "physics": {"ground": {"type": "biot"}},
            "bodies": {"plate": plate},
            "boundary conditions": conditions,
            "contacts": {"face": {"type": "penalty", "body": "plate", "surface": "top", "drainage": "film",
                                  "film viscosity": self.VISCOSITY}},
            "solver": {"linear solver": {"type": "direct"}},
            "stages": {"squeeze": {"type": "quasi-static", "duration": 2.0,
                                   "time step": {"initial": 0.2, "maximum": 0.2}}}})))
        # with the film as thick as it is at the end
        return history, 12 * self.VISCOSITY * self.SPEED / (self.FILM - self.SPEED * history.time)**3

    def test_strip_and_disc(self):
        for geometry, exact in (("plane strain", 1 / 3), ("axisymmetric", math.pi / 8)):  # of the curvature, radius 1
            history, curvature = self.squeeze(
                geometry, "quad9", [20, 1], [1.0, 0.1], {"contour": {**PLATE, "extent": "half", "x": [0.0, 3.0]}},
                {**held(bottom="x y", left="x", right="x"), "edge": {"type": "pore pressure", "set": "right"}})
            self.compare_values(geometry, history["contact/face/reaction y"], exact * curvature, 2e-3)

    def test_square(self):
        """A quarter of a square; the pressure is that of a membrane under a uniform load."""
        odd = np.arange(1, 400, 2)
        # over the square of side 2: 4 (1/3 - 64/pi^5 sum tanh(n pi/2)/n^5), a quarter of that here
        exact = 1 / 3 - 64 / math.pi**5 * np.sum(np.tanh(odd * math.pi / 2) / odd**5.0)
        history, curvature = self.squeeze(
            "three-dimensional", "hex27", [12, 12, 1], [1.0, 1.0, 0.1],
            {"surface": {"type": "box", "length x": 6.0, "length y": 6.0, "length z": 2.0, "position": [0.0, 0.0, 1.0]}},
            {**held(bottom="x y z", left="x", right="x", front="y", back="y"),
             "edge x": {"type": "pore pressure", "set": "right"}, "edge y": {"type": "pore pressure", "set": "back"}})
        self.compare_values("square", history["contact/face/reaction z"], exact * curvature, 5e-3)


if __name__ == "__main__":
    unittest.main()
