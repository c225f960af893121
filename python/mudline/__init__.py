"""mudline from Python: decks as objects, runs, and what they leave.

    import mudline

    deck = mudline.Deck.based_on("pile", diameter="0.5 m", depth="4 m")
    deck["stages/set-up/duration"] = "30 days"
    result = mudline.run(deck, name="my_pile")
    result.results.value("pile", "resistance", stage="push")     # [N]
    result.history["body/pile/position y"]                       # numpy array, a row for each step
    result.fields.fields(-1)["excess pore pressure"].values      # at the nodes, of the last output

It needs numpy and h5py; history.frame() needs pandas, fields.grid() needs pyvista. Quantities are in SI units, pore
pressure is positive in compression, as in the files (docs/output_format.md).
"""

from mudline.deck import Deck, Expression
from mudline.errors import MudlineError
from mudline.fields import Field, Fields
from mudline.history import History
from mudline.mesh_import import import_mesh
from mudline.program import program, run
from mudline.result import Result
from mudline.results import Results

__all__ = ["Deck", "Expression", "Field", "Fields", "History", "MudlineError", "Result", "Results", "import_mesh", "program", "run"]
