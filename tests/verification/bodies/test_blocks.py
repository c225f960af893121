"""Bodies with several degrees of freedom on rough ground: sliding, stick-slip, rolling; a load without inertia."""
import os
import unittest

import numpy as np
from compared_case import problem
from mudline_case import ROOT, MudlineCase
from references import contact
from references import sliding_block as reference


def deck(name):
    return os.path.join(ROOT, "inputs", "contact", name + ".xml")


@problem("exact", "Coulomb's friction in closed form", "Rigid blocks on rough ground")
class Blocks(MudlineCase):
    def test_sliding_block_stops(self):
        history = self.run_deck(deck("sliding_block"), ("stages/slide/time step/initial=0.001",))
        slides = history.time > 1
        t, x, v = (values[slides] for values in (history.time - 1, history["body/block/position x"], history["body/block/velocity x"]))
        moving = (t > 0.002) & (t < 0.66)
        self.compare("deceleration", np.abs(history["body/block/acceleration x"][slides][moving] + 3).max(), 1e-6)
        # the spring that friction is before it slides takes a step to stretch
        self.compare("way", abs(x[-1] - 2 / 3), 2e-3)
        self.compare("time of rest", abs(t[np.argmax(v < 1e-2)] - 2 / 3), 5e-3)
        self.compare("speed at rest", np.abs(v[t > 0.7]).max(), 2e-3)
        # what it had has become heat
        self.compare("heat of friction", abs(history["contact/face/friction heat"][-1] / 2000 - 1), 2e-3)

    def test_spring_block_sticks_and_slips(self):
        k = 4 * np.pi**2 * 1000  # a period of 1 s; strength / k = 0.06
        spring = "stages/slide/motions/block/"
        history = self.run_deck(deck("sliding_block"),
                                ("stages/slide/time step/initial=0.001", "stages/slide/duration=1.1", spring + "initial velocity={0,0}",
                                 f"{spring}force x=-{k}*(x+1)", f"contacts/face/friction/coefficient={0.06 * k / 1e4}"))
        slides = history.time > 1
        exact = [reference.spring_block(t - 1, 2 * np.pi, 0.06, 1.0) - 1 for t in history.time[slides]]
        self.compare("way while it slides", np.abs(history["body/block/position x"][slides] - exact).max(), 5e-3)
        self.compare("place of the second stick", abs(history["body/block/position x"][-1] + 1 - 0.626312), 5e-3)

    def test_roller_rolls(self):
        history = self.run_deck(deck("roller"))
        rolls = history.time > 1
        t = history.time[rolls] - 1
        a = reference.rolling_acceleration(3.0, 100.0, 12.5, 0.5)
        self.assertAlmostEqual(a, 2.0)
        self.compare("spin", abs(-0.5 * history["body/roller/spin"][-1] / (a * t[-1]) - 1), 0.01)
        angle = -history["body/roller/rotation"][rolls]
        self.compare("angle", abs(0.5 * angle[-1] / (0.5 * a * t[-1]**2) - 1), 0.01)
        # the reference point, lowest at the start, goes round with the cylinder
        self.compare("cycloid, x",
                     np.abs(history["body/roller/position x"][rolls] - 0.5 * (angle - np.sin(angle))).max(), 5e-3)
        self.compare("cycloid, y", np.abs(history["body/roller/position y"][rolls] - 0.5 * (1 - np.cos(angle))).max(),
                     8e-3)

    @problem("consistency")
    def test_ranks(self):
        one = self.run_deck(deck("roller"), ("stages/roll/duration=0.1",))
        many = self.run_deck(deck("roller"), ("stages/roll/duration=0.1", "output/name=many"), ranks=4, name="many")
        self.assert_same_run(one, many, ("body/roller/rotation", "body/roller/position y", "contact/face/reaction x",
                                         "balance/energy/body inertia"), "4 ranks")

    @problem("consistency")
    def test_load_without_inertia(self):
        """A punch that is loaded instead of moved, in a quasi-static stage and from just above the surface: same settlement."""
        overlay = self.write("load.xml", """<ParameterList name="load"><ParameterList name="bodies"><ParameterList name="punch">
          <Parameter name="position" type="Array(double)" value="{0.0, 1e-7}"/>
          <ParameterList name="motion"><Parameter name="type" type="string" value="force"/>
            <Parameter name="force y" type="string" value="-1000*t"/></ParameterList></ParameterList></ParameterList></ParameterList>""")
        with open(deck("flat_punch")) as file:  # a motion of another type takes the place of the deck's
            text = file.read()
        start = text.index('<ParameterList name="motion">')
        plain = self.write("punch.xml", text[:start] + text[text.index("</ParameterList>", start) + len("</ParameterList>"):])
        history = self.run_deck([plain, overlay], name="punch")
        self.compare("reaction", abs(history["contact/face/reaction y"][-1] / 1000 - 1), 1e-6)
        load, _ = contact.circular_punch(2.275e-5, 0.1, contact.plane_modulus(2e8, 0.3))
        settlement = -history["body/punch/displacement y"][-1] - 1e-7  # less the distance to the surface
        self.compare("settlement", abs(settlement / (2.275e-5 * 1000 / load) - 1), 0.03)


if __name__ == "__main__":
    unittest.main()
