"""A group of runs, computed by a worker of any executor in a separate process.

A worker gets the name of the file, the options and the numbers of the runs. It reads the file itself, so that
protocols need not be pickled. The process is a fresh one, since a worker may have threads and cannot fork.
Ctrl-C at a terminal does not reach it: `press` does.
"""

import os
import pickle
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Sequence
from concurrent.futures import CancelledError
from dataclasses import dataclass, replace
from pathlib import Path

from gradysim.cli.errors import report_crashes
from gradysim.cli.execution import simulator
from gradysim.cli.guardian import end_with
from gradysim.cli.interrupt import StopOnInterrupt
from gradysim.cli.options import RunOptions
from gradysim.cli.run_all import may_others_go_on
from gradysim.cli.run_task import LineStart, Reported, RunTask, import_what_runs_use
from gradysim.cli.runner import ForkExecutor, WorkerError, blocked
from gradysim.cli.runs import check

KILLING = 3
"""Number of presses after which no process goes on."""

_lock = threading.Lock()
_processes: dict[subprocess.Popen[bytes], str] = {}
"""Running groups, and the commands that they belong to."""
_presses: dict[str, int] = {}
"""How often Ctrl-C was pressed for commands that begin no more runs."""


@dataclass(frozen=True)
class Group:
    """Runs that a worker computes one after the other.

    Attributes:
        file: The .ini file.
        options: Options of the command.
        numbers: Numbers of the runs, which increase.
        first: Number of the run whose lint findings are printed.
        line: Beginning of the line about a run; None to print its full summary.
        directory: Working directory of the command.
        columns: Width of its terminal; None without one.
        command: Identifies the command.
    """

    file: Path
    options: RunOptions
    numbers: tuple[int, ...]
    first: int
    line: LineStart | None
    directory: str
    columns: int | None
    command: str

    @staticmethod
    def of(file: Path, options: RunOptions, first: int, line: LineStart | None) -> "Group":
        """Return a group without runs of the command in this process."""
        command = os.urandom(8).hex()
        return Group(file, options, (), first, line, os.getcwd(), width_of_terminal(), command)


@dataclass(frozen=True)
class Ended:
    """How a run of a group ended.

    Attributes:
        outcome: What its task returned, or how its process died.
        printed: Its output to standard output and standard error.
    """

    outcome: Reported | WorkerError
    printed: tuple[bytes, ...]


@dataclass(frozen=True)
class GroupResult:
    """The runs of a group that have ended.

    Attributes:
        ended: How each ended, by its number.
        duration_s: Wall time of all of them in seconds, without the start of the process.
    """

    ended: dict[int, Ended]
    duration_s: float


def compute(group: Group) -> GroupResult:
    """Compute a group in a separate process, which ends with this one. After a `press` no run begins.

    Raises RuntimeError if the process fails.
    """
    columns = {} if group.columns is None else {"COLUMNS": str(group.columns)}
    with _lock, blocked(signal.SIGINT):  # until the process can handle it
        if group.command in _presses:
            return GroupResult({}, 0.0)
        process = subprocess.Popen(
            [sys.executable, "-P", "-c", "from gradysim.cli.group import main; main()"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            cwd=group.directory,
            env={**os.environ, **columns},
            process_group=0,
        )
        _processes[process] = group.command
    with process:
        try:
            returned, error_output = process.communicate(pickle.dumps((os.getpid(), group)))
        finally:
            process.kill()
            del _processes[process]
    if process.returncode:
        printed = error_output.decode("utf-8", errors="replace").strip()
        raise RuntimeError(f"the process of a group exited with status {process.returncode}\n{printed}")
    result: GroupResult = pickle.loads(returned)
    return result


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


def width_of_terminal() -> int | None:
    """Return the width that tables have in the output of this command; None for the default."""
    if "COLUMNS" in os.environ or sys.stdout.isatty():
        return shutil.get_terminal_size().columns
    return None


def main() -> None:
    """Compute the group that standard input has, and write its result to standard output."""
    parent, group = pickle.load(sys.stdin.buffer)
    end_with(parent)
    for each in ("SIGTERM", "SIGHUP"):  # for the worker, which ends this process or does not
        if hasattr(signal, each):
            signal.signal(getattr(signal, each), signal.SIG_IGN)
    returned = os.dup(1)
    os.dup2(2, 1)  # for what modules of protocols print
    result = _computed(group)
    with os.fdopen(returned, "wb") as file:
        pickle.dump(result, file)


def _computed(group: Group) -> GroupResult:
    from gradysim.encapsulator.run_context import gc_paused
    from gradysim.scenario.runs import text_of_runs

    options = replace(group.options, runs=text_of_runs(group.numbers), share=None)
    with gc_paused():
        study = check(group.file, options.config, options.runs, options.settings, options.seed)
        _, build = simulator(options)
        report_crashes()
        import_what_runs_use(options)
        begin_s = time.monotonic()
        interrupt = StopOnInterrupt()
        with ForkExecutor(1, interrupt, captures=True) as executor, interrupt:
            signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])
            task = RunTask(study, options, build, interrupt, group.first, group.line)
            ended = _all_ended(group.numbers, task, executor)
            signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])  # it has a result to return
    return GroupResult(ended, time.monotonic() - begin_s)


def _all_ended(numbers: Sequence[int], task: RunTask, executor: ForkExecutor) -> dict[int, Ended]:
    """Compute runs until one ends so that the others may not go on."""
    ended: dict[int, Ended] = {}
    for place, number in enumerate(numbers):
        future = executor.submit(task, place)
        try:
            outcome: Reported | WorkerError = future.result()
        except CancelledError:
            break
        except WorkerError as error:
            outcome = error
        ended[number] = Ended(outcome, future.printed)
        if not may_others_go_on(future):
            break
    return ended
