import math

import pytest
from simulated import Recorder, build, fired, protocol, timers

from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration, Simulator


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


def test_an_unknown_node_is_an_error():
    with pytest.raises(KeyError, match=r"no node 5, only \[0\]"):
        build(protocol()).get_node(5)


def test_an_id_is_given_once():
    simulator = build(protocol())
    with pytest.raises(ValueError, match="id 0 already"):
        simulator.create_node((0, 0, 0), protocol(), 0)


@pytest.mark.parametrize("position", [(1, 2), (1, 2, math.nan), "123"])
def test_a_malformed_position_is_refused(position):
    with pytest.raises(ValueError, match="the position of a node must be three finite numbers"):
        SimulationBuilder().add_node(protocol(), position)


@pytest.mark.parametrize("wrong", [int, "text", None])
def test_what_is_no_protocol_class_is_refused(wrong):
    with pytest.raises(TypeError, match="protocol's class"):
        SimulationBuilder().add_node(wrong, (0, 0, 0))


def test_an_instance_of_a_protocol_is_refused():
    with pytest.raises(TypeError, match="protocol's class"):
        SimulationBuilder().add_node(protocol()(), (0, 0, 0))


@pytest.mark.parametrize("wrong", [TimerHandler, "text", None])
def test_what_is_no_handler_is_refused(wrong):
    with pytest.raises(TypeError, match="handler"):
        SimulationBuilder().add_handler(wrong)


def test_a_wrong_configuration_is_refused():
    with pytest.raises(ValueError, match="real_time"):
        Simulator({}, SimulationConfiguration(real_time=-1))
