"""Bisection: the lowest level at which a protocol fails, and the smallest set of effects that makes it fail.

1. Each level gets ten runs, all with the same seeds. So a flaw shows that a higher level hides again.
2. If all of them hold, the rest of the budget searches for a rare failure, half of it at the last level.
3. Otherwise two neighboring levels get pairs of runs on common seeds, where the pairs so far speak most. A
   level fails if the evidence exceeds a bound that all pairs of levels share. So the error rate holds,
   however often the pairs are looked at, and however many levels there are.
4. Effects are left out one by one, as long as the protocol still fails.
"""

from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from itertools import cycle
from typing import Protocol

from gradysim.ladder.assertion import Assertion
from gradysim.ladder.failure import Failure
from gradysim.ladder.jitter import Jitter
from gradysim.ladder.levels import Level
from gradysim.ladder.observation import Observation
from gradysim.ladder.sequential import SequentialTest, evidence_of_pairs
from gradysim.results.confidence_interval import ratio_bounds
from gradysim.scenario.errors import ConfigError

Effects = frozenset[str]

_AT_EACH_LEVEL = 10
"""Runs that each level gets first."""

_AT_ONCE = 4
"""Runs that are submitted before their results are looked at."""


class Runs(Protocol):
    """What a bisection needs of a campaign."""

    @property
    def levels(self) -> Sequence[Level]:
        """The levels of the ladder, the most ideal one first."""

    def __len__(self) -> int:
        """Return the number of runs that each set of effects can have."""

    def effects_up_to(self, level: int) -> Effects:
        """Return the effects of the levels 0 to `level`."""

    def working(self, effects: Effects) -> Effects:
        """Return those of these effects that have what they need."""

    def observations(
        self,
        executor: Executor | None,
        effects: Effects,
        indices: Sequence[int],
        quantities: Sequence[str],
        jitter: Jitter | None = None,
    ) -> Iterator[Observation]:
        """Submit runs, and return an iterator that waits for what they show."""


class _OutOfRunsError(Exception):
    """The budget of runs is used up."""


@dataclass
class Tally:
    """Runs with one set of effects. A run that fails with an exception does not satisfy the assertion.

    Attributes:
        outcomes: Whether the assertion holds, for the runs 0, 1, 2, …
        searched: The same for runs that searched for a rare failure: {index of the run: outcome}.
        failures: Why runs failed: {index of the run: its exception}.
    """

    outcomes: list[bool] = field(default_factory=list)
    searched: dict[int, bool] = field(default_factory=dict)
    failures: dict[int, Failure] = field(default_factory=dict)

    @property
    def run_count(self) -> int:
        """Number of runs."""
        return len(self.outcomes) + len(self.searched)

    @property
    def held(self) -> int:
        """Number of runs in which the assertion holds."""
        return sum(self.outcomes) + sum(self.searched.values())

    @property
    def ratio(self) -> float:
        """Ratio of runs in which the assertion holds; 0 without runs."""
        return self.held / self.run_count if self.run_count else 0.0

    @property
    def failed_run(self) -> int | None:
        """Position of the first run in which the assertion does not hold."""
        failed = [index for index, holds in enumerate(self.outcomes) if not holds]
        return min([*failed, *(index for index, holds in self.searched.items() if not holds)], default=None)

    def most_failures(self, confidence: float) -> float:
        """Return the largest ratio of failing runs that fits to these, with that confidence."""
        return 1 - ratio_bounds(self.held, self.run_count, 1 - confidence)[0] if self.run_count else 1.0

    def __str__(self) -> str:
        return f"{self.held} of {self.run_count} runs"


@dataclass(frozen=True)
class Verdict:
    """Result of a bisection.

    Attributes:
        works: The level below the one at which it fails; None if it fails at level 0, the last level if it
            works at all levels.
        fails: The lowest level at which it fails; None if all runs at all levels hold.
        is_sure: Whether pairs of runs show that these two levels differ. True if it works at all levels or
            fails at level 0.
        smallest: The smallest set of effects that makes it fail, in the order of levels; empty if unknown.
        index: Index of a run that works at the one level and fails at the other, if there is one.
        run_count: Runs that it took.
    """

    works: int | None
    fails: int | None
    is_sure: bool
    smallest: tuple[str, ...] = ()
    index: int | None = None
    run_count: int = 0


class Bisection:
    """Runs a campaign until it is known which level breaks the protocol.

    Attributes:
        campaign: The configuration.
        assertion: What the protocol has to achieve.
        confidence: 1 less the error rate: see `__init__`.
    """

    def __init__(
        self,
        campaign: Runs,
        assertion: Assertion,
        executor: Executor | None = None,
        *,
        confidence: float = 0.95,
        max_runs: int = 400,
    ) -> None:
        """Prepare.

        Args:
            campaign: The configuration. It needs as many runs as the budget.
            assertion: What the protocol has to achieve.
            executor: Executes the runs, see `Campaign.observations`.
            confidence: > 0.5 and < 1. A level that fails as often as the one below it is named with a
                probability of at most 1 - confidence, all levels and looks at the runs together.
            max_runs: Budget of runs, one for each level at least.

        Raises:
            ConfigError: The budget is too small.
        """
        if max_runs < len(campaign.levels):
            raise ConfigError(
                f"a budget of {max_runs} runs is too small",
                expected=f"at least {len(campaign.levels)}, one at each level; ten at each are better",
            )
        self.campaign, self.assertion, self.confidence = campaign, assertion, confidence
        self._executor, self._max_runs = executor, max_runs
        self._tallies: dict[Effects, Tally] = {}

    @property
    def run_count(self) -> int:
        """Number of runs so far."""
        return sum(tally.run_count for tally in self._tallies.values())

    def at_level(self, number: int) -> Tally:
        """Return the runs of a level."""
        return self.with_effects(self.campaign.effects_up_to(number))

    def with_effects(self, effects: Effects) -> Tally:
        """Return the runs with a set of effects. Those that lack what they need have no part in it."""
        return self._tallies.setdefault(self.campaign.working(effects), Tally())

    def find(self) -> Verdict:
        """Return the level at which the protocol breaks. Raises ConfigError for an unknown quantity."""
        levels = range(len(self.campaign.levels))
        first = min(_AT_EACH_LEVEL, self._max_runs // len(levels))
        self._run_all([(self._effects(level), range(first)) for level in levels])
        if self.at_level(0).ratio < 0.5:
            return Verdict(None, 0, True, (), self.at_level(0).failed_run, self.run_count)
        try:
            if all(self.at_level(level).failed_run is None for level in levels):
                self._search()
            fails = self._confirmed()
        except _OutOfRunsError:
            if all(self.at_level(level).failed_run is None for level in levels):
                return Verdict(levels[-1], None, True, run_count=self.run_count)
            fails = self._suspect()
            return Verdict(fails - 1, fails, False, (), self._run_that_differs(fails), self.run_count)
        smallest = self._smallest(fails)
        return Verdict(fails - 1, fails, True, smallest, self._run_that_differs(fails), self.run_count)

    def _effects(self, level: int) -> Effects:
        return self.campaign.effects_up_to(level)

    def _search(self) -> None:
        """Run levels until one run fails, with other seeds than the first ones, and that seed at all levels.

        Every second run is at the last level, since most flaws show there. The pairs that confirm a level
        leave these runs out: a seed that was chosen for its failure would count for that level.
        """
        top = len(self.campaign.levels) - 1
        index = len(self.campaign) - 1
        for level in cycle(range(1, top)) if top > 1 else cycle([top]):
            indices = range(index, index - _AT_ONCE, -1)
            index -= _AT_ONCE
            self._run_searching([(top, indices), (level, indices)] if level != top else [(top, indices)])
            failed = self._failed_in_search()
            if failed is not None:
                self._run_searching([(each, [failed]) for each in range(top + 1)])
                return

    def _failed_in_search(self) -> int | None:
        for level in range(len(self.campaign.levels)):
            for index, holds in self.at_level(level).searched.items():
                if not holds:
                    return index
        return None

    def _confirmed(self) -> int:
        """Return the lowest level that is shown to fail. Runs pairs of the most suspect one until one is."""
        bound = (len(self.campaign.levels) - 1) / (1 - self.confidence)
        while True:
            for level in range(1, len(self.campaign.levels)):
                if evidence_of_pairs(*self._pairs(level)) >= bound:
                    return level
            suspect = self._suspect()
            count = min(len(self.at_level(level).outcomes) for level in (suspect - 1, suspect)) + _AT_ONCE
            self._run_all([(self._effects(level), range(count)) for level in (suspect - 1, suspect)])

    def _pairs(self, level: int) -> tuple[int, int]:
        """Return the runs that hold below a level only, and those that hold at it only, of common seeds."""
        pairs = list(zip(self.at_level(level - 1).outcomes, self.at_level(level).outcomes, strict=False))
        return pairs.count((True, False)), pairs.count((False, True))

    def _suspect(self) -> int:
        """Return the level for whose failure the pairs speak most; without pairs, the one that fails most."""

        def suspicion(level: int) -> tuple[float, float, float, int]:
            below, here = self.at_level(level - 1), self.at_level(level)
            found = any(
                holds and not here.searched.get(index, True) for index, holds in below.searched.items()
            )
            return evidence_of_pairs(*self._pairs(level)), found, below.ratio - here.ratio, -level

        return max(range(1, len(self.campaign.levels)), key=suspicion)

    def _smallest(self, fails: int) -> tuple[str, ...]:
        """Return a set of effects that makes the protocol fail, each of which it needs.

        Effects are few, so each is tried alone. Channel access comes last: without it nodes send whatever
        others do, so that more frames collide, and a flaw of hidden nodes would not need their range.

        Source of the method: A. Zeller and R. Hildebrandt, "Simplifying and isolating failure-inducing
        input", IEEE Trans. on Software Engineering 28, 2002.
        """
        needed = self.campaign.working(self._effects(fails))
        high, low = self.at_level(fails - 1).ratio, self.at_level(fails).ratio
        try:
            levels = reversed(self.campaign.levels[1 : fails + 1])
            for level in sorted(levels, key=lambda level: level.name == "access"):
                without = self.campaign.working(needed - {level.name})
                if level.name in needed and not self._works(without, high, low):
                    needed = without
        except _OutOfRunsError:
            return ()
        return tuple(level.name for level in self.campaign.levels[1:] if level.name in needed)

    def _works(self, effects: Effects, high: float, low: float) -> bool:
        """Return whether the protocol works in `high` of the runs with these effects, and not in `low`."""
        test = SequentialTest(high, low, (1 - self.confidence) / len(self.campaign.levels))
        tally = self.with_effects(effects)
        test.add(tally.outcomes)
        while test.works is None:
            known = len(tally.outcomes)
            self._run_all([(effects, range(known + _AT_ONCE))])
            test.add(tally.outcomes[known:])
        return test.works

    def _run_that_differs(self, fails: int) -> int | None:
        """Return a run that works below a level and not at it."""
        below, here = self.at_level(fails - 1), self.at_level(fails)
        pairs = enumerate(zip(below.outcomes, here.outcomes, strict=False))
        in_search = (
            (index, (holds, here.searched.get(index, True))) for index, holds in below.searched.items()
        )
        return next((index for index, (one, other) in [*pairs, *in_search] if one and not other), None)

    def _run_all(self, wanted: Sequence[tuple[Effects, range]]) -> None:
        """Execute the runs with these effects that have not been done, up to the end of each range."""
        missing = [
            (effects, range(len(self.with_effects(effects).outcomes), indices.stop))
            for effects, indices in wanted
        ]
        self._check_budget([indices for _, indices in missing])
        for effects, indices, seen in self._submitted(missing):
            tally = self.with_effects(effects)
            for index, each in zip(indices, seen, strict=True):
                tally.outcomes.append(self._holds(tally, index, each))

    def _run_searching(self, wanted: Sequence[tuple[int, Sequence[int]]]) -> None:
        """Execute these runs at these levels, unless that has been done."""
        missing = [
            (self._effects(level), [index for index in indices if index not in self.at_level(level).searched])
            for level, indices in wanted
        ]
        self._check_budget([indices for _, indices in missing])
        for effects, indices, seen in self._submitted(missing):
            tally = self.with_effects(effects)
            for index, each in zip(indices, seen, strict=True):
                tally.searched[index] = self._holds(tally, index, each)

    def _check_budget(self, missing: Sequence[Sequence[int]]) -> None:
        last = max((index for indices in missing for index in indices), default=0)
        if self.run_count + sum(map(len, missing)) > self._max_runs or last >= len(self.campaign):
            raise _OutOfRunsError

    def _submitted(
        self, wanted: Sequence[tuple[Effects, Sequence[int]]]
    ) -> Iterator[tuple[Effects, Sequence[int], Iterator[Observation]]]:
        """Submit all of these runs, and yield what they show."""
        quantities = self.assertion.quantities
        submitted = [
            self.campaign.observations(self._executor, effects, indices, quantities)
            for effects, indices in wanted
        ]
        for (effects, indices), seen in zip(wanted, submitted, strict=True):
            yield effects, indices, seen

    def _holds(self, tally: Tally, index: int, seen: Observation) -> bool:
        if seen.failure is not None:
            tally.failures[index] = seen.failure
            return False
        return self.assertion.holds(seen.numbers)
