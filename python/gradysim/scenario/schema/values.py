"""Reads the values of lines."""

import re
from dataclasses import dataclass
from pathlib import Path

from gradysim.scenario.errors import BadValue, Source, is_fully_qualified
from gradysim.scenario.parse.distributions import distribution_in
from gradysim.scenario.parse.expressions import (
    ParameterContext,
    differs_between_parameters,
    parse_list,
    parse_value,
)
from gradysim.scenario.parse.functions import Value, text_of
from gradysim.scenario.parse.ini import Entry
from gradysim.scenario.parse.regular_files import check_regular
from gradysim.scenario.schema.parameter_types import ParameterType, Scalar

_LIKE_AN_EXPRESSION = re.compile(r'"|\?|\w\s*\(')
"""Strings in quotes, conditions and calls, which a string without quotes does not have."""

_UNIFORM = re.compile(r'\s*uniform\s*\(([^(),"]*),([^(),"]*)\)\s*', re.ASCII)


@dataclass(frozen=True)
class Setting:
    """A value with the source where it was written, for errors that come up later."""

    value: Scalar
    source: Source


class SettingReader:
    """Reads the values of one run.

    Each entry is read once for each type, unless each parameter has its own value.
    """

    def __init__(self, seed: int = 0) -> None:
        self._seed = seed
        self._settings: dict[tuple[int, int], tuple[Entry, ParameterType, Setting]] = {}
        self._files: dict[str, None] = {}  # in their order, each once
        self._read: dict[int, Entry] = {}
        self._right_for_all_seeds: dict[tuple[int, int], bool] = {}  # of drawn values

    def setting(self, entry: Entry, kind: ParameterType, path: str = "") -> Setting:
        """Return the value of an entry. ConfigError, with its source, if it is not of that type.

        `path` is the parameter that it is for, from below the network; "" if it is not for a parameter.
        """
        key = (id(entry), id(kind))
        known = self._settings.get(key)
        if known is None:
            self._read[id(entry)] = entry
            if path and differs_between_parameters(entry.text):
                own = read_scalar(entry, kind, path, ParameterContext(self._seed, path))
                if key not in self._right_for_all_seeds:
                    self._right_for_all_seeds[key] = is_right_for_all_seeds(entry.text, kind)
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

    def has_values_of_parameters(self) -> bool:
        """Whether a value that was read is drawn, or depends on an index."""
        return bool(self._right_for_all_seeds)

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
    """Return the value of an entry. ConfigError, with its source, if it is not of that type.

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
