"""Plugin for a follower: the node keeps a position relative to a leader."""

import logging
from dataclasses import dataclass

from gradysim.protocol.checked_values import checked_number, checked_point
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import SendMessageCommand
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand
from gradysim.protocol.plugin.attachment import configuration_or_default, time_of
from gradysim.protocol.plugin.dispatcher import DispatchReturn, create_dispatcher
from gradysim.protocol.plugin.follow_mobility.mobility import (
    FOLLOWER_TAG,
    FOLLOWER_TIMER_TAG,
    LEADER_PREFIX,
    LEADER_TAG,
    FollowMobilityException,
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
        scanning_interval: Time between two checks of the available leaders; s, > 0.
        leader_timeout: A leader that was not heard for this long is dropped; s, > 0.
        auto_follow: Whether a check chooses a leader if none is followed.
        follow_orientation: Whether the relative position turns with the leader's orientation.
    """

    scanning_interval: float = 0.5
    leader_timeout: float = 2
    auto_follow: bool = True
    follow_orientation: bool = True


class MobilityFollowerPlugin:
    """Flies to a position relative to its leader each time it hears the leader, and sends an answer.

    Create it in `initialize` or later. Every `scanning_interval` it drops leaders that it has not heard for
    `leader_timeout`. If its own leader is among them, the vehicle stays at its last target. With
    `auto_follow` it then follows the leader with the smallest id. The protocol does not get the broadcasts of
    leaders.
    """

    def __init__(
        self, protocol: IProtocol, configuration: MobilityFollowerConfiguration | None = None
    ) -> None:
        """Attach to `protocol`; without a configuration its defaults hold.

        Raise FollowMobilityException if a number of the configuration is outside its range.
        """
        self._configuration = configuration_or_default(self, configuration, MobilityFollowerConfiguration)
        interval, timeout = self._configuration.scanning_interval, self._configuration.leader_timeout
        error = FollowMobilityException
        checked_number("scanning_interval", interval, 0, above=True, unit="s", error=error)
        checked_number("leader_timeout", timeout, 0, above=True, infinite=True, unit="s", error=error)
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
        """Ids of the leaders that were heard and not dropped since."""
        return set(self._last_heard)

    @property
    def current_leader(self) -> int | None:
        """Id of the current leader, or None."""
        return self._leader

    @property
    def current_leader_position(self) -> Position | None:
        """Last broadcast position of the leader, (x, y, z) in meters; None before its first broadcast."""
        return self._leader_position

    @property
    def current_leader_orientation(self) -> float | None:
        """Last broadcast orientation of the leader, degrees; None before its first broadcast."""
        return self._leader_orientation

    @property
    def relative_position(self) -> Position:
        """Position relative to a leader with orientation 0, (x, y, z) in meters."""
        return self._relative_position

    def follow_leader(self, leader_id: int) -> None:
        """Follow that leader from its next broadcast on.

        Raise FollowMobilityException if it is not in `available_leaders`.
        """
        if leader_id not in self._last_heard:
            available = ", ".join(map(str, sorted(self._last_heard))) or "none"
            raise FollowMobilityException(f"leader {leader_id!r} is not available; available: {available}")
        if leader_id != self._leader:
            self._follow(leader_id)

    def set_relative_position(self, position: Position) -> None:
        """Set the relative position, (x, y, z) in meters. It is used from the leader's next broadcast on.

        Raise FollowMobilityException if it is not three finite numbers.
        """
        self._relative_position = checked_point("a relative position", position, FollowMobilityException)

    def _schedule_scan(self) -> None:
        next_scan = time_of(self._provider) + self._configuration.scanning_interval
        self._provider.schedule_timer(FOLLOWER_TIMER_TAG, next_scan)

    def _handle_timer(self, _protocol: IProtocol, timer: str) -> DispatchReturn:
        if timer != FOLLOWER_TIMER_TAG:
            return DispatchReturn.CONTINUE
        oldest = time_of(self._provider) - self._configuration.leader_timeout
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
        self._last_heard[state.id] = time_of(self._provider)
        if state.id == self._leader:
            self._leader_position = state.position
            self._leader_orientation = state.orientation
            self._take_position(state.position, state.orientation)
            answer = SendMessageCommand(encode_follower(self._provider.get_id()), state.id)
            self._provider.send_communication_command(answer)
        return DispatchReturn.INTERRUPT

    def _take_position(self, leader: Position, orientation: float) -> None:
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
