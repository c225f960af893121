"""Reads a result of mudline: the fields (.h5), the histories (.csv) beside it. Layout: docs/output_format.md."""

import csv
import os
from pathlib import Path

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")  # a running simulation must not be disturbed
import h5py  # noqa: E402
import numpy as np  # noqa: E402

from report_space import Mesh  # noqa: E402

NODES_OF_CELL = {4: 3, 5: 4, 36: 6, 35: 9}  # XDMF cell number: nodes
# Straight-sided triangles that cover a cell, and its outline; node order: corners, edge middles, centre.
TRIANGLES_OF_CELL = {
    4: [(0, 1, 2)],
    5: [(0, 1, 2), (0, 2, 3)],
    36: [(0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)],
    35: [(0, 4, 8), (4, 1, 8), (1, 5, 8), (5, 2, 8), (2, 6, 8), (6, 3, 8), (3, 7, 8), (7, 0, 8)],
}
OUTLINE_OF_CELL = {4: [0, 1, 2], 5: [0, 1, 2, 3], 36: [0, 3, 1, 4, 2, 5], 35: [0, 4, 1, 5, 2, 6, 3, 7]}


RESULTS = ".results.csv"  # ending of the results of a run, beside its history


class ReportError(Exception):
    """The user asked for something that is not there; printed as one line."""


class Field:
    """One field of one step as numbers that can be drawn."""

    def __init__(self, name, unit, values, by_cell):
        self.name, self.unit, self.values, self.by_cell = name, unit, values, by_cell


def find_files(argument):
    """(field file, history file) that a stem, a file or a folder means; either may be None, not both."""
    path = Path(argument)
    if path.is_dir():
        stems = sorted({p.with_suffix("") for p in path.iterdir() if p.suffix == ".xdmf" or is_result(p)})
        if not stems:
            stems = sorted(p.with_suffix("") for p in path.glob("*.csv") if not p.name.endswith(RESULTS))
        if not stems:
            raise ReportError(f"{argument}: the folder holds no result (.h5 with .xdmf, or .csv)")
        if len(stems) > 1:
            raise ReportError(
                f"{argument}: the folder holds several results, name one: " + ", ".join(s.name for s in stems)
            )
        stem = stems[0]
    else:
        path = path.with_name(path.name.removesuffix(RESULTS))
        stem = path.with_suffix("") if path.suffix in (".h5", ".xdmf", ".csv") else path
    fields, history = (stem.with_name(stem.name + suffix) for suffix in (".h5", ".csv"))
    if path.suffix == ".h5" and not path.is_file():
        raise ReportError(f"{argument}: there is no such file")
    if not fields.is_file() and not history.is_file():
        raise ReportError(f"{argument}: there is no such result (neither {fields} nor {history} exists)")
    return (fields if fields.is_file() else None), (history if history.is_file() else None)


def is_result(path):
    if path.suffix != ".h5":
        return False
    try:
        with h5py.File(path, "r") as file:
            return text(file.attrs.get("format", "")) == "mudline fields"
    except OSError:
        return False


def text(value):
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


class PlaneCells:
    """Triangles of the cells of a mesh, the cells they belong to, edges, and those of the boundary."""

    def __init__(self, mesh):
        topology, offset = mesh["topology"][:], mesh["offset"][:]
        kinds = topology[offset]
        triangles, owners, edges = [], [], []
        for kind, count in NODES_OF_CELL.items():
            cells = np.flatnonzero(kinds == kind)
            if not len(cells):
                continue
            nodes = topology[offset[cells][:, None] + 1 + np.arange(count)]
            for triangle in TRIANGLES_OF_CELL[kind]:
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


class FieldResult:
    """The fields of a run."""

    def __init__(self, path):
        try:
            self.file = h5py.File(path, "r")
        except OSError:
            raise ReportError(f"{path}: cannot be read as an HDF5 file") from None
        if text(self.file.attrs.get("format", "")) != "mudline fields":
            raise ReportError(f"{path}: not a field file of mudline")
        self.geometry = text(self.file.attrs["geometry"])
        self.axisymmetric = self.geometry == "axisymmetric"
        self.in_space = self.geometry == "three-dimensional"
        self.metadata = {name: text(data[()]) for name, data in self.file["metadata"].items()}
        try:
            self.regions = text(self.file["mesh/region names"][()]).split("\n")
            self.steps = [name for name, step in self.file["steps"].items() if "time" in step.attrs]
        except KeyError:  # a link that leads nowhere
            link = self.file.get("mesh", getlink=True)
            folder = Path(path).parent / getattr(link, "filename", ".").rpartition("/")[0]
            raise ReportError(f"{path}: the files of its fields cannot be read; they belong in the folder {folder}") from None
        self.times = np.array([self.file["steps"][name].attrs["time"] for name in self.steps], dtype=float)
        self.stages = [text(self.file["steps"][name].attrs["stage"]) for name in self.steps]
        self._read_cells()

    def _read_cells(self):
        self._cells = {}  # by name of their mesh
        if self.in_space:
            if not self.mesh_in_space(None).blocks:
                raise ReportError(f"{self.file.filename}: no tetrahedra or hexahedra of known kind")
            return
        first = self.cells(None)
        self.triangles, self.triangle_cells, self.edges, self.boundary = (
            first.triangles, first.triangle_cells, first.edges, first.boundary)

    def mesh_name(self, step):
        """Of a step's mesh; "mesh" where the step names none of its own (None: no step)."""
        group = {} if step is None else self.file["steps"][self.steps[step]]
        return text(group.attrs["mesh"]) if "mesh" in group else "mesh"

    def _of_mesh(self, step, make):
        name = self.mesh_name(step)
        if name not in self._cells:
            self._cells[name] = make((self.file if name == "mesh" else self.file["steps"][self.steps[step]])["mesh"])
        return self._cells[name]

    def cells(self, step):
        """The plane cells of a step's mesh."""
        return self._of_mesh(step, PlaneCells)

    def mesh_in_space(self, step):
        """A step's mesh in space."""
        return self._of_mesh(step, lambda mesh: Mesh(mesh["topology"][:], mesh["offset"][:], mesh["coordinates"][:]))

    def stage_spans(self):
        """[(stage, first time, last time, number of steps)] in order."""
        spans = []
        for stage, time in zip(self.stages, self.times):
            if spans and spans[-1][0] == stage:
                spans[-1][2] = time
                spans[-1][3] += 1
            else:
                spans.append([stage, time, time, 1])
        return spans

    def nearest_step(self, time):
        return int(np.argmin(np.abs(self.times - time)))

    def coordinates(self, step):
        return self.file["steps"][self.steps[step]]["coordinates"][:, : 3 if self.in_space else 2]

    def bodies(self, step):
        """{name: current contour (n, 2)}"""
        group = self.file["steps"][self.steps[step]].get("bodies", {})
        result = {}
        for link, body in self.file.get("bodies", {}).items():
            name = text(body.attrs.get("name", link))
            if link in group and "coordinates" in group[link]:  # shifted and turned
                result[name] = group[link]["coordinates"][:, :2]
                continue
            shift = group[link].attrs["displacement"] if link in group else np.zeros(2)
            result[name] = body["contour"][:] + shift
        return result

    def bodies_in_space(self, step):
        """{name: (points (n, 3), triangles (m, 3)) of the current surface}"""
        placed = self.file["steps"][self.steps[step]].get("bodies", {})
        return {
            text(body.attrs["name"]): (placed[link]["coordinates"][:], body["triangles"][:])
            for link, body in self.file.get("bodies", {}).items()
        }

    def fields(self, step):
        """{name: Field} of what can be drawn: scalars, lengths of vectors, invariants of stresses."""
        result = {}
        for group, by_cell in (("nodal", False), ("cell", True)):
            for link, data in self.file["steps"][self.steps[step]].get(group, {}).items():
                name, unit = text(data.attrs.get("name", link)), text(data.attrs.get("unit", ""))
                values = data[:]
                if values.ndim == 1:
                    result[name] = Field(name, unit, values, by_cell)
                elif values.shape[1] == 3:
                    result[name] = Field(name, unit, np.linalg.norm(values, axis=1), by_cell)
                    for axis, column in zip("xyz" if self.in_space else "xy", values.T):
                        result[f"{name} {axis}"] = Field(f"{name} {axis}", unit, column, by_cell)
                elif "stress" in name:
                    result.update(stress_invariants(name, unit, values, by_cell))
        return result


def stress_invariants(name, unit, tensor, by_cell):
    """Mean stress (compression positive) and deviatoric stress q from columns xx xy xz yy yz zz."""
    xx, xy, xz, yy, yz, zz = tensor.T
    mean = (xx + yy + zz) / 3
    q = np.sqrt(1.5 * ((xx - mean) ** 2 + (yy - mean) ** 2 + (zz - mean) ** 2 + 2 * (xy**2 + xz**2 + yz**2)))
    return {
        f"mean {name}": Field(f"mean {name}", unit, -mean, by_cell),
        "deviatoric stress": Field("deviatoric stress", unit, q, by_cell),
    }


class History:
    """The CSV of histories: time and columns {(group, name, unit): values}."""

    def __init__(self, path):
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        if not rows or not rows[0] or rows[0][0] != "time [s]":
            raise ReportError(f"{path}: not a history of mudline (the first column is not 'time [s]')")
        header = rows[0]
        # A last row cut short belongs to a step that is being written.
        complete = [row for row in rows[1:] if len(row) == len(header)]
        try:
            values = np.array(complete, dtype=float).reshape(len(complete), len(header))
        except ValueError:
            raise ReportError(f"{path}: a row holds something that is not a number") from None
        self.time = values[:, 0]
        self.columns = {}
        for title, column in zip(header[1:], values[:, 1:].T):
            path_text, _, unit = title.rpartition(" [")
            group, _, name = path_text.rpartition("/")
            self.columns[(group, name, unit.rstrip("]"))] = column

    def groups(self):
        """{group: {unit: {name: values}}} in the order of the file."""
        result = {}
        for (group, name, unit), values in self.columns.items():
            result.setdefault(group, {}).setdefault(unit, {})[name] = values
        return result
