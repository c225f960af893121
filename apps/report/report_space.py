"""The mesh in space as triangles: its outer surface, and sections through it. No drawing here.

Node order of cells: corners, edge middles, face centres, centre (VTK). Quadratic cells are split into straight-sided
ones at their nodes. Cells that lack centres of their quadrilaterals and of themselves get them, as means of nodes, so that
neighbours split the face between them alike; a value there is the mean, too.
"""

import numpy as np

CELLS = {6: 4, 38: 10, 9: 8, 50: 27, 8: 6, 40: 15, 41: 18}  # XDMF cell number: nodes
TETRAHEDRA, WEDGES, HEX8 = (6, 38), (8, 40, 41), 9
LINEAR = (6, 8, 9)
# Corners of the faces, counter-clockwise as seen from outside.
TET_FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
HEX_FACES = [(0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)]
TET_EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
HEX_EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
WEDGE_FACES = [(0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5), (0, 2, 1), (3, 4, 5)]
WEDGE_EDGES = [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)]
WEDGE_QUADRILATERALS = [(6, 13, 9, 12), (7, 14, 10, 13), (8, 12, 11, 14)]  # nodes in the middle of their edges
SHARP = np.cos(np.radians(35.0))  # faces that meet at a larger angle meet at an edge of the model


def faces_of(kind):
    return TET_FACES if kind in TETRAHEDRA else WEDGE_FACES if kind in WEDGES else HEX_FACES


def edges_of(kind):
    return TET_EDGES if kind in TETRAHEDRA else WEDGE_EDGES if kind in WEDGES else HEX_EDGES


def face_centre(kind, face):
    """Local number of the node in the middle of a quadrilateral."""
    return {HEX8: 8, 50: 20, 8: 6, 40: 15, 41: 15}[kind] + face


def cell_centre(kind):
    return {HEX8: 14, 50: 26, 8: 9, 40: 18, 41: 18}[kind]


def face_triangles(kind, face):
    """[(three local nodes, which of its three sides are edges of the cell)] of one face, oriented as the face."""
    corners = faces_of(kind)[face]
    ring = list(zip(corners, corners[1:] + corners[:1]))
    if kind in LINEAR:
        if len(corners) == 3:
            return [(corners, (True, True, True))]
        return [((a, b, face_centre(kind, face)), (True, False, False)) for a, b in ring]
    edges = edges_of(kind)
    first = {38: 4, 50: 8, 40: 6, 41: 6}[kind]
    middle = {pair: first + i for i, edge in enumerate(edges) for pair in (edge, edge[::-1])}
    if len(corners) == 3:
        before = ring[-1:] + ring[:-1]
        triangles = [((a, middle[a, b], middle[c, a]), (True, False, True)) for (c, _), (a, b) in zip(before, ring)]
        return triangles + [(tuple(middle[pair] for pair in ring), (False, False, False))]
    halves = [pair for a, b in ring for pair in ((a, middle[a, b]), (middle[a, b], b))]
    return [((a, b, face_centre(kind, face)), (True, False, False)) for a, b in halves]


def cell_tetrahedra(kind):
    """Local nodes of the straight-sided tetrahedra that cover a cell."""
    if kind == 6:
        return [(0, 1, 2, 3)]
    if kind == 38:  # at the corners, and four around the diagonal 6-8 of the rest
        corners = [(0, 4, 6, 7), (1, 5, 4, 8), (2, 6, 5, 9), (3, 7, 9, 8)]
        return corners + [(6, 8, 4, 5), (6, 8, 5, 9), (6, 8, 9, 7), (6, 8, 7, 4)]
    centre = cell_centre(kind)
    return [nodes + (centre,) for face in range(len(faces_of(kind))) for nodes, _ in face_triangles(kind, face)]


def centres_of(kind):
    """(local nodes of which the centres of quadrilaterals are the mean, those of the cell's centre) that cells lack."""
    if kind == HEX8:
        return HEX_FACES, tuple(range(8))
    if kind == 8:
        return WEDGE_FACES[:3], tuple(range(6))
    if kind in (40, 41):
        return WEDGE_QUADRILATERALS if kind == 40 else [], (12, 13, 14)
    return [], ()


def with_centres(kind, nodes, first):
    """(nodes of cells with the centres that they lack as nodes from `first` on, what those are the means of)."""
    of_faces, of_cell = centres_of(kind)
    means, columns = [], [nodes]
    if of_faces:
        faces = nodes[:, of_faces].reshape(-1, 4)
        _, where, number = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_inverse=True)
        columns.append(first + number.reshape(-1, len(of_faces)))
        means.append(faces[where])
        first += len(where)
    if of_cell:
        columns.append(first + np.arange(len(nodes)))
        means.append(nodes[:, of_cell])
    return np.column_stack(columns), means


class Mesh:
    """The cells of a mesh in space by kind, and the positions of its nodes at the start."""

    def __init__(self, topology, offset, points):
        self.points = points
        kinds = topology[offset]
        self.blocks = []  # (kind, cells, nodes)
        for kind, count in CELLS.items():
            cells = np.flatnonzero(kinds == kind)
            if len(cells):
                self.blocks.append((kind, cells, topology[offset[cells][:, None] + 1 + np.arange(count)]))


class Triangles:
    """Triangles between places: a place is a node, the mean of nodes, or lies on the line between two of these."""

    def __init__(self, means, ends, share, triangles, cells):
        """ends, share: a place is (1 - share) of its first end and share of its second; the ends are numbers of nodes
        and, after the last node, of the rows of `means`, a list of arrays of nodes."""
        self.means, self.ends, self.share = means, ends, share
        self.triangles, self.cells = triangles, cells  # cells: that each triangle belongs to

    def at_places(self, nodal):
        """Values at the places from those at the nodes: scalars or vectors."""
        values = np.concatenate([nodal] + [nodal[nodes].mean(axis=1) for nodes in self.means])
        share = self.share.reshape(-1, *[1] * (nodal.ndim - 1))
        return (1 - share) * values[self.ends[:, 0]] + share * values[self.ends[:, 1]]


def outer_faces(mesh):
    """[(block, cells, local face)] of the faces that belong to one cell only; cells count within the block."""
    owners, keys = [], []
    for b, (kind, _, nodes) in enumerate(mesh.blocks):
        for f, face in enumerate(faces_of(kind)):
            # The three lowest corners tell a face from every other.
            keys.append(np.sort(nodes[:, face], axis=1)[:, :3])
            owners.append(np.column_stack([np.full(len(nodes), b), np.arange(len(nodes)), np.full(len(nodes), f)]))
    keys, owners = np.concatenate(keys), np.concatenate(owners)
    order = np.lexsort(keys.T)
    same = np.zeros(len(keys) + 1, bool)
    same[1:-1] = (keys[order[1:]] == keys[order[:-1]]).all(axis=1)
    owners = owners[order[~same[1:] & ~same[:-1]]]
    return [
        (b, owners[chosen, 1], f)
        for b, (kind, _, _) in enumerate(mesh.blocks)
        for f in range(len(faces_of(kind)))
        if (chosen := (owners[:, 0] == b) & (owners[:, 2] == f)).any()
    ]


def outer_surface(mesh):
    """Triangles of the outer surface, counter-clockwise as seen from outside. `sides` (triangle, 3) tells what lies
    between its nodes 01, 12, 20: 0 nothing, 1 an edge of a cell, 2 an edge of the model."""
    count, means = len(mesh.points), []
    triangles, cells, sides = [], [], []
    for b, chosen, face in outer_faces(mesh):
        kind, ids, nodes = mesh.blocks[b]
        nodes = nodes[chosen]
        nodes, more = with_centres(kind, nodes, count + sum(map(len, means)))
        means += more
        for local, edges in face_triangles(kind, face):
            triangles.append(nodes[:, local])
            cells.append(ids[chosen])
            sides.append(np.tile(edges, (len(nodes), 1)))
    used, triangles = np.unique(np.concatenate(triangles), return_inverse=True)
    ends, share = np.column_stack([used, used]), np.zeros(len(used))
    surface = Triangles(means, ends, share, triangles.reshape(-1, 3), np.concatenate(cells))
    surface.sides = np.concatenate(sides).astype(int)
    surface.sides[sharp_sides(surface.at_places(mesh.points), surface.triangles) & (surface.sides == 1)] = 2
    return surface


def normals(points, triangles):
    """Twice the area times the outward normal."""
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return np.cross(b - a, c - a)


def sharp_sides(points, triangles):
    """(triangle, 3): whether the surface has an edge between the corners 01, 12, 20."""
    normal = normals(points, triangles)
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    pairs = np.sort(triangles[:, [(0, 1), (1, 2), (2, 0)]].reshape(-1, 2), axis=1)
    _, number, uses = np.unique(pairs, axis=0, return_inverse=True, return_counts=True)
    total = np.zeros((len(uses), 3))
    np.add.at(total, number, np.repeat(normal, 3, axis=0))
    # |n1 + n2|^2 = 2 + 2 cos of the angle between them
    sharp = ((total**2).sum(axis=1) < 2 + 2 * SHARP) & (uses == 2)
    return sharp[number].reshape(-1, 3)


class Section(Triangles):
    """The cut of the cells by a plane x = at or y = at of the mesh at the start; it moves with the soil.
    `outline` and `edges` are pairs of places: around it, and between its cells."""

    def __init__(self, mesh, axis, at):
        self.axis, self.at = axis, at
        level = levels(mesh.points[:, axis], at)
        count, means = len(level), []
        tetrahedra, owners = [np.empty((0, 4), int)], [np.empty(0, int)]
        for kind, ids, nodes in mesh.blocks:
            of_cells = level[nodes]
            chosen = (of_cells.max(axis=1) > 0) & (of_cells.min(axis=1) <= 0)
            nodes = nodes[chosen]
            if len(nodes):
                nodes, more = with_centres(kind, nodes, count + sum(map(len, means)))
                means += more
            for local in cell_tetrahedra(kind):
                tetrahedra.append(nodes[:, local])
                owners.append(ids[chosen])
        level = np.concatenate([level] + [level[nodes].mean(axis=1) for nodes in means])
        ends, share, triangles, cells = cut(np.concatenate(tetrahedra), np.concatenate(owners), level)
        super().__init__(means, ends, share, triangles, cells)
        self.outline, self.edges = section_edges(triangles, cells)


def levels(coordinate, at):
    """Signed distance from the plane, exactly 0 where only rounding differs; positive on the side where the mesh is."""
    level = coordinate - at
    level[np.abs(level) < 1e-9 * max(np.ptp(coordinate), 1e-300)] = 0.0
    return level if (level > 0).any() else -level


def cut(tetrahedra, owners, level):
    """(ends, share, triangles, owners) of the section level = 0. Cells that only touch it count where they lie above."""
    above = level[tetrahedra] > 0
    number = above.sum(axis=1)
    order = np.argsort(above, axis=1, kind="stable")  # first the corners that are not above
    tetrahedra = np.take_along_axis(tetrahedra, order, axis=1)
    corners, cells = [], []
    for how_many, polygon in (
        (1, [((3, 0), (3, 1), (3, 2))]),
        (2, [((2, 0), (2, 1), (3, 1)), ((2, 0), (3, 1), (3, 0))]),
        (3, [((1, 0), (2, 0), (3, 0))]),
    ):
        chosen = number == how_many
        for triangle in polygon:
            corners.append(tetrahedra[chosen][:, triangle])
            cells.append(owners[chosen])
    corners, cells = np.concatenate(corners), np.concatenate(cells)
    upper, lower = level[corners[..., 0]], level[corners[..., 1]]
    share = upper / (upper - lower)
    corners[..., 0] = np.where(lower == 0, corners[..., 1], corners[..., 0])  # a node in the plane is one place
    ends, first, places = np.unique(corners.reshape(-1, 2), axis=0, return_index=True, return_inverse=True)
    triangles = places.reshape(-1, 3)
    whole = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
    return ends, share.reshape(-1)[first], triangles[whole], cells[whole]


def section_edges(triangles, cells):
    """(outline, edges between cells) as pairs of places."""
    pairs = np.sort(triangles[:, [(0, 1), (1, 2), (2, 0)]].reshape(-1, 2), axis=1)
    pairs, number, uses = np.unique(pairs, axis=0, return_inverse=True, return_counts=True)
    low, high = np.full(len(pairs), np.iinfo(int).max), np.full(len(pairs), -1)
    np.minimum.at(low, number, np.repeat(cells, 3))
    np.maximum.at(high, number, np.repeat(cells, 3))
    return pairs[uses == 1], pairs[(uses > 1) & (low != high)]
