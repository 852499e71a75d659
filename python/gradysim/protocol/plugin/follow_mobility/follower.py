"""Makes a protocol's node a follower: it keeps its place beside a leader."""

import logging
import math
from dataclasses import dataclass

from gradysim.protocol.checked_values import checked_number, checked_point
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import SendMessageCommand
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand
from gradysim.protocol.plugin.configuration import configuration_or_default
from gradysim.protocol.plugin.dispatcher import DispatchReturn, create_dispatcher
from gradysim.protocol.plugin.follow_mobility.exception import FollowMobilityException
from gradysim.protocol.plugin.follow_mobility.mobility import (
    FOLLOWER_TAG,
    FOLLOWER_TIMER_TAG,
    LEADER_PREFIX,
    LEADER_TAG,
    decode_leader,
    encode_follower,
)
from gradysim.protocol.position import Position, rotate_position_2d

__all__ = [
    "FOLLOWER_TAG",
    "FOLLOWER_TIMER_TAG",
    "LEADER_TAG",
    "FollowMobilityException",
    "MobilityFollowerConfiguration",
    "MobilityFollowerPlugin",
]

_logger = logging.getLogger(__name__)


@dataclass
class MobilityFollowerConfiguration:
    """How a follower finds and keeps a leader.

    Attributes:
        scanning_interval: Time between two looks at which leaders are there; s, > 0.
        leader_timeout: A leader that has not been heard for this long is gone; s, > 0.
        auto_follow: Whether a look that finds a leader, while none is followed, chooses it.
        follow_orientation: Whether the relative position turns with the leader's orientation.
    """

    scanning_interval: float = 0.5
    leader_timeout: float = 2
    auto_follow: bool = True
    follow_orientation: bool = True


class MobilityFollowerPlugin:
    """Flies to a place relative to its leader each time it hears the leader, and answers.

    Create it in `initialize` or later. Every `scanning_interval` it looks which leaders it still hears: those
    not heard for `leader_timeout` are dropped, the one that it follows among them; the vehicle then ends up
    at its last target. With `auto_follow`, the leader with the smallest id is taken if none is followed.
    The broadcasts of leaders do not reach the protocol.

    Answers go out at once. Followers of the same leader answer together, right after its broadcast; on a real
    channel, which was busy with that broadcast, each one's network interface then waits for a random time.
    """

    def __init__(
        self, protocol: IProtocol, configuration: MobilityFollowerConfiguration | None = None
    ) -> None:
        """Attach to `protocol`; without a configuration its defaults hold.

        Raises:
            FollowMobilityException: A number of the configuration is outside its range.
        """
        self._configuration = configuration_or_default(self, configuration, MobilityFollowerConfiguration)
        _check(self._configuration)
        self._provider = protocol.provider
        self._last_heard: dict[int, float] = {}
        self._leader: int | None = None
        self._leader_position: Position | None = None
        self._leader_orientation: float | None = None
        self._relative_position: Position = (0, 0, 0)
        dispatcher = create_dispatcher(protocol)
        dispatcher.register_handle_timer(self._handle_timer)
        dispatcher.register_handle_packet(self._handle_packet)
        self._schedule_scan()

    @property
    def available_leaders(self) -> set[int]:
        """Ids of the leaders that have been heard and not been found gone since."""
        return set(self._last_heard)

    @property
    def current_leader(self) -> int | None:
        """Id of the leader that is followed, or None."""
        return self._leader

    @property
    def current_leader_position(self) -> Position | None:
        """Where the leader said that it is, (x, y, z) in metres; None before it was heard as the leader."""
        return self._leader_position

    @property
    def current_leader_orientation(self) -> float | None:
        """Which way the leader said that it looks, degrees; None before it was heard as the leader."""
        return self._leader_orientation

    @property
    def relative_position(self) -> Position:
        """Place beside the leader, (x, y, z) in metres from it, when its orientation is 0."""
        return self._relative_position

    def follow_leader(self, leader_id: int) -> None:
        """Follow that leader, from its next broadcast on, instead of any other.

        Raises:
            FollowMobilityException: It is not among `available_leaders`.
        """
        if leader_id not in self._last_heard:
            available = ", ".join(map(str, sorted(self._last_heard))) or "none"
            raise FollowMobilityException(f"leader {leader_id!r} is not available; available: {available}")
        if leader_id != self._leader:
            self._follow(leader_id)

    def set_relative_position(self, position: Position) -> None:
        """Set the place beside the leader, (x, y, z) in metres; taken up at the leader's next broadcast.

        Raises:
            FollowMobilityException: It is not three finite numbers.
        """
        self._relative_position = checked_point("a relative position", position, FollowMobilityException)

    def _schedule_scan(self) -> None:
        next_scan = self._provider.current_time() + self._configuration.scanning_interval
        self._provider.schedule_timer(FOLLOWER_TIMER_TAG, next_scan)

    def _handle_timer(self, _protocol: IProtocol, timer: str) -> DispatchReturn:
        if timer != FOLLOWER_TIMER_TAG:
            return DispatchReturn.CONTINUE
        oldest = self._provider.current_time() - self._configuration.leader_timeout
        self._last_heard = {leader: heard for leader, heard in self._last_heard.items() if heard > oldest}
        if self._leader is not None and self._leader not in self._last_heard:
            self._follow(None)
        if self._configuration.auto_follow and self._leader is None and self._last_heard:
            self._follow(min(self._last_heard))
        self._schedule_scan()
        return DispatchReturn.INTERRUPT

    def _handle_packet(self, _protocol: IProtocol, message: str) -> DispatchReturn:
        if not message.startswith(LEADER_PREFIX):
            return DispatchReturn.CONTINUE
        state = decode_leader(message)
        self._last_heard[state.id] = self._provider.current_time()
        if state.id == self._leader:
            self._leader_position = state.position
            self._leader_orientation = state.orientation
            self._take_place(state.position, state.orientation)
            answer = SendMessageCommand(encode_follower(self._provider.get_id()), state.id)
            self._provider.send_communication_command(answer)
        return DispatchReturn.INTERRUPT

    def _take_place(self, leader: Position, orientation: float) -> None:
        relative = self._relative_position
        if self._configuration.follow_orientation:
            relative = rotate_position_2d(relative, orientation)
        target = (leader[0] + relative[0], leader[1] + relative[1], leader[2] + relative[2])
        self._provider.send_mobility_command(GotoCoordsMobilityCommand(*target))

    def _follow(self, leader: int | None) -> None:
        if leader is None:
            _logger.info("Follow mobility: lost leader %s", self._leader)
        else:
            _logger.info("Follow mobility: following leader %s", leader)
        self._leader = leader
        self._leader_position = None
        self._leader_orientation = None


def _check(configuration: MobilityFollowerConfiguration) -> None:
    checked_number(
        "scanning_interval",
        configuration.scanning_interval,
        lambda seconds: 0 < seconds < math.inf,
        "finite and > 0 s",
        FollowMobilityException,
    )
    checked_number(
        "leader_timeout",
        configuration.leader_timeout,
        lambda seconds: seconds > 0,
        "> 0 s",
        FollowMobilityException,
    )
