"""Reads a configuration of a file as scenarios, one for each run."""

from array import array
from collections.abc import Iterable, Mapping, Sequence, Set
from pathlib import Path
from typing import Any, overload

from gradysim.notebook import html_table
from gradysim.scenario.build.coverage import Coverage
from gradysim.scenario.build.networks import Networks
from gradysim.scenario.errors import OF_SCRIPT, ArgumentNames, ConfigError, ErrorCollector
from gradysim.scenario.parse.ini import Entry, read_ini, read_overrides
from gradysim.scenario.parse.sections import (
    check_not_abstract,
    entries_in_order,
    search_order,
    what_to_run_instead,
)
from gradysim.scenario.resolve.runs import (
    NumberedRun,
    UnreadVariables,
    check_seeds_of_runs,
    entries_of_the_hash,
    numbered_runs,
    seed_of_file,
    settings_hash,
    whole_seed,
)
from gradysim.scenario.resolve.sweep import (
    REPETITION,
    depends_on_run,
    free_text,
    is_free_text_in_all_runs,
    name_iterations,
    run_variables,
    substitute,
    substituted,
    text_of_iterations,
    variables_in,
    with_labels,
)
from gradysim.scenario.resolve.unknown_keys import NoSuchNodeError
from gradysim.scenario.scenario import Scenario
from gradysim.scenario.schema.options import (
    OPTIONS,
    check_option,
    is_ignored,
    is_option,
    network_name,
    options_in_force,
)
from gradysim.scenario.schema.parameter_types import Scalar
from gradysim.scenario.schema.values import read_scalar

_READ_IN_EACH_RUN = ("sim-time-limit", "vector-record-interval", "description")
"""Options that are fields of a Scenario."""

_CHECKED_IN_FULL = 100
"""Networks of a study that are read and built before its first run, all combinations of values."""

_MOST_CHECKED = 300
"""Networks that are read before the first run if each has a value that no other one has."""

_MOST_FAILED = 20
"""Combinations of iteration variables with errors, after which reading stops."""


def load_scenarios(
    file: str | Path,
    config: str = "General",
    runs: str | Iterable[int] | None = None,
    overrides: Iterable[str] = (),
    seed: int | None = None,
    *,
    names: ArgumentNames = OF_SCRIPT,
) -> list[Scenario]:
    """Read a configuration and check all of it.

    Args:
        file: The .ini file.
        config: Name of the configuration in it.
        runs: Numbers of the wanted runs, or a string such as "0,2,5..9"; None for all.
        overrides: "KEY=VALUE" strings that precede the whole file; of several that match, the first is used.
        seed: Seed of run 0; run N adds N. Each is 0 to 2^63 - 1. None for the seed-set of the file.
        names: Names of these arguments in messages.

    Returns:
        One scenario per run, by run number.

    Raises:
        ConfigError: Anything is wrong. Several errors are a ConfigErrors, whose `errors` are sorted by line.
        TypeError: An argument has the wrong type.
    """
    return list(Study(file, config, runs, overrides, seed, names))


class Study(Sequence[Scenario]):
    """The wanted runs of a configuration, checked. A scenario is made when it is asked for.

    The first `_CHECKED_IN_FULL` networks are checked in full, and then those with new values. Beyond
    `_MOST_CHECKED` networks, values are checked separately. Making a scenario that was not checked in full
    raises ConfigError for its errors.

    Attributes:
        config: Name of the configuration.
        numbers: Numbers of the runs.
        seeds: Seeds of the runs.
    """

    def __init__(
        self,
        file: str | Path,
        config: str,
        runs: str | Iterable[int] | None,
        overrides: Iterable[str],
        seed: int | None,
        names: ArgumentNames,
        part: slice = slice(None),
        levels: Sequence[str] = (),
    ) -> None:
        """Read and check it; arguments and exceptions are those of `load_scenarios`.

        Of the wanted runs, only those at the positions `part` are read, which may be none. `levels` are names
        of sections `[Level NAME]`, whose lines precede those of the configuration.
        """
        if not isinstance(config, str):
            raise TypeError(f"{names.config} {config!r}: expected the name of a configuration")
        self._seed = None if seed is None else whole_seed(seed)
        self.config = config
        self._file = file = Path(file)
        ini = read_ini(file)
        self._sections = tuple(search_order(ini, config, levels))
        check_not_abstract(ini, config)
        self._source = source = ini.sections[config].source
        written = lines = entries_in_order(read_overrides(file, overrides, names.overrides), self._sections)
        errors = ErrorCollector()
        for entry in lines:
            if is_option(entry):
                with errors.collecting():
                    check_option(entry)
        self._network = Scenario.network  # the default
        try:
            self._network = network_name(lines)
            lines, variables = name_iterations(lines)
            self._options = options_in_force(lines)
            self._runs = numbered_runs(self._options, variables, config, runs, source, names.runs, part)
            if self._seed is not None and self._runs:
                check_seeds_of_runs(self._seed, self._runs.numbers[-1], names.seed)
        except ConfigError as error:
            errors.add(error)
            errors.errors += self._errors_of_others(written, errors.errors, file.parent)
            raise errors.combined() from None
        self._lines = tuple(lines)
        read = [line for line in lines if not is_ignored(line)]
        self._names = set[str]().union(*(variables_in(line.text) for line in read))
        self._differing = {
            name: option
            for name in _READ_IN_EACH_RUN
            if (option := self._options.get(name)) is not None
            and depends_on_run(option)
            and not (name == "description" and is_free_text_in_all_runs(option, variables))
        }
        self._hashed = entries_of_the_hash(lines)
        self._hashes: dict[tuple[str, ...], str] = {}
        instead = what_to_run_instead(ini, config, self._sections, names.config)
        self._networks = Networks(lines, file.parent, instead, source)
        self._coverage = Coverage(lines, self._options, self._differing.values(), variables, self._runs)
        self._checked: list[int] = []
        self._unread: tuple[UnreadVariables, ...] = ()
        self.numbers = self._runs.numbers
        self.seeds = self._seeds(errors)
        self._check(errors)
        errors.raise_all()
        if len(self._runs) == self._runs.run_count and len(self._checked) < _MOST_CHECKED:
            self._networks.check_lines_of_other_runs()
            self._unread = self._networks.unread(variables)

    def _errors_of_others(
        self, lines: Sequence[Entry], known: Sequence[ConfigError], folder: Path
    ) -> list[ConfigError]:
        """Return the errors in the values of lines without an error, as if the other lines were not there.

        Nodes may be missing without the other lines. Errors about missing nodes are left out.
        """
        wrong = {error.source for error in known}
        others = [line for line in lines if line.source not in wrong]
        found = ErrorCollector()
        has_runs = False
        with found.collecting():
            entries, variables = name_iterations(others)
            self._options = options_in_force(entries)
            (run,) = numbered_runs(self._options, variables, self.config, [0], self._source, "")
            values, has_runs = self._variables(run, None), True
            with found.collecting():
                self._settings(values)
            Networks(entries, folder, "", self._source).check((), values, 0)
        of_lines = {line.source for line in others}
        more = [
            error
            for error in found.errors
            if error.source in of_lines and not isinstance(error, NoSuchNodeError)
        ]
        if more and not has_runs:
            more += self._errors_of_others(lines, [*known, *more], folder)
        return more

    def _check(self, errors: ErrorCollector) -> None:
        failed: set[tuple[str, ...]] = set()
        for index in range(len(self._runs)):
            is_new = self._coverage.adds_a_value(index)
            if not is_new and len(self._checked) >= _CHECKED_IN_FULL:
                continue
            network = self._coverage.network_of(index)
            is_checked = self._networks.is_checked(network, self.seeds[index])
            if is_checked and not is_new:
                continue
            run = self._runs[index]
            key = tuple(run.iterations.values())
            if key in failed:
                continue
            if len(failed) == _MOST_FAILED:
                return
            error_count = len(errors.errors)
            with errors.collecting():
                values = self._variables(run, self.seeds[index], self._names)
                with errors.collecting():
                    if index == 0:
                        self._settings(values)
                    else:
                        for name in self._differing:
                            self._option(name, values)
                if len(self._checked) >= _MOST_CHECKED:
                    self._networks.check_values(values)
                elif not is_checked:
                    self._networks.check(network, values, self.seeds[index])
                    self._checked.append(index)
            if len(errors.errors) > error_count:
                failed.add(key)

    def __len__(self) -> int:
        return len(self._runs)

    @overload
    def __getitem__(self, index: int) -> Scenario: ...

    @overload
    def __getitem__(self, index: slice) -> list[Scenario]: ...

    def __getitem__(self, index: int | slice) -> Scenario | list[Scenario]:
        if isinstance(index, slice):
            return [self[each] for each in range(len(self))[index]]
        index = range(len(self))[index]
        run, seed = self._runs[index], self.seeds[index]
        variables = self._variables(run, seed)
        return Scenario(
            file=self._file,
            config=self.config,
            run_number=run.number,
            seed=seed,
            **self._settings(variables),
            **self._networks.of_run(self._coverage.network_of(index), variables, seed),
            sections=self._sections,
            repetition=run.repetition,
            iterations=run.iterations,
            settings_hash=self._hash(run, seed),
            run_count=self._runs.run_count,
            network=self._network,
            lines=self._lines,
            unread_variables=self._unread,
        )

    def __repr__(self) -> str:
        return f"<{len(self)} runs of {self.config} in {self._file}>"

    def _repr_html_(self) -> str:
        """Return the runs as a table, for notebooks."""
        names = list(dict.fromkeys(name for run in self._runs for name in run.iterations))
        return html_table(
            f"{self._file.name}, {self.config}: {len(self)} runs",
            ("run", *names, "repetition", "seed"),
            [
                (run.number, *(run.iterations.get(name, "") for name in names), run.repetition, seed)
                for run, seed in zip(self._runs, self.seeds, strict=True)
            ],
        )

    def checked_in_full(self) -> list[Scenario]:
        """Return the scenarios whose networks were checked: at least the first one.

        Each node of the study, and each line in force, is in one of them, unless there are too many.
        """
        return [self[index] for index in self._checked]

    def has_equal_runs(self) -> bool:
        """Return whether runs share a seed, all else being equal."""
        if isinstance(self.seeds, range):
            return False
        runs = {(seed, *run.iterations.values()) for seed, run in zip(self.seeds, self._runs, strict=True)}
        return len(runs) < len(self._runs)

    def width_of_iterations(self) -> int:
        """Return the width of the longest `$x=1, $speed=5 #0` of a run."""
        return max(
            len(f"{text_of_iterations(run.iterations)} #{run.repetition}".lstrip()) for run in self._runs
        )

    def indices_of_repetitions(self) -> list[list[int]]:
        """Return the positions of the runs of each combination of values, in the order of repetitions."""
        found: dict[tuple[str, ...], list[tuple[int, int]]] = {}
        for index, run in enumerate(self._runs):
            found.setdefault(tuple(run.iterations.values()), []).append((run.repetition, index))
        return [[index for _, index in sorted(alike)] for alike in found.values()]

    def _seeds(self, errors: ErrorCollector) -> Sequence[int]:
        """Return the seeds of all runs; `errors` takes what is wrong with those of the file."""
        entry, numbers = self._options.get("seed-set"), self._runs.numbers
        of_file: Sequence[int] = numbers
        if entry is not None and entry.text == "${runnumber}":  # the default
            entry = None
        if entry is not None and not depends_on_run(entry):
            with errors.collecting():
                of_file = [seed_of_file(entry, {})] * len(numbers)
        elif entry is not None:
            seeds, names = array("q"), variables_in(entry.text)
            count = len(errors.errors)
            for run in self._runs:
                with errors.collecting():
                    seeds.append(seed_of_file(entry, self._variables(run, None, names)))
                if len(errors.errors) - count == _MOST_FAILED:
                    break
            of_file = seeds if len(seeds) == len(numbers) else numbers
        if self._seed is None:
            return of_file
        if isinstance(numbers, range):
            return range(self._seed + numbers.start, self._seed + numbers.stop, numbers.step)
        return [self._seed + number for number in numbers]

    def _variables(self, run: NumberedRun, seed: int | None, names: Set[str] | None = None) -> dict[str, str]:
        """Return the variables of a run, at least those called `names`; without a seed, not its labels."""
        plain = {**run.iterations, "runnumber": str(run.number), REPETITION: str(run.repetition)}
        if names is not None and names <= plain.keys():
            return plain  # ten times faster
        values = run_variables(self._file, self._network, self.config, *run)
        return values if seed is None else with_labels(values, seed, self._options)

    def _settings(self, variables: Mapping[str, str]) -> dict[str, Any]:
        """Return the fields of a Scenario that are options. Raises ConfigError."""
        limit, interval, description = (self._option(name, variables) for name in _READ_IN_EACH_RUN)
        if limit is None:
            problem = f"`{self.config}` has no time limit"
            raise ConfigError(problem, self._source, expected="`sim-time-limit = 1h`")
        return {
            "sim_time_limit_s": float(limit),
            "vector_record_interval_s": float(interval or 0.0),
            "description": description or "",
        }

    def _option(self, name: str, variables: Mapping[str, str]) -> Scalar | None:
        """Return the value of an option; None without it. Raises ConfigError."""
        if name not in self._options:
            return None
        entry = substitute(self._options[name], variables)
        return free_text(entry) if name == "description" else read_scalar(entry, OPTIONS[name])

    def _hash(self, run: NumberedRun, seed: int) -> str:
        """Return the hash of the settings of a run: no more of it is in the hash than its iterations."""
        key = tuple(run.iterations.values())
        if key not in self._hashes:
            values = run_variables(self._file, self._network, self.config, *run)
            values = with_labels(values, seed, self._options, for_hash=True)
            self._hashes[key] = settings_hash(substituted(self._hashed, values))
        return self._hashes[key]


def runs_of(
    file: str | Path, config: str, overrides: Iterable[str] = (), *, names: ArgumentNames = OF_SCRIPT
) -> Sequence[tuple[int, int, Mapping[str, Any]]]:
    """Return number, repetition and values of iterations of each run of a configuration.

    It needs neither nodes nor a time limit, and checks neither. The configuration may be abstract. Raises
    ConfigError.
    """
    sections = tuple(search_order(read_ini(Path(file)), config))
    overridden = read_overrides(Path(file), overrides, names.overrides)
    lines, variables = name_iterations(entries_in_order(overridden, sections))
    as_written = options_in_force(lines)
    return numbered_runs(as_written, variables, config, None, sections[0].source, names.runs)
