"""The ladder itself: a metric at each level, and its change from the level before."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass

from gradysim.ladder.campaign import Campaign
from gradysim.ladder.failure import Failure
from gradysim.ladder.levels import Level
from gradysim.ladder.observation import LOST_MESSAGES, Observation
from gradysim.results.confidence_interval import Estimate, estimate
from gradysim.results.paired import compare_pairs

_SMALLEST_RATIO = 0.0005
"""Losses below it are not named: they would have 0.0 %."""


@dataclass(frozen=True)
class Rung:
    """One level of a ladder.

    Attributes:
        number: 0 for the most ideal level.
        level: What it adds.
        metric: Mean over the runs that came to their end, with its interval; None if all of them failed.
        change: From the level before, paired by seed; None at the first level that was run, and without
            pairs.
        failures: Why runs failed: {index of the run: its exception}.
        loss: The most frequent outcome of lost receptions or messages; "" below 0.05 %.
        loss_ratio: Its share of the receptions within the range, or of the messages.
    """

    number: int
    level: Level
    metric: Estimate | None
    change: Estimate | None
    loss: str
    loss_ratio: float
    failures: Mapping[int, Failure]


def climb(campaign: Campaign, metric: str, levels: range, executor: Executor | None = None) -> Iterator[Rung]:
    """Yield the levels of a campaign, from the most ideal one to the most real one.

    Runs at different levels have the same seeds, so that the interval of a change is narrow.

    Args:
        campaign: The configuration.
        metric: Name of a quantity, as `gradysim means` prints it.
        levels: Their numbers, in increasing order.
        executor: Executes the runs, see `Campaign.observations`.

    Raises:
        ConfigError: The runs have no such metric.
    """
    submitted = {
        number: campaign.observations(
            executor, campaign.effects_up_to(number), range(len(campaign)), [metric]
        )
        for number in levels
    }
    before: Sequence[float | None] = ()
    binary = True  # as long as it is 0 or 1 in all runs
    for number, observations in submitted.items():
        seen = list(observations)
        values = [None if each.failure else each.numbers.get(metric, 0.0) for each in seen]
        pairs = [(one, other) for one, other in zip(before, values, strict=False) if None not in (one, other)]
        known = [value for value in values if value is not None]
        binary = binary and all(metric in each.binary or metric not in each.numbers for each in seen)
        loss, ratio = _most_frequent_loss(seen)
        yield Rung(
            number,
            campaign.levels[number],
            estimate(known, binary=binary) if known else None,
            compare_pairs(*zip(*pairs, strict=True), binary=binary).difference if pairs else None,
            loss,
            ratio,
            {index: each.failure for index, each in enumerate(seen) if each.failure is not None},
        )
        before = values


def largest_drop(rungs: Sequence[Rung]) -> Rung | None:
    """Return the rung that decreases the metric by the largest ratio, if there is one.

    The interval of its change does not contain 0.
    """
    ratios = [
        (rung.change.mean / (rung.metric.mean - rung.change.mean), number)
        for number, rung in enumerate(rungs)
        if rung.metric is not None
        and rung.change is not None
        and rung.change.mean < 0
        and rung.change.excludes_zero
    ]
    return rungs[min(ratios)[1]] if ratios else None


def _most_frequent_loss(seen: Sequence[Observation]) -> tuple[str, float]:
    """Return the loss with the largest ratio: of the receptions, or of the messages."""
    losses: Counter[str] = Counter()
    messages: Counter[str] = Counter()
    for each in seen:
        losses.update(each.losses)
        messages.update(each.messages)
    receptions = max(1, sum(each.receptions for each in seen))
    message_count = max(1, messages.total())
    ratios = {outcome: count / receptions for outcome, count in losses.items()}
    ratios |= {outcome: messages[outcome] / message_count for outcome in LOST_MESSAGES if messages[outcome]}
    most = max(ratios.items(), key=lambda item: item[1], default=("", 0.0))
    return most if most[1] >= _SMALLEST_RATIO else ("", 0.0)
