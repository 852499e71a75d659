"""Guardian of a run: the parent of its process, which ends all processes that the run has started.

A protocol may start programs, which may start others and leave their session and their process group. On
Linux they become children of the guardian when their parent ends, so the guardian kills its children until it
has none. The run stays in the process group of the terminal, because it could not read input otherwise.
"""

import contextlib
import ctypes
import faulthandler
import os
import signal
import sys
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import NoReturn

from gradysim.cli.interrupt import FORWARDED

HAS_GUARDIANS = sys.platform == "linux"

_KILL = getattr(signal, "SIGKILL", signal.SIGTERM)

_END = signal.SIGUSR2 if HAS_GUARDIANS else _KILL
"""Signal that makes a guardian kill its run. The kernel sends it when the command dies."""

_HANDLED = {signal.SIGCHLD, FORWARDED, _END} if HAS_GUARDIANS else set()

_PR_SET_PDEATHSIG, _PR_SET_CHILD_SUBREAPER = 1, 36
"""Options of prctl(2): the signal that a process gets when its parent dies; to inherit orphans."""


def end_with(parent: int, number: int = _KILL) -> None:
    """Send a signal to this process when its parent dies. Linux only."""
    if sys.platform == "linux":
        _set_option(_PR_SET_PDEATHSIG, number)
        if os.getppid() != parent:  # it has already died
            os._exit(1)


def fork_guarded(command: int) -> None:
    """Fork, and return in the child. This process becomes its guardian, and exits as the child does.

    WATCHED must be blocked. The guardian passes FORWARDED on to the child.
    """
    blocked = signal.pthread_sigmask(signal.SIG_BLOCK, _HANDLED)
    _set_option(_PR_SET_CHILD_SUBREAPER, 1)
    end_with(command, _END)
    guardian, run = os.getpid(), os.fork()
    if run == 0:
        end_with(guardian)
        signal.pthread_sigmask(signal.SIG_SETMASK, blocked)
        return
    exit_code = 1
    try:
        exit_code = _exit_code_of(run)
    finally:
        end_children()
        _exit_with(exit_code)


def end(worker: int) -> None:
    """Kill the process of a run, by its guardian if it has one."""
    os.kill(worker, _END)


def _exit_code_of(run: int) -> int:
    """Wait for the end of a run, or end it when the command ends. Return its exit code."""
    while True:
        pid, status = os.waitpid(-1, os.WNOHANG)
        if pid == run:
            return os.waitstatus_to_exitcode(status)
        if pid == 0:
            number = signal.sigwait(_HANDLED)
            if number != signal.SIGCHLD:
                os.kill(run, FORWARDED if number == FORWARDED else _KILL)


@contextlib.contextmanager
def ending_children() -> Iterator[set[int]]:
    """End the children that this process starts inside the block. Linux only.

    Their own children go on if they are orphans by then. Children whose ids are added to the set stay.
    """
    spared = set(children())
    try:
        yield spared
    finally:
        end_children(spared)


def end_children(spared: Collection[int] = ()) -> None:
    """Kill the children of this process until it has none but those to spare and those of other users."""
    with contextlib.suppress(ChildProcessError):
        while True:
            os.waitid(os.P_ALL, 0, os.WEXITED | os.WNOHANG | os.WNOWAIT)  # it raises if there are none
            killed = [child for child in children() if child not in spared and _kill(child)]
            if not killed:
                return
            os.waitpid(killed[0], 0)


def children() -> list[int]:
    """Return the children of this process."""
    found = []
    for entry in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):  # it has ended
            parent = entry.read_bytes().rpartition(b")")[2].split()[1]
            if int(parent) == os.getpid():
                found.append(int(entry.parent.name))
    return found


def _kill(pid: int) -> bool:
    """Kill a process. Return whether this is allowed: it may belong to another user."""
    try:
        os.kill(pid, _KILL)
    except PermissionError:
        return False
    return True


def _exit_with(exit_code: int) -> NoReturn:
    """Exit with a code, or by the signal whose negative number it is."""
    if exit_code < 0:
        import resource

        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))  # the run has left its core file
        faulthandler.disable()
        with contextlib.suppress(OSError, ValueError):
            signal.signal(-exit_code, signal.SIG_DFL)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {-exit_code})
        os.kill(os.getpid(), -exit_code)
    os._exit(exit_code)


def _set_option(option: int, value: int) -> None:
    ctypes.CDLL(None).prctl(option, value)
