"""What the tests in space share: meshes written as Gmsh does, decks as dictionaries, fields with norms over tetrahedra,
wedges and hexahedra."""
import os

import h5py
import numpy as np

from mudline_case import ROOT, History, MudlineCase, deck_text

SIDES = ("left", "right", "front", "back", "bottom", "top")
SHAPES = {6: "tet4", 38: "tet10", 9: "hex8", 50: "hex27", 8: "wedge6", 40: "wedge15", 41: "wedge18"}  # XDMF's codes
CORNERS = {"tet": 4, "hex": 8, "wedge": 6}
TET_EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
HEX = np.array([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2),  # as VTK numbers them
                (1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2),
                (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1), (0, 1, 1), (2, 1, 1), (1, 0, 1), (1, 2, 1), (1, 1, 0), (1, 1, 2), (1, 1, 1)])
WEDGE_EDGES = ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5))
WEDGE_FACES = ((0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5), (0, 2, 1), (3, 4, 5))
# what Gmsh has at each place of its own numbering
GMSH_TYPE = {"tet4": 4, "tet10": 11, "hex8": 5, "hex27": 12, "wedge6": 6, "wedge15": 18, "wedge18": 13}
GMSH_SIDE = {3: 2, 6: 9, 4: 3, 8: 16, 9: 10}  # by the number of nodes
GMSH_WEDGE = [0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10, 15, 17, 16]
GMSH_HEX = [0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14, 24, 22, 20, 21, 23, 25, 26]
GMSH_TET = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]
GMSH_ORDER = {"tet": GMSH_TET, "hex": GMSH_HEX, "wedge": GMSH_WEDGE}


def kind(cell):
    """The shape without its number of nodes."""
    return cell.rstrip("0123456789")


def rotation(axis=(1.0, 2.0, -0.7), angle=0.9):
    """The matrix that turns by an angle [rad] about an axis (Rodrigues)."""
    n = np.array(axis) / np.linalg.norm(axis)
    cross = np.array([[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


class BoxMesh:
    """A box of hexahedra, or of six tetrahedra or two wedges in each, whose nodes may be moved: by `move` the corners, the others stay
    midway (straight sides), or with `curved` all of them."""

    def __init__(self, cell, cells, upper=(1.0, 1.0, 1.0), move=None, curved=False):
        self.cell = cell
        n = np.array(cells)
        grid = np.stack(np.meshgrid(*(np.arange(2 * k + 1) for k in n), indexing="ij"), axis=-1).reshape(-1, 3)
        size = 2 * n + 1

        def number(place):
            return (place[..., 0] * size[1] + place[..., 1]) * size[2] + place[..., 2]

        first = 2 * np.stack(np.meshgrid(*(np.arange(k) for k in n), indexing="ij"), axis=-1).reshape(-1, 3)
        hexes = number(first[:, None, :] + HEX[None])
        nodes = grid / (2.0 * n) * np.array(upper)
        moved = move(nodes) if move else nodes
        if cell.startswith("hex"):
            self.cells, corners = hexes, 8
            around = [np.flatnonzero([all(h == 1 or h == c for h, c in zip(HEX[a], HEX[b])) for b in range(8)]) for a in range(27)]
            faces = [np.flatnonzero(HEX[:, d] == v) for d in range(3) for v in (0, 2)]
        elif kind(cell) == "wedge":
            wedges = []
            for corners in (((0, 0), (2, 0), (2, 2)), ((0, 0), (2, 2), (0, 2))):
                place = np.array([(*xy, z) for z in (0, 2) for xy in corners])
                middles = [(place[a] + place[b]) // 2 for a, b in WEDGE_EDGES] + [place[list(f)].sum(axis=0) // 4 for f in WEDGE_FACES[:3]]
                wedges.append(number(first[:, None, :] + np.vstack([place, middles])[None]))
            self.cells, corners = np.concatenate(wedges), 6
            around = [[a] for a in range(6)] + [list(e) for e in WEDGE_EDGES] + [list(f) for f in WEDGE_FACES[:3]]
        else:
            tets = []
            for path in ((0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)):
                place = np.zeros((4, 3), dtype=int)
                for i, axis in enumerate(path):
                    place[i + 1:, axis] = 2
                if np.linalg.det((place[1:] - place[0]).astype(float)) < 0:
                    place[[1, 2]] = place[[2, 1]]
                middles = [(place[a] + place[b]) // 2 for a, b in TET_EDGES]
                tets.append(number(first[:, None, :] + np.vstack([place, middles])[None]))
            self.cells, corners = np.concatenate(tets), 4
            around = [[a] for a in range(4)] + [list(e) for e in TET_EDGES]
        self.nodes = moved.copy()
        if not curved:
            for a in range(corners, self.cells.shape[1]):
                self.nodes[self.cells[:, a]] = moved[self.cells[:, around[a]]].mean(axis=1)
        self.sides = {}
        for i, name in enumerate(SIDES):
            at = 0 if i % 2 == 0 else size[i // 2] - 1
            on = grid[:, i // 2] == at
            if cell.startswith("hex"):
                wanted = [0, 1, 2, 3, 4, 5, 6, 7, 8]  # corners round, mid-side nodes, centre
                local = {0: [0, 4, 7, 3, 16, 15, 19, 11, 20], 1: [1, 2, 6, 5, 9, 18, 13, 17, 21], 2: [0, 1, 5, 4, 8, 17, 12, 16, 22],
                         3: [3, 7, 6, 2, 19, 14, 18, 10, 23], 4: [0, 3, 2, 1, 11, 10, 9, 8, 24], 5: [4, 5, 6, 7, 12, 13, 14, 15, 25]}[i]
                assert set(local) == set(faces[i])
                chosen = self.cells[on[self.cells[:, local[8]]]][:, local]
                self.sides[name] = chosen[:, wanted]
            elif kind(cell) == "wedge":
                found = []
                for f, face in enumerate(WEDGE_FACES):
                    edge = [6 + next(k for k, e in enumerate(WEDGE_EDGES) if set(e) == set(pair)) for pair in zip(face, face[1:] + face[:1])]
                    centre = [15 + f] if f < 3 and cell == "wedge18" else []
                    local = list(face) + ([] if cell == "wedge6" else edge + centre)
                    chosen = self.cells[on[self.cells[:, list(face)]].all(axis=1)]
                    if len(chosen):
                        found.append(chosen[:, local])
                self.sides[name] = np.concatenate(found)
            else:
                found = []
                for a, b, c in ((0, 1, 3), (1, 2, 3), (2, 0, 3), (0, 2, 1)):
                    edge = [4 + next(k for k, e in enumerate(TET_EDGES) if set(e) == set(pair)) for pair in ((a, b), (b, c), (c, a))]
                    chosen = self.cells[on[self.cells[:, [a, b, c]]].all(axis=1)]
                    found.append(chosen[:, [a, b, c] + edge])
                self.sides[name] = np.concatenate(found)
        if cell in ("tet4", "hex8"):
            self.cells = self.cells[:, :corners]
            self.sides = {k: v[:, :3 if cell == "tet4" else 4] for k, v in self.sides.items()}

        if kind(cell) == "wedge":
            self.cells = self.cells[:, :int(cell[5:])]

    def turned(self, matrix):
        self.nodes = self.nodes @ matrix.T
        return self

    def write(self, path):
        """Gmsh's format 2.2, with the region "soil" and the six sides."""
        return write_boxes(path, {"": self})


def write_boxes(path, boxes):
    """Boxes of one kind of cell that share no nodes, by name, in Gmsh's format 2.2: each one a region (the box without a name is
    "soil") with sides called "name side"."""
    names, nodes, lines, first = [], [], [], 1
    for box_name, box in boxes.items():
        used, index = np.unique(box.cells, return_inverse=True)
        index = index.reshape(box.cells.shape)
        order = GMSH_ORDER[kind(box.cell)][:box.cells.shape[1]]
        for side_name in SIDES:
            names.append((2, f"{box_name} {side_name}".strip()))
            lines += [(GMSH_SIDE[len(side)], len(names), first + side) for side in np.searchsorted(used, box.sides[side_name])]
        names.append((3, box_name or "soil"))
        lines += [(GMSH_TYPE[box.cell], len(names), first + cell[order]) for cell in index]
        nodes += box.nodes[used].tolist()
        first += len(used)
    with open(path, "w") as file:
        file.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(names)}\n" +
                   "".join(f'{d} {i + 1} "{name}"\n' for i, (d, name) in enumerate(names)) + "$EndPhysicalNames\n")
        file.write(f"$Nodes\n{len(nodes)}\n" + "".join(f"{i + 1} {x!r} {y!r} {z!r}\n" for i, (x, y, z) in enumerate(nodes)) +
                   "$EndNodes\n")
        file.write(f"$Elements\n{len(lines)}\n" + "".join(
            f"{k + 1} {kind} 2 {tag} {tag} {' '.join(str(n) for n in cell)}\n" for k, (kind, tag, cell) in enumerate(lines)))
        file.write("$EndElements\n")
    return path


def _shapes(shape, xi):
    """Values and slopes (node, 3) of the shape functions at one place of the reference cell."""
    if shape.startswith("tet"):
        L = np.array([1 - sum(xi), *xi])
        dL = np.array([[-1, -1, -1], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
        if shape == "tet4":
            return L, dL
        pairs = np.array(TET_EDGES)
        return (np.concatenate([L * (2 * L - 1), 4 * L[pairs[:, 0]] * L[pairs[:, 1]]]),
                np.vstack([(4 * L - 1)[:, None] * dL, 4 * (dL[pairs[:, 0]] * L[pairs[:, 1], None] + L[pairs[:, 0], None] * dL[pairs[:, 1]])]))
    if shape.startswith("wedge"):
        return _wedge_shapes(shape, np.array(xi))
    x = np.array(xi)
    if shape == "hex8":
        value, slope, places = np.array([(1 - x) / 2, (1 + x) / 2]), np.array([-0.5 * np.ones(3), 0.5 * np.ones(3)]), HEX[:8] // 2
    else:
        value, slope, places = np.array([x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2]), np.array([x - 0.5, -2 * x, x + 0.5]), HEX
    along = np.array([[value[p[d], d] for d in range(3)] for p in places])
    steep = np.array([[slope[p[d], d] for d in range(3)] for p in places])
    return along.prod(axis=1), np.stack([steep[:, d] * along[:, [e for e in range(3) if e != d]].prod(axis=1) for d in range(3)], axis=1)


def _wedge_shapes(shape, xi):
    """By their conditions: the polynomials x^i y^j z^k that the cell holds are found again from their values at the nodes."""
    corners = np.array([(0, 0, -1), (1, 0, -1), (0, 1, -1), (0, 0, 1), (1, 0, 1), (0, 1, 1)], dtype=float)
    around = [[a] for a in range(6)] + [list(e) for e in WEDGE_EDGES] + [list(f) for f in WEDGE_FACES[:3]]
    nodes = np.array([corners[a].mean(axis=0) for a in around])[:int(shape[5:])]
    plane = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)]
    powers = {"wedge6": [(i, j, k) for i, j in plane[:3] for k in (0, 1)], "wedge18": [(i, j, k) for i, j in plane for k in (0, 1, 2)],
              "wedge15": [(i, j, k) for i, j in plane for k in (0, 1)] + [(i, j, 2) for i, j in plane[:3]]}[shape]

    def terms(x):
        return np.array([x[0] ** i * x[1] ** j * x[2] ** k for i, j, k in powers])

    def slopes(x):
        return np.array([[i * x[0] ** max(i - 1, 0) * x[1] ** j * x[2] ** k, j * x[0] ** i * x[1] ** max(j - 1, 0) * x[2] ** k,
                          k * x[0] ** i * x[1] ** j * x[2] ** max(k - 1, 0)] for i, j, k in powers])

    at_nodes = np.array([terms(node) for node in nodes]).T  # (term, node)
    return np.linalg.solve(at_nodes, terms(xi)), np.linalg.solve(at_nodes, slopes(xi))


def _rule(shape):
    """Gauss points and weights; tetrahedra as collapsed cubes, exact to degree 5, and the triangles of wedges as squares."""
    g, w = np.polynomial.legendre.leggauss(4)
    for i in range(4):
        for j in range(4):
            for k in range(4):
                if shape.startswith("hex"):
                    yield (g[i], g[j], g[k]), w[i] * w[j] * w[k]
                elif shape.startswith("wedge"):
                    a, b = (1 + g[i]) / 2, (1 + g[j]) / 2
                    yield (a, b * (1 - a), g[k]), w[i] * w[j] * w[k] / 4 * (1 - a)
                else:
                    a, b, c = (1 + g[i]) / 2, (1 + g[j]) / 2, (1 + g[k]) / 2
                    yield (a, b * (1 - a), c * (1 - a) * (1 - b)), w[i] * w[j] * w[k] / 8 * (1 - a) ** 2 * (1 - b)


class Fields:
    """Mesh and last fields of a run. `cells` and what integrates over them are for cells of one shape; of several they are those of
    the first."""

    def __init__(self, folder, stem, step=-1):
        with h5py.File(os.path.join(folder, "results", stem + ".h5"), "r") as file:
            topology = file["mesh/topology"][:]
            self.shape = SHAPES[topology[0]]
            rows = np.split(topology, file["mesh/offset"][1:])
            self.cells = np.array([row[1:] for row in rows if row[0] == topology[0]])
            self.nodes = file["mesh/coordinates"][:]
            last = file["steps"][sorted(file["steps"])[step]]
            self.nodal = {name: last["nodal"][name][:] for name in last["nodal"]}
            self.cell = {name: last["cell"][name][:] for name in last["cell"]}
        self.vertices = np.unique(self.cells[:, :CORNERS[kind(self.shape)]])

    def points(self):
        """(places, weights times volume, shape values) of every quadrature point of all cells."""
        for xi, weight in _rule(self.shape):
            value, slope = _shapes(self.shape, xi)
            jacobian = np.einsum("eai,aj->eij", self.nodes[self.cells], slope)
            yield np.einsum("a,eai->ei", value, self.nodes[self.cells]), weight * np.linalg.det(jacobian), value, xi

    def volume(self):
        return sum(weight.sum() for _, weight, _, _ in self.points())

    def integral(self, values):
        return sum((weight * (values[self.cells] @ shape)).sum() for _, weight, shape, _ in self.points())

    def l2_error(self, values, exact, linear=False):
        """Of nodal values (node) or (node, 3) against exact(x, y, z), relative to the norm of the exact ones; `linear`: the
        field lives on the corners."""
        corners = CORNERS[kind(self.shape)]
        off = size = 0.0
        for place, weight, shape, xi in self.points():
            if linear:
                shape = _shapes(f"{kind(self.shape)}{corners}", xi)[0]
            found = np.tensordot(values[self.cells[:, :corners] if linear else self.cells], shape, axes=(1, 0))
            true = np.stack(np.broadcast_arrays(*exact(*place.T)), axis=-1) if values.ndim > 1 else exact(*place.T)
            off += (weight * ((found - true) ** 2).reshape(len(weight), -1).sum(axis=1)).sum()
            size += (weight * (true ** 2).reshape(len(weight), -1).sum(axis=1)).sum()
        return np.sqrt(off / size)


def prescribed(components, sides=SIDES):
    """Conditions that prescribe {x: expression, ...} on sides."""
    return {f"displacement {side}": {"type": "displacement", "set": side, **components} for side in sides}


ELASTIC = {"type": "linear elastic", "Young's modulus": 1e7, "Poisson's ratio": 0.25}
WATER = {"type": "water", "incompressible": True, "unit weight": 1e4}
SATURATED = {"porosity": 0.4, "skeleton": ELASTIC, "fluid": WATER,
             "permeability": {"type": "constant", "hydraulic conductivity": 1e-6}}
SOLID = {"density": 1800.0, "skeleton": ELASTIC}


def quasi_static(duration, step, theta=1.0, start_up=0, **more):
    return {"type": "quasi-static", "duration": float(duration),
            "integrator": {"type": "theta", "theta": theta, "start-up steps": start_up}, "time step": {"initial": float(step), **more}}


def deck(name, mesh, conditions, stages, physics="solid", material=None, more_physics=None, **sections):
    """A deck of one soil; mesh is a section without its geometry, or a file."""
    mesh = {"type": "gmsh", "file": mesh} if isinstance(mesh, str) else mesh
    return deck_text(name, {
        "mesh": {"geometry": "three-dimensional", **mesh},
        "materials": {"soil": material or (SATURATED if physics == "biot" else SOLID)},
        "physics": {"ground": {"type": physics, **(more_physics or {})}},
        "boundary conditions": conditions, "stages": stages, **sections})


class SpaceCase(MudlineCase):
    def input(self, name, topic="space"):
        return os.path.join(ROOT, "inputs", topic, name + ".xml")

    def run_text(self, name, text, settings=(), **options):
        return self.run_deck(self.write(name + ".xml", text), settings, **options)

    def fields(self, stem, step=-1):
        return Fields(self.folder, stem, step)

    def history_of(self, stem):
        return History(os.path.join(self.folder, "results", stem + ".csv"))
