"""What a run leaves: files that begin with one stem, results/my_pile."""

from pathlib import Path

import h5py

from mudline.errors import MudlineError
from mudline.fields import FORMAT, Fields, text
from mudline.history import History
from mudline.results import ENDING, Results


class Result:
    """The result that a stem, one of its files, or a folder with a single result means. MudlineError where there is none.

    history, results, fields: what the files hold, read when first asked for; None where there is no such file."""

    def __init__(self, place):
        self.fields_path, self.history_path = find_files(place)
        self.stem = (self.fields_path or self.history_path).with_suffix("")
        self._read = {}

    @property
    def name(self):
        return self.stem.name

    def _once(self, path, reader):
        if path is None or not path.is_file():
            return None
        if path not in self._read:
            self._read[path] = reader(path)
        return self._read[path]

    @property
    def history(self):
        return self._once(self.history_path, History)

    @property
    def results(self):
        return self._once(self.stem.with_name(self.name + ENDING), Results)

    @property
    def fields(self):
        return self._once(self.fields_path, Fields)


def find_files(argument):
    """(field file, history file) that a stem, a file or a folder means; either may be None, not both."""
    path = Path(argument)
    if path.is_dir():
        stems = sorted({p.with_suffix("") for p in path.iterdir() if p.suffix == ".xdmf" or is_result(p)})
        if not stems:
            stems = sorted(p.with_suffix("") for p in path.glob("*.csv") if not p.name.endswith(ENDING))
        if not stems:
            raise MudlineError(f"{argument}: the folder holds no result (.h5 with .xdmf, or .csv)")
        if len(stems) > 1:
            raise MudlineError(
                f"{argument}: the folder holds several results, name one: " + ", ".join(s.name for s in stems)
            )
        stem = stems[0]
    else:
        path = path.with_name(path.name.removesuffix(ENDING))
        stem = path.with_suffix("") if path.suffix in (".h5", ".vtkhdf", ".xdmf", ".csv") else path
    fields, history = (stem.with_name(stem.name + suffix) for suffix in (".h5", ".csv"))
    if path.suffix == ".h5" and not path.is_file():
        raise MudlineError(f"{argument}: there is no such file")
    if not fields.is_file() and not history.is_file():
        of_deck = f"; it is a deck, whose results are mostly results/{path.stem}" if path.suffix == ".xml" else ""
        raise MudlineError(f"{argument}: there is no such result (neither {fields} nor {history} exists){of_deck}")
    return (fields if fields.is_file() else None), (history if history.is_file() else None)


def is_result(path):
    if path.suffix != ".h5":
        return False
    try:
        with h5py.File(path, "r") as file:
            return text(file.attrs.get("format", "")) == FORMAT
    except OSError:
        return False
