#!/usr/bin/env python3
"""The program looks for tinyxml2 before Gmsh, whose newer versions export a tinyxml2 of their own that does not fit.

    check_link_order.py PROGRAM     ends with 1 where a library that reads the deck stands behind Gmsh, or is missing
"""
import re
import subprocess
import sys


def main():
    listing = subprocess.run(["readelf", "-d", sys.argv[1]], capture_output=True, text=True, check=True).stdout
    needed = re.findall(r"\(NEEDED\).*\[lib([\w+-]+)", listing)
    if "tinyxml2" not in needed:
        print("the program is not linked with tinyxml2")
        return 1
    if "gmsh" in needed and needed.index("gmsh") < needed.index("tinyxml2"):
        print("libgmsh stands before libtinyxml2: newer Gmsh libraries would answer for it")
        return 1
    print("tinyxml2 before Gmsh: in order")
    return 0


if __name__ == "__main__":
    sys.exit(main())
