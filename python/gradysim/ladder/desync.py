"""Desynchronization: which timers send into each other, and the jitter that fixes it, found by simulation."""

import tempfile
from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from gradysim.integrated.native_protocols import is_native
from gradysim.ladder.campaign import Campaign
from gradysim.ladder.clashes import Diagnosis, Pattern, diagnose
from gradysim.ladder.jitter import Jitter
from gradysim.ladder.observation import Observation
from gradysim.replay.reader import read_replay

_SUFFICIENT = 0.01
"""Distance to the best delivery ratio that is good enough."""

_LEAST_CLASHES = 0.01
"""Ratio of receptions lost to clashes below which nothing has to be fixed."""


@dataclass(frozen=True)
class Trial:
    """Runs with one jitter.

    Attributes:
        jitter_s: The longest delay of the timers; 0 without jitter.
        delivery: Ratio of the receptions within the range that were not lost.
        metric: Mean of the metric over the runs; None without one.
    """

    jitter_s: float
    delivery: float
    metric: float | None


@dataclass(frozen=True)
class Desync:
    """Result of the analysis.

    Attributes:
        diagnosis: Clashes in the first run.
        timers: (group of nodes, name) of the timers that need jitter; empty if jitter does not help.
        trials: The curve, by jitter; empty without timers.
        jitter_s: The smallest jitter whose delivery is within 1 % of the best; None without timers.
        runs_per_trial: Runs with each jitter.
        no_trials: Why no jitter was tried; "" with trials.
    """

    diagnosis: Diagnosis
    timers: tuple[tuple[str, str], ...] = ()
    trials: tuple[Trial, ...] = ()
    jitter_s: float | None = None
    runs_per_trial: int = 0
    no_trials: str = ""

    @property
    def run_count(self) -> int:
        """Number of all runs."""
        return 1 + len(self.trials) * self.runs_per_trial


def desynchronize(campaign: Campaign, executor: Executor | None = None, metric: str | None = None) -> Desync:
    """Find the timers of a scenario that clash, and the jitter that they need.

    Args:
        campaign: The configuration; each jitter gets all of its runs.
        executor: Executes the runs, see `Campaign.observations`.
        metric: A quantity to report for each jitter; None for none.

    Raises:
        ConfigError: The runs have no such metric.
        RuntimeError: A run with jitter failed.
        Exception: What protocols raise in the first run.
    """
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "run.html")
        record = partial(campaign.record, campaign.all_effects, 0, path)
        if executor is None:
            record()
        else:
            executor.submit(record).result()
        diagnosis = diagnose(read_replay(path))
    fixable = [pattern for pattern in diagnosis.patterns if is_fixable(pattern)]
    if not fixable:
        return Desync(diagnosis, no_trials="a delay of timers does not help against these clashes")
    if sum(each.count for each in fixable) < _LEAST_CLASHES * diagnosis.receptions:
        return Desync(diagnosis, no_trials=f"timers cost less than {_LEAST_CLASHES:.0%} of the receptions")
    timers = tuple(
        dict.fromkeys(
            (origin.group, origin.timer) for each in fixable for origin in each.origins if origin.is_timer
        )
    )
    without = Jitter(frozenset(timers), 0.0)
    nodes = campaign.scenario(campaign.all_effects, 0).nodes
    if any(is_native(spec) and without.timers_of(spec) for spec in nodes):
        return Desync(diagnosis, no_trials="timers of the engine's own protocols cannot be delayed")
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
    best = max(trial.delivery for trial in trials)
    smallest = next(each.jitter_s for each in trials if each.delivery >= best * (1 - _SUFFICIENT))
    return Desync(diagnosis, timers, trials, smallest, len(campaign))


def is_fixable(pattern: Pattern) -> bool:
    """Return whether jitter can help: timers fire together, or come close again and again."""
    return pattern.verdict in ("synchronized", "drifting") and all(each.is_timer for each in pattern.origins)


def _jitters(airtime_s: float, period_s: float) -> Sequence[float]:
    """Return 0, and then jitters from the airtime of a frame to half of the period, each twice the last."""
    jitters = [0.0]
    jitter_s = _rounded(airtime_s)
    while jitter_s < period_s / 2:
        jitters.append(jitter_s)
        jitter_s = _rounded(2 * jitter_s)
    return [*jitters, period_s / 2]


def _rounded(seconds: float) -> float:
    """Return a number with two digits."""
    return float(f"{seconds:.1e}")


def _trial(jitter_s: float, seen: Sequence[Observation], metric: str | None) -> Trial:
    for place, each in enumerate(seen):
        if each.failure:
            raise RuntimeError(f"jitter of {jitter_s:g} s, run {place}: {each.failure}")
    receptions = sum(each.receptions for each in seen)
    lost = sum(sum(each.losses.values()) for each in seen)
    values = [each.numbers.get(metric, 0.0) for each in seen] if metric else []
    return Trial(
        jitter_s,
        1 - lost / receptions if receptions else 1.0,
        sum(values) / len(values) if metric and values else None,
    )
