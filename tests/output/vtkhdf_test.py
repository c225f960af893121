"""The files for VTK (VTKHDF), read as its specification says and, where VTK is installed, by VTK's own reader, against
the fields of the same run."""
import os
import sys
import unittest

import h5py
import numpy as np
from mudline_case import ROOT, MudlineCase, deck_text, program

sys.path.insert(0, os.path.join(ROOT, "python"))
sys.path.insert(0, os.path.join(ROOT, "tests", "verification", "ale"))
from mudline.fields import CELLS, Fields  # noqa: E402
from remeshed_ball import FOCUS, WALL, ball, remeshing  # noqa: E402

TENSOR = [0, 3, 5, 1, 4, 2]  # columns xx yy zz xy yz xz of VTK in the fields' xx xy xz yy yz zz
LINE, TRIANGLE = 4, 5


class Grid:
    """A grid at one time: points (n, 3), cells [(VTK's number, nodes)], arrays by name, field data by name."""

    def __init__(self, time, points, types, ends, nodes):
        self.time, self.points = time, np.asarray(points)
        self.cells = [(int(kind), list(nodes[a:b])) for kind, a, b in zip(types, ends[:-1], ends[1:])]
        self.data, self.fields = {"PointData": {}, "CellData": {}}, {}


def by_specification(path):
    """The grids of all times, from the arrays and their offsets, and nothing else."""
    grids = []
    with h5py.File(path) as file:
        root = file["VTKHDF"]
        assert list(root.attrs["Version"]) == [2, 0] and root.attrs["Type"] == b"UnstructuredGrid"
        steps = root["Steps"]
        count = {name: root["NumberOf" + name][:] for name in ("Points", "Cells", "ConnectivityIds")}
        assert all(len(table) == steps.attrs["NSteps"] for table in steps.values() if isinstance(table, h5py.Dataset))
        for k in range(steps.attrs["NSteps"]):
            assert steps["NumberOfParts"][k] == 1
            part = steps["PartOffsets"][k]
            at = {name: steps[name][k] for name in ("PointOffsets", "CellOffsets", "ConnectivityIdOffsets")}
            points, cells, nodes = (count[name][part] for name in ("Points", "Cells", "ConnectivityIds"))
            ends = at["CellOffsets"] + part  # every part before has one more end than cells
            grid = Grid(steps["Values"][k], root["Points"][at["PointOffsets"]:][:points],
                        root["Types"][at["CellOffsets"]:][:cells], root["Offsets"][ends:][:cells + 1],
                        root["Connectivity"][at["ConnectivityIdOffsets"]:][:nodes])
            for group, rows in (("PointData", points), ("CellData", cells)):
                for name, values in root[group].items():
                    first = steps[group + "Offsets"][name][k]
                    grid.data[group][name] = values[first:first + rows]
            for name, values in root["FieldData"].items():
                first, (_, rows) = steps["FieldDataOffsets"][name][k], steps["FieldDataSizes"][name][k]
                grid.fields[name] = [v.decode() if isinstance(v, bytes) else int(v) for v in values[first:first + rows]]
            grids.append(grid)
    return grids


def by_vtk(path):
    """The same by VTK's reader."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
    from vtkmodules.vtkIOHDF import vtkHDFReader

    reader = vtkHDFReader()
    reader.SetFileName(path)
    reader.UpdateInformation()
    information, key = reader.GetOutputInformation(0), vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    grids = []
    for k in range(information.Length(key)):
        time = information.Get(key, k)
        reader.SetStep(k)  # a time is not enough: there may be two outputs of one
        reader.Modified()
        reader.Update()
        found = reader.GetOutputDataObject(0)
        cells = found.GetCells()
        grid = Grid(time, vtk_to_numpy(found.GetPoints().GetData()).copy(),
                    [found.GetCellType(i) for i in range(found.GetNumberOfCells())],
                    vtk_to_numpy(cells.GetOffsetsArray()), vtk_to_numpy(cells.GetConnectivityArray()))
        for group, data in (("PointData", found.GetPointData()), ("CellData", found.GetCellData())):
            arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
            grid.data[group] = {array.GetName(): vtk_to_numpy(array).copy() for array in arrays}
        for name in ("step", "region names"):
            array = found.GetFieldData().GetAbstractArray(name)
            if array is not None:
                values = [array.GetVariantValue(i) for i in range(array.GetNumberOfValues())]
                grid.fields[name] = [value.ToString() if name == "region names" else value.ToInt() for value in values]
        grids.append(grid)
    return grids


def readers():
    try:
        import vtkmodules.vtkIOHDF  # noqa: F401
    except ImportError:
        return [by_specification]
    return [by_specification, by_vtk]


class Vtkhdf(MudlineCase):
    def runs(self, *arguments, ranks=1):
        done = program(["run", "-q", *arguments], ranks, self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)

    def compare_with_h5(self, name):
        """Returns the number of steps, of meshes, and the kinds of cells."""
        stem = os.path.join(self.folder, "results", name)
        fields = Fields(stem + ".h5")
        meshes, kinds = set(), set()
        for read in readers():
            with self.subTest(result=name, reader=read.__name__):
                grids = read(stem + ".vtkhdf")
                self.assertEqual([grid.time for grid in grids], list(fields.times))
                for k, grid in enumerate(grids):
                    step, mesh = fields.file["steps"][fields.steps[k]], fields.mesh(k)
                    meshes.add(fields.mesh_name(k))
                    np.testing.assert_array_equal(grid.points, step["coordinates"][:])
                    topology = mesh["topology"][:]
                    cells = [(CELLS[topology[at]][1], list(topology[at + 1:at + 1 + CELLS[topology[at]][0]]))
                             for at in mesh["offset"][:]]
                    kinds.update(kind for kind, _ in cells)
                    self.assertEqual(grid.cells, cells)
                    np.testing.assert_array_equal(grid.data["CellData"].pop("region"), mesh["region"][:])
                    for group, there in (("PointData", "nodal"), ("CellData", "cell")):
                        expected = {}
                        for values in step[there].values():
                            name_, unit = (values.attrs[what].decode() if isinstance(values.attrs[what], bytes) else
                                           values.attrs[what] for what in ("name", "unit"))
                            array = values[:]
                            expected[name_.replace("/", " ") + f" [{unit.replace('/', ' per ')}]"] = (
                                array[:, TENSOR] if array.ndim == 2 and array.shape[1] == 6 else array)
                        self.assertEqual(set(grid.data[group]), set(expected))
                        for what, array in expected.items():
                            np.testing.assert_array_equal(grid.data[group][what], array, what)
                    self.assertEqual(grid.fields["step"], [step.attrs["step"]])
                    self.assertEqual(grid.fields["region names"], fields.regions)
                for body in fields.file["bodies"]:
                    outline = fields.file["bodies"][body]
                    found = read(os.path.join(stem + ".fields", body + ".vtkhdf"))
                    self.assertEqual([grid.time for grid in found], list(fields.times))
                    for k, grid in enumerate(found):
                        points = fields.file["steps"][fields.steps[k]]["bodies"][body]["coordinates"][:]
                        np.testing.assert_array_equal(grid.points, points)
                        corners = ([(TRIANGLE, list(row)) for row in outline["triangles"][:]] if "triangles" in outline
                                   else [(LINE, list(range(len(points))))])
                        self.assertEqual(grid.cells, corners)
        return len(fields.steps), len(meshes), kinds

    def test_remeshed_in_the_plane_and_restarted_on_two_ranks(self):
        decks = [self.write("ball.xml", ball()), self.write("over.xml", remeshing(4, WALL, FOCUS))]
        often = ["--set", "output/field steps=2", "--set", "stages/push/duration=2.5e-3"]
        self.runs(*decks, *often, "--steps", "5", ranks=2)
        first = self.compare_with_h5("ball")
        self.runs(*decks, *often, "--restart")
        steps, meshes, kinds = self.compare_with_h5("ball")
        self.assertGreater(steps, first[0] + 2)
        self.assertGreaterEqual(meshes, 3)
        self.assertEqual(kinds, {22})
        # the files hold no values of their own: those of the mesh, which stay, and those of the steps, are elsewhere
        with h5py.File(os.path.join(self.folder, "results", "ball.vtkhdf")) as file:
            root = file["VTKHDF"]
            arrays = [array for group in ("PointData", "CellData") for array in root[group].values()]
            for array in (root["Points"], root["Connectivity"], *arrays):
                self.assertTrue(array.is_virtual, array.name)
            cells = root["NumberOfCells"][:]
            self.assertEqual(len(cells), meshes)
            self.assertEqual(len(root["Types"]), sum(cells))

    def test_remeshed_in_space(self):
        deck = os.path.join(ROOT, "inputs", "space", "ball.xml")
        over = self.write("space.xml", deck_text("space", {"mesh motion": {
            "remeshing": {"when quality below": 0.0, "when side above": 0.1, "least steps": 2, "wall size": 0.25}}}))
        settings = ("mesh/cells={5, 3, 3}", "mesh/distortion=0.3", "stages/push/duration=0.2", "output/field steps=1")
        self.runs(deck, over, *(word for pair in settings for word in ("--set", pair)))
        steps, meshes, kinds = self.compare_with_h5("ball")
        self.assertGreaterEqual(steps, 3)
        self.assertGreaterEqual(meshes, 2)
        self.assertEqual(kinds, {24})

    def test_every_cell(self):
        plane = os.path.join(ROOT, "inputs", "consolidation", "terzaghi.xml")
        space = os.path.join(ROOT, "inputs", "space", "terzaghi.xml")
        for cell, number in {"quad9": 35, "quad4": 5, "tri3": 4, "hex27": 50, "hex8": 9, "wedge15": 40, "wedge18": 41,
                             "wedge6": 8, "tet4": 6}.items():
            in_space = cell not in ("quad9", "quad4", "tri3")
            cells = "{1, 1, 3}" if in_space else "{1, 3}"
            settings = ["mesh/cell=" + cell, "mesh/cells=" + cells, "output/name=" + cell, "output/field steps=1"]
            if cell in ("quad4", "tri3", "hex8", "wedge6", "tet4"):
                settings.append("physics/ground/pressure=equal order")
            words = [word for one in settings for word in ("--set", one)]
            self.runs(space if in_space else plane, "--steps", "1", *words)
            self.assertEqual(self.compare_with_h5(cell), (2, 1, {CELLS[number][1]}))

    def test_result_of_an_earlier_version(self):
        """Its mesh has no cells for VTK: a restart goes on without the file, and says so."""
        deck = [os.path.join(ROOT, "inputs", "consolidation", "terzaghi.xml"), "--set", "mesh/cells={1, 3}"]
        self.runs(*deck, "--steps", "1")
        stem = os.path.join(self.folder, "results", "terzaghi")
        self.assertTrue(os.path.exists(stem + ".vtkhdf"))
        with h5py.File(os.path.join(stem + ".fields", "mesh.h5"), "a") as file:
            for name in ("connectivity", "offsets", "types"):
                del file["mesh"][name]
        done = program(["run", "-q", *deck, "--steps", "2", "--restart", "--accept-changes"], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("warning: results/terzaghi.vtkhdf is left out: results/terzaghi.fields/mesh.h5 is of an earlier version",
                      done.stderr)
        self.assertFalse(os.path.exists(stem + ".vtkhdf"))
        self.assertTrue(os.path.exists(stem + ".xdmf"))

    def test_body_of_an_earlier_run(self):
        """What a run leaves does not stay where another one of the same name has no such body."""
        self.runs(os.path.join(ROOT, "tests", "mpi", "ball_in_clay.xml"), "--steps", "1", "--set", "output/name=same")
        body = os.path.join(self.folder, "results", "same.fields", "ball.vtkhdf")
        self.assertTrue(os.path.exists(body))
        deck = os.path.join(ROOT, "inputs", "consolidation", "terzaghi.xml")
        self.runs(deck, "--overwrite", "--steps", "1", "--set", "output/name=same", "--set", "mesh/cells={1, 3}")
        self.assertFalse(os.path.exists(body))
        self.compare_with_h5("same")


if __name__ == "__main__":
    unittest.main()
