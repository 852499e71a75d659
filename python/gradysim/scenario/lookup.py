"""Finds the entry in force for a parameter, the first that matches in search order, and reads its value.

A path has two parts: the name below the network (`uavs[3]`) and the rest (`mobility.speed`). The patterns
that can match a rest are found once per rest. Per node, one dictionary lookup remains for the entries that
name the node, and one match for each other entry that may be about its group.
"""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from gradysim.scenario.distributions import distribution_in
from gradysim.scenario.errors import BadValue, ConfigError, ErrorCollector, Source, is_fully_qualified
from gradysim.scenario.expressions import (
    ParameterContext,
    differs_between_parameters,
    parse_list,
    parse_value,
)
from gradysim.scenario.functions import Value, text_of
from gradysim.scenario.ini import Entry
from gradysim.scenario.parameter_types import ParameterType, Scalar
from gradysim.scenario.patterns import Pattern, PatternIndex, compile_pattern
from gradysim.scenario.regular_files import check_regular
from gradysim.scenario.schema import (
    IGNORED_BEGINNINGS,
    IGNORED_ENDS,
    IGNORED_MODULES,
    IGNORED_OPTION_BEGINNINGS,
    IGNORED_OPTIONS,
    NETWORK,
    OPTIONS,
    Key,
)

_NETWORK_NAME = re.compile(r'("?)(?:[A-Za-z_]\w*\.)*([A-Za-z_]\w*)\1', re.ASCII)
"""Names of packages may precede it; quotes are optional."""

_LIKE_AN_EXPRESSION = re.compile(r'"|\?|\w\s*\(')
"""Strings in quotes, conditions and calls, which a string without quotes does not have."""

_UNIFORM = re.compile(r'\s*uniform\s*\(([^(),"]*),([^(),"]*)\)\s*', re.ASCII)


@dataclass(frozen=True)
class Setting:
    """A value with the place where it was written, for errors that come up later."""

    value: Scalar
    source: Source


@dataclass(frozen=True, eq=False)
class Found:
    """An entry with its position in the search order.

    Attributes:
        order: Its position among all entries; the first one that matches is in force.
        entry: The entry.
        pattern: Its key, compiled.
        parts: The pattern for the network, for the name below it and for the rest (which may be missing), or
            None if `**` makes them uncertain.
        differs: Whether its value differs between parameters: it is drawn, or depends on an index.
    """

    order: int
    entry: Entry
    pattern: Pattern
    parts: list[Pattern] | None
    differs: bool

    @property
    def is_default(self) -> bool:
        """Whether the entry is `default`: it stops the search and leaves the default."""
        return self.entry.text == "default"

    def overrides(self, other: "Found") -> bool:
        """Return whether it comes before the other from another section or file, so on purpose."""
        here, there = ((found.entry.rank, found.entry.source.file) for found in (self, other))
        return here != there and self.order < other.order

    def may_end_in(self, rest: str) -> bool:
        """Return whether paths that end in `rest` can match, judged by their last name only."""
        tail = self.pattern.tail
        return tail is None or not rest or tail.matches(rest.rpartition(".")[2])

    def name_pattern(self) -> Pattern | None:
        """Return the part that names something below the network, if it is certain."""
        return self.parts[1] if self.parts else None

    def rest_pattern(self) -> Pattern | None:
        """Return the part below that name, if there is one and it is certain."""
        return self.parts[2] if self.parts and len(self.parts) == 3 else None


class Candidate(NamedTuple):
    """An entry that can match a rest, and the pattern for the name; None if only the whole path decides."""

    found: Found
    name: Pattern | None

    def matches(self, network: str, rest: str, name: str) -> bool:
        """Return whether the entry matches that rest, which it can match, below that name."""
        if self.name is not None:
            return self.name.matches(name)
        return self.found.pattern.matches(f"{network}.{name}.{rest}" if rest else f"{network}.{name}")


_ANY_NAME = compile_pattern("*")


class Candidates:
    """The entries that can match one rest below some name.

    Attributes:
        every: All of them, in search order.
    """

    def __init__(self, network: str, rest: str, candidates: Sequence[Candidate]) -> None:
        self._network = network
        self._rest = rest
        self.every = candidates
        self._by_name: dict[str, Found] = {}
        self._patterns: list[Candidate] = []
        for candidate in candidates:
            if candidate.name is None or candidate.name.literal is None:
                self._patterns.append(candidate)
            else:
                self._by_name.setdefault(candidate.name.literal, candidate.found)
        self._of_group: dict[str, list[Candidate]] = {}

    def __bool__(self) -> bool:
        return bool(self._by_name or self._patterns)

    def first(self, name: str) -> Found | None:
        """Return the entry in force for that name."""
        best = self._by_name.get(name)
        for candidate in self._patterns_for(name.partition("[")[0]):
            if best is not None and candidate.found.order > best.order:
                break
            if candidate.matches(self._network, self._rest, name):
                return candidate.found
        return best

    def _patterns_for(self, group: str) -> list[Candidate]:
        """Return those that may match nodes of that group."""
        of_group = self._of_group.get(group)
        if of_group is None:
            of_group = self._of_group[group] = [
                candidate
                for candidate in self._patterns
                if candidate.name is None or candidate.name.group in (None, group)
            ]
        return of_group


class Lookup:
    """All entries of a configuration, in search order.

    Attributes:
        network: What paths begin with.
        found: The entries of parameters in search order, without those that only OMNeT++ reads.
    """

    def __init__(self, entries: Sequence[Entry]) -> None:
        """Index entries in search order. Raises ConfigError for all bad patterns."""
        self.network = network_name(entries)
        self.found: list[Found] = []
        errors = ErrorCollector()
        for order, entry in enumerate(entries):
            if not is_option(entry) and not is_ignored(entry):
                with errors.collecting():
                    self.found.append(_compile(order, entry))
        errors.raise_all()
        self._below_names: PatternIndex[Candidate] = PatternIndex()  # by the pattern of the rest
        self._without_rest: list[Candidate] = []
        self._below_anything: PatternIndex[Candidate] = PatternIndex()  # `**.` and what is below
        self._uncertain: list[Candidate] = []
        for found in self.found:
            self._add(found)
        self._candidates: dict[str, Candidates] = {}

    def _add(self, found: Found) -> None:
        if found.parts is not None:
            if not found.parts[0].matches(self.network):
                return
            name, rest = found.parts[1], found.rest_pattern()
        elif (below := found.pattern.below_anything) is not None:
            name, rest = below
            self._below_anything.add(found.pattern, Candidate(found, _ANY_NAME))
        else:
            self._uncertain.append(Candidate(found, None))
            return
        if rest is None:
            self._without_rest.append(Candidate(found, name))
        else:
            self._below_names.add(rest, Candidate(found, name))

    def candidates(self, rest: str) -> Candidates:
        """Return the entries that can match `NETWORK.<name>.<rest>`; without a rest, `NETWORK.<name>`."""
        candidates = self._candidates.get(rest)
        if candidates is None:
            found = [candidate for candidate in self._uncertain if candidate.found.may_end_in(rest)]
            if rest:
                found += self._below_names.matching(rest)
                found += self._below_anything.matching(f".{rest}")
            else:
                found += self._without_rest
            found.sort(key=lambda candidate: candidate.found.order)
            candidates = self._candidates[rest] = Candidates(self.network, rest, found)
        return candidates

    def asked_for(self) -> Iterable[tuple[str, Candidates]]:
        """Return the rests that were looked up, sorted, and the entries that can match them."""
        return sorted(self._candidates.items())

    def first(self, name: str, rest: str = "") -> Found | None:
        """Return the entry in force for one path."""
        return self.candidates(rest).first(name)


def network_name(entries: Iterable[Entry]) -> str:
    """Return what paths begin with: the option `network`, in which packages may precede the name.

    Raises ConfigError if it has variables or is not a name.
    """
    network = next((entry for entry in entries if entry.key == NETWORK), None)
    if network is None:
        return "Network"
    if "${" in network.text:
        text = "it is the same in all runs"
        raise ConfigError.at(network.source, text, expected="a name without variables")
    match = _NETWORK_NAME.fullmatch(network.text)
    if match is None:
        expected = "the name of a network, such as `Network` or `package.Network`"
        raise ConfigError.at(network.source, f"`{network.text}` is not a name", expected=expected)
    return match[2]


def is_option(entry: Entry) -> bool:
    """Return whether the key is that of an option: it has no dot."""
    return "." not in entry.key


def options_in_force(entries: Iterable[Entry]) -> dict[str, Entry]:
    """Return the entry in force for each option that is set."""
    options: dict[str, Entry] = {}
    for entry in entries:
        if entry.key in OPTIONS:
            options.setdefault(entry.key, entry)
    return {key: entry for key, entry in options.items() if entry.text != "default"}


def is_ignored(entry: Entry) -> bool:
    """Return whether only OMNeT++ reads an entry. Its value is not checked."""
    parts = entry.key.split(".")
    if len(parts) == 1:
        return entry.key in IGNORED_OPTIONS or entry.key.startswith(IGNORED_OPTION_BEGINNINGS)
    if parts[-1].startswith(IGNORED_BEGINNINGS) or parts[-1] in IGNORED_ENDS:
        return True
    return len(parts) > 2 and parts[1] in IGNORED_MODULES


def _compile(order: int, entry: Entry) -> Found:
    try:
        pattern = compile_pattern(entry.key)
    except BadValue as error:
        text = f"{entry.key}: {error.problem}"
        raise ConfigError(text, entry.source, expected=error.expected, hint=error.hint) from error
    parts = pattern.split()
    differs = differs_between_parameters(entry.text)
    return Found(order, entry, pattern, parts if parts and len(parts) > 1 else None, differs)


def read_struct(
    struct: str,
    found: Mapping[Key, Found],
    settings: "SettingReader",
    path_of: Callable[[Key], str],
    errors: ErrorCollector,
) -> dict[str, Setting]:
    """Return the fields of one struct that entries set. Of two keys for one field, the first entry is used.

    `path_of` gives the path of a key's parameter below the network. `errors` takes the errors of values;
    their fields are left out.
    """
    first: dict[str, tuple[Found, Key]] = {}
    for key, entry in found.items():
        if key.struct == struct and (key.field not in first or entry.order < first[key.field][0].order):
            first[key.field] = (entry, key)
    read: dict[str, Setting] = {}
    for field, (entry, key) in first.items():
        if not entry.is_default:
            with errors.collecting():
                read[field] = settings.setting(entry.entry, key.kind, path_of(key))
    return read


class SettingReader:
    """Reads the values of one run.

    Each entry is read once for each type, unless each parameter has its own value.
    """

    def __init__(self, seed: int = 0) -> None:
        self._seed = seed
        self._settings: dict[tuple[int, int], tuple[Entry, ParameterType, Setting]] = {}
        self._files: dict[str, None] = {}  # in their order, each once
        self._read: dict[int, Entry] = {}
        self._right_for_all_seeds: dict[tuple[str, ParameterType], bool] = {}  # of drawn values

    def setting(self, entry: Entry, kind: ParameterType, path: str = "") -> Setting:
        """Return the value of an entry. ConfigError, with its place, if it is not of that type.

        `path` is the parameter that it is for, from below the network; "" if it is not for a parameter.
        """
        key = (id(entry), id(kind))
        known = self._settings.get(key)
        if known is None:
            self._read[id(entry)] = entry
            if path and differs_between_parameters(entry.text):
                own = read_scalar(entry, kind, path, ParameterContext(self._seed, path))
                if (entry.text, kind) not in self._right_for_all_seeds:
                    self._right_for_all_seeds[entry.text, kind] = is_right_for_all_seeds(entry.text, kind)
                return self._noted(Setting(own, entry.source), kind)
            # Entry and type are kept beside the value, so that their ids are not reused.
            setting = self._noted(Setting(read_scalar(entry, kind, path), entry.source), kind)
            known = self._settings[key] = (entry, kind, setting)
        return known[2]

    def scalar(self, entry: Entry, kind: ParameterType, path: str = "") -> Scalar:
        """Return only the value."""
        return self.setting(entry, kind, path).value

    def files(self) -> list[Path]:
        """Return the files that the values read so far name."""
        return [Path(file) for file in self._files]

    def lines_read(self) -> frozenset[Source]:
        """Return the lines of the values read so far."""
        return frozenset(entry.source for entry in self._read.values())

    def types_read(self) -> list[tuple[Source, ParameterType]]:
        """Return lines whose values were read and are the same for all parameters, with their types."""
        return [(entry.source, kind) for entry, kind, _ in self._settings.values()]

    def is_right_for_all_seeds(self) -> bool:
        """Whether runs that differ from this one only in their seed are valid if this one is."""
        return all(self._right_for_all_seeds.values())

    def for_checks(self) -> "SettingReader":
        """Return another reader for the same run. It shares only what it finds out about draws."""
        reader = SettingReader(self._seed)
        reader._right_for_all_seeds = self._right_for_all_seeds
        return reader

    def _noted(self, setting: Setting, kind: ParameterType) -> Setting:
        if kind.is_file and setting.value:
            self._files[str(setting.value)] = None
        return setting


def read_scalar(
    entry: Entry, kind: ParameterType, path: str = "", parameter: ParameterContext | None = None
) -> Scalar:
    """Return the value of an entry. ConfigError, with its place, if it is not of that type.

    The error names `path`, the parameter that the value is for, if wildcards of the key leave it open:
    `**.power` may be for a transmitter or for the background noise. With `parameter` the value may be drawn
    and depend on indices.
    """
    written: Value | None = None
    try:
        written = _value_of(entry, kind, parameter)
        value = kind.convert(written)
        if not kind.is_file or not value:
            return value
        file = entry.source.file.parent / str(value)
        check_regular(file, str(value))
        return str(file)
    except BadValue as error:
        is_of_one_run = "${" in entry.source.value and "${" not in entry.text
        this = f"that is {entry.text}: " if is_of_one_run else ""
        if parameter is not None:
            seed = f" with seed {parameter.seed}" if parameter.has_drawn else ""
            that = "" if written is None or kind.is_list else f"that is {text_of(written)} "
            this += f"{that}for {path}{seed}: "
        elif path and not is_fully_qualified(entry.key, path.partition(".")[2]):
            this += f"for {path}: "
        raise error.at(entry.source, prefix=this, expected=kind.expected) from error


def _value_of(entry: Entry, kind: ParameterType, parameter: ParameterContext | None) -> Value:
    """Evaluate the entry. A string in an override needs no quotes, which a shell takes away."""
    needs_no_quotes = kind.is_text and entry.source.is_override
    if needs_no_quotes and (entry.text in kind.names or not _LIKE_AN_EXPRESSION.search(entry.text)):
        return entry.text
    if kind.is_list:
        return parse_list(entry.text, parameter)  # type: ignore[return-value]
    return parse_value(entry.text, parameter)


def is_right_for_all_seeds(text: str, kind: ParameterType) -> bool:
    """Whether a value that is valid with one seed is known to be valid with every other seed.

    That is known of `uniform(0m, 1km)` if both ends are valid and everything between valid values is. It
    spares studies that differ in seeds from checking every run.
    """
    if not distribution_in(text):
        return True
    ends = _UNIFORM.fullmatch(text)
    if ends is None or not kind.has_all_between:
        return False
    try:
        for end in ends.groups():
            kind.convert(parse_value(end))
    except BadValue:  # out of range, or different for each parameter
        return False
    return True
