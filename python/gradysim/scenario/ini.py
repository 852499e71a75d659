"""Reads .ini files: lines, includes, sections and entries, and the sections of a configuration.

This module does not know what keys mean. The grammar is that of OMNeT++: content starts in column 1, an
indented line continues the line above it, a backslash at the end of a line joins it with the next line, and
`#` outside of quotes starts a comment. `search_order` gives the sections of a configuration: its own, those
that it extends, and [General].
"""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from gradysim.scenario.errors import (
    OF_SCRIPT,
    BadValue,
    ConfigError,
    ErrorCollector,
    Source,
    nearest,
    nearest_file,
    shortened,
)
from gradysim.scenario.regular_files import check_regular

GENERAL = "General"
"""The section that every configuration falls back on; entries before the first section go there."""

_HEADING = re.compile(r"\[\s*(?:Config\s+)?([^\s\[\]]+)\s*\]")

_DEEPEST = 100
"""Limit for nested includes and for chains of sections; Python's stack has such a limit, too."""

_MOST_BYTES = 64 * 2**20
"""Of a file with all that it includes."""

_MOST_INCLUDES = 1000
"""Files that a file includes. Two files that each include two others, and so on, would be too many."""

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
    """An .ini file with all that it includes. It always has a section General."""

    file: Path
    sections: dict[str, Section]


def read_ini(file: Path) -> IniFile:
    """Read a file and all that it includes.

    Raises:
        ConfigError: A file cannot be read, or lines are not understood; all of them are reported.
    """
    reader = _Reader(file)
    reader.read(file, GENERAL, None, ())
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

    def read(self, file: Path, section: str, asked_by: Source | None, including: tuple[Path, ...]) -> None:
        """Read one file into `section`, up to its first heading."""
        headings: dict[str, int] = {}
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
                    included = file.parent / match.group(1).strip().strip('"')
                    self.read(included, section, source, (*including, resolved))
                else:
                    self.ini.sections[section].entries.append(_entry(line, source))

    def _open_section(self, line: str, source: Source, headings: dict[str, int]) -> str:
        match = _HEADING.fullmatch(line)
        if not match or line.split() == ["[Config", "General]"]:
            problem = f"`{shortened(line)}` is not a heading"
            raise ConfigError(problem, source, expected="[General] or [Config NAME]")
        name = match.group(1)
        if {"/", "\\"} & set(name):
            raise ConfigError(
                f"`{shortened(name)}` cannot be part of a file name", source, expected="no `/` and no `\\`"
            )
        if name in headings:
            raise ConfigError(
                f"section `{shortened(name)}` is already at line {headings[name]}",
                source,
                expected="each section once in a file",
            )
        headings[name] = source.line
        section = self.ini.sections.setdefault(name, Section(name, source))
        if section.source.line == 0:
            section.source = source
        return name

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


def _bytes_of(file: Path, asked_by: Source | None, most: int) -> bytes:
    try:
        check_regular(file, str(file) if asked_by else "it")
        with file.open("rb") as opened:
            return opened.read(most)
    except BadValue as error:
        raise ConfigError(error.problem, asked_by or Source(file, 0), expected=error.expected) from error
    except OSError as error:
        reason = "no such file" if isinstance(error, FileNotFoundError) else error.strerror or str(error)
        raise ConfigError(
            f"{file}: {reason}", asked_by, expected="an .ini file", suggestion=nearest_file(file, (".ini",))
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


_MAX_NAMES = 20
"""Configurations that a message lists."""


def search_order(ini: IniFile, config: str) -> list[Section]:
    """Return the configuration's own section, then its bases by C3 linearization, then [General].

    Raises:
        ConfigError: The configuration does not exist, it is abstract, or its bases cannot be ordered.
    """
    if config not in ini.sections:
        names = config_names(ini)
        raise ConfigError(
            f"no configuration `{config}`",
            Source(ini.file, 0),
            expected=f"one of {', '.join(names)}",
            suggestion=nearest(config, names),
        )
    section = ini.sections[config]
    if (abstract := _own_option(section, "abstract")) and _is_true(abstract):
        heirs = [name for name in config_names(ini) if name != config]
        raise ConfigError(
            f"configuration `{config}` is abstract",
            abstract.source,
            expected=f"one of {', '.join(heirs) or 'those that extend it'}",
        )
    names = [name for name in _linearize(ini, config, (), {}) if name != GENERAL]
    return [ini.sections[name] for name in [*names, GENERAL]]


def entries_in_order(overrides: Iterable[Entry], sections: Iterable[Section]) -> list[Entry]:
    """Return all entries of a configuration in search order, with the ranks of their sections."""
    of_sections = (
        replace(entry, rank=rank) for rank, section in enumerate(sections, 1) for entry in section.entries
    )
    return [*overrides, *of_sections]


def config_names(ini: IniFile) -> list[str]:
    """Return the configurations that can be run, in the order of the file; General only if it is alone."""
    names = [
        name
        for name, section in ini.sections.items()
        if name != GENERAL and not ((entry := _own_option(section, "abstract")) and _is_true(entry))
    ]
    return names or [GENERAL]


def unused_sections(ini: IniFile, used: Sequence[Section]) -> list[str]:
    """Return the sections that are not in `used` and that no section extends."""
    extended = {
        base.strip()
        for section in ini.sections.values()
        if (entry := _own_option(section, "extends"))
        for base in entry.text.split(",")
    }
    names = {section.name for section in used} | extended
    return [name for name in ini.sections if name not in names]


def _linearize(ini: IniFile, name: str, heirs: tuple[str, ...], known: dict[str, list[str]]) -> list[str]:
    """Return a section and its bases in order. `heirs` lead to it; `known` are the orders found before."""
    if name in known:
        return known[name]
    section = ini.sections[name]
    extends = _own_option(section, "extends")
    if extends is None or name == GENERAL:
        if extends is not None:
            raise ConfigError("[General] is the base of all", extends.source, expected="no `extends` in it")
        return [name]
    bases = _bases(ini, extends)
    if cycle := [base for base in bases if base == name or base in heirs]:
        text = f"`{name}` extends itself through `{cycle[0]}`"
        raise ConfigError(text, extends.source, expected="no cycle")
    if len(heirs) == _DEEPEST:
        raise ConfigError(
            f"more than {_DEEPEST} sections in a row extend each other", extends.source, expected="fewer"
        )
    chains = [_linearize(ini, base, (*heirs, name), known) for base in bases]
    merged = _merge([*chains, bases])
    if merged is None:
        raise ConfigError(
            f"the bases of `{name}` contradict each other in their order",
            extends.source,
            expected="one order everywhere",
        )
    known[name] = [name, *merged]
    return known[name]


def _merge(chains: list[list[str]]) -> list[str] | None:
    """Merge chains as C3 does: take the first head that is in no tail. None if there is none."""
    merged: list[str] = []
    remaining = [list(chain) for chain in chains if chain]
    while remaining:
        for chain in remaining:
            head = chain[0]
            if not any(head in other[1:] for other in remaining):
                break
        else:
            return None
        merged.append(head)
        remaining = [rest for chain in remaining if (rest := [name for name in chain if name != head])]
    return merged


def _bases(ini: IniFile, extends: Entry) -> list[str]:
    bases = [base.strip() for base in extends.text.split(",")]
    for base in bases:
        if base not in ini.sections:
            raise ConfigError(
                f"extends `{base}`",
                extends.source,
                expected="the name of a section",
                suggestion=nearest(base, ini.sections),
            )
    if len(set(bases)) < len(bases):
        raise ConfigError.at(extends.source, "a section is repeated", expected="each section once")
    return bases


def _own_option(section: Section, name: str) -> Entry | None:
    return next((entry for entry in section.entries if entry.key == name), None)


def _is_true(entry: Entry) -> bool:
    if entry.text not in ("true", "false"):
        raise ConfigError.at(entry.source, f"`{entry.text}` is not a boolean", expected="true or false")
    return entry.text == "true"


def what_to_run_instead(ini: IniFile, config: str, sections: Sequence[Section], name: str) -> str:
    """Return the end of a message about an incomplete configuration: a misspelled section, or the others.

    `name` is the option for the name of a configuration.
    """
    unused = unused_sections(ini, sections)
    general_is_empty = not ini.sections[GENERAL].entries
    match = nearest(GENERAL, unused) if general_is_empty else ""
    if match:
        return f"; [{match}] at line {ini.sections[match].source.line} is not used: did you mean [{GENERAL}]?"
    names = config_names(ini)
    if config in names:
        return ""
    listed = ", ".join(names[:_MAX_NAMES]) + (", …" if len(names) > _MAX_NAMES else "")
    return f"; or run another configuration of the file: `{name} NAME`, {listed}"
