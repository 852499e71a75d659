"""Executor of calls: each has a fresh fork of this process, so that they do not affect each other.

A forked process has the engine, the scenarios and the protocols loaded. Nothing has to be passed to it.
"""

import contextlib
import gc
import io
import os
import pickle
import shutil
import signal
import sys
import traceback
from collections import deque
from collections.abc import Callable, Collection, Iterable, Iterator
from concurrent.futures import Executor, Future
from functools import partial
from pathlib import Path
from tempfile import TemporaryFile
from typing import IO, Any, NamedTuple, NoReturn, ParamSpec, TextIO, TypeVar

from gradysim.cli.guardian import HAS_GUARDIANS, end, fork_guarded
from gradysim.cli.interrupt import WATCHED, StopOnInterrupt

P = ParamSpec("P")
T = TypeVar("T")

_WRITTEN_TO = (io.TextIOWrapper, io.BufferedWriter)


class WorkerError(Exception):
    """The process of a call could not start, or ended before the call did.

    Attributes:
        exit_code: Exit code of the process, or the negative number of the signal that killed it. None if it
            did not start.
    """

    def __init__(self, text: str, exit_code: int | None) -> None:
        super().__init__(text, exit_code)  # both, so that it can be pickled
        self.exit_code = exit_code

    def __str__(self) -> str:
        return str(self.args[0])


class ForkFuture(Future[T]):
    """Future of a call. `result()` runs the executor, which has no thread: it calls `advance`.

    Attributes:
        printed: Output of the call to standard output and standard error; empty if it was not captured.
    """

    def __init__(self, advance: Callable[[], None]) -> None:
        super().__init__()
        self.printed: tuple[bytes, ...] = ()
        self._advance = advance

    def result(self, timeout: float | None = None) -> T:
        """Wait for the call to end, and return what it returned or raise what it raised."""
        while not self.done():
            self._advance()
        return super().result(timeout)


class _Worker(NamedTuple):
    """A running process: one end of the pipe of its return value, and its output if that is captured."""

    future: ForkFuture[Any]
    returned: IO[bytes]
    printed: Collection[IO[bytes]]


class ForkExecutor(Executor):
    """Executes each call in a separate forked process, `jobs` at a time.

    Calls start in the order of submission. A process that dies fails its own call only. So does an exception,
    whose traceback is printed. The return value of a call must fit into a pipe: 64 kB at most. On Linux,
    workers end with this process, and what calls start ends with their worker.

    The output of calls is captured if several print at once, or if the streams of this process are not files:
    see `ForkFuture.printed`. If the system cannot fork, calls are executed in this process.
    """

    def __init__(self, jobs: int, interrupt: StopOnInterrupt, *, captures: bool = False) -> None:
        """Prepare for `jobs` calls at a time.

        `interrupt` forwards presses to the workers. With `captures`, output is captured in all cases.
        """
        self._jobs = jobs
        self._interrupt = interrupt
        self._captures = captures or jobs > 1 or not (_is_file(sys.stdout) and _is_file(sys.stderr))
        self._waiting: deque[tuple[ForkFuture[Any], Callable[[], Any]]] = deque()
        self._workers: dict[int, _Worker] = {}
        self._files = _open_files()
        interrupt.workers = self._workers.keys()

    def submit(self, fn: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> ForkFuture[T]:
        """Submit a call of `fn` with these arguments. It starts at once if there is room."""
        future: ForkFuture[T] = ForkFuture(self.advance)
        self._waiting.append((future, partial(fn, *args, **kwargs)))
        self._start_waiting()
        return future

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Kill the running workers. Fetch wanted results before."""
        while self._workers:
            pid, worker = self._workers.popitem()
            with contextlib.suppress(ProcessLookupError, ChildProcessError):
                end(pid)
                os.waitpid(pid, 0)
            _finish(worker, -signal.SIGKILL)

    def advance(self) -> None:
        """Wait for the end of a worker, and start calls that wait for room."""
        self._start_waiting()
        if self._workers:
            pid, status = os.wait()
            worker = self._workers.pop(pid, None)  # the user's modules may have started processes, too
            if worker is not None:
                _finish(worker, os.waitstatus_to_exitcode(status))

    def _start_waiting(self) -> None:
        while self._waiting and len(self._workers) < self._jobs:
            future, call = self._waiting.popleft()
            if future.set_running_or_notify_cancel():
                self._start(future, call)

    def _start(self, future: ForkFuture[Any], call: Callable[[], Any]) -> None:
        if not hasattr(os, "fork"):
            try:
                future.set_result(call())
            except Exception as error:
                future.set_exception(error)
            return
        for file in (sys.stdout, sys.stderr, *self._files):  # or each worker would write the buffer again
            _flush(file)
        gc.freeze()  # or a collection in a worker would copy the pages of all objects
        with contextlib.ExitStack() as files:
            try:
                theirs, ours = (
                    files.enter_context(open(descriptor, mode))
                    for descriptor, mode in zip(os.pipe(), ("rb", "wb"), strict=True)
                )
                printed = [files.enter_context(TemporaryFile()) for _ in range(2 * self._captures)]
                with blocked(*WATCHED):  # until the worker can handle them
                    parent, pid = os.getpid(), os.fork()
                    if pid == 0:
                        self._work(_Worker(future, ours, printed), call, parent)
                    self._workers[pid] = _Worker(future, theirs, printed)
                ours.close()
            except OSError as error:  # too many processes or files, or a full disk
                future.set_exception(_not_started(error))
            else:
                files.pop_all()  # `_finish` closes them

    def _work(self, worker: _Worker, call: Callable[[], Any], parent: int) -> NoReturn:
        """Run as the worker: execute the call, write its result or exception to a file, and exit."""
        code = 1
        try:
            if HAS_GUARDIANS:
                try:
                    fork_guarded(parent)
                except OSError as error:
                    pickle.dump(_not_started(error), worker.returned)
                    worker.returned.flush()
                    os._exit(0)
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


def _not_started(error: OSError) -> WorkerError:
    return WorkerError(f"the process cannot start: {error.strerror or error}", None)


def _finish(worker: _Worker, exit_code: int) -> None:
    """Pass on the result of a worker that has ended."""
    worker.future.printed = tuple(map(_content, worker.printed))
    with worker.returned as pipe:
        os.set_blocking(pipe.fileno(), False)  # a child of the worker may hold the other end
        returned = pipe.read() if exit_code == 0 else None
    if returned:
        value = pickle.loads(returned)
    elif exit_code < 0:
        number = -exit_code
        name = signal.Signals(number).name if number in set(signal.Signals) else f"signal {number}"
        value = WorkerError(f"the process was killed by {name}", exit_code)
    else:
        value = WorkerError(f"the process exited with status {exit_code}", exit_code)
    if isinstance(value, WorkerError):
        worker.future.set_exception(value)
    else:
        worker.future.set_result(value)


def _content(file: IO[bytes]) -> bytes:
    """Return the content of a file, and close it."""
    with file:
        file.seek(0)
        return file.read()


def _is_file(stream: TextIO) -> bool:
    """Return whether a stream has a file descriptor, which a forked process can use."""
    try:
        stream.fileno()
    except (OSError, AttributeError):
        return False
    return True


def _redirect(output: IO[bytes], error_output: IO[bytes]) -> None:
    """Redirect the output of this process to these files, and its input to nothing.

    Each line is written at once: a killed process has no time to flush.
    """
    if sys.stdout.isatty():
        os.environ["COLUMNS"] = str(shutil.get_terminal_size().columns)
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    sys.stdout, sys.stderr = _stream(output, 1), _stream(error_output, 2)


def _stream(file: IO[bytes], descriptor: int) -> TextIO:
    os.dup2(file.fileno(), descriptor)
    return open(descriptor, "w", buffering=1, encoding="utf-8", errors="backslashreplace", closefd=False)


def _open_files() -> list[io.IOBase]:
    """Return the writable files opened since `gc.freeze()`."""
    return [each for each in gc.get_objects() if issubclass(type(each), _WRITTEN_TO)]


def _flush(file: IO[Any] | io.IOBase) -> None:
    with contextlib.suppress(OSError, ValueError):  # a full disk, or a closed file
        file.flush()


def keep_from_forks(files: Iterable[Path]) -> None:
    """Prevent processes forked by callbacks from writing to these files. Linux only.

    They inherit descriptors and buffers: both processes would write the same data.
    """
    names = {os.path.realpath(file) for file in files}
    os.register_at_fork(after_in_child=partial(_leave_files, names))


def _leave_files(names: Collection[str]) -> None:
    with contextlib.suppress(OSError):  # no /proc
        for descriptor in os.listdir("/proc/self/fd"):
            with contextlib.suppress(OSError):  # the descriptor of the directory itself is closed
                if os.readlink(f"/proc/self/fd/{descriptor}") in names:
                    os.dup2(os.open(os.devnull, os.O_WRONLY), int(descriptor))


@contextlib.contextmanager
def blocked(*signals: signal.Signals) -> Iterator[None]:
    """Block these signals inside the block."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, signals)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
