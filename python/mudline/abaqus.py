"""Meshes of Abaqus input files (.inp).

Read are nodes, elements, sets of both, element surfaces and solid sections, in a flat file or in one part with one instance.
The element set of a solid section becomes a region; without sections, the set that stands at the elements.
"""

from mudline.errors import MudlineError
from mudline.foreign_mesh import CELLS, ForeignMesh, lines_of

FAMILIES = {"CPE": 2, "CPS": 2, "CAX": 2, "DC2D": 2, "C3D": 3, "DC3D": 3}


class Lines:
    """The blocks of an input file: a keyword with its options, and its lines of data. Comments and empty lines are left out."""

    def __init__(self, path):
        self.path = path
        lines = lines_of(path)
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


class InpMesh(ForeignMesh):
    """The mesh of an input file."""

    def __init__(self, path):
        super().__init__(path)
        self.region_hint = "a *SOLID SECTION, or an ELSET at *ELEMENT, gives it one"
        self.own_sets = []  # those that stand at elements
        self.instances = 0
        for keyword, options, line, data in Lines(path).blocks:
            read = getattr(self, "_" + keyword.replace(" ", "_").replace("-", "_"), None)
            if keyword in ("node", "element", "nset", "elset", "surface", "solid section", "instance", "part", "include"):
                read(options, line, data)
        self.region_names = self.region_names or self.own_sets
        self.finish()

    def _part(self, options, line, data):
        pass

    def _include(self, options, line, data):
        self.fail(line, f"*INCLUDE of '{options.get('input', '')}' is not followed: put its content here")

    def _instance(self, options, line, data):
        self.instances += 1
        if self.instances > 1:
            self.fail(line, "several instances of parts; one is read: write the assembly as a flat file")
        if any(float(item or 0) != 0 for _, items in data for item in items):
            self.fail(line, "an instance that is moved or turned is not read: write the assembly as a flat file")

    def _node(self, options, line, data):
        names = options.get("nset", "").lower()
        for number, items in data:
            try:
                place = tuple(float(item or 0) for item in items[1:4])
            except ValueError:
                self.fail(number, f"'{', '.join(items)}' is no node: expected its number and two or three coordinates")
            if len(place) < 2:
                self.fail(number, f"'{', '.join(items)}' is no node: expected its number and two or three coordinates")
            node = self.whole(items[0], number)
            self.add_node(node, place, number)
            if names:
                self.node_sets.setdefault(names, []).append(node)

    def _element(self, options, line, data):
        kind = options.get("type", "").upper()
        family = next((FAMILIES[name] for name in sorted(FAMILIES, key=len, reverse=True) if kind.startswith(name)), None)
        if family is None:
            self.fail(line, f"elements of type '{kind}' are not read; allowed are solid ones: CPE, CPS, CAX and C3D")
        name = options.get("elset", "").lower()
        if name and name not in self.own_sets:
            self.own_sets.append(name)
        numbers = []  # an element may go on in further lines
        size = 0
        for number, items in data:
            numbers += [self.whole(item, number) for item in items if item]
            if not size:
                size = self._nodes_of(kind, line)
            if len(numbers) < size + 1:
                continue
            if len(numbers) > size + 1:
                self.fail(number, f"element {numbers[0]} of type {kind} has {len(numbers) - 1} nodes; expected {size}")
            element, *nodes = numbers
            numbers = []
            self.add_element(element, family, nodes, number)
            if name:
                self.element_sets.setdefault(name, []).append(element)
        if numbers:
            self.fail(data[-1][0], f"element {numbers[0]} of type {kind} has {len(numbers) - 1} nodes; expected {size}")

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
            self.fail(line, f"elements of type '{kind}' are not read: there are no cells of {size} nodes")
        return size

    def _members(self, options, data, known):
        """Numbers of a set: listed, by other sets, or generated."""
        members = []
        for number, items in data:
            if "generate" in options:
                first, last, *step = (self.whole(item, number) for item in items if item)
                members += range(first, last + 1, step[0] if step else 1)
                continue
            for item in items:
                if item.lstrip("-").isdigit():
                    members.append(int(item))
                elif item.lower() in known:
                    members += known[item.lower()]
                elif item:
                    self.fail(number, f"there is no set '{item}'")
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
                self.fail(number, f"'{', '.join(items)}' names no face such as S1")
            if name in self.element_sets:
                elements = self.element_sets[name]
            elif name.isdigit():
                elements = [int(name)]
            else:
                self.fail(number, f"there is no element set '{items[0]}'")
            sides += [(element, int(face) - 1, number) for element in elements]

    def _solid_section(self, options, line, data):
        name = options.get("elset", "").lower()
        self.region_names.append(name)
        self.region_lines[name] = line
