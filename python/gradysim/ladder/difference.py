"""The first callback at which two runs of one seed part.

Callbacks are paired by what caused them: the same timer or message of the same callback, back to the start of
the run. So a missing message shifts nothing. Two runs part where a callback is missing or does something
else. What explains it is a lost message, two callbacks in another order, another position, or another time.
"""

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal, NamedTuple

from gradysim.ladder.callbacks import Callback, Cause, Effect, without_numbers
from gradysim.ladder.recording import Recording

Kind = Literal["lost", "gained", "order", "position", "reported position", "time", "values"]

_NS_PER_S = 1e9
_LEAST_DISTANCE_M = 0.001
_LEAST_DELAY_NS = 1000
_ACTIONS = ("raise", "set", "send", "move", "cancel", "timer", "attribute")
"""Most telling effects first."""


@dataclass(frozen=True)
class Event:
    """A callback, as a reader knows it.

    Attributes:
        name: `timer NAME`, `packet`, `telemetry` or `initialize`; "#" stands for numbers in names.
        sender: Name of the node whose message a `packet` has; "" for others.
        cause: The callback that sent the message, in the same form.
        is_answer: Whether the message answers one of this node.
    """

    name: str
    sender: str = ""
    cause: str = ""
    is_answer: bool = False


@dataclass(frozen=True)
class Difference:
    """The first difference between a run that works and one that fails.

    Attributes:
        kind: `lost` and `gained`: a message arrives in one run only. `order`: two callbacks in another order.
            `position`: the node is elsewhere. `reported position`: telemetry says so. `time`: the callback
            comes at another time. `values`: all of that is equal, but the callback does something else.
        time_s: Time in the run that fails; in the run that works if it happens only there.
        node: Name of the node.
        event: The callback.
        other: For `order`: the other callback.
        apart_s: For `order`: time from `other` to `event` in both runs, negative if `event` comes first. For
            `time`: 0, and the delay.
        is_later: For `order`: whether `event` comes after `other` in the run that fails.
        outcomes: For `lost` and `gained`: what happens to the message in both runs.
        message: For `lost` and `gained`: the message is number N, from 1 on, of M to this destination in one
            callback.
        distance_m: For `position`: distance between the two positions. For `reported position`: distance
            from the true one, in the run that fails if the callback is there.
        affected: The first callback that does something else because of it; None if there is none.
        affected_time_s: Its time.
        effects: What it does in one run only, in both runs; the most telling effects first.
    """

    kind: Kind
    time_s: float
    node: str
    event: Event
    other: Event | None = None
    apart_s: tuple[float, float] = (0.0, 0.0)
    is_later: bool = False
    outcomes: tuple[str, str] = ("", "")
    message: tuple[int, int] = (1, 1)
    distance_m: float = 0.0
    affected: Event | None = None
    affected_time_s: float = 0.0
    effects: tuple[tuple[Effect, ...], tuple[Effect, ...]] = ((), ())


def first_difference(works: Recording, fails: Recording) -> Difference | None:
    """Return the first difference between two recorded runs of one scenario and seed.

    None if all callbacks do the same at the same times.
    """
    return _Comparison(works, fails).first()


class _Finding(NamedTuple):
    """A callback that is in one run only, or that does something else there. Sorted by time.

    Attributes:
        time_ns: Its time where it works, or else where it fails.
        before: Its index in the log of the run that works; -1 if it is not there.
        after: Likewise, of the run that fails.
        outcomes: What happens to its message in both runs; empty strings if it has none or arrives in both.
    """

    time_ns: int
    before: int
    after: int
    outcomes: tuple[str, str] = ("", "")


class _Late(NamedTuple):
    """A timer that only one run cancels in time.

    Attributes:
        cancels: Indices of the callback that cancels it, where it works and where it fails.
        expires: Indices of the timer; -1 where it is canceled.
        expires_ns: When it expires, or would.
        is_later: Whether the run that fails cancels too late.
    """

    cancels: tuple[int, int]
    expires: tuple[int, int]
    expires_ns: tuple[int, int]
    is_later: bool


_NUMBERS, _UNSEEN = 1, 2
"""Ranks of findings that change numbers in a protocol alone, such as a delay, and nothing that was seen."""


class _Comparison:
    def __init__(self, works: Recording, fails: Recording) -> None:
        self._works, self._fails = works, fails
        self._names = {node["id"]: node["name"] for node in fails.replay.run["nodes"]}
        self._after_of = self._paired()
        self._before_of = {after: before for before, after in self._after_of.items()}

    def first(self) -> Difference | None:
        findings = [*self._changed(), *self._only_where_it_works(), *self._only_where_it_fails()]
        self._unseen = [each for each in findings if self._rank(each) == _UNSEEN]
        found = min(findings, key=lambda each: (self._rank(each), each), default=None)
        if found is None:
            found = next(self._other_values(), None)
        if found is None:
            return next(self._delays(), None)
        if any(found.outcomes):
            return self._message(found)
        return self._explained(found)

    def _paired(self) -> Mapping[int, int]:
        """Return {index where it works: index where it fails} of the callbacks with equal causes."""
        indices = {
            _key(callback, callback.cause): index for index, callback in enumerate(self._works.callbacks)
        }
        before_of: dict[int, int] = {}
        after_of: dict[int, int] = {}
        for after, callback in enumerate(self._fails.callbacks):
            cause = callback.cause
            if cause is not None:
                cause = _mapped(cause, before_of)
                if cause is None:
                    continue
            before = indices.get(_key(callback, cause))
            if before is not None and before not in after_of:
                before_of[after] = before
                after_of[before] = after
        return after_of

    def _changed(self) -> Iterator[_Finding]:
        for before, after in self._after_of.items():
            one, other = self._works.callbacks[before], self._fails.callbacks[after]
            if one.effects != other.effects and _alike(one) != _alike(other):
                yield _Finding(one.time_ns, before, after)

    def _only_where_it_works(self) -> Iterator[_Finding]:
        for index, outcome in _only(self._works, self._fails, self._after_of):
            outcomes = ("delivered", outcome) if outcome else ("", "")
            yield _Finding(self._works.callbacks[index].time_ns, index, -1, outcomes)

    def _only_where_it_fails(self) -> Iterator[_Finding]:
        for index, outcome in _only(self._fails, self._works, self._before_of):
            outcomes = (outcome, "delivered") if outcome else ("", "")
            yield _Finding(self._fails.callbacks[index].time_ns, -1, index, outcomes)

    def _rank(self, found: _Finding) -> int:
        """Return how little a finding tells; the first one of the lowest rank is the answer."""
        before, after = self._effects_of(found)
        if not before and not after:
            return _UNSEEN
        is_number = all(
            each.action == "attribute" and isinstance(each.value, int | float)
            for each in (*_without(before, after), *_without(after, before))
        )
        return _NUMBERS if is_number and not any(found.outcomes) else 0

    def _effects_of(self, found: _Finding) -> tuple[Sequence[Effect], Sequence[Effect]]:
        return (
            self._works.callbacks[found.before].effects if found.before >= 0 else (),
            self._fails.callbacks[found.after].effects if found.after >= 0 else (),
        )

    def _callback(self, found: _Finding) -> Callback:
        """Return the callback of the run that fails, or else of the one that works."""
        is_there = found.after >= 0
        return self._fails.callbacks[found.after] if is_there else self._works.callbacks[found.before]

    def _event(self, found: _Finding) -> Event:
        recording = self._fails if found.after >= 0 else self._works
        callback = self._callback(found)
        if callback.frame is None:
            return Event(without_numbers(callback.name))
        sender = recording.frames["node"][callback.frame]
        cause = without_numbers(recording.frames["cause"][callback.frame])
        return Event(callback.name, self._names[sender], cause, _is_answer(recording, callback))

    def _message(self, found: _Finding) -> Difference:
        """Return the difference of a message that arrives in one run only."""
        callback = self._callback(found)
        number, count = 0, 0
        time_ns = callback.time_ns
        if callback.cause is not None:
            recording = self._fails
            cause = callback.cause if found.after >= 0 else _mapped(callback.cause, self._after_of)
            assert cause is not None
            number, count = cause.number, recording.count(cause)
            rows = recording.frames_of.get(cause)
            time_ns = recording.frames["time_ns"][rows[0]] if rows else recording.time_ns(cause)
        return Difference(
            "lost" if found.after < 0 else "gained",
            time_ns / _NS_PER_S,
            self._names[callback.node],
            self._event(found),
            outcomes=found.outcomes,
            message=(number + 1, count),
        )

    @cached_property
    def _late_cancels(self) -> Mapping[tuple[int, int], _Late]:
        """Timers that one run cancels, and the other one too late.

        By the two indices of the callback that cancels, and by those of the timer.
        """
        found: dict[tuple[int, int], _Late] = {}
        for canceler, late, timer, due_ns in _late(self._works, self._fails, self._after_of):
            expires_ns = (due_ns, self._fails.callbacks[timer].time_ns)
            each = _Late((canceler, late), (-1, timer), expires_ns, is_later=True)
            found |= {each.cancels: each, each.expires: each}
        for canceler, late, timer, due_ns in _late(self._fails, self._works, self._before_of):
            expires_ns = (self._works.callbacks[timer].time_ns, due_ns)
            each = _Late((late, canceler), (timer, -1), expires_ns, is_later=False)
            found |= {each.cancels: each, each.expires: each}
        return found

    def _cancellation(self, found: _Finding) -> Difference | None:
        """Return the difference of a timer that one run cancels too late.

        None if this callback is neither the timer nor what cancels it.
        """
        late = self._late_cancels.get((found.before, found.after))
        if late is None:
            return None
        before, after = late.cancels
        times_ns = (self._works.callbacks[before].time_ns, self._fails.callbacks[after].time_ns)
        apart = [(mine - its) / _NS_PER_S for mine, its in zip(times_ns, late.expires_ns, strict=True)]
        return Difference(
            "order",
            min(times_ns[1], late.expires_ns[1]) / _NS_PER_S,
            self._names[self._callback(found).node],
            self._event(_Finding(0, *late.cancels)),
            self._event(_Finding(0, *late.expires)),
            (apart[0], apart[1]),
            late.is_later,
        )

    def _explained(self, found: _Finding) -> Difference:
        """Return what explains that a callback does something else."""
        explanation = (
            self._cancellation(found)
            or self._order(found)
            or self._unseen_message(found)
            or self._position(found)
            or self._earlier_order(found)
            or self._delay(found)
        )
        return self._with_effects(found, explanation)

    def _with_effects(self, found: _Finding, difference: Difference) -> Difference:
        before, after = self._effects_of(found)
        effects = (_without(before, after), _without(after, before))
        if not any(effects):
            pairs = [pair for pair in zip(before, after, strict=True) if _has_other_value(*pair)]
            effects = (tuple(one for one, _ in pairs), tuple(other for _, other in pairs))
        return replace(
            difference,
            affected=self._event(found),
            affected_time_s=self._callback(found).time_ns / _NS_PER_S,
            effects=effects,
        )

    def _order(self, found: _Finding) -> Difference | None:
        """Return the nearest callback of the node that comes on the other side of this one in one run."""
        if found.before < 0 or found.after < 0:
            return None
        node = self._callback(found).node
        one, other = self._works.callbacks, self._fails.callbacks
        at = (one[found.before].time_ns, other[found.after].time_ns)
        nearest: tuple[int, int, int] | None = None
        for before, after in self._after_of.items():
            is_crossed = (before < found.before) != (after < found.after)
            if is_crossed and one[before].node == node and (one[before].effects or other[after].effects):
                distance = abs(one[before].time_ns - at[0]) + abs(other[after].time_ns - at[1])
                nearest = min(nearest or (distance, before, after), (distance, before, after))
        return None if nearest is None else self._crossed(found, _Finding(0, *nearest[1:]))

    def _earlier_order(self, found: _Finding) -> Difference | None:
        """Return the last two callbacks of the node before this one that changed places.

        What they changed was not seen. It may be inside an object.
        """
        node = self._callback(found).node
        crossed: tuple[_Finding, _Finding] | None = None
        last: _Finding | None = None
        for before, after in sorted(self._after_of.items()):
            is_earlier = not (before >= found.before >= 0 or after >= found.after >= 0)
            if is_earlier and self._works.callbacks[before].node == node:
                pair = _Finding(0, before, after)
                if last is None or after > last.after:
                    last = pair
                else:
                    crossed = (pair, last)
        return None if crossed is None else self._crossed(*crossed)

    def _crossed(self, one: _Finding, other: _Finding) -> Difference:
        """Return the difference of two callbacks that come in another order."""
        if not self._event(one).sender and self._event(other).sender:
            one, other = other, one
        before, after = (
            (recording.callbacks[first].time_ns, recording.callbacks[second].time_ns)
            for recording, first, second in (
                (self._works, one.before, other.before),
                (self._fails, one.after, other.after),
            )
        )
        return Difference(
            "order",
            min(after) / _NS_PER_S,
            self._names[self._callback(one).node],
            self._event(one),
            self._event(other),
            ((before[0] - before[1]) / _NS_PER_S, (after[0] - after[1]) / _NS_PER_S),
            one.after > other.after,
        )

    def _unseen_message(self, found: _Finding) -> Difference | None:
        """Return the last message before this callback that arrives at the node in one run only.

        What it changed was not seen. It may be inside an object.
        """
        node = self._callback(found).node
        earlier = [
            each
            for each in self._unseen
            if any(each.outcomes) and each < found and self._callback(each).node == node
        ]
        return self._message(max(earlier)) if earlier else None

    def _position(self, found: _Finding) -> Difference | None:
        callback = self._callback(found)
        time_s = callback.time_ns / _NS_PER_S
        one, other = (each.replay.positions(time_s)[callback.node] for each in (self._works, self._fails))
        kind: Kind = "position"
        distance_m = math.dist(one, other)
        if distance_m < _LEAST_DISTANCE_M and callback.position is not None:
            kind, distance_m = "reported position", math.dist(callback.position, other)
        if distance_m < _LEAST_DISTANCE_M:
            return None
        return Difference(kind, time_s, self._names[callback.node], self._event(found), distance_m=distance_m)

    def _delay(self, found: _Finding) -> Difference:
        callback = self._callback(found)
        delay_ns = 0
        if found.before >= 0 and found.after >= 0:
            delay_ns = callback.time_ns - self._works.callbacks[found.before].time_ns
        return Difference(
            "time" if delay_ns else "values",
            callback.time_ns / _NS_PER_S,
            self._names[callback.node],
            self._event(found),
            apart_s=(0.0, delay_ns / _NS_PER_S),
        )

    def _other_values(self) -> Iterator[_Finding]:
        """Yield callbacks that set a tracked variable to another number."""
        for before, after in self._after_of.items():
            one, other = self._works.callbacks[before], self._fails.callbacks[after]
            if any(map(_has_other_value, one.effects, other.effects)):
                yield _Finding(one.time_ns, before, after)

    def _delays(self) -> Iterator[Difference]:
        for before, after in self._after_of.items():
            found = _Finding(self._works.callbacks[before].time_ns, before, after)
            if abs(self._fails.callbacks[after].time_ns - found.time_ns) >= _LEAST_DELAY_NS:
                yield self._delay(found)


def _key(callback: Callback, cause: Cause | None) -> object:
    """Return what a callback and its partner have in common. `cause` is that of the run that works."""
    return (callback.node, cause) if cause is not None else (callback.node, callback.name, callback.number)


def _mapped(cause: Cause, partner: Mapping[int, int]) -> Cause | None:
    """Return a cause as the other run has it; None if its callback has no partner there."""
    index = partner.get(cause.callback) if cause.callback >= 0 else cause.callback
    return None if index is None else cause._replace(callback=index)


def _only(here: Recording, there: Recording, partner: Mapping[int, int]) -> Iterator[tuple[int, str]]:
    """Yield the callbacks that are only `here`, and what happens to their message in the other run.

    Their timer or message exists in both runs, or what made it is the difference.
    """
    for index, callback in enumerate(here.callbacks):
        if index in partner or callback.time_ns >= there.end_ns:
            continue
        if callback.name == "telemetry":
            yield index, ""
        elif callback.cause is not None and (cause := _mapped(callback.cause, partner)) is not None:
            if callback.name != "packet":
                if cause in there.recorded.log.canceled:
                    yield index, ""
            elif outcome := there.outcome(cause, callback.node):
                yield index, outcome


def _late(
    here: Recording, there: Recording, partner: Mapping[int, int]
) -> Iterator[tuple[int, int, int, int]]:
    """Yield timers that `here` cancels, and the other run too late.

    Each has the index of the callback that cancels it in both runs, the index of the timer there, and when it
    would have expired here, in ns.
    """
    timers = {
        each.cause: index
        for index, each in enumerate(there.callbacks)
        if each.cause is not None and each.frame is None
    }
    for cause, (canceler, due_ns) in here.recorded.log.canceled.items():
        mapped = _mapped(cause, partner)
        timer = None if mapped is None else timers.get(mapped)
        if canceler in partner and timer is not None and timer < partner[canceler]:
            yield canceler, partner[canceler], timer, due_ns


def _alike(callback: Callback) -> Counter[tuple[object, ...]]:
    return Counter(each.alike for each in callback.effects)


def _is_answer(recording: Recording, callback: Callback) -> bool:
    if callback.cause is None or callback.cause.callback < 0:
        return False
    asked = recording.callbacks[callback.cause.callback]
    if asked.name != "packet" or asked.cause is None:
        return False
    sender = asked.cause.callback
    return (recording.callbacks[sender].node if sender >= 0 else ~sender) == callback.node


def _without(effects: Sequence[Effect], others: Sequence[Effect]) -> tuple[Effect, ...]:
    """Return the effects that are not among the others, the most telling ones first."""
    left = Counter(each.alike for each in others)
    found: list[Effect] = []
    for each in effects:
        if left[each.alike]:
            left[each.alike] -= 1
        else:
            found.append(each)
    return tuple(sorted(found, key=lambda each: _ACTIONS.index(each.action)))


def _has_other_value(one: Effect, other: Effect) -> bool:
    values = (one.value, other.value)
    if one.action != "set" or not all(isinstance(value, int | float) for value in values):
        return False
    return not math.isclose(*values, rel_tol=1e-9)  # type: ignore[arg-type]
