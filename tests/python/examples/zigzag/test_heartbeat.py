import math
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from heartbeat import HeartbeatClock


def test_without_jitter_all_clocks_agree_exactly_wherever_they_start() -> None:
    early = HeartbeatClock(0.1, 0.0, start=0.0, random=Random(1))
    late = HeartbeatClock(0.1, 0.0, start=30.05, random=Random(2))
    instants = {early.next() for _ in range(1000)}
    assert all(late.next() in instants for _ in range(600))


def test_the_first_heartbeat_comes_after_the_start() -> None:
    assert HeartbeatClock(1.0, 0.0, start=30.0, random=Random(1)).next() == 31.0


@given(
    interval=st.floats(0.01, 100.0),
    fraction=st.floats(0.0, 1.0),
    start=st.floats(0.0, 1e4),
    seed=st.integers(0, 2**32),
)
def test_each_heartbeat_is_late_by_the_jitter_at_most(
    interval: float, fraction: float, start: float, seed: int
) -> None:
    clock = HeartbeatClock(interval, interval * fraction, start, Random(seed))
    first = math.floor(start / interval) + 1
    for number in range(first, first + 20):
        lateness = clock.next() - number * interval
        assert 0 <= lateness <= interval * fraction + 1e-9


@given(interval=st.floats(0.01, 100.0), seed=st.integers(0, 2**32))
def test_time_never_runs_backwards_even_with_the_largest_jitter(interval: float, seed: int) -> None:
    clock = HeartbeatClock(interval, interval, start=0.0, random=Random(seed))
    times = [clock.next() for _ in range(50)]
    assert times == sorted(times)


@pytest.mark.parametrize("interval", [0.0, -1.0, float("nan")])
def test_an_interval_that_is_not_positive_is_refused(interval: float) -> None:
    with pytest.raises(ValueError, match="heartbeat_interval is"):
        HeartbeatClock(interval, 0.0, start=0.0, random=Random(1))


@pytest.mark.parametrize("jitter", [-0.1, 1.5, float("nan")])
def test_a_jitter_outside_the_interval_is_refused(jitter: float) -> None:
    with pytest.raises(ValueError, match="heartbeat_jitter is"):
        HeartbeatClock(1.0, jitter, start=0.0, random=Random(1))
