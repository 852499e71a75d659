"""Several runs at once, each in a process of its own, which is forked when its turn comes.

A forked process has all that was read and checked, so nothing has to be passed to it. What it prints goes to
files, and from there to the outputs of this process when it has ended, in the order of the runs.
"""

import contextlib
import multiprocessing
import os
import shutil
import signal
import sys
import tempfile
import traceback
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from mmap import mmap
from multiprocessing.connection import wait
from multiprocessing.context import ForkProcess
from types import FrameType
from typing import IO, TextIO

from gradysim.cli.exit_code import FAILED, MISTAKE, OK
from gradysim.cli.interrupt import StopOnInterrupt

Work = Callable[[int, StopOnInterrupt, TextIO], int]
"""Carries out the run with an index, prints to the output it is given, and returns an exit code."""

_FINISHED, _RAISED = 1, 2
"""How a process ends: the run has come to its end, well or not, or something else raised. Else 0."""


@dataclass
class _Running:
    """A run under way."""

    index: int
    process: ForkProcess
    ending: mmap = field(default_factory=lambda: mmap(-1, 1))
    """Shared with the process, which says in it how it ends."""
    output: IO[bytes] = field(default_factory=tempfile.TemporaryFile)
    error_output: IO[bytes] = field(default_factory=tempfile.TemporaryFile)


@dataclass(frozen=True)
class _Printed:
    """What a run that has ended has printed, no longer in files.

    Runs are told in their order: while one takes long, more may wait behind it than may have files open.
    """

    output: bytes
    error_output: bytes


class _PassedOn(StopOnInterrupt):
    """Passes each press of Ctrl-C on to the processes under way; the third one raises KeyboardInterrupt."""

    def __init__(self) -> None:
        super().__init__()
        self.running: list[_Running] = []
        self._pressed_twice = False

    def _on_signal(self, number: int, frame: FrameType | None) -> None:
        if self._pressed_twice:
            signal.signal(number, signal.SIG_IGN)  # or one more would interrupt the end
        for run in self.running:
            with contextlib.suppress(ProcessLookupError):
                os.kill(run.process.pid or os.getpid(), signal.SIGINT)
        if self._pressed_twice:
            raise KeyboardInterrupt
        if self.should_stop():
            self._pressed_twice = True
        else:
            super()._on_signal(number, frame)


class _InAProcess(StopOnInterrupt):
    """Stops also when the process that began this one is gone; says nothing, as that one has said it."""

    def __init__(self) -> None:
        super().__init__(silent=True)
        self._parent = os.getppid()

    def should_stop(self) -> bool:
        return super().should_stop() or os.getppid() != self._parent


def in_processes(work: Work, names: Sequence[str], jobs: int, output: TextIO) -> dict[int, int]:
    """Call `work` for the indices of `names`, `jobs` at a time; return {index: exit code} of those.

    After one that does not end with OK, and after Ctrl-C, none is begun: those have no exit code. Of a
    process that ends before its run does, the error output tells with the name of the run.
    """
    codes: dict[int, int] = {}
    printed: dict[int, _Printed] = {}
    with _PassedOn() as interrupt:
        try:
            begun = 0
            while True:
                while begun < len(names) and len(interrupt.running) < jobs and not any(codes.values()):
                    if interrupt.should_stop():
                        break
                    output.flush()
                    sys.stderr.flush()
                    try:
                        with _held_back(signal.SIGINT):
                            interrupt.running.append(_begin(work, begun, output))
                    except OSError as error:  # there are too many processes or files, or no room for files
                        text = f"{names[begun]}: its process cannot begin: {error.strerror or error}\n"
                        codes[begun] = MISTAKE
                        printed[begun] = _Printed(b"", text.encode())
                    begun += 1
                if not interrupt.running:
                    _show(printed, [], output)
                    return codes
                wait([run.process.sentinel for run in interrupt.running])
                for run in [run for run in interrupt.running if not run.process.is_alive()]:
                    interrupt.running.remove(run)
                    codes[run.index], told = _ending(run, names[run.index])
                    error_output = _content(run.error_output) + told.encode()
                    printed[run.index] = _Printed(_content(run.output), error_output)
                    run.process.close()
                _show(printed, interrupt.running, output)
        finally:
            for run in interrupt.running:
                run.process.kill()
            for run in interrupt.running:
                run.process.join()


def _begin(work: Work, index: int, output: TextIO) -> _Running:
    running = _Running(index, multiprocessing.get_context("fork").Process())
    width = str(shutil.get_terminal_size().columns) if output.isatty() else None
    errors_only = sys.stdout is sys.stderr

    def in_the_process() -> None:
        os.setpgid(0, 0)  # or a terminal would tell it of Ctrl-C, too
        if width is not None:
            os.environ["COLUMNS"] = width
        theirs, sys.stderr = _stream(running.output, 1), _stream(running.error_output, 2)
        sys.stdout = sys.stderr if errors_only else theirs
        try:
            with _InAProcess() as interrupt:
                signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])
                code = work(index, interrupt, theirs)
            theirs.flush()
            sys.stderr.flush()
        except BaseException:
            traceback.print_exc(file=sys.stderr)
            sys.stderr.flush()
            running.ending[0] = _RAISED
            os._exit(FAILED)
        running.ending[0] = _FINISHED
        os._exit(code)

    running.process.run = in_the_process  # type: ignore[method-assign]
    running.process.start()
    return running


def _stream(file: IO[bytes], descriptor: int) -> TextIO:
    """A text stream into that file, which takes what is written to the descriptor, too.

    A line is in the file as soon as it is printed: a process that is killed has no time to write more.
    """
    os.dup2(file.fileno(), descriptor)
    return open(descriptor, "w", buffering=1, encoding="utf-8", errors="backslashreplace", closefd=False)


@contextlib.contextmanager
def _held_back(number: signal.Signals) -> Iterator[None]:
    """Inside, the signal waits: a process that is just forked is not yet ready for it."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, [number])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _ending(run: _Running, name: str) -> tuple[int, str]:
    """Return the exit code of a run whose process has ended, and what to say if that was too early."""
    status = run.process.exitcode or OK
    if run.ending[0] == _FINISHED and status >= 0:
        return status, ""
    if status < 0:
        number = signal.Signals(-status).name if -status in set(signal.Signals) else str(-status)
        how = f"was ended by {number}"
    elif run.ending[0] == _RAISED:
        how = "ended with that exception"
    else:
        how = f"ended with exit status {status}, as by os._exit"
    return FAILED, f"{name}: its process {how}, and left no result\n"


def _content(file: IO[bytes]) -> bytes:
    """All of it; the file is closed."""
    with file:
        file.seek(0)
        return file.read()


def _show(printed: dict[int, _Printed], running: list[_Running], output: TextIO) -> None:
    """Show what the runs before the first one under way have printed."""
    first = min((run.index for run in running), default=None)
    for index in sorted(printed):
        if first is not None and index > first:
            return
        run = printed.pop(index)
        for text, stream in ((run.error_output, sys.stderr), (run.output, output)):
            stream.write(text.decode("utf-8", errors="replace"))
            stream.flush()
