"""Reads .ini files: lines, includes, sections and entries.

This module does not know what keys mean. The grammar is that of OMNeT++: content starts in column 1, an
indented line continues the line above it, a backslash at the end of a line joins it with the next line, and
`#` outside of quotes starts a comment.
"""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from gradysim.scenario.errors import (
    OF_SCRIPT,
    BadValue,
    ConfigError,
    ErrorCollector,
    Source,
    nearest_file,
    shortened,
)
from gradysim.scenario.parse.regular_files import check_regular

GENERAL = "General"
"""The section that every configuration falls back on; entries before the first section go there."""

PROFILES = Path(__file__).parents[1] / "profiles"
"""Directory of the files that come with the package: each makes the engine follow another simulator."""

_HEADING = re.compile(r"\[\s*(?:(?P<kind>Config|Level)\s+)?(?P<name>[^\s\[\]]+)\s*\]")

_DEEPEST = 100
"""Limit for nested includes; Python's stack has such a limit, too."""

_MOST_BYTES = 64 * 2**20
"""Largest size of a file with all its includes."""

_MOST_INCLUDES = 1000
"""Largest number of included files. Two files that each include two others, and so on, would be too many."""

_NOT_TEXT = re.compile(rb"[\x00-\x08\x0b\x0e-\x1f\x7f]")
"""Control characters that no text has. UTF-16 has the first one."""


@dataclass(frozen=True)
class Entry:
    """One `key = value` as it is written, not interpreted.

    Attributes:
        rank: Position of its section in the search order, from `entries_in_order`; 0 is the command line.
    """

    key: str
    text: str
    source: Source
    rank: int = 0


@dataclass
class Section:
    """A section with its entries, from all files, in the order in which they are written."""

    name: str
    source: Source
    entries: list[Entry] = field(default_factory=list)


@dataclass
class IniFile:
    """An .ini file with all that it includes. It always has a section General.

    Attributes:
        sections: Configurations and General, by name.
        levels: `[Level NAME]`: lines that a level of `gradysim ladder` adds to a configuration, by name.
    """

    file: Path
    sections: dict[str, Section]
    levels: dict[str, Section] = field(default_factory=dict)


def read_ini(file: Path) -> IniFile:
    """Read a file and all that it includes.

    Raises:
        ConfigError: A file cannot be read, or lines are not understood; all of them are reported.
    """
    reader = _Reader(file)
    reader.read(file, reader.ini.sections[GENERAL], None, ())
    reader.errors.raise_all()
    return reader.ini


def read_overrides(file: Path, overrides: Iterable[str], option: str = OF_SCRIPT.overrides) -> list[Entry]:
    """Return the entries of "KEY=VALUE" strings. Of equal keys the first one wins.

    Args:
        file: Paths in values are relative to this file.
        overrides: The strings.
        option: The option that they were given to, for messages.

    Raises:
        ConfigError: Strings are not KEY=VALUE; all of them are reported.
        TypeError: `overrides` is not a list of strings.
    """
    entries = []
    errors = ErrorCollector()
    for override in _strings(overrides):
        key, equals, text = (part.strip() for part in override.partition("="))
        source = Source(file, 0, key, text, option)
        with errors.collecting():
            if any("\ud800" <= character <= "\udfff" for character in override):
                written = shortened(ascii(override))
                raise ConfigError(f"{option} {written}: it is not UTF-8", expected="KEY=VALUE in UTF-8")
            if not (key and equals and text):
                problem = f"{option} {shortened(override)}"
                raise ConfigError(f"{problem}: expected KEY=VALUE, such as `sim-time-limit=10s`")
            _refuse_variables(key, source)
            entries.append(Entry(key, text, source))
    errors.raise_all()
    return entries


def _strings(overrides: object) -> list[str]:
    if isinstance(overrides, Iterable) and not isinstance(overrides, str | Mapping):
        strings = list(overrides)
        if all(isinstance(string, str) for string in strings):
            return strings
    raise TypeError(
        f"overrides = {overrides!r:.80}: expected a list of strings, such as ['sim-time-limit=10s']"
    )


class _Reader:
    def __init__(self, file: Path) -> None:
        self.ini = IniFile(file, {GENERAL: Section(GENERAL, Source(file, 0))})
        self.errors = ErrorCollector()
        self._bytes = self._files = 0

    def read(
        self, file: Path, section: Section, asked_by: Source | None, including: tuple[Path, ...]
    ) -> None:
        """Read one file into `section`, up to its first heading."""
        headings: dict[tuple[str, str], int] = {}
        text = self._text_of(file, asked_by)  # before `resolve`, which fails for names that no file can have
        resolved = file.resolve()
        if resolved in including:
            raise ConfigError(f"{file} includes itself", asked_by, expected="another file")
        if len(including) > _DEEPEST:
            raise ConfigError(f"more than {_DEEPEST} nested includes", asked_by, expected="fewer")
        for number, line in _logical_lines(file, text, self.errors):
            source = Source(file, number)
            with self.errors.collecting():
                if line.startswith("["):
                    section = self._open_section(line, source, headings)
                elif match := re.match(r"include\s++(?!=)(.*)", line):
                    included = _included_file(file, match.group(1).strip().strip('"'))
                    self.read(included, section, source, (*including, resolved))
                else:
                    section.entries.append(_entry(line, source))

    def _open_section(self, line: str, source: Source, headings: dict[tuple[str, str], int]) -> Section:
        match = _HEADING.fullmatch(line)
        if not match or line.split() == ["[Config", "General]"]:
            problem = f"`{shortened(line)}` is not a heading"
            raise ConfigError(problem, source, expected="[General], [Config NAME] or [Level NAME]")
        kind, name = match["kind"] or "Config", match["name"]
        if {"/", "\\"} & set(name):
            raise ConfigError(
                f"`{shortened(name)}` cannot be part of a file name", source, expected="no `/` and no `\\`"
            )
        if (kind, name) in headings:
            raise ConfigError(
                f"section `{shortened(name)}` is already at line {headings[kind, name]}",
                source,
                expected="each section once in a file",
            )
        headings[kind, name] = source.line
        sections = self.ini.levels if kind == "Level" else self.ini.sections
        section = sections.setdefault(name, Section(name, source))
        if section.source.line == 0:
            section.source = source
        return section

    def _text_of(self, file: Path, asked_by: Source | None) -> str:
        self._files += 1
        if self._files > _MOST_INCLUDES:
            expected = f"at most {_MOST_INCLUDES} included files"
            raise ConfigError(f"{self.ini.file} includes more files", asked_by, expected=expected)
        data = _bytes_of(file, asked_by, _MOST_BYTES + 1 - self._bytes)
        self._bytes += len(data)
        if self._bytes > _MOST_BYTES:
            problem = f"{self.ini.file} has more than {_MOST_BYTES >> 20} MiB with all that it includes"
            raise ConfigError(problem, asked_by or Source(file, 0), expected="less")
        return _decoded(file, data)


def _included_file(file: Path, name: str) -> Path:
    """Return the file that `file` includes by that name: one relative to it, or else a profile."""
    beside = file.parent / name
    is_profile = name in {profile.name for profile in PROFILES.glob("*.ini")}
    return PROFILES / name if is_profile and not beside.exists() else beside


def _bytes_of(file: Path, asked_by: Source | None, most: int) -> bytes:
    try:
        check_regular(file, str(file) if asked_by else "it")
        with file.open("rb") as opened:
            return opened.read(most)
    except BadValue as error:
        raise ConfigError(error.problem, asked_by or Source(file, 0), expected=error.expected) from error
    except OSError as error:
        reason = "no such file" if isinstance(error, FileNotFoundError) else error.strerror or str(error)
        folders = [file.parent, PROFILES] if asked_by else [file.parent]
        nearest = next(filter(None, (nearest_file(folder / file.name, (".ini",)) for folder in folders)), "")
        raise ConfigError(
            f"{file}: {reason}", asked_by, expected="an .ini file", suggestion=nearest
        ) from error


def _decoded(file: Path, data: bytes) -> str:
    if found := _NOT_TEXT.search(data):
        line, byte = data.count(b"\n", 0, found.start()) + 1, data[found.start()]
        raise ConfigError(
            f"this line has the byte 0x{byte:02x}, which no text has", Source(file, line), expected="UTF-8"
        )
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise ConfigError("this line is not UTF-8", Source(file, line), expected="UTF-8") from error


def _logical_lines(file: Path, text: str, errors: ErrorCollector) -> Iterator[tuple[int, str]]:
    """Yield lines without comments and with their continuations, each with the number of its first line."""
    current: tuple[int, str] | None = None
    for number, raw in _joined_lines(text):
        with errors.collecting():
            line = _without_comment(raw, Source(file, number))
            if not line.strip():
                continue
            if line[0] not in " \t":
                if current:
                    yield current
                current = (number, line.rstrip())
            else:
                _check_continuation(line, current, Source(file, number))
                current = (current[0], f"{current[1]}\n{line.strip()}") if current else None
    if current:
        yield current


def _check_continuation(line: str, current: tuple[int, str] | None, source: Source) -> None:
    if current is None or current[1].startswith("["):
        raise ConfigError(
            "an indented line continues the entry above it, and there is none", source, expected="column 1"
        )
    if _looks_like_an_entry(line.strip()):
        raise ConfigError(
            f"an indented line continues the entry above it, at line {current[0]}",
            source,
            expected="a new entry in column 1",
        )


def _looks_like_an_entry(line: str) -> bool:
    """Return whether an indented line begins like an entry: with a key that has a dot or a hyphen."""
    key, equals, value = line.partition("=")
    is_key = not {" ", "\t", '"', "'"} & set(key.rstrip()) and bool({".", "-"} & set(key))
    return is_key and bool(equals) and not value.startswith("=")


def _joined_lines(text: str) -> Iterator[tuple[int, str]]:
    """Yield physical lines, joined where a line ends with a backslash."""
    start, parts = 0, list[str]()
    for number, raw in enumerate(text.split("\n"), start=1):
        line = raw.removesuffix("\r")
        start = start if parts else number
        if line.endswith("\\"):
            parts.append(line[:-1])
        else:
            yield start, "".join([*parts, line])
            parts = []
    if parts:
        yield start, "".join(parts)


def _without_comment(line: str, source: Source) -> str:
    """Remove a comment; `#` between quotes does not start one."""
    if sign := re.match(r"\s*(;|//)", line):
        raise ConfigError(f"`{sign[1]}` does not start a comment", source, expected="`#`")
    in_string = False
    position = 0
    while position < len(line):
        character = line[position]
        if in_string and character == "\\":
            position += 1
        elif character == '"':
            in_string = not in_string
        elif character == "#" and not in_string:
            return line[:position]
        position += 1
    if in_string:
        raise ConfigError("a string does not end on its line", source, expected='a closing `"`')
    return line


def _entry(line: str, source: Source) -> Entry:
    key, equals, text = (part.strip() for part in line.partition("="))
    if not equals or not key:
        raise ConfigError(f"`{shortened(line)}` is not an entry", source, expected="`key = value`")
    if not text:
        name = shortened(key)
        raise ConfigError(f"`{name}` has no value", source, expected=f"`{name} = value`")
    _refuse_variables(key, source)
    return Entry(key, text, Source(source.file, source.line, key, text.replace("\n", " ")))


def _refuse_variables(key: str, source: Source) -> None:
    if "${" in key:
        raise ConfigError(f"`{shortened(key)}` has a variable", source, expected="`${...}` in values only")
