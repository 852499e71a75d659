import pytest

from gradysim.simulator import pacing


@pytest.fixture
def clock(monkeypatch):
    """A wall clock that goes on only while somebody sleeps."""

    class Clock:
        now = 100.0
        sleeps: list[float]

        def monotonic(self):
            return self.now

        def sleep(self, duration_s):
            self.sleeps.append(duration_s)
            self.now += duration_s

    clock = Clock()
    clock.sleeps = []
    monkeypatch.setattr(pacing, "time", clock)
    return clock


@pytest.mark.parametrize(("factor", "wall_s"), [(1.0, 10.0), (2.0, 5.0), (0.5, 20.0)])
def test_simulated_time_goes_by_at_the_factor(clock, factor, wall_s):
    pacing.RealTimePacer(factor).wait_until(10.0)
    assert clock.now - 100.0 == wall_s


def test_time_spent_elsewhere_is_not_slept_again(clock):
    pacer = pacing.RealTimePacer(1.0)
    clock.now += 3.0
    pacer.wait_until(10.0)
    assert clock.sleeps == [7.0]


def test_who_is_late_does_not_sleep(clock):
    pacer = pacing.RealTimePacer(1.0)
    clock.now += 11.0
    pacer.wait_until(10.0)
    assert clock.sleeps == []


def test_what_was_held_up_on_purpose_is_not_caught_up_on(clock):
    pacer = pacing.RealTimePacer(2.0)
    clock.now += 7.0
    pacer.held_up_s = 4.0
    assert (pacer.elapsed_s, pacer.remaining_s(10.0)) == (3.0, 2.0)
