#!/usr/bin/env python3
"""What the developer guide says of classes, where it can be checked without a compiler: a class stands in one header and one source;
fields are not looked up by literal names.

    check_classes.py [ROOT]     prints one line per fault and ends with 1 if there is any
"""
import pathlib
import re
import sys

# Classes that still stand in several sources.
SEVERAL_SOURCES = {"Ale", "Run", "SurfaceMotion"}

# Look-ups of a field by a literal name that are left in all packages. A field is known to the physics that declares it, to the soil and
# to the context of a contact or of a condition: ask these. The number may fall.
LOOK_UPS = 25

CLASS = re.compile(r"^(?:struct|class) (?:alignas\(\d+\) )?(\w+)(?: final)?(?: :| {)", re.M)
MEMBER = re.compile(r"^(?!\s|return|//)[^\n;=(]*?\b(\w+)(?:<[^>\n]*>)?::~?(?:operator[^\s(]*|\w+)\(", re.M)
LOOK_UP = re.compile(r'\bfind\("(?:displacement|pore pressure|temperature|body motion)"\)')


def sources(root, suffixes, folders=("packages", "apps", "inputs")):
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in suffixes and not {"tests", "build"} & set(path.relative_to(root).parts):
                yield path.relative_to(root).as_posix(), path.read_text(encoding="utf-8")


def spread_classes(root):
    """Class name to the sources that define its members, of classes in headers."""
    classes = {name for _, text in sources(root, {".hpp"}) for name in CLASS.findall(text)}
    where = {}
    for path, text in sources(root, {".cpp"}):
        for name in MEMBER.findall(text):
            if name in classes:
                where.setdefault(name, set()).add(path)
    return {name: sorted(paths) for name, paths in where.items() if len(paths) > 1}


def class_faults(root):
    for name, paths in sorted(spread_classes(root).items()):
        if name not in SEVERAL_SOURCES:
            yield f"{', '.join(paths)}: the class {name} stands in {len(paths)} sources: make parts of it classes of their own"


def look_up_faults(root):
    found = [f"{path}:{text.count(chr(10), 0, match.start()) + 1}" for path, text in sources(root, {".hpp", ".cpp"}, ("packages",))
             for match in LOOK_UP.finditer(text)]
    if len(found) > LOOK_UPS:
        yield (f"{', '.join(found)}: {len(found)} look-ups of fields by literal names, more than the {LOOK_UPS} that are left: ask the "
               "physics, the soil or the context for the field")


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
    faults = [*class_faults(root), *look_up_faults(root)]
    print("\n".join(faults) if faults else "classes in one source, look-ups of fields: in order")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
