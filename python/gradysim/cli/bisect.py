"""`gradysim bisect`: the lowest level of realism at which a protocol fails, and why."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from gradysim.cli.desync import sentences_about_patterns
from gradysim.cli.errors import FAILED, OK, say_mistake
from gradysim.cli.options import DEFAULT_DIR, CampaignOptions, FileArgument, Integer

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from gradysim.ladder.bisect import Bisection, Verdict
    from gradysim.ladder.campaign import Campaign
    from gradysim.ladder.why import Explanation

DEFAULTS = CampaignOptions()


def find_breaking_level(
    file: FileArgument,
    /,
    *,
    assertion: Annotated[
        str,
        Parameter(
            name="--assert",
            help="What the protocol has to achieve, such as `groundStation collected >= 100`.",
        ),
    ],
    confidence: Annotated[float, Parameter(help="Probability that the level is the right one.")] = 0.99,
    max_runs: Annotated[Integer, Parameter(help="Budget of runs.")] = 400,
    result_dir: Annotated[Path, Parameter(help="Directory of the two replays.")] = DEFAULT_DIR,
    options: CampaignOptions = DEFAULTS,
) -> int:
    """Find the lowest level of realism at which a protocol fails, and say why.

    Exit code 0: it works at all levels; 1: it fails at some level.
    """
    from gradysim.cli.campaign import campaign_of, executor_of
    from gradysim.cli.console import console
    from gradysim.ladder.assertion import Assertion
    from gradysim.ladder.bisect import Bisection
    from gradysim.scenario.errors import ConfigError

    try:
        if not 0.5 < confidence < 1:
            raise ConfigError(
                f"--confidence {confidence}: it is out of range; expected 0.5 to 1, such as 0.99"
            )
        campaign = campaign_of(file, options, run_count=max_runs)
        with executor_of(options) as executor:
            bisection = Bisection(
                campaign,
                Assertion.parse(assertion),
                executor,
                confidence=confidence,
                max_runs=max_runs,
                at_once=options.jobs,
            )
            verdict = bisection.find()
            lines = [*_sentences(campaign, bisection, verdict, confidence)]
            if verdict.works is not None and verdict.fails is not None and verdict.seed_place is not None:
                lines += _explained(campaign, verdict, result_dir, executor)
    except (ConfigError, OSError) as mistake:
        return say_mistake(mistake)
    console().print(*lines, sep="\n", markup=False, highlight=False)
    return OK if verdict.fails is None else FAILED


def _sentences(
    campaign: "Campaign", bisection: "Bisection", verdict: "Verdict", confidence: float
) -> Iterator[str]:
    levels = campaign.levels
    if verdict.fails is None:
        yield (
            f"The protocol works at all levels, up to level {len(levels) - 1}, {levels[-1].name}:"
            f" {bisection.at_level(len(levels) - 1)}."
        )
        return
    if verdict.works is None:
        yield f"The protocol already fails at level 0, {levels[0].name}: {bisection.at_level(0)} satisfy it."
        return
    works, fails = levels[verdict.works], levels[verdict.fails]
    if verdict.is_sure:
        yield (
            f"The protocol works up to level {verdict.works}, {works.name}"
            f" ({bisection.at_level(verdict.works)}), and fails from level {verdict.fails}, {fails.name}"
            f" ({bisection.at_level(verdict.fails)}). {verdict.run_count} runs, confidence {confidence:g}."
        )
        yield f"Level {verdict.fails} adds: {fails.adds}."
    else:
        yield (
            f"Undecided: the protocol works at level {verdict.works}, {works.name}, and fails at level"
            f" {verdict.fails}, {fails.name}; the level between them would take more than"
            f" {verdict.run_count} runs (--max-runs)."
        )
    if verdict.smallest:
        yield f"Smallest set of effects that makes it fail: {', '.join(verdict.smallest)}."


def _explained(
    campaign: "Campaign", verdict: "Verdict", result_dir: Path, executor: "Executor"
) -> Iterator[str]:
    from gradysim.ladder.why import explain
    from gradysim.replay.reader import read_replay

    assert verdict.works is not None
    assert verdict.fails is not None
    assert verdict.seed_place is not None
    place = verdict.seed_place
    result_dir.mkdir(parents=True, exist_ok=True)
    files = [
        result_dir / f"{campaign.config}-{campaign.levels[level].name}-#{place}.html"
        for level in (verdict.works, verdict.fails)
    ]
    for level, file in zip((verdict.works, verdict.fails), files, strict=True):
        executor.submit(campaign.record, campaign.effects_up_to(level), place, file).result()
    yield from _reasons(explain(*map(read_replay, files)), verdict.works, verdict.fails)
    yield f"Look at both, run {place}: gradysim view {files[0]} {files[1]}"


def _reasons(explanation: "Explanation", works: int, fails: int) -> Iterator[str]:
    for outcome, (before, after) in list(explanation.losses.items())[:2]:
        if after > before:
            yield (
                f"Receptions lost to `{outcome.replace('_', ' ')}`: {after:.1%} at level {fails},"
                f" {before:.1%} at level {works}."
            )
    yield from sentences_about_patterns(explanation.diagnosis, 2)
    if (first := explanation.first) is not None:
        cause = f" of {first.cause}" if first.cause else ""
        yield (
            f"First difference, at {first.time_s:.6f} s: the frame{cause} from {first.sender} at"
            f" {first.receiver} is {_text_of(first.before)} at level {works} and {_text_of(first.after)} at"
            f" level {fails}."
        )


def _text_of(outcome: str) -> str:
    if outcome in ("", "delivered"):
        return outcome or "not sent, or out of range,"
    return f"lost to `{outcome.replace('_', ' ')}`"
