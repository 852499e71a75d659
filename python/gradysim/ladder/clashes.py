"""Clashes: which timers of which nodes send into each other, from the replays of runs."""

import math
from bisect import bisect_left, bisect_right
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from statistics import median
from typing import Any, Literal

from gradysim.ladder.callbacks import without_numbers
from gradysim.replay.reader import Replay
from gradysim.replay.tables import BROADCAST, DATA_KINDS, EVENT_KINDS, OUTCOMES
from gradysim.results.tracked_variables import group_of

Verdict = Literal["saturated", "hidden", "synchronized", "drifting", "hidden and drifting", "random"]

LOST_TO_OTHERS = (
    "interference",
    "receiver_transmitting",
    "receiver_locked",
    "captured",
    "preamble_undetected",
)
"""Outcomes of receptions that are lost to another frame."""

_LOST_TO_OTHERS = {OUTCOMES.index(name) for name in LOST_TO_OTHERS}
_IN_AIR = OUTCOMES.index("in_air")
_TOO_WEAK = OUTCOMES.index("below_sensitivity")
_TIMER = "timer "
_ANSWER = "packet"
_NS_PER_S = 1e9
_NS = 1.5e-9
"""Rounding error of the distance between two times, in s."""

_SATURATED = 0.7
"""Share of the time that frames fill at a receiver, from which on no jitter helps."""

_MOST = 0.8
"""Share of clashes that makes a verdict."""

_LEAST_STEPS = 5
"""Steps from clash to clash that show a drift. Fewer may be equal by chance."""

_OFTEN = 0.2
"""Least share of frames that are due together if nodes are synchronized."""

_MORE_THAN_CHANCE = 3
"""Factor by which frames of synchronized nodes are due together more often than at random times."""


@dataclass(frozen=True)
class Origin:
    """What sent a frame: a callback of a group of nodes, such as `timer heartbeat` of `uavs[*]`.

    Timers that differ in numbers alone are one: `timer retry-#`.
    """

    group: str
    cause: str

    def __str__(self) -> str:
        return f"{text_of_cause(self.cause)} of {self.group}"

    @property
    def is_timer(self) -> bool:
        """Whether it is a timer."""
        return self.cause.startswith(_TIMER)

    @property
    def timer(self) -> str:
        """Name of the timer, with "#" for numbers."""
        return self.cause.removeprefix(_TIMER)


def text_of_cause(cause: str) -> str:
    """Return `timer "heartbeat"`, or the name of another callback. ACK, RTS and CTS have none."""
    if cause.startswith(_TIMER):
        return f'timer "{cause.removeprefix(_TIMER)}"'
    return f"handle_{cause}" if cause in (_ANSWER, "telemetry") else cause or "control frames"


@dataclass(frozen=True)
class Clash:
    """One reception that another frame destroyed, or that was missed because of it.

    Attributes:
        time_s: Start of the lost frame.
        lost: Origin of the lost frame.
        other: Origin of the other one.
        apart_s: Time between what sent the two frames: timers, or the messages that they answer.
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
        apart_s: Median time between what sent the two frames.
    """

    origins: tuple[Origin, ...]
    count: int
    verdict: Verdict
    period_s: float
    apart_s: float


@dataclass(frozen=True)
class Diagnosis:
    """Clashes of one or several runs.

    Attributes:
        receptions: Number of receptions that their receivers noticed, without those in progress at the end.
        clashes: Number of them that other frames destroyed.
        busiest: Largest share of the time that frames fill at a receiver, in any run.
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
            _verdict(alike, run),
            run.period_s(origins),
            median(each.apart_s for each in alike),
        )
        for origins, alike in by_origins.items()
    ]
    patterns.sort(key=lambda pattern: -pattern.count)
    airtime_s = median(each.airtime_s for each in clashes) if clashes else 0.0
    ended = sum(outcome != _IN_AIR for *_, outcome in run.receptions)
    return Diagnosis(ended, len(clashes), run.busiest, tuple(patterns), airtime_s)


def merged(diagnoses: Sequence[Diagnosis]) -> Diagnosis:
    """Return the clashes of all these runs.

    A pattern has the verdict of most of its clashes, and the times of the run that has most of them.
    """
    by_origins: defaultdict[tuple[Origin, ...], list[Pattern]] = defaultdict(list)
    for diagnosis in diagnoses:
        for pattern in diagnosis.patterns:
            by_origins[pattern.origins].append(pattern)
    patterns = []
    for alike in by_origins.values():
        verdicts: Counter[Verdict] = Counter()
        for pattern in alike:
            verdicts[pattern.verdict] += pattern.count
        ((verdict, _),) = verdicts.most_common(1)
        most = max((each for each in alike if each.verdict == verdict), key=lambda each: each.count)
        patterns.append(replace(most, count=verdicts.total()))
    airtimes = [each.airtime_s for each in diagnoses if each.clashes]
    return Diagnosis(
        sum(each.receptions for each in diagnoses),
        sum(each.clashes for each in diagnoses),
        max((each.busiest for each in diagnoses), default=0.0),
        tuple(sorted(patterns, key=lambda pattern: -pattern.count)),
        median(airtimes) if airtimes else 0.0,
    )


def _verdict(clashes: Sequence[Clash], run: "_Run") -> Verdict:
    if run.busiest >= _SATURATED:
        return "saturated"
    if _is_synchronized(clashes, run):
        return "synchronized"
    is_hidden = sum(each.is_hidden for each in clashes) >= _MOST * len(clashes)
    if _drifts(clashes):
        return "hidden and drifting" if is_hidden else "drifting"
    return "hidden" if is_hidden else "random"


def _is_synchronized(clashes: Sequence[Clash], run: "_Run") -> bool:
    """Return whether frames of the two origins are due together more often than by chance.

    "Together" is as close as in most of the clashes. Frames that overlap by chance are due at any distance
    below their duration, so this alone would not distinguish them.
    """
    distances = sorted(each.apart_s for each in clashes)
    apart_s = distances[math.ceil(_MOST * len(distances)) - 1]
    share, by_chance = run.together(clashes[0].lost, clashes[0].other, apart_s)
    return share >= max(_OFTEN, _MORE_THAN_CHANCE * by_chance)


def _drifts(clashes: Sequence[Clash]) -> bool:
    """Return whether clashes come in series in which the distance of the timers changes step by step.

    Timers in lock-step keep their distance. Independent ones have distances in any order.
    """
    if not all(each.lost.is_timer and each.other.is_timer for each in clashes):
        return False
    steps = [abs(after.apart_s - before.apart_s) for before, after in pairwise(clashes)]
    changes = [step for step in steps if step > _NS]  # of two lost frames, each is a clash
    return len(changes) >= _LEAST_STEPS and _is_smooth(changes)


def _is_smooth(steps: Sequence[float]) -> bool:
    middle = median(steps)
    return sum(abs(step - middle) < middle / 10 for step in steps) >= _MOST * len(steps)


class _Run:
    """Tables of a replay, indexed."""

    def __init__(self, replay: Replay) -> None:
        self._groups = {node["id"]: group_of(node["name"]) for node in replay.run["nodes"]}
        self._frames: dict[str, Any] = replay.table("frames")
        self._causes = [without_numbers(cause) for cause in self._frames["cause"]]
        self._ends = [
            start + duration
            for start, duration in zip(self._frames["time_ns"], self._frames["duration_ns"], strict=True)
        ]
        self._longest = max(self._frames["duration_ns"], default=0)
        rows = zip(*replay.table("receptions").values(), strict=True)
        self.receptions = [row for row in rows if row[2] != _TOO_WEAK]
        self._heard = {(frame, receiver) for frame, receiver, _ in self.receptions}
        self._interferers = _interferers(replay)
        self._timers = _timers(replay)
        self._end_ns = replay.end_s * _NS_PER_S
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

    def together(self, one: Origin, other: Origin, apart_s: float) -> tuple[float, float]:
        """Return the share of frames that are due together with one of another node, and that by chance.

        The share is that of the origin with the larger one. Chance means that frames are due at random times.
        """
        window_ns = apart_s * _NS_PER_S + 1  # times are rounded
        shares = [self._share_together(*pair, window_ns) for pair in ((one, other), (other, one))]
        return max(shares)

    def _share_together(self, one: Origin, other: Origin, window_ns: float) -> tuple[float, float]:
        due, others = self._due[one], self._due[other]
        together = 0
        expected = 0.0
        rate = 2 * window_ns / max(1.0, self._end_ns)
        frames_of = Counter(node for _, node in others)
        for time_ns, node in due:
            first = bisect_left(others, (math.ceil(time_ns - window_ns), -1))
            last = bisect_right(others, (math.floor(time_ns + window_ns), math.inf))
            together += any(others[index][1] != node for index in range(first, last))
            expected += 1 - math.exp(-rate * (len(others) - frames_of[node]))
        return together / len(due), expected / len(due)

    @cached_property
    def _due(self) -> Mapping[Origin, Sequence[tuple[int, int]]]:
        """{origin: (time in ns at which it was due, node) of each frame}, by time, without retries."""
        found: defaultdict[Origin, list[tuple[int, int]]] = defaultdict(list)
        for frame, (node, retry) in enumerate(zip(self._frames["node"], self._frames["retry"], strict=True)):
            if not retry:
                found[self._origin(frame)].append((self._due_ns(frame), node))
        return {origin: sorted(due) for origin, due in found.items()}

    @cached_property
    def _answerable(self) -> Mapping[int, Sequence[int]]:
        """{node: ends in ns of the messages that it received}."""
        found: defaultdict[int, list[int]] = defaultdict(list)
        for frame, receiver, outcome in self.receptions:
            is_message = self._frames["kind"][frame] in DATA_KINDS and self._is_for(frame, receiver)
            if is_message and OUTCOMES[outcome] == "delivered":
                found[receiver].append(self._ends[frame])
        return {node: sorted(ends) for node, ends in found.items()}

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
        return Origin(self._groups[self._frames["node"][frame]], self._causes[frame])

    def _due_ns(self, frame: int) -> int:
        """Return when the timer expired or the message arrived that sent a frame, or the frame's start."""
        start: int = self._frames["time_ns"][frame]
        cause = self._causes[frame]
        node = self._frames["node"][frame]
        times: Sequence[int] = ()
        if cause.startswith(_TIMER):
            times = self._timers.get((node, cause.removeprefix(_TIMER)), ())
        elif cause == _ANSWER:
            times = self._answerable.get(node, ())
        index = bisect_right(times, start)
        return times[index - 1] if index else start

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


def _interferers(replay: Replay) -> dict[tuple[int, int], set[int]]:
    found: defaultdict[tuple[int, int], set[int]] = defaultdict(set)
    table = replay.table("interferers")
    columns = (table[column] for column in ("frame", "receiver", "node"))
    for frame, receiver, node in zip(*columns, strict=True):
        found[frame, receiver].add(node)
    return found


def _timers(replay: Replay) -> dict[tuple[int, str], list[int]]:
    """Return {(node, timer without numbers): times at which it expired, in ns}."""
    found: defaultdict[tuple[int, str], list[int]] = defaultdict(list)
    for time_ns, node, kind, text in zip(*replay.table("events").values(), strict=True):
        if EVENT_KINDS[kind] == "timer":
            found[node, without_numbers(text)].append(time_ns)
    return found
