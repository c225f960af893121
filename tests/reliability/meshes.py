"""Meshes that are not as they should be: files of Gmsh in two versions with elements missing, doubled, torn apart, moved or badly numbered, files
that are cut off or garbled, geometries with mistakes."""

import copy
import itertools
import random

import fault
from mesh_file import CURVES, LINE, QUAD, SIZE, SURFACES, TRI, Mesh

TITLE = "meshes"
FULL = 300
SAMPLE = 14

DECK = """<ParameterList name="slope">
  <ParameterList name="mesh">
    <Parameter name="type" type="string" value="gmsh"/>
    <Parameter name="geometry" type="string" value="@geometry@"/>
    <Parameter name="file" type="string" value="@file@"/>
    <Parameter name="order" type="int" value="@order@"/>
    <Parameter name="time limit" type="double" value="20"/>
  </ParameterList>
  <ParameterList name="materials">
    <ParameterList name="soils">
      <Parameter name="regions" type="Array(string)" value="{clay, sand}"/>
      <Parameter name="porosity" type="double" value="0.4"/>
      <Parameter name="grain density" type="double" value="2700"/>
      <ParameterList name="skeleton">
        <Parameter name="type" type="string" value="linear elastic"/>
        <Parameter name="Young's modulus" type="double" value="2e7"/>
        <Parameter name="Poisson's ratio" type="double" value="0.3"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="physics">
    <ParameterList name="ground">
      <Parameter name="type" type="string" value="solid"/>
      <Parameter name="gravity" type="Array(double)" value="{0.0, -9.81}"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="boundary conditions">
    <ParameterList name="base">
      <Parameter name="type" type="string" value="fixed"/>
      <Parameter name="set" type="string" value="bottom"/>
    </ParameterList>
    <ParameterList name="left roller">
      <Parameter name="type" type="string" value="fixed"/>
      <Parameter name="set" type="string" value="left"/>
      <Parameter name="components" type="string" value="x"/>
    </ParameterList>
    <ParameterList name="right load">
      <Parameter name="type" type="string" value="pressure"/>
      <Parameter name="set" type="string" value="right"/>
      <Parameter name="value" type="double" value="3e3"/>
    </ParameterList>
    <ParameterList name="top load">
      <Parameter name="type" type="string" value="pressure"/>
      <Parameter name="set" type="string" value="top"/>
      <Parameter name="value" type="double" value="10e3"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="stages">
    <ParameterList name="rest">
      <Parameter name="type" type="string" value="quasi-static"/>
      <Parameter name="duration" type="double" value="1"/>
      <ParameterList name="time step">
        <Parameter name="initial" type="double" value="1"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="output">
    <ParameterList name="probes">
      <Parameter name="corner" type="Array(double)" value="{1.0, 1.0}"/>
      <Parameter name="middle" type="Array(double)" value="{0.5, 0.5}"/>
    </ParameterList>
  </ParameterList>
</ParameterList>
"""

GEOMETRY = """size = 0.25;
Point(1) = {0, 0, 0, size};
Point(2) = {1, 0, 0, size};
Point(3) = {1, 0.5, 0, size};
Point(4) = {1, 1, 0, size};
Point(5) = {0, 1, 0, size};
Point(6) = {0, 0.5, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {3, 6};
Curve Loop(1) = {1, 2, 7, 6};
Curve Loop(2) = {3, 4, 5, -7};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Physical Surface("clay") = {1};
Physical Surface("sand") = {2};
Physical Curve("bottom") = {1};
Physical Curve("right") = {2, 3};
Physical Curve("top") = {4};
Physical Curve("left") = {5, 6};
"""

# ---- faults of the mesh itself: each changes a Mesh -------------------------------------------------------------------------------


def missing_inside(mesh, rng):
    mesh.elements.remove(rng.choice(mesh.inner_cells()))


def missing_at_the_boundary(mesh, rng):
    mesh.elements.remove(rng.choice([e for e in mesh.cells() if any(mesh.nodes[t][k] in (0, 1) for t in e[2][len(mesh.corners(e)):] for k in (0, 1))]))


def many_missing(mesh, rng):
    for element in rng.sample(mesh.cells(), len(mesh.cells()) // 3):
        mesh.elements.remove(element)


def region_torn_off(mesh, rng):
    region = rng.choice([1, 2])
    cells = [e for e in mesh.cells() if e[1] == region]
    mesh.copy_nodes(cells)
    if rng.random() < 0.5:  # the lines go along
        places = {tuple(mesh.nodes[t]): t for e in cells for t in e[2]}
        for line in mesh.elements:
            if line[0] == LINE and all(tuple(mesh.nodes[t]) in places for t in line[2]):
                line[2] = [places[tuple(mesh.nodes[t])] for t in line[2]]


def crack_inside(mesh, rng):
    """Two neighbouring inner corners' sides get twin nodes above, the ends stay joined."""
    row = 2 * rng.randrange(1, SIZE)
    first = 2 * rng.randrange(0, SIZE - 1)
    y, ends = row / (2 * SIZE), (first / (2 * SIZE), (first + 4) / (2 * SIZE))
    above = [e for e in mesh.cells() if sum(mesh.nodes[c][1] for c in mesh.corners(e)) / len(mesh.corners(e)) > y]
    keep = {t for t, x in mesh.nodes.items() if not (x[1] == y and ends[0] < x[0] < ends[1])}
    mesh.copy_nodes(above, keep)


def element_twice(mesh, rng):
    mesh.elements.append(copy.deepcopy(rng.choice(mesh.cells())))


def element_over_another(mesh, rng):
    double = copy.deepcopy(rng.choice(mesh.cells()))
    mesh.elements.append(double)
    mesh.copy_nodes([double])


def mesh_twice(mesh, rng):
    double = copy.deepcopy(mesh.cells() if rng.random() < 0.5 else mesh.elements)
    mesh.elements += double
    mesh.copy_nodes(double)


def mesh_over_another(mesh, rng):
    double = copy.deepcopy(mesh.cells())
    before = set(mesh.nodes)
    mesh.elements += double
    mesh.copy_nodes(double)
    shift = (rng.uniform(-0.9, 0.9), rng.uniform(-0.9, 0.9))
    for tag in set(mesh.nodes) - before:
        for k in (0, 1):
            mesh.nodes[tag][k] += shift[k]


def hanging_node(mesh, rng):
    """A row of cells gets half as many neighbours: pairs of cells of the top row become one."""
    kind = mesh.cells()[0][0]
    n = 2 * SIZE
    first = 4 * rng.randrange(0, SIZE // 2)
    box = [first / n, (first + 4) / n, (n - 2) / n, 1]
    inside = [e for e in mesh.cells() if all(box[0] <= mesh.nodes[c][0] <= box[1] and box[2] <= mesh.nodes[c][1] <= box[3] for c in e[2])]
    for element in inside:
        mesh.elements.remove(element)
    mesh.elements = [e for e in mesh.elements if not (e[0] == LINE and e[1] == CURVES["top"] and all(box[0] <= mesh.nodes[t][0] <= box[1] for t in e[2]))]
    a, b, c, d = (first, n - 2), (first + 4, n - 2), (first + 4, n), (first, n)
    mesh.line("top", c, d)
    if kind == QUAD:
        middles = [mesh.between(*pair) for pair in ((a, b), (b, c), (c, d), (d, a))] + [(first + 2, n - 1)]
        mesh.elements.append([QUAD, SURFACES["sand"], [mesh.tag(*x) for x in [a, b, c, d] + middles]])
        return
    for corners in ([a, b, c], [a, c, d]):
        middles = [mesh.between(corners[k], corners[(k + 1) % 3]) for k in range(3)]
        mesh.elements.append([TRI, SURFACES["sand"], [mesh.tag(*x) for x in corners + middles]])


def gap_too_narrow(mesh, rng):
    region_torn_off(mesh, random.Random(0))
    for tag, x in mesh.nodes.items():
        if tag > (2 * SIZE + 1) ** 2 and x[1] == 0.5:
            x[1] += 0.001 * rng.choice([-1, 1])


def clockwise(mesh, rng):
    for element in rng.sample(mesh.cells(), rng.randint(1, len(mesh.cells()))):
        corners = len(mesh.corners(element))
        nodes = element[2]
        nodes[1:corners] = nodes[1:corners][::-1]
        nodes[corners:2 * corners] = nodes[corners:2 * corners][::-1]


def numbered_crosswise(mesh, rng):
    nodes = rng.choice(mesh.cells())[2]
    a, b = rng.sample(range(len(nodes)), 2)
    nodes[a], nodes[b] = nodes[b], nodes[a]


def lines_backwards(mesh, rng):
    for element in mesh.elements:
        if element[0] == LINE and rng.random() < 0.5:
            element[2][:2] = element[2][1::-1]


def order_of_elements(mesh, rng):
    rng.shuffle(mesh.elements)


def order_of_nodes(mesh, rng):
    items = list(mesh.nodes.items())
    rng.shuffle(items)
    mesh.nodes = dict(items)


def numbers_with_gaps(mesh, rng):
    new = {tag: 7 * k + rng.randrange(7) + 1 for k, tag in enumerate(mesh.nodes)}
    mesh.nodes = {new[tag]: x for tag, x in mesh.nodes.items()}
    for element in mesh.elements:
        element[2] = [new[tag] for tag in element[2]]


def spare_nodes(mesh, rng):
    for _ in range(rng.randint(1, 5)):
        mesh.nodes[max(mesh.nodes) + 1] = [rng.uniform(-1, 2), rng.uniform(-1, 2), 0.0]


def unknown_tag(mesh, rng):
    for element in rng.sample(mesh.cells(), rng.choice([1, 5])):
        element[1] = rng.choice([3, 77, -1, 0])


def misspelt_name(mesh, rng):
    k = rng.randrange(len(mesh.names))
    dimension, tag, name = mesh.names[k]
    mesh.names[k] = (dimension, tag, rng.choice([name + "s", name[:-1], name.upper(), "", name + " "]))


def no_names(mesh, rng):
    mesh.names = []


def dimension_of_a_name(mesh, rng):
    k = rng.randrange(len(mesh.names))
    dimension, tag, name = mesh.names[k]
    mesh.names[k] = (rng.choice([0, 3, 3 - dimension]), tag, name)


def empty_group(mesh, rng):
    name = rng.choice(list(CURVES))
    mesh.elements = [e for e in mesh.elements if not (e[0] == LINE and e[1] == CURVES[name])]


def region_without_elements(mesh, rng):
    region = rng.choice([1, 2])
    mesh.elements = [e for e in mesh.elements if e[0] == LINE or e[1] != region]


def lines_only(mesh, rng):
    mesh.elements = [e for e in mesh.elements if e[0] == LINE]


def inner_side_in_a_loaded_set(mesh, rng):
    row, first = 2 * rng.randrange(1, SIZE), 2 * rng.randrange(0, SIZE)
    mesh.line(rng.choice(["top", "right"]), (first, row), (first + 2, row))


def line_across_an_element(mesh, rng):
    first = 2 * rng.randrange(0, SIZE)
    mesh.line(rng.choice(list(CURVES)), (first + 2, 0), (first, 2))


def line_twice(mesh, rng):
    mesh.elements.append(copy.deepcopy(rng.choice([e for e in mesh.elements if e[0] == LINE and e[1] in (CURVES["top"], CURVES["right"])])))


def number_that_is_none(mesh, rng):
    tag = rng.choice(list(mesh.nodes))
    mesh.nodes[tag][rng.randrange(2)] = rng.choice(["nan", "-nan", "inf", "-inf", "1e400", "x", "1e300"])


def node_moved_far(mesh, rng):
    mesh.nodes[rng.choice(list(mesh.nodes))][rng.randrange(2)] += rng.choice([-1, 1]) * rng.uniform(0.5, 20)


def out_of_the_plane(mesh, rng):
    mesh.nodes[rng.choice(list(mesh.nodes))][2] = rng.choice([0.01, -3.0])


def all_in_one_place(mesh, rng):
    scale = rng.choice([0.0, 1e-300])
    for x in mesh.nodes.values():
        x[0] *= scale
        x[1] *= rng.choice([scale, 1]) if scale else scale


def squeezed_flat(mesh, rng):
    axis = rng.randrange(2)
    for x in mesh.nodes.values():
        x[axis] = 0.0


def island(mesh, rng):
    double = copy.deepcopy(mesh.cells())
    before = set(mesh.nodes)
    mesh.elements += double
    mesh.copy_nodes(double)
    for tag in set(mesh.nodes) - before:
        mesh.nodes[tag][0] += rng.choice([-3, 3])
        mesh.nodes[tag][1] += rng.uniform(-1, 1)


def unknown_node(mesh, rng):
    nodes = rng.choice(mesh.elements)[2]
    nodes[rng.randrange(len(nodes))] = rng.choice([0, -5, 10 ** 6, 2 ** 40])


def node_twice_in_an_element(mesh, rng):
    nodes = rng.choice(mesh.cells())[2]
    a, b = rng.sample(range(len(nodes)), 2)
    nodes[a] = nodes[b]


def element_of_another_kind(mesh, rng):
    element = rng.choice(mesh.cells())
    element[0], count = rng.choice([(2, 3), (3, 4), (16, 8), (21, 10), (4, 4), (15, 1), (11, 10)])
    element[2] = (element[2] * 2)[:count]


def linear_elements(mesh, rng):
    for element in mesh.elements:
        corners = mesh.corners(element)
        element[0], element[2] = {LINE: 1, TRI: 2, QUAD: 3}[element[0]], corners


def middles_torn_apart(mesh, rng):
    element = rng.choice(mesh.inner_cells())
    corners = len(mesh.corners(element))
    mesh.copy_nodes([element], set(mesh.corners(element)))
    assert corners


MESH_FAULTS = [
    missing_inside, missing_at_the_boundary, many_missing, region_torn_off, crack_inside, element_twice, element_over_another, mesh_twice,
    mesh_over_another, hanging_node, gap_too_narrow, clockwise, numbered_crosswise, lines_backwards, order_of_elements, order_of_nodes,
    numbers_with_gaps, spare_nodes, unknown_tag, misspelt_name, no_names, dimension_of_a_name, empty_group, region_without_elements, lines_only,
    inner_side_in_a_loaded_set, line_across_an_element, line_twice, number_that_is_none, node_moved_far, out_of_the_plane, all_in_one_place,
    squeezed_flat, island, unknown_node, node_twice_in_an_element, element_of_another_kind, linear_elements, middles_torn_apart,
]

# ---- faults of the file: each changes its text ------------------------------------------------------------------------------------


def cut_off(text, rng):
    return text[:rng.randrange(len(text))]


def cut_off_in_the_elements(text, rng):
    return text[:rng.randrange(text.index("$Elements"), text.index("$EndElements"))]


def garbled(text, rng):
    start = rng.randrange(len(text) - 40)
    return text[:start] + "".join(rng.choice("#@xyz!?$ \n") for _ in range(rng.randint(3, 30))) + text[start + 30:]


def line_lost(text, rng):
    lines = text.splitlines(keepends=True)
    del lines[rng.randrange(len(lines))]
    return "".join(lines)


def section_lost(text, rng):
    names = [line[1:] for line in text.splitlines() if line.startswith("$") and not line.startswith("$End")]
    name = rng.choice(names)
    return text[:text.index(f"${name}")] + text[text.index(f"$End{name}") + len(name) + 5:]


def count_wrong(text, rng):
    lines = text.splitlines()
    at = lines.index(rng.choice(["$Nodes", "$Elements"])) + 1
    words = lines[at].split()
    k = rng.randrange(min(2, len(words)))
    words[k] = str(rng.choice([0, -1, 1, int(words[k]) - 1, int(words[k]) + 1, 2 * int(words[k]), 10 ** 12]))
    lines[at] = " ".join(words)
    return "\n".join(lines) + "\n"


def version_wrong(text, rng):
    lines = text.splitlines()
    lines[1] = rng.choice(["3.0 0 8", "9.9 0 8", "2.2 1 8", "4.1 1 8", "4.1 0 4", "x", "", "-1 0 8"])
    return "\n".join(lines) + "\n"


def empty(text, rng):
    return rng.choice(["", "\n", "$MeshFormat\n", "mesh"])


def not_text(text, rng):
    return "".join(chr(rng.randrange(1, 256)) for _ in range(rng.randrange(10, 2000)))


def line_ends(text, rng):
    return text.replace("\n", "\r\n")


TEXT_FAULTS = [cut_off, cut_off_in_the_elements, garbled, line_lost, section_lost, count_wrong, version_wrong, empty, not_text, line_ends]

# ---- faults of a geometry: what is replaced by what -------------------------------------------------------------------------------

GEOMETRY_FAULTS = [
    ("Point(3) = {1, 0.5, 0, size};", "Point(3) = {1, 0.5, 0, size}"), ("Point(3)", "Pont(3)"), ("size = 0.25;", ""), ("size = 0.25;", "size = -1;"), ("size = 0.25;", "size = 1e-320;"), ("Line(2) = {2, 3};", "Line(2) = {2, 33};"), ("Line(2) = {2, 3};", "Line(2) = {2, 2};"),
    ("Curve Loop(1) = {1, 2, 7, 6};", "Curve Loop(1) = {1, 2, 7};"), ("Curve Loop(1) = {1, 2, 7, 6};", "Curve Loop(1) = {1, 7, 2, 6};"),
    ("Curve Loop(1) = {1, 2, 7, 6};", "Curve Loop(1) = {1, -2, 7, 6};"), ("Plane Surface(2) = {2};", "Plane Surface(2) = {1};"),
    ("Plane Surface(2) = {2};", ""), ("Plane Surface(2) = {2};", "Plane Surface(2) = {22};"), ('Physical Surface("sand") = {2};', ""),
    ('Physical Surface("sand") = {2};', 'Physical Surface("sand") = {1, 2};'), ('Physical Surface("sand") = {2};', 'Physical Surface("sand") = {};'),
    ('Physical Surface("sand") = {2};', 'Physical Surface("sand") = {9};'), ('Physical Curve("top") = {4};', ""),
    ('Physical Curve("top") = {4};', 'Physical Curve("top") = {4, 7};'), ('Physical Curve("top") = {4};', 'Physical Curve("top") = {44};'),
    ('Physical Curve("top") = {4};', 'Physical Curve("Top") = {4};'), ('Physical Curve("top") = {4};', 'Physical Point("top") = {4};'),
    ("Point(4) = {1, 1, 0, size};", "Point(4) = {-1, 0.2, 0, size};"), ("Point(4) = {1, 1, 0, size};", "Point(4) = {0.2, -0.4, 0, size};"),
    ("Point(4) = {1, 1, 0, size};", "Point(4) = {1, 1, 0.3, size};"), ("Point(4) = {1, 1, 0, size};", "Point(4) = {1, 1/0, 0, size};"),
    ("Point(4) = {1, 1, 0, size};", "Point(4) = {1, 0.5, 0, size};"), ("Point(4) = {1, 1, 0, size};", "Point(3) = {1, 1, 0, size};"),
    ("Line(7) = {3, 6};", "Line(7) = {3, 6}; Line(7) = {6, 3};"), ("size = 0.25;", "size = 0.25; Mesh.SecondOrderIncomplete = 1;"),
    ("size = 0.25;", "size = 0.25; Mesh.ElementOrder = 3;"), ("size = 0.25;", "size = 0.25; Error('no');"), ("size = 0.25;", "size = 0.25; Exit;"),
    ("size = 0.25;", "size = 0.25; Abort;"), ("size = 0.25;", "size = 0.25; Include 'nothing.geo';"), ("size = 0.25;", "For i In {0:1e9}\nEndFor\nsize = 0.25;"),
    ("size = 0.25;", "/* size = 0.25;"), ("Curve Loop(2) = {3, 4, 5, -7};", "Point(7) = {0, 0.5, 0, size}; Point(8) = {1, 0.5, 0, size}; Line(8) = {8, 7}; "
                                          "Line(9) = {8, 4}; Line(10) = {5, 7}; Curve Loop(2) = {9, 4, 10, -8};"),
]

DECK_FAULTS = [("@file@", "none.msh"), ("@file@", "."), ("@file@", "deck.xml"), ("@order@", "1"), ("@order@", "3"), ("@geometry@", "plane"),
               ('value="20"/>', 'value="20"/><Parameter name="cracks" type="Array(string)" value="{top}"/>'),
               ('value="20"/>', 'value="20"/><Parameter name="cracks" type="Array(string)" value="{gap}"/>'),
               ('name="time limit" type="double" value="20"', 'name="time limit" type="double" value="1e-6"'),
               ('name="time limit" type="double" value="20"', 'name="time limit" type="double" value="-1"')]


def row(path):
    """The last row of a history, by column."""
    with open(path, encoding="utf-8") as file:
        lines = [line.rstrip("\n").split(",") for line in file if line.strip()]
    return dict(zip(lines[0], map(float, lines[-1])))


def run_deck(folder, file, text, changes=(), geometry="plane strain", order="2"):
    """Runs the deck on a mesh; returns how it ended."""
    deck = DECK
    for old, new in [*changes, ("@file@", file), ("@geometry@", geometry), ("@order@", order)]:
        deck = deck.replace(old, new)
    folder.mkdir()
    (folder / "deck.xml").write_text(deck, encoding="utf-8")
    (folder / file).write_bytes(text.encode("latin-1", "replace"))
    return fault.start(["run", "-q", "deck.xml"], folder, limit=60)


def changed(good, folder):
    """What differs between the last rows of two histories; "": nothing."""

    def compare():
        sound, here = row(good / "results" / "deck.csv"), row(folder / "results" / "deck.csv")
        if set(sound) != set(here):
            return "other columns"
        scale = {}
        for name, value in sound.items():
            kind = name[name.rfind("["):]
            scale[kind] = max(scale.get(kind, 0.0), abs(value))
        for name, value in sound.items():
            if "newton" in name or "numerical" in name or "error" in name:
                continue
            if not abs(here[name] - value) <= 1e-7 * scale[name[name.rfind("["):]]:
                return f"{name}: {here[name]} for {value}"
        return ""

    return compare


def faults(rng):
    """Endless: name, kind of mesh ('tri', 'quad', 'geo'), file, text, further arguments of run_deck."""
    versions = {"v2": Mesh.version_2, "v4": Mesh.version_4}
    mesh_faults, text_faults = itertools.cycle(MESH_FAULTS), itertools.cycle(TEXT_FAULTS)
    others = itertools.cycle([("geo", g) for g in GEOMETRY_FAULTS] + [("deck", d) for d in DECK_FAULTS] + [("radius", None)])
    for k in itertools.count():
        shape, kind = rng.choice([(TRI, "tri"), (QUAD, "quad")])
        version = rng.choice(list(versions))
        mesh = Mesh(shape)
        what = k % 6
        if what < 3:
            change = next(mesh_faults)
            change(mesh, rng)
            yield f"{change.__name__.replace('_', ' ')} ({kind}, {version})", kind, "soil.msh", versions[version](mesh), {}
        elif what < 5:
            change = next(text_faults)
            yield f"{change.__name__.replace('_', ' ')} ({kind}, {version})", kind, "soil.msh", change(versions[version](mesh), rng), {}
        else:
            of, (detail) = next(others)
            if of == "geo":
                yield f"geometry: {detail[0]} -> {' '.join(detail[1].split())}", "geo", "soil.geo", GEOMETRY.replace(*detail), {}
            elif of == "deck":
                yield f"deck: {detail[1]}", kind, "soil.msh", versions[version](mesh), {"changes": [detail]}
            else:
                for x in mesh.nodes.values():
                    x[0] -= 0.3
                yield f"negative radii ({kind}, {version})", kind, "soil.msh", versions[version](mesh), {"geometry": "axisymmetric"}


def run(count, seed, folder):
    rng = random.Random(seed)
    sound = {"tri": ("soil.msh", Mesh(TRI).version_2()), "quad": ("soil.msh", Mesh(QUAD).version_4()), "geo": ("soil.geo", GEOMETRY)}
    for kind, (file, text) in sound.items():
        ended = run_deck(folder / kind, file, text)
        if ended.code != 0:
            raise RuntimeError("the sound deck does not run: " + ended.stderr)
    for k, (name, kind, file, text, options) in enumerate(itertools.islice(faults(rng), count)):
        here = folder / f"fault {k}"
        ended = run_deck(here, file, text, **options)
        yield fault.judge(name, ended, changed(folder / kind, here))
