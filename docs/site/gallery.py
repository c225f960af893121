"""The gallery: all decks of `inputs`, each with the first sentence of its comment, its picture and the command."""
import os
import re
import sys

# Decks whose picture has another name than the deck
PICTURES = {
    "cpt/clay_and_sand": "cone_through_layers", "cpt/faceted": "faceted_cone", "cpt/guide_tube": "penetration_meshes",
    "footing/tresca_penetration": "strip_penetration", "measurements/kaolin": "measured_kaolin",
    "measurements/kaolin_cone": "measured_kaolin_cone", "measurements/sand": "measured_sand", "pile/clay": "pile",
    "pile/deep": "pile_wall", "pile/drainage": "pile_drainage", "pile/tapered": "tapered_pile",
    "space/torpedo": "torpedo_capacity", "torpedo/clay": "torpedo", "torpedo/impact_velocity": "torpedo_depth",
}

# What a deck is laid over, where shipped_decks() does not run it as the documents do
LAID_OVER = {"torpedo/deep_torpedo": ["torpedo/tresca", "torpedo/remeshing"]}


def title(text):
    """First sentence of the first comment."""
    words = re.sub(r"\s+", " ", re.search(r"<!--(.*?)-->", text, re.DOTALL)[1]).strip()
    return re.split(r"(?<=[^.\d])[.:;] (?=[A-Z])", words)[0].rstrip(".").strip()


def command(root, files, text):
    """How a deck is run; `files` are those of the deck itself and of what it is laid over."""
    names = " ".join(os.path.relpath(file, root) for file in files)
    if re.search(r'^  <Parameter name="deck"', text, re.MULTILINE):
        return "sweep " + names
    if re.search(r'^  <ParameterList name="tests"', text, re.MULTILINE):
        return "point " + names
    return "run " + names


def entry(root, path, files):
    name = os.path.relpath(path.with_suffix(""), root / "inputs")
    text = path.read_text(encoding="utf-8")
    lines = [f"### {name}", "", title(text) + ".", ""]
    picture = root / "docs" / "pictures" / (PICTURES.get(name, path.stem) + ".png")
    if name in PICTURES or picture.exists():
        lines += [f"![{name}](pictures/{picture.name})", ""]
    lines += [f"    ./mudline {command(root, files, text)}", "", f"[The deck](../inputs/{name}.xml)", ""]
    return lines


def page(root):
    """Markdown that follows the heading of docs/gallery.md."""
    sys.path.insert(0, str(root / "tests" / "plausibility"))
    from shipped_decks import shipped_decks
    laid_over = shipped_decks()
    for name, below in LAID_OVER.items():
        laid_over[name] = [str(root / "inputs" / f"{deck}.xml") for deck in [*below, name]]
    lines, folder = [], ""
    decks = [path for path in sorted((root / "inputs").rglob("*.xml"))
             if root / "inputs" / "plugins" not in path.parents]
    unknown = set(PICTURES) - {os.path.relpath(path.with_suffix(""), root / "inputs") for path in decks}
    if unknown:
        raise ValueError(f"pictures of decks that are not there: {sorted(unknown)}")
    for path in decks:
        if path.parent.name != folder:
            folder = path.parent.name
            lines += [f"## {folder.replace('_', ' ')}", ""]
        lines += entry(root, path, laid_over.get(os.path.relpath(path.with_suffix(""), root / "inputs"), [str(path)]))
    return "\n".join(lines)
