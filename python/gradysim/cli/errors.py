"""Exit codes, and messages about errors, failures of protocols and crashes."""

import contextlib
import errno
import faulthandler
import os
import sys
import traceback
from pathlib import Path
from types import TracebackType
from typing import TextIO

PACKAGE = Path(__file__).resolve().parent.parent

OK, FAILED, MISTAKE, LOCKED, OVER_MEMORY, INCOMPLETE, INTERRUPTED = 0, 1, 2, 3, 4, 5, 130

_TAKES_NO_MORE = {errno.EPIPE, errno.ENOSPC, errno.EFBIG, errno.EDQUOT, errno.EIO}


def is_about_output(error: BaseException | None) -> bool:
    """Return whether standard output cannot be written. Errors about other files have a file name."""
    return isinstance(error, OSError) and error.errno in _TAKES_NO_MORE and error.filename is None


def abandon_output() -> None:
    """Discard further standard output. The interpreter flushes it again when it exits."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def report_error(error: Exception) -> int:
    """Print an error of the user without a traceback, and return the exit code."""
    if is_about_output(error):
        raise error  # `main` handles it
    print(text_of(error), file=sys.stderr)
    return MISTAKE


def text_of(error: Exception) -> str:
    """Return the message. An error of the system without a file name gets the line that caused it."""
    if not isinstance(error, OSError):
        return str(error)
    if error.filename is not None:
        return f"{error.filename}: {error.strerror}"
    frames = traceback.extract_tb(error.__traceback__)
    where = f" (in {frames[-1].name}, {frames[-1].filename}:{frames[-1].lineno})" if frames else ""
    return f"{error.strerror or error}{where}"


def report_crashes() -> None:
    """Make the interpreter print the current line on a crash; for example, in a C library."""
    with contextlib.suppress(OSError, ValueError):  # standard error without a file descriptor
        if not faulthandler.is_enabled():
            faulthandler.enable()


def print_failure(failure: BaseException, file: TextIO) -> None:
    """Print `failure` with its notes, without the frames of gradysim above the user's code.

    A KeyboardInterrupt without notes came outside of callbacks. It is not printed.
    """
    if isinstance(failure, KeyboardInterrupt) and not hasattr(failure, "__notes__"):
        return
    from gradysim.protocol.errors import (
        CommunicationException,
        MasslessMobilityException,
        NativeProtocolError,
        TimerException,
    )
    from gradysim.replay.sink import OutputError
    from gradysim.sitl import SitlError

    without_frames = (NativeProtocolError, OutputError, SitlError)  # no code of the user led to these
    refused_commands = (CommunicationException, MasslessMobilityException, TimerException)
    frames = None if isinstance(failure, without_frames) else from_users_code(failure.__traceback__)
    told = traceback.TracebackException(type(failure), failure, frames)
    if isinstance(failure, refused_commands):  # in integrated mode no frames show where they are raised
        cut_behind_users_code(told.stack)
    told.print(file=file)


def cut_behind_users_code(stack: traceback.StackSummary) -> None:
    """Remove frames of gradysim that the user's code called from the end of `stack`."""
    last = max((index for index, frame in enumerate(stack) if not is_ours(frame.filename)), default=None)
    if last is not None:
        del stack[last + 1 :]


def from_users_code(frames: TracebackType | None) -> TracebackType | None:
    """Return `frames` from the first one outside this package; all of them if there is none."""
    first = frames
    while first is not None and is_ours(first.tb_frame.f_code.co_filename):
        first = first.tb_next
    return first if first is not None else frames


def is_ours(filename: str) -> bool:
    """Return whether a source file belongs to the package gradysim."""
    return Path(filename).is_relative_to(PACKAGE)
