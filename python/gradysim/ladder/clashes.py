"""Clashes: which timers of which nodes send into each other, from the replay of a run."""

from bisect import bisect_right
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from statistics import median
from typing import Any, Literal

from gradysim.replay.reader import Replay
from gradysim.replay.tables import BROADCAST, EVENT_KINDS, OUTCOMES

Verdict = Literal["saturated", "hidden", "synchronized", "drifting", "random"]

_LOST_TO_OTHERS = {
    OUTCOMES.index(name)
    for name in (
        "interference",
        "receiver_transmitting",
        "receiver_locked",
        "captured",
        "preamble_undetected",
    )
}
_TIMER = "timer "
_NS_PER_S = 1e9

_SATURATED = 0.7
"""Share of the time that frames fill at a receiver, from which on no jitter helps."""

_MOST = 0.8
"""Share of clashes that makes a verdict."""


@dataclass(frozen=True)
class Origin:
    """What sent a frame: a callback of a group of nodes, such as `timer heartbeat` of `uavs[*]`."""

    group: str
    cause: str

    def __str__(self) -> str:
        name = self.cause.removeprefix(_TIMER)
        return (
            f'timer "{name}" of {self.group}'
            if self.is_timer
            else f"{self.cause or 'an answer'} of {self.group}"
        )

    @property
    def is_timer(self) -> bool:
        """Whether it is a timer."""
        return self.cause.startswith(_TIMER)

    @property
    def timer(self) -> str:
        """Name of the timer."""
        return self.cause.removeprefix(_TIMER)


@dataclass(frozen=True)
class Clash:
    """One reception that another frame destroyed, or that was missed because of it.

    Attributes:
        time_s: Start of the lost frame.
        lost: Origin of the lost frame.
        other: Origin of the other one.
        apart_s: Time between the two timers; between the frames if one of them has no timer.
        is_hidden: Whether the two senders do not hear each other.
        airtime_s: Duration of the longer frame.
    """

    time_s: float
    lost: Origin
    other: Origin
    apart_s: float
    is_hidden: bool
    airtime_s: float


@dataclass(frozen=True)
class Pattern:
    """All clashes between two origins.

    Attributes:
        origins: The two, in the order of their names; one if they are equal.
        count: Number of clashes.
        verdict: Why they clash.
        period_s: Median time between two expirations of the timer, 0 if there is none.
        apart_s: Median time between the two timers.
        nodes: Number of nodes of these groups that send.
    """

    origins: tuple[Origin, ...]
    count: int
    verdict: Verdict
    period_s: float
    apart_s: float


@dataclass(frozen=True)
class Diagnosis:
    """Clashes of a run.

    Attributes:
        receptions: Number of receptions that their receivers noticed.
        clashes: Number of them that other frames destroyed.
        busiest: Largest share of the time that frames fill at a receiver.
        patterns: By origins, the most frequent ones first.
        airtime_s: Median duration of the lost frames; 0 without clashes.
    """

    receptions: int
    clashes: int
    busiest: float
    patterns: tuple[Pattern, ...]
    airtime_s: float


def diagnose(replay: Replay) -> Diagnosis:
    """Return which origins clash in a recorded run, and why."""
    run = _Run(replay)
    clashes = list(run.clashes())
    by_origins: defaultdict[tuple[Origin, ...], list[Clash]] = defaultdict(list)
    for clash in clashes:
        pair = {clash.lost, clash.other}
        by_origins[tuple(sorted(pair, key=str))].append(clash)
    patterns = [
        Pattern(
            origins,
            len(alike),
            _verdict(alike, run.busiest),
            run.period_s(origins),
            median(each.apart_s for each in alike),
        )
        for origins, alike in by_origins.items()
    ]
    patterns.sort(key=lambda pattern: -pattern.count)
    airtime_s = median(each.airtime_s for each in clashes) if clashes else 0.0
    return Diagnosis(len(run.receptions), len(clashes), run.busiest, tuple(patterns), airtime_s)


def _verdict(clashes: Sequence[Clash], busiest: float) -> Verdict:
    def share(which: Sequence[bool]) -> float:
        return sum(which) / len(which)

    if busiest >= _SATURATED:
        return "saturated"
    if share([each.is_hidden for each in clashes]) >= _MOST:
        return "hidden"
    if not all(each.lost.is_timer and each.other.is_timer for each in clashes):
        return "random"
    if share([each.apart_s < 2 * each.airtime_s for each in clashes]) >= _MOST:
        changes = {round(each.apart_s, 9) for each in clashes}
        return "drifting" if _drifts(clashes, changes) else "synchronized"
    return "random"


def _drifts(clashes: Sequence[Clash], distances: set[float]) -> bool:
    """Return whether clashes come in series in which the distance of the timers changes step by step.

    Timers in lock-step keep their distance. Independent ones have distances in any order.
    """
    steps = [abs(after.apart_s - before.apart_s) for before, after in pairwise(clashes)]
    return len(distances) > len(clashes) / 2 and len(steps) > 2 and max(steps) > 0 and _is_smooth(steps)


def _is_smooth(steps: Sequence[float]) -> bool:
    middle = median(steps)
    return middle > 0 and sum(abs(step - middle) < middle / 10 for step in steps) >= _MOST * len(steps)


class _Run:
    """Tables of a replay, indexed."""

    def __init__(self, replay: Replay) -> None:
        self._groups = {node["id"]: _group(node, replay.run["nodes"]) for node in replay.run["nodes"]}
        self._frames: dict[str, Any] = replay.table("frames")
        self._ends = [
            start + duration
            for start, duration in zip(self._frames["time_ns"], self._frames["duration_ns"], strict=True)
        ]
        self._longest = max(self._frames["duration_ns"], default=0)
        self.receptions = list(zip(*replay.table("receptions").values(), strict=True))
        self._heard = {(frame, receiver) for frame, receiver, _ in self.receptions}
        self._interferers = _interferers(replay)
        self._timers = _timers(replay)
        self.busiest = self._share_of_the_busiest(replay.end_s)

    def clashes(self) -> Iterator[Clash]:
        for frame, receiver, outcome in self.receptions:
            if outcome in _LOST_TO_OTHERS and self._is_for(frame, receiver):
                other = self._other(frame, receiver, outcome)
                if other is not None:
                    yield self._clash(frame, other)

    def period_s(self, origins: Sequence[Origin]) -> float:
        gaps = [
            after - before
            for (node, timer), times in self._timers.items()
            if any(timer == each.timer and self._groups[node] == each.group for each in origins)
            for before, after in pairwise(times)
        ]
        return median(gaps) / _NS_PER_S if gaps else 0.0

    def _clash(self, frame: int, other: int) -> Clash:
        frames = self._frames
        return Clash(
            frames["time_ns"][frame] / _NS_PER_S,
            self._origin(frame),
            self._origin(other),
            abs(self._due_ns(frame) - self._due_ns(other)) / _NS_PER_S,
            (frame, frames["node"][other]) not in self._heard
            and (other, frames["node"][frame]) not in self._heard,
            max(frames["duration_ns"][frame], frames["duration_ns"][other]) / _NS_PER_S,
        )

    def _is_for(self, frame: int, receiver: int) -> bool:
        return self._frames["destination"][frame] in (BROADCAST, receiver)

    def _origin(self, frame: int) -> Origin:
        return Origin(self._groups[self._frames["node"][frame]], self._frames["cause"][frame])

    def _due_ns(self, frame: int) -> int:
        """Return when the timer that sent a frame expired; for other frames their start."""
        start: int = self._frames["time_ns"][frame]
        cause: str = self._frames["cause"][frame]
        times = self._timers.get((self._frames["node"][frame], cause.removeprefix(_TIMER)), ())
        index = bisect_right(times, start)
        return times[index - 1] if cause.startswith(_TIMER) and index else start

    def _other(self, frame: int, receiver: int, outcome: int) -> int | None:
        """Return the frame that destroyed a reception: the one that overlaps with it most."""
        wanted = {receiver} if OUTCOMES[outcome] == "receiver_transmitting" else None
        if OUTCOMES[outcome] == "interference":
            wanted = self._interferers.get((frame, receiver))
        sender = self._frames["node"][frame]
        overlapping = [
            (self._overlap_ns(frame, other), -other)
            for other in self._around(frame)
            if self._frames["node"][other] != sender
            and (
                self._frames["node"][other] in wanted
                if wanted is not None
                else (other, receiver) in self._heard
            )
        ]
        return -max(overlapping)[1] if overlapping else None

    def _around(self, frame: int) -> Iterator[int]:
        """Yield the frames that are on the air together with a frame. They are sorted by their starts."""
        starts = self._frames["time_ns"]
        first = bisect_right(starts, starts[frame] - self._longest - 1)
        for other in range(first, bisect_right(starts, self._ends[frame])):
            if other != frame and self._ends[other] >= starts[frame]:
                yield other

    def _overlap_ns(self, frame: int, other: int) -> int:
        starts = self._frames["time_ns"]
        overlap: int = min(self._ends[frame], self._ends[other]) - max(starts[frame], starts[other])
        return overlap

    def _share_of_the_busiest(self, end_s: float) -> float:
        busy_ns: Counter[int] = Counter()
        for frame, receiver, _ in self.receptions:
            busy_ns[receiver] += self._frames["duration_ns"][frame]
        for node, duration_ns in zip(self._frames["node"], self._frames["duration_ns"], strict=True):
            busy_ns[node] += duration_ns
        return max(busy_ns.values(), default=0) / _NS_PER_S / end_s if end_s else 0.0


def _group(node: Mapping[str, Any], nodes: Sequence[Mapping[str, Any]]) -> str:
    group: str = node["group"]
    return group if node["name"] == group else f"{group}[*]"


def _interferers(replay: Replay) -> dict[tuple[int, int], set[int]]:
    found: defaultdict[tuple[int, int], set[int]] = defaultdict(set)
    for frame, receiver, node in zip(*replay.table("interferers").values(), strict=True):
        found[frame, receiver].add(node)
    return found


def _timers(replay: Replay) -> dict[tuple[int, str], list[int]]:
    """Return {(node, timer): times at which it expired, in ns}."""
    found: defaultdict[tuple[int, str], list[int]] = defaultdict(list)
    for time_ns, node, kind, text in zip(*replay.table("events").values(), strict=True):
        if EVENT_KINDS[kind] == "timer":
            found[node, text].append(time_ns)
    return found
