import math

import pytest

from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    MobilityCommand,
    MobilityCommandType,
    SetSpeedMobilityCommand,
    SetVelocityMobilityCommand,
)
from gradysim.simulator.handler.mobility import (
    DynamicVelocityMobilityConfiguration,
    DynamicVelocityMobilityException,
    DynamicVelocityMobilityHandler,
    DynamicVelocityTelemetry,
)


class Hangar:
    """One handler in a world; `node` is its only node unless more are added."""

    def __init__(self, world, settings):
        limits = {"max_speed_xy": 10, "max_speed_z": 5, "max_acc_xy": 2, "max_acc_z": 1}
        configuration = DynamicVelocityMobilityConfiguration(**{"update_rate": 0.1} | limits | settings)
        self.handler = DynamicVelocityMobilityHandler(configuration)
        self.handler.inject(world.loop)
        self.node = world.node(0, handler=self.handler)
        self.telemetry = []
        self.node.protocol_encapsulator.handle_telemetry = self.telemetry.append
        self.handler.initialize()

    def fly(self, *velocity):
        self.handler.handle_command(SetVelocityMobilityCommand(*velocity), self.node)


@pytest.fixture
def hangar(world):
    return lambda **settings: Hangar(world, settings)


def test_its_label():
    assert DynamicVelocityMobilityHandler.get_label() == "mobility"


def test_in_a_second_simulation_the_nodes_of_the_first_one_are_forgotten(new_world, hangar):
    place = hangar()
    place.fly(1, 0, 0)
    world = new_world()
    place.handler.inject(world.loop)
    new = world.node(0, handler=place.handler)
    place.handler.initialize()
    seen = []
    new.protocol_encapsulator.handle_telemetry = seen.append
    world.run(until=0.1)
    assert (place.telemetry, [told.current_velocity for told in seen]) == ([], [(0, 0, 0)])


def test_a_handler_injected_later_counts_from_then(world, hangar):
    world.loop.advance_to(5)
    hangar(update_rate=0.5)
    assert world.loop.peek_event().timestamp == 5.5


def test_velocity_grows_with_the_acceleration_and_then_the_position(world, hangar):
    place = hangar()
    place.fly(3, 0, 1)
    world.run(until=0.3)
    assert place.node.position == pytest.approx((0.12, 0.0, 0.06))
    assert place.handler.velocities[0] == pytest.approx((0.6, 0.0, 0.3))


def test_a_velocity_holds_until_another_is_asked_for(world, hangar):
    place = hangar(max_acc_xy=math.inf)
    place.fly(2, 0, 0)
    world.run(until=10)
    assert place.node.position == pytest.approx((20, 0, 0))


def test_the_speed_is_limited(world, hangar):
    place = hangar(max_acc_xy=math.inf)
    place.fly(30, 40, 0)
    world.run(until=1)
    assert place.handler.velocities[0] == pytest.approx((6, 8, 0))


def test_time_constants(world, hangar):
    place = hangar(max_acc_xy=math.inf, tau_xy=1.0)
    place.fly(1, 0, 0)
    world.run(until=0.2)
    assert place.handler.velocities[0] == pytest.approx((0.19, 0, 0))


def test_without_a_command_a_node_stays(world, hangar):
    place = hangar()
    world.run(until=1)
    assert place.node.position == (0.0, 0.0, 0.0)


def test_telemetry_tells_position_and_velocity(world, hangar):
    place = hangar()
    place.fly(3, 0, 0)
    world.run(until=0.1)
    (telemetry,) = place.telemetry
    assert isinstance(telemetry, DynamicVelocityTelemetry)
    assert telemetry.current_position == pytest.approx((0.02, 0, 0))
    assert telemetry.current_velocity == pytest.approx((0.2, 0, 0))


def test_update_and_telemetry_are_events_of_their_own(world, hangar):
    hangar()
    update = world.loop.pop_event()
    update.callback()
    assert (update.context, world.loop.pop_event().context) == ("Mobility", "Node 0 handle_telemetry")


@pytest.mark.parametrize(
    ("settings", "count"), [({}, 6), ({"telemetry_decimation": 2}, 3), ({"send_telemetry": False}, 0)]
)
def test_how_often_telemetry_comes(world, hangar, settings, count):
    place = hangar(**settings)
    world.run(until=0.6)
    assert len(place.telemetry) == count


def test_without_nodes_there_are_no_updates(world):
    handler = DynamicVelocityMobilityHandler(DynamicVelocityMobilityConfiguration(0.1, 1, 1, 1, 1))
    handler.inject(world.loop)
    handler.initialize()
    assert len(world.loop) == 0


def test_a_new_simulation_forgets_the_nodes_of_the_last(world, new_world, hangar):
    place = hangar()
    place.handler.inject(new_world().loop)
    assert (place.handler.nodes, place.handler.velocities) == ({}, {})


@pytest.mark.parametrize(
    "command",
    [
        SetSpeedMobilityCommand(1),
        GotoCoordsMobilityCommand(1, 2, 3),
        SetVelocityMobilityCommand(1, 2, math.nan),
        SetVelocityMobilityCommand(1, math.inf, 2),
        SetVelocityMobilityCommand(1, "2", 3),
        MobilityCommand(MobilityCommandType.SET_SPEED),
        "faster",
    ],
)
def test_other_commands_are_refused(hangar, command):
    place = hangar()
    with pytest.raises(DynamicVelocityMobilityException, match="SetVelocityMobilityCommand"):
        place.handler.handle_command(command, place.node)


def test_an_unregistered_node_is_refused(world, hangar):
    with pytest.raises(DynamicVelocityMobilityException, match="node 7"):
        hangar().handler.handle_command(SetVelocityMobilityCommand(1, 2, 3), world.node(7))


def test_what_is_no_configuration_is_refused():
    with pytest.raises(TypeError, match="DynamicVelocityMobilityConfiguration"):
        DynamicVelocityMobilityHandler(None)
