"""Plugin for a leader: the node broadcasts its position and knows its followers."""

import logging
import math
from dataclasses import dataclass
from random import Random

from gradysim.protocol.checked_values import checked_number
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.plugin.attachment import (
    configuration_or_default,
    stream_of,
    time_of,
    warn_without_telemetry,
)
from gradysim.protocol.plugin.dispatcher import DispatchReturn, create_dispatcher
from gradysim.protocol.plugin.follow_mobility.mobility import (
    BROADCAST_TIMER_TAG,
    FOLLOWER_PREFIX,
    FOLLOWER_TAG,
    LEADER_TAG,
    FollowMobilityException,
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
    """How a leader broadcasts.

    Attributes:
        broadcast_interval: Mean time between two broadcasts; s, > 0.
        follower_timeout: A follower that did not answer for this long is dropped; s, > 0.
        initial_orientation: First orientation: degrees, from x (North) towards y (East).
        broadcast_jitter: Largest random delay of a broadcast, as a part of the interval; 0 to 1. With 0,
            leaders that are created at the same time send at the same instants, and their frames collide on a
            real channel.
    """

    broadcast_interval: float = 0.02
    follower_timeout: float = 5
    initial_orientation: float = 0.0
    broadcast_jitter: float = 0.5


class MobilityLeaderPlugin:
    """Broadcasts position and orientation of its node, and keeps the set of its followers.

    Create it in `initialize` or later. The first broadcast comes one interval later. Before the first
    telemetry, a leader that was created at time 0 broadcasts its initial position, and any other one is
    silent. The protocol does not get the answers of followers; it gets the broadcasts of other leaders.

    Attributes:
        is_broadcasting: True; set it to False to pause the broadcasts.
    """

    def __init__(self, protocol: IProtocol, configuration: MobilityLeaderConfiguration | None = None) -> None:
        """Attach to `protocol`; without a configuration its defaults hold.

        Raise FollowMobilityException if a number of the configuration is outside its range.
        """
        configuration = configuration_or_default(self, configuration, MobilityLeaderConfiguration)
        error = FollowMobilityException
        interval, timeout = configuration.broadcast_interval, configuration.follower_timeout
        jitter = checked_number("broadcast_jitter", configuration.broadcast_jitter, 0, 1, error=error)
        interval = checked_number("broadcast_interval", interval, 0, above=True, unit="s", error=error)
        self._timeout = checked_number(
            "follower_timeout", timeout, 0, above=True, infinite=True, unit="s", error=error
        )
        self._orientation = checked_orientation(configuration.initial_orientation)
        self._provider = protocol.provider
        self._last_answer: dict[int, float] = {}
        self._warned = getattr(self._provider, "has_telemetry", True) is False
        warn_without_telemetry(_logger, protocol, "a leader does not know where it flies")
        self.is_broadcasting = True
        dispatcher = create_dispatcher(protocol)
        dispatcher.register_handle_telemetry(self._handle_telemetry)
        dispatcher.register_handle_timer(self._handle_timer)
        dispatcher.register_handle_packet(self._handle_packet)
        now = time_of(self._provider)
        initial_position = getattr(self._provider, "initial_position", None)
        self._position: Position | None = initial_position if now == 0 else None
        self._clock = BroadcastClock(interval, jitter, now, stream_of(self._provider))
        self._provider.schedule_timer(BROADCAST_TIMER_TAG, self._clock.next(now))

    @property
    def followers(self) -> set[int]:
        """Ids of the nodes that answered less than `follower_timeout` seconds ago."""
        oldest = time_of(self._provider) - self._timeout
        return {follower for follower, answer in self._last_answer.items() if answer > oldest}

    @property
    def orientation(self) -> float:
        """Orientation of the leader: degrees, from x (North) towards y (East)."""
        return self._orientation

    def set_orientation(self, orientation: float) -> None:
        """Set the orientation, in degrees. Followers get it with the next broadcast.

        Raise FollowMobilityException if it is not a finite number.
        """
        self._orientation = checked_orientation(orientation)

    def _handle_telemetry(self, _protocol: IProtocol, telemetry: Telemetry) -> None:
        self._position = telemetry.current_position

    def _handle_timer(self, _protocol: IProtocol, timer: str) -> DispatchReturn:
        if timer != BROADCAST_TIMER_TAG:
            return DispatchReturn.CONTINUE
        now = time_of(self._provider)
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
                "Leader %s does not broadcast: its position is unknown before the first telemetry",
                self._provider.get_id(),
            )

    def _handle_packet(self, _protocol: IProtocol, message: str) -> DispatchReturn:
        if not message.startswith(FOLLOWER_PREFIX):
            return DispatchReturn.CONTINUE
        self._last_answer[decode_follower(message)] = time_of(self._provider)
        return DispatchReturn.INTERRUPT


class BroadcastClock:
    """Times of a leader's broadcasts: one in each interval, with a random delay.

    Broadcast k = 1, 2, ... is due at start + k * interval + delay. The delay is uniform between 0 and
    jitter * interval. The mean time between two broadcasts is the interval, without a drift.

    Without the delay, leaders that are created at the same time always send at the same instant. Their frames
    collide, and a radio that transmits does not receive.
    """

    def __init__(self, interval: float, jitter: float, start: float, random: Random) -> None:
        """Count intervals from `start` (s); `interval` in s, > 0; `jitter` 0 to 1."""
        self._interval = interval
        self._jitter = jitter
        self._start = start
        self._random = random
        self._number = 0

    def next(self, now: float) -> float:
        """Return the time of the next broadcast, s, >= `now`. Missed intervals are skipped."""
        # The tolerance keeps the next interval if rounding puts `now` just behind the end of this one.
        elapsed = math.ceil((now - self._start) / self._interval - 1e-6)
        self._number = max(self._number + 1, elapsed)
        delay = self._random.uniform(0, self._jitter)
        return max(now, self._start + (self._number + delay) * self._interval)
