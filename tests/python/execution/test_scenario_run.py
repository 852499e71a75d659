import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.execution import scenario_run
from gradysim.execution.scenario_run import CHUNK_S, MAX_EVENTS, next_chunk, run_in_chunks


class Clock:
    """Wall time that passes only when the fake simulator works."""

    def __init__(self):
        self.time_s = 0.0

    def __call__(self):
        return self.time_s


@pytest.fixture
def clock(monkeypatch):
    clock = Clock()
    monkeypatch.setattr(scenario_run, "perf_counter", clock)
    return clock


class Work:
    """A simulator of `total` events, each of which takes `event_s` of wall time."""

    def __init__(self, clock, total, event_s=1e-4):
        self.clock, self.total, self.event_s = clock, total, event_s
        self.done = 0
        self.took = []

    def advance(self, max_events):
        events = min(max_events, self.total - self.done)
        self.done += events
        self.clock.time_s += events * self.event_s
        self.took.append(events * self.event_s)
        return self.done == self.total

    def now(self):
        return float(self.done)


@given(total=st.integers(1, 10_000))
def test_every_event_is_executed(total):
    work = Work(Clock(), total)
    assert run_in_chunks(work.advance, work.now)
    assert work.done == total


def test_chunks_settle_at_their_wall_time(clock):
    work = Work(clock, 100_000)
    run_in_chunks(work.advance, work.now)
    assert work.took[10] == pytest.approx(CHUNK_S, rel=0.02)


def test_progress_is_called_ten_times_a_second(clock):
    work, times = Work(clock, 100_000), []
    run_in_chunks(work.advance, work.now, progress=times.append)
    assert len(times) == pytest.approx(10 * clock.time_s, rel=0.4)


def test_progress_ends_at_the_end_of_the_shortest_run(clock):
    work, times = Work(clock, 1), []
    run_in_chunks(work.advance, work.now, progress=times.append)
    assert times == [1.0]


def test_progress_ends_where_the_run_was_stopped(clock):
    work, times = Work(clock, 10_000, event_s=1e-6), []
    run_in_chunks(work.advance, work.now, progress=times.append, should_stop=lambda: work.done > 500)
    assert times == [float(work.done)]


def test_should_stop_ends_the_run_before_its_end(clock):
    work = Work(clock, 10_000)
    assert not run_in_chunks(work.advance, work.now, should_stop=lambda: work.done > 500)
    assert 500 < work.done < 10_000


def test_a_run_that_is_complete_was_not_stopped(clock):
    work = Work(clock, 10)
    assert run_in_chunks(work.advance, work.now, should_stop=lambda: True)


def test_a_chunk_is_four_times_the_one_before_at_most():
    assert next_chunk(64, CHUNK_S / 1000) == 4 * 64
    assert next_chunk(64, CHUNK_S * 1000) == 64 / 4


@given(max_events=st.integers(1, 10**9), took_s=st.floats(0, 1e6))
def test_a_chunk_never_becomes_empty_or_endless(max_events, took_s):
    assert 1 <= next_chunk(max_events, took_s) <= MAX_EVENTS
