"""`gradysim run --executor dask`: a real scheduler and real workers, which are killed."""

import contextlib
import json
import os
import re
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from gradysim.cli.errors import INCOMPLETE
from gradysim.cli.interrupt import STOPPING
from python.cli.command import PROTOCOL, Gradysim, compiled, environment, objects, run_without
from python.processes import session, wait_until

COSTS = ("wall_s", "cpu_s", "setup_s", "checksum")

RUN_COUNT = 24

SLOW = """
import time
from protocol import Talker

class Slow(Talker):
    def handle_timer(self, timer):
        time.sleep(0.02)
        super().handle_timer(timer)
"""

STUDY = ("--set", f"repeat={RUN_COUNT}", "--set", '*.uavs[*].protocol.class="slow.py:Slow"')

ENDLESS = """
from protocol import Talker

class Endless(Talker):
    def handle_timer(self, timer):
        if self.provider.current_time() > 2:
            open("begun", "w").close()
        super().handle_timer(timer)
"""

ONE_ENDS = (
    *("--mode", "prototype", "--result-dir", "out", "--set", "repeat=4"),
    *("--set", '*.uavs[*].protocol.class="endless.py:Endless"'),
    *("--set", "sim-time-limit=1s + 1e6s * ${runnumber}"),
)
"""A study of four runs: the first one ends at once, and the others never do."""

WITHOUT_PATIENCE = (
    "import sys; from gradysim.cli import app, dask_workers; dask_workers.WITHOUT_WORKERS_S = 0.5;"
    " sys.exit(app.main())"
)
"""The command that does not wait for workers for 30 s."""

IMPATIENT = (
    "import sys; from gradysim.cli import app, dask_workers; dask_workers.ANSWERS_WITHIN_S = 3.0;"
    " sys.exit(app.main())"
)
"""The command that does not wait for the answer of a scheduler for 30 s."""


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--scheduler", "tcp://a:1"), "--scheduler tcp://a:1: expected --executor dask, too"),
        (("--executor", "dask", "--scheduler", "a:b"), "--scheduler a:b: "),
    ],
)
def test_other_options_are_errors(gradysim: Gradysim, options: tuple[str, ...], message: str) -> None:
    done = gradysim("run", "test.ini", "--mode", "prototype", *options)
    assert (done.returncode, done.stdout) == (2, "")
    assert message in done.stderr


def test_dask_is_an_extra(folder: Path) -> None:
    options = ("--mode", "prototype", "--executor", "dask", "--scheduler", "tcp://a:1")
    done = run_without("distributed", folder, "run", "test.ini", *options)
    assert (done.returncode, done.stdout) == (2, "")
    assert "pip" in done.stderr


@contextlib.contextmanager
def started(*arguments: str) -> Iterator[subprocess.Popen[str]]:
    """Start a process of Python, and end it."""
    pipe = subprocess.PIPE
    with subprocess.Popen(
        [sys.executable, *arguments], env=environment(), stderr=pipe, text=True, start_new_session=True
    ) as process:
        try:
            yield process
        finally:
            process.kill()


class Scheduler:
    """A process of a Dask scheduler, and processes of workers with one thread each."""

    def __init__(self, processes: contextlib.ExitStack) -> None:
        self._processes = processes
        self._workers: list[subprocess.Popen[str]] = []
        self.process = self._start("scheduler", "--port", "0")
        self.address = self._wait(self.process, r"Scheduler at:\s*(tcp://\S+)")

    def _start(self, program: str, *arguments: str) -> subprocess.Popen[str]:
        module = f"distributed.cli.dask_{program}"
        return self._processes.enter_context(started("-m", module, *arguments, "--no-dashboard"))

    @staticmethod
    def _wait(process: subprocess.Popen[str], text: str) -> str:
        """Wait for a line of the log of a process, and return its group."""
        for line in process.stderr:
            if found := re.search(text, line):
                return found[1]
        raise AssertionError("it has ended")

    def start_workers(self, count: int) -> list[subprocess.Popen[str]]:
        """Start as many workers as are missing, and return all of them."""
        self._workers = [worker for worker in self._workers if worker.poll() is None]
        options = (self.address, "--nthreads", "1", "--no-nanny")
        new = [self._start("worker", *options) for _ in range(count - len(self._workers))]
        for worker in new:
            self._wait(worker, "(Registered to):")
        self._workers += new
        return self._workers


@pytest.fixture(scope="module")
def scheduler() -> Iterator[Scheduler]:
    """Return a scheduler without workers for the tests of this module, of which the last one kills it."""
    with contextlib.ExitStack() as processes:
        yield Scheduler(processes)


@contextlib.contextmanager
def command(folder: Path, *arguments: str, code: str | None = None) -> Iterator[subprocess.Popen[str]]:
    """Begin a command of `gradysim run` in a session of its own, and kill what is left of it."""
    (folder / "endless.py").write_text(ENDLESS)
    program = ("-m", "gradysim") if code is None else ("-c", code)
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    line = [sys.executable, *program, "run", "test.ini", "--executor", "dask", *arguments]
    with subprocess.Popen(
        line, cwd=folder, env=environment(), text=True, start_new_session=True, **pipes
    ) as process:
        try:
            yield process
        finally:
            process.kill()


def wait_for_the_second_run(folder: Path) -> None:
    """Wait until the study `ONE_ENDS` has one result, and a run that does not end is under way."""
    wait_until(lambda: (folder / "begun").exists() and len(list((folder / "out").glob("*.json"))) == 1, 60)


def without_costs(row: dict[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in row.items() if name not in COSTS}


def results(directory: Path) -> dict[str, Any]:
    return {file.name: without_costs(json.loads(file.read_text())) for file in directory.glob("*.json")}


@pytest.mark.verify
def test_a_scheduler_without_workers_ends_the_command(folder: Path, scheduler: Scheduler) -> None:
    options = (*ONE_ENDS, "--scheduler", scheduler.address)
    with command(folder, *options, code=WITHOUT_PATIENCE) as process:
        _, errors = process.communicate(timeout=60)
    lost = f"--scheduler {scheduler.address}: the scheduler has had no worker for 0.5 s"
    assert errors == f"{lost}; General: 0 of 4 runs are done, 4 were not begun (0..3)\n"
    assert process.returncode == INCOMPLETE


def test_after_ctrl_c_nothing_goes_on(folder: Path, scheduler: Scheduler) -> None:
    (worker,) = scheduler.start_workers(1)
    with command(folder, *ONE_ENDS, "--scheduler", scheduler.address) as process:
        wait_for_the_second_run(folder)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
    ended = "General: run 1 was interrupted, 1 of 4 runs is done (0), 2 were not begun (2..3)"
    assert (process.returncode, errors.splitlines()[-1]) == (130, ended)
    assert session(worker.pid) == [worker.pid]
    interrupted = {name: result["interrupted"] for name, result in results(folder / "out").items()}
    assert interrupted == {"General-#0.prototype.json": False, "General-#1.prototype.json": True}


@pytest.mark.verify
def test_without_its_last_worker_the_command_ends(folder: Path, scheduler: Scheduler) -> None:
    (worker,) = scheduler.start_workers(1)
    options = (*ONE_ENDS, "--scheduler", scheduler.address)
    with command(folder, *options, code=WITHOUT_PATIENCE) as process:
        wait_for_the_second_run(folder)
        worker.kill()
        _, errors = process.communicate(timeout=60)
    lost = f"--scheduler {scheduler.address}: the scheduler has had no worker for 0.5 s"
    assert errors == f"{lost}; General: 1 of 4 runs is done (0), 3 were under way (1..3)\n"
    assert process.returncode == INCOMPLETE


@pytest.mark.verify
@pytest.mark.parametrize("number", STOPPING)
def test_a_signal_does_not_wait_for_a_worker(folder: Path, scheduler: Scheduler, number: int) -> None:
    (worker,) = scheduler.start_workers(1)
    with command(folder, *ONE_ENDS, "--scheduler", scheduler.address) as process:
        wait_for_the_second_run(folder)
        worker.kill()
        worker.wait()
        process.send_signal(number)
        _, errors = process.communicate(timeout=60)
    ended = "General: 1 of 4 runs is done (0), 3 were under way (1..3)"
    assert (process.returncode, errors.splitlines()[-1]) == (128 + number, ended)


@compiled
@pytest.mark.verify
def test_a_worker_that_is_killed_loses_nothing(
    folder: Path, gradysim: Gradysim, scheduler: Scheduler
) -> None:
    (folder / "slow.py").write_text(SLOW)
    worker, _ = scheduler.start_workers(2)
    expected = gradysim("run", "test.ini", *STUDY, "--json", "--result-dir", "local", "--jobs", "2")
    options = (*STUDY, "--json", "--result-dir", "out", "--scheduler", scheduler.address)
    with command(folder, *options) as process:
        wait_until(lambda: len(list((folder / "out").glob("*.json"))) >= RUN_COUNT // 2, 120)
        assert process.poll() is None
        worker.kill()
        printed, errors = process.communicate(timeout=120)
    assert process.returncode == 0, errors
    rows = [without_costs(row) for row in objects(printed)]
    assert [row["run"] for row in rows] == list(range(RUN_COUNT))
    assert rows == [without_costs(row) for row in objects(expected.stdout)]
    assert results(folder / "out") == results(folder / "local")


@pytest.mark.verify
def test_a_scheduler_that_is_frozen_ends_the_command(folder: Path, scheduler: Scheduler) -> None:
    (worker,) = scheduler.start_workers(1)
    with command(folder, *ONE_ENDS, "--scheduler", scheduler.address, code=IMPATIENT) as process:
        wait_for_the_second_run(folder)
        scheduler.process.send_signal(signal.SIGSTOP)
        try:
            _, errors = process.communicate(timeout=30)
        finally:
            worker.kill()
            worker.wait()
            scheduler.process.send_signal(signal.SIGCONT)
    lost = f"--scheduler {scheduler.address}: the scheduler does not answer any more"
    assert errors == f"{lost}; General: 1 of 4 runs is done (0), 3 were under way (1..3)\n"
    assert process.returncode == INCOMPLETE


def test_a_scheduler_that_is_killed_ends_the_command(folder: Path, scheduler: Scheduler) -> None:
    scheduler.start_workers(1)
    with command(folder, *ONE_ENDS, "--scheduler", scheduler.address) as process:
        wait_for_the_second_run(folder)
        scheduler.process.kill()
        _, errors = process.communicate(timeout=60)
    lost = f"--scheduler {scheduler.address}: the scheduler does not answer any more"
    assert errors == f"{lost}; General: 1 of 4 runs is done (0), 3 were under way (1..3)\n"
    assert process.returncode == INCOMPLETE


LOCAL = "--executor dask: 2 workers on this machine, as no --scheduler is given"


@pytest.mark.verify
def test_without_a_scheduler_workers_start_here(folder: Path, gradysim: Gradysim) -> None:
    (folder / "protocol.py").write_text(PROTOCOL.replace('print("printed by a protocol")', ""))
    options = ("--mode", "prototype", "--json", "--jobs", "2")
    expected = gradysim("run", "test.ini", *options)
    with socket.socket() as other_cluster:
        with contextlib.suppress(OSError):  # there is one
            other_cluster.bind(("", 8787))
            other_cluster.listen()
        with command(folder, *options) as process:
            printed, errors = process.communicate(timeout=60)
    assert (process.returncode, errors) == (0, f"{LOCAL}\n")
    rows = [without_costs(row) for row in objects(printed)]
    assert rows == [without_costs(row) for row in objects(expected.stdout)]


def listening(pid: int) -> set[str]:
    """Return the addresses that a process listens at, as hexadecimal numbers."""
    sockets = {os.readlink(file) for file in Path(f"/proc/{pid}/fd").iterdir()}
    rows = [
        row.split() for name in ("tcp", "tcp6") for row in Path(f"/proc/net/{name}").read_text().splitlines()
    ]
    return {row[1].split(":")[0] for row in rows if row[3] == "0A" and f"socket:[{row[9]}]" in sockets}


@pytest.mark.verify
@pytest.mark.skipif(sys.platform != "linux", reason="it looks into /proc")
def test_other_machines_do_not_reach_workers_here(folder: Path) -> None:
    with command(folder, *ONE_ENDS, "--jobs", "2") as process:
        wait_for_the_second_run(folder)
        assert listening(process.pid) <= {"0100007F"}  # 127.0.0.1
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)


@pytest.mark.verify
@pytest.mark.skipif(sys.platform != "linux", reason="it looks into /proc")
@pytest.mark.parametrize(
    ("number", "code"),
    [(signal.SIGTERM, 143), (signal.SIGKILL, -9), (signal.SIGINT, 130), (signal.SIGALRM, INCOMPLETE)],
)
def test_workers_here_end_with_the_command(folder: Path, number: signal.Signals, code: int) -> None:
    with command(folder, *ONE_ENDS, "--jobs", "2", "--stop-after", "1h") as process:
        wait_for_the_second_run(folder)
        process.send_signal(number)
        _, errors = process.communicate(timeout=60)
        wait_until(lambda: not session(process.pid), 3)
    assert errors.splitlines()[0] == LOCAL
    assert process.returncode == code
