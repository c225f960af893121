"""Meshes of Abaqus input files (.inp), written as MSH 2.2, which the mesh source `gmsh` reads.

Read are nodes, elements, sets of both, element surfaces and solid sections, in a flat file or in one part with one instance.
The element set of a solid section becomes a region; without sections, the set that stands at the elements. A surface becomes a
side set, and so does a node set that holds all nodes of a side of the boundary, else it becomes a set of nodes.
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
FAMILIES = {"CPE": 2, "CPS": 2, "CAX": 2, "DC2D": 2, "C3D": 3, "DC3D": 3}


class Lines:
    """The blocks of an input file: a keyword with its options, and its lines of data. Comments and empty lines are left out."""

    def __init__(self, path):
        self.path = path
        try:
            with open(path, encoding="utf-8", errors="replace") as file:
                lines = file.read().splitlines()
        except OSError as error:
            raise MudlineError(f"{path}: cannot be read: {error.strerror}") from None
        self.blocks = []
        number, count = 0, len(lines)
        while number < count:
            line = lines[number].strip()
            first = number + 1
            number += 1
            if not line or line.startswith("**"):
                continue
            if line.startswith("*"):
                while line.endswith(",") and number < count:  # the options go on in the next line
                    line += lines[number].strip()
                    number += 1
                words = [word.strip() for word in line[1:].split(",")]
                options = {}
                for word in words[1:]:
                    name, _, value = word.partition("=")
                    if name.strip():
                        options[name.strip().lower()] = value.strip().strip('"')
                self.blocks.append((" ".join(words[0].lower().split()), options, first, []))
            elif self.blocks:
                self.blocks[-1][3].append((first, [item.strip() for item in line.rstrip(",").split(",")]))
            else:
                raise MudlineError(f"{path}:{first}: no Abaqus input file: it begins with no keyword such as *NODE")


class InpMesh:
    """The mesh of an input file."""

    def __init__(self, path):
        self.path, self.nodes, self.elements = path, {}, {}
        self.node_sets, self.element_sets, self.surfaces, self.sections = {}, {}, {}, []
        self.own_sets = []  # those that stand at elements
        self.instances = 0
        for keyword, options, line, data in Lines(path).blocks:
            read = getattr(self, "_" + keyword.replace(" ", "_").replace("-", "_"), None)
            if keyword in ("node", "element", "nset", "elset", "surface", "solid section", "instance", "part", "include"):
                read(options, line, data)
        if not self.nodes or not self.elements:
            self._fail(1, "there are no nodes" if not self.nodes else "there are no elements")
        self.dimension = next(iter(self.elements.values()))[0]
        for element, (dimension, _, line) in self.elements.items():
            if dimension != self.dimension:
                self._fail(line, f"element {element} is of another dimension than the first one")
        self.used = {node for _, nodes, _ in self.elements.values() for node in nodes}

    def _fail(self, line, message):
        raise MudlineError(f"{self.path}:{line}: {message}")

    def _whole(self, text, line):
        try:
            return int(text)
        except ValueError:
            return self._fail(line, f"'{text}' is no whole number")

    def _part(self, options, line, data):
        pass

    def _include(self, options, line, data):
        self._fail(line, f"*INCLUDE of '{options.get('input', '')}' is not followed: put its content here")

    def _instance(self, options, line, data):
        self.instances += 1
        if self.instances > 1:
            self._fail(line, "several instances of parts; one is read: write the assembly as a flat file")
        if any(float(item or 0) != 0 for _, items in data for item in items):
            self._fail(line, "an instance that is moved or turned is not read: write the assembly as a flat file")

    def _node(self, options, line, data):
        names = options.get("nset", "").lower()
        for number, items in data:
            try:
                place = tuple(float(item or 0) for item in items[1:4])
            except ValueError:
                self._fail(number, f"'{', '.join(items)}' is no node: expected its number and two or three coordinates")
            if len(place) < 2:
                self._fail(number, f"'{', '.join(items)}' is no node: expected its number and two or three coordinates")
            node = self._whole(items[0], number)
            if node in self.nodes:
                self._fail(number, f"node {node} is given twice")
            self.nodes[node] = place
            if names:
                self.node_sets.setdefault(names, []).append(node)

    def _element(self, options, line, data):
        kind = options.get("type", "").upper()
        family = next((FAMILIES[name] for name in sorted(FAMILIES, key=len, reverse=True) if kind.startswith(name)), None)
        if family is None:
            self._fail(line, f"elements of type '{kind}' are not read; allowed are solid ones: CPE, CPS, CAX and C3D")
        name = options.get("elset", "").lower()
        if name and name not in self.own_sets:
            self.own_sets.append(name)
        numbers = []  # an element may go on in further lines
        size = 0
        for number, items in data:
            numbers += [self._whole(item, number) for item in items if item]
            if not size:
                size = self._nodes_of(kind, line)
            if len(numbers) < size + 1:
                continue
            if len(numbers) > size + 1:
                self._fail(number, f"element {numbers[0]} of type {kind} has {len(numbers) - 1} nodes; expected {size}")
            element, *nodes = numbers
            numbers = []
            missing = [node for node in nodes if node not in self.nodes]
            if missing:
                self._fail(number, f"element {element} names node {missing[0]}, which there is not")
            if element in self.elements:
                self._fail(number, f"element {element} is given twice")
            self.elements[element] = (family, nodes, number)
            if name:
                self.element_sets.setdefault(name, []).append(element)
        if numbers:
            self._fail(data[-1][0], f"element {numbers[0]} of type {kind} has {len(numbers) - 1} nodes; expected {size}")

    def _nodes_of(self, kind, line):
        """CPE8R, CAX8RP, C3D20RH: the number behind the family."""
        family = next(name for name in sorted(FAMILIES, key=len, reverse=True) if kind.startswith(name))
        digits = ""
        for letter in kind[len(family):]:
            if not letter.isdigit():
                break
            digits += letter
        size = int(digits) if digits else 0
        if (FAMILIES[family], size) not in CELLS:
            self._fail(line, f"elements of type '{kind}' are not read: there are no cells of {size} nodes")
        return size

    def _members(self, options, data, known):
        """Numbers of a set: listed, by other sets, or generated."""
        members = []
        for number, items in data:
            if "generate" in options:
                first, last, *step = (self._whole(item, number) for item in items if item)
                members += range(first, last + 1, step[0] if step else 1)
                continue
            for item in items:
                if item.lstrip("-").isdigit():
                    members.append(int(item))
                elif item.lower() in known:
                    members += known[item.lower()]
                elif item:
                    self._fail(number, f"there is no set '{item}'")
        return members

    def _nset(self, options, line, data):
        members = self._members(options, data, self.node_sets)
        if "elset" in options:
            members += [node for element in self.element_sets.get(options["elset"].lower(), []) for node in self.elements[element][1]]
        self.node_sets.setdefault(options.get("nset", "").lower(), []).extend(members)

    def _elset(self, options, line, data):
        self.element_sets.setdefault(options.get("elset", "").lower(), []).extend(self._members(options, data, self.element_sets))

    def _surface(self, options, line, data):
        if options.get("type", "element").lower() != "element":
            return
        sides = self.surfaces.setdefault(options.get("name", "").lower(), [])
        for number, items in data:
            name, face = items[0].lower(), (items + [""])[1].upper().lstrip("SF")
            if not face.isdigit():
                self._fail(number, f"'{', '.join(items)}' names no face such as S1")
            if name in self.element_sets:
                elements = self.element_sets[name]
            elif name.isdigit():
                elements = [int(name)]
            else:
                self._fail(number, f"there is no element set '{items[0]}'")
            sides += [(element, int(face) - 1, number) for element in elements]

    def _solid_section(self, options, line, data):
        self.sections.append((options.get("elset", "").lower(), line))

    def cell(self, element):
        dimension, nodes, _ = self.elements[element]
        return CELLS[dimension, len(nodes)]

    def regions(self):
        """{name: elements}, each element in one. MudlineError where an element has none, or two."""
        names = [name for name, _ in self.sections] or self.own_sets
        if not names:
            return {"soil": list(self.elements)}
        of = {}
        for name in names:
            if name not in self.element_sets:
                self._fail(next((line for own, line in self.sections if own == name), 1), f"there is no element set '{name}'")
            for element in self.element_sets[name]:
                if of.setdefault(element, name) != name:
                    self._fail(1, f"element {element} is in the regions '{of[element]}' and '{name}'; allowed is one")
        without = [element for element in self.elements if element not in of]
        if without:
            self._fail(1, f"element {without[0]} is in no region; a *SOLID SECTION, or an ELSET at *ELEMENT, gives it one")
        result = {name: [] for name in names}
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
        """({name: sides as nodes}, {name: nodes}): of surfaces and of node sets."""
        sides, points = {}, {}
        for name, faces in self.surfaces.items():
            sides[name] = []
            for element, face, line in faces:
                if element not in self.elements:
                    self._fail(line, f"there is no element {element}")
                cell = self.cell(element)
                if not 0 <= face < len(cell.faces):
                    self._fail(line, f"element {element} has no face {face + 1}")
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


def convert(source, target, scale=1.0):
    """Writes the mesh of an Abaqus input file as MSH 2.2. scale: factor of all coordinates, 0.001 for a mesh in millimetres.
    Returns {"region": names, "side set": names, "node set": names}. MudlineError with file and line."""
    mesh = InpMesh(source)
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
