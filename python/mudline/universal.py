"""Meshes of universal files of I-DEAS (.unv), as Salome, Gmsh, NX and others write them.

Read are the datasets 2411 (nodes), 2412 (elements), 2435, 2452, 2467 and 2477 (groups) and 164 (units); others are
skipped. Groups of the elements that fill the mesh become regions. Groups of the faces between them, in the plane of
lines, become side sets; groups of nodes as in ForeignMesh. Source: the published formats of the datasets.
"""

import re

from mudline.foreign_mesh import ForeignMesh, lines_of

# Kinds of elements by the file's number: dimension and nodes. First rods and beams, which have a line of their own in
# front of the nodes, and a mass; then solids; then plane stress, plane strain, axisymmetric solids, thin shells.
KINDS = {11: (1, 2), 21: (1, 2), 22: (1, 2), 24: (1, 3), 161: (0, 1),
         111: (3, 4), 118: (3, 10), 112: (3, 6), 113: (3, 15), 115: (3, 8), 116: (3, 20)}
for tens in (40, 50, 80, 90):
    KINDS.update({tens + 1: (2, 3), tens + 2: (2, 6), tens + 4: (2, 4), tens + 5: (2, 8)})
BEAMS = (11, 21, 22, 24)
# The file's order of a cell's nodes goes around its edges, corner and middle in turn: places of the corners, then of the
# middles of the edges as in Cell
ORDER = {
    (1, 2): [0, 1], (1, 3): [0, 2, 1], (2, 6): [0, 2, 4, 1, 3, 5], (2, 8): [0, 2, 4, 6, 1, 3, 5, 7],
    (3, 10): [0, 2, 4, 9, 1, 3, 5, 6, 7, 8],
    (3, 15): [0, 2, 4, 9, 11, 13, 1, 3, 5, 10, 12, 14, 6, 7, 8],
    (3, 20): [0, 2, 4, 6, 12, 14, 16, 18, 1, 3, 5, 7, 13, 15, 17, 19, 8, 9, 10, 11],
}
NODES, ELEMENTS, UNITS, GROUPS = "2411", "2412", "164", ("2435", "2452", "2467", "2477")
NODE, ELEMENT = 7, 8  # what a group lists


class Dataset:
    """The lines of a dataset, which are taken one after the other; `line`: number of the last one taken."""

    def __init__(self, mesh, lines, first):
        self.mesh, self.lines, self.first, self.line = mesh, lines, first, first - 1

    def __bool__(self):
        return self.line - self.first + 1 < len(self.lines)

    def take(self, what):
        if not self:
            self.mesh.fail(self.line, f"the dataset ends within {what}")
        self.line += 1
        return self.lines[self.line - self.first]

    def whole(self, count, what):
        """So many whole numbers of one line, or more."""
        words = self.take(what).split()
        if len(words) < count:
            self.mesh.fail(self.line, f"{what} has {len(words)} numbers; expected {count}")
        return [self.mesh.whole(word, self.line) for word in words]

    def list(self, count, what):
        """So many whole numbers, over as many lines as they take."""
        numbers = []
        while len(numbers) < count:
            numbers += self.whole(1, what)
        if len(numbers) > count:
            self.mesh.fail(self.line, f"{what} has {len(numbers)} numbers; expected {count}")
        return numbers


class UnvMesh(ForeignMesh):
    """The mesh of a universal file."""

    def __init__(self, path):
        super().__init__(path)
        self.region_hint = "a group of elements gives it one"
        self.length = 1.0  # units of the file in a metre
        self.lower = {}  # {element: nodes} of the sides and points
        self.groups = []  # (name, numbers of nodes, numbers of elements, line)
        read = {NODES: self._nodes, ELEMENTS: self._elements, UNITS: self._units}
        read.update({one: self._groups for one in GROUPS})
        found = self._datasets()
        for number, reader in read.items():  # the nodes first, wherever they stand
            for own, dataset in found:
                if own == number:
                    reader(dataset)
        self._keep_cells()
        self._sort_groups()
        self.nodes = {node: tuple(x / self.length for x in place) for node, place in self.nodes.items()}
        self.finish()

    def _datasets(self):
        """[(number, Dataset)]"""
        lines, found, start = lines_of(self.path), [], None
        for k, line in enumerate(lines):
            if line.strip() == "-1":
                if start is not None:
                    number = lines[start + 1].split()[:1] if start + 1 < k else []
                    found.append((number[0] if number else "", Dataset(self, lines[start + 2:k], start + 3)))
                start = k if start is None else None
            elif start is None and line.strip():
                self.fail(k + 1, "no universal file: a dataset begins with a line '-1', and ends with one")
        if start is not None:
            self.fail(len(lines), f"the file is cut off: the dataset of line {start + 1} does not end with a line '-1'")
        return found

    def _number(self, text, line):
        try:
            return float(re.sub("[dD]", "e", text))
        except ValueError:
            return self.fail(line, f"'{text}' is no number")

    def _units(self, dataset):
        dataset.take("the units")
        self.length = self._number((dataset.take("the units").split() or [""])[0], dataset.line)
        if not self.length > 0:
            self.fail(dataset.line, "the factor of lengths is not positive")

    def _nodes(self, dataset):
        while dataset:
            node = dataset.whole(1, "a node")[0]
            words = dataset.take(f"node {node}").split()
            if len(words) != 3:
                self.fail(dataset.line, f"node {node} has {len(words)} coordinates; expected 3")
            self.add_node(node, tuple(self._number(word, dataset.line) for word in words), dataset.line)

    def _elements(self, dataset):
        while dataset:
            head = dataset.whole(6, "the head of an element")
            element, kind, count = head[0], head[1], head[5]
            line = dataset.line
            if kind not in KINDS:
                self.fail(line, f"element {element} is of the kind {kind}, which is not read; allowed are solids (111 to "
                          "118), plane, axisymmetric and shell elements (41 to 55, 81 to 95), beams and rods")
            dimension, size = KINDS[kind]
            if count != size:
                self.fail(line, f"element {element} of the kind {kind} has {count} nodes; expected {size}")
            if kind in BEAMS:
                dataset.take(f"element {element}")
            nodes = dataset.list(size, f"element {element}")
            order = ORDER.get((dimension, size), range(size))
            self.add_element(element, dimension, [nodes[place] for place in order], line)

    def _groups(self, dataset):
        while dataset:
            count = dataset.whole(8, "the head of a group")[7]
            line = dataset.line + 1
            name = dataset.take("a group").strip()
            if not name:
                self.fail(line, "a group has no name")
            numbers = dataset.list(4 * count, f"group '{name}'")
            entries = list(zip(numbers[0::4], numbers[1::4]))
            self.groups.append((name, [tag for kind, tag in entries if kind == NODE],
                                [tag for kind, tag in entries if kind == ELEMENT], line))

    def _keep_cells(self):
        """Elements of the highest dimension are cells; the others are sides, or nothing."""
        highest = self.dimension = max((dimension for dimension, _, _ in self.elements.values()), default=0)
        if not self.elements:
            self.fail(1, "there are no elements (dataset 2412)")
        if highest < 2:
            self.fail(1, "there are no cells: elements in the plane or in space")
        self.lower = {element: own for element, own in self.elements.items() if own[0] < highest}
        self.elements = {element: own for element, own in self.elements.items() if own[0] == highest}
        for element, (dimension, nodes, line) in self.elements.items():
            if dimension == 2 and any(self.nodes[node][2] != 0 for node in nodes):
                self.fail(line, f"element {element} does not lie in the plane z = 0, and there are no elements in space")

    def _sort_groups(self):
        for name, nodes, elements, line in self.groups:
            for node in nodes:
                if node not in self.nodes:
                    self.fail(line, f"the group '{name}' names node {node}, which there is not")
            for element in elements:
                if element not in self.elements and element not in self.lower:
                    self.fail(line, f"the group '{name}' names element {element}, which there is not")
            cells = [element for element in elements if element in self.elements]
            sides = [self.lower[element][1] for element in elements
                     if element in self.lower and self.lower[element][0] == self.dimension - 1]
            if sum(map(bool, (nodes, cells, sides))) > 1:
                self.fail(line, f"the group '{name}' mixes nodes, cells and sides; make a group of each")
            if cells:
                self.region_names.append(name)
                self.element_sets[name] = cells
            elif sides:
                self.sides[name] = sides
            elif nodes:
                self.node_sets[name] = nodes
