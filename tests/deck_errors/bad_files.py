"""Decks that are no XML, files that are missing or wrong, --set that does not fit."""
from wrong_deck import Wrong, line_of, parameter, section

BOTH = (1, 2)
BOX = ("    " + parameter("type", "string", "box") + "\n", "    " + parameter("type", "string", "gmsh") + "\n")
CELL = ("    " + parameter("cell", "string", "quad9") + "\n", "")
CELLS = ("    " + parameter("cells", "Array(int)", "{3, 3}") + "\n", "")
UPPER = parameter("upper", "Array(double)", "{0.3, 0.3}")

SQUARE = 'SetFactory("OpenCASCADE");\nRectangle(1) = {0, 0, 0, 0.3, 0.3};\n'
SETS = """Physical Surface("soil") = Surface{:};
Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("top") = {3%s};
Physical Curve("left") = {4};
MeshSize{:} = 0.15;
"""
ISLAND = SQUARE + "Rectangle(2) = {0.5, 0, 0, 0.1, 0.1};\n" + SETS % ""
FORGOTTEN = SQUARE + "Rectangle(2) = {0.3, 0, 0, 0.1, 0.3};\n" + SETS % ""  # Coherence
INNER = SQUARE + "Point(9) = {0.1, 0.1, 0};\nPoint(10) = {0.2, 0.1, 0};\nLine(9) = {9, 10};\nCurve{9} In Surface{1};\n" + SETS % ", 9"
# a square whose mid-side node lies beside a corner
FOLDED = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
2 1 "soil"
$EndPhysicalNames
$Nodes
9
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0.5 0 0
6 1 0.5 0
7 0.5 1 0
8 0 0.5 0
9 0.95 0.95 0
$EndNodes
$Elements
1
1 10 2 1 1 1 2 3 4 5 6 7 8 9
$EndElements
"""


def gmsh(name, file, content, message, path="mesh/file", at='name="file"', more="", **options):
    changes = [BOX, CELL, CELLS, (UPPER, parameter("file", "string", file) + more)]
    return Wrong(name, changes, f"{path}: {message}", at=at, files=[(file, content)] if content is not None else [], **options)


def plugin(name, file, message, content=None, **options):
    changes = (section("output"), section("plugins") + parameter("files", "Array(string)", "{" + file + "}") +
               "</ParameterList>" + section("output"))
    return Wrong(name, changes, "plugins/files: " + message, files=[(file, content)] if content else [], **options)


def setting(name, text, message, **options):
    return Wrong(name, [], f"--set {text}: {message}", line=False, settings=[text], **options)


DECKS = [
    Wrong("duplicated parameter", (parameter("void ratio", "double", "1.2"), parameter("void ratio", "double", "1.2") +
                                   parameter("void ratio", "double", "1.3")),
          f"materials/clay/void ratio: duplicated parameter (first given at deck.xml:{line_of('void ratio')})", at=parameter("void ratio", "double", "1.3")),
    Wrong("duplicated section", (section("solver"), section("solver") + "</ParameterList>" + section("solver")),
          f"solver: duplicated section (first given at deck.xml:{line_of(section('solver'))})", ranks=BOTH),
    Wrong("end tag missing", ("</ParameterList>\n  " + section("functions"), "\n  " + section("functions")),
          "malformed XML: by its indentation the section that begins here has no closing tag", at=section("mesh"), ranks=BOTH),
    Wrong("end tag of an inner section missing", ("</ParameterList>\n      " + section("fluid"), "\n      " + section("fluid")),
          "malformed XML: by its indentation the section that begins here has no closing tag", at=section("skeleton")),
    Wrong("a sweep that is run", (section("functions"), section("settings") + parameter("mesh/cells", "string", "{n, n}") + "</ParameterList>" +
                                  section("functions")),
          "settings/mesh/cells: a name cannot contain '/', which separates sections; is this a sweep? `mudline sweep` runs it"),
    gmsh("mesh of Abaqus", "part.inp", "*NODE\n", "expected a .msh or .geo file, given 'part.inp'; `mudline import` makes a .msh of it"),
    gmsh("drawing for a mesh", "part.STEP", "ISO-10303-21;\n", "expected a .msh or .geo file, given 'part.STEP'; a .geo merges it and names its "
         "groups (user guide, section 3)", ranks=BOTH),
    gmsh("empty geometry", "square.geo", "", "'square.geo' is empty"),
    gmsh("folders of another system", "meshes\\square.geo", None, "the file 'meshes\\square.geo' does not exist (looked for {folder}/meshes\\square.geo); "
         "folders are separated by '/'"),
    Wrong("quote missing", ('name="cells" type', 'name="cells type'),
          'malformed XML: an attribute is not written correctly (name="value") or given twice'),
    Wrong("misspelt tag", ('<Parameter name="cells"', '<Paramter name="cells"'), "mesh: unknown element <Paramter> (did you mean 'Parameter'?)"),
    Wrong("type missing", ('name="cells" type="Array(int)"', 'name="cells"'), "mesh/cells: the parameter has no type", at='name="cells"'),
    Wrong("unknown type", ('type="Array(int)"', 'type="Array(integer)"'),
          "mesh/cells: unknown parameter type 'Array(integer)' (did you mean 'Array(int)'?)"),
    gmsh("mesh file missing", "soil.msh", None, "the file 'soil.msh' does not exist (looked for {folder}/soil.msh)", ranks=BOTH),
    gmsh("geometry without physical groups", "plain.geo", SQUARE,
         "'plain.geo': the 162 elements of surface 1 belong to no physical group; add a Physical Surface for each region", ranks=BOTH),
    gmsh("broken geometry", "broken.geo", "Point(1) = {0, 0 0};\n",
         "Gmsh, reading 'broken.geo': '{folder}/broken.geo', line 1: syntax error (0)"),
    gmsh("folded element", "folded.msh", FOLDED, "element with negative Jacobian in region 'soil' centred at (0.5, 0.5): it is inverted, "
         "flat, or its sides are too curved", path="mesh", at=section("mesh"), ranks=BOTH),
    gmsh("island", "island.geo", ISLAND, "the mesh is in 2 parts that have no common nodes, and nothing could hold the one at (0.5, 0.1): no "
         "displacement is prescribed on it and no contact has a surface of it", path="mesh", at=section("mesh"), ranks=BOTH),
    gmsh("forgotten Coherence", "two.geo", FORGOTTEN, "the mesh has a crack of twin nodes: two elements have a side from (0.3, 0.15) to (0.3, 0.3) "
         "each; join them (in Gmsh by Coherence), or name both surfaces in a contact's 'slave' and 'master', or their side set in 'cracks' when "
         "they are to part", path="mesh", at=section("mesh"), ranks=BOTH),
    gmsh("inner side of a loaded set", "inner.geo", INNER, "side set 'top' has a side between two elements, at (0.15, 0.1); all its sides must be on "
         "the boundary of the mesh", path="boundary conditions/surcharge/set", at=parameter("set", "string", "top") + "\n      <Parameter name=\"value\"", ranks=BOTH),
    gmsh("a command in a geometry", "save.geo", SQUARE + "// Save\nSave \"mine.msh\";\n" + SETS % "", "save.geo:4: 'Save' writes a file; a file that makes "
         "a mesh must not do that. Take it out, or, if you trust the file, give --allow-commands on the command line", ranks=BOTH),
    gmsh("a script that is called a mesh", "script.msh", 'SystemCall "touch here";\n', "'script.msh' is no mesh of Gmsh: it does not begin with "
         "$MeshFormat", ranks=BOTH),
    gmsh("Gmsh takes too long", "slow.geo", SQUARE + "For i In {0:1e12}\nEndFor\n", "Gmsh, reading 'slow.geo', had not finished after 1 s and was "
         "stopped; does a boundary cut itself? 'time limit' gives it more time", more=parameter("time limit", "double", "1"), ranks=BOTH),
    plugin("plugin missing", "my_clay.so", "plugin 'my_clay.so' does not exist (looked for {folder}/my_clay.so)", ranks=BOTH),
    plugin("no shared library", "my_clay.so", "plugin 'my_clay.so' cannot be loaded: {folder}/my_clay.so: file too short", content="text"),
    setting("set: new section without type", "stages/second/duration=1", "stages/second: required parameter 'type' is missing; known stage "
            "types: geostatic, quasi-static, dynamic"),
    setting("set: misspelt section of a section", "stages/push/integratr/type=newmark",
            "stages/push/integratr: unknown section (did you mean 'integrator'?)"),
    setting("set: misspelt material", "materials/cly/void ratio=1", "materials/cly: the deck has no such section (did you mean 'clay'?)"),
    setting("set: below a parameter", "mesh/type/cells=3", "mesh/type: a parameter; it has no entries of its own"),
    setting("set: section", "stages/pusch/duration=1", "stages/pusch: the deck has no such section (did you mean 'push'?)"),
    setting("set: parameter", "stages/push/durations=3", "stages/push/durations: unknown parameter (did you mean 'duration'?)", ranks=BOTH),
    setting("set: no value", "stages/push/duration", "expected section/parameter=value, such as stages/push/duration=2.0"),
    setting("set: wrong type", "stages/push/duration=long", "stages/push/duration: expected a number (double), given the string 'long'"),
    setting("set: an expression without braces", "solver/linear tolerance=1e-4*2",
            "solver/linear tolerance: expected a number (double), given the string '1e-4*2'; an expression has the type "
            "double, and in a setting it stands in braces, \"{1e-4*2}\""),
    setting("set: a section", "stages/push=3", "stages/push: a section; only parameters can be set"),
    setting("set: out of range", "solver/residual tolerance=2", "solver/residual tolerance: 2 is out of range; allowed: (0, 1)"),
]
