#!/usr/bin/env python3
"""Every documented parameter occurs in some test or deck.

    check_tested.py ROOT     prints the parameters of docs/parameters.md that occur in none, and ends with 1 if there are any
"""
import pathlib
import re
import sys

SUFFIXES = (".xml", ".py", ".cpp", ".hpp")


def documented(reference):
    """[(type, section, parameter)] of the reference."""
    found, entry, section = [], "", ""
    for line in reference.splitlines():
        if line.startswith("## "):
            entry, section = line[3:], ""
        elif line.startswith("### Section "):
            section = line[len("### Section "):]
        elif line.startswith("| ") and not line.startswith("| parameter |"):
            found.append((entry, section, line[2:].split(" | ")[0].replace("\\", "")))
    return found


def is_source(path):
    return path.suffix in SUFFIXES and ("tests" in path.parts or path.name.startswith("test_"))


def texts(root):
    yield from (root / "inputs").rglob("*.xml")
    for folder in ("tests", "packages", "apps"):
        yield from filter(is_source, (root / folder).rglob("*"))


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    text = "\n".join(path.read_text(encoding="utf-8", errors="replace") for path in texts(root))
    # as a deck, a dictionary or a list writes it ("name"), or a setting (path/name=, {path}name=)
    given = set(re.findall(r"""(?<=["'/}])((?:[^"'/{}=\n\\]|'s )+)\\?(?=["'=])""", text))
    given |= {name.replace("_", " ") for name in re.findall(r"\b([a-z]+_[a-z_]+)=", text)}  # arguments of Python's helpers
    missing = [parameter for parameter in documented((root / "docs" / "parameters.md").read_text()) if parameter[2] not in given]
    for entry, section, name in missing:
        print(f"{entry}{', ' + section if section else ''}: no test and no deck gives '{name}'")
    print(f"{len(missing)} documented parameters occur in no test or deck" if missing else "every documented parameter occurs in a test or deck")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
