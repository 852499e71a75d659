"""Which level breaks a protocol, in sentences."""

from collections.abc import Iterator

from gradysim.ladder.bisect import Bisection, Tally, Verdict


def verdict_sentences(bisection: Bisection, verdict: Verdict) -> Iterator[str]:
    """Yield where the protocol breaks, and why runs ended with an exception."""
    levels = bisection.campaign.levels
    top = len(levels) - 1
    if verdict.fails is None:
        yield (
            f"The protocol works at all {len(levels)} levels, in all of {verdict.run_count} runs. At the last"
            f" level, {top} {levels[top].name}, it fails in at most {_bound(bisection, top)} of the seeds"
            f" (confidence {bisection.confidence:g})."
        )
        return
    if verdict.works is None:
        yield (
            f"The protocol already fails at level 0, {levels[0].name}: the assertion holds in"
            f" {bisection.at_level(0)}."
        )
        yield from _levels_that_work(bisection, 0)
    else:
        yield _location(bisection, verdict)
        if verdict.is_sure:
            yield f"Level {verdict.fails} adds: {levels[verdict.fails].adds}."
        yield from _levels_that_work(bisection, verdict.fails)
    yield from _exception_sentences(bisection)
    if verdict.smallest:
        yield f"Smallest set of effects that makes it fail: {', '.join(verdict.smallest)}."
    elif verdict.is_sure and verdict.works is not None:
        yield (
            "The smallest set of effects takes more runs than the budget has left"
            f" ({verdict.run_count} of --max-runs are used)."
        )


def _location(bisection: Bisection, verdict: Verdict) -> str:
    assert verdict.works is not None
    assert verdict.fails is not None
    levels = bisection.campaign.levels
    works, fails = levels[verdict.works], levels[verdict.fails]
    below, here = bisection.at_level(verdict.works), bisection.at_level(verdict.fails)
    if verdict.is_sure:
        return (
            f"The protocol works up to level {verdict.works}, {works.name} ({below}), and fails from level"
            f" {verdict.fails}, {fails.name} (it works in {here}). {verdict.run_count} runs, confidence"
            f" {bisection.confidence:g}."
        )
    return (
        f"Undecided after {verdict.run_count} runs, since failures are too rare to be located: the protocol"
        f" works at level {verdict.works}, {works.name}, in {below}, and at level {verdict.fails},"
        f" {fails.name}, in {here}. More runs (--max-runs) may decide."
    )


def _levels_that_work(bisection: Bisection, fails: int) -> Iterator[str]:
    """Yield the levels above one that fails at which all runs hold."""
    levels = bisection.campaign.levels
    works = [level for level in range(fails + 1, len(levels)) if bisection.at_level(level).failed_run is None]
    if works:
        named = ", ".join(f"{level} {levels[level].name} ({bisection.at_level(level)})" for level in works)
        yield f"The assertion holds again at {'level' if len(works) == 1 else 'levels'} {named}."


def _exception_sentences(bisection: Bisection) -> Iterator[str]:
    """Yield the first exception of the lowest level at which runs ended with one."""
    for number, level in enumerate(bisection.campaign.levels):
        tally = bisection.at_level(number)
        if tally.failures:
            index, failure = min(tally.failures.items())
            yield (
                f"{_count(tally)} at level {number}, {level.name}, with an exception. Run {index}: {failure}."
            )
            return


def _count(tally: Tally) -> str:
    count = len(tally.failures)
    return "1 run ends" if count == 1 else f"{count} runs end"


def _bound(bisection: Bisection, level: int) -> str:
    return f"{bisection.at_level(level).most_failures(bisection.confidence):.1%}"
