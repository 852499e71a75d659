from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.plugin.follow_mobility.broadcast_clock import BroadcastClock

intervals = st.floats(1e-3, 1e3)
jitters = st.floats(0, 1)
starts = st.floats(0, 1e5)


def times(clock, start, count):
    """What the clock says when it is asked at each of its own times."""
    result = [clock.next(start)]
    while len(result) < count:
        result.append(clock.next(result[-1]))
    return result


@given(intervals, jitters, starts, st.randoms(use_true_random=False))
def test_each_interval_has_one_broadcast_in_its_first_part(interval, jitter, start, random):
    for number, time in enumerate(times(BroadcastClock(interval, jitter, start, random), start, 50), start=1):
        offset = (time - start) / interval - number
        assert -1e-6 <= offset <= jitter + 1e-6


@given(intervals, jitters, starts, st.randoms(use_true_random=False), st.floats(0, 1e5))
def test_it_never_says_a_time_in_the_past(interval, jitter, start, random, late):
    clock = BroadcastClock(interval, jitter, start, random)
    clock.next(start)
    assert clock.next(start + late) >= start + late


def test_intervals_that_have_gone_by_are_left_out():
    clock = BroadcastClock(1.0, 0.0, 0.0, Random(0))
    assert [clock.next(0.0), clock.next(7.5), clock.next(8.0)] == [1.0, 8.0, 9.0]


def test_a_broadcast_at_the_very_end_of_its_interval_leaves_the_next_one_its_own():
    class Latest(Random):
        def uniform(self, a, b):
            return b

    clock = BroadcastClock(546.97, 1.0, 0.0, Latest())
    assert times(clock, 0.0, 50) == pytest.approx([546.97 * (number + 1) for number in range(1, 51)])


def test_without_jitter_it_is_periodic():
    assert times(BroadcastClock(0.5, 0.0, 2.0, Random(0)), 2.0, 4) == [2.5, 3.0, 3.5, 4.0]


def test_the_mean_time_between_two_is_the_interval():
    result = times(BroadcastClock(0.5, 1.0, 0.0, Random(0)), 0.0, 1001)
    assert (result[-1] - result[0]) / 1000 == pytest.approx(0.5, abs=0.5 / 1000)


def test_two_clocks_with_other_streams_do_not_tick_together():
    one, other = (times(BroadcastClock(0.02, 0.5, 0.0, Random(seed)), 0.0, 100) for seed in (1, 2))
    assert set(one).isdisjoint(other)
