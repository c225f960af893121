"""Groups in files of Gmsh's format 2.2 belong to elements: files whose elements share an elementary tag, and sides in two groups."""
import os
import unittest

from compared_case import problem
from grid_file import Grid
from mudline_case import MudlineCase, deck_text

YOUNG, POISSON, LOAD = 1e7, 0.3, 1e4
CONSTRAINED = YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON))


@problem("exact", "one-dimensional compression", "Groups of mesh files")
class Groups(MudlineCase):
    def squeeze(self, grid, side_rollers, **file):
        """A confined slab under a load of LOAD on its top: the histories of a run."""
        path = grid.write(os.path.join(self.folder, "mesh.msh"), **file)
        rollers = {f"roller {name}": {"type": "fixed", "set": name, "components": axis} for name, axis in side_rollers}
        up = "xyz"[grid.dim - 1]
        self.write("case.xml", deck_text("case", {
            "mesh": {"type": "gmsh", "geometry": "plane strain" if grid.dim == 2 else "three-dimensional", "file": path},
            "materials": {"soil": {"density": 1800.0, "skeleton": {
                "type": "linear elastic", "Young's modulus": YOUNG, "Poisson's ratio": POISSON}}},
            "physics": {"ground": {"type": "solid"}},
            "boundary conditions": {"base": {"type": "fixed", "set": "bottom"}, **rollers,
                                    "load": {"type": "traction", "set": "top", up: -LOAD}},
            "stages": {"squeeze": {"type": "quasi-static", "duration": 1.0, "time step": {"initial": 1.0}}},
            "output": {"probes": {"top": [1.0] * grid.dim}}}))
        return self.run_deck(os.path.join(self.folder, "case.xml")), up

    def assert_squeezed(self, grid, side_rollers, **file):
        history, up = self.squeeze(grid, side_rollers, **file)
        # small strains: the load over the stiffness makes 7e-4, and the solution of large strains differs by about that
        self.compare_values("settlement", history[f"probe/top/displacement {up}"][-1], -LOAD / CONSTRAINED, 2e-3)
        self.compare_values("reaction of the base", history[f"reaction/base {up}"][-1], LOAD, 1e-8)

    def test_one_elementary_tag_for_all(self):
        """Before, every side was in every group: held everywhere, it did not settle, and nothing was said."""
        self.assert_squeezed(Grid(9, (3, 2)), [("left", "x"), ("right", "x")], shared_tag=True)
        self.assert_squeezed(Grid(27, (2, 2, 2)), [("left", "x"), ("right", "x"), ("front", "y"), ("back", "y")], shared_tag=True)

    def test_side_in_two_groups(self):
        for shared in (False, True):
            self.assert_squeezed(Grid(9, (3, 2)), [("ends", "x")], shared_tag=shared,
                                 more_groups=[("ends", ["left", "right"]), ("all", ["left", "right", "bottom", "top"])])


if __name__ == "__main__":
    unittest.main()
