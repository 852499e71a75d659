"""`gradysim bisect`: the lowest level of realism at which a protocol fails, and why."""

from collections.abc import Mapping
from concurrent.futures import Executor
from dataclasses import asdict
from typing import Annotated, Any

from cyclopts import Parameter

from gradysim.cli.campaign import campaign_of, print_json
from gradysim.cli.console import console
from gradysim.cli.errors import FAILED, OK, report_error
from gradysim.cli.options import DEFAULT_DIR, CampaignOptions, FileArgument, Integer
from gradysim.ladder.assertion import Assertion
from gradysim.ladder.bisect import Bisection, Verdict
from gradysim.ladder.campaign import Campaign
from gradysim.ladder.explanation_words import explanation_sentences
from gradysim.ladder.why import Explanation, record_and_explain
from gradysim.ladder.words import verdict_sentences
from gradysim.scenario.errors import ConfigError

DEFAULTS = CampaignOptions()


def find_breaking_level(
    file: FileArgument,
    /,
    *,
    assertion: Annotated[
        str,
        Parameter(
            name="--assert",
            help="What the protocol has to achieve, such as `groundStation collected >= 100` or `base heard"
            " >= 0.95 * uavs[*] sent`; `and` and `or` join several.",
        ),
    ],
    confidence: Annotated[
        float,
        Parameter(
            help="1 less the error rate: how rarely a level is named that does not differ from the one below."
        ),
    ] = 0.95,
    max_runs: Annotated[Integer, Parameter(help="Budget of runs; all of it is used if none fails.")] = 400,
    options: CampaignOptions = DEFAULTS,
) -> int:
    """Carry out `gradysim bisect`, and return the exit code."""
    try:
        if not 0.5 < confidence < 1:
            raise ConfigError(
                f"--confidence {confidence}: it is out of range; expected 0.5 to 1, such as 0.95"
            )
        wanted = Assertion.parse(assertion)
        with campaign_of(file, options, run_count=max_runs) as (campaign, executor):
            bisection = Bisection(campaign, wanted, executor, confidence=confidence, max_runs=max_runs)
            verdict = bisection.find()
            terminal = console()
            if not options.as_json:  # at once: the explanation may take a while
                terminal.print(
                    *verdict_sentences(bisection, verdict), sep="\n", markup=False, highlight=False
                )
            explained = _explained(campaign, verdict, options, executor)
    except (ConfigError, OSError) as error:
        return report_error(error)
    if options.as_json:
        print_json(verdict_json(bisection, verdict, explained))
    elif explained is not None:
        explanation, files = explained
        assert verdict.works is not None
        assert verdict.fails is not None
        lines = explanation_sentences(explanation, verdict.works, verdict.fails)
        look = f"Look at both, run {verdict.index}: gradysim view {' '.join(files)}"
        terminal.print(*lines, look, sep="\n", markup=False, highlight=False)
    return OK if verdict.fails is None else FAILED


def _explained(
    campaign: Campaign, verdict: Verdict, options: CampaignOptions, executor: Executor
) -> tuple[Explanation, list[str]] | None:
    """Record a run that works at the one level and fails at the other, and compare the two."""
    index, works, fails = verdict.index, verdict.works, verdict.fails
    if index is None or works is None or fails is None:
        return None
    directory = options.result_dir or DEFAULT_DIR
    directory.mkdir(parents=True, exist_ok=True)
    one, other = (
        directory / f"{campaign.config}-{campaign.levels[level].name}-#{index}.html"
        for level in (works, fails)
    )
    effects = (campaign.effects_up_to(works), campaign.effects_up_to(fails))
    explanation = record_and_explain(campaign, effects, index, (one, other), executor)
    return explanation, [str(one), str(other)]


def verdict_json(
    bisection: Bisection, verdict: Verdict, explained: tuple[Explanation, list[str]] | None
) -> dict[str, Any]:
    """Return the verdict, the runs of each level and the explanation for other programs."""
    levels = bisection.campaign.levels
    plain: dict[str, Any] = {
        "assertion": bisection.assertion.text,
        "holds": verdict.fails is None,
        "works": None if verdict.works is None else levels[verdict.works].name,
        "fails": None if verdict.fails is None else levels[verdict.fails].name,
        "is_sure": verdict.is_sure,
        "confidence": bisection.confidence,
        "smallest": verdict.smallest,
        "run": verdict.index,
        "runs": verdict.run_count,
        "levels": [_level_json(bisection, number) for number in range(len(levels))],
    }
    if explained is not None:
        explanation, files = explained
        plain["first_difference"] = None if explanation.first is None else asdict(explanation.first)
        for name, ratios in (("receptions", explanation.losses), ("messages", explanation.messages)):
            plain[f"lost_{name}"] = {
                outcome: {"works": one, "fails": other} for outcome, (one, other) in ratios.items()
            }
        plain["replays"] = files
    return plain


def _level_json(bisection: Bisection, number: int) -> Mapping[str, object]:
    tally = bisection.at_level(number)
    return {
        "level": bisection.campaign.levels[number].name,
        "runs": tally.run_count,
        "held": tally.held,
        "fails_at_most": tally.most_failures(bisection.confidence),
        "exceptions": [{"run": index} | asdict(each) for index, each in sorted(tally.failures.items())],
    }
