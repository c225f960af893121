"""Every deck that is shipped, as it is meant to be run."""
import os
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent

# how an overlay says in its head what it is laid over: a deck of its folder, or with a path one from inputs
OVER = re.compile(r"(?:Laid over|Overlay for|to be given after) ([\w/]+)\.xml(?:, after (\w+)\.xml)?")


def needs_result(path):
    """Whether a deck starts from the result of another one, as in tests/regression/test_pile.py."""
    return 'value="from result"' in pathlib.Path(path).read_text()


def shipped_decks():
    """{name: files} of all decks of a run; sweeps and decks of material points are none, nor are those that need a plugin built first."""
    inputs = pathlib.Path(ROOT, "inputs")
    decks = {}
    for path in sorted(inputs.rglob("*.xml")):
        if inputs / "plugins" in path.parents:  # tests/plugins builds and runs them
            continue
        text = path.read_text()
        if needs_result(path):
            continue
        over = OVER.search(re.sub(r"\s+", " ", text[:text.index("-->")]))
        if not over and not re.search(r'^  <ParameterList name="mesh">', text, flags=re.M):
            continue
        below = [str((inputs if "/" in name else path.parent) / (name + ".xml"))
                 for name in over.groups() if name] if over else []
        decks[os.path.relpath(path.with_suffix(""), inputs)] = below + [str(path)]
    return decks
