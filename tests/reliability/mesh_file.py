"""A small mesh as files of Gmsh hold it, to spoil: names, nodes and elements, written in two versions of the format."""

import itertools

SIZE = 4  # cells in each direction
LINE, TRI, QUAD = 8, 9, 10  # Gmsh's second-order elements

CURVES = {"bottom": 1, "right": 2, "top": 3, "left": 4}
SURFACES = {"clay": 1, "sand": 2}


class Mesh:
    """The unit square, clay below sand, with names and elements as a file of Gmsh holds them."""

    def __init__(self, shape):
        self.nodes, self.elements = {}, []
        self.names = [(1, tag, name) for name, tag in CURVES.items()] + [(2, tag, name) for name, tag in SURFACES.items()]
        n = 2 * SIZE
        for j, i in itertools.product(range(n + 1), range(n + 1)):
            self.nodes[self.tag(i, j)] = [i / n, j / n, 0.0]
        for k in range(0, n, 2):
            self.line("bottom", (k, 0), (k + 2, 0))
            self.line("right", (n, k), (n, k + 2))
            self.line("top", (n - k, n), (n - k - 2, n))
            self.line("left", (0, n - k), (0, n - k - 2))
        for j, i in itertools.product(range(0, n, 2), range(0, n, 2)):
            a, b, c, d = (i, j), (i + 2, j), (i + 2, j + 2), (i, j + 2)
            region = SURFACES["clay" if j < SIZE else "sand"]
            if shape == QUAD:
                corners = [a, b, c, d]
                middles = [self.between(corners[k], corners[(k + 1) % 4]) for k in range(4)]
                self.elements.append([QUAD, region, [self.tag(*x) for x in corners + middles + [(i + 1, j + 1)]]])
            else:
                for corners in ([a, b, c], [a, c, d]):
                    middles = [self.between(corners[k], corners[(k + 1) % 3]) for k in range(3)]
                    self.elements.append([TRI, region, [self.tag(*x) for x in corners + middles]])

    @staticmethod
    def tag(i, j):
        return 1 + i + j * (2 * SIZE + 1)

    @staticmethod
    def between(a, b):
        return ((a[0] + b[0]) // 2, (a[1] + b[1]) // 2)

    def line(self, name, a, b):
        self.elements.append([LINE, CURVES[name], [self.tag(*x) for x in (a, b, self.between(a, b))]])

    def cells(self):
        return [e for e in self.elements if e[0] != LINE]

    def inner_cells(self):
        """Elements with no corner on the boundary."""
        return [e for e in self.cells() if all(0 < x < 1 for c in self.corners(e) for x in self.nodes[c][:2])]

    @staticmethod
    def corners(element):
        return element[2][: {LINE: 2, TRI: 3, QUAD: 4}[element[0]]]

    def copy_nodes(self, elements, keep=()):
        """Gives elements nodes of their own, at the same places."""
        new = {}
        for element in elements:
            for k, tag in enumerate(element[2]):
                if tag in keep:
                    continue
                if tag not in new:
                    new[tag] = max(self.nodes) + 1
                    self.nodes[new[tag]] = list(self.nodes[tag])
                element[2][k] = new[tag]

    def names_text(self):
        return ["$PhysicalNames", str(len(self.names)), *(f'{d} {t} "{n}"' for d, t, n in self.names), "$EndPhysicalNames"]

    @staticmethod
    def numbers(values):
        return " ".join(x if isinstance(x, str) else repr(x) for x in values)

    def version_2(self):
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", *self.names_text(), "$Nodes", str(len(self.nodes))]
        lines += [f"{tag} {self.numbers(x)}" for tag, x in self.nodes.items()]
        lines += ["$EndNodes", "$Elements", str(len(self.elements))]
        for k, (kind, tag, nodes) in enumerate(self.elements):
            lines.append(f"{k + 1} {kind} 2 {tag} {tag} {self.numbers(nodes)}")
        return "\n".join(lines + ["$EndElements", ""])

    def version_4(self):
        groups = {}
        for kind, tag, nodes in self.elements:
            groups.setdefault((1 if kind == LINE else 2, tag, kind), []).append(nodes)
        curves, surfaces = (sorted({tag for d, tag, _ in groups if d == dim}) for dim in (1, 2))
        lines = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", *self.names_text(), "$Entities", f"0 {len(curves)} {len(surfaces)} 0"]
        lines += [f"{tag} 0 0 0 1 1 0 1 {tag} 0" for tag in curves + surfaces]
        tags = list(self.nodes)
        home = f"2 {surfaces[0]}" if surfaces else f"1 {curves[0]}"
        lines += ["$EndEntities", "$Nodes", f"1 {len(tags)} {min(tags)} {max(tags)}", f"{home} 0 {len(tags)}"]
        lines += [str(tag) for tag in tags] + [self.numbers(x) for x in self.nodes.values()]
        lines += ["$EndNodes", "$Elements", f"{len(groups)} {len(self.elements)} 1 {len(self.elements)}"]
        number = itertools.count(1)
        for (dimension, tag, kind), group in groups.items():
            lines.append(f"{dimension} {tag} {kind} {len(group)}")
            lines += [f"{next(number)} {self.numbers(nodes)}" for nodes in group]
        return "\n".join(lines + ["$EndElements", ""])
