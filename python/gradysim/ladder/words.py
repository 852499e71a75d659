"""Which level breaks a protocol, in sentences."""

from collections.abc import Iterator

from gradysim.ladder.bisect import Bisection, Verdict


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
