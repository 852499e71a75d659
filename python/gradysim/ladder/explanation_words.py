"""Why a level breaks a protocol, in sentences."""

from collections.abc import Iterator, Mapping

from gradysim.ladder.clashes import text_of_cause
from gradysim.ladder.desync_words import pattern_sentences
from gradysim.ladder.why import Explanation

_LEAST_INCREASE = 0.001
"""Increase of a ratio of losses below which it is not worth a line."""


def explanation_sentences(explanation: Explanation, works: int, fails: int) -> Iterator[str]:
    """Yield what differs between a run at the level `works` and one at the level `fails`."""
    yield from _loss_sentences("Receptions", explanation.losses, works, fails)
    yield from _loss_sentences("Messages", explanation.messages, works, fails)
    yield from pattern_sentences(explanation.diagnosis, 2)
    first = explanation.first
    if first is None:
        yield "All frames have the same outcomes at both levels. Times or positions differ."
    else:
        yield (
            f"First difference, at {first.time_s:.6f} s: the frame of {text_of_cause(first.cause)} from"
            f" {first.sender} at {first.receiver} is {_text_of(first.before)} at level {works} and"
            f" {_text_of(first.after)} at level {fails}."
        )


def _loss_sentences(
    what: str, losses: Mapping[str, tuple[float, float]], works: int, fails: int
) -> Iterator[str]:
    """Yield the two largest increases."""
    for outcome, (before, after) in list(losses.items())[:2]:
        if after - before >= _LEAST_INCREASE:
            yield f"{what} {_text_of(outcome)}: {after:.1%} at level {fails}, {before:.1%} at level {works}."


def _text_of(outcome: str) -> str:
    known = {"": "not sent", "delivered": "delivered", "below_sensitivity": "too weak or out of range"}
    return known.get(outcome, f"lost to `{outcome.replace('_', ' ')}`")
