"""The fields of a run: an HDF5 file of outputs, each with a time, a stage, and fields at nodes and cells."""

import os

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")  # a running simulation must not be disturbed
from pathlib import Path  # noqa: E402

import h5py  # noqa: E402
import numpy as np  # noqa: E402

from mudline.errors import MudlineError  # noqa: E402

FORMAT = "mudline fields"
# Number of a cell's kind in the file (XDMF): its nodes, and its number in VTK, whose order of nodes it has.
CELLS = {4: (3, 5), 5: (4, 9), 36: (6, 22), 35: (9, 28), 6: (4, 10), 38: (10, 24), 9: (8, 12), 50: (27, 29), 8: (6, 13),
         40: (15, 26), 41: (18, 32)}


def text(value):
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


class Field:
    """One field of one step as numbers that can be drawn."""

    def __init__(self, name, unit, values, by_cell):
        self.name, self.unit, self.values, self.by_cell = name, unit, values, by_cell


class Fields:
    """The fields of a run."""

    def __init__(self, path):
        try:
            self.file = h5py.File(path, "r")
        except OSError:
            raise MudlineError(f"{path}: cannot be read as an HDF5 file") from None
        if text(self.file.attrs.get("format", "")) != FORMAT:
            raise MudlineError(f"{path}: not a field file of mudline")
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
            raise MudlineError(f"{path}: the files of its fields cannot be read; they belong in the folder {folder}") from None
        self.times = np.array([self.file["steps"][name].attrs["time"] for name in self.steps], dtype=float)
        self.stages = [text(self.file["steps"][name].attrs["stage"]) for name in self.steps]

    def mesh_name(self, step):
        """Of a step's mesh; "mesh" where the step names none of its own (None: no step)."""
        group = {} if step is None else self.file["steps"][self.steps[step]]
        return text(group.attrs["mesh"]) if "mesh" in group else "mesh"

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

    def mesh(self, step=None):
        """The mesh of an output as a group of the file: topology, offset, region; None: the first one."""
        name = self.mesh_name(step)
        return (self.file if name == "mesh" else self.file["steps"][self.steps[step]])["mesh"]

    def grid(self, step=-1):
        """The mesh of an output, where it is then, with all fields as they are stored, as a pyvista.UnstructuredGrid."""
        import pyvista

        step = range(len(self.steps))[step]
        mesh, group = self.mesh(step), self.file["steps"][self.steps[step]]
        topology, offset = mesh["topology"][:], mesh["offset"][:]
        kinds = topology[offset]
        cells = np.concatenate([np.concatenate([[CELLS[kind][0]], topology[at + 1:at + 1 + CELLS[kind][0]]])
                                for kind, at in zip(kinds, offset)])
        grid = pyvista.UnstructuredGrid(cells, np.array([CELLS[kind][1] for kind in kinds]), group["coordinates"][:])
        for place, data in (("nodal", grid.point_data), ("cell", grid.cell_data)):
            for link, values in group.get(place, {}).items():
                data[text(values.attrs.get("name", link))] = values[:]
        return grid


def stress_invariants(name, unit, tensor, by_cell):
    """Mean stress (compression positive) and deviatoric stress q from columns xx xy xz yy yz zz."""
    xx, xy, xz, yy, yz, zz = tensor.T
    mean = (xx + yy + zz) / 3
    q = np.sqrt(1.5 * ((xx - mean) ** 2 + (yy - mean) ** 2 + (zz - mean) ** 2 + 2 * (xy**2 + xz**2 + yz**2)))
    return {
        f"mean {name}": Field(f"mean {name}", unit, -mean, by_cell),
        "deviatoric stress": Field("deviatoric stress", unit, q, by_cell),
    }
