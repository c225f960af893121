#!/usr/bin/env python3
"""The shape of the tree: include arrows, heavy headers, file lengths, no machine paths, class names once, format.

    check_includes.py [ROOT]     prints one line per fault and ends with 1 if there is any
"""
import pathlib
import re
import shutil
import subprocess
import sys

# A package may include itself and these (docs/developer_guide.md draws the arrows). Contact, ale and integrator are
# siblings, and so are physics and bodies; contact and materials see no matrices, so that their kernels stay light and
# portable.
ARROWS = {
    "tensor": [],
    "core": ["tensor"],
    "algebra": ["core", "tensor"],
    "discretisation": ["core", "tensor", "algebra"],
    "geometry": ["core", "tensor", "discretisation"],
    "materials": ["core", "tensor"],
    "framework": ["core", "tensor", "algebra", "discretisation", "materials"],
    "physics": ["core", "tensor", "algebra", "discretisation", "materials", "framework"],
    "bodies": ["core", "tensor", "discretisation", "geometry", "framework"],
    "contact": ["core", "tensor", "discretisation", "materials", "geometry", "framework", "bodies"],
    "ale": ["core", "tensor", "algebra", "discretisation", "materials", "geometry", "framework", "physics", "bodies"],
    "integrator": ["core", "tensor", "algebra", "discretisation", "framework"],
}
ARROWS["simulation"] = list(ARROWS)
ARROWS["checks"] = list(ARROWS)

# Headers that cost seconds of compilation, or that another library could replace one day: each stays in its corner.
# A header in a list hands the burden on, so only files of the same list may include it. A name ending in / is a folder.
HEAVY = {
    r"NOX": ["packages/integrator/nox_interface.hpp", "packages/integrator/guarded_step.hpp", "packages/integrator/newton.cpp"],
    r"Thyra|Stratimikos": [],
    r"MueLu|Xpetra|Ifpack2": ["packages/algebra/amg.cpp"],
    r"Belos": ["packages/algebra/krylov.cpp"],
    r"[sdcz]mumps_": ["packages/algebra/mumps_factor.cpp"],
    r"gmsh": [f"packages/discretisation/gmsh_{part}.cpp" for part in ("session", "model", "curve", "triangulation")],
    r"hdf5|H5": ["packages/simulation/output/", "packages/simulation/tests/"],
    r"tinyxml2": ["packages/core/deck_xml.cpp", "packages/simulation/tests/documentation_test.cpp"],
    r"muParser": ["packages/core/function.cpp"],
    r"CLI/": ["apps/mudline/"],
}
NO_TPETRA = ["core", "tensor", "materials", "contact"]
FOR_TESTS = {
    "contact": ["algebra", "physics"],  # its tests assemble the matrices that its kernels do not know, and close conditions
    "geometry": ["bodies"],  # its contours are read from decks with bodies
}

MAX_LINES = 600  # a class stands in one header and one source; one that needs more does too much
LONG_FILES = {}  # path: why it is longer
MAX_COLUMNS = 120
CLANG_FORMAT = "14"  # other versions lay some lines out differently

MACHINE_PATH = re.compile(r"(?<![\w.}>*-])/(?:work|home|root|Users|tmp)/\w")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
SOURCES = (".hpp", ".cpp", ".h", ".cc", ".py", ".cmake")
TEXT = SOURCES + (".xml", ".md", ".txt", ".json", ".geo", ".sh")


def files_of(root, suffixes):
    for folder in ("packages", "apps", "tests", "cmake", "inputs", "docs", ".ci"):
        for path in sorted((root / folder).rglob("*")):
            name = path.relative_to(root)
            # a plugin of inputs/plugins may have been built where it stands
            if path.is_file() and (path.suffix in suffixes or folder == ".ci") and not {"__pycache__", "build"} & set(name.parts):
                yield name.as_posix(), path


def listed(name, allowed):
    return any(name == entry or (entry.endswith("/") and name.startswith(entry)) for entry in allowed)


def includes_of(path):
    """Pairs (line number, kind of bracket, header)."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1), match.group(2)


def arrow_faults(name, package, number, bracket, header):
    first = header.split("/")[0] if "/" in header else ""
    in_tests = "/tests/" in name
    allowed = ARROWS.get(package, []) + (FOR_TESTS.get(package, []) if in_tests else [])
    if first in ARROWS:
        if bracket == "<":
            yield f'{name}:{number}: write #include "{header}": own headers stand in quotes'
        if package and first != package and first not in allowed:
            seen = ", ".join(allowed) or "no other package"
            yield f"{name}:{number}: {package} may not include {header} (it may see: {seen})"
    elif bracket == '"' and first and package:
        yield f'{name}:{number}: "{header}" names no package; own headers read "<package>/<file>.hpp"'
    if package in NO_TPETRA and not in_tests and re.match(r"Tpetra", header):
        yield f"{name}:{number}: {package} may not include {header}: no Tpetra in this package"


def heavy_faults(name, number, bracket, header):
    for pattern, allowed in HEAVY.items():
        carrier = bracket == '"' and "packages/" + header in allowed
        if (carrier or (bracket == "<" and re.match(pattern, header))) and not listed(name, allowed):
            where = " or ".join(allowed) or "nowhere yet; list the file in tests/structure/check_includes.py"
            yield f"{name}:{number}: {header} belongs in {where}"


def source_faults(root):
    for name, path in files_of(root, (".hpp", ".cpp", ".h", ".cc")):
        parts = name.split("/")
        package = parts[1] if parts[0] == "packages" else None
        if package is not None and package not in ARROWS:
            yield f"{name}: unknown package {package}: give it its arrows in tests/structure/check_includes.py"
            continue
        for number, bracket, header in includes_of(path):
            yield from arrow_faults(name, package, number, bracket, header)
            yield from heavy_faults(name, number, bracket, header)


def length_faults(root):
    for name, path in files_of(root, SOURCES):
        lines = path.read_text(encoding="utf-8").count("\n")
        if lines > MAX_LINES and name not in LONG_FILES:
            yield f"{name}: {lines} lines, more than {MAX_LINES}: split it, or give the reason in LONG_FILES"


def path_faults(root):
    for name, path in files_of(root, TEXT):
        for number, line in enumerate(path.read_text(encoding="utf-8", errors="replace").splitlines(), 1):
            if MACHINE_PATH.search(line):
                yield f"{name}:{number}: path of one machine: {line.strip()[:80]}"


def name_faults(root):
    """Two classes of one name in two headers are one class to the linker: it takes either, silently."""
    seen = {}
    for name, path in files_of(root, {".hpp"}):
        if not name.startswith("packages/"):
            continue
        text = path.read_text()
        space = re.search(r"^namespace (mudline\S*) {", text, re.M)
        for found in re.finditer(r"^(?:struct|class) (?:alignas\(\d+\) )?(\w+)(?: final)?(?: :| {)", text, re.M):
            type_name = f"{space.group(1) if space else ''}::{found.group(1)}"
            if seen.setdefault(type_name, name) != name:
                yield f"{name}: {type_name} is also a class in {seen[type_name]}"


def clang_format():
    """The program of the project's version, or "" where there is none."""
    for program in (f"clang-format-{CLANG_FORMAT}", "clang-format"):
        if shutil.which(program):
            version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
            if re.search(rf"version {CLANG_FORMAT}\.", version):
                return program
    return ""


def format_faults(root):
    """Columns of C++ sources, and their layout where clang-format of the project's version is there."""
    sources = [pair for pair in files_of(root, (".hpp", ".cpp")) if pair[1].suffix in (".hpp", ".cpp")]
    for name, path in sources:
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            if len(line) > MAX_COLUMNS:
                yield f"{name}:{number}: {len(line)} columns, more than {MAX_COLUMNS}"
    if clang_format():
        command = [clang_format(), "--dry-run", *(str(path) for _, path in sources)]
        for line in subprocess.run(command, capture_output=True, text=True, check=True).stderr.splitlines():
            if "clang-format-violations" in line:
                yield line.replace(f"{root}/", "").split(": warning")[0] + ": not formatted (clang-format -i FILE mends it)"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
    if not (root / "packages").is_dir():
        sys.exit(f"{root}: no packages/ here")
    faults = [*source_faults(root), *length_faults(root), *path_faults(root), *name_faults(root),
              *format_faults(root)]
    layout = "format" if clang_format() else f"columns (no clang-format {CLANG_FORMAT} here: layout not checked)"
    print("\n".join(faults) if faults else f"include arrows, heavy headers, file lengths, paths, class names, {layout}: in order")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
