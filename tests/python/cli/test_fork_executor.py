"""The executor, with functions of these tests as tasks."""

import io
import os
import sys
import time
from concurrent.futures import CancelledError

import pytest

from gradysim.cli.fork_executor import ForkExecutor, WorkerError
from gradysim.cli.interrupt import StopOnInterrupt


@pytest.fixture(params=[1, 3])
def executor(request, monkeypatch):
    """Return an executor that captures the output of tasks, since standard output has no file descriptor."""
    monkeypatch.setattr(sys, "stdout", io.StringIO())
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    with ForkExecutor(request.param, StopOnInterrupt()) as executor:
        yield executor


def test_results_are_those_of_the_tasks(executor):
    futures = [executor.submit(pow, number, 2) for number in range(7)]
    assert [future.result() for future in futures] == [0, 1, 4, 9, 16, 25, 36]


def test_each_task_finds_what_its_parent_left(executor):
    left = []

    def task(number):
        left.append(number)
        return left

    assert [executor.submit(task, number).result() for number in range(3)] == [[0], [1], [2]]
    assert left == []


def test_what_a_task_prints_is_captured(executor):
    def task():
        print("text")
        print("error", file=sys.stderr)
        os.write(1, b"\xff\n")

    future = executor.submit(task)
    future.result()
    assert future.printed == (b"text\n\xff\n", b"error\n")


@pytest.mark.parametrize(
    ("end", "exit_code"),
    [
        (lambda: os._exit(0), 0),
        (lambda: os._exit(7), 7),
        (lambda: os.kill(os.getpid(), 9), -9),
        (sys.exit, 1),
    ],
)
def test_a_worker_that_dies_fails_its_own_task_only(executor, end, exit_code):
    died, other = executor.submit(end), executor.submit(int)
    with pytest.raises(WorkerError) as error:
        died.result()
    assert error.value.exit_code == exit_code
    assert other.result() == 0


def test_a_task_may_be_canceled_before_it_starts(executor):
    futures = [executor.submit(int) for _ in range(5)]
    futures[-1].cancel()
    assert [future.result() for future in futures[:-1]] == [0] * 4
    with pytest.raises(CancelledError):
        futures[-1].result()


def test_what_a_task_leaves_in_open_files_is_written(executor, tmp_path):
    left = []
    early = (tmp_path / "early").open("w")
    executor.shutdown()
    with ForkExecutor(1, StopOnInterrupt()) as executor:

        def task():
            left.append((tmp_path / "late").open("w"))
            for file in (early, *left):
                file.write("text")

        executor.submit(task).result()
    assert (tmp_path / "late").read_text() == (tmp_path / "early").read_text() == "text"
    early.close()


def test_the_end_of_the_executor_ends_its_workers(tmp_path):
    def write_pid_and_wait(file):
        file.write_text(str(os.getpid()))
        time.sleep(60)

    file = tmp_path / "pid"
    with ForkExecutor(2, StopOnInterrupt()) as executor:
        executor.submit(write_pid_and_wait, file)
        executor.submit(int).result()
        while not (file.exists() and file.read_text()):
            time.sleep(0.01)
    with pytest.raises(ProcessLookupError):
        os.kill(int(file.read_text()), 0)
