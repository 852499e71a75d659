"""`gradysim run --executor dask`: a real scheduler with two worker processes, of which one is killed."""

import contextlib
import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from python.cli.command import Gradysim, compiled, environment, objects, run_without
from python.processes import wait_until

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


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--scheduler", "tcp://a:1"), "--scheduler tcp://a:1: expected --executor dask, too"),
        (("--executor", "dask"), "--executor dask: expected the address of its scheduler"),
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
    assert done.stderr.endswith("pip install distributed\n")


@contextlib.contextmanager
def started(folder: Path, *arguments: str) -> Iterator[subprocess.Popen[str]]:
    """Start a program of Dask, and end it."""
    with (folder / "dask.log").open("a") as log:
        process = subprocess.Popen(
            [sys.executable, "-m", *arguments, "--no-dashboard"],
            cwd=folder,
            env=environment(),
            stdout=log,
            stderr=log,
            text=True,
        )
    try:
        yield process
    finally:
        process.terminate()
        process.wait(30)


@pytest.fixture
def cluster(folder: Path) -> Iterator[tuple[str, list[subprocess.Popen[str]]]]:
    """Return the address of a scheduler and its two workers, each a process with one thread."""
    found = folder / "scheduler.json"
    worker = ("distributed.cli.dask_worker", "--scheduler-file", str(found), "--nthreads", "1", "--no-nanny")
    with contextlib.ExitStack() as processes:
        scheduler = ("distributed.cli.dask_scheduler", "--port", "0", "--scheduler-file", str(found))
        processes.enter_context(started(folder, *scheduler))
        wait_until(found.exists, 60)
        workers = [processes.enter_context(started(folder, *worker)) for _ in range(2)]
        wait_until(lambda: (folder / "dask.log").read_text().count("Registered to:") == 2, 60)
        yield json.loads(found.read_text())["address"], workers


def without_costs(row: dict[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in row.items() if name not in COSTS}


def results(directory: Path) -> dict[str, Any]:
    return {file.name: without_costs(json.loads(file.read_text())) for file in directory.glob("*.json")}


@compiled
@pytest.mark.verify
def test_a_worker_that_is_killed_loses_nothing(
    folder: Path,
    gradysim: Callable[..., subprocess.CompletedProcess[str]],
    cluster: tuple[str, list[subprocess.Popen[str]]],
) -> None:
    (folder / "slow.py").write_text(SLOW)
    address, workers = cluster
    expected = gradysim("run", "test.ini", *STUDY, "--json", "--result-dir", "local", "--jobs", "2")
    command = [sys.executable, "-m", "gradysim", "run", "test.ini", *STUDY, "--json", "--result-dir", "out"]
    command += ["--executor", "dask", "--scheduler", address]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen(command, cwd=folder, env=environment(), text=True, **pipes) as process:
        wait_until(lambda: len(list((folder / "out").glob("*.json"))) >= RUN_COUNT // 2, 120)
        assert process.poll() is None
        os.kill(workers[0].pid, signal.SIGKILL)
        printed, errors = process.communicate(timeout=120)
    assert process.returncode == 0, errors
    rows = [without_costs(row) for row in objects(printed)]
    assert [row["run"] for row in rows] == list(range(RUN_COUNT))
    assert rows == [without_costs(row) for row in objects(expected.stdout)]
    assert results(folder / "out") == results(folder / "local")
