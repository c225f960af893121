"""Links of Markdown files, as GitHub resolves them: to files, to headings, to pictures; and paths in backticks."""
import pathlib
import re

LINK = re.compile(r"\]\(([^()\s]+)\)")
PATH = re.compile(r"`(?:\./)?((?:docs|inputs|tests|apps|packages)/[\w./-]*\.(?:md|xml|geo|csv|py|png|slurm))`")


def without_code(text):
    """The text without fenced and indented code and without code spans."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)
    text = re.sub(r"(?:^|\n)\n(?: {4,}[^\n]*\n)+", "\n\n", text)
    return re.sub(r"`[^`]*`", "", text)


def anchors(text):
    """The names that headings have on GitHub."""
    found, seen = set(), {}
    text = re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)
    for heading in re.findall(r"^#+ (.*)$", text, re.MULTILINE):
        name = re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")
        found.add(f"{name}-{seen[name]}" if name in seen else name)
        seen[name] = seen.get(name, 0) + 1
    return found


def broken(root, files, source=True):
    """A line for each link of the files that leads nowhere, and for each path in backticks. source: the whole source is
    there; an installed program has no tests, to which the matrix of verification problems leads."""
    lines = []
    for file in files:
        text = file.read_text(encoding="utf-8")
        for target in LINK.findall(without_code(text)):
            if re.match(r"[a-z]+:", target) or (not source and target.startswith("../tests/")):
                continue
            path, _, name = target.partition("#")
            place = (file.parent / path).resolve() if path else file
            if not place.is_file():
                lines.append(f"{file.relative_to(root)}: there is no file {target}")
            elif name and name not in anchors(place.read_text(encoding="utf-8")):
                lines.append(f"{file.relative_to(root)}: no heading for {target}")
        lines += [f"{file.relative_to(root)}: there is no file {path}" for path in PATH.findall(text)
                  if source and not (root / path).exists()]
    return lines


def documents(root):
    """All documents of the repository."""
    root = pathlib.Path(root)
    return sorted([*root.glob("*.md"), *(root / "docs").rglob("*.md"), *(root / "inputs").rglob("*.md")])
