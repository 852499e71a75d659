"""What a bisection or an analysis of timers found, in sentences."""

from collections.abc import Iterator, Mapping

from gradysim.ladder.bisect import Bisection, Verdict
from gradysim.ladder.clashes import Diagnosis, Pattern, text_of_cause
from gradysim.ladder.desync import Desync
from gradysim.ladder.why import Explanation

_BECAUSE = {
    "synchronized": "fire together, {apart} apart, every {period}",
    "drifting": "drift past each other: they come close again and again, every {period}",
    "hidden": "come from nodes that do not hear each other, so jitter does not help",
    "saturated": "fill the channel, so jitter does not help: send less or shorter frames",
    "random": "meet by chance, {apart} apart",
}
_ANSWERS = "send together, {apart} apart: they need a random delay before each message"
"""What is said of synchronized frames without a timer."""

_RARE = 0.01
"""Ratio of clashes below which a pattern is not worth a line."""

_LEAST_INCREASE = 0.001
"""Increase of a ratio of losses below which it is not worth a line."""


def verdict_sentences(bisection: Bisection, verdict: Verdict) -> Iterator[str]:
    """Yield where the protocol breaks."""
    levels = bisection.campaign.levels
    top = len(levels) - 1
    if verdict.fails is None:
        yield f"The protocol works up to the last level, {top} {levels[top].name}: {bisection.at_level(top)}."
        return
    if verdict.works is None:
        yield f"The protocol already fails at level 0, {levels[0].name}: it works in {bisection.at_level(0)}."
        yield from _exception_sentences(bisection, 0)
        return
    works, fails = levels[verdict.works], levels[verdict.fails]
    if verdict.is_sure:
        yield (
            f"The protocol works up to level {verdict.works}, {works.name}"
            f" ({bisection.at_level(verdict.works)}), and fails from level {verdict.fails}, {fails.name}"
            f" (it works in {bisection.at_level(verdict.fails)}). {verdict.run_count} runs, confidence"
            f" {bisection.confidence:g}."
        )
        yield f"Level {verdict.fails} adds: {fails.adds}."
    else:
        yield (
            f"Undecided after {verdict.run_count} runs: the protocol works at level {verdict.works},"
            f" {works.name}, in {bisection.at_level(verdict.works)}, and at level {verdict.fails},"
            f" {fails.name}, in {bisection.at_level(verdict.fails)}."
        )
    yield from _exception_sentences(bisection, verdict.fails)
    if verdict.smallest:
        yield f"Smallest set of effects that makes it fail: {', '.join(verdict.smallest)}."


def _exception_sentences(bisection: Bisection, level: int) -> Iterator[str]:
    exceptions = bisection.at_level(level).exceptions
    if exceptions:
        yield f"{len(exceptions)} of the runs at level {level} end with an exception: {exceptions[0]}"


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


def desync_sentences(found: Desync) -> Iterator[str]:
    """Yield which timers clash, and the jitter that they need."""
    diagnosis = found.diagnosis
    if not diagnosis.clashes:
        yield f"None of {diagnosis.receptions:,} receptions was lost to another frame."
        return
    yield (
        f"{diagnosis.clashes:,} of {diagnosis.receptions:,} receptions were lost to another frame"
        f" ({diagnosis.clashes / diagnosis.receptions:.1%})."
    )
    yield from pattern_sentences(diagnosis, 5)
    if found.jitter_s is None:
        yield f"No jitter was tried: {found.no_trials}."
        return
    named = " and ".join(f'timer "{timer}" of {group}' for group, timer in found.timers)
    first, best = found.trials[0], max(trial.delivery for trial in found.trials)
    if found.jitter_s == 0:
        yield (
            f"A random delay of {named} does not help: {first.delivery:.1%} of the receptions arrive without"
            f" it, {best:.1%} at best ({found.run_count} runs)."
        )
        return
    chosen = next(trial for trial in found.trials if trial.jitter_s == found.jitter_s)
    yield (
        f"Delay {named} by a random time of up to {text_of_time(found.jitter_s)}: {first.delivery:.1%} of the"
        f" receptions arrive without it, {chosen.delivery:.1%} with it, and {best:.1%} at best"
        f" ({found.run_count} runs)."
    )


def pattern_sentences(diagnosis: Diagnosis, most: int) -> Iterator[str]:
    """Yield a line for each of the most frequent patterns of clashes; rare ones are left out."""
    for pattern in diagnosis.patterns[:most]:
        if pattern.count >= diagnosis.clashes * _RARE:
            yield f"  {pattern.count / diagnosis.clashes:4.0%} of them: {_text_of_pattern(pattern)}"


def _text_of_pattern(pattern: Pattern) -> str:
    is_answer = pattern.verdict == "synchronized" and not all(each.is_timer for each in pattern.origins)
    because = (_ANSWERS if is_answer else _BECAUSE[pattern.verdict]).format(
        apart=text_of_time(pattern.apart_s), period=text_of_time(pattern.period_s)
    )
    return f"{' and '.join(map(str, pattern.origins))}: {because}"


def text_of_time(seconds: float) -> str:
    """Return `40 ms`."""
    for unit, size in (("s", 1), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return "0 s" if seconds == 0 else f"{seconds * 1e9:.3g} ns"
