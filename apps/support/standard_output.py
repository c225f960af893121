"""What the scripts that the program starts do with their standard output."""

import os
import sys


def after_output(main):
    """The exit code of main(), once its text has reached where it should: a full disk, or a terminal that is gone, refuses it."""
    try:
        code = main()
        sys.stdout.flush()
        return code
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # for what is flushed at the end
        told = "the text for the standard output could not be written; is the disk full?"
        print(f"error: {told if error.filename is None else error}", file=sys.stderr)
        return 1
