"""The ball in saturated clay of tests/mpi, on triangles that are remeshed during the run."""
import os
import re

from mudline_case import ROOT, deck_text

BALL = os.path.join(ROOT, "tests", "mpi", "ball_in_clay.xml")
# sides of a new boundary are up to 1.5 times as long as wanted: below that there is a new mesh whenever the steps are over
ALWAYS = 0.1
WALL = {"wall size": 0.02}
FOCUS = {"focus": "ball", "size near focus": 0.02, "near distance": 0.11, "growth": 0.3}
ADAPTIVE = {"size": "adaptive", "smallest size": 0.02, "largest size": 0.2}
ESTIMATE = {"error estimate": True, "target error": 0.2}


def remeshing(every, more=(), boundary=(), output=()):
    """An overlay; `more`: of the section remeshing."""
    inside = {"when side above": ALWAYS, "least steps": every, "when quality below": 0.0}
    inside.update(more)
    parts = {"remeshing": inside}
    if boundary:
        parts["boundary"] = dict(boundary)
    entries = {"mesh motion": parts}
    if output:
        entries["output"] = dict(output)
    return deck_text("remeshing", entries)


def ball():
    """The text of the deck."""
    with open(BALL) as file:
        text = file.read()
    return re.sub(r'    <ParameterList name="probes">.*?</ParameterList>\n', "", text, flags=re.S).replace("quad9", "tri6")
