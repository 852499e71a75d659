"""Reads the value of an entry as what its key wants it to be."""

import re
from dataclasses import dataclass
from pathlib import Path

from gradysim.scenario.errors import BadValue, Source, is_fully_qualified
from gradysim.scenario.ini import Entry
from gradysim.scenario.value.expression import parse_value
from gradysim.scenario.value.kinds import Kind, Scalar
from gradysim.scenario.value.operators import Value, text_of
from gradysim.scenario.value.parameter_context import ParameterContext, differs_between_parameters
from gradysim.scenario.value.safe_draws import is_safe

_LIKE_AN_EXPRESSION = re.compile(r'"|\?|\w\s*\(')
"""What no text without quotes has: texts in quotes, conditions and calls."""


@dataclass(frozen=True)
class Setting:
    """A value with the place where it was written, for errors that come up later."""

    value: Scalar
    source: Source


class SettingReader:
    """Reads values; each entry once for each kind, unless it is another value for each parameter."""

    def __init__(self, seed: int = 0) -> None:
        """For the run with that seed."""
        self._seed = seed
        self._settings: dict[tuple[int, int], tuple[Entry, Kind, Setting]] = {}
        self._files: dict[str, None] = {}  # in their order, each once
        self._read: dict[int, Entry] = {}
        self._parameters: set[str] = set()
        self._draws: dict[tuple[str, Kind], bool] = {}  # whether they are safe

    def setting(self, entry: Entry, kind: Kind, path: str = "") -> Setting:
        """The value of an entry. Raises ConfigError with its place if it is not of that kind.

        `path` is the parameter that it is for, from below the network; without one its value is nobody's own.
        """
        key = (id(entry), id(kind))
        known = self._settings.get(key)
        if known is None:
            self._read[id(entry)] = entry
            self._parameters.add(path.partition(".")[2])
            if path and differs_between_parameters(entry.text):
                own = read_scalar(entry, kind, path, ParameterContext(self._seed, path))
                if (entry.text, kind) not in self._draws:
                    self._draws[entry.text, kind] = is_safe(entry.text, kind)
                return self._noted(Setting(own, entry.source), kind)
            # Entry and kind are kept beside the value, so that their ids are not given to others.
            setting = self._noted(Setting(read_scalar(entry, kind, path), entry.source), kind)
            known = self._settings[key] = (entry, kind, setting)
        return known[2]

    def files(self) -> list[Path]:
        """The files that the values read up to now name."""
        return [Path(file) for file in self._files]

    def lines_read(self) -> frozenset[Source]:
        """The lines of which the values read up to now are."""
        return frozenset(entry.source for entry in self._read.values())

    def parameters_read(self) -> frozenset[str]:
        """What they were read for, without the names of nodes and parts of the network: "mobility.speed"."""
        return frozenset(self._parameters - {""})

    def is_right_for_all_seeds(self) -> bool:
        """Whether runs that differ from this one in their seed alone have no other mistakes than it."""
        return all(self._draws.values())

    def for_checks(self) -> "SettingReader":
        """Return another reader for the same run, of which this one notices only what it draws."""
        reader = SettingReader(self._seed)
        reader._draws = self._draws
        return reader

    def _noted(self, setting: Setting, kind: Kind) -> Setting:
        if kind.is_file and setting.value:
            self._files[str(setting.value)] = None
        return setting

    def scalar(self, entry: Entry, kind: Kind, path: str = "") -> Scalar:
        """Only the value."""
        return self.setting(entry, kind, path).value


def read_scalar(
    entry: Entry, kind: Kind, path: str = "", parameter: ParameterContext | None = None
) -> Scalar:
    """The value of an entry. Raises ConfigError with its place if it is not of that kind.

    `path` is the parameter that it is for, which the error tells if the key leaves a part of its name to
    wildcards: `**.power` may be for a transmitter or for the background noise. With `parameter` its
    value may be that parameter's own.
    """
    written: Value | None = None
    try:
        written = _value_of(entry, kind, parameter)
        value = kind.convert(written)
        return str(entry.source.file.parent / str(value)) if kind.is_file and value else value
    except BadValue as error:
        is_of_one_run = "${" in entry.source.value and "${" not in entry.text
        this = f"that is {entry.text}: " if is_of_one_run else ""
        if parameter is not None:
            seed = f" with seed {parameter.seed}" if parameter.has_drawn else ""
            this += f"{f'that is {text_of(written)} ' if written is not None else ''}for {path}{seed}: "
        elif path and not is_fully_qualified(entry.key, path.partition(".")[2]):
            this += f"for {path}: "
        raise error.at(entry.source, prefix=this, expected=kind.expected) from error


def _value_of(entry: Entry, kind: Kind, parameter: ParameterContext | None) -> Value:
    """The value; where a text is meant, an override needs no quotes, which a shell takes away."""
    needs_no_quotes = kind.is_text and entry.source.is_override
    if needs_no_quotes and (entry.text in kind.names or not _LIKE_AN_EXPRESSION.search(entry.text)):
        return entry.text
    return parse_value(entry.text, parameter)
