#!/usr/bin/python3
"""Writes the mesh of an Abaqus input file (.inp) or of a universal file of I-DEAS (.unv) as MSH 2.2, for the mesh source
`gmsh`.

mudline import part.inp                      # part.msh
mudline import part.unv
mudline import part.inp -o soil.msh --scale 0.001   # a mesh in millimetres

Regions are the element sets of solid sections, or groups of elements that fill the mesh. Element surfaces and groups of
faces become side sets, and so do node sets that hold all nodes of a side of the boundary; other node sets stay sets of
nodes.
"""

import argparse
import sys
from pathlib import Path

sys.path[1:1] = [str(place / "python") for place in Path(__file__).resolve().parents[1:3]]
from mudline import MudlineError, import_mesh  # noqa: E402

sys.path.append(str(Path(__file__).resolve().parent.parent / "support"))
from standard_output import after_output  # noqa: E402


def main():
    parser = argparse.ArgumentParser(prog="mudline import", description=__doc__, allow_abbrev=False,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", help="the file, .inp or .unv")
    parser.add_argument("-o", "--output", help="the mesh (default: the file with the ending .msh)")
    parser.add_argument("--scale", type=float, default=1.0, help="factor of all coordinates [1]")
    options = parser.parse_args()
    output = Path(options.output) if options.output else Path(options.file).with_suffix(".msh")
    try:
        groups = import_mesh(options.file, output, options.scale)
    except (MudlineError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    print(output)
    for kind, names in groups.items():
        if names:
            print(f"{kind}{'s' if len(names) > 1 else ''}: {', '.join(names)}")
    return 0


if __name__ == "__main__":
    sys.exit(after_output(main))
