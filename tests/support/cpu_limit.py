#!/usr/bin/env python3
"""Runs a command until its processes together have used so many seconds of CPU time.

    cpu_limit.py SECONDS COMMAND [ARGUMENT ...]

A busy machine makes a test slow, not wrong: what is limited is the time that the command and all that it starts spend
on processors. A deadlock that waits without computing ends at the wall clock, after WALL_FACTOR times the limit and
WALL_EXTRA seconds. The exit code is the command's (128 + n after signal n), or 124 at a limit.
"""
import os
import pathlib
import signal
import subprocess
import sys
import time

POLL = 2.0  # [s] between two looks at the clocks of all processes, which take some milliseconds each
WALL_FACTOR, WALL_EXTRA = 2, 600
TIMED_OUT = 124
CHILD_SUBREAPER = 36  # Linux, <sys/prctl.h>


def _processes():
    """{pid: (parent, CPU seconds of it and of the children it has waited for)} of all processes; {} without /proc."""
    found, tick = {}, os.sysconf("SC_CLK_TCK")
    for name in os.listdir("/proc") if os.path.isdir("/proc") else []:
        if not name.isdigit():
            continue
        try:
            fields = pathlib.Path("/proc", name, "stat").read_text().rpartition(")")[2].split()
        except OSError:  # it has ended since
            continue
        found[int(name)] = (int(fields[1]), sum(map(int, fields[11:15])) / tick)
    return found


def family(root):
    """{pid: CPU seconds} of a process and of all that live below it."""
    processes = _processes()
    children, waiting, found = {}, [root], {}
    for pid, (parent, _) in processes.items():
        children.setdefault(parent, []).append(pid)
    while waiting:
        pid = waiting.pop()
        found[pid] = processes.get(pid, (0, 0.0))[1]
        waiting += children.get(pid, [])
    return found


def communicate(process, seconds, root=None):
    """process.communicate() (output, errors). At a limit everything below `root` (by default the process) is killed, and
    subprocess.TimeoutExpired is raised."""
    start, root = time.monotonic(), root or process.pid
    while True:
        try:
            return process.communicate(timeout=POLL)
        except subprocess.TimeoutExpired:
            used = family(root)
            if sum(used.values()) <= seconds and time.monotonic() - start <= WALL_FACTOR * seconds + WALL_EXTRA:
                continue
            for pid in used:
                try:
                    if pid != os.getpid():
                        os.kill(pid, signal.SIGKILL)
                except ProcessLookupError:
                    pass
            output, errors = process.communicate()
            raise subprocess.TimeoutExpired(process.args, seconds, output, errors) from None


def run(command, seconds, **options):
    """subprocess.run with captured text, limited in CPU seconds."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)
    output, errors = communicate(process, seconds)
    return subprocess.CompletedProcess(command, process.returncode, output, errors)


def _adopt_orphans():
    """Processes whose parent ends come to this one, so that their time counts."""
    try:
        import ctypes
        ctypes.CDLL(None).prctl(CHILD_SUBREAPER, 1, 0, 0, 0)
    except (ImportError, OSError, AttributeError):
        pass  # not Linux


def main():
    seconds, command = float(sys.argv[1]), sys.argv[2:]
    _adopt_orphans()
    process = subprocess.Popen(command)
    try:
        communicate(process, seconds, os.getpid())
        code = process.returncode
    except subprocess.TimeoutExpired:
        print(f"stopped: more than {seconds:g} s of CPU time, or {WALL_FACTOR * seconds + WALL_EXTRA:g} s by the clock", flush=True)
        code = TIMED_OUT
    used = os.times()
    print(f"CPU time: {used.children_user + used.children_system:.1f} s")
    return code if code >= 0 else 128 - code


if __name__ == "__main__":
    sys.exit(main())
