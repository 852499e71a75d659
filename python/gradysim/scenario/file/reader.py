"""Reads the text of .ini files: lines, continuations, comments, includes, sections and entries.

Knows nothing of what keys mean. The grammar is OMNeT++'s: content starts in column 1, an indented line
continues the one above it, a backslash at the end of a line joins it with the next, and `#` outside of quotes
starts a comment.
"""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from gradysim.scenario.errors import OF_SCRIPT, ConfigError, Source, nearest_file

GENERAL = "General"
"""The section that every configuration falls back on; entries before the first section go there."""

OVERRIDES = "overrides"
"""The section name of entries that no file has."""

_LIKE_AN_ENTRY = re.compile(r"""[^\s"'=]*[.-][^\s"'=]*\s*=(?!=)""")
"""What an indented line begins with that was meant as an entry of its own: a key with a dot or a hyphen."""

_HEADING = re.compile(r"\[\s*(?:Config\s+)?([^\s\[\]]+)\s*\]")

_DEEPEST = 100
"""Files that include each other in a row; Python's stack has such a limit, too."""


@dataclass(frozen=True)
class Entry:
    """One `key = value` as it is written: nothing in it has been interpreted yet."""

    key: str
    text: str
    source: Source
    section: str


@dataclass
class Section:
    """A section with its entries in the order in which they were written, those of all files together."""

    name: str
    source: Source
    entries: list[Entry] = field(default_factory=list)


@dataclass
class IniFile:
    """An .ini file with all that it includes. There always is a section General."""

    file: Path
    sections: dict[str, Section]


def read_ini(file: Path) -> IniFile:
    """Read a file and all that it includes.

    Raises:
        ConfigError: It cannot be read, or a line of it makes no sense.
    """
    ini = IniFile(file, {GENERAL: Section(GENERAL, Source(file, 0))})
    _Reader(ini).read(file, GENERAL, None, ())
    return ini


def read_overrides(file: Path, overrides: Iterable[str], option: str = OF_SCRIPT.overrides) -> list[Entry]:
    """Entries of "KEY=VALUE" texts. Paths in them are relative to `file`. Of equal keys the first one wins.

    `option` is what they were given to.

    Raises:
        ConfigError: One is not KEY=VALUE.
        TypeError: They are no list of texts.
    """
    entries = []
    for override in _texts(overrides):
        key, equals, text = (part.strip() for part in override.partition("="))
        if not (key and equals and text):
            raise ConfigError(f"{option} {override}: expected KEY=VALUE, such as `sim-time-limit=10s`")
        source = Source(file, 0, key, text, option)
        _refuse_variables(key, source)
        entries.append(Entry(key, text, source, OVERRIDES))
    return entries


def _texts(overrides: object) -> list[str]:
    if isinstance(overrides, Iterable) and not isinstance(overrides, str | Mapping):
        texts = list(overrides)
        if all(isinstance(text, str) for text in texts):
            return texts
    raise TypeError(
        f"overrides = {overrides!r:.80}: expected a list of texts, such as ['sim-time-limit=10s']"
    )


class _Reader:
    def __init__(self, ini: IniFile) -> None:
        self._ini = ini

    def read(self, file: Path, section: str, asked_by: Source | None, including: tuple[Path, ...]) -> None:
        """Read one file into `section`, up to its first heading."""
        headings: dict[str, int] = {}
        text = _text_of(file, asked_by)  # what cannot be read has no other name either
        resolved = file.resolve()
        if resolved in including:
            raise ConfigError(f"{file} includes itself; expected another file", asked_by)
        if len(including) > _DEEPEST:
            raise ConfigError(f"more than {_DEEPEST} files in a row include each other", asked_by)
        for number, line in _logical_lines(file, text):
            source = Source(file, number)
            if line.startswith("["):
                section = self._open_section(line, source, headings)
            elif match := re.match(r"include\s+(?!=)(.*)", line):
                included = file.parent / match.group(1).strip().strip('"')
                self.read(included, section, source, (*including, resolved))
            else:
                self._ini.sections[section].entries.append(_entry(line, source, section))

    def _open_section(self, line: str, source: Source, headings: dict[str, int]) -> str:
        match = _HEADING.fullmatch(line)
        if not match or line.split() == ["[Config", "General]"]:
            raise ConfigError(f"`{line}` is no heading; expected [General] or [Config NAME]", source)
        name = match.group(1)
        if {"/", "\\"} & set(name):
            raise ConfigError(
                f"`{name}` cannot be part of a file's name, as those of configurations are;"
                " expected no `/` and no `\\`",
                source,
            )
        if name in headings:
            raise ConfigError(
                f"section `{name}` is already at line {headings[name]}; expected each once in a file",
                source,
            )
        headings[name] = source.line
        section = self._ini.sections.setdefault(name, Section(name, source))
        if section.source.line == 0:
            section.source = source
        return name


def _text_of(file: Path, asked_by: Source | None) -> str:
    try:
        data = file.read_bytes()
    except OSError as error:
        reason = "no such file" if isinstance(error, FileNotFoundError) else error.strerror or str(error)
        raise ConfigError(
            f"{file}: {reason}", asked_by, expected="an .ini file", suggestion=nearest_file(file, (".ini",))
        ) from error
    zero = data.find(b"\0")  # of UTF-16, say; no name of a file has one
    if zero >= 0:
        line = data.count(b"\n", 0, zero) + 1
        raise ConfigError("this line has a zero byte; expected UTF-8", Source(file, line))
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise ConfigError("this line is not UTF-8; expected UTF-8", Source(file, line)) from error


def _logical_lines(file: Path, text: str) -> Iterator[tuple[int, str]]:
    """Lines without comments and with their continuations, each with the number of its first line."""
    current: tuple[int, str] | None = None
    for number, raw in _joined_lines(text):
        source = Source(file, number)
        if sign := re.match(r"\s*(;|//)", raw):
            raise ConfigError(f"`{sign[1]}` starts no comment here; expected `#`", source)
        line = _without_comment(raw, source)
        if not line.strip():
            continue
        if line[0] not in " \t":
            if current:
                yield current
            current = (number, line.rstrip())
        elif current is None or current[1].startswith("["):
            raise ConfigError(
                "an indented line continues the entry above it, and there is none; expected column 1",
                source,
            )
        elif _LIKE_AN_ENTRY.match(line.strip()):
            raise ConfigError(
                f"an indented line continues the entry above it, that of line {current[0]}; expected"
                " a new entry in column 1",
                source,
            )
        else:
            current = (current[0], f"{current[1]}\n{line.strip()}")
    if current:
        yield current


def _joined_lines(text: str) -> Iterator[tuple[int, str]]:
    """Physical lines, those that end in a backslash joined with the next."""
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
    """Cut a comment off; `#` between quotes is none."""
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
        raise ConfigError('a text in quotes does not end on its line; expected a closing `"`', source)
    return line


def _entry(line: str, source: Source, section: str) -> Entry:
    key, equals, text = (part.strip() for part in line.partition("="))
    if not equals or not key:
        raise ConfigError(f"`{line}` is no entry; expected `key = value`", source)
    if not text:
        raise ConfigError(f"`{key}` has no value; expected `{key} = value`", source)
    _refuse_variables(key, source)
    return Entry(key, text, Source(source.file, source.line, key, text.replace("\n", " ")), section)


def _refuse_variables(key: str, source: Source) -> None:
    if "${" in key:
        raise ConfigError(f"`{key}` has a variable; expected `${{...}}` in values only", source)
