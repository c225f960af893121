"""One wrong deck: the valid base.xml with one thing spoilt, and the one line the program must answer.

The message is written without the position of a deck: "deck.xml:LINE: " is put before it, where LINE is found by looking
for `at` in the spoilt deck (by default the text that was put in), so that base.xml may be edited freely.
"""
import os

HERE = os.path.dirname(os.path.abspath(__file__))
with open(os.path.join(HERE, "base.xml")) as _file:
    BASE = _file.read()


def parameter(name, kind, value):
    return f'<Parameter name="{name}" type="{kind}" value="{value}"/>'


def section(name):
    return f'<ParameterList name="{name}">'


def whole(name, text=BASE):
    """The text of a section with its end tag."""
    begin = text.index(section(name))
    begin = text.rindex("\n", 0, begin) + 1
    indent = text[begin:].split("<")[0]
    end = text.index(f"\n{indent}</ParameterList>\n", begin)
    return text[begin:end + len(f"\n{indent}</ParameterList>\n")]


def line_of(text, deck=BASE):
    return deck[:deck.index(text)].count("\n") + 1


class Wrong:
    def __init__(self, name, changes, message, at=None, line=True, settings=(), files=(), ranks=(1,), base=BASE):
        self.name, self.message, self.settings, self.files, self.ranks = name, message, settings, files, ranks
        self.text = base
        if changes and isinstance(changes[0], str):
            changes = [changes]
        for old, new in changes:
            if old not in self.text:
                raise ValueError(f"{name}: the valid deck does not hold {old!r}")
            self.text = self.text.replace(old, new, 1)
        self.expected = "error: " + message
        if line:
            number = line_of(at if at is not None else changes[0][1], self.text)
            self.expected = f"error: deck.xml:{number}: {message}"
