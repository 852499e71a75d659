"""How a command ends."""

import sys
import traceback

from gradysim.cli.standard_output import is_about_output

OK, FAILED, MISTAKE, INTERRUPTED = 0, 1, 2, 130


def say_mistake(mistake: Exception) -> int:
    """Say what the user got wrong, without a traceback, and return the exit code."""
    if is_about_output(mistake):
        raise mistake  # nobody reads it, or the disk is full: `main` deals with it
    print(text_of(mistake), file=sys.stderr)
    return MISTAKE


def text_of(mistake: Exception) -> str:
    """Return what to say. If the system refused something that has no name, say where it was asked for."""
    if not isinstance(mistake, OSError):
        return str(mistake)
    if mistake.filename is not None:
        return f"{mistake.filename}: {mistake.strerror}"
    frames = traceback.extract_tb(mistake.__traceback__)
    where = f" (in {frames[-1].name}, {frames[-1].filename}:{frames[-1].lineno})" if frames else ""
    return f"{mistake.strerror or mistake}{where}"
