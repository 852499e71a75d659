import pytest

from gradysim.simulator.handler.mobility.updates import UpdateTimes


@pytest.mark.parametrize("rate", [0.01, 0.1, 0.03, 1.0, 2.5])
def test_the_first_update_comes_after_one_interval(rate):
    assert UpdateTimes(rate).time_of(1) == rate


def test_whole_frequencies_meet_the_timers_of_that_time():
    times = UpdateTimes(0.01)
    assert [times.time_of(update) for update in (35, 41, 57, 70)] == [0.35, 0.41, 0.57, 0.7]


def test_rounding_does_not_add_up():
    assert UpdateTimes(0.1).time_of(1_000_000) == 100_000.0


def test_they_count_from_the_start():
    assert UpdateTimes(0.5, start_s=10.0).time_of(3) == 11.5


@pytest.mark.parametrize(
    ("timestamp", "update"),
    [(0.02, 3), (0.05, 4), (0.35, 34), (0.3501, 35), (0.4, 39), (0.41, 40), (9e9, 40)],
)
def test_the_last_one_before_a_time(timestamp, update):
    assert UpdateTimes(0.01).last_before(timestamp, range(3, 41)) == update


def test_a_tiny_interval_is_no_whole_frequency():
    assert UpdateTimes(1e-12).time_of(2) == 2e-12
