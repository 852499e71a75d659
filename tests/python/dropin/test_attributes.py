"""Public attributes of instances, which signatures do not show."""

from typing import Any

import pytest

from gradysim.encapsulator.interop import InteropProvider
from gradysim.encapsulator.python import PythonProvider
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand, SetSpeedMobilityCommand
from gradysim.protocol.plugin.follow_mobility import MobilityLeaderPlugin
from gradysim.protocol.plugin.raft import RaftConfig, RaftState
from gradysim.simulator.event import EventLoop
from gradysim.simulator.extension.extension import Extension
from gradysim.simulator.extension.radio import Radio
from gradysim.simulator.handler.communication import CommunicationHandler, CommunicationMedium
from gradysim.simulator.handler.mobility import MobilityHandler
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.node import Node
from python.quiet_protocol import Quiet


@pytest.fixture
def node() -> Node[Any]:
    node: Node[Any] = Node()
    node.id = 3
    node.position = (0, 0, 0)
    return node


def test_a_provider_shows_its_node_and_handlers(node: Node[Any]) -> None:
    mobility = MobilityHandler()
    provider = PythonProvider(node, mobility=mobility)
    assert (provider.node, provider.handlers, provider.tracked_variables) == (
        node,
        {"mobility": mobility},
        {},
    )


def test_a_provider_shows_the_handlers_that_take_its_commands(node: Node[Any]) -> None:
    communication, timer = CommunicationHandler(), TimerHandler()
    provider = PythonProvider(node, communication=communication, timer=timer)
    assert (provider.communication_handler, provider.mobility_handler, provider.timer_handler) == (
        communication,
        None,
        timer,
    )


def test_a_provider_without_timers_is_at_time_zero(node: Node[Any]) -> None:
    assert PythonProvider(node).current_time() == 0


def test_an_interop_provider_starts_empty() -> None:
    provider = InteropProvider()
    assert (provider.consequences, provider.timestamp, provider.id) == ([], 0, 0)
    assert provider.tracked_variables == {}


def test_the_mobility_handler_shows_nodes_targets_and_speeds(node: Node[Any]) -> None:
    mobility = MobilityHandler()
    mobility.inject(EventLoop())
    mobility.register_node(node)
    mobility.handle_command(GotoCoordsMobilityCommand(1, 2, 3), node)
    mobility.handle_command(SetSpeedMobilityCommand(4), node)
    assert (mobility.nodes, mobility.targets, mobility.speeds) == ({3: node}, {3: (1, 2, 3)}, {3: 4})


def test_the_communication_handler_shows_its_medium() -> None:
    medium = CommunicationMedium(transmission_range=7)
    assert CommunicationHandler(medium).default_medium is medium


def test_a_leader_broadcasts_as_long_as_it_is_not_told_otherwise(node: Node[Any]) -> None:
    assert MobilityLeaderPlugin(Quiet.instantiate(PythonProvider(node))).is_broadcasting


def test_an_extension_needs_a_provider() -> None:
    with pytest.raises(ReferenceError):
        Extension(Quiet())


def test_a_radio_needs_a_communication_handler(node: Node[Any]) -> None:
    with pytest.raises(RuntimeError):
        Radio(Quiet.instantiate(PythonProvider(node)))


def test_states_of_raft_print_their_names() -> None:
    assert [str(state) for state in RaftState] == ["FOLLOWER", "CANDIDATE", "LEADER"]


def test_a_default_configuration_of_raft_can_be_shown() -> None:
    assert RaftConfig().to_dict()["raft_mode"] == "fault_tolerant"
    assert "fault_tolerant" in str(RaftConfig())
