"""A mesh whose vertices inside swing, by the plugin swinging_mesh.cpp: what its remap carries must not notice."""
import os

from mudline_case import PROGRAM

PLUGIN = os.environ.get("MUDLINE_SWINGING_MESH",
                        os.path.join(os.path.dirname(PROGRAM), "..", "..", "tests", "verification", "swinging_mesh.so"))


def swinging_mesh(amplitude, period, **motion):
    """Sections of a deck: vertices swing by the share `amplitude` of their smallest side, with `period` [s]; further parts of "mesh motion"."""
    interior = {"type": "swinging", "amplitude": float(amplitude), "period": float(period)}
    return {"plugins": {"files": [os.path.abspath(PLUGIN)]}, "mesh motion": {"interior": interior, **motion}}
