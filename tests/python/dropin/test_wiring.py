"""Handlers, nodes and event loop combined by hand, as in users' tests and handlers."""

import math
from typing import Any

import pytest

from gradysim.protocol.messages.communication import BroadcastMessageCommand
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand, SetVelocityMobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.communication import CommunicationHandler
from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.handler.mobility import (
    DynamicVelocityMobilityConfiguration,
    DynamicVelocityMobilityHandler,
    MobilityConfiguration,
    MobilityHandler,
)
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.node import Node


class Encapsulated:
    """Encapsulator of a user's handler test: any object with the three callbacks."""

    def __init__(self) -> None:
        self.calls: list[Any] = []

    def handle_packet(self, message: str) -> None:
        self.calls.append(message)

    def handle_timer(self, timer: str) -> None:
        self.calls.append(timer)

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        self.calls.append(telemetry.current_position)


def wired(*handlers: INodeHandler, nodes: int = 1) -> tuple[EventLoop, list[Node[Any]]]:
    """Combine handlers and nodes by hand, as in a user's test."""
    loop = EventLoop()
    made: list[Node[Any]] = []
    for handler in handlers:
        handler.inject(loop)
    for number in range(nodes):
        node: Node[Any] = Node()
        node.id = number
        node.position = (0, 0, 0)
        node.protocol_encapsulator = Encapsulated()
        for handler in handlers:
            handler.register_node(node)
        made.append(node)
    return loop, made


def test_a_timer_is_one_event_of_the_loop() -> None:
    timers = TimerHandler()
    loop, (node,) = wired(timers)
    timers.set_timer("tick", 1.5, node)
    assert len(loop) == 1
    loop.pop_event().callback()
    assert (node.protocol_encapsulator.calls, loop.current_time) == (["tick"], 1.5)


def test_a_message_is_one_event_for_each_receiver() -> None:
    communication = CommunicationHandler()
    loop, nodes = wired(communication, nodes=3)
    communication.handle_command(BroadcastMessageCommand("hi"), nodes[0])
    assert len(loop) == 2
    while len(loop) > 0:
        loop.pop_event().callback()
    assert [node.protocol_encapsulator.calls for node in nodes] == [[], ["hi"], ["hi"]]


def test_the_first_movement_is_scheduled_when_the_loop_is_injected() -> None:
    loop, _ = wired(MobilityHandler(), nodes=0)
    event = loop.peek_event()
    assert event is not None
    assert event.timestamp == 0.01


def test_a_movement_and_each_telemetry_are_events_of_their_own() -> None:
    mobility = MobilityHandler(MobilityConfiguration(update_rate=1))
    loop, nodes = wired(mobility, nodes=2)
    loop.pop_event().callback()
    assert len(loop) == 3  # one telemetry for each node, and the next movement
    loop.pop_event().callback()
    assert [len(node.protocol_encapsulator.calls) for node in nodes] == [1, 0]


def test_a_movement_is_exactly_the_speed_times_the_update_rate() -> None:
    mobility = MobilityHandler(MobilityConfiguration(update_rate=0.5, default_speed=3))
    loop, (node,) = wired(mobility)
    mobility.handle_command(GotoCoordsMobilityCommand(100, 100, 100), node)
    loop.pop_event().callback()
    assert node.position == pytest.approx((1.5 / math.sqrt(3),) * 3)


def test_a_vehicle_stops_at_its_target() -> None:
    mobility = MobilityHandler(MobilityConfiguration(update_rate=1, default_speed=3))
    loop, (node,) = wired(mobility)
    mobility.handle_command(GotoCoordsMobilityCommand(2, 0, 0), node)
    loop.pop_event().callback()
    assert node.position == (2, 0, 0)


def test_a_vehicle_steered_by_velocity_keeps_to_its_limits() -> None:
    configuration = DynamicVelocityMobilityConfiguration(
        update_rate=1, max_speed_xy=10, max_speed_z=5, max_acc_xy=2, max_acc_z=1
    )
    mobility = DynamicVelocityMobilityHandler(configuration)
    loop, (node,) = wired(mobility)
    mobility.initialize()
    mobility.handle_command(SetVelocityMobilityCommand(8, 0, 3), node)
    loop.pop_event().callback()
    assert node.position == (2, 0, 1)
