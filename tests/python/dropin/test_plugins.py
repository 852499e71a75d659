"""Behavior that users rely on, and fixes of the published package: plugins."""

from typing import Any, cast
from unittest.mock import MagicMock

import pytest

from gradysim.protocol.interface import IProtocol, IProvider
from gradysim.protocol.messages.communication import CommunicationCommand
from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.plugin.dispatcher import DispatchReturn, create_dispatcher
from gradysim.protocol.plugin.follow_mobility import (
    MobilityFollowerConfiguration,
    MobilityFollowerPlugin,
    MobilityLeaderConfiguration,
    MobilityLeaderPlugin,
)
from gradysim.protocol.plugin.mission_mobility import MissionMobilityPlugin
from gradysim.protocol.plugin.random_mobility import RandomMobilityPlugin
from gradysim.simulator.handler.communication import CommunicationHandler
from gradysim.simulator.handler.mobility import MobilityHandler
from gradysim.simulator.handler.timer import TimerHandler
from python.dropin.user_code import Provider, simulation
from python.quiet_protocol import Quiet


def test_the_handler_registered_last_comes_first_and_may_end_the_event() -> None:
    calls: list[str] = []

    class Packets(Quiet):
        def handle_packet(self, message: str) -> None:
            calls.append("protocol")

    def first(protocol: IProtocol, message: str) -> DispatchReturn | None:
        calls.append("registered first")
        return None

    def last(protocol: IProtocol, message: str) -> DispatchReturn:
        calls.append("registered last")
        return DispatchReturn.INTERRUPT if message == "stop" else DispatchReturn.CONTINUE

    protocol = Packets()
    create_dispatcher(protocol).register_handle_packet(first)
    create_dispatcher(protocol).register_handle_packet(last)
    protocol.handle_packet("go")
    protocol.handle_packet("stop")
    assert calls == ["registered last", "registered first", "protocol", "registered last"]


def test_nobody_can_keep_finish_from_a_protocol() -> None:
    calls: list[str] = []

    class Finishes(Quiet):
        def finish(self) -> None:
            calls.append("finish")

    protocol = Finishes()
    create_dispatcher(protocol).register_finish(lambda protocol: DispatchReturn.INTERRUPT)
    protocol.finish()
    assert calls == ["finish"]


def test_the_timeout_of_followers_is_in_seconds() -> None:
    provider = Provider()
    protocol = Quiet.instantiate(provider)
    leader = MobilityLeaderPlugin(protocol, MobilityLeaderConfiguration(follower_timeout=5))
    protocol.handle_packet("FollowMobilityPlugin__follower:7")
    provider.now = 4.9
    for _ in range(100):
        protocol.handle_timer("FollowMobilityPlugin__leader_broadcast_timer")
    assert leader.followers == {7}
    provider.now = 5.1
    assert leader.followers == set()


@pytest.mark.parametrize(("auto_follow", "leader"), [(True, 2), (False, None)])
def test_a_follower_chooses_a_leader_only_if_it_may(auto_follow: bool, leader: int | None) -> None:
    protocol = Quiet.instantiate(Provider())
    follower = MobilityFollowerPlugin(protocol, MobilityFollowerConfiguration(auto_follow=auto_follow))
    for number in (3, 2):
        protocol.handle_packet(f'FollowMobilityPlugin__leader:{{"id": {number}, "position": [0, 0, 0]}}')
    protocol.handle_timer("FollowMobilityPlugin__follower_timer")
    assert follower.available_leaders == {2, 3}
    assert follower.current_leader == leader


def test_a_trip_can_be_asked_for_before_it_begins() -> None:
    seen: list[Any] = []

    class Idle(Quiet):
        def initialize(self) -> None:
            trip = RandomMobilityPlugin(self)
            trip.finish_random_trip()
            seen.extend([trip.trip_ongoing, trip.current_target])

    simulation(Idle).start_simulation()
    assert seen == [False, None]


def test_a_seed_repeats_the_draws_of_every_node() -> None:
    def draws() -> list[float]:
        drawn: list[float] = []

        class Draws(Quiet):
            def initialize(self) -> None:
                drawn.append(self.provider.random.random())

        simulation(Draws, Draws, seed=5).start_simulation()
        return drawn

    first, second = draws(), draws()
    assert first == second
    assert first[0] != first[1]


def test_a_provider_of_ones_own_needs_only_the_published_methods() -> None:
    assert 0 <= Quiet.instantiate(Provider()).provider.random.random() < 1


def test_a_random_trip_may_be_made_in_the_constructor() -> None:
    class PingPong(Quiet):
        def __init__(self) -> None:
            self.trip = RandomMobilityPlugin(self)

        def initialize(self) -> None:
            self.trip.initiate_random_trip()
            seen.append(self.trip.current_target)

    def targets(seed: int) -> list[Any]:
        seen.clear()
        handlers = (TimerHandler(), CommunicationHandler(), MobilityHandler())
        simulation(PingPong, PingPong, seed=seed, handlers=handlers).start_simulation()
        return [*seen]

    seen: list[Any] = []
    first = targets(5)
    assert first == targets(5)
    assert first[0] != first[1]
    assert first != targets(6)


class Mock:
    """A user's mock of a provider, with only the methods of its test."""

    def __init__(self) -> None:
        self.timers: list[tuple[str, float]] = []
        self.sent: list[CommunicationCommand] = []

    def send_communication_command(self, command: CommunicationCommand) -> None:
        self.sent.append(command)

    def send_mobility_command(self, command: MobilityCommand) -> None: ...

    def schedule_timer(self, timer: str, timestamp: float) -> None:
        self.timers.append((timer, timestamp))

    def get_id(self) -> int:
        return 3


@pytest.mark.parametrize("provider", [Mock(), MagicMock(get_id=lambda: 3)], ids=["class", "MagicMock"])
def test_plugins_work_on_a_mock_of_a_provider(provider: Any) -> None:
    protocol = Quiet.instantiate(provider)
    MobilityLeaderPlugin(protocol)
    MobilityFollowerPlugin(protocol)
    trip = RandomMobilityPlugin(protocol)
    trip.initiate_random_trip()
    MissionMobilityPlugin(protocol).start_mission([(0, 0, 0), (1, 0, 0)])
    protocol.handle_telemetry(Telemetry((0, 0, 0)))
    protocol.handle_timer("FollowMobilityPlugin__leader_broadcast_timer")
    assert trip.trip_ongoing


def test_the_leader_broadcasts_with_a_mock() -> None:
    provider = Mock()
    protocol = Quiet.instantiate(cast("IProvider", provider))
    MobilityLeaderPlugin(protocol)
    protocol.handle_telemetry(Telemetry((0, 0, 0)))
    protocol.handle_timer("FollowMobilityPlugin__leader_broadcast_timer")
    assert len(provider.sent) == 1
    assert [name for name, _ in provider.timers] == ["FollowMobilityPlugin__leader_broadcast_timer"] * 2
    assert all(0 < time_s < 0.06 for _, time_s in provider.timers)
