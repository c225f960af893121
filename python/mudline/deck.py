"""Decks as objects that read and write Teuchos XML."""

import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from mudline.errors import MudlineError

# Types of values that an entry takes without another type of its own: a text for a number is an expression.
FITS = {"double": ("double", "int", "string"), "int": ("int", "string"),
        "Array(double)": ("Array(double)", "Array(int)", "Array(string)"), "Array(int)": ("Array(int)", "Array(string)")}
TYPES = {bool: "bool", int: "int", float: "double", str: "string"}
WITH_UNIT = re.compile(r"\s*[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?\s*[A-Za-z%]")


class Expression:
    """An expression of the deck's variables as a number: Expression("2*diameter")."""

    def __init__(self, text):
        self.text = text


def written(value):
    """(type, text) of a value: bool, int, float, text, Expression, or a list of numbers or of texts. A text such as "30 days"
    is a number with a unit, as it is for --set."""
    if isinstance(value, Expression):
        return "double", value.text
    if isinstance(value, str) and WITH_UNIT.match(value):
        return "double", value
    if isinstance(value, (list, tuple)):
        kinds = {type(item) for item in value}
        inner = "string" if str in kinds else "int" if kinds == {int} else "double"
        return f"Array({inner})", "{" + ", ".join(written(item)[1] for item in value) + "}"
    for kind, name in TYPES.items():
        if isinstance(value, kind):
            return name, str(value).lower() if kind is bool else repr(float(value)) if kind is float else str(value)
    raise MudlineError(f"{value!r} is no value of a deck: allowed are bool, int, float, str, and lists of numbers or texts")


def read_value(kind, text):
    """A value as Python has it; the text itself where it is an expression or has a unit."""
    if kind.startswith("Array"):
        return [read_value(kind[6:-1], item.strip()) for item in text.strip().strip("{}").split(",") if item.strip()]
    if kind == "bool" and text.strip() in ("true", "false"):
        return text.strip() == "true"
    try:
        return {"int": int, "double": float}.get(kind, str)(text)
    except ValueError:
        return text


class Deck:
    """A deck, or an overlay: sections and parameters by path, deck["stages/push/duration"] = 2.0. Comments are kept."""

    def __init__(self, title="deck"):
        self.root = ElementTree.Element("ParameterList", name=title)
        self.folder = None  # of the file that it was read from; relative paths in it start there

    @classmethod
    def read(cls, path):
        deck = cls()
        parser = ElementTree.XMLParser(target=ElementTree.TreeBuilder(insert_comments=True))
        try:
            deck.root = ElementTree.parse(path, parser).getroot()
        except OSError as error:
            raise MudlineError(f"{path}: cannot be read: {error.strerror}") from None
        except ElementTree.ParseError as error:
            raise MudlineError(f"{path}: no XML: {error}") from None
        if deck.root.tag != "ParameterList":
            raise MudlineError(f"{path}: no deck: its first element is '{deck.root.tag}', not 'ParameterList'")
        deck.folder = Path(path).resolve().parent
        return deck

    @classmethod
    def based_on(cls, kind, **numbers):
        """A deck on one of the program's own, as `mudline new` writes it, with these of its numbers: diameter="0.5 m"."""
        deck = cls(f"my {kind}")
        deck["based on"] = kind
        for name, value in numbers.items():
            deck["variables/" + name] = value
        return deck

    def _find(self, path):
        """The element of an entry; None where there is none."""
        entry = self.root
        for name in path.split("/"):
            entry = next((inner for inner in entry if inner.get("name") == name), None)
            if entry is None:
                return None
        return entry

    def _section(self, path, wanted):
        """The element of a section, for an entry that is wanted in it; those of the path that are missing are made."""
        if not path:
            return self.root
        parent, _, name = path.rpartition("/")
        entry = self._find(path)
        if entry is None:
            return ElementTree.SubElement(self._section(parent, wanted), "ParameterList", name=name)
        if entry.tag != "ParameterList":
            raise MudlineError(f"{wanted}: '{name}' is a parameter; it has no entries of its own")
        return entry

    def __contains__(self, path):
        return self._find(path) is not None

    def __getitem__(self, path):
        """The value of a parameter, or the names in a section. KeyError where there is none."""
        entry = self._find(path)
        if entry is None:
            raise KeyError(path)
        if entry.tag == "ParameterList":
            return [inner.get("name") for inner in entry if inner.tag in ("Parameter", "ParameterList")]
        return read_value(entry.get("type"), entry.get("value"))

    def __setitem__(self, path, value):
        """Sets a parameter; sections that are missing are made. The type stays where the value fits it."""
        parent, _, name = path.rpartition("/")
        section, entry = self._section(parent, path), self._find(path)
        if entry is not None and entry.tag == "ParameterList":
            raise MudlineError(f"{path}: a section; only parameters can be set")
        kind, text = written(value)
        if entry is None:
            ElementTree.SubElement(section, "Parameter", name=name, type=kind, value=text)
            return
        if kind not in FITS.get(entry.get("type"), ()):
            entry.set("type", kind)
        entry.set("value", text)

    def __delitem__(self, path):
        entry = self._find(path)
        if entry is None:
            raise KeyError(path)
        self._section(path.rpartition("/")[0], path).remove(entry)

    def text(self):
        """The deck as XML."""
        ElementTree.indent(self.root)
        return ElementTree.tostring(self.root, encoding="unicode") + "\n"

    def write(self, path):
        Path(path).write_text(self.text(), encoding="utf-8")
