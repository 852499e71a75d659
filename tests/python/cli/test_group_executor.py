"""Runs in groups: their sizes, and what happens if one fails. The groups of most tests are not computed."""

import signal
from concurrent.futures import CancelledError, Executor, Future, ThreadPoolExecutor
from pathlib import Path

import pytest

from gradysim.cli import group_executor
from gradysim.cli.executors import Workers, WorkersLostError
from gradysim.cli.group import Ended, Group, GroupResult, press
from gradysim.cli.group_executor import GroupExecutor
from gradysim.cli.interrupt import StopOnInterrupt
from gradysim.cli.options import RunOptions
from gradysim.cli.run import run_file
from gradysim.cli.runner import WorkerError
from python.cli.command import compiled, objects

RUN_S = 0.01


class ByHand(Executor):
    """Executor that computes a group when it is asked for, in the order of submission."""

    def __init__(self):
        self.groups = []
        self.waiting = []

    def submit(self, fn, /, *args, **kwargs):
        (group,) = args
        self.groups.append(group.numbers)
        self.waiting.append((group.numbers, Future()))
        return self.waiting[-1][1]

    def compute_one(self, codes=None):
        """Compute the first group; `codes` are those of runs that are not OK, and None ends the group."""
        numbers, future = self.waiting.pop(0)
        ended = {number: Ended(((codes or {}).get(number, 0), None), (b"", b"")) for number in numbers}
        if future.set_running_or_notify_cancel():
            future.set_result(GroupResult(ended, RUN_S * len(numbers)))


@pytest.fixture
def by_hand():
    return ByHand()


@pytest.fixture
def groups(by_hand, monkeypatch):
    """Return the executor of groups for two workers."""
    monkeypatch.setattr(group_executor, "_POLL_S", 0.0)
    group = Group.of(Path("test.ini"), RunOptions(), 0, None)
    with StopOnInterrupt() as interrupt:
        yield GroupExecutor(Workers(by_hand, 2), group, interrupt)


def test_groups_have_one_run_first_and_five_seconds_later(groups, by_hand):
    futures = [groups.submit(number) for number in range(10_000)]
    while not all(future.done() for future in futures):
        groups.advance()
        by_hand.compute_one()
        groups.advance()
    sizes = [len(numbers) for numbers in by_hand.groups]
    assert sizes[:4] == [1, 1, 1, 1]
    assert sizes[4] == 5 / RUN_S
    assert sizes[-2] == 2 / RUN_S
    assert sorted(sum(by_hand.groups, ())) == list(range(10_000))
    assert {future.result() for future in futures} == {(0, None)}


def test_runs_of_less_than_two_seconds_stay_together(groups, by_hand):
    for number in range(40):
        groups.submit(number)
    groups.advance()
    by_hand.compute_one()
    groups.advance()
    groups.advance()
    assert by_hand.groups[4:] == [tuple(range(4, 40))]


def test_each_worker_has_a_group_in_reserve(groups, by_hand):
    for number in range(9):
        groups.submit(number)
    groups.advance()
    assert by_hand.groups == [(0,), (1,), (2,), (3,)]


def test_after_a_failure_no_group_starts(groups, by_hand):
    futures = [groups.submit(number) for number in range(9)]
    groups.advance()
    by_hand.compute_one({0: 1})
    groups.advance()
    assert futures[0].result() == (1, None)
    for future in futures[1:]:
        with pytest.raises(CancelledError):
            future.result()


def test_after_ctrl_c_no_group_starts(groups, by_hand):
    futures = [groups.submit(number) for number in range(9)]
    signal.raise_signal(signal.SIGINT)
    groups.advance()
    assert by_hand.groups == []
    with pytest.raises(CancelledError):
        futures[0].result()


class Elsewhere(Workers):
    """Workers of a cluster, which may have begun what it cancels. They end with a press."""

    def __init__(self, executor):
        super().__init__(executor, 2)
        self.presses = []

    def cancel(self, group):
        return False

    def call_each(self, function, *arguments):
        self.presses.append(arguments[1])
        if function is press and self.executor.waiting:
            self.executor.waiting.pop(0)[1].set_result(GroupResult({}, 0.0))


def test_groups_of_a_cluster_are_not_canceled_but_get_each_press(by_hand):
    group = Group.of(Path("test.ini"), RunOptions(), 0, None)
    workers = Elsewhere(by_hand)
    with StopOnInterrupt() as interrupt:
        groups = GroupExecutor(workers, group, interrupt)
        future = groups.submit(0)
        groups.advance()
        signal.raise_signal(signal.SIGINT)
        with pytest.raises(CancelledError):
            future.result()
    assert workers.presses == [1]


def test_a_group_that_the_executor_cancels_is_lost(groups, by_hand):
    future = groups.submit(0)
    groups.advance()
    by_hand.waiting[0][1].cancel()
    with pytest.raises(WorkersLostError):
        future.result()


def test_a_group_that_fails_fails_its_runs(groups, by_hand):
    future = groups.submit(0)
    groups.advance()
    by_hand.waiting[0][1].set_exception(RuntimeError("the disk is full"))
    with pytest.raises(WorkerError, match="the disk is full"):
        future.result()


def test_runs_that_a_group_did_not_begin_are_not_begun(groups, by_hand):
    future = groups.submit(0)
    groups.advance()
    by_hand.waiting[0][1].set_result(GroupResult({}, 0.0))
    with pytest.raises(CancelledError):
        future.result()


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
    assert "RuntimeError: spoilt" in printed.err
    assert "Failing: run 0 failed, " in printed.err
    assert " 0 of 3 runs are done, " in printed.err
