"""Makes a protocol's node a leader: it tells where it is, and knows who follows it."""

import logging
import math
from dataclasses import dataclass

from gradysim.protocol.checked_values import checked_number
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.plugin.configuration import configuration_or_default
from gradysim.protocol.plugin.dispatcher import DispatchReturn, create_dispatcher
from gradysim.protocol.plugin.follow_mobility.broadcast_clock import BroadcastClock
from gradysim.protocol.plugin.follow_mobility.exception import FollowMobilityException
from gradysim.protocol.plugin.follow_mobility.mobility import (
    BROADCAST_TIMER_TAG,
    FOLLOWER_PREFIX,
    FOLLOWER_TAG,
    LEADER_TAG,
    LeaderState,
    checked_orientation,
    decode_follower,
    encode_leader,
)
from gradysim.protocol.position import Position

__all__ = [
    "BROADCAST_TIMER_TAG",
    "FOLLOWER_TAG",
    "LEADER_TAG",
    "FollowMobilityException",
    "MobilityLeaderConfiguration",
    "MobilityLeaderPlugin",
]

_logger = logging.getLogger(__name__)


@dataclass
class MobilityLeaderConfiguration:
    """How a leader makes itself known.

    Attributes:
        broadcast_interval: Mean time between two broadcasts; s, > 0.
        follower_timeout: A follower that has not answered for this long is one no more; s, > 0.
        initial_orientation: Which way the leader looks at first: degrees, from x (North) towards y (East).
        broadcast_jitter: Each interval has one broadcast, at a random moment of its first part, which is this
            long; 0 to 1 intervals. With 0 all leaders that were made together send in lock-step: on a real
            channel none of them is heard.
    """

    broadcast_interval: float = 0.02
    follower_timeout: float = 5
    initial_orientation: float = 0.0
    broadcast_jitter: float = 0.5


class MobilityLeaderPlugin:
    """Broadcasts position and orientation of its node, and keeps the set of those who answer.

    Create it in `initialize` or later. The first broadcast comes one interval after that, and not before the
    first telemetry has told the position. Answers of followers do not reach the protocol; the broadcasts of
    other leaders do.

    Attributes:
        is_broadcasting: True; while it is set to False, broadcasts are left out.
    """

    def __init__(self, protocol: IProtocol, configuration: MobilityLeaderConfiguration | None = None) -> None:
        """Attach to `protocol`; without a configuration its defaults hold.

        Raises:
            FollowMobilityException: A number of the configuration is outside its range.
        """
        configuration = configuration_or_default(self, configuration, MobilityLeaderConfiguration)
        interval, self._timeout, self._orientation, jitter = _checked(configuration)
        self._provider = protocol.provider
        self._position: Position | None = None
        self._last_answer: dict[int, float] = {}
        self._warned = False
        self.is_broadcasting = True
        dispatcher = create_dispatcher(protocol)
        dispatcher.register_handle_telemetry(self._handle_telemetry)
        dispatcher.register_handle_timer(self._handle_timer)
        dispatcher.register_handle_packet(self._handle_packet)
        now = self._provider.current_time()
        self._clock = BroadcastClock(interval, jitter, now, self._provider.random)
        self._provider.schedule_timer(BROADCAST_TIMER_TAG, self._clock.next(now))

    @property
    def followers(self) -> set[int]:
        """Ids of the nodes that have answered less than `follower_timeout` seconds ago."""
        oldest = self._provider.current_time() - self._timeout
        return {follower for follower, answer in self._last_answer.items() if answer > oldest}

    @property
    def orientation(self) -> float:
        """Which way the leader looks: degrees, from x (North) towards y (East)."""
        return self._orientation

    def set_orientation(self, orientation: float) -> None:
        """Look that way, in degrees; followers learn of it with the next broadcast.

        Raises:
            FollowMobilityException: It is not a finite number.
        """
        self._orientation = checked_orientation(orientation)

    def _handle_telemetry(self, _protocol: IProtocol, telemetry: Telemetry) -> None:
        self._position = telemetry.current_position

    def _handle_timer(self, _protocol: IProtocol, timer: str) -> DispatchReturn:
        if timer != BROADCAST_TIMER_TAG:
            return DispatchReturn.CONTINUE
        now = self._provider.current_time()
        if self.is_broadcasting:
            self._broadcast()
        followers = self.followers
        self._last_answer = {id: answer for id, answer in self._last_answer.items() if id in followers}
        self._provider.schedule_timer(BROADCAST_TIMER_TAG, self._clock.next(now))
        return DispatchReturn.INTERRUPT

    def _broadcast(self) -> None:
        if self._position is not None:
            state = LeaderState(self._provider.get_id(), self._position, self._orientation)
            self._provider.send_communication_command(BroadcastMessageCommand(encode_leader(state)))
        elif not self._warned:
            self._warned = True
            _logger.warning(
                "Leader %s does not broadcast: it has had no telemetry yet to tell it where it is",
                self._provider.get_id(),
            )

    def _handle_packet(self, _protocol: IProtocol, message: str) -> DispatchReturn:
        if not message.startswith(FOLLOWER_PREFIX):
            return DispatchReturn.CONTINUE
        self._last_answer[decode_follower(message)] = self._provider.current_time()
        return DispatchReturn.INTERRUPT


def _checked(configuration: MobilityLeaderConfiguration) -> tuple[float, float, float, float]:
    error = FollowMobilityException
    return (
        checked_number(
            "broadcast_interval",
            configuration.broadcast_interval,
            lambda seconds: 0 < seconds < math.inf,
            "finite and > 0 s",
            error,
        ),
        checked_number(
            "follower_timeout", configuration.follower_timeout, lambda seconds: seconds > 0, "> 0 s", error
        ),
        checked_orientation(configuration.initial_orientation),
        checked_number(
            "broadcast_jitter",
            configuration.broadcast_jitter,
            lambda part: 0 <= part <= 1,
            "0 to 1, a part of the interval",
            error,
        ),
    )
