#!/usr/bin/env python3
"""docs/parameters.md is what the program writes.

    check_reference.py PROGRAM ROOT     prints the first differences and ends with 1 if there are any
"""
import difflib
import pathlib
import subprocess
import sys

SHOWN = 20  # lines of the difference


def main():
    program, root = sys.argv[1:]
    path = pathlib.Path(root) / "docs" / "parameters.md"
    done = subprocess.run([program, "list", "--markdown"], capture_output=True, text=True, timeout=60)
    if done.returncode != 0:
        sys.exit(f"mudline list --markdown ended with {done.returncode}: {done.stderr.strip()}")
    written = path.read_text(encoding="utf-8") if path.exists() else ""
    lines = [text.splitlines() for text in (written, done.stdout)]
    difference = list(difflib.unified_diff(*lines, "docs/parameters.md", "the program", n=0, lineterm=""))
    if not difference:
        print("docs/parameters.md: as the program writes it")
        return 0
    print("\n".join(difference[:SHOWN]))
    print("docs/parameters.md is out of date; write it anew: mudline list --markdown > docs/parameters.md")
    return 1


if __name__ == "__main__":
    sys.exit(main())
