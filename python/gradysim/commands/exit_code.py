"""How a command ends."""

import sys

OK, FAILED, MISTAKE, INTERRUPTED = 0, 1, 2, 130


def say_mistake(mistake: Exception) -> int:
    """Say what the user got wrong, without a traceback, and return the exit code."""
    if isinstance(mistake, OSError) and mistake.filename is None:
        raise mistake  # about the output, where nobody reads or the disk is full: `main` deals with it
    print(mistake, file=sys.stderr)
    return MISTAKE
