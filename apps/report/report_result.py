"""What the report draws of a result: its fields with the cells of their meshes cut into triangles."""

import sys
from pathlib import Path

import numpy as np

# the package lies beside the applications in the source tree, and in share/ of an installation
sys.path[1:1] = [str(place / "python") for place in Path(__file__).resolve().parents[1:3]]
from mudline import Field, Fields, History, MudlineError, Result  # noqa: E402, F401
from mudline.fields import CELLS, stress_invariants, text  # noqa: E402, F401
from mudline.units import scaled, time_unit  # noqa: E402, F401
from report_space import Mesh  # noqa: E402

# Straight-sided triangles that cover a cell, and its outline; node order: corners, edge middles, centre.
TRIANGLES_OF_CELL = {
    4: [(0, 1, 2)],
    5: [(0, 1, 2), (0, 2, 3)],
    36: [(0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)],
    35: [(0, 4, 8), (4, 1, 8), (1, 5, 8), (5, 2, 8), (2, 6, 8), (6, 3, 8), (3, 7, 8), (7, 0, 8)],
}
OUTLINE_OF_CELL = {4: [0, 1, 2], 5: [0, 1, 2, 3], 36: [0, 3, 1, 4, 2, 5], 35: [0, 4, 1, 5, 2, 6, 3, 7]}


class PlaneCells:
    """Triangles of the cells of a mesh, the cells they belong to, edges, and those of the boundary."""

    def __init__(self, mesh):
        topology, offset = mesh["topology"][:], mesh["offset"][:]
        kinds = topology[offset]
        triangles, owners, edges = [], [], []
        for kind, inner in TRIANGLES_OF_CELL.items():
            cells = np.flatnonzero(kinds == kind)
            if not len(cells):
                continue
            nodes = topology[offset[cells][:, None] + 1 + np.arange(CELLS[kind][0])]
            for triangle in inner:
                triangles.append(nodes[:, triangle])
                owners.append(cells)
            outline = OUTLINE_OF_CELL[kind]
            for a, b in zip(outline, outline[1:] + outline[:1]):
                edges.append(nodes[:, (a, b)])
        self.triangles = np.vstack(triangles) if triangles else np.empty((0, 3), int)
        self.triangle_cells = np.concatenate(owners) if owners else np.empty(0, int)
        every = np.sort(np.vstack(edges), axis=1) if edges else np.empty((0, 2), int)
        self.edges, uses = np.unique(every, axis=0, return_counts=True)
        self.boundary = self.edges[uses == 1]


class FieldResult(Fields):
    """The fields of a run, to be drawn."""

    def __init__(self, path):
        super().__init__(path)
        self._cells = {}  # by name of their mesh
        if self.in_space:
            if not self.mesh_in_space(None).blocks:
                raise MudlineError(f"{self.file.filename}: no tetrahedra or hexahedra of known kind")
            return
        first = self.cells(None)
        self.triangles, self.triangle_cells, self.edges, self.boundary = (
            first.triangles, first.triangle_cells, first.edges, first.boundary)

    def _of_mesh(self, step, make):
        name = self.mesh_name(step)
        if name not in self._cells:
            self._cells[name] = make(self.mesh(step))
        return self._cells[name]

    def cells(self, step):
        """The plane cells of a step's mesh."""
        return self._of_mesh(step, PlaneCells)

    def mesh_in_space(self, step):
        """A step's mesh in space."""
        return self._of_mesh(step, lambda mesh: Mesh(mesh["topology"][:], mesh["offset"][:], mesh["coordinates"][:]))
