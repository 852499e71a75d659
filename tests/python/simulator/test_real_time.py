import pytest

from gradysim.simulator import real_time
from gradysim.simulator.real_time import full_speed, is_full_speed


@pytest.mark.parametrize(("factor", "wall_s"), [(1.0, 10.0), (2.0, 5.0), (0.5, 20.0)])
def test_simulated_time_goes_by_at_the_factor(wall_clock, factor, wall_s):
    real_time.RealTimePacer(factor).wait_until(10.0)
    assert wall_clock.now - 100.0 == wall_s


def test_time_spent_elsewhere_is_not_slept_again(wall_clock):
    pacer = real_time.RealTimePacer(1.0)
    wall_clock.now += 3.0
    pacer.wait_until(10.0)
    assert wall_clock.sleeps == [7.0]


def test_who_is_late_does_not_sleep(wall_clock):
    pacer = real_time.RealTimePacer(1.0)
    wall_clock.now += 11.0
    pacer.wait_until(10.0)
    assert wall_clock.sleeps == []


def test_what_was_held_up_on_purpose_is_not_caught_up_on(wall_clock):
    pacer = real_time.RealTimePacer(2.0)
    wall_clock.now += 7.0
    pacer.paused_s = 4.0
    assert (pacer.elapsed_s, pacer.remaining_s(10.0)) == (3.0, 2.0)


def test_simulated_time_that_is_due(wall_clock):
    pacer = real_time.RealTimePacer(2.0)
    wall_clock.now += 3.0
    assert (pacer.due_s(), pacer.due_s(ahead_s=0.5)) == (6.0, 7.0)


@pytest.mark.parametrize(("given", "factor"), [(False, 0.0), (True, 1.0), (2, 2.0), (0.5, 0.5)])
def test_the_factor(given, factor):
    assert real_time.real_time_factor(given) == factor


@pytest.mark.parametrize("given", [-1, float("nan"), float("inf"), "fast", None])
def test_a_factor_that_is_none(given):
    with pytest.raises(ValueError, match="real_time"):
        real_time.real_time_factor(given)


def test_it_ends_with_the_outermost_context() -> None:
    seen = [is_full_speed()]
    with full_speed():
        with full_speed():
            seen.append(is_full_speed())
        seen.append(is_full_speed())
    seen.append(is_full_speed())
    assert seen == [False, True, True, False]
