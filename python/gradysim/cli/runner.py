"""Executor of runs: each one in a fresh fork of this process, so that no run sees what another one left.

A forked process has the engine, the scenario and the protocols loaded, so nothing has to be passed to it.
"""

import contextlib
import ctypes
import gc
import io
import os
import pickle
import shutil
import signal
import sys
import threading
import traceback
from collections import deque
from collections.abc import Callable, Collection, Iterable, Iterator
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from tempfile import TemporaryFile
from typing import IO, Any, NoReturn, ParamSpec, TextIO, TypeVar

from gradysim.cli.interrupt import WATCHED, StopOnInterrupt

P = ParamSpec("P")
T = TypeVar("T")

_WRITTEN_TO = (io.TextIOWrapper, io.BufferedWriter)

_PR_SET_PDEATHSIG = 1
"""Of prctl(2): the signal that the kernel sends to a process when its parent dies."""

_prctl = ctypes.CDLL(None).prctl if sys.platform == "linux" else None


class WorkerError(Exception):
    """The process of a run could not start, or ended before the run did.

    Attributes:
        exit_code: What the process exited with, the negative number of the signal that killed it, or None if
            it did not start.
    """

    def __init__(self, text: str, exit_code: int | None) -> None:
        super().__init__(text)
        self.exit_code = exit_code


class RunFuture(Future[T]):
    """The result of a task to come. Its `result()` lets the executor work, which has no thread for that.

    Attributes:
        printed: What the task printed to standard output and to the error output; empty if that was not
            captured.
    """

    def __init__(self, executor: "ForkExecutor") -> None:
        super().__init__()
        self.printed: tuple[bytes, ...] = ()
        self._executor = executor

    def result(self, timeout: float | None = None) -> T:
        """Wait for the task to end, and return what it returned or raise what it raised."""
        while not self.done():
            self._executor.advance()
        return super().result(timeout)


@dataclass(frozen=True)
class _Worker:
    """A process under way, and the files that it writes to."""

    future: RunFuture[Any]
    returned: IO[bytes]
    """The end of a pipe: here that to read from, in the worker that to write to."""
    printed: tuple[IO[bytes], ...]
    """Where its standard output and its error output go, if they are captured."""


class ForkExecutor(Executor):
    """Calls each task in a process of its own that is forked when its turn comes, `jobs` at a time.

    Tasks start in the order in which they were submitted. A process that dies fails its own task only, and so
    does an exception, whose traceback is printed. What a task returns has to fit into a pipe: 64 kB at most.
    Workers end with this process. After Ctrl-C no task starts: those that wait are canceled.

    What tasks print is captured where several print at once, or where the streams of this process are not
    files: see `RunFuture.printed`. Where the system cannot fork, tasks are called in this process.
    """

    def __init__(self, jobs: int, interrupt: StopOnInterrupt) -> None:
        """Prepare for `jobs` tasks at a time; `interrupt` passes Ctrl-C on to the workers."""
        self._jobs = jobs
        self._interrupt = interrupt
        self._captures = jobs > 1 or not (_is_file(sys.stdout) and _is_file(sys.stderr))
        self._waiting: deque[tuple[RunFuture[Any], Callable[[], Any]]] = deque()
        self._workers: dict[int, _Worker] = {}
        self._files = _open_files()
        gc.freeze()  # a collection in a worker would copy the pages of all that is loaded
        interrupt.workers = self._workers.keys()

    def submit(self, fn: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> RunFuture[T]:
        """Let `fn` be called with these arguments when its turn comes."""
        future: RunFuture[T] = RunFuture(self)
        self._waiting.append((future, lambda: fn(*args, **kwargs)))
        return future

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Kill the workers that still run. Results that are wanted have to be asked for before."""
        while self._workers:
            pid, worker = self._workers.popitem()
            with contextlib.suppress(ProcessLookupError, ChildProcessError):
                os.kill(pid, signal.SIGKILL)
                os.waitpid(pid, 0)
            _finish(worker, -signal.SIGKILL)

    def advance(self) -> None:
        """Start the tasks that there is room for, and wait for the end of a worker."""
        if self._interrupt.should_stop():
            for future, _ in self._waiting:
                future.cancel()
        while self._waiting and len(self._workers) < self._jobs:
            future, call = self._waiting.popleft()
            if future.set_running_or_notify_cancel():
                self._start(future, call)
        if self._workers:
            pid, status = os.wait()
            worker = self._workers.pop(pid, None)  # a module of the user may have started processes, too
            if worker is not None:
                _finish(worker, os.waitstatus_to_exitcode(status))

    def _start(self, future: RunFuture[Any], call: Callable[[], Any]) -> None:
        if not hasattr(os, "fork"):
            try:
                future.set_result(call())
            except Exception as error:
                future.set_exception(error)
            return
        for file in (sys.stdout, sys.stderr, *self._files):  # or each worker would write it once more
            _flush(file)
        with contextlib.ExitStack() as files:
            try:
                reading, writing = os.pipe()
                theirs = files.enter_context(open(reading, "rb"))
                ours = files.enter_context(open(writing, "wb"))
                printed = tuple(
                    files.enter_context(TemporaryFile()) for _ in range(2 if self._captures else 0)
                )
                with _blocked(*WATCHED):  # until the worker can handle them
                    parent, pid = os.getpid(), os.fork()
                    if pid == 0:
                        self._work(_Worker(future, ours, printed), call, parent)
                    self._workers[pid] = _Worker(future, theirs, printed)
                ours.close()
            except OSError as error:  # there are too many processes or files, or no room for files
                problem = f"the process cannot start: {error.strerror or error}"
                future.set_exception(WorkerError(problem, None))
            else:
                files.pop_all()  # `_finish` closes them

    def _work(self, worker: _Worker, call: Callable[[], Any], parent: int) -> NoReturn:
        """Be the worker: call the task, leave what it returns or raises in a file, and exit."""
        code = 1
        try:
            _end_with(parent)
            ident = threading.get_ident()
            os.register_at_fork(after_in_child=partial(_end_with_worker, os.getpid(), ident))
            if worker.printed:
                _redirect(*worker.printed)
            self._interrupt.become_worker()
            signal.pthread_sigmask(signal.SIG_UNBLOCK, WATCHED)
            value = call()
            signal.pthread_sigmask(signal.SIG_BLOCK, WATCHED)
            for file in (sys.stdout, sys.stderr, *self._files, *_open_files()):
                _flush(file)
            pickle.dump(value, worker.returned)
            worker.returned.flush()
            code = 0
        except BaseException:
            traceback.print_exc()
        finally:
            os._exit(code)


def _finish(worker: _Worker, exit_code: int) -> None:
    """Pass on what came out of a worker that has ended."""
    worker.future.printed = tuple(_content(file) for file in worker.printed)
    with worker.returned as pipe:
        os.set_blocking(pipe.fileno(), False)  # a process that the worker began may still hold the other end
        returned = pipe.read() if exit_code == 0 else None
    if returned:
        worker.future.set_result(pickle.loads(returned))
    elif exit_code < 0:
        number = -exit_code
        name = signal.Signals(number).name if number in set(signal.Signals) else f"signal {number}"
        worker.future.set_exception(WorkerError(f"the process was killed by {name}", exit_code))
    else:
        worker.future.set_exception(WorkerError(f"the process exited with status {exit_code}", exit_code))


def _content(file: IO[bytes]) -> bytes:
    """Return all of a file, and close it."""
    with file:
        file.seek(0)
        return file.read()


def _is_file(stream: TextIO) -> bool:
    """Return whether a stream has a file descriptor, which a forked process can write to as well."""
    try:
        stream.fileno()
    except (OSError, AttributeError):
        return False
    return True


def _redirect(output: IO[bytes], error_output: IO[bytes]) -> None:
    """Let all that this process prints go to these files, and let it read nothing.

    A line is in the file as soon as it is printed: a process that is killed has no time to write more.
    """
    if sys.stdout.isatty():
        os.environ["COLUMNS"] = str(shutil.get_terminal_size().columns)
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    sys.stdout, sys.stderr = _stream(output, 1), _stream(error_output, 2)


def _stream(file: IO[bytes], descriptor: int) -> TextIO:
    os.dup2(file.fileno(), descriptor)
    return open(descriptor, "w", buffering=1, encoding="utf-8", errors="backslashreplace", closefd=False)


def _open_files() -> list[io.IOBase]:
    """Return the files that text or bytes may be written to, of those opened since `gc.freeze()`."""
    return [each for each in gc.get_objects() if issubclass(type(each), _WRITTEN_TO)]


def _flush(file: IO[Any] | io.IOBase) -> None:
    with contextlib.suppress(OSError, ValueError):  # a file that takes no more, or that is closed
        file.flush()


def _end_with(parent: int) -> None:
    """Let this process be killed when its parent dies, however that happens. Linux only."""
    if _prctl is not None:
        _prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
        if os.getppid() != parent:  # it has died already
            os._exit(1)


def _end_with_worker(worker: int, thread: int) -> None:
    """Let a process that a callback forked be killed when the worker ends. Linux only.

    If it returns from the callback, it goes on with the run, and may wait for threads that it does not have.
    The kernel sends the signal when the forking thread ends, so threads of the user are not concerned.
    """
    if _prctl is not None and os.getppid() == worker and threading.get_ident() == thread:
        _prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


def keep_from_forks(files: Iterable[Path]) -> None:
    """Let processes that callbacks fork from now on write nothing to these files. Linux only.

    They inherit the descriptors and what is buffered: both processes would write it.
    """
    names = {os.path.realpath(file) for file in files}
    os.register_at_fork(after_in_child=partial(_leave_files, names))


def _leave_files(names: Collection[str]) -> None:
    with contextlib.suppress(OSError):  # no /proc
        for descriptor in os.listdir("/proc/self/fd"):
            with contextlib.suppress(OSError):  # that of the directory itself, which is closed
                if os.readlink(f"/proc/self/fd/{descriptor}") in names:
                    os.dup2(os.open(os.devnull, os.O_WRONLY), int(descriptor))


@contextlib.contextmanager
def _blocked(*signals: signal.Signals) -> Iterator[None]:
    """Inside, these signals wait."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, signals)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
