"""One radio with its arrivals: the model text as a loop over events.

Slow and obvious on purpose: every arrival is an event, and interference is computed from all arrivals.
Nothing here comes from the engine, except the random stream of the receiver, which is part of a scenario's
result: one number for each decision about a frame, or about a part of it.

A radio that is not transmitting and not locked locks on to an arrival that reaches its sensitivity. Then all
other arrivals are interference. So are frames of channels that only overlap with its own, and frames of modes
that the radio does not have. A frame that starts while the radio transmits is never received, and its own
transmission ends a reception. A frame survives if its SNIR is strictly above the threshold, and its random
number is below the probability that all its bits are correct.

Options: PHY header and data are decided separately, with all changes of the interference ("chunks"). Preamble
detection selects the strongest of frames that start together. Frame capture drops a frame for a stronger one.

Events of equal time run in the order in which they were scheduled.
"""

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from heapq import heappop, heappush
from itertools import count, pairwise
from math import exp, inf
from random import Random

from verification.oracle.case import Receiver
from verification.oracle.physics import FrameFormat


@dataclass(frozen=True)
class Transmission:
    """A frame as sent. The order is that of the starts."""

    order: int
    sender: int
    start_ps: int
    slack_ps: int
    """Upper limit of its delay: the engine's record is not more exact."""
    kind: str
    octets: bytes
    """Without the FCS."""
    format: FrameFormat

    @property
    def end_ps(self) -> int:
        return self.start_ps + self.format.duration_us * 1_000_000


@dataclass(frozen=True)
class Arrival:
    """The same frame at a receiver."""

    sent: Transmission
    start_ps: int
    power_w: float
    """Power within the receiver's band."""
    is_decodable: bool
    """Whether the receiver can decode it; otherwise it is noise."""

    @property
    def end_ps(self) -> int:
        return self.start_ps + self.sent.format.duration_us * 1_000_000


@dataclass(frozen=True)
class Reception:
    """A frame to which a radio was locked until its end."""

    arrival: Arrival
    decoded: bool


@dataclass
class Heard:
    """Everything received by one radio."""

    receptions: list[Reception] = field(default_factory=list)
    outcomes: Counter[tuple[str, str]] = field(default_factory=Counter)
    """Outcomes of arrivals that reach the sensitivity, by (kind, outcome)."""
    busy_ps: list[tuple[int, int]] = field(default_factory=list)
    """Start and end of each period in which the channel was busy."""
    uncertain: int = 0
    """Receptions with a probability from 1 % to 99 %: the random number decided."""


class Radio:
    """One radio over a whole run; `heard` is its result."""

    def __init__(
        self,
        receiver: Receiver,
        noise_w: float,
        draws: Random,
        arrivals: Sequence[Arrival],
        own: Sequence[Transmission],
    ) -> None:
        self.heard = Heard()
        self._receiver = receiver
        self._noise_w = noise_w
        self._draws = draws
        self._arrivals = arrivals
        self._transmitting = False
        self._locked: Arrival | None = None
        self._detecting: list[Arrival] = []
        self._present: list[Arrival] = []
        self._busy_since_ps: int | None = None
        self._neighbours: dict[int, list[Arrival]] = {}
        self._numbers = count()
        self._events: list[tuple[int, int, int, int, Callable[[], None]]] = []
        for sent in own:
            self._at(sent.start_ps, self._begin_to_send, sent.start_ps, sent.order)
            self._at(sent.end_ps, self._end_sending, sent.start_ps, sent.order)
        for arrival in arrivals:
            sent = arrival.sent
            self._at(arrival.start_ps, partial(self._begin, arrival), sent.start_ps, sent.order)
            self._at(arrival.end_ps, partial(self._end, arrival), sent.start_ps, sent.order)
        while self._events:
            self._now_ps, *_, action = heappop(self._events)
            action()
            self._sense()

    def _at(self, time_ps: int, action: Callable[[], None], scheduled_ps: int, order: int) -> None:
        heappush(self._events, (time_ps, scheduled_ps, order, next(self._numbers), action))

    def _after(self, delay_us: int, action: Callable[[], None]) -> None:
        self._at(self._now_ps + delay_us * 1_000_000, action, self._now_ps, 1_000_000)

    def _sense(self) -> None:
        """Update the channel: busy while the radio sends or receives, and with enough energy.

        With preamble detection, energy is sensed as slowly as preambles.
        """
        energy_w = self._noise_w + sum(
            arrival.power_w for arrival in self._present if not self._is_detecting(arrival)
        )
        busy = self._transmitting or self._locked is not None or energy_w >= self._receiver.energy_detection_w
        if busy and self._busy_since_ps is None:
            self._busy_since_ps = self._now_ps
        elif not busy and self._busy_since_ps is not None:
            self.heard.busy_ps.append((self._busy_since_ps, self._now_ps))
            self._busy_since_ps = None

    # Its own transmissions.

    def _begin_to_send(self) -> None:
        self._transmitting = True
        for arrival in self._detecting:
            self._book(arrival, "receiver_transmitting")
        self._detecting = []
        if self._locked is not None:
            self._book(self._locked, "receiver_transmitting")
            self._locked = None

    def _end_sending(self) -> None:
        self._transmitting = False

    # Arrivals.

    def _begin(self, arrival: Arrival) -> None:
        self._present.append(arrival)
        if not arrival.is_decodable or arrival.power_w < self._receiver.sensitivity_w:
            return
        if self._transmitting:
            self._book(arrival, "receiver_transmitting")
        elif self._locked is None:
            self._notice(arrival)
        elif self._is_captured_by(arrival):
            self._book(self._locked, "captured")
            self._locked = None
            self._notice(arrival)
        else:
            self._book(arrival, "receiver_locked")

    def _is_captured_by(self, newcomer: Arrival) -> bool:
        capture = self._receiver.frame_capture
        assert self._locked is not None
        return (
            capture is not None
            and newcomer.start_ps - self._locked.start_ps <= capture.window_us * 1_000_000
            and newcomer.power_w > self._locked.power_w * capture.margin
        )

    def _notice(self, arrival: Arrival) -> None:
        detection = self._receiver.preamble_detection
        if detection is None:
            self._lock_on(arrival)
        else:
            self._detecting.append(arrival)
            self._after(detection.duration_us, partial(self._end_detection, arrival))

    def _end_detection(self, arrival: Arrival) -> None:
        if not self._is_detecting(arrival):
            return
        detection = self._receiver.preamble_detection
        assert detection is not None
        self._detecting = [other for other in self._detecting if other is not arrival]
        beside_w = self._noise_w + self._interference_w(arrival, self._now_ps - 1)
        if (
            any(other.power_w > arrival.power_w for other in self._detecting)
            or arrival.power_w < detection.minimum_power_w
            or arrival.power_w / beside_w < detection.threshold
        ):
            self._book(arrival, "preamble_undetected")
            return
        for other in self._detecting:
            self._book(other, "receiver_locked")
        self._detecting = []
        self._lock_on(arrival)

    def _is_detecting(self, arrival: Arrival) -> bool:
        return any(other is arrival for other in self._detecting)

    def _lock_on(self, arrival: Arrival) -> None:
        self._locked = arrival
        if self._receiver.by_chunks:
            _, end_ps = self._header_of(arrival)
            self._at(max(end_ps, self._now_ps), partial(self._end_header, arrival), self._now_ps, 1_000_000)

    def _end_header(self, arrival: Arrival) -> None:
        if self._locked is not arrival:
            return
        chance = self._chance_by_chunks(
            arrival, self._header_of(arrival), arrival.sent.format.log_header_success
        )
        if self._draws.random() >= chance:
            self._book(arrival, "header_error")
            self._locked = None

    def _end(self, arrival: Arrival) -> None:
        self._present = [other for other in self._present if other is not arrival]
        if self._is_detecting(arrival):
            self._detecting = [other for other in self._detecting if other is not arrival]
            self._book(arrival, "preamble_undetected")
        if self._locked is not arrival:
            return
        self._locked = None
        chance, undisturbed = (
            self._chances_of_data(arrival) if self._receiver.by_chunks else self._chances_at_once(arrival)
        )
        draw = self._draws.random()
        self.heard.uncertain += 0.01 < chance < 0.99
        outcome = "delivered" if draw < chance else "interference" if draw < undisturbed else "noise"
        self._book(arrival, outcome)
        self.heard.receptions.append(Reception(arrival, outcome == "delivered"))

    def _book(self, arrival: Arrival, outcome: str) -> None:
        self.heard.outcomes[arrival.sent.kind, outcome] += 1

    # Probabilities, with and without interference.

    def _chances_at_once(self, arrival: Arrival) -> tuple[float, float]:
        period_ps = arrival.start_ps, arrival.end_ps
        most_w = max(self._interference_w(arrival, time) for time in self._changes(arrival, period_ps))
        with_w, without_w = self._log_of_all(arrival, most_w), self._log_of_all(arrival, 0.0)
        return exp(with_w), exp(without_w)

    def _log_of_all(self, arrival: Arrival, interference_w: float) -> float:
        snir = arrival.power_w / (self._noise_w + interference_w)
        if not snir > self._receiver.snir_threshold:
            return -inf
        form = arrival.sent.format
        return form.log_header_success(snir) + form.log_data_success(snir)

    def _chances_of_data(self, arrival: Arrival) -> tuple[float, float]:
        log_success = arrival.sent.format.log_data_success
        snr = arrival.power_w / self._noise_w
        return (
            self._chance_by_chunks(arrival, self._data_of(arrival), log_success),
            exp(log_success(snr)) if snr > self._receiver.snir_threshold else 0.0,
        )

    def _chance_by_chunks(
        self, arrival: Arrival, period_ps: tuple[int, int], log_success: Callable[[float], float]
    ) -> float:
        start_ps, end_ps = period_ps
        moments = [*self._changes(arrival, period_ps), end_ps]
        total = 0.0
        for moment, following in pairwise(moments):
            snir = arrival.power_w / (self._noise_w + self._interference_w(arrival, moment))
            if not snir > self._receiver.snir_threshold:
                return 0.0
            total += log_success(snir) * (following - moment) / (end_ps - start_ps)
        return exp(total)

    # Interference.

    def _interference_w(self, arrival: Arrival, time_ps: int) -> float:
        """Return the power of all other arrivals at that time."""
        return sum(
            other.power_w for other in self._beside(arrival) if other.start_ps <= time_ps < other.end_ps
        )

    def _changes(self, arrival: Arrival, period_ps: tuple[int, int]) -> list[int]:
        """Return the start of the period and all times within it at which the interference changes."""
        start_ps, end_ps = period_ps
        times = {time for other in self._beside(arrival) for time in (other.start_ps, other.end_ps)}
        return [start_ps, *sorted(time for time in times if start_ps < time < end_ps)]

    def _beside(self, arrival: Arrival) -> list[Arrival]:
        """Return all other arrivals that overlap with it."""
        order = arrival.sent.order
        if order not in self._neighbours:
            self._neighbours[order] = [
                other
                for other in self._arrivals
                if other is not arrival
                and other.start_ps < arrival.end_ps
                and arrival.start_ps < other.end_ps
            ]
        return self._neighbours[order]

    def _header_of(self, arrival: Arrival) -> tuple[int, int]:
        form = arrival.sent.format
        start_ps = arrival.start_ps + form.preamble_us * 1_000_000
        return start_ps, start_ps + form.header_us * 1_000_000

    def _data_of(self, arrival: Arrival) -> tuple[int, int]:
        _, start_ps = self._header_of(arrival)
        return start_ps, start_ps + arrival.sent.format.data_us * 1_000_000
