"""`gradysim bisect`: the lowest level of realism at which a protocol fails, and why."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from gradysim.cli.errors import FAILED, OK, say_mistake
from gradysim.cli.options import DEFAULT_DIR, CampaignOptions, FileArgument, Integer

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from gradysim.ladder.bisect import Verdict
    from gradysim.ladder.campaign import Campaign

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
    from gradysim.ladder.words import verdict_sentences
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
            )
            verdict = bisection.find()
            lines = [*verdict_sentences(bisection, verdict)]
            if verdict.place is not None:
                lines += _explained(campaign, verdict, result_dir, executor)
    except (ConfigError, OSError) as mistake:
        return say_mistake(mistake)
    console().print(*lines, sep="\n", markup=False, highlight=False)
    return OK if verdict.fails is None else FAILED


def _explained(
    campaign: "Campaign", verdict: "Verdict", result_dir: Path, executor: "Executor"
) -> Iterator[str]:
    from gradysim.ladder.explanation_words import explanation_sentences
    from gradysim.ladder.why import record_and_explain

    place, works, fails = verdict.place, verdict.works, verdict.fails
    assert place is not None
    assert works is not None
    assert fails is not None
    result_dir.mkdir(parents=True, exist_ok=True)
    one, other = (
        result_dir / f"{campaign.config}-{campaign.levels[level].name}-#{place}.html"
        for level in (works, fails)
    )
    effects = (campaign.effects_up_to(works), campaign.effects_up_to(fails))
    explanation = record_and_explain(campaign, effects, place, (one, other), executor)
    yield from explanation_sentences(explanation, works, fails)
    yield f"Look at both, run {place}: gradysim view {one} {other}"
