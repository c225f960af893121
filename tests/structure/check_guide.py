#!/usr/bin/env python3
"""The user guide, with its pages on bodies, contact and mesh motion, and the program agree: every law of the soil is named
in the section on materials, and every column that they document is one of a shipped deck's history (as the golden
histories keep it).

    check_guide.py PROGRAM ROOT     prints what is missing and ends with 1 if anything is
"""
import pathlib
import re
import subprocess
import sys

COLUMN = re.compile(r"(body|contact|balance|mesh|mesh motion|probe|reaction|step)/")
PAGES = ("bodies.md", "contact.md", "mesh_motion.md")
ESTIMATE = re.compile(r"(^mesh/.*| )error$")  # columns of the error estimate, which tests/verification/error looks at


def laws(program):
    """Names that `skeleton` takes, as `mudline list` prints them."""
    done = subprocess.run([program, "list", "skeleton"], capture_output=True, text=True, timeout=60, check=True)
    return [re.split(r"\s{2,}", line.strip())[0] for line in done.stdout.splitlines() if line.startswith("  ")]


def recorded_columns(root):
    """Columns of all golden histories, without units."""
    found = set()
    for path in sorted((root / "tests" / "regression" / "golden").glob("*.csv")):
        header = path.read_text(encoding="utf-8").splitlines()[1]
        found |= {re.sub(r" \[[^\]]*\]$", "", column) for column in header.split(",")[1:]}
    return found


def documented(guide):
    """Columns that the guide names: whole ones anywhere, their last parts in what follows "Histories"."""
    whole = {word for word in re.findall(r"`([^`\n]+)`", guide) if COLUMN.match(word) and not word.endswith("/")}
    parts = set()
    for paragraph in guide.split("\n\n"):
        for sentence in re.findall(r"\bHistories\b(?:[^.`]|`[^`]*`)*", paragraph.replace("\n", " ")):
            parts |= set(re.findall(r"`([a-z ]{2,})`", sentence))
    return whole, parts


def matches(word, columns, begin):
    pattern = begin + re.sub(r"<[^>]*>", ".+", word) + r"( [xyz]|/.*)?"
    return any(re.fullmatch(pattern, column) for column in columns)


def main():
    program, root = sys.argv[1], pathlib.Path(sys.argv[2])
    guide = (root / "docs" / "user_guide.md").read_text(encoding="utf-8")
    materials = re.search(r"^## 4\. Materials$.*?(?=^## )", guide, re.DOTALL | re.MULTILINE).group()
    missing = [f"section 4 does not name the law `{law}`" for law in laws(program) if f"`{law}`" not in materials]
    columns = recorded_columns(root)
    pages = [(root / "docs" / page).read_text(encoding="utf-8") for page in PAGES]
    whole, parts = documented("\n\n".join([guide, *pages]))
    missing += [f"no shipped deck's history has the column `{word}`" for word in sorted(whole)
                if not ESTIMATE.search(word) and not matches(word, columns, "")]
    missing += [f"no shipped deck's history has a column that ends with `{word}`" for word in sorted(parts) if not matches(word, columns, ".*/")]
    print("\n".join(missing) or f"the guide names all laws, and {len(whole) + len(parts)} documented columns are there")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
