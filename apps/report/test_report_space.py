"""Tests of the report of results in space: outer faces, sections, the perspective picture, the page."""

import itertools
import os
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
os.environ.setdefault("MPLCONFIGDIR", tempfile.gettempdir())
sys.path.insert(0, str(Path(__file__).resolve().parent))

import h5py  # noqa: E402
import numpy as np  # noqa: E402

import report_pictures  # noqa: E402
import report_space  # noqa: E402
import report_space_bodies  # noqa: E402
import report_space_pictures  # noqa: E402
import report_view  # noqa: E402
import test_report  # noqa: E402
from report_result import FieldResult  # noqa: E402

# Nodes of hex27 in the order of VTK, in half sides of the cell; those of hex8 are the first eight.
HEX27 = "000 200 220 020 002 202 222 022 100 210 120 010 102 212 122 012 001 201 221 021 011 211 101 121 110 112 111"
SIZE = np.array([2.0, 3.0, 1.0])
CELLS = np.array([2, 3, 2])


def box_in_space(kind, size=SIZE):
    """(topology, offset, points) of the box from 0 to size in CELLS, tetrahedra six to a cell, wedges two; inner nodes are shifted."""
    hexahedron = np.array([[int(c) for c in place] for place in HEX27.split()])
    if kind in (6, 38):
        shapes = []
        for way in itertools.permutations(np.eye(3, dtype=int) * 2):
            corners = np.cumsum([np.zeros(3, int), *way], axis=0)
            if np.linalg.det(corners[1:] - corners[0]) < 0:
                corners = corners[[0, 2, 1, 3]]
            middles = [(corners[a] + corners[b]) // 2 for a, b in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))]
            shapes.append(np.vstack([corners, middles])[: 4 if kind == 6 else 10])
    elif kind in (8, 40, 41):
        shapes = []
        for triangle in (((0, 0), (2, 0), (2, 2)), ((0, 0), (2, 2), (0, 2))):
            corners = np.array([(*place, z) for z in (0, 2) for place in triangle])
            of_edges = [(corners[a] + corners[b]) // 2 for a, b in report_space.WEDGE_EDGES]
            of_faces = [corners[list(face)].sum(axis=0) // 4 for face in report_space.WEDGE_FACES[:3]]
            shapes.append(np.vstack([corners, of_edges, of_faces])[: report_space.CELLS[kind]])
    else:
        shapes = [hexahedron[:8] if kind == 9 else hexahedron]
    cells = np.array(
        [2 * np.array(ijk) + shape for ijk in itertools.product(*map(range, CELLS)) for shape in shapes]
    )  # (cell, node, 3) in half sides
    places, nodes = np.unique(cells.reshape(-1, 3), axis=0, return_inverse=True)
    points = places / (2 * CELLS) * size
    inner = ((places > 0) & (places < 2 * CELLS)).all(axis=1)
    points[inner] += 0.04 * size * np.random.default_rng(1).uniform(-1, 1, (inner.sum(), 3))
    nodes = nodes.reshape(cells.shape[:2])
    topology = np.column_stack([np.full(len(nodes), kind), nodes])
    return topology.ravel(), np.arange(len(nodes)) * topology.shape[1], points


def write_space_result(path, kind, peak, size=SIZE):
    """Two outputs: at rest, and pressed down around the place `peak`."""
    topology, offset, points = box_in_space(kind, size)
    with h5py.File(path, "w") as file:
        file.attrs.update({"format": "mudline fields", "geometry": "three-dimensional"})
        file.attrs.update({"nodes": len(points), "elements": len(offset)})
        file["metadata/deck"] = np.bytes_("<ParameterList>\n</ParameterList>")
        file["mesh/topology"], file["mesh/offset"], file["mesh/coordinates"] = topology, offset, points
        file["mesh/region names"] = np.bytes_("clay")
        down = np.exp(-np.linalg.norm(points - peak, axis=1))
        for k, stage in enumerate(("start", "load")):
            step = file.create_group(f"steps/{k:06d}")
            step.attrs.update({"step": k, "stage": stage, "time": 2.0 * k})
            moved = k * down[:, None] * [0.0, 1e-3, -0.02]
            step["coordinates"] = points + moved
            for link, name, unit, values in [
                ("nodal/displacement", "displacement", "m", moved),
                ("nodal/pore_pressure", "pore pressure", "Pa", 1e4 * (1 - points[:, 2])),
                ("cell/void_ratio", "void ratio", "-", 0.8 + 1e-3 * np.arange(len(offset))),
            ]:
                step[link] = values
                step[link].attrs.update({"name": name, "unit": unit})


def sphere(radius, middle, rings=24):
    """(points, triangles) with poles up and down, counter-clockwise as seen from outside."""
    around = 2 * rings
    along, about = np.meshgrid(np.pi * np.arange(1, rings) / rings, np.pi * np.arange(around) / rings, indexing="ij")
    belt = np.stack([np.sin(along) * np.cos(about), np.sin(along) * np.sin(about), np.cos(along)], axis=-1)
    points = np.vstack([belt.reshape(-1, 3), [[0, 0, 1], [0, 0, -1]]])
    triangles = []
    for j, k in zip(range(around), np.roll(range(around), -1)):
        triangles.append((len(points) - 2, j, k))
        for i in range(0, len(belt.reshape(-1, 3)) - around, around):
            triangles += [(i + j, i + around + j, i + around + k), (i + j, i + around + k, i + k)]
        triangles.append((len(points) - 1, len(points) - 2 - around + k, len(points) - 2 - around + j))
    return radius * points + middle, np.array(triangles)


def block(low, high):
    """(points, triangles) of a box."""
    points = np.array(list(itertools.product(*zip(low, high))), float)
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return points, np.array([triangle for a, b, c, d in faces for triangle in ((a, b, c), (a, c, d))])


def together(*bodies):
    """One surface of several."""
    firsts = np.cumsum([0] + [len(points) for points, _ in bodies])
    return np.vstack([points for points, _ in bodies]), np.vstack([t + i for (_, t), i in zip(bodies, firsts)])


def volume(corners):
    """By the divergence theorem, of a closed surface."""
    return np.linalg.det(corners).sum() / 6


def add_bodies(path, bodies):
    """bodies: {name: (points, triangles)}; they go down by 0.1 m in the second output."""
    with h5py.File(path, "r+") as file:
        for name, (points, triangles) in bodies.items():
            file[f"bodies/{name}/surface"], file[f"bodies/{name}/triangles"] = points, triangles
            file[f"bodies/{name}"].attrs["name"] = name
            for k in range(2):
                file[f"steps/{k:06d}/bodies/{name}/coordinates"] = points - [0, 0, 0.1 * k]


def linear(points):
    return 3 + points @ [2.0, -1.0, 4.0]


def areas(points, triangles):
    return 0.5 * np.linalg.norm(report_space.normals(points, triangles), axis=1)


class SpaceTest(unittest.TestCase):
    setUp, tearDown = test_report.ReportTest.setUp, test_report.ReportTest.tearDown
    run_report = test_report.ReportTest.run_report

    def test_outer_faces_of_a_box(self):
        quadrilaterals = 2 * (CELLS[0] * CELLS[1] + CELLS[1] * CELLS[2] + CELLS[2] * CELLS[0])
        for kind, faces, pieces in ((6, 2, 1), (38, 2, 4), (9, 1, 4), (50, 1, 8)):
            mesh = report_space.Mesh(*box_in_space(kind))
            self.assertEqual(sum(len(cells) for _, cells, _ in report_space.outer_faces(mesh)), faces * quadrilaterals)
            self.check_surface(mesh, faces * pieces * quadrilaterals)

    def test_outer_faces_of_wedges(self):
        upright, level = 2 * (CELLS[0] + CELLS[1]) * CELLS[2], 2 * 2 * CELLS[0] * CELLS[1]
        for kind, of_quadrilateral, of_triangle in ((8, 4, 1), (40, 8, 4), (41, 8, 4)):
            mesh = report_space.Mesh(*box_in_space(kind))
            self.assertEqual(sum(len(cells) for _, cells, _ in report_space.outer_faces(mesh)), upright + level)
            self.check_surface(mesh, of_quadrilateral * upright + of_triangle * level)

    def check_surface(self, mesh, triangles):
        surface = report_space.outer_surface(mesh)
        self.assertEqual(len(surface.triangles), triangles)
        points = surface.at_places(mesh.points)
        area = 2 * (SIZE[0] * SIZE[1] + SIZE[1] * SIZE[2] + SIZE[2] * SIZE[0])
        self.assertAlmostEqual(areas(points, surface.triangles).sum(), area)
        # by the divergence theorem: right only if every triangle is turned outwards
        corners = points[surface.triangles]
        self.assertAlmostEqual(np.linalg.det(corners).sum() / 6, SIZE.prod())
        lengths = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
        self.assertAlmostEqual(lengths[surface.sides == 2].sum(), 2 * 4 * SIZE.sum())  # each seen by two triangles

    def test_cells_are_filled_by_their_tetrahedra(self):
        for kind in (6, 38, 9, 50, 8, 40, 41):
            mesh = report_space.Mesh(*box_in_space(kind))
            nodes, points = mesh.blocks[0][2], mesh.points
            nodes, means = report_space.with_centres(kind, nodes, len(points))
            if means:
                points = np.concatenate([points] + [points[group].mean(axis=1) for group in means])
            corners = points[nodes[:, report_space.cell_tetrahedra(kind)]].reshape(-1, 4, 3)
            volumes = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
            self.assertAlmostEqual(np.abs(volumes).sum(), SIZE.prod())

    def test_section_through_a_linear_field_is_exact(self):
        for kind, axis, at in itertools.product((6, 38, 9, 50, 8, 40, 41), (0, 1), (0.0, 0.37, 0.5, 1.0)):
            mesh = report_space.Mesh(*box_in_space(kind))
            at *= SIZE[axis]  # sides, a plane through cells, and those between cells
            section = report_space.Section(mesh, axis, at)
            places = section.at_places(mesh.points)
            np.testing.assert_allclose(places[:, axis], at, atol=1e-12)
            np.testing.assert_allclose(section.at_places(linear(mesh.points)), linear(places), atol=1e-12)
            self.assertAlmostEqual(areas(places, section.triangles).sum(), SIZE[1 - axis] * SIZE[2])
            ends = places[section.outline]
            self.assertAlmostEqual(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum(), 2 * (SIZE[1 - axis] + SIZE[2]))
            self.assertGreaterEqual(len(np.unique(section.cells)), CELLS[1 - axis] * CELLS[2])

    def test_section_takes_the_values_of_the_cells_that_it_cuts(self):
        topology, offset, points = box_in_space(9)
        mesh = report_space.Mesh(topology, offset, points)
        section = report_space.Section(mesh, 1, 0.5)  # through the middle of the first row of cells
        first_row = [cell for cell in range(len(offset)) if points[topology[offset[cell] + 1], 1] < 0.5]
        self.assertEqual(sorted(set(section.cells)), first_row)

    def test_section_moves_with_the_soil(self):
        mesh = report_space.Mesh(*box_in_space(38))
        section = report_space.Section(mesh, 0, 0.6)
        moved = section.at_places(mesh.points * [1.0, 1.0, 0.9] + [0.1, 0.0, 0.0])
        np.testing.assert_allclose(moved[:, 0], 0.7)
        np.testing.assert_allclose([moved[:, 2].min(), moved[:, 2].max()], [0.0, 0.9], atol=1e-12)

    def look(self, points, triangles):
        view = report_view.View([0, 0, 0], SIZE, (-1.0, -1.5))
        projected = view.project(points)
        low, high = projected[:, :2].min(axis=0), projected[:, :2].max(axis=0)
        window = [low[0], high[0], low[1], high[1]]
        return view, window, report_view.Buffer(projected, triangles, window, 160, 120)

    def test_pixels_show_the_places_that_lie_behind_them(self):
        mesh = report_space.Mesh(*box_in_space(6))
        surface = report_space.outer_surface(mesh)
        points = surface.at_places(mesh.points)
        view, window, buffer = self.look(points, surface.triangles)
        seen = np.column_stack([buffer.values(column[surface.triangles]) for column in points.T])
        back = view.project(seen)
        x = window[0] + (buffer.pixel % 320 + 0.5) / 320 * (window[1] - window[0])
        y = window[3] - (buffer.pixel // 320 + 0.5) / 240 * (window[3] - window[2])
        np.testing.assert_allclose(back[:, :2], np.column_stack([x, y]), atol=2e-5)
        # of a box the eye sees three sides, whole: none of the other three, and the picture's area is that of these
        self.assertTrue(((seen[:, 0] < 1e-5) | (seen[:, 1] < 1e-5) | (seen[:, 2] > 1 - 1e-5)).all())
        corners = view.project(points)[surface.triangles][:, :, :2]
        picture = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 2
        pixel = (window[1] - window[0]) * (window[3] - window[2]) / (320 * 240)
        self.assertAlmostEqual(len(buffer.pixel) * pixel / picture[picture > 0].sum(), 1.0, delta=0.002)

    def test_what_lies_behind_is_hidden(self):
        surface = report_space.outer_surface(report_space.Mesh(*box_in_space(9)))
        points = surface.at_places(box_in_space(9)[2])
        count, triangles = len(points), surface.triangles
        behind = SIZE / 2 + 0.2 * (points - SIZE / 2) - 3.0 * report_view.View([0, 0, 0], SIZE, (-1.0, -1.5)).eye
        for order in ([triangles, triangles + count], [triangles + count, triangles]):
            _, _, buffer = self.look(np.vstack([points, behind]), np.vstack(order))
            seen = np.vstack(order)[buffer.triangle]
            self.assertTrue((seen < count).all())

    def test_sections_and_view_go_where_the_soil_moves(self):
        for i, (peak, places, signs) in enumerate(
            [
                ((0, 0, 1), (0.0, 0.0), (-1, -1)),
                ((1, 1.5, 1), (1.5, 1.0), (-1, -1)),
                ((2, 0, 1), (0.0, 2.0), (1, -1)),
                ((1, 3, 1), (3.0, 1.0), (-1, 1)),
            ]
        ):
            path = self.folder / f"box{i}.h5"
            write_space_result(path, 50, peak)
            model = report_space_pictures.SpaceModel(FieldResult(path), 1)
            self.assertEqual(tuple(section.at for section in model.sections), places)
            self.assertEqual(tuple(np.sign(model.towards)), signs)

    def test_section_of_a_slice_across_it_is_left_out(self):
        write_space_result(self.folder / "box.h5", 9, (0, 0, 1), np.array([2.0, 0.15, 1.0]))
        sections = report_space_pictures.SpaceModel(FieldResult(self.folder / "box.h5"), 1).sections
        self.assertEqual([(section.axis, section.at) for section in sections], [(1, 0.0)])

    def test_page_of_a_result_in_space(self):
        write_space_result(self.folder / "box.h5", 9, (0, 0, 1))
        code, _, err = self.run_report(self.folder / "box.h5", "--png", self.folder / "png")
        self.assertEqual((code, err), (0, ""))
        page = (self.folder / "box_report.html").read_text()
        self.assertIn("three-dimensional", page)
        self.assertIn("<p>t = 0 s, start: 0 m everywhere.</p>", page)
        written = {path.name for path in (self.folder / "png").iterdir()}
        expected = {f"{name}_load.png" for name in ("displacement", "displacement_z", "pore_pressure", "void_ratio")}
        self.assertEqual(written, expected | {"pore_pressure_start.png", "void_ratio_start.png"})

    def test_picture_has_both_sections_and_readable_units(self):
        for kind in (6, 9, 38, 50, 40):
            write_space_result(self.folder / f"box{kind}.h5", kind, (0, 0, 1))
            self.check_picture(FieldResult(self.folder / f"box{kind}.h5"))

    def check_picture(self, result):
        fields = result.fields(1)
        self.assertAlmostEqual(fields["displacement z"].values.min(), -0.02)
        model = report_space_pictures.SpaceModel(result, 1)
        figure = report_space_pictures.SpacePicture(result, 1, model).figure(fields["displacement z"])
        surface, first, second, bar = figure.axes
        titles = [axes.get_title("left") for axes in (first, second)]
        self.assertEqual(titles, ["section at y = 0 m", "section at x = 0 m"])
        self.assertEqual((first.get_xlabel(), second.get_xlabel()), ("x [m]", "y [m]"))
        self.assertEqual(bar.get_ylabel(), "displacement z [mm]")
        np.testing.assert_allclose(bar.get_ylim(), [-20, fields["displacement z"].values.max() * 1e3])
        np.testing.assert_allclose(first.get_xlim(), [0, 2], atol=1e-9)
        np.testing.assert_allclose(second.get_xlim(), [0, 3], atol=2e-3)
        report_pictures.plt.close(figure)

    def test_body_cut_off_at_a_box_is_closed_and_has_its_volume(self):
        far = np.array([-9.0, -9.0, -9.0]), np.array([9.0, 9.0, 9.0])
        ball = sphere(1.0, [0, 0, 0])
        whole = volume(ball[0][ball[1]])
        self.assertAlmostEqual(whole, 4 / 3 * np.pi, delta=0.05)
        unit = block([0, 0, 0], [1, 1, 1])
        holed = together(unit, (lambda points, triangles: (points, triangles[:, ::-1]))(*block([0.3] * 3, [0.6] * 3)))
        turned = unit[0] @ np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0], unit[1]
        turned_volume = volume(turned[0][turned[1]])
        for body, low, high, expected in [
            (ball, *far, whole),
            (ball, [0, -9, -9], far[1], whole / 2),  # through its points
            (ball, [0, 0, -9], far[1], whole / 4),
            (ball, far[0], [9, 0, 9], whole / 2),
            (ball, far[0], [0, 0, 0], whole / 8),
            (ball, [-0.3, -0.5, -0.2], [0.4, 0.3, 0.6], 0.7 * 0.8 * 0.8),  # inside: the box itself
            (ball, [2, 2, 2], far[1], 0.0),
            (unit, [0, 0, 0], [1, 1, 1], 1.0),  # all faces in those of the box
            (unit, [0, 0.25, -9], [1, 9, 0.5], 0.375),
            (unit, [-1, 0, -9], [0, 1, 9], 0.0),  # beside it
            (holed, [0.5, -9, -9], far[1], 0.5 - 0.1 * 0.3 * 0.3),
            (holed, far[0], [9, 9, 0.4], 0.4 - 0.1 * 0.3 * 0.3),
            (turned, [-0.2, -0.3, -0.1], far[1], None),
        ]:
            low, high = np.array(low, float), np.array(high, float)
            corners, sides = report_space_bodies.clipped(*body, low, high)
            self.assertEqual(corners.shape[:2], sides.shape)
            self.assertTrue((corners >= low - 1e-9).all() and (corners <= high + 1e-9).all())
            # of a closed surface the areas times the normals add up to nothing
            total = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).sum(axis=0)
            np.testing.assert_allclose(total, 0, atol=1e-12)
            if expected is not None:
                self.assertAlmostEqual(volume(corners), expected, places=12)
            else:
                self.assertTrue(0 < abs(volume(corners)) < abs(turned_volume))

    def test_overlapping_bodies_are_one_in_a_cut(self):
        cross = together(block([0, 0, 0], [3, 1, 1]), block([1, -1, 0], [2, 2, 1]))
        for axis, at, area in ((2, 0.5, 5.0), (0, 1.5, 3.0), (1, 0.5, 3.0)):
            for inwards in (-1, 1):
                corners, sides = report_space_bodies.cut_face(*cross, (axis, at, inwards), 4.0)
                total = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).sum(axis=0) / 2
                np.testing.assert_allclose(total, -inwards * area * np.eye(3)[axis], atol=1e-12)
        # strong lines around it: 12 long, less those across the strips
        corners, sides = report_space_bodies.cut_face(*cross, (2, 0.5, -1), 4.0)
        lengths = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
        self.assertAlmostEqual(lengths[sides == 2].sum(), 6.0)

    def test_edges_of_a_cut_body_are_strong(self):
        box = np.array([[-1, -1, -1], [2, 2, 0.5]])
        corners, sides = report_space_bodies.clipped(*block([0, 0, 0], [1, 1, 1]), *box)
        lengths = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
        # each edge is one of two faces; of the cut face two lie along its strips
        self.assertAlmostEqual(lengths[sides == 2].sum(), 2 * (4 * 0.5 + 4) + 4 + 2)
        corners, sides = report_space_bodies.clipped(*sphere(1.0, [0, 0, 0]), *np.array([[-2, -2, -2], [2, 2, 2]]))
        self.assertFalse(sides.any())

    def test_section_loops_run_around_the_body_and_against_it_around_holes(self):
        def area(loop):
            x, y = loop[:, 0], loop[:, 1]
            return (x[:-1] * y[1:] - x[1:] * y[:-1]).sum() / 2

        holed = together(
            block([0, 0, 0], [1, 2, 1]),
            (lambda points, triangles: (points, triangles[:, ::-1]))(*block([0.3] * 3, [0.6] * 3)),
        )
        for inwards in (1, -1):
            loops = report_space_bodies.section_loops(*holed, (2, 0.5, inwards), 2.0)
            self.assertEqual(sorted(round(abs(area(loop)), 12) for loop in loops), [0.09, 2.0])
            self.assertAlmostEqual(abs(sum(map(area, loops))), 1.91)
            for loop in loops:
                np.testing.assert_array_equal(loop[0], loop[-1])
                np.testing.assert_allclose(loop[:, 2], 0.5)
        (loop,) = report_space_bodies.section_loops(*sphere(1.0, [0, 0, 0]), (1, 0.0, 1), 2.0)  # through points
        self.assertEqual(len(loop), 49)
        np.testing.assert_allclose(np.linalg.norm(loop, axis=1), 1.0)
        # a face in the plane: its outline if the body is on the inner side
        for at, inwards, count in ((0.0, 1, 1), (0.0, -1, 0), (1.0, -1, 1), (1.0, 1, 0)):
            loops = report_space_bodies.section_loops(*block([0, 0, 0], [1, 1, 1]), (0, at, inwards), 1.0)
            self.assertEqual([round(abs(area(loop[:, 1:])), 12) for loop in loops], [1.0] * count)

    def picture_with(self, bodies, peak=(0, 0, 1)):
        path = self.folder / f"{len(list(self.folder.iterdir()))}.h5"
        write_space_result(path, 50, peak)
        add_bodies(path, bodies)
        result = FieldResult(path)
        return result, report_space_pictures.SpacePicture(result, 1, report_space_pictures.SpaceModel(result, 1))

    def seen(self, picture):
        """(pixel, 3) places, and whether they are on a body."""
        points, triangles, _, part = picture.with_bodies()
        buffer = picture.buffer
        places = np.column_stack([buffer.values(column[triangles]) for column in points.T])
        return places, part[buffer.triangle] > 1

    def test_body_is_seen_where_no_soil_is_in_front_of_it(self):
        result, picture = self.picture_with({"ball": sphere(0.4, [1.0, 1.5, 1.1]), "buried": sphere(0.2, [1, 1, 0.4])})
        places, on_body = self.seen(picture)
        self.assertGreater(on_body.sum(), 1000)
        self.assertGreater(places[on_body, 2].min(), 0.97)  # what is in the soil is hidden
        radius = np.linalg.norm(places[on_body] - [1.0, 1.5, 1.0], axis=1)
        np.testing.assert_allclose(radius, 0.4, atol=0.004)
        inside = (np.linalg.norm(places[:, :2] - [1.0, 1.5], axis=1) < 0.2) & (places[:, 2] > 0.9)
        self.assertTrue(on_body[inside].all())  # and it hides the soil below it
        # the body is grey in every field, the soil is not
        figure = picture.figure(result.fields(1)["pore pressure"])
        image = picture.buffer.image(np.repeat(on_body[:, None], 3, axis=1).astype(float))
        drawn = np.array(figure.axes[0].images[0].get_array()).astype(float)
        grey, soil = (drawn[(image[..., 3] == 255) & (image[..., 0] == value)] for value in (255, 0))
        self.assertLess(np.median(np.ptp(grey[:, :3], axis=1)), 15)
        self.assertGreater(np.median(np.ptp(soil[:, :3], axis=1)), 50)
        report_pictures.plt.close(figure)

    def test_body_in_a_plane_of_symmetry_is_cut_there(self):
        _, picture = self.picture_with({"ball": sphere(0.4, [0.0, 0.0, 1.1])})
        places, on_body = self.seen(picture)
        self.assertGreaterEqual(places[on_body, :2].min(), -1e-4)
        flat = on_body & (places[:, :2].min(axis=1) < 1e-4)
        # its cut faces are before the soil's sides, which go on behind them
        self.assertLess(places[flat, 2].min(), 0.65)
        self.assertGreater(flat.sum(), 0.5 * on_body.sum())

    def test_sections_go_through_the_body_and_show_it(self):
        result, picture = self.picture_with({"block": block([1.3, 0.4, 0.8], [1.7, 1.4, 1.3])}, peak=(1.5, 0.9, 1))
        np.testing.assert_allclose([panel.section.at for panel in picture.panels], [0.9, 1.5])
        for panel, low, high in zip(picture.panels, ([1.3, 0.7], [0.4, 0.7]), ([1.7, 1.2], [1.4, 1.2])):
            (loop,) = panel.loops
            np.testing.assert_allclose([loop.min(axis=0), loop.max(axis=0)], [low, high])
        figure = picture.figure(result.fields(1)["void ratio"])
        for axes, (y, z) in zip(figure.axes[1:3], (((0, 2), (0, 1.26)), ((0, 3), (0, 1.26)))):
            np.testing.assert_allclose([axes.get_xlim(), axes.get_ylim()], [y, z], atol=1e-2)
            filled = [patch for patch in axes.patches if patch.get_path() is not None]
            self.assertEqual(len(filled), 2)  # outline and area
        report_pictures.plt.close(figure)

    def test_section_stays_with_the_body_where_the_soil_moves_as_much_elsewhere(self):
        for low, places in ((0.2, [1.0, 0.6]), (-1.0, [0.0, 0.0])):  # beside the flat sides, and across them
            _, picture = self.picture_with({"block": block([low, low, 0.8], [1.0, 1.8, 1.3])}, peak=(0, 0, 300))
            np.testing.assert_allclose([panel.section.at for panel in picture.panels], places)

    def test_body_that_goes_on_for_ever_ends_above_the_soil(self):
        for top, expected in ((50.0, 1.0 + 0.25 * 3), (1.9, 1.8 + 0.02 * 3)):
            _, picture = self.picture_with({"pile": block([0.5, 1.0, 0.5], [0.7, 1.2, top])}, peak=(0.6, 1.1, 1))
            places, on_body = self.seen(picture)
            self.assertAlmostEqual(places[on_body, 2].max(), min(expected, top - 0.1), delta=2e-3)
            self.assertAlmostEqual(picture.panels[0].high[1], expected, delta=2e-3)

    def test_page_with_a_body(self):
        write_space_result(self.folder / "box.h5", 9, (0, 0, 1))
        add_bodies(self.folder / "box.h5", {"ball": sphere(0.4, [1.0, 1.5, 1.1])})
        code, _, err = self.run_report(self.folder / "box.h5", "--fields", "void ratio")
        self.assertEqual((code, err), (0, ""))
        self.assertIn("<td>ball</td>", (self.folder / "box_report.html").read_text())

    def test_zoom_is_refused(self):
        write_space_result(self.folder / "box.h5", 6, (0, 0, 1))
        code, _, err = self.run_report(self.folder / "box.h5", "--zoom", "0,1,0,1")
        self.assertEqual((code, err), (2, "mudline report: --zoom: there is no second panel for a result in space\n"))


if __name__ == "__main__":
    unittest.main()
