"""The runs of a configuration with any set of effects, on common seeds."""

import contextlib
import io
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from concurrent.futures import Executor, Future
from functools import cached_property, partial
from pathlib import Path
from typing import Any, TypeVar

import gradysim.integrated.run  # noqa: F401 (before processes are forked)
from gradysim.ladder.callbacks import CallbackLog
from gradysim.ladder.failure import Failure
from gradysim.ladder.jitter import Jitter
from gradysim.ladder.kept_runs import KeptRuns
from gradysim.ladder.levels import LEVELS, Level, added_sections, levels_of, settings_of, working
from gradysim.ladder.observation import Observation, losses_of, messages_of
from gradysim.ladder.reach import power_settings, range_settings
from gradysim.replay.sink import ReplayWriter
from gradysim.results.run_summary import RunSummary
from gradysim.scenario.errors import OF_SCRIPT, ArgumentNames, unknown_name
from gradysim.scenario.load import Study
from gradysim.scenario.parse.ini import read_ini
from gradysim.scenario.scenario import Scenario
from gradysim.stepping import start

Effects = frozenset[str]
"""Names of the levels whose effects a run has."""

_Result = TypeVar("_Result")

_LAST_WITHOUT_NOISE = "interference"

_MOST_NUMBERS = 500
"""Of a run that are passed between processes and kept: what a process returns has to fit into a pipe."""


def submitted(executor: Executor | None, call: Callable[..., _Result], *arguments: Any) -> Future[_Result]:
    """Submit a call. Without an executor, this process executes it at once."""
    if executor is not None:
        return executor.submit(call, *arguments)
    future: Future[_Result] = Future()
    future.set_result(call(*arguments))
    return future


class Campaign:
    """A configuration whose effects can be left out.

    Attributes:
        levels: The levels of the ladder that the scenario has.
        config: Name of the configuration.
        run_count: Runs that were executed.
        kept_count: Runs that were found among those that are kept.
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
        kept: KeptRuns | None = None,
    ) -> None:
        """Read the configuration.

        Args:
            file: The .ini file.
            config: Name of the configuration in it.
            settings: "KEY=VALUE" strings that precede the file.
            run_count: Repetitions of each combination of values; None for the `repeat` of the file.
            seed: Seed of run 0; run N adds N. None for the seed-set of the file.
            names: Names of these arguments in messages.
            kept: Where runs are kept, and found; None to keep none.

        Raises:
            ConfigError: Anything is wrong with the file or the settings.
        """
        self._file, self.config, self._seed, self._names = Path(file), config, seed, names
        self._settings = [*([] if run_count is None else [f"repeat={run_count}"]), *settings]
        self._studies: dict[object, Study] = {}
        self._kept = kept
        self._quantities: set[str] = set()
        self.run_count = self.kept_count = 0
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

    def working(self, effects: Effects) -> Effects:
        """Return those of these effects that have what they need: collisions need airtime."""
        return working(effects, self.levels)

    def scenario(self, effects: Effects, index: int) -> Scenario:
        """Return the scenario of the run at `index` with these effects. Raises ConfigError."""
        powers, ranges = self._fixed_settings(index)
        left_out = settings_of(effects, self.levels)
        return self._study([*powers, *left_out, *ranges], added_sections(effects, self.levels))[index]

    def observations(
        self,
        executor: Executor | None,
        effects: Effects,
        indices: Iterable[int],
        quantities: Collection[str] = (),
        jitter: Jitter | None = None,
    ) -> Iterator[Observation]:
        """Submit runs with these effects, and return an iterator that waits for what they show.

        Processes that the executor forks have the scenarios loaded. Calls that are passed to the executor
        cannot be pickled. Without an executor, they are executed in this process.

        Args:
            executor: Executes the runs.
            effects: Names of levels.
            indices: Indices of the runs.
            quantities: Names that the runs must have.
            jitter: A delay of timers.

        Raises:
            ConfigError: No run has a quantity of that name.
        """
        futures: list[Future[Observation]] = []
        for index in indices:
            scenario = self.scenario(effects, index)
            seen = None if self._kept is None else self._kept.find(scenario, jitter, quantities)
            if seen is None:
                future = submitted(executor, self.observe, effects, index, jitter, quantities)
                future.add_done_callback(partial(self._done, scenario, jitter))
            else:
                future = Future()
                future.set_result(seen)
                self.kept_count += 1
            futures.append(future)
        return self._results(futures, quantities)

    def _done(self, scenario: Scenario, jitter: Jitter | None, future: Future[Observation]) -> None:
        """Keep what a run showed, as soon as it has ended."""
        if future.cancelled() or future.exception() is not None:
            return
        self.run_count += 1
        if self._kept is not None:
            self._kept.add(scenario, jitter, future.result())

    def _results(
        self, futures: Sequence[Future[Observation]], quantities: Collection[str]
    ) -> Iterator[Observation]:
        known = self._quantities
        for future in futures:
            try:
                seen = future.result()
            except Exception as failure:  # the process was killed
                seen = Observation(failure=Failure.of(failure))
            known.update(seen.numbers)
            unknown = next((name for name in quantities if name not in known), None)
            if seen.numbers and unknown is not None:
                raise unknown_name(f"no quantity is called `{unknown}`", unknown, sorted(known))
            yield seen

    def record(self, effects: Effects, index: int, path: Path, log: CallbackLog | None = None) -> Observation:
        """Write the replay of the run at a position with these effects, and return what it showed.

        If the run fails, the replay and the log of its callbacks end there. Raises OSError.
        """
        return self.observe(effects, index, replay=path, log=log)

    def observe(
        self,
        effects: Effects,
        index: int,
        jitter: Jitter | None = None,
        quantities: Collection[str] = (),
        *,
        replay: Path | None = None,
        log: CallbackLog | None = None,
    ) -> Observation:
        """Run the scenario at a position with these effects, and return what it showed.

        What protocols print is discarded. With `replay`, the replay of the run is written there; otherwise
        the run is faster. `log` gets the callbacks.
        """
        scenario = self.scenario(effects, index)
        failure = run = None
        options: dict[str, Any] = {} if replay is None else {"replay": ReplayWriter(replay)}
        try:
            with contextlib.redirect_stdout(io.StringIO()), start(scenario, **options) as run:
                if jitter is not None:
                    jitter.add_to(run, scenario)
                if log is not None:
                    log.watch(run, scenario)
                run.run_until()
        except OSError as error:
            if replay is not None and error.filename == str(replay):
                raise
            failure = Failure.of(error)
        except Exception as error:
            failure = Failure.of(error)
        if run is None:
            return Observation(failure=failure)
        result = run.result()
        losses, receptions = losses_of(result.outcomes)
        messages = messages_of(result.outcomes)
        if failure is not None:
            return Observation({}, losses, receptions, messages, failure)
        summary = RunSummary.of(result.to_json_object())
        numbers = summary.numbers
        has_all = len(numbers) <= _MOST_NUMBERS
        if not has_all:
            numbers = {name: numbers[name] for name in quantities if name in numbers}
        binary = tuple(filter(summary.is_binary, numbers))
        return Observation(numbers, losses, receptions, messages, binary=binary, has_all=has_all)

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

    def _fixed_settings(self, index: int) -> tuple[list[str], list[str]]:
        """Return the settings that all levels of a run share: of powers and of ranges."""
        scenario = self._full[index]
        key = (id(scenario.nodes), id(scenario.medium))
        if key not in self._fixed:
            powers = power_settings(scenario)
            ranges: list[str] = []
            if powers:
                names = [level.name for level in LEVELS]
                noiseless = settings_of(names[: names.index(_LAST_WITHOUT_NOISE) + 1], self.levels)
                ranges = range_settings(self._study([*powers, *noiseless], ())[index])
            self._fixed[key] = (powers, ranges, scenario)  # the scenario keeps the ids from being used again
        return self._fixed[key][:2]
