"""Heat in saturated soil: a point source, a heated surface, a front in a flow, heat of friction, and the balance of
heat while the mesh moves."""
import os
import unittest

import numpy as np

from compared_case import problem
from mudline_case import ROOT, MudlineCase, deck_text
from references import heat

TIMES = np.array([1e5, 1e6, 1e7])
CLAY = heat.Clay()
WARM = """<ParameterList name="warm">
  <ParameterList name="materials"><ParameterList name="{material}"><ParameterList name="heat">
    <Parameter name="conductivity" type="double" value="1.2"/>
    <Parameter name="grain heat capacity" type="double" value="800"/>
  </ParameterList></ParameterList></ParameterList>
  <ParameterList name="physics"><ParameterList name="ground">
    <Parameter name="type" type="string" value="thermo-hydro-mechanical"/>{more}
  </ParameterList></ParameterList>
</ParameterList>
"""


@problem("exact", "balance of heat", "Heat")
class Heat(MudlineCase):
    def deck(self, name):
        return os.path.join(ROOT, "inputs", "heat", name + ".xml")

    @problem("exact", "Booker and Savvidou (1985)")
    def test_point_source(self):
        """Booker and Savvidou: at every radius each quantity against the largest it has there."""
        history = self.run_deck(self.deck("point_source"))
        for probe, r in (("near", 0.25), ("middle", 0.5), ("far", 1.0)):
            exact = np.array([heat.point_source(CLAY, 1.0, r, t) for t in TIMES]).T
            values = (history.at(f"probe/{probe}/temperature", TIMES) - 10, history.at(f"probe/{probe}/pore pressure", TIMES),
                      history.at(f"probe/{probe}/displacement x", TIMES))
            for what, value, expected in zip(("temperature", "pressure", "displacement"), values, exact):
                self.compare_values(f"{what} at {r} m", value, expected, 0.02, np.abs(expected).max())
        # half of 1 W over 1e7 s, all of it still in the ground
        self.compare_values("heat in the ground", history["balance/heat/change"][-1], 0.5e7, 1e-4)

    @problem("exact", "McTigue (1986)")
    def test_heated_surface(self):
        """McTigue: temperature, pressure and heave."""
        history = self.run_deck(self.deck("heated_surface"), ("mesh/cells={1, 192}", "mesh/grading={1.0, 1.0}"))
        for probe, depth in (("shallow", 0.25), ("deep", 1.0)):
            temperature, pressure, _ = np.array([heat.heated_surface(CLAY, 0.5, depth, t) for t in TIMES]).T
            self.compare_values(f"temperature at {depth} m", history.at(f"probe/{probe}/temperature", TIMES) - 10,
                                temperature, 5e-3, temperature.max())
            self.compare_values(f"pressure at {depth} m", history.at(f"probe/{probe}/pore pressure", TIMES), pressure,
                                5e-3, pressure.max())
        for t in TIMES:
            heave = heat.heated_surface(CLAY, 0.5, 0.0, t)[2]
            self.compare_values(f"heave at {t:.0e} s", history.at("probe/surface/displacement y", t), heave, 5e-3,
                                heave)

    @problem("behaviour")
    def test_two_ranks(self):
        one, two = (self.run_deck(self.deck("heated_surface"), ("stages/heating/duration=1e5",), ranks=n, name="heated_surface")
                    for n in (1, 2))
        for name in ("probe/deep/temperature", "probe/shallow/pore pressure", "balance/heat/outflow"):
            np.testing.assert_allclose(two[name], one[name], rtol=1e-6, atol=1e-9 * np.abs(one[name]).max())

    @problem("exact", "Ogata and Banks (1961)")
    def test_front(self):
        """Convection and conduction: second order in the size of the elements, and where it leaves the front is not held back."""
        probes = (("one metre", 1.0), ("three metres", 3.0), ("five metres", 5.0))
        times = np.array([5e5, 1e6, 2e6])
        errors = []
        for cells in (50, 100, 200):
            history = self.run_deck(self.deck("convection_front"), (f"mesh/cells={{1, {cells}}}", "solver/residual tolerance=1e-9"))
            exact = np.array([heat.front(20.0, 4186e3 * 1e-6 / 2.8e6, 1.5 / 2.8e6, x, times) for _, x in probes])
            values = np.array([history.at(f"probe/{name}/temperature", times) - 10 for name, _ in probes])
            errors.append(np.linalg.norm(values - exact) / np.linalg.norm(exact))
            self.assertLess(np.abs(history["balance/heat/error"]).max(), 1e-10)
        self.compare("temperature, 200 cells", errors[-1], 2e-4)
        self.compare_orders("order of the temperature", errors, 1.8, all_orders=True)

    def test_uniform_warmth_stays(self):
        """Water that flows through soil of one temperature, other than that of reference, changes nothing."""
        history = self.run_deck(self.deck("convection_front"), (
            "physics/ground/initial temperature=30", "stages/heating/duration=1e5", "physics/ground/water heat capacity=4000", "physics/ground/water expansion=0.0004",
            "materials/sand/heat/grain expansion=3e-5", "materials/sand/skeleton/Young's modulus=1e6"))
        for probe in ("one metre", "three metres", "five metres"):
            self.compare("temperature", np.abs(history[f"probe/{probe}/temperature"] - 30).max(), 1e-8)

    @problem("exact", "steady conduction through two layers")
    def test_layers(self):
        """Two layers of one region, each with its conductivity and heat capacity: the steady temperature between them, and the heat
        that is in them then. The temperature is linear in each layer, so that both are exact but for rounding."""
        text = open(self.deck("heated_surface")).read()
        start, end = text.index('<ParameterList name="clay">'), text.index('  </ParameterList>\n  <ParameterList name="physics">')
        deep = text[start:end].replace('"clay"', '"deep"', 1).replace('name="porosity"', 'name="top" type="double" value="6.0"/>\n<Parameter name="porosity"', 1)
        deep = deep.replace('"1.5"', '"3.0"').replace('"707.92452830188677"', f'"{2 * 707.92452830188677!r}"')
        warm = text.index('    <ParameterList name="warm surface">')
        base = ('<ParameterList name="cold base"><Parameter name="type" type="string" value="value"/><Parameter name="set" type="string" value="bottom"/>'
                '<Parameter name="field" type="string" value="temperature"/><Parameter name="value" type="double" value="10.0"/></ParameterList>\n')
        text = text[:end] + deep + text[end:warm] + base + text[warm:]
        text = text.replace('name="grain expansion" type="double" value="3e-5"', 'name="grain expansion" type="double" value="0.0"').replace('"4e-4"', '"0.0"')
        history = self.run_deck(self.write("layers.xml", text), (
            "mesh/cells={1, 8}", "mesh/grading={1.0, 1.0}", "solver/residual tolerance=1e-10", "stages/heating/duration=1e13", "stages/heating/time step/initial=1e8",
            "stages/heating/time step/maximum=1e13", "stages/heating/time step/growth=2", "stages/heating/integrator/start-up steps=100", "output/probes/between={0.05, 6.0}"))
        between = 0.5 / (6 / 1.5 + 6 / 3.0) * 6 / 3.0
        self.compare_values("temperature between", history["probe/between/temperature"][-1] - 10, between, 1e-7,
                            between)
        water, grains = 0.4 * 1000 * 4186, 0.6 * 2650 * 707.92452830188677
        held = 0.6 * ((water + grains) * (between + 0.5) / 2 + (water + 2 * grains) * between / 2)
        self.compare_values("heat", history["balance/heat/change"][-1], held, 1e-6, held)
        self.assertLess(np.abs(history["balance/heat/error"]).max(), 1e-9)

    def test_friction_warms_the_soil(self):
        """A plate that slides: what friction makes is in the ground, but for what the little water that moves brings along."""
        overlay = self.write("warm.xml", WARM.format(material="soil", more=""))
        history = self.run_deck([os.path.join(ROOT, "inputs", "contact", "sliding_plate.xml"), overlay], name="sliding_plate")
        made = history["contact/face/friction heat"][-1]
        self.assertGreater(made, 10)
        self.compare_values("heat in the ground against heat of friction", history["balance/heat/change"][-1], made,
                            1e-3)
        self.assertLess(np.abs(history["balance/heat/error"]).max(), 1e-8)

    def test_heat_through_mesh_motion(self):
        """A pile that is pushed into warm clay: what steps do to heat is kept apart from what the transfer does, and that is little."""
        overlay = self.write("warm.xml", WARM.format(material="clay", more="""
            <Parameter name="reference temperature" type="double" value="10.0"/>
            <Parameter name="initial temperature" type="string" value="10-2*y"/>
            <Parameter name="water expansion" type="double" value="0.0"/>"""))
        pile = [os.path.join(ROOT, "inputs", "pile", name + ".xml") for name in ("clay", "short_pile")]
        history = self.run_deck([*pile, overlay], extra=("--steps", "40"), name="short_pile")
        self.assertLess(np.abs(history["balance/heat/error"]).max(), 1e-10)
        moved = history["mesh motion/change of heat"]
        self.assertGreater(history["time"][-1], 0.02)
        self.assertGreater(np.abs(moved).max(), 0)
        self.compare("heat of the transfer", np.abs(moved).max() / 2.7e9,
                     1e-6)  # of the heat in the ground, in joules


RUBBED = '''
For b In {0:1}
  p = newp; c = newc;
  Point(p) = {0, b, 0}; Point(p+1) = {1, b, 0}; Point(p+2) = {1, b+1, 0}; Point(p+3) = {0, b+1, 0};
  Line(c) = {p, p+1}; Line(c+1) = {p+1, p+2}; Line(c+2) = {p+2, p+3}; Line(c+3) = {p+3, p};
  l = newll; Curve Loop(l) = {c:c+3};
  s~{b} = news; Plane Surface(s~{b}) = {l};
  Transfinite Curve {c:c+3} = 5;
  Transfinite Surface {s~{b}}; Recombine Surface {s~{b}};
  bottom~{b} = c; top~{b} = c+2;
EndFor
Physical Surface("lower") = {s_0}; Physical Surface("upper") = {s_1};
Physical Curve("base") = {bottom_0}; Physical Curve("face") = {top_0};
Physical Curve("under") = {bottom_1}; Physical Curve("top") = {top_1};
'''


@problem("exact", "the work of friction, shared", "Heat of friction between two blocks")
class RubbedBlocks(MudlineCase):
    """A block is pressed on another one and dragged over it: the heat of friction warms both, the slave by its share.
    The blocks are alike and insulated, and water hardly moves, so that the temperatures that rise beside the interface
    are as the shares."""

    def rub(self, share, contact, thickness=None, ranks=1):
        self.write("blocks.geo", RUBBED)
        mesh = {"type": "gmsh", "file": "blocks.geo", "order": 2}
        material = {"porosity": 0.4,
                    "skeleton": {"type": "linear elastic", "Young's modulus": 1e9, "Poisson's ratio": 0.0},
                    "fluid": {"type": "water", "incompressible": True, "unit weight": 1e4},
                    "permeability": {"type": "constant", "hydraulic conductivity": 1e-3},
                    "heat": {"conductivity": 2.0, "grain heat capacity": 800.0}}
        moves, places = {"x": "1e-3*t", "y": "-1e-5*min(1,8*t)"}, ([0.5, 1.25], [0.5, 0.75])
        if thickness:
            mesh = {"type": "extruded", "geometry": "three-dimensional", "along": "y", "length": thickness, "layers": 1,
                    "plane": mesh}
            moves, places = {"x": moves["x"], "y": "0", "z": moves["y"]}, [[x, 0.0, z] for x, z in places]
        history = self.run_deck(self.write("rub.xml", deck_text("rub", {
            "mesh": mesh,
            "materials": {name: {"regions": [name], **material} for name in ("lower", "upper")},
            "physics": {"ground": {"type": "thermo-hydro-mechanical", "water expansion": 0.0}},
            "boundary conditions": {
                "base": {"type": "fixed", "set": "base"}, "moves": {"type": "displacement", "set": "top", **moves},
                **{f"drained {name}": {"type": "pore pressure", "set": name}
                   for name in ("base", "face", "under", "top")}},
            "contacts": {"face": {"slave": "under", "master": "face", "slave heat share": share,
                                  "friction": {"type": "coulomb", "coefficient": 0.5, "on": "total"}, **contact}},
            "stages": {"rub": {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 0.125}}},
            "output": {"probes": dict(zip(("in slave", "in master"), places))}})), ranks=ranks)
        made = history["contact/face/friction heat"][-1]
        # strain 5e-6 in both blocks: 5 kPa press, half of it rubs along 1 mm but for what sticks at first
        self.compare_values("heat made", made, 0.5 * 5e3 * (thickness or 1) * 1e-3, 0.05)
        self.compare_values("heat held", history["balance/heat/change"][-1], made, 1e-4)
        warmer = [history[f"probe/in {body}/temperature"][-1] - 20 for body in ("slave", "master")]
        self.assertGreater(abs(warmer[0]), 1e-9)
        self.compare_values("share of the slave", warmer[0] / sum(warmer), share, 1e-4)

    def test_nodes(self):
        self.rub(0.5, {"type": "node to segment", "drainage": "drained"})
        self.rub(0.25, {"type": "node to segment", "drainage": "drained"}, ranks=2)

    def test_mortar(self):
        self.rub(0.25, {"type": "mortar"})

    def test_faces(self):
        self.rub(0.25, {"type": "point to face", "drainage": "drained"}, thickness=0.25)


if __name__ == "__main__":
    unittest.main()
