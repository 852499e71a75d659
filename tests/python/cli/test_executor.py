"""The executor of runs: the sizes of batches, and what happens if a run fails. Most are not computed."""

import signal
from collections import deque
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import pytest

from gradysim.cli.errors import FAILED, MISTAKE, OK
from gradysim.cli.executor import Row, RunExecutor, WorkersLostError
from gradysim.cli.interrupt import KILLING, StopOnInterrupt
from gradysim.cli.options import RunOptions
from gradysim.cli.run import run_file
from gradysim.cli.workers import ForkedWorkers
from python.cli.command import compiled, objects

RUN_S = 0.01


class ByHand:
    """Two workers, as those of a cluster: each wait ends the first batch, with the next of `ends`."""

    batch_s = (2.0, 5.0)

    def __init__(self):
        self.begun = []
        self.waiting = deque()
        self.ends = deque()
        self.presses = []
        self.cancels = True

    def count(self):
        return 2

    def begin(self, numbers):
        self.begun.append(numbers)
        self.waiting.append((numbers, Future()))
        return self.waiting[-1][1]

    def wait(self, batches):
        numbers, batch = self.waiting.popleft()
        end = self.ends.popleft() if self.ends else [Row(number, OK, wall_s=RUN_S) for number in numbers]
        if batch.set_running_or_notify_cancel():
            batch.set_exception(end) if isinstance(end, Exception) else batch.set_result(end)

    def stop(self, batches, presses):
        self.presses.append(presses)
        return [batch for batch in batches if self.cancels and batch.cancel()]

    def lost(self):
        return WorkersLostError("lost")


@pytest.fixture
def workers():
    return ByHand()


@pytest.fixture
def executor(workers):
    with StopOnInterrupt(raises_at=KILLING) as interrupt:
        yield RunExecutor(workers, interrupt)


def all_rows(executor, count):
    return [row for rows in executor.rows(range(count)) for row in rows]


def test_batches_have_one_run_first_and_five_seconds_later(executor, workers):
    rows = all_rows(executor, 10_000)
    sizes = [len(numbers) for numbers in workers.begun]
    assert sizes[:2] == [1, 1]
    assert sizes[2] == 5 / RUN_S
    assert sizes[-2] == 2 / RUN_S
    assert [row.number for row in rows] == list(range(10_000))
    assert {row.code for row in rows} == {OK}


def test_runs_of_less_than_two_seconds_stay_together(executor, workers):
    all_rows(executor, 40)
    assert workers.begun[2:] == [tuple(range(2, 40))]


def test_each_worker_has_one_batch(executor, workers):
    next(executor.rows(range(9)))
    assert workers.begun == [(0,), (1,)]


def test_while_the_first_run_is_under_way_not_all_others_begin(executor, workers, monkeypatch):
    def wait_for_the_last(batches):
        workers.waiting.rotate(1)
        ByHand.wait(workers, batches)

    monkeypatch.setattr("gradysim.cli.executor._MOST_AHEAD", 5)
    workers.wait = wait_for_the_last
    assert [row.number for row in all_rows(executor, 9)] == [1, 2, 3, 4, 0, 5, 6, 7, 8]
    assert workers.begun[:3] == [(0,), (1,), (2, 3, 4)]


@pytest.mark.parametrize(
    "row", [Row(0, FAILED), Row(0, MISTAKE, death="it cannot start"), Row(0, OK, OSError())]
)
def test_after_a_failure_no_batch_begins(executor, workers, row):
    workers.ends.append([row])
    assert all_rows(executor, 9) == [row]
    assert workers.begun == [(0,), (1,)]
    assert executor.under_way == []


def test_the_death_of_a_process_does_not_stop_the_others(executor, workers):
    workers.ends.append([Row(0, FAILED, death="it was killed")])
    assert len(all_rows(executor, 9)) == 9


def test_after_ctrl_c_no_batch_begins(executor, workers):
    signal.raise_signal(signal.SIGINT)
    assert all_rows(executor, 9) == []
    assert workers.begun == []


def test_batches_that_are_not_canceled_get_each_press(executor, workers):
    workers.cancels = False
    rows = executor.rows(range(9))
    next(rows)
    signal.raise_signal(signal.SIGINT)
    workers.ends.append([])
    assert list(rows) == [[]]
    assert workers.presses == [1]


def test_without_workers_one_press_is_enough(executor, workers):
    workers.cancels = False
    rows = executor.rows(range(9))
    next(rows)
    workers.count = lambda: 0
    signal.raise_signal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        next(rows)


def test_a_batch_that_the_workers_cancel_is_lost(executor, workers):
    rows = executor.rows(range(4))
    next(rows)
    workers.waiting[0][1].cancel()
    with pytest.raises(WorkersLostError):
        next(rows)
    assert executor.under_way == [1, 2, 3]


def test_a_batch_that_fails_fails_its_runs(executor, workers):
    workers.ends.append(RuntimeError("the disk is full"))
    assert all_rows(executor, 9) == [Row(0, MISTAKE, death="the disk is full")]


def test_runs_that_a_batch_did_not_begin_have_no_rows(executor, workers):
    workers.ends.append([])
    assert [row.number for row in all_rows(executor, 3)] == [1, 2]


@pytest.mark.parametrize("is_left", [True, False])
def test_batches_that_have_not_ended_are_killed(executor, workers, is_left):
    with executor:
        if is_left:
            next(executor.rows(range(3)))
        else:
            all_rows(executor, 3)
    assert workers.presses == ([KILLING] if is_left else [])


@pytest.mark.parametrize("jobs", [1, 3])
def test_forked_workers_get_one_run_each(jobs):
    begun = []

    def task(number):
        begun.append(number)
        print(begun)
        return OK, None

    with StopOnInterrupt(raises_at=KILLING) as interrupt:
        workers = ForkedWorkers(task, jobs, interrupt, captures=True)
        rows = [row for rows in RunExecutor(workers, interrupt).rows([0, 3, 4]) for row in rows]
    printed = {row.number: row.printed for row in rows}
    assert printed == {0: (b"[0]\n", b""), 3: (b"[3]\n", b""), 4: (b"[4]\n", b"")}


COSTS = ("wall_s", "cpu_s", "setup_s")


def rows(printed):
    """Return the JSON objects without the fields that differ each time."""
    return [{key: value for key, value in row.items() if key not in COSTS} for row in objects(printed)]


@compiled
def test_rows_are_the_same_for_any_executor(folder, gradysim, capfd, monkeypatch):
    monkeypatch.chdir(folder)
    expected = rows(gradysim("run", "test.ini", "--json").stdout)
    options = RunOptions(as_json=True, result_dir=Path("out"), jobs=2)
    with ThreadPoolExecutor(2) as executor:
        assert run_file(Path("test.ini"), options, executor) == 0
    assert rows(capfd.readouterr().out) == expected
    assert len(list((folder / "out").glob("*.json"))) == 3


def test_a_run_that_fails_ends_the_command(folder, capfd, monkeypatch):
    monkeypatch.chdir(folder)
    with ThreadPoolExecutor(1) as executor:
        code = run_file(Path("test.ini"), RunOptions(config="Failing", mode="prototype"), executor)
    assert code == 1
    printed = capfd.readouterr()
    assert "spoilt" in printed.err
    assert printed.err.endswith(" (1..2)\n")
