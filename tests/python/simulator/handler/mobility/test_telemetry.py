from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.simulator.handler.mobility.updates import TelemetryGroup
from gradysim.simulator.node import Node


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
