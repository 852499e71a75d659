"""The ladder itself: a metric at each level, and its change from the level before."""

from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass

from gradysim.ladder.campaign import Campaign, Observation
from gradysim.ladder.levels import Level
from gradysim.results.paired import Estimate, compare_pairs, estimate


@dataclass(frozen=True)
class Rung:
    """One level of a ladder.

    Attributes:
        number: 0 for the most ideal level.
        level: What it adds.
        metric: Mean over the runs, with its interval.
        change: From the level before, paired by seed; None at the first level that was run.
        loss: The most frequent outcome of lost receptions, or "".
        loss_ratio: Its share of the receptions within the range.
    """

    number: int
    level: Level
    metric: Estimate
    change: Estimate | None
    loss: str
    loss_ratio: float


def climb(campaign: Campaign, metric: str, levels: range, executor: Executor) -> Iterator[Rung]:
    """Yield the levels of a campaign, from the most ideal one to the most real one.

    Runs at different levels have the same seeds, so that the interval of a change is narrow.

    Args:
        campaign: The configuration.
        metric: Name of a quantity, as `gradysim means` prints it.
        levels: Their numbers, in increasing order.
        executor: Executes the runs, see `Campaign.submit`.

    Raises:
        ConfigError: The runs have no such metric.
        Exception: What protocols raise.
    """
    submitted = {
        number: campaign.submit(executor, campaign.effects_up_to(number), range(len(campaign)), metric)
        for number in levels
    }
    before: Sequence[float] = ()
    for number, futures in submitted.items():
        seen = [each.result() for each in futures]
        values = [each.value for each in seen]
        loss, ratio = _most_frequent_loss(seen)
        yield Rung(
            number,
            campaign.levels[number],
            estimate(values),
            compare_pairs(before, values).difference if before else None,
            loss,
            ratio,
        )
        before = values


def largest_drop(rungs: Sequence[Rung]) -> Rung | None:
    """Return the rung with the largest decrease of the metric whose interval excludes 0, if there is one."""
    drops = [each for each in rungs if each.change is not None and _is_drop(each.change)]
    return min(drops, key=lambda rung: rung.change.mean if rung.change else 0.0, default=None)


def _is_drop(change: Estimate) -> bool:
    return change.mean < 0 and (change.half_width is None or change.excludes_zero)


def _most_frequent_loss(seen: Sequence[Observation]) -> tuple[str, float]:
    losses: Counter[str] = Counter()
    for each in seen:
        losses.update(each.losses)
    receptions = sum(each.receptions for each in seen)
    if not losses or not receptions:
        return "", 0.0
    outcome, count = losses.most_common(1)[0]
    return outcome, count / receptions
