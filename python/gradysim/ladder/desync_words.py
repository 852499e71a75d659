"""Which timers send into each other, in sentences."""

from collections.abc import Iterator

from gradysim.ladder.clashes import Diagnosis, Pattern
from gradysim.ladder.desync import Desync

_BECAUSE = {
    "synchronized": "fire together, {apart} apart{every}",
    "drifting": "drift past each other: they come close again and again{every}",
    "hidden": "come from nodes that do not hear each other, so jitter does not help",
    "hidden and drifting": "drift past each other, and come from nodes that do not hear each other: agree on"
    " a clock, or use RTS and CTS",
    "saturated": "fill the channel, so jitter does not help: send less or shorter frames",
    "random": "meet by chance, {apart} apart",
}
_ANSWERS = "send together, {apart} apart: they need a random delay before each message"
"""What is said of synchronized frames without a timer."""

_RARE = 0.01
"""Ratio of clashes below which a pattern is not worth a line."""


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
        apart=text_of_time(pattern.apart_s),
        every=f", every {text_of_time(pattern.period_s)}" if pattern.period_s else "",
    )
    return f"{' and '.join(map(str, pattern.origins))}: {because}"


def text_of_time(seconds: float) -> str:
    """Return `40 ms`."""
    seconds = float(f"{seconds:.3g}")  # or 0.9999 s would be 1e+03 ms
    for unit, size in (("s", 1), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return "0 s" if seconds == 0 else f"{seconds * 1e9:.3g} ns"
