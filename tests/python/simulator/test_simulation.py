import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.simulator import simulation
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.simulation import PositionScheme, SimulationBuilder, SimulationConfiguration
from python.simulator.simulator.simulated import Recorder, fired, protocol, timers


def test_ids_count_from_zero():
    builder = SimulationBuilder()
    assert [builder.add_node(protocol(), (0, 0, 0)) for _ in range(3)] == [0, 1, 2]


def test_a_node_has_its_position_and_protocol():
    tested = protocol()
    builder = SimulationBuilder()
    builder.add_node(tested, [1, 2, 3])
    node = builder.build().get_node(0)
    assert (node.id, node.position, type(node.protocol_encapsulator.protocol)) == (0, (1.0, 2.0, 3.0), tested)


def test_adding_a_handler_returns_the_builder():
    builder = SimulationBuilder()
    assert builder.add_handler(TimerHandler()) is builder


def test_the_last_handler_of_a_label_wins():
    calls = []
    builder = SimulationBuilder()
    builder.add_handler(Recorder([])).add_handler(Recorder(calls))
    builder.build()
    assert calls == [("inject",)]


def test_building_twice_makes_two_simulations():
    tested = timers(1)
    builder = SimulationBuilder(SimulationConfiguration(duration=2)).add_handler(TimerHandler())
    builder.add_node(tested, (0, 0, 0))
    for _ in range(2):
        builder.build().start_simulation()
    assert fired(tested) == ["1", "1"]


def test_nodes_are_prepared_before_their_protocols_are_made():
    seen = []
    builder = SimulationBuilder()
    builder.add_node(protocol(), (0, 0, 0))
    builder.add_node(protocol(), (0, 0, 0))
    builder.prepare_nodes(
        lambda node: seen.append((node.id, hasattr(node.protocol_encapsulator, "protocol")))
    )
    builder.build()
    assert seen == [(0, False), (1, False)]


@pytest.mark.parametrize("position", [(1, 2), (1, 2, math.nan), "123"])
def test_a_malformed_position_is_refused(position):
    with pytest.raises(ValueError, match="position"):
        SimulationBuilder().add_node(protocol(), position)


@pytest.mark.parametrize("wrong", [TimerHandler, "text", None])
def test_what_is_no_handler_is_refused(wrong):
    with pytest.raises(TypeError, match="handler"):
        SimulationBuilder().add_handler(wrong)


def test_the_names_of_the_published_module_are_here():
    assert {"PositionScheme", "SimulationBuilder", "SimulationConfiguration", "Simulator"} <= set(
        vars(simulation)
    )
    assert simulation.PositionScheme is PositionScheme


ranges = st.tuples(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6)).map(lambda pair: (min(pair), max(pair)))


@given(ranges, ranges, ranges)
def test_points_lie_in_the_box(x_range, y_range, z_range):
    position = PositionScheme.random(x_range, y_range, z_range)
    assert all(
        low <= coordinate <= high
        for coordinate, (low, high) in zip(position, (x_range, y_range, z_range), strict=True)
    )


@pytest.mark.parametrize(("share", "corner"), [(0, (-10, -10, 0)), (1, (10, 10, 10))])
def test_the_corners_of_the_default_box(monkeypatch, share, corner):
    monkeypatch.setattr("random.uniform", lambda low, high: low + share * (high - low))
    assert PositionScheme.random() == corner


@pytest.mark.parametrize("wrong", [(5, -5), 5, (1, 2, 3), (0, float("nan")), ("a", "b"), None])
def test_what_is_no_range_is_refused(wrong):
    with pytest.raises(ValueError, match="y_range"):
        PositionScheme.random(y_range=wrong)
