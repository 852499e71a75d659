"""Runs of a configuration: their numbers and seeds, and hashes that show whether two runs are the same."""

import hashlib
import os
import re
from array import array
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from operator import index
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple, overload

from gradysim.scenario.errors import OF_SCRIPT, ConfigError, Source
from gradysim.scenario.parse.ini import Entry
from gradysim.scenario.resolve.combinations import (
    Combinations,
    Constraint,
    check_lock_step,
    count_combinations,
    in_nesting_order,
)
from gradysim.scenario.resolve.resolution import Resolution
from gradysim.scenario.resolve.sweep import (
    LABEL_OPTIONS,
    MAX_VALUES,
    REPETITION,
    IterationVariable,
    substitute,
)
from gradysim.scenario.schema.options import LARGEST_SEED, NETWORK, OPTIONS, is_ignored, is_option
from gradysim.scenario.schema.values import read_scalar

HASH_DIGITS = 16
"""Hexadecimal digits of a hash, as many as a fingerprint has."""

OF_NO_RUN = (
    "repeat",
    "constraint",
    "iteration-nesting-order",
    "description",
    NETWORK,
    "extends",
    "abstract",
    *LABEL_OPTIONS,
)
"""Options that determine the runs, or that do not change the events of a run."""

_MOST_NAMES = 3
"""Names of files that a message lists."""

_RANGE_OF_RUNS = re.compile(r"\s*(\d{1,9})\s*(?:(?:\.\.|-)\s*(\d{1,9})\s*)?", re.ASCII)
_NAMES = re.compile(r"\$\{(\w+)\}", re.ASCII)
_OF_ALL = {"iterationvars", "iterationvarsf", "iterationvarsd", "experiment", "measurement", "replication"}
"""Variables that may contain the values of others."""


class NumberedRun(NamedTuple):
    """One run: its number, its repetition, and the values of the iteration variables by name."""

    number: int
    repetition: int
    iterations: dict[str, str]


class NumberedRuns(Sequence[NumberedRun]):
    """Runs of a configuration by number. Each is made when it is asked for.

    Attributes:
        numbers: Their numbers, which increase.
        run_count: The number of all runs, wanted or not.
        combinations: The combinations of values and repetitions that `indices` count.
        indices: The index of each run among all combinations.
    """

    def __init__(
        self, numbers: Sequence[int], run_count: int, combinations: Combinations, indices: Sequence[int]
    ) -> None:
        self.numbers = numbers
        self.run_count = run_count
        self.combinations = combinations
        self.indices = indices

    def __len__(self) -> int:
        return len(self.numbers)

    @overload
    def __getitem__(self, index: int) -> NumberedRun: ...

    @overload
    def __getitem__(self, index: slice) -> "NumberedRuns": ...

    def __getitem__(self, index: int | slice) -> "NumberedRun | NumberedRuns":
        if isinstance(index, slice):
            return NumberedRuns(self.numbers[index], self.run_count, self.combinations, self.indices[index])
        values = self.combinations[self.indices[index]]
        return NumberedRun(self.numbers[index], int(values.pop(REPETITION)), values)


def numbered_runs(
    options: Mapping[str, Entry],
    variables: Sequence[IterationVariable],
    config: str,
    runs: str | Iterable[int] | None,
    source: Source,
    name: str,
    part: slice = slice(None),
) -> NumberedRuns:
    """Return the runs that are wanted, or a part of them.

    All runs are the combinations of values that the constraint leaves, each repeated. Repetitions are values
    of one more variable, the innermost one unless `iteration-nesting-order` says otherwise. `source` is the
    source of the configuration, and `name` what messages about `runs` begin with. Raises ConfigError if there
    are too few runs or too many, and what `select_runs` raises.
    """
    repetitions = _repetitions(options.get("repeat"), source)
    nested = in_nesting_order([*variables, repetitions], options.get("iteration-nesting-order"))
    check_lock_step(nested)
    repeat, combined = len(repetitions.values), count_combinations(variables)
    if combined * repeat > MAX_VALUES:
        raise ConfigError(
            f"configuration `{config}` has {combined} combinations of values and {repeat} runs of each;"
            f" expected at most {MAX_VALUES} runs",
            repetitions.source,
        )
    combinations = Combinations(nested)
    allowed: Sequence[int] = range(len(combinations))
    made_of = f"{combined} combinations of values, `repeat = {repeat}`" if variables else ""
    if entry := options.get("constraint"):
        constraint = Constraint(entry)
        allowed = array("l", (index for index, values in enumerate(combinations) if constraint.holds(values)))
        made_of = f"what the constraint leaves of {made_of}" if made_of else ""
        if not allowed:
            problem = f"none of {combined} combinations of values is left; expected one at least"
            raise ConfigError.at(constraint.source, problem)
    numbers = select_runs(runs, len(allowed), config, repetitions.source, made_of, name)[part]
    indices = allowed if len(numbers) == len(allowed) else [allowed[number] for number in numbers]
    return NumberedRuns(numbers, len(allowed), combinations, indices)


def _repetitions(repeat: Entry | None, source: Source) -> IterationVariable:
    """The variable `repetition`. Raises ConfigError if the option is not a number."""
    if repeat is None:
        return IterationVariable(REPETITION, ("0",), source)
    if "${" in repeat.text:
        raise ConfigError.at(repeat.source, "it is the same for all combinations; expected a number")
    count = int(read_scalar(repeat, OPTIONS["repeat"]))
    return IterationVariable(REPETITION, tuple(map(str, range(count))), repeat.source)


def select_runs(
    runs: str | Iterable[int] | None,
    count: int,
    config: str,
    source: Source,
    made_of: str = "",
    name: str = OF_SCRIPT.runs,
) -> Sequence[int]:
    """Return run numbers such as "0,2,5..9" in increasing order, each once; 0 to count-1 for None.

    `source` is where `count` comes from, and `made_of` says how, if `repeat` alone does not. `name` is what
    messages about `runs` begin with.

    Raises:
        ConfigError: The string is not a list of numbers, or there is no such run.
        TypeError: `runs` is neither a string nor integers.
    """
    if runs is None:
        return range(count)
    ranges = _ranges(runs, name) if isinstance(runs, str) else _single_runs(runs, name)
    for numbers in ranges:
        if not numbers or numbers.start < 0 or numbers.stop > count:
            run = numbers.start if not numbers or numbers.start < 0 else numbers.stop - 1
            has = "run 0" if count == 1 else f"runs 0 to {count - 1}"
            expected = f"{has} ({made_of or f'`repeat = {count}`'})"
            raise ConfigError(f"configuration `{config}` has no run {run}", source, expected=expected)
    return sorted({run for numbers in ranges for run in numbers})


def text_of_runs(numbers: Sequence[int]) -> str:
    """Write increasing run numbers so that `select_runs` reads them."""
    parts: list[list[int]] = []
    for number in numbers:
        if parts and parts[-1][-1] == number - 1:
            parts[-1].append(number)
        else:
            parts.append([number])
    return ",".join(f"{part[0]}..{part[-1]}" if part[1:] else str(part[0]) for part in parts)


def _single_runs(runs: Iterable[int], name: str) -> list[range]:
    try:
        return [range(run, run + 1) for run in map(index, runs)]
    except TypeError:
        raise TypeError(f"{name} {runs!r:.80}: expected numbers of runs, such as [0, 2]") from None


def _ranges(text: str, name: str) -> list[range]:
    ranges = []
    for part in text.split(","):
        match = _RANGE_OF_RUNS.fullmatch(part)
        if match is None or (match[2] and int(match[2]) < int(match[1])):
            raise ConfigError(f"{name} {text}: expected numbers of runs and ranges such as `0,2,5..9`")
        ranges.append(range(int(match[1]), int(match[2] or match[1]) + 1))
    return ranges


def whole_seed(seed: object) -> int:
    """Return a seed as an int, since numpy's integers overflow. TypeError if it is not an integer."""
    try:
        return index(seed)  # type: ignore[arg-type]
    except TypeError:
        raise TypeError(f"seed = {seed!r}: expected an integer") from None


def checked_seed(seed: object) -> int:
    """Return the seed of a run as an int. Raises TypeError and ValueError for other values."""
    whole = whole_seed(seed)
    if not 0 <= whole <= LARGEST_SEED:
        raise ValueError(f"seed = {whole}: it is out of range; expected 0 to {LARGEST_SEED}")
    return whole


def check_seeds_of_runs(seed: int, last_run: int, name: str = OF_SCRIPT.seed) -> None:
    """Raise ConfigError unless `seed`, that of run 0, and the seeds of all runs to the last are in range.

    `name` is what the message begins with.
    """
    if not 0 <= seed <= LARGEST_SEED:
        raise ConfigError(f"{name} {seed}: it is out of range; expected 0 to {LARGEST_SEED}")
    if seed + last_run > LARGEST_SEED:
        raise ConfigError(
            f"{name} {seed}: run {last_run} would have the seed {seed + last_run}; expected at most"
            f" {LARGEST_SEED - last_run}, since run N adds N"
        )


def seed_of_file(seed: Entry, variables: Mapping[str, str]) -> int:
    """Return the seed that the option `seed-set` gives a run. Raises ConfigError if it is not a seed."""
    entry = substitute(seed, variables)
    if entry.text.isdecimal() and entry.text.isascii() and len(entry.text) < len(str(LARGEST_SEED)):
        return int(entry.text)  # a hundred times faster, for each run of a large study
    return int(read_scalar(entry, OPTIONS["seed-set"]))


def entries_of_the_hash(entries: Iterable[Entry]) -> list[Entry]:
    """Return the entries that a settings hash covers: the first of each key, unless it is not about a run."""
    first: dict[str, Entry] = {}
    for entry in entries:
        if entry.key not in OF_NO_RUN and not is_ignored(entry):
            first.setdefault(entry.key, entry)
    return list(first.values())


def settings_hash(entries: Iterable[Entry]) -> str:
    """Return the hash of entries whose variables have been replaced: of keys, values and their order."""
    text = "\0".join(f"{entry.key}={entry.text}" for entry in entries)
    return hashlib.sha256(text.encode()).hexdigest()[:HASH_DIGITS]


class FileHashes:
    """Hashes of files, relative to the folder of the .ini file. Reads each file once."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder.resolve()
        self._hashes: dict[Path, tuple[str, str]] = {}

    def of(self, files: Iterable[Path], others: Mapping[str, Path] = MappingProxyType({})) -> dict[str, str]:
        """Return {name: hash}, sorted by name. Names are relative to the folder, or given in `others`."""
        hashes = {self._named(file) for file in files}
        hashes |= {(name, self._named(file)[1]) for name, file in others.items()}
        return dict(sorted(hashes))

    def _named(self, file: Path) -> tuple[str, str]:
        known = self._hashes.get(file)
        if known is None:
            known = self._hashes[file] = (self._name(file.resolve()), hash_of(file))
        return known

    def _name(self, file: Path) -> str:
        """Return a name that is the same if the user's folders are copied elsewhere."""
        try:
            return Path(os.path.relpath(file, self._folder)).as_posix()
        except ValueError:  # another drive
            return file.as_posix()


def hash_of(file: Path) -> str:
    """Return the hash of a file; "" if it cannot be read."""
    try:
        if not file.is_file():  # a missing file, or a pipe, whose content can be read only once
            return ""
        with file.open("rb") as content:
            return hashlib.file_digest(content, "sha256").hexdigest()[:HASH_DIGITS]
    except OSError:  # not readable, or an impossible name: what needs the file reports it
        return ""


def text_of_files(names: Sequence[str]) -> str:
    """Return names of files for a sentence, "a.py and b.py"; of many only the first ones."""
    left_out = len(names) - _MOST_NAMES
    if left_out > 1:
        return f"{', '.join(names[:_MOST_NAMES])} and {left_out} other files"
    return " and ".join(names)


@dataclass(frozen=True)
class UnreadVariables:
    """The iteration variables of one line that no run reads, since another line overrides it by another key.

    `**.rtsThreshold = ${rts=3000B, 100B}` below `**.mac.dcf.rtsPolicy.rtsThreshold = 100B` makes runs of both
    values, and these are alike. Of lines with the same key, `name_iterations` leaves the second one out.

    Attributes:
        source: The line.
        names: Those of its variables that no other line refers to, either.
        instead: A line that is in force for a parameter that this one matches, if one was found.
    """

    source: Source
    names: tuple[str, ...]
    instead: Source | None = None


def unread_variables(
    lines: Sequence[Entry], variables: Sequence[IterationVariable], read: Collection[Source]
) -> dict[Source, tuple[str, ...]]:
    """Return the lines that iterate over several values in vain, with the names of these variables.

    `lines` have names for values, and `read` are the sources of those that some run reads, without options.
    """
    by_name = {variable.name: variable for variable in variables}
    used = {
        name
        for line in lines
        if line.source in read or (is_option(line) and not is_ignored(line) and line.key not in OF_NO_RUN)
        for name in _NAMES.findall(line.text)
    }
    if used & _OF_ALL:
        return {}
    for variable in variables:  # those that the used ones are in lock-step with
        leader = variable
        while leader.name in used and leader.follows in by_name and leader.follows not in used:
            leader = by_name[leader.follows]
            used.add(leader.name)
    options = {line.source for line in lines if is_option(line)}
    unread: dict[Source, tuple[str, ...]] = {}
    for variable in variables:
        if variable.name not in used and variable.source not in options and len(variable.values) > 1:
            unread[variable.source] = (*unread.get(variable.source, ()), variable.name)
    return unread


def line_instead(idle: Source, resolution: Resolution) -> Source | None:
    """Return a line that is in force where the line `idle` matches, too; None if there is none."""
    for row in resolution.rows():
        if row.line.entry.source != idle and any(line.entry.source == idle for line in row.lines):
            return row.line.entry.source
    return None
