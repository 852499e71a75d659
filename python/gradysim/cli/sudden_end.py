"""What ends the interpreter in the middle of a run, without an exception: os._exit, or a crash."""

import contextlib
import faulthandler
import os
import sys
import traceback
from collections.abc import Callable, Iterator
from types import FrameType
from typing import NoReturn

from gradysim.cli.exit_code import FAILED

_ERROR_OUTPUT = 2  # the file descriptor
_SHOW_CURSOR = b"\x1b[?25h"
"""A progress bar hides it, until the bar is gone."""


@contextlib.contextmanager
def told_of_exit(name: str, say_unfinished: Callable[[], None]) -> Iterator[None]:
    """Inside, os._exit tells that the run `name` ends, and where, and ends the process with FAILED.

    A status of 0 would say that all is well. A process that a protocol has forked ends as it wants to.
    """
    own_process, at_once = os.getpid(), os._exit

    def tell_and_exit(status: int) -> NoReturn:
        if os.getpid() != own_process:
            at_once(status)
        with contextlib.suppress(Exception):  # it ends in any case
            sys.stdout.flush()
            if sys.stderr.isatty():
                os.write(_ERROR_OUTPUT, b"\r" + _SHOW_CURSOR)
            print(f"{name}: os._exit({status}) ends the process, and leaves no result", file=sys.stderr)
            sys.stderr.writelines(traceback.format_list(_users_frames(sys._getframe(1))))
            say_unfinished()
            sys.stderr.flush()
        at_once(FAILED)

    os._exit = tell_and_exit
    try:
        yield
    finally:
        os._exit = at_once


def tell_of_crashes() -> None:
    """Let the interpreter say on the error output in which line it crashes, as in a library written in C."""
    with contextlib.suppress(OSError, ValueError):  # an error output that is no file
        if not faulthandler.is_enabled():
            faulthandler.enable()


def _users_frames(frame: FrameType) -> traceback.StackSummary:
    """Return the innermost frames, up to the first one of this package."""
    from gradysim.cli.failure import is_ours

    stack = traceback.extract_stack(frame)
    last = max((index for index, line in enumerate(stack) if is_ours(line.filename)), default=-1)
    return traceback.StackSummary.from_list(stack[last + 1 :])
