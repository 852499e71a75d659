"""How a command ends."""

import errno
import os
import sys
import traceback

OK, FAILED, MISTAKE, INTERRUPTED = 0, 1, 2, 130

_TAKES_NO_MORE = {errno.EPIPE, errno.ENOSPC, errno.EFBIG, errno.EDQUOT, errno.EIO}


def is_about_output(error: BaseException | None) -> bool:
    """Return whether standard output takes no more. An error about another file has the name of that file."""
    return isinstance(error, OSError) and error.errno in _TAKES_NO_MORE and error.filename is None


def abandon_output() -> None:
    """Let nothing more be written to standard output: the interpreter flushes it once more as it ends."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def say_mistake(mistake: Exception) -> int:
    """Say what the user got wrong, without a traceback, and return the exit code."""
    if is_about_output(mistake):
        raise mistake  # `main` deals with it
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
