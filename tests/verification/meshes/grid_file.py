"""Boxes of quadrilaterals or hexahedra as files of Gmsh's format 2.2, and the shapes of cells without centres (serendipity)."""
import itertools

import numpy as np

# Reference places in Gmsh's order of nodes; the first 8 of the plane and the first 20 of space are those of incomplete cells.
QUAD = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1), (0, -1), (1, 0), (0, 1), (-1, 0), (0, 0)])
HEX_CORNERS = [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)]
HEX_EDGES = [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)]
HEX_FACES = [(0, 0, -1), (0, -1, 0), (-1, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
HEX = np.array(HEX_CORNERS + [tuple(np.add(HEX_CORNERS[a], HEX_CORNERS[b]) // 2) for a, b in HEX_EDGES] + HEX_FACES + [(0, 0, 0)])
REFERENCE = {8: QUAD[:8], 9: QUAD, 20: HEX[:20], 27: HEX}
TYPE = {8: 16, 9: 10, 20: 17, 27: 12}  # Gmsh's numbers
SIDES = ("left", "right", "bottom", "top")
SIDES_IN_SPACE = ("left", "right", "front", "back", "bottom", "top")


def serendipity(nodes, xi):
    """Values and slopes (node, dimension) of the shapes of a cell of 8 or 20 nodes at a reference place."""
    places = REFERENCE[nodes].astype(float)
    dim = places.shape[1]

    def value(at):
        factors = np.where(places == 0, 1 - at ** 2, 1 + places * at)
        product = factors.prod(axis=1)
        corner = (places != 0).all(axis=1)
        return np.where(corner, product * (places @ at - (dim - 1)) / 2 ** dim, product / 2 ** (dim - 1))

    xi = np.asarray(xi, dtype=float)
    step = 0.5  # cubic along each direction at most: two central differences give the slope but for rounding
    slopes = []
    for d in range(dim):
        e = step * np.eye(dim)[d]
        slopes.append((8 * (value(xi + e) - value(xi - e)) - (value(xi + 2 * e) - value(xi - 2 * e))) / (12 * step))
    return value(xi), np.array(slopes).T


class Grid:
    """The unit box (or one with other upper corners) of equal cells with so many nodes each. `move` takes places (node,
    dimension) to others: of the corners only, the others stay midway between them, or with `curved` of all."""

    def __init__(self, nodes_of_cell, cells, upper=None, move=None, curved=False):
        self.nodes_of_cell, self.cells_along = nodes_of_cell, np.array(cells)
        self.dim = len(cells)
        self.upper = np.array(upper or [1.0] * self.dim)
        reference = REFERENCE[nodes_of_cell]
        numbers, self.cells, places = {}, [], []
        move = move or (lambda x: x)

        def place(halves):
            return np.array(halves) / (2.0 * self.cells_along) * self.upper

        for first in itertools.product(*(range(0, 2 * n, 2) for n in cells)):
            corners = move(np.array([place(np.add(first, r + 1)) for r in reference[:2 ** self.dim]]))
            cell = []
            for r in reference:
                key = tuple(np.add(first, r + 1))
                if key not in numbers:
                    numbers[key] = len(places)
                    weights = ((1 + reference[:2 ** self.dim] * r) / 2.0).prod(axis=1)
                    places.append(move(place(key)[None])[0] if curved else weights @ corners)
                cell.append(numbers[key])
            self.cells.append(cell)
        self.nodes, self.halves = np.array(places), np.array(list(numbers))

    def side(self, name):
        """Cells of dimension one less on a side, in Gmsh's order of nodes."""
        names = SIDES if self.dim == 2 else SIDES_IN_SPACE
        axis, high = divmod(names.index(name), 2)
        wanted = 2 * self.cells_along[axis] if high else 0
        reference = REFERENCE[self.nodes_of_cell]
        local = [a for a in range(self.nodes_of_cell) if reference[a][axis] == (1 if high else -1)]
        rest = [d for d in range(self.dim) if d != axis]
        pattern = [(-1,), (1,), (0,)] if self.dim == 2 else QUAD[:9 if self.nodes_of_cell == 27 else 8].tolist()
        in_order = [next(a for a in local if tuple(reference[a][rest]) == tuple(p)) for p in pattern]
        return [[cell[a] for a in in_order] for cell in self.cells if all(self.halves[cell[a]][axis] == wanted for a in local)]

    def write(self, path, shared_tag=False, more_groups=()):
        """With the region "soil" and its sides. shared_tag: all elements have the elementary tag 1. more_groups: (name, sides),
        whose elements are listed once more."""
        names = SIDES if self.dim == 2 else SIDES_IN_SPACE
        groups = [(name, [name]) for name in names] + list(more_groups)
        lines = []
        for tag, (_, sides) in enumerate(groups, start=1):
            for side in sides:
                entity = 1 if shared_tag else 1 + names.index(side)
                cells = self.side(side)
                kind = 8 if self.dim == 2 else TYPE[len(cells[0])]
                lines += [(kind, tag, entity, cell) for cell in cells]
        lines += [(TYPE[self.nodes_of_cell], len(groups) + 1, 1, cell) for cell in self.cells]
        with open(path, "w") as file:
            file.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(groups) + 1}\n")
            for tag, (name, _) in enumerate(groups, start=1):
                file.write(f'{self.dim - 1} {tag} "{name}"\n')
            file.write(f'{self.dim} {len(groups) + 1} "soil"\n$EndPhysicalNames\n$Nodes\n{len(self.nodes)}\n')
            for k, x in enumerate(self.nodes):
                file.write(f"{k + 1} " + " ".join(repr(float(v)) for v in [*x, 0.0][:3]) + "\n")
            file.write(f"$EndNodes\n$Elements\n{len(lines)}\n")
            for k, (kind, tag, entity, cell) in enumerate(lines):
                file.write(f"{k + 1} {kind} 2 {tag} {entity} {' '.join(str(n + 1) for n in cell)}\n")
            file.write("$EndElements\n")
        return path

    def volume(self):
        """Of incomplete cells with serendipity shapes [m2 or m3]: the sum of the Jacobian, exact to degree 7."""
        points, weights = np.polynomial.legendre.leggauss(4)
        total = 0.0
        for which in itertools.product(range(4), repeat=self.dim):
            slopes = serendipity(self.nodes_of_cell, points[list(which)])[1]
            jacobians = np.einsum("eai,aj->eij", self.nodes[np.array(self.cells)], slopes)
            total += weights[list(which)].prod() * np.linalg.det(jacobians).sum()
        return total
