"""The process in which a run lets Gmsh remesh the region: caught while it works, so that signals can be sent just then."""
import os
import signal
import time


def children(process):
    """Processes whose parent it is."""
    found = []
    try:
        for name in os.listdir(f"/proc/{process}/task"):
            with open(f"/proc/{process}/task/{name}/children") as file:
                found += [int(word) for word in file.read().split()]
    except (FileNotFoundError, ProcessLookupError):
        pass  # it has ended
    return found


def stands_still(process):
    """Stops a process at once; False where it had ended."""
    try:
        os.kill(process, signal.SIGSTOP)
        for _ in range(10000):
            with open(f"/proc/{process}/stat") as file:
                state = file.read().rpartition(")")[2].split()[0]
            if state in "TZX":
                return state == "T"
            time.sleep(0.001)
    except (ProcessLookupError, FileNotFoundError):
        pass
    return False


def caught(running, of_mpi):
    """The process of a remeshing, which stands still; None where the run (subprocess.Popen) has ended. `of_mpi`: its other children."""
    while running.poll() is None:
        for child in children(running.pid):
            if child not in of_mpi and stands_still(child):
                return child
        time.sleep(0.001)
    return None
