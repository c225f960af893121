"""Runs the program."""

import os
import shutil
import subprocess
from pathlib import Path

from mudline.deck import Deck, written
from mudline.errors import MudlineError
from mudline.result import Result


def program():
    """The program: the environment's MUDLINE_PROGRAM, `mudline` on the path, or that of the tree that this package is in."""
    here = Path(__file__).resolve()
    built = here.parents[2] / "build" / "release" / "apps" / "mudline" / "mudline"
    for place in (os.environ.get("MUDLINE_PROGRAM"), shutil.which("mudline"), str(built) if built.is_file() else None):
        if place:
            return place
    raise MudlineError("the program mudline is not on the path; the environment variable MUDLINE_PROGRAM may name it")


def run(deck, *overlays, settings=None, name=None, folder="results", ranks=1, options=(), log=None):
    """Runs a deck with overlays (each a Deck, or the path of one) and returns its Result.

    settings: {"stages/push/duration": 2.0}, as --set; name and folder: of the results; options: further words for
    `mudline run`, such as "--restart"; log: a file for what the program prints. MudlineError, with the program's line, where
    the run does not end well. A Deck that was made here is kept beside the results, <name>.deck.xml; relative paths in it start
    there, those of a deck that was read where it was read."""
    settings = {**(settings or {}), "output/folder": str(folder), **({"output/name": name} if name else {})}
    Path(folder).mkdir(parents=True, exist_ok=True)
    files, written_here = [], []
    for k, one in enumerate((deck, *overlays)):
        if isinstance(one, Deck):
            # the same place each time, so that results of the same deck are known as such
            stem = (name or "deck") + (f".{k}" if k else "")
            path = one.folder / f".{stem}.xml" if one.folder else Path(folder) / f"{stem}.deck.xml"
            one.write(path)
            if one.folder:
                written_here.append(path)
            one = path
        files.append(str(one))
    try:
        command = ([] if ranks == 1 else ["mpiexec", "-n", str(ranks)]) + [program(), "run", *files, *options]
        for path, value in settings.items():
            command += ["--set", f"{path}={value if isinstance(value, str) else written(value)[1]}"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    finally:
        for path in written_here:
            path.unlink()
    if log:
        Path(log).write_text(done.stdout + done.stderr, encoding="utf-8")
    if done.returncode != 0:
        lines = [line for line in done.stderr.splitlines() if line.startswith("error: ")] or done.stderr.splitlines()[-1:]
        raise MudlineError((lines[-1] if lines else "no word") + f" (exit code {done.returncode})")
    return Result(Path(folder) / (name or Path(files[0]).name.removeprefix(".").removesuffix(".xml")))
