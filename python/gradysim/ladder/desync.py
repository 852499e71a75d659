"""Desynchronization: which timers send into each other, and the jitter that fixes it, found by simulation."""

import tempfile
from collections import Counter
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor, Future
from dataclasses import dataclass, field, replace
from pathlib import Path

from gradysim.integrated.native_protocols import is_native
from gradysim.ladder.campaign import Campaign, submitted
from gradysim.ladder.clashes import LOST_TO_OTHERS, Diagnosis, Pattern, diagnose, merged
from gradysim.ladder.failure import Failure
from gradysim.ladder.jitter import Jitter
from gradysim.ladder.observation import Observation
from gradysim.replay.reader import read_replay

LEAST_GAIN = 0.5
"""Ratio of the receptions lost to other frames that a jitter has to save, or it is not recommended."""

_SUFFICIENT = 0.01
"""Distance to the best delivery ratio that is good enough."""

_LEAST_CLASHES = 0.01
"""Ratio of receptions lost to clashes below which nothing has to be fixed, nor a single pattern."""

_LONGEST_OF_ONE_SHOT = 100
"""Longest jitter of a timer without a period, in durations of a frame."""


@dataclass(frozen=True)
class Trial:
    """Runs with one jitter.

    Attributes:
        jitter_s: The longest delay of the timers; 0 without jitter.
        delivery: Ratio of the receptions within the range that were not lost.
        clashes: Ratio of them that were lost to another frame.
        lost_to: The most frequent outcome of lost receptions; "" if none was lost.
        metric: Mean of the metric over the runs that came to their end; None without one.
        failures: {position of a run that failed: why}.
    """

    jitter_s: float
    delivery: float
    clashes: float = 0.0
    lost_to: str = ""
    metric: float | None = None
    failures: Mapping[int, Failure] = field(default_factory=dict)


@dataclass(frozen=True)
class Desync:
    """Result of the analysis.

    Attributes:
        diagnosis: Clashes in all runs without jitter. Runs that failed count up to their failure.
        timers: (group of nodes, name) of the timers that need jitter; empty if jitter does not help.
        trials: The curve, by jitter; empty without timers.
        jitter_s: The smallest jitter whose delivery is within 1 % of the best; None without timers. 0 if it
            saves less than `LEAST_GAIN` of the receptions that are lost to other frames.
        runs_per_trial: Runs with each jitter.
        no_trials: Why no jitter was tried; "" with trials.
        failures: {position of a run without jitter that failed: why}.
    """

    diagnosis: Diagnosis
    timers: tuple[tuple[str, str], ...] = ()
    trials: tuple[Trial, ...] = ()
    jitter_s: float | None = None
    runs_per_trial: int = 0
    no_trials: str = ""
    failures: Mapping[int, Failure] = field(default_factory=dict)

    @property
    def run_count(self) -> int:
        """Number of all runs."""
        return (1 + len(self.trials)) * self.runs_per_trial


def desynchronize(campaign: Campaign, executor: Executor | None = None, metric: str | None = None) -> Desync:
    """Find the timers of a scenario that clash, and the jitter that they need.

    A run that fails does not end the analysis.

    Args:
        campaign: The configuration. All of its runs are recorded, and each jitter gets all of them.
        executor: Executes the runs, see `Campaign.observations`.
        metric: A quantity to report for each jitter; None for none.

    Raises:
        ConfigError: The runs have no such metric.
    """
    diagnosis, failures = _diagnosed(campaign, executor)
    found = Desync(diagnosis, runs_per_trial=len(campaign), failures=failures)
    fixable = [pattern for pattern in diagnosis.patterns if is_fixable(pattern)]
    if not fixable:
        return replace(found, no_trials="a delay of timers does not help against these clashes")
    least = _LEAST_CLASHES * diagnosis.receptions
    if sum(each.count for each in fixable) < least:
        return replace(found, no_trials=f"timers cost less than {_LEAST_CLASHES:.0%} of the receptions")
    fixable = [pattern for pattern in fixable if pattern.count >= least] or fixable
    timers = tuple(
        dict.fromkeys(
            (origin.group, origin.timer) for each in fixable for origin in each.origins if origin.is_timer
        )
    )
    without = Jitter(frozenset(timers), 0.0)
    nodes = campaign.scenario(campaign.all_effects, 0).nodes
    if any(is_native(spec) and without.timers_of(spec) for spec in nodes):
        return replace(found, no_trials="timers of the engine's own protocols cannot be delayed")
    period_s = max(each.period_s for each in fixable)
    observations = {
        jitter_s: campaign.observations(
            executor,
            campaign.all_effects,
            range(len(campaign)),
            [metric] if metric else [],
            replace(without, longest_s=jitter_s),
        )
        for jitter_s in _jitters(diagnosis.airtime_s, period_s)
    }
    trials = tuple(_trial(jitter_s, list(seen), metric) for jitter_s, seen in observations.items())
    return replace(found, timers=timers, trials=trials, jitter_s=_smallest(trials))


def is_fixable(pattern: Pattern) -> bool:
    """Return whether jitter can help: timers fire together, or come close again and again."""
    return pattern.verdict in ("synchronized", "drifting") and all(each.is_timer for each in pattern.origins)


def _diagnosed(campaign: Campaign, executor: Executor | None) -> tuple[Diagnosis, Mapping[int, Failure]]:
    """Record all runs of a campaign, and return their clashes and failures."""
    futures: list[Future[tuple[Diagnosis, Failure | None]]] = []
    for index in range(len(campaign)):
        campaign.scenario(campaign.all_effects, index)  # processes that are forked have it
        futures.append(submitted(executor, _diagnosis, campaign, index))
    diagnoses: list[Diagnosis] = []
    failures: dict[int, Failure] = {}
    for index, future in enumerate(futures):
        try:
            diagnosis, failure = future.result()
        except Exception as error:  # the process was killed
            failure = Failure.of(error)
        else:
            diagnoses.append(diagnosis)
        if failure is not None:
            failures[index] = failure
    return merged(diagnoses), failures


def _diagnosis(campaign: Campaign, index: int) -> tuple[Diagnosis, Failure | None]:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "run.html")
        failure = campaign.record(campaign.all_effects, index, path).failure
        if failure is not None and not path.stat().st_size:  # before its start
            return merged([]), failure
        return diagnose(read_replay(path)), failure


def _jitters(airtime_s: float, period_s: float) -> Sequence[float]:
    """Return 0, and then jitters from the airtime of a frame to half of the period, each twice the last."""
    jitters = [0.0]
    longest_s = period_s / 2 or _rounded(_LONGEST_OF_ONE_SHOT * airtime_s)
    jitter_s = _rounded(airtime_s)
    while jitter_s < longest_s:
        jitters.append(jitter_s)
        jitter_s = _rounded(2 * jitter_s)
    return [*jitters, longest_s]


def _rounded(seconds: float) -> float:
    """Return a number with two digits."""
    return float(f"{seconds:.1e}")


def _trial(jitter_s: float, seen: Sequence[Observation], metric: str | None) -> Trial:
    receptions = sum(each.receptions for each in seen)
    losses: Counter[str] = Counter()
    for each in seen:
        losses.update(each.losses)
    to_others = sum(losses[outcome] for outcome in LOST_TO_OTHERS)
    values = [each.numbers.get(metric, 0.0) for each in seen if metric and each.failure is None]
    return Trial(
        jitter_s,
        1 - losses.total() / receptions if receptions else 1.0,
        to_others / receptions if receptions else 0.0,
        losses.most_common(1)[0][0] if losses else "",
        sum(values) / len(values) if metric and values else None,
        {index: each.failure for index, each in enumerate(seen) if each.failure is not None},
    )


def _smallest(trials: Sequence[Trial]) -> float:
    """Return the smallest jitter that is good enough, of those with which the fewest runs fail."""
    without = trials[0]
    fewest = min(len(trial.failures) for trial in trials)
    candidates = [trial for trial in trials if len(trial.failures) == fewest]
    best = max(trial.delivery for trial in candidates)
    chosen = next(each for each in candidates if each.delivery >= best * (1 - _SUFFICIENT))
    is_gain = chosen.clashes <= (1 - LEAST_GAIN) * without.clashes
    return chosen.jitter_s if is_gain or len(chosen.failures) < len(without.failures) else 0.0
