"""Unslotted CSMA/CA of IEEE 802.15.4 for stations that all hear each other, in a hundred lines of Python.

Written from the definitions, independent of the engine: there are no positions, powers or propagation, and
frames that overlap are lost. All times are in microseconds.

A station waits 0 to 2^BE - 1 backoff periods of 320 us, with BE = 3, 4, 5, 5, 5. After each wait it assesses
the channel for 128 us. The channel is busy if there is a frame on the air at the end. After the fifth time
the message is dropped. Otherwise its frame starts 192 us later in any case. With ACKs, an ACK of 352 us
follows 192 us after a received frame. Without an ACK the frame is repeated, three times at most.

Source: IEEE Std 802.15.4-2006, 7.5.1.4 (CSMA-CA algorithm), 7.5.6.4 (acknowledgments), tables 22, 85 and 86.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from heapq import heappop, heappush
from random import Random

PERIOD_US, ASSESSMENT_US, TURNAROUND_US, ACK_US = 320, 128, 192, 352
LONGEST_WAITS = (8, 16, 32, 32, 32)
RETRIES = 3
FIRST_WITHIN_US = 5000


@dataclass(frozen=True)
class Rules:
    """Differences between simulators."""

    acks: bool
    rest_us: float
    """From the end of an exchange to the next wait: 640 in ns-3 (macLIFSPeriod), 0 in INET."""
    ack_wait_us: float
    """From the end of a frame to its repetition: 864 in the standard and in ns-3, 560 in INET."""
    gives_up_new_frames: bool = True
    """INET retries without a limit while the frame has not been on the air."""


@dataclass
class Counts:
    """Outcomes of the messages."""

    received: int = 0
    """Received messages, each counted once."""
    failed_access: int = 0
    failed_retries: int = 0
    done: int = 0
    """Sent or dropped messages."""
    frames: int = 0
    """Transmissions, including repetitions."""


@dataclass
class Air:
    """Frames on the air, and pending events."""

    frame_us: float
    rules: Rules
    random: Random
    counts: Counts = field(default_factory=Counts)
    damaged: dict[int, bool] = field(default_factory=dict)
    """For each transmission on the air, whether it overlapped with another one."""
    _events: list[tuple[float, int, Callable[[float], None]]] = field(default_factory=list)
    _number: int = 0

    def at(self, time: float, action: Callable[[float], None]) -> None:
        self._number += 1
        heappush(self._events, (time, self._number, action))

    def run(self, until: float) -> None:
        while self._events[0][0] < until:
            time, _, action = heappop(self._events)
            action(time)

    def transmit(self, start: float, duration: float, done: Callable[[float, bool], None]) -> None:
        """Call `done` at the end, with whether the frame arrived."""
        met = bool(self.damaged)
        self.damaged = dict.fromkeys(self.damaged, True)
        self._number += 1
        transmission = self._number
        self.damaged[transmission] = met
        self.at(start + duration, lambda now: done(now, not self.damaged.pop(transmission)))


class Station:
    """Sends messages without a pause."""

    def __init__(self, air: Air) -> None:
        self._air = air
        self._next_message(air.random.uniform(0, FIRST_WITHIN_US))

    def _next_message(self, time: float) -> None:
        self._retries, self._arrived = 0, False
        self._attempt(time)

    def _attempt(self, time: float) -> None:
        self._failures = 0
        self._wait(time)

    def _wait(self, time: float) -> None:
        periods = self._air.random.randrange(LONGEST_WAITS[self._failures])
        self._air.at(time + PERIOD_US * periods + ASSESSMENT_US, self._assessed)

    def _assessed(self, time: float) -> None:
        if not self._air.damaged:
            self._air.at(time + TURNAROUND_US, self._send)
            return
        self._failures += 1
        if self._failures < len(LONGEST_WAITS):
            self._wait(time)
        elif self._retries == 0 and not self._air.rules.gives_up_new_frames:
            self._attempt(time)
        else:
            self._air.counts.failed_access += 1
            self._done(time)

    def _send(self, time: float) -> None:
        self._air.counts.frames += 1
        self._air.transmit(time, self._air.frame_us, self._sent)

    def _sent(self, time: float, arrived: bool) -> None:
        rules = self._air.rules
        self._air.counts.received += arrived and not self._arrived
        self._arrived |= arrived
        if not rules.acks:
            self._done(time + rules.rest_us)
            return
        if arrived:
            self._air.at(
                time + TURNAROUND_US, lambda now: self._air.transmit(now, ACK_US, self._acknowledged)
            )
        self._timeout = time + rules.ack_wait_us
        if not arrived:
            self._air.at(self._timeout, self._repeat)

    def _acknowledged(self, time: float, arrived: bool) -> None:
        if arrived:
            self._done(time + self._air.rules.rest_us)
        else:
            self._air.at(self._timeout, self._repeat)

    def _repeat(self, time: float) -> None:
        self._retries += 1
        if self._retries <= RETRIES:
            self._attempt(time)
        else:
            self._air.counts.failed_retries += 1
            self._done(time)

    def _done(self, next_message: float) -> None:
        self._air.counts.done += 1
        self._next_message(next_message)


def contend(stations: int, frame_us: float, rules: Rules, duration_s: float, seed: int) -> Counts:
    """Simulate stations that always have a message, each from a random instant of the first 5 ms on."""
    air = Air(frame_us, rules, Random(seed))
    for _ in range(stations):
        Station(air)
    air.run(duration_s * 1e6)
    return air.counts
