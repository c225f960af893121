#!/usr/bin/env python3
"""The program starts without Gmsh, which it loads when it needs it, and looks for tinyxml2 before all other libraries.

    check_link_order.py PROGRAM     ends with 1 where that is not so

Newer Gmsh libraries export a tinyxml2 of their own that does not fit, and loading Gmsh takes longer than most commands.
"""
import re
import subprocess
import sys


def main():
    listing = subprocess.run(["readelf", "-d", sys.argv[1]], capture_output=True, text=True, check=True).stdout
    needed = re.findall(r"\(NEEDED\).*\[lib([\w+-]+)", listing)
    if needed[:1] != ["tinyxml2"]:
        print("the first library of the program is not tinyxml2")
        return 1
    if "gmsh" in needed:
        print("the program loads Gmsh at its start")
        return 1
    print("tinyxml2 first, and no Gmsh: in order")
    return 0


if __name__ == "__main__":
    sys.exit(main())
