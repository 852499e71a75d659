"""Why a level breaks a protocol, in sentences."""

from collections.abc import Iterator, Mapping

from gradysim.ladder.callbacks import Effect
from gradysim.ladder.clashes import text_of_cause
from gradysim.ladder.desync_words import pattern_sentences, text_of_time
from gradysim.ladder.difference import Difference, Event
from gradysim.ladder.why import Explanation
from gradysim.protocol.plain_value import readable_number

_LEAST_INCREASE = 0.001
"""Increase of a ratio of losses below which it is not worth a line."""

_LONGEST = 60
"""Characters of a value."""


def explanation_sentences(explanation: Explanation, works: int, fails: int) -> Iterator[str]:
    """Yield what differs between a run at the level `works` and one at the level `fails`."""
    yield from _loss_sentences("Receptions", explanation.losses, works, fails)
    yield from _loss_sentences("Messages", explanation.messages, works, fails)
    yield from pattern_sentences(explanation.diagnosis, 2)
    first = explanation.first
    if first is None:
        yield "All callbacks of protocols in Python do the same at both levels, at the same times."
    else:
        yield f"First difference, at {first.time_s:.6f} s at {first.node}: {_text_of(first, works, fails)}."
        yield from _consequences(first, fails)


def _loss_sentences(
    what: str, losses: Mapping[str, tuple[float, float]], works: int, fails: int
) -> Iterator[str]:
    """Yield the two largest increases."""
    for outcome, (before, after) in list(losses.items())[:2]:
        if after - before >= _LEAST_INCREASE:
            lost = _text_of_outcome(outcome)
            yield f"{what} {lost}: {after:.1%} at level {fails}, {before:.1%} at level {works}."


def _text_of_outcome(outcome: str) -> str:
    known = {
        "delivered": "delivered",
        "below_sensitivity": "too weak or out of range",
        "queued": "not sent before the end of the run",
    }
    return known.get(outcome, f"lost to `{outcome.replace('_', ' ')}`")


def _text_of(first: Difference, works: int, fails: int) -> str:
    event = _text_of_event(first.event, first.message)
    if first.kind in ("lost", "gained"):
        before, after = map(_text_of_outcome, first.outcomes)
        return f"{event} is {before} at level {works} and {after} at level {fails}"
    if first.kind == "order":
        assert first.other is not None
        before, after = (
            _text_of_order(apart_s, is_later)
            for apart_s, is_later in zip(first.apart_s, (not first.is_later, first.is_later), strict=True)
        )
        other = _text_of_event(first.other)
        return f"{event} comes {after} {other} at level {fails}, and {before} it at level {works}"
    if first.kind == "position":
        return f"in {event}, it is {first.distance_m:.3g} m away from its position at level {works}"
    if first.kind == "reported position":
        return f"{event} reports a position that is {first.distance_m:.3g} m away from the true one"
    if first.kind == "time":
        delay_s = first.apart_s[1]
        later = "later" if delay_s > 0 else "earlier"
        return f"{event} comes {text_of_time(abs(delay_s))} {later} at level {fails} than at level {works}"
    same = "after calls in the same order, at the same time and position"
    return f"{event} {_deeds(first)} at level {fails}, {same}"


def _text_of_order(apart_s: float, is_later: bool) -> str:
    side = "after" if is_later else "before"
    return f"{text_of_time(abs(apart_s))} {side}" if apart_s else f"right {side}"


def _text_of_event(event: Event, message: tuple[int, int] = (1, 1)) -> str:
    if not event.sender:
        return text_of_cause(event.name)
    number, count = message
    if count > 1:
        return f"message {number} of {count} of {text_of_cause(event.cause)} from {event.sender}"
    if event.is_answer:
        return f"the answer of {event.sender}"
    return f"the message of {text_of_cause(event.cause)} from {event.sender}"


def _consequences(first: Difference, fails: int) -> Iterator[str]:
    """Yield what a callback does because of the difference, and what it no longer does."""
    if first.affected is not None and first.kind != "values":
        yield (
            f"So {text_of_cause(first.affected.name)} {_deeds(first)} at level {fails},"
            f" at {first.affected_time_s:.6f} s."
        )


def _deeds(first: Difference) -> str:
    before, after = first.effects
    if before and after and before[0][:2] == after[0][:2] and after[0].action in ("set", "attribute"):
        return f"{_text_of_effect(after[0])} instead of {_text_of_value(before[0].value)}"
    does = [_text_of_effect(each) for each in after[:1]]
    does += [_text_of_missing_effect(each) for each in before[:1]]
    return " and ".join(does)


def _text_of_effect(effect: Effect) -> str:
    name = str(effect.what)
    texts = {
        "send": "sends a message",
        "timer": f'sets timer "{name}"',
        "cancel": f'cancels timer "{name}"',
        "move": "commands the vehicle",
        "set": f"sets `{name}` to {_text_of_value(effect.value)}",
        "attribute": f"sets `self.{name}` to {_text_of_value(effect.value)}",
        "raise": f"raises {name}: {effect.value}" if effect.value else f"raises {name}",
    }
    if effect.action == "attribute" and isinstance(effect.value, tuple):
        return f"changes `self.{name}`"
    return texts[effect.action]


def _text_of_missing_effect(effect: Effect) -> str:
    name = str(effect.what)
    return {
        "send": "does not send its message",
        "timer": f'does not set timer "{name}"',
        "cancel": f'does not cancel timer "{name}"',
        "move": "does not command the vehicle",
        "set": f"does not set `{name}`",
        "attribute": f"does not change `self.{name}`",
        "raise": f"does not raise {name}",
    }[effect.action]


def _text_of_value(value: object) -> str:
    if isinstance(value, int | float) and not isinstance(value, bool):
        return f"{readable_number(value):.6g}"
    return str(value)[:_LONGEST]
