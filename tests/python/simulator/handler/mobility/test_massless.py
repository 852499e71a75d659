import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.messages.communication import BroadcastMessageCommand
from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    GotoGeoCoordsMobilityCommand,
    MobilityCommand,
    SetSpeedMobilityCommand,
    SetVelocityMobilityCommand,
)
from gradysim.protocol.position import geo_to_cartesian, squared_distance
from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler import mobility
from gradysim.simulator.handler.mobility import (
    MasslessMobilityConfiguration,
    MasslessMobilityException,
    MasslessMobilityHandler,
)


@pytest.fixture
def handler(world):
    handler = MasslessMobilityHandler(MasslessMobilityConfiguration(update_rate=0.5, default_speed=10))
    handler.inject(world.loop)
    return handler


def telemetry(node):
    return node.protocol_encapsulator.calls


def test_the_label():
    assert MasslessMobilityHandler.get_label() == "mobility"


def test_the_defaults_are_the_published_ones():
    assert MasslessMobilityConfiguration() == MasslessMobilityConfiguration(
        update_rate=0.01, default_speed=10, reference_coordinates=(0, 0, 0)
    )


@pytest.mark.parametrize("name", ["Handler", "Configuration", "Exception"])
def test_the_old_names_are_the_massless_ones(name):
    assert getattr(mobility, f"Mobility{name}") is getattr(mobility, f"MasslessMobility{name}")


def test_the_first_update_is_scheduled_at_injection(world, handler):
    assert (len(world.loop), world.loop.peek_event().timestamp) == (1, 0.5)


def test_in_a_second_simulation_the_nodes_of_the_first_one_are_forgotten(world, new_world, handler):
    old = world.node(0, handler=handler)
    handler.handle_command(GotoCoordsMobilityCommand(9, 9, 9), old)
    second = new_world()
    handler.inject(second.loop)
    new = second.node(0, handler=handler)
    second.run(until=0.5)
    assert (telemetry(old), old.position, telemetry(new)) == ([], (0, 0, 0), [(0.5, (0, 0, 0))])


def test_an_update_and_each_telemetry_are_events_of_their_own(world, handler):
    nodes = [world.node(number, handler=handler) for number in range(3)]
    world.loop.pop_event().callback()
    assert (len(world.loop), [telemetry(node) for node in nodes]) == (4, [[], [], []])
    world.loop.pop_event().callback()
    assert [len(telemetry(node)) for node in nodes] == [1, 0, 0]


def test_a_node_without_a_command_stays_and_has_telemetry(world, handler):
    node = world.node(0, (1.0, 2.0, 3.0), handler)
    world.run(1.0)
    assert telemetry(node) == [(0.5, (1, 2, 3)), (1.0, (1, 2, 3))]


def test_a_node_flies_straight_at_its_speed_and_stops_at_its_target(world, handler):
    node = world.node(0, handler=handler)
    handler.handle_command(GotoCoordsMobilityCommand(12, 0, 0), node)
    world.run(2.0)
    assert [position[0] for _, position in telemetry(node)] == [5, 10, 12, 12]


def test_the_target_is_reached_exactly(world, handler):
    node = world.node(0, (0.1, 0.2, 0.3), handler)
    handler.handle_command(GotoCoordsMobilityCommand(1.7, -2.9, 3.1), node)
    world.run(5.0)
    assert node.position == (1.7, -2.9, 3.1)


def test_a_target_at_exactly_one_step_is_reached_exactly(world, handler):
    target = (5.9, 7.1, 0.8)  # by rounding, x / distance * distance is not x
    node = world.node(0, handler=handler)
    handler.handle_command(GotoCoordsMobilityCommand(*target), node)
    handler.handle_command(SetSpeedMobilityCommand(2 * math.sqrt(squared_distance((0, 0, 0), target))), node)
    world.run(0.5)
    assert node.position == target


def test_the_speed_can_be_set(world, handler):
    node = world.node(0, handler=handler)
    handler.handle_command(GotoCoordsMobilityCommand(100, 0, 0), node)
    handler.handle_command(SetSpeedMobilityCommand(4), node)
    world.run(1.0)
    assert node.position == (4, 0, 0)


def test_at_speed_zero_a_node_stays(world, handler):
    node = world.node(0, handler=handler)
    handler.handle_command(GotoCoordsMobilityCommand(100, 0, 0), node)
    handler.handle_command(SetSpeedMobilityCommand(0), node)
    world.run(1.0)
    assert node.position == (0, 0, 0)


def test_a_new_target_replaces_the_old_one(world, handler):
    node = world.node(0, handler=handler)
    handler.handle_command(GotoCoordsMobilityCommand(100, 0, 0), node)
    world.run(0.5)
    handler.handle_command(GotoCoordsMobilityCommand(5, 100, 0), node)
    world.run(1.0)
    assert node.position == (5, 5, 0)


@pytest.mark.parametrize("time_s", [0.6, 0.9, 1.0])
def test_a_command_counts_for_the_whole_step_to_the_next_update(world, handler, time_s):
    node = world.node(0, handler=handler)
    handler.handle_command(GotoCoordsMobilityCommand(100, 0, 0), node)
    turn = GotoCoordsMobilityCommand(5, 100, 0)
    world.loop.schedule_event(time_s, lambda: handler.handle_command(turn, node))
    world.run(1.0)
    assert telemetry(node) == [(0.5, (5, 0, 0)), (1.0, (5, 5, 0))]


def test_a_geographic_target_is_placed_by_the_reference(world):
    reference = (10, 20, 0)
    handler = MasslessMobilityHandler(
        MasslessMobilityConfiguration(update_rate=1, default_speed=1e6, reference_coordinates=reference)
    )
    handler.inject(world.loop)
    node = world.node(0, handler=handler)
    handler.handle_command(GotoGeoCoordsMobilityCommand(10.01, 19.99, 30), node)
    world.run(1)
    assert node.position == geo_to_cartesian(reference, (10.01, 19.99, 30))


def test_targets_and_speeds_are_public(world, handler):
    node = world.node(0, handler=handler)
    handler.handle_command(GotoCoordsMobilityCommand(1, 2, 3), node)
    assert (handler.nodes, handler.targets, handler.speeds) == ({0: node}, {0: (1, 2, 3)}, {0: 10})


def test_updates_meet_the_times_as_they_are_written(world):
    handler = MasslessMobilityHandler(MasslessMobilityConfiguration(update_rate=0.01))
    handler.inject(world.loop)
    node = world.node(0, handler=handler)
    world.run(1.0)
    assert [time for time, _ in telemetry(node)] == [float(f"{number / 100:.2f}") for number in range(1, 101)]


@pytest.mark.parametrize("update_rate", [0.3, 2, 1.5, 1e-10])
def test_any_update_rate_is_kept(world, update_rate):
    handler = MasslessMobilityHandler(MasslessMobilityConfiguration(update_rate=update_rate))
    handler.inject(world.loop)
    node = world.node(0, handler=handler)
    world.run(10 * update_rate)
    assert [time for time, _ in telemetry(node)] == pytest.approx(
        [number * update_rate for number in range(1, 11)], rel=1e-12
    )


def test_a_handler_injected_later_counts_from_then(world):
    world.loop.schedule_event(2.0, lambda: None)
    world.run()
    handler = MasslessMobilityHandler(MasslessMobilityConfiguration(update_rate=0.5))
    handler.inject(world.loop)
    assert world.loop.peek_event().timestamp == 2.5


coordinates = st.floats(-1000, 1000)
positions = st.tuples(coordinates, coordinates, coordinates)


@given(start=positions, target=positions, speed=st.floats(0.1, 100), update_rate=st.floats(0.01, 1))
def test_a_step_is_speed_times_update_rate_along_the_line(new_world, start, target, speed, update_rate):
    world = new_world()
    handler = MasslessMobilityHandler(MasslessMobilityConfiguration(update_rate, speed))
    handler.inject(world.loop)
    node = world.node(0, start, handler)
    handler.handle_command(GotoCoordsMobilityCommand(*target), node)
    world.loop.pop_event().callback()
    distance = math.dist(start, target)
    step = speed * update_rate
    if distance <= step * (1 - 1e-9):
        assert node.position == target
    elif distance > step * (1 + 1e-9):
        share = step / distance
        expected = [a + (b - a) * share for a, b in zip(start, target, strict=True)]
        assert node.position == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize(
    "command",
    [
        GotoCoordsMobilityCommand(1, math.nan, 3),
        GotoCoordsMobilityCommand(1, 2, None),
        GotoCoordsMobilityCommand("1", 2, 3),
        GotoGeoCoordsMobilityCommand(91, 0, 0),
        SetSpeedMobilityCommand(-1),
        SetSpeedMobilityCommand(math.inf),
        SetSpeedMobilityCommand(None),
        SetVelocityMobilityCommand(1, 2, 3),
        SetVelocityMobilityCommand(1, 2, None),
        SetVelocityMobilityCommand(1, None, 3),
        "land",
        BroadcastMessageCommand("hi"),
        MobilityCommand(9),
    ],
)
def test_an_invalid_command_is_refused(world, handler, command):
    node = world.node(0, handler=handler)
    with pytest.raises(MasslessMobilityException):
        handler.handle_command(command, node)


def test_a_stranger_is_refused(world, handler):
    with pytest.raises(MasslessMobilityException, match="node 7"):
        handler.handle_command(SetSpeedMobilityCommand(1), world.node(7))


def test_nodes_come_after_the_event_loop(world):
    with pytest.raises(MasslessMobilityException, match="node 0"):
        MasslessMobilityHandler().register_node(world.node(0))


def test_a_new_event_loop_forgets_the_nodes(world, handler):
    node = world.node(0, handler=handler)
    handler.inject(EventLoop())
    assert (handler.nodes, handler.targets, handler.speeds) == ({}, {}, {})
    with pytest.raises(MasslessMobilityException):
        handler.handle_command(SetSpeedMobilityCommand(1), node)


@pytest.mark.parametrize(
    "wrong",
    [
        {"update_rate": 0},
        {"update_rate": math.nan},
        {"update_rate": "often"},
        {"default_speed": -1},
        {"default_speed": math.inf},
        {"reference_coordinates": (91, 0, 0)},
        {"reference_coordinates": (0, math.nan, 0)},
        {"reference_coordinates": (0, 0)},
        {"reference_coordinates": None},
    ],
)
def test_a_wrong_configuration_is_refused(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        MasslessMobilityConfiguration(**wrong)


def test_what_is_no_configuration_is_refused():
    with pytest.raises(TypeError, match="MasslessMobilityConfiguration"):
        MasslessMobilityHandler(0.1)


class TestNodesOfTheirOwnKind:
    def test_speed(self, world, handler):
        handler.configure_node(0, speed=2)
        node = world.node(0, handler=handler)
        handler.handle_command(GotoCoordsMobilityCommand(100, 0, 0), node)
        world.run(1.0)
        assert node.position == (2, 0, 0)

    def test_telemetry_every_kth_update(self, world, handler):
        handler.configure_node(0, telemetry_interval=1.5)
        node = world.node(0, handler=handler)
        world.run(5.0)
        assert [time for time, _ in telemetry(node)] == [1.5, 3.0, 4.5]

    def test_motion_does_not_wait_for_telemetry(self, world, handler):
        handler.configure_node(0, telemetry_interval=2)
        node = world.node(0, handler=handler)
        handler.handle_command(GotoCoordsMobilityCommand(100, 0, 0), node)
        world.run(1.0)
        assert node.position == (10, 0, 0)

    def test_no_telemetry(self, world, handler):
        handler.configure_node(0, telemetry_interval=0)
        node = world.node(0, handler=handler)
        assert world.run(5.0) == 10
        assert telemetry(node) == []

    def test_the_others_are_not_concerned(self, world, handler):
        handler.configure_node(0, telemetry_interval=0, speed=1)
        world.node(0, handler=handler)
        other = world.node(1, handler=handler)
        world.run(1.0)
        assert (len(telemetry(other)), handler.speeds) == (2, {0: 1, 1: 10})

    @pytest.mark.parametrize("command", [GotoCoordsMobilityCommand(1, 2, 3), SetSpeedMobilityCommand(1)])
    def test_a_stationary_node_refuses_commands(self, world, handler, command):
        handler.configure_node(0, stationary=True)
        with pytest.raises(MasslessMobilityException, match="node 0"):
            handler.handle_command(command, world.node(0, handler=handler))

    def test_settings_hold_in_the_next_simulation_too(self, world, handler):
        handler.configure_node(0, speed=2)
        handler.inject(EventLoop())
        world.node(0, handler=handler)
        assert handler.speeds == {0: 2}

    def test_a_registered_node_is_settled(self, world, handler):
        world.node(0, handler=handler)
        with pytest.raises(MasslessMobilityException):
            handler.configure_node(0, speed=2)

    @pytest.mark.parametrize(
        ("wrong", "text"),
        [
            ({"speed": -1}, r"speed .* 0\b"),
            ({"speed": math.nan}, r"speed .* 0\b"),
            ({"telemetry_interval": -1}, r"telemetry_interval .* 0\b"),
            ({"telemetry_interval": math.inf}, r"telemetry_interval .* 0\b"),
            ({"telemetry_interval": 0.4}, r"update_rate .*0\.5 s"),
        ],
    )
    def test_wrong_settings_are_refused(self, handler, wrong, text):
        with pytest.raises(ValueError, match=text):
            handler.configure_node(0, **wrong)
