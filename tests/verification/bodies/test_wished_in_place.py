"""A smooth cylinder and a ball wished in place in a ring of soil under stress: the contact starts pressed with the soil's traction, and the start is
balanced at once. Taken away, it lets the hole shrink as Lamé says; pulled, it takes the soil along on both sides, since it is pressed."""
import unittest

import numpy as np

from compared_case import problem
from mudline_case import MudlineCase, deck_text
from references.ring import Ring

# stiff soil, so that the change of geometry is no part of the answers
A, B, YOUNG, POISSON, STRESS, WAY = 0.5, 2.5, 1e8, 0.3, 1e5, 1e-5
SCALE = STRESS * A / (YOUNG / (1 + POISSON))  # [m] of the hole's unloading
# Half a ring, x >= 0; triangles or quadrilaterals.
RING = '''SetFactory("Built-in");
DefineConstant[ around = {%d, Name "around"}, out = {%d, Name "out"} ];
Point(1) = {0, 0, 0};
Point(2) = {0, -0.5, 0}; Point(3) = {0.5, 0, 0}; Point(4) = {0, 0.5, 0};
Point(5) = {0, -2.5, 0}; Point(6) = {2.5, 0, 0}; Point(7) = {0, 2.5, 0};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 4}; Circle(3) = {5, 1, 6}; Circle(4) = {6, 1, 7};
Line(5) = {2, 5}; Line(6) = {3, 6}; Line(7) = {4, 7};
Curve Loop(1) = {5, 3, -6, -1}; Curve Loop(2) = {6, 4, -7, -2};
Plane Surface(1) = {1}; Plane Surface(2) = {2};
Transfinite Curve {1, 2, 3, 4} = around + 1;
Transfinite Curve {5, 6, 7} = out + 1 Using Progression %g;
Transfinite Surface {1, 2};
%s
Physical Surface("soil") = {1, 2};
Physical Curve("hole") = {1, 2}; Physical Curve("far side") = {3, 4}; Physical Curve("axis") = {5, 7};
'''
# The disc that fills the hole, with a core that is held, and sides that do not match the hole's.
DISC = '''
Point(11) = {0, 0, 0}; Point(12) = {0, -0.5, 0}; Point(13) = {0.5, 0, 0}; Point(14) = {0, 0.5, 0};
Point(15) = {0, -0.2, 0}; Point(16) = {0.2, 0, 0}; Point(17) = {0, 0.2, 0};
Circle(11) = {12, 11, 13}; Circle(12) = {13, 11, 14}; Circle(13) = {15, 11, 16}; Circle(14) = {16, 11, 17};
Line(15) = {12, 15}; Line(16) = {13, 16}; Line(17) = {14, 17};
Curve Loop(11) = {11, 16, -13, -15}; Curve Loop(12) = {12, 17, -14, -16};
Plane Surface(11) = {11}; Plane Surface(12) = {12};
Transfinite Curve {11, 12, 13, 14} = 10;
Transfinite Curve {15, 16, 17} = 4;
Transfinite Surface {11, 12};
Physical Surface("disc") = {11, 12};
Physical Curve("hull") = {11, 12}; Physical Curve("core") = {13, 14}; Physical Curve("axis") = {5, 7, 15, 17};
'''
ELASTIC = {"type": "linear elastic", "Young's modulus": YOUNG, "Poisson's ratio": POISSON}
DRY = ("solid", {"density": 2000.0, "skeleton": ELASTIC}, {})
WET = ("biot", {"porosity": 0.4, "Biot coefficient": 0.8, "skeleton": ELASTIC, "fluid": {"type": "water"},
                "permeability": {"type": "constant", "hydraulic conductivity": 1e-6}}, {"pore pressure": 5e4})
PULL = {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 0.5}}


@problem("exact", "Lamé (1852); Timoshenko and Goodier (1970), sections 28 and 132", "Bodies wished in place")
class WishedInPlace(MudlineCase):
    def deck(self, name, geometry, soil=DRY, order=2, around=12, out=8, quads=False, contact=None, penalty=1e12, stages=None, initial=None,
             gravity=None, layers=6):
        """quads: quadrilaterals. penalty [Pa/m]: so stiff that the pull's pressures of some kPa penetrate 1e-4 of its displacement."""
        physics, material, water = soil
        space = geometry == "space"
        self.write("ring.geo", RING % (around, out, 1.25, "Recombine Surface {1, 2};" if quads else ""))
        plane = {"type": "gmsh", "file": "ring.geo", **({} if order == 2 else {"order": order})}
        mesh = {"type": "revolved", "geometry": "three-dimensional", "angle": 90.0, "layers": layers, "plane": plane} if space else \
            {"geometry": geometry, **plane}
        effective = STRESS - 0.8 * water.get("pore pressure", 0.0)
        more = {"gravity": gravity} if gravity else {}
        if space:  # four points in a curved tetrahedron do not integrate a constant stress exactly: 3e-4 of SCALE
            more["quadrature degree"] = 4
        up, bottom = ("z", [0.0, 0.0, -A]) if space else ("y", [0.0, -A])
        conditions = {"far side": {"type": "fixed", "set": "far side"}, "axis": {"type": "fixed", "set": "axis", "components": "x"}}
        if space:
            conditions = {"far side": {"type": "fixed", "set": "far side"}, "start": {"type": "fixed", "set": "start", "components": "y"},
                          "end": {"type": "fixed", "set": "end", "components": "x"}}
        contour = {"type": "sphere", "diameter": 2 * A}
        body = {"surface": {"type": "revolved", "contour": contour}} if space else {"contour": contour}
        way = f"{WAY}*t"
        return self.write(name + ".xml", deck_text(name, {
            "mesh": mesh, "materials": {"soil": material},
            "physics": {"ground": {"type": physics, **more, "initial state": initial or {
                "type": "uniform", **{f"effective stress {i}": effective for i in ("xx", "yy", "zz")}, **water}}},
            "bodies": {"body": {"position": bottom, **body, "motion": {"type": "prescribed displacement", **({} if space else {"x": "0"}), up: way}}},
            "boundary conditions": conditions,
            "contacts": {"hull": {"type": "penalty", "body": "body", "surface": "hole", "penalty": penalty, **(contact or {"initial gap": "in-situ stress"})}},
            "stages": {"start": {"type": "geostatic", "contacts": ["hull"], "balance tolerance": 1e-4 * SCALE}, **(stages or {})},
            "output": {"probes": {"wall": [A, 0.0, 0.0] if space else [A, 0.0]}}}))

    def assert_pulled(self, geometry, **options):
        """The whole force against the reference, 1 %: of the mesh."""
        name = geometry.replace(" ", "_")
        history = self.run_deck(self.deck(name, geometry, stages={"pull": PULL}, **options))
        k = 1 if geometry == "plane strain" else 2
        part = {"plane strain": 0.5, "axisymmetric": 1.0, "space": 0.25}[geometry]
        expected = part * Ring(k, A, B, YOUNG, POISSON).pulled(WAY)
        found = history["contact/hull/reaction " + ("z" if geometry == "space" else "y")]
        self.compare(f"{name} {options}: force at the start", abs(found[0]) / (STRESS * A), 1e-4)
        self.compare(f"{name} {options}: pulled", abs(found[-1] / expected - 1), 0.01)

    def assert_released(self, geometry, **options):
        """The inward displacement of the wall after the body is gone, 1 %."""
        name = geometry.replace(" ", "_")
        gone = {"type": "quasi-static", "duration": 1.0, "contacts": ["none"], "time step": {"initial": 1.0}}
        history = self.run_deck(self.deck(name, geometry, stages={"gone": gone}, **options))
        expected = Ring(1 if geometry == "plane strain" else 2, A, B, YOUNG, POISSON).unloaded(STRESS)
        self.compare(f"{name} {options}: released", abs(history["probe/wall/displacement x"][-1] / expected - 1),
                     0.01)

    def test_pulled_in_the_plane(self):
        self.assert_pulled("plane strain")
        self.assert_pulled("plane strain", order=1, around=24, out=20, quads=True)
        self.assert_pulled("plane strain", penalty=2e9, contact={"initial gap": "in-situ stress", "enforcement": "augmented Lagrangian"})

    def test_pulled_in_axisymmetry(self):
        self.assert_pulled("axisymmetric")

    def test_pulled_in_space(self):
        self.assert_pulled("space", around=6, out=5)

    def test_released_in_the_plane(self):
        self.assert_released("plane strain")

    def test_released_in_space(self):
        self.assert_released("space", around=6, out=5)

    def test_water_counts(self):
        """Saturated soil under the same total stress, part of it in the water (Biot coefficient 0.8)."""
        history = self.run_deck(self.deck("wet", "plane strain", soil=WET))
        self.compare("penetration", abs(history["contact/hull/maximum penetration"][-1] * 1e12 / STRESS - 1), 1e-3)

    def meshed(self, soil=DRY, pull=True):
        """A stiff disc of the mesh instead of the body, with other sides than the hole's: its points press the nodes of the hole. Its
        stress is that of the soil, so it is in balance too. Nodes whose forces are those of their tributary lengths are less exact."""
        physics, material, water = soil
        ring = (RING % (12, 8, 1.25, "")).replace('; Physical Curve("axis") = {5, 7};', ";") + DISC
        self.write("disc.geo", ring)
        effective = STRESS - 0.8 * water.get("pore pressure", 0.0)
        stiff = {**material, "skeleton": {**ELASTIC, "Young's modulus": 1e5 * YOUNG}}
        conditions = {"far side": {"type": "fixed", "set": "far side"}, "axis": {"type": "fixed", "set": "axis", "components": "x"},
                      "disc": {"type": "displacement", "set": "core", "y": f"{WAY}*t"}}
        stages = {"start": {"type": "geostatic", "contacts": ["hull"], "balance tolerance": 2e-3 * SCALE}}
        if pull:
            stages["pull"] = PULL
        return self.run_deck(self.write("meshed.xml", deck_text("meshed", {
            "mesh": {"type": "gmsh", "file": "disc.geo", "geometry": "plane strain"},
            "materials": {"soil": {**material, "regions": ["soil"]}, "disc": {**stiff, "regions": ["disc"]}},
            "physics": {"ground": {"type": physics, "initial state": {
                "type": "uniform", **{f"effective stress {i}": effective for i in ("xx", "yy", "zz")}, **water}}},
            "boundary conditions": conditions,
            "contacts": {"hull": {"type": "node to segment", "slave": "hole", "master": "hull", "penalty": 1e12, "initial gap": "in-situ stress"}},
            "stages": stages})))

    def test_meshed_body(self):
        """Pulled as the rigid one, and balanced from the start: a factor in the pressures would show at once."""
        history = self.meshed()
        force = -history["contact/hull/force on slave y"]
        self.compare("meshed disc: force at the start", abs(force[0]) / (STRESS * A), 1e-3)
        expected = 0.5 * Ring(1, A, B, YOUNG, POISSON).pulled(WAY)
        self.compare("meshed disc pulled", abs(abs(force[-1] / expected) - 1), 0.015)
        self.compare("meshed disc: area", abs(history["contact/hull/contact area"][0] / (np.pi * A) - 1), 1e-3)

    def test_meshed_body_under_water(self):
        history = self.meshed(WET, pull=False)
        self.compare("penetration", abs(history["contact/hull/maximum penetration"][-1] * 1e12 / STRESS - 1), 1e-2)

    def test_weight_of_the_soil_carries_the_body(self):
        """K0 = 1 under gravity: the reaction is the weight of the soil that the hole is missing."""
        initial = {"type": "geostatic", "K0": 1.0, "surcharge": STRESS}
        for geometry, volume in (("plane strain", np.pi * A * A / 2), ("axisymmetric", 4 / 3 * np.pi * A ** 3)):
            history = self.run_deck(self.deck("weight", geometry, initial=initial, gravity=[0.0, -10.0]), settings=(f"output/name={geometry}",), name=geometry)
            self.compare(geometry, abs(history["contact/hull/reaction y"][-1] / (2e4 * volume) - 1), 2e-3)

    def test_straight_sides_closed(self):
        """Straight sides miss a round hull by 2e-3 m: as placed it presses with that, closed it does not press at all."""
        free = {"type": "stress free"}
        as_placed = self.run_deck(self.deck("as_placed", "plane strain", order=1, around=8, contact={"initial gap": "as placed"}, initial=free),
                                  settings=("stages/start/balance tolerance=0",))
        self.assertGreater(as_placed["contact/hull/maximum penetration"][-1], 1e-6)
        closed = self.run_deck(self.deck("closed", "plane strain", order=1, around=8, contact={"initial gap": "closed"}, initial=free))
        self.assertLess(closed["contact/hull/maximum penetration"][-1], 1e-15)
        self.compare("displacement of the wall", abs(closed["probe/wall/displacement x"][-1]), 1e-15)

    @problem("consistency")
    def test_restart_and_ranks(self):
        """The offsets are in the checkpoint, and on other ranks."""
        deck = self.deck("whole", "plane strain", penalty=1e11, stages={"pull": PULL})
        whole = self.run_deck(deck)
        self.run_deck(deck, ("output/name=parts",), extra=("--steps", "1"), name="parts")
        parts = self.run_deck(deck, ("output/name=parts",), extra=("--restart",), name="parts")
        self.assertEqual(whole.data.tolist(), parts.data.tolist())
        two = self.run_deck(deck, ("output/name=two",), ranks=2, name="two")
        self.assert_same_run(whole, two, ["contact/hull/reaction y", "contact/hull/maximum penetration"], "2 ranks")


if __name__ == "__main__":
    unittest.main()
