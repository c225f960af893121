"""What packages say of the program is what its build says: the version everywhere, and in the recipe for Spack the
libraries that CMake looks for, no more and no fewer.

    check_packaging.py ROOT     ends with 1 where that is not so
"""
import ast
import pathlib
import re
import sys

RECIPE = "packaging/spack/spack_repo/mudline/packages/mudline/package.py"
# what Spack calls the libraries that CMake looks for
SPACK = {"MPI": "mpi", "Trilinos": "trilinos", "PkgConfig": "pkgconfig", "tinyxml2": "tinyxml2", "HDF5": "hdf5",
         "muparser": "muparser", "metis": "metis", "dmumps": "mumps", "mumps_common": "mumps", "gmsh": "gmsh",
         "CLI11": "cli11", "GTest": "googletest", "Python3": "python"}
TIMINGS = {"benchmark"}  # of programs that no package has
OTHERS = {"c", "cxx", "cmake"}  # what CMake's project() asks for


def versions(root):
    """{file: version} of all files that name it."""
    places = {"CMakeLists.txt": r"project\(mudline VERSION (\S+)", "CITATION.cff": r"(?m)^version: (\S+)",
              "python/pyproject.toml": r'(?m)^version = "(.*)"', "CHANGELOG.md": r"(?m)^## (\d+\.\d+\.\d+)",
              RECIPE: r'version\("(.*)"\)', "docs/developer_guide.md": r"mudline@(\S+)"}
    return {file: re.search(pattern, (root / file).read_text(encoding="utf-8"))[1]
            for file, pattern in places.items()}


def wanted_by_cmake(root):
    """The libraries that the build looks for, as CMake names them."""
    text = "\n".join((root / "cmake" / file).read_text(encoding="utf-8")
                     for file in ("MudlineDependencies.cmake", "MudlineTest.cmake"))
    return set(re.findall(r"(?m)^\s*find_package\((\w+)", text) + re.findall(r"find_library\(\w+ (\w+)", text)
               + re.findall(r"IMPORTED_TARGET (\w+)", text))


def recipe_names(root):
    """The packages on which the recipe depends, without versions and variants, and without modules of Python."""
    tree = ast.parse((root / RECIPE).read_text(encoding="utf-8"))
    names = {re.match(r"[\w-]+", node.args[0].value)[0] for node in ast.walk(tree)
             if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "depends_on"}
    return {name for name in names if not name.startswith("py-")}


def main(root):
    wrong = []
    found = versions(root)
    if len(set(found.values())) > 1:
        wrong.append("the version differs: " + ", ".join(f"{file} {version}" for file, version in found.items()))
    wanted = wanted_by_cmake(root) - TIMINGS
    unknown = wanted - set(SPACK)
    if unknown:
        wrong.append(f"check_packaging.py does not know what Spack calls {', '.join(sorted(unknown))}")
    needed, given = {SPACK[name] for name in wanted - unknown} | OTHERS, recipe_names(root)
    for what, names in (("lacks", needed - given), ("asks in vain for", given - needed)):
        if names:
            wrong.append(f"{RECIPE} {what} {', '.join(sorted(names))}")
    sys.exit("\n".join(wrong) or None)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
