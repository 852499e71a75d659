"""Which timers send into each other, in sentences."""

from collections.abc import Iterator, Mapping

from gradysim.ladder.clashes import Diagnosis, Pattern
from gradysim.ladder.desync import Desync, Trial
from gradysim.ladder.failure import Failure

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

_MUCH = 0.05
"""Ratio of lost receptions from which on a recommendation says what remains lost."""

_MOST_FAILURES = 3
"""Failed runs that are named."""


def desync_sentences(found: Desync) -> Iterator[str]:
    """Yield which timers clash, and the jitter that they need."""
    yield from _failure_sentences(found.failures, found.runs_per_trial)
    diagnosis = found.diagnosis
    receptions = f"{diagnosis.receptions:,} receptions in {_runs(found.runs_per_trial)}"
    if not diagnosis.clashes:
        yield f"None of {receptions} was lost to another frame."
        return
    ratio = diagnosis.clashes / diagnosis.receptions
    yield f"{diagnosis.clashes:,} of {receptions} were lost to another frame ({ratio:.1%})."
    yield from pattern_sentences(diagnosis, 5)
    if found.jitter_s is None:
        yield f"No jitter was tried: {found.no_trials}."
        return
    named = " and ".join(f'timer "{timer}" of {group}' for group, timer in found.timers)
    without = found.trials[0]
    best = max(found.trials, key=lambda trial: trial.delivery)
    if found.jitter_s == 0:
        least = min(trial.clashes for trial in found.trials)
        yield (
            f"A random delay of {named} does not help: {without.clashes:.1%} of the receptions are lost to"
            f" other frames without it, and still {least:.1%} with the best one ({found.run_count} runs)."
        )
        yield from _trial_failure_sentences(found)
        return
    chosen = next(trial for trial in found.trials if trial.jitter_s == found.jitter_s)
    yield (
        f"Delay {named} by a random time of up to {text_of_time(found.jitter_s)}: {without.delivery:.1%} of"
        f" the receptions arrive without it, {chosen.delivery:.1%} with it, and {best.delivery:.1%} at best"
        f" ({found.run_count} runs)."
    )
    yield from _remaining_sentences(chosen)
    yield from _trial_failure_sentences(found)


def _remaining_sentences(chosen: Trial) -> Iterator[str]:
    """Yield what the recommended jitter does not help against."""
    if 1 - chosen.delivery >= _MUCH:
        outcome = chosen.lost_to.replace("_", " ")
        yield f"Even then, {1 - chosen.delivery:.1%} are lost, most of them to `{outcome}`."


def _trial_failure_sentences(found: Desync) -> Iterator[str]:
    """Yield what failed with jitter, and whether the recommended one changes that."""
    without = len(found.failures)
    chosen = next(trial for trial in found.trials if trial.jitter_s == found.jitter_s)
    if without and found.jitter_s:
        yield f"With it, {len(chosen.failures)} of {_runs(found.runs_per_trial)} fail; without it, {without}."
    first = next((trial for trial in found.trials if trial.failures), None)
    if first is not None and not without:
        index, failure = next(iter(first.failures.items()))
        yield f"With a jitter of up to {text_of_time(first.jitter_s)}, run {index} fails: {failure}."


def _failure_sentences(failures: Mapping[int, Failure], run_count: int) -> Iterator[str]:
    if failures and len(failures) == run_count:
        yield f"All {_runs(run_count)} failed. What is said below is about the time before."
    for index, failure in list(failures.items())[:_MOST_FAILURES]:
        yield f"Run {index} failed: {failure}."
    if len(failures) > _MOST_FAILURES:
        yield f"So did {len(failures) - _MOST_FAILURES} other runs."


def _runs(count: int) -> str:
    return "1 run" if count == 1 else f"{count} runs"


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
