"""Bisection: the lowest level at which a protocol fails, and the smallest set of effects that makes it fail.

The two ends are calibrated first. Each level between them gets a sequential test: does the protocol work as
at the ideal end, or as at the real one? The result is confirmed by pairs of runs of the two levels on common
seeds.
"""

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field

from gradysim.ladder.assertion import Assertion
from gradysim.ladder.campaign import Campaign, Effects
from gradysim.ladder.sequential import SequentialTest, probability_of_pairs
from gradysim.scenario.errors import ConfigError

_AT_ENDS = 10
"""Runs that calibrate each end."""

_AT_ONCE = 4
"""Runs that are submitted before their results are looked at."""

_LEAST_DIFFERENCE = 0.3
"""Least difference of the ratios at the two ends. Smaller ones take too many runs to be located."""


class _OutOfRunsError(Exception):
    """The budget of runs is used up."""


@dataclass
class Tally:
    """Runs with one set of effects. A run that fails with an exception does not satisfy the assertion.

    Attributes:
        outcomes: Whether the assertion holds, by the position of the run.
        exceptions: Those of the runs that fail with one.
    """

    outcomes: list[bool] = field(default_factory=list)
    exceptions: list[str] = field(default_factory=list)

    @property
    def ratio(self) -> float:
        """Ratio of runs in which the assertion holds; 0 without runs."""
        return sum(self.outcomes) / len(self.outcomes) if self.outcomes else 0.0

    def __str__(self) -> str:
        return f"{sum(self.outcomes)} of {len(self.outcomes)} runs"


@dataclass(frozen=True)
class Verdict:
    """Result of a bisection.

    Attributes:
        works: The highest level at which the protocol works; None if it fails at all levels.
        fails: The lowest level at which it fails; None if it works at all levels.
        is_sure: Whether the two levels are next to each other, and pairs of runs confirm the difference.
        smallest: The smallest set of effects that makes it fail, in the order of levels; empty if unknown.
        place: Position of a run that works at the one level and fails at the other, if there is one.
        run_count: Runs that it took.
    """

    works: int | None
    fails: int | None
    is_sure: bool
    smallest: tuple[str, ...] = ()
    place: int | None = None
    run_count: int = 0


class Bisection:
    """Runs a campaign until it is known which level breaks the protocol.

    Attributes:
        campaign: The configuration.
        confidence: Probability that the level is the right one.
    """

    def __init__(
        self,
        campaign: Campaign,
        assertion: Assertion,
        executor: Executor | None = None,
        *,
        confidence: float = 0.99,
        max_runs: int = 400,
    ) -> None:
        """Prepare.

        Args:
            campaign: The configuration. It needs as many runs as one level may take: 100 are enough.
            assertion: What the protocol has to achieve.
            executor: Executes the runs, see `Campaign.observations`.
            confidence: Probability that the level is the right one, > 0.5 and < 1.
            max_runs: Budget of runs, at least 20.

        Raises:
            ConfigError: The budget is too small.
        """
        if max_runs < 2 * _AT_ENDS:
            raise ConfigError(
                f"a budget of {max_runs} runs is too small",
                expected=f"at least {2 * _AT_ENDS}: {_AT_ENDS} at each end of the ladder",
            )
        self.campaign, self.confidence = campaign, confidence
        self._assertion, self._executor, self._max_runs = assertion, executor, max_runs
        self._tallies: dict[Effects, Tally] = {}
        self._high, self._low = 1.0, 0.0

    @property
    def run_count(self) -> int:
        """Number of runs so far."""
        return sum(len(tally.outcomes) for tally in self._tallies.values())

    def at_level(self, number: int) -> Tally:
        """Return the runs of a level."""
        return self.with_effects(self.campaign.effects_up_to(number))

    def with_effects(self, effects: Effects) -> Tally:
        """Return the runs with a set of effects."""
        return self._tallies.setdefault(effects, Tally())

    def find(self) -> Verdict:
        """Return the level at which the protocol breaks. Raises what its runs raise."""
        top = len(self.campaign.levels) - 1
        self._run(self._effects(0), _AT_ENDS)
        self._run(self._effects(top), _AT_ENDS)
        self._high, self._low = self.at_level(0).ratio, self.at_level(top).ratio
        if self._high < 0.5:
            return Verdict(None, 0, True, run_count=self.run_count)
        if self._low == 1 or self._low >= self._high:
            return Verdict(top, None, True, run_count=self.run_count)
        if self._high - self._low < _LEAST_DIFFERENCE:
            return Verdict(0, top, False, (), self._run_that_differs(0, top), self.run_count)
        works, fails = 0, top
        try:
            while fails - works > 1:
                middle = (works + fails) // 2
                if self._works(self._effects(middle)):
                    works = middle
                else:
                    fails = middle
            is_sure = self._confirm(works, fails)
        except _OutOfRunsError:
            return Verdict(works, fails, False, (), self._run_that_differs(works, fails), self.run_count)
        smallest = self._smallest(fails)
        return Verdict(works, fails, is_sure, smallest, self._run_that_differs(works, fails), self.run_count)

    def _effects(self, level: int) -> Effects:
        return self.campaign.effects_up_to(level)

    def _works(self, effects: Effects) -> bool:
        """Return whether the protocol works with these effects as at the ideal end, by a sequential test."""
        test = SequentialTest(self._high, self._low, (1 - self.confidence) / 5)
        tally = self.with_effects(effects)
        test.add(tally.outcomes)
        while test.works is None:
            known = len(tally.outcomes)
            self._run(effects, known + _AT_ONCE)
            test.add(tally.outcomes[known:])
        return test.works

    def _confirm(self, works: int, fails: int) -> bool:
        """Return whether pairs of runs on common seeds show that the two levels differ."""
        high, low = self._effects(works), self._effects(fails)
        count = max(len(self.with_effects(each).outcomes) for each in (high, low))
        while True:
            self._run(high, count)
            self._run(low, count)
            pairs = list(zip(self.with_effects(high).outcomes, self.with_effects(low).outcomes, strict=False))
            better, worse = pairs.count((True, False)), pairs.count((False, True))
            if probability_of_pairs(better, worse) < 1 - self.confidence:
                return True
            count += _AT_ONCE

    def _smallest(self, fails: int) -> tuple[str, ...]:
        """Return a set of effects that makes the protocol fail, none of which can be left out.

        Effects are few, so each is tried alone. Source of the method: A. Zeller and R. Hildebrandt,
        "Simplifying and isolating failure-inducing input", IEEE Trans. on Software Engineering 28, 2002.
        """
        needed = self._effects(fails)
        try:
            for level in reversed(self.campaign.levels[1 : fails + 1]):
                if not self._works(needed - {level.name}):
                    needed -= {level.name}
        except _OutOfRunsError:
            return ()
        return tuple(level.name for level in self.campaign.levels[1:] if level.name in needed)

    def _run_that_differs(self, works: int, fails: int) -> int | None:
        outcomes = zip(self.at_level(works).outcomes, self.at_level(fails).outcomes, strict=False)
        return next((place for place, (one, other) in enumerate(outcomes) if one and not other), None)

    def _run(self, effects: Effects, count: int) -> None:
        """Execute the first `count` runs with these effects, unless that has been done."""
        tally = self.with_effects(effects)
        missing: Sequence[int] = range(len(tally.outcomes), count)
        if count > len(self.campaign) or self.run_count + len(missing) > self._max_runs:
            raise _OutOfRunsError
        metric = self._assertion.metric
        for seen in self.campaign.observations(self._executor, effects, missing, metric):
            tally.outcomes.append(seen.value is not None and self._assertion.holds(seen.value))
            tally.exceptions += [seen.failure] if seen.failure else []
