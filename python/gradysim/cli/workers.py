"""Workers of runs: forked processes of this machine, and tasks of any other executor.

The task of an executor gets the name of the file, the options and the numbers of the runs. It reads the file
itself, so that protocols need not be pickled. It has a fresh process, since a worker may have threads and
cannot fork. Ctrl-C at a terminal does not reach that process: `press` does.
"""

import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Collection, Iterable
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from functools import partial
from tempfile import TemporaryFile

from gradysim.cli.errors import FAILED, MISTAKE, report_crashes
from gradysim.cli.executor import Batch, Row, RunExecutor, WorkersLostError
from gradysim.cli.fork_executor import ForkExecutor, ForkFuture, WorkerError, blocked
from gradysim.cli.guardian import end_with
from gradysim.cli.interrupt import KILLING, StopOnInterrupt
from gradysim.cli.run_task import Command, Reported, RunTask

_POLL_S = 0.1
"""Wall time in seconds until Ctrl-C is passed on."""

_lock = threading.Lock()
_processes: dict[subprocess.Popen[bytes], str] = {}
"""Running processes of batches, and the commands that they belong to."""
_presses: dict[str, int] = {}
"""How often Ctrl-C was pressed for commands that begin no more runs."""


class ForkedWorkers:
    """Processes of this machine, each forked for one run. Presses reach them directly, by signals."""

    batch_s = (0.0, 0.0)

    def __init__(
        self,
        task: Callable[[int], Reported],
        jobs: int,
        interrupt: StopOnInterrupt,
        *,
        captures: bool = False,
    ) -> None:
        """`task` executes the run of a number, `jobs` at a time. For the others see `ForkExecutor`."""
        self._task = task
        self._jobs = jobs
        self._forks = ForkExecutor(jobs, interrupt, captures=captures)

    def count(self) -> int:
        """Return the number of processes."""
        return self._jobs

    def begin(self, numbers: tuple[int, ...]) -> Batch:
        """Fork a process for the run of this number."""
        (number,) = numbers
        batch: Batch = Future()
        begin_s = time.monotonic()

        def end(ended: Future[Reported]) -> None:
            printed = ended.printed if isinstance(ended, ForkFuture) else ()
            row = partial(Row, number, printed=printed, wall_s=time.monotonic() - begin_s)
            try:
                batch.set_result([row(*ended.result())])
            except WorkerError as error:
                batch.set_result([row(MISTAKE if error.exit_code is None else FAILED, death=str(error))])
            except Exception as error:  # on systems that cannot fork
                batch.set_exception(error)

        self._forks.submit(self._task, number).add_done_callback(end)
        return batch

    def wait(self, batches: Collection[Batch]) -> None:
        """Wait for the end of a process."""
        self._forks.advance()

    def stop(self, batches: Iterable[Batch], presses: int) -> list[Batch]:
        """Kill the processes after `KILLING` presses. Others reach them by signals."""
        if presses >= KILLING:
            self._forks.shutdown()
        return []

    def lost(self) -> WorkersLostError:
        """Never called: nothing cancels these batches."""
        raise NotImplementedError


class ExecutorWorkers:
    """The workers of any executor, such as a pool of processes."""

    batch_s = (2.0, 5.0)

    def __init__(self, executor: Executor, count: int, command: Command) -> None:
        """`count` batches are computed at the same time. The caller shuts the executor down."""
        self._executor = executor
        self._count = count
        self._command = command

    def count(self) -> int:
        """Return the number of workers. Raises WorkersLostError."""
        return self._count

    def begin(self, numbers: tuple[int, ...]) -> Batch:
        """Submit a batch."""
        return self._executor.submit(compute, self._command, numbers)

    def wait(self, batches: Collection[Batch]) -> None:
        """Wait for the end of a batch, for a tenth of a second at most."""
        if batches:
            wait(batches, _POLL_S, FIRST_COMPLETED)
        else:  # the cluster does not have a worker yet
            time.sleep(_POLL_S)

    def stop(self, batches: Iterable[Batch], presses: int) -> list[Batch]:
        """Cancel the batches that wait, and pass presses on to the others."""
        self.press(presses)
        return [batch for batch in batches if batch.cancel()]

    def lost(self) -> WorkersLostError:
        """Return the error after the executor has canceled a batch."""
        return WorkersLostError("the executor has canceled its tasks")

    def press(self, presses: int) -> None:
        """Pass on presses to the processes of the workers, of which an executor reaches only this one."""
        press(self._command.id, presses)


def compute(command: Command, numbers: tuple[int, ...]) -> list[Row]:
    """Compute a batch in a separate process, which ends with this one. After a `press` no run begins.

    Raises RuntimeError if the process fails.
    """
    columns = {} if command.columns is None else {"COLUMNS": str(command.columns)}
    with (
        TemporaryFile() as returned,
        TemporaryFile() as printed,
    ):  # a process that a module starts keeps pipes
        with _lock, blocked(signal.SIGINT):  # until the process can handle it
            if command.id in _presses:
                return []
            process = subprocess.Popen(
                [sys.executable, "-P", "-c", "from gradysim.cli.workers import main; main()"],
                stdin=subprocess.PIPE,
                stdout=returned,
                stderr=printed,
                cwd=command.directory,
                env={**os.environ, **columns},
                process_group=0,
            )
            _processes[process] = command.id
        with process:
            try:
                process.communicate(pickle.dumps((os.getpid(), command, numbers)))
            finally:
                process.kill()
                del _processes[process]
        returned.seek(0)
        if process.returncode == 0:
            rows: list[Row] = pickle.load(returned)
            return rows
        printed.seek(0)
        text = printed.read().decode("utf-8", errors="replace").strip()
        raise RuntimeError(f"the process of a batch exited with status {process.returncode}\n{text}")


def press(command: str, presses: int) -> None:
    """Begin no more runs of a command in this process, and pass on the presses of its Ctrl-C so far.

    Runs under way take each new press as those of `ForkExecutor` do. `KILLING` presses kill their processes.
    """
    with _lock:
        before = _presses.get(command, 0)
        _presses[command] = max(presses, before)
        for process in [process for process, of in _processes.items() if of == command]:
            if presses >= KILLING:
                process.kill()
            elif presses > before:
                process.send_signal(signal.SIGINT)


def main() -> None:
    """Compute the batch that standard input has, and write its rows to standard output."""
    parent, command, numbers = pickle.load(sys.stdin.buffer)
    end_with(parent)
    for each in ("SIGTERM", "SIGHUP"):  # for the worker, which ends this process or does not
        if hasattr(signal, each):
            signal.signal(getattr(signal, each), signal.SIG_IGN)
    returned = os.dup(1)
    os.dup2(2, 1)  # for what modules of protocols print
    rows = _rows(command, numbers)
    with os.fdopen(returned, "wb") as file:
        pickle.dump(rows, file)


def _rows(command: Command, numbers: tuple[int, ...]) -> list[Row]:
    from gradysim.encapsulator.run_context import gc_paused

    with gc_paused(), StopOnInterrupt(raises_at=KILLING) as interrupt:
        task = RunTask.of(command, numbers, interrupt)
        report_crashes()
        with RunExecutor(ForkedWorkers(task, 1, interrupt, captures=True), interrupt) as executor:
            signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])
            rows = [row for rows in executor.rows(numbers) for row in rows]
            signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])  # it has a result to return
    return rows
