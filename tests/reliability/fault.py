"""What becomes of a run that something is wrong with: shared by the categories of this folder."""

import os
import re
import subprocess
from dataclasses import dataclass

import cpu_limit
from own_lines import own_lines

GOOD = {
    "said": "one line that says what is wrong, and a non-zero exit code",
    "unchanged": "exit code 0 and the numbers of the run without the fault",
    "survived": "continued after a restart, with the numbers of the run without the fault",
    "doubted": "a warning that names the quantity, what it is and what is usual; the run is not stopped",
}
OPEN = {
    "silent": "a mistake about which nothing is said: the deck could be meant as it stands",
}
BAD = {
    "other numbers": "exit code 0 although the numbers are others",
    "crash": "ended by a signal, or with a stack trace",
    "hang": "still running at the time limit",
    "several lines": "more than one line of explanation, or none",
    "carried out": "a file of data did what a program may do: it wrote, started a program, or ended Gmsh",
}


@dataclass
class Outcome:
    """One fault: what was done, the verdict (a key of GOOD, OPEN or BAD), and what the program said or what was compared."""

    fault: str
    verdict: str
    said: str = ""


@dataclass
class Ended:
    """A process that ended: exit code (negative: signal), whether it ran into the limit, output streams."""

    code: int
    timed_out: bool
    stdout: str
    stderr: str


def program():
    return os.environ["MUDLINE"]


def launcher(ranks):
    """The words that start the program on so many ranks; Open MPI without its own frame around every exit code."""
    if ranks == 1:
        return []
    words = os.environ.get("MUDLINE_MPIEXEC", "mpirun --allow-run-as-root --oversubscribe").split()
    return [*words, *(["--quiet"] if "--oversubscribe" in words else []), "-n", str(ranks)]


def arguments_of(folder, deck, overlay, settings):
    """The words that run a deck, a file or a function that gives its text, with an overlay; both are put into the new folder."""
    folder.mkdir()
    (folder / "over.xml").write_text(overlay)
    if callable(deck):
        (folder / "deck.xml").write_text(deck())
        deck = "deck.xml"
    return ["run", "-q", deck, "over.xml", *(word for setting in settings for word in ("--set", setting))]


def start(arguments, folder, ranks=1, limit=120, **options):
    """Runs the program in `folder`; kills it and all that it started after `limit` seconds of CPU time."""
    process = subprocess.Popen(
        [*launcher(ranks), program(), *arguments],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        errors="replace",
        start_new_session=True,
        **options,
    )
    try:
        out, err = cpu_limit.communicate(process, limit)
        return Ended(process.returncode, False, out, err)
    except subprocess.TimeoutExpired as late:
        return Ended(process.returncode, True, late.output, late.stderr)


def judge(fault, ended, numbers_changed=None):
    """The outcome of a fault. numbers_changed(): "" where the results are those without the fault, else what differs;
    None where exit code 0 is wrong whatever the numbers are."""
    lines = own_lines(ended.stderr)
    error_lines = [line for line in lines if not line.startswith("warning:")]
    last = error_lines[-1] if error_lines else ""
    if ended.timed_out:
        return Outcome(fault, "hang", last)
    if ended.code < 0 or ended.code >= 126 or re.search(r"Segmentation|Aborted|terminate called|Backtrace", ended.stderr):
        return Outcome(fault, "crash", last)
    if ended.code == 0:
        changed = "exit code 0" if numbers_changed is None else numbers_changed()
        return Outcome(fault, "other numbers" if changed else "unchanged", changed)
    return Outcome(fault, "said" if len(error_lines) == 1 else "several lines", last)
