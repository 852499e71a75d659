"""The runs of a configuration with any set of effects, on common seeds."""

import contextlib
import io
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor, Future
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import gradysim.integrated.run  # noqa: F401 (before processes are forked)
from gradysim.ladder.jitter import Jitter
from gradysim.ladder.levels import LEVELS, Level, added_sections, levels_of, settings_without
from gradysim.ladder.reach import power_settings, range_settings
from gradysim.replay.sink import ReplayWriter
from gradysim.results.outcomes import Outcomes
from gradysim.results.run_summary import RunSummary
from gradysim.scenario.errors import OF_SCRIPT, ArgumentNames, ConfigError, nearest
from gradysim.scenario.ini import read_ini
from gradysim.scenario.load import Study
from gradysim.scenario.scenario import Scenario
from gradysim.stepping import start

Effects = frozenset[str]
"""Names of the levels whose effects a run has."""

_FIRST_WITH_RADIOS = "interference"
_NOT_LOST = {"delivered", "below_sensitivity", "in_air"}
"""Outcomes of receptions that are not losses, or that are out of range."""

LOST_MESSAGES = ("queue_overflow", "retry_limit", "channel_access_failure")
"""Outcomes of messages that their sender gave up."""


class FailedRunError(Exception):
    """A run failed: a protocol raised an exception."""


@dataclass(frozen=True)
class Observation:
    """What one run showed.

    Attributes:
        value: The metric; None if the run failed.
        losses: {outcome: receptions lost} of frames at their addressees.
        receptions: Receptions within the range.
        messages: {outcome: messages}.
        failure: Why the run failed: the exception of a protocol, or the end of its process.
        quantities: Names of all quantities of the run.
        binary: Whether the metric is 0 or 1, see `RunSummary.is_binary`.
    """

    value: float | None
    losses: Mapping[str, int] = field(default_factory=dict)
    receptions: int = 0
    messages: Mapping[str, int] = field(default_factory=dict)
    failure: str = ""
    quantities: tuple[str, ...] = ()
    binary: bool = False


class Campaign:
    """A configuration whose effects can be left out.

    Attributes:
        levels: The levels of the ladder that the scenario has.
        config: Name of the configuration.
    """

    def __init__(
        self,
        file: str | Path,
        config: str = "General",
        *,
        settings: Iterable[str] = (),
        run_count: int | None = None,
        seed: int | None = None,
        names: ArgumentNames = OF_SCRIPT,
    ) -> None:
        """Read the configuration.

        Args:
            file: The .ini file.
            config: Name of the configuration in it.
            settings: "KEY=VALUE" strings that precede the file.
            run_count: Repetitions of each combination of values; None for the `repeat` of the file.
            seed: Seed of run 0; run N adds N. None for the seed-set of the file.
            names: Names of these arguments in messages.

        Raises:
            ConfigError: Anything is wrong with the file or the settings.
        """
        self._file, self.config, self._seed, self._names = Path(file), config, seed, names
        self._settings = [*([] if run_count is None else [f"repeat={run_count}"]), *settings]
        self._studies: dict[object, Study] = {}
        self._quantities: set[str] = set()
        self._fixed: dict[tuple[int, int], tuple[list[str], list[str], Scenario]] = {}
        self._full = self._study((), ())
        self.levels: tuple[Level, ...] = levels_of(self._full[0], read_ini(self._file).levels)

    def __len__(self) -> int:
        """Return the number of runs at each level."""
        return len(self._full)

    def effects_up_to(self, level: int) -> Effects:
        """Return the effects of the levels 0 to `level`."""
        return frozenset(each.name for each in self.levels[: level + 1])

    @cached_property
    def all_effects(self) -> Effects:
        """The effects of all levels."""
        return self.effects_up_to(len(self.levels) - 1)

    def scenario(self, effects: Effects, place: int) -> Scenario:
        """Return the scenario of the run at position `place` with these effects. Raises ConfigError."""
        powers, ranges = self._fixed_settings(place)
        left_out = settings_without(self.all_effects - effects, self.levels)
        return self._study([*powers, *left_out, *ranges], added_sections(effects, self.levels))[place]

    def observations(
        self,
        executor: Executor | None,
        effects: Effects,
        places: Iterable[int],
        metric: str,
        jitter: Jitter | None = None,
    ) -> Iterator[Observation]:
        """Submit runs with these effects, and return an iterator that waits for what they show.

        Processes that the executor forks have the scenarios loaded. Calls that are passed to the executor
        cannot be pickled. Without an executor, they are executed in this process. Raises ConfigError if the
        runs have no such metric.
        """
        futures: list[Future[Observation]] = []
        for place in places:
            self.scenario(effects, place)
            if executor is not None:
                futures.append(executor.submit(self.observe, effects, place, metric, jitter))
            else:
                futures.append(Future())
                futures[-1].set_result(self.observe(effects, place, metric, jitter))
        return self._results(futures, metric)

    def _results(self, futures: Sequence[Future[Observation]], metric: str) -> Iterator[Observation]:
        for future in futures:
            try:
                seen = future.result()
            except Exception as failure:  # the process was killed
                seen = Observation(None, failure=str(failure))
            self._quantities.update(seen.quantities)
            if seen.quantities and metric not in self._quantities:
                raise ConfigError(
                    f"no quantity is called `{metric}`",
                    expected=f"one of {', '.join(f'`{name}`' for name in sorted(self._quantities))}",
                    suggestion=nearest(metric, self._quantities),
                )
            yield seen

    def record(self, effects: Effects, place: int, path: Path) -> Mapping[str, int]:
        """Write the replay of the run at a position with these effects, and return {outcome: messages}.

        Raises what protocols raise.
        """
        recorder = ReplayWriter(path)
        with (
            contextlib.redirect_stdout(io.StringIO()),
            start(self.scenario(effects, place), replay=recorder) as run,
        ):
            run.run_until()
        return _messages(run.result().fates)

    def observe(self, effects: Effects, place: int, metric: str, jitter: Jitter | None = None) -> Observation:
        """Run the scenario at a position with these effects, and return what it showed.

        What protocols print is discarded. A quantity that the run does not have counts as 0, such as a
        tracked variable that no node has set.
        """
        scenario = self.scenario(effects, place)
        try:
            with contextlib.redirect_stdout(io.StringIO()), start(scenario) as run:
                if jitter is not None:
                    jitter.add_to(run, scenario)
                run.run_until()
        except Exception as failure:
            return Observation(None, failure=f"{type(failure).__name__}: {failure}")
        result = run.result()
        summary = RunSummary.of(result.to_json_object())
        losses, receptions = _losses(result.fates)
        messages = _messages(result.fates)
        value = summary.numbers.get(metric, 0.0)
        quantities, binary = summary.conditions.quantities, summary.is_binary(metric)
        return Observation(value, losses, receptions, messages, quantities=quantities, binary=binary)

    def _study(self, settings: Sequence[str], levels: Collection[str]) -> Study:
        key = (*settings, *levels)
        if key not in self._studies:
            self._studies[key] = Study(
                self._file,
                self.config,
                None,
                [*settings, *self._settings],
                self._seed,
                self._names,
                levels=tuple(levels),
            )
        return self._studies[key]

    def _fixed_settings(self, place: int) -> tuple[list[str], list[str]]:
        """Return the settings that all levels of a run share: of powers and of ranges."""
        scenario = self._full[place]
        key = (id(scenario.nodes), id(scenario.medium))
        if key not in self._fixed:
            powers = power_settings(scenario)
            ranges: list[str] = []
            if powers:
                at = next(i for i, level in enumerate(LEVELS) if level.name == _FIRST_WITH_RADIOS)
                noiseless = settings_without([level.name for level in LEVELS[at + 1 :]], self.levels)
                ranges = range_settings(self._study([*powers, *noiseless], ())[place])
            self._fixed[key] = (powers, ranges, scenario)  # the scenario keeps the ids from being used again
        return self._fixed[key][:2]


def _losses(outcomes: Outcomes) -> tuple[dict[str, int], int]:
    """Return the lost receptions by outcome, and the number of receptions within the range."""
    losses: dict[str, int] = {}
    receptions = 0
    for kind, counts in outcomes["frames"].items():
        if kind.endswith("overheard"):
            continue
        receptions += sum(counts.values()) - counts.get("below_sensitivity", 0)
        for outcome, count in counts.items():
            if outcome not in _NOT_LOST and count:
                losses[outcome] = losses.get(outcome, 0) + count
    return losses, receptions


def _messages(outcomes: Outcomes) -> dict[str, int]:
    """Return the number of messages by outcome, of all kinds."""
    messages: dict[str, int] = {}
    for counts in outcomes["messages"].values():
        for outcome, count in counts.items():
            messages[outcome] = messages.get(outcome, 0) + count
    return messages
