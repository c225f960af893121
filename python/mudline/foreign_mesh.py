"""Meshes of other programs, as the readers of their files hand them on: written as MSH 2.2, which the mesh source `gmsh`
reads.

A surface becomes a side set, and so does a node set that holds all nodes of a side of the boundary, else it becomes a set
of nodes.
"""

from pathlib import Path

from mudline.errors import MudlineError

# Cells by their number of nodes and dimension: number in MSH, places in the file's order of the nodes that MSH wants, and
# their sides as corners and middles of edges, in Abaqus' order of the faces.
TRI = [(0, 1), (1, 2), (2, 0)]
QUAD = [(0, 1), (1, 2), (2, 3), (3, 0)]
TET_EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
TET_FACES = [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]
HEX_EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
HEX_FACES = [(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)]
WEDGE_EDGES = [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)]
WEDGE_FACES = [(0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)]
MSH_TET_EDGES = [(0, 1), (1, 2), (2, 0), (3, 0), (2, 3), (1, 3)]
MSH_HEX_EDGES = [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)]
MSH_WEDGE_EDGES = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 4), (2, 5), (3, 4), (3, 5), (4, 5)]


class Cell:
    """A kind of cell."""

    def __init__(self, number, corners, edges, faces, msh_edges=None):
        self.number, self.corners, self.edges, self.faces = number, corners, edges, faces
        wanted = edges if msh_edges is None else msh_edges
        self.order = list(range(corners)) + [corners + self._edge(edge) for edge in wanted[:len(edges)]]

    def _edge(self, edge):
        return next(k for k, own in enumerate(self.edges) if set(own) == set(edge))

    def side(self, face):
        """Places of the nodes of a side: corners, then the middles of its edges."""
        corners = self.faces[face]
        if not self.edges:
            return list(corners)
        pairs = [corners] if len(corners) == 2 else list(zip(corners, corners[1:] + corners[:1]))
        return list(corners) + [self.corners + self._edge(pair) for pair in pairs]


CELLS = {
    (2, 3): Cell(2, 3, [], TRI), (2, 4): Cell(3, 4, [], QUAD), (2, 6): Cell(9, 3, TRI, TRI), (2, 8): Cell(16, 4, QUAD, QUAD),
    (3, 4): Cell(4, 4, [], TET_FACES), (3, 10): Cell(11, 4, TET_EDGES, TET_FACES, MSH_TET_EDGES),
    (3, 8): Cell(5, 8, [], HEX_FACES), (3, 20): Cell(17, 8, HEX_EDGES, HEX_FACES, MSH_HEX_EDGES),
    (3, 6): Cell(6, 6, [], WEDGE_FACES), (3, 15): Cell(18, 6, WEDGE_EDGES, WEDGE_FACES, MSH_WEDGE_EDGES),
}
SIDES = {(2, 2): 1, (2, 3): 8, (3, 3): 2, (3, 4): 3, (3, 6): 9, (3, 8): 16}  # (dimension, nodes): number in MSH
POINT = 15


def lines_of(path):
    """The lines of a text file, without their ends. MudlineError where it cannot be read."""
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            return file.read().splitlines()
    except OSError as error:
        raise MudlineError(f"{path}: cannot be read: {error.strerror}") from None


class ForeignMesh:
    """A mesh as it stands in a file of another program. A reader fills it in."""

    def __init__(self, path):
        self.path = path
        self.nodes = {}  # {number: place (x, y) or (x, y, z) [the file's unit]}
        self.elements = {}  # {number: (dimension, nodes, line of the file)}
        self.node_sets, self.element_sets = {}, {}  # {name: numbers}
        self.surfaces = {}  # {name: [(element, face from 0 on, line)]}
        self.sides = {}  # {name: sides as nodes}, which the file lists themselves
        self.region_names = []  # element sets that are regions; none: all elements are "soil"
        self.region_lines = {}  # {name: line that calls it a region}
        self.region_hint = "an element set gives it one"

    def fail(self, line, message):
        raise MudlineError(f"{self.path}:{line}: {message}")

    def whole(self, text, line):
        try:
            return int(text)
        except ValueError:
            return self.fail(line, f"'{text}' is no whole number")

    def finish(self):
        """What the whole mesh must be. To be called when everything is read."""
        if not self.nodes or not self.elements:
            self.fail(1, "there are no nodes" if not self.nodes else "there are no elements")
        self.dimension = next(iter(self.elements.values()))[0]
        for element, (dimension, _, line) in self.elements.items():
            if dimension != self.dimension:
                self.fail(line, f"element {element} is of another dimension than the first one")
        self.used = {node for _, nodes, _ in self.elements.values() for node in nodes}

    def add_node(self, node, place, line):
        if node in self.nodes:
            self.fail(line, f"node {node} is given twice")
        self.nodes[node] = place

    def add_element(self, element, dimension, nodes, line):
        missing = [node for node in nodes if node not in self.nodes]
        if missing:
            self.fail(line, f"element {element} names node {missing[0]}, which there is not")
        if element in self.elements:
            self.fail(line, f"element {element} is given twice")
        self.elements[element] = (dimension, nodes, line)

    def cell(self, element):
        dimension, nodes, _ = self.elements[element]
        return CELLS[dimension, len(nodes)]

    def regions(self):
        """{name: elements}, each element in one. MudlineError where an element has none, or two."""
        if not self.region_names:
            return {"soil": list(self.elements)}
        of = {}
        for name in self.region_names:
            if name not in self.element_sets:
                self.fail(self.region_lines.get(name, 1), f"there is no element set '{name}'")
            for element in self.element_sets[name]:
                if of.setdefault(element, name) != name:
                    self.fail(1, f"element {element} is in the regions '{of[element]}' and '{name}'; allowed is one")
        without = [element for element in self.elements if element not in of]
        if without:
            self.fail(1, f"element {without[0]} is in no region; {self.region_hint}")
        result = {name: [] for name in self.region_names}
        for element, name in of.items():
            result[name].append(element)
        return result

    def boundary(self):
        """{corners of a side: its nodes}, of the sides that one element has."""
        found = {}
        for element, (_, nodes, _) in self.elements.items():
            cell = self.cell(element)
            for face in range(len(cell.faces)):
                side = [nodes[place] for place in cell.side(face)]
                found.setdefault(frozenset(side), []).append(side)
        return {corners: sides[0] for corners, sides in found.items() if len(sides) == 1}

    def side_sets(self):
        """({name: sides as nodes}, {name: nodes}): of sides, surfaces and node sets."""
        sides, points = dict(self.sides), {}
        for name, faces in self.surfaces.items():
            sides[name] = []
            for element, face, line in faces:
                if element not in self.elements:
                    self.fail(line, f"there is no element {element}")
                cell = self.cell(element)
                if not 0 <= face < len(cell.faces):
                    self.fail(line, f"element {element} has no face {face + 1}")
                sides[name].append([self.elements[element][1][place] for place in cell.side(face)])
        outside = self.boundary()
        for name, nodes in self.node_sets.items():
            if name in sides:
                continue
            members = set(nodes)
            within = [side for side in outside.values() if members.issuperset(side)]
            if within:
                sides[name] = within
            else:
                points[name] = sorted(members & self.used)
        return sides, points


def write_msh(mesh, target, scale=1.0):
    """Writes a ForeignMesh as MSH 2.2. scale: factor of all coordinates [m]. Returns {"region": names, "side set": names,
    "node set": names}. MudlineError with file and line."""
    regions, (sides, points) = mesh.regions(), mesh.side_sets()
    groups = [(mesh.dimension, name) for name in regions] + [(mesh.dimension - 1, name) for name in sides] + [(0, name) for name in points]
    tags = {group: k + 1 for k, group in enumerate(groups)}
    elements = []
    for name, members in regions.items():
        for element in members:
            cell, nodes = mesh.cell(element), mesh.elements[element][1]
            elements.append((cell.number, tags[mesh.dimension, name], [nodes[place] for place in cell.order]))
    for name, members in sides.items():
        elements += [(SIDES[mesh.dimension, len(side)], tags[mesh.dimension - 1, name], side) for side in members]
    for name, members in points.items():
        elements += [(POINT, tags[0, name], [node]) for node in members]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(groups))]
    lines += [f'{dimension} {tags[dimension, name]} "{name}"' for dimension, name in groups]
    lines += ["$EndPhysicalNames", "$Nodes", str(len(mesh.used))]
    for node in sorted(mesh.used):  # others, such as reference points, belong to no cell
        lines.append(f"{node} " + " ".join(repr(scale * x) for x in (*mesh.nodes[node], 0.0)[:3]))
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    for number, (kind, tag, nodes) in enumerate(elements):
        lines.append(f"{number + 1} {kind} 2 {tag} {tag} " + " ".join(map(str, nodes)))
    lines.append("$EndElements")
    Path(target).write_text("\n".join(lines) + "\n", encoding="utf-8")
    return {"region": list(regions), "side set": list(sides), "node set": list(points)}
