from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.simulator.handler.mobility.updates import TelemetryGroup, UpdateTimes
from gradysim.simulator.node import Node


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


def due(interval, count):
    group = TelemetryGroup(interval)
    return [update for update in range(1, count + 1) if group.is_due(update)]


@pytest.mark.parametrize(
    ("interval", "updates"),
    [(1.0, [1, 2, 3, 4, 5, 6]), (2.0, [2, 4, 6]), (2.5, [3, 5]), (1.5, [2, 3, 5, 6]), (7.0, [])],
)
def test_telemetry_comes_with_the_first_update_at_or_after_its_time(interval, updates):
    assert due(interval, 6) == updates


@pytest.mark.parametrize("interval", [1.0, 2.0, 2.5, 7.0])
def test_updates_before_the_one_that_is_due_may_be_left_out(interval):
    group = TelemetryGroup(interval)
    given_out = []
    while group.due <= 30:
        given_out.append(group.due)
        assert group.is_due(group.due)
    assert given_out == due(interval, 30)


@given(st.integers(1, 64), st.integers(1, 16))
def test_an_interval_is_kept_on_average(numerator, denominator):
    interval = max(Fraction(numerator, denominator), Fraction(1))
    assert len(due(float(interval), 200)) == pytest.approx(200 / interval, abs=1)


def test_a_delivery_tells_the_position_of_its_instant():
    seen = []

    class Encapsulator:
        def handle_telemetry(self, telemetry):
            seen.append(telemetry.current_position)

    node = Node()
    node.id, node.position, node.protocol_encapsulator = 4, (0, 0, 0), Encapsulator()
    group = TelemetryGroup(1.0)
    group.add(node)
    node.position = (1, 2, 3)
    [(callback, context)] = group.deliveries
    callback()
    assert (seen, context) == ([(1, 2, 3)], "Node 4 handle_telemetry")
