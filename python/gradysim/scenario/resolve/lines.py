"""The lines of a configuration and their rows: the only place that matches patterns.

A path has two parts: the name below the network (`uavs[3]`) and the rest (`mobility.speed`). The key of a
line is taken apart in the same way. The name of each subject is matched once with each pattern of a name, and
the paths of a schema once with each pattern of a rest, so that a thousand nodes cost little more than one.
"""

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from operator import attrgetter
from typing import NamedTuple

from gradysim.scenario.errors import BadValue, ConfigError, ErrorCollector
from gradysim.scenario.parse.expressions import differs_between_parameters
from gradysim.scenario.parse.ini import Entry
from gradysim.scenario.parse.patterns import Pattern, compile_pattern
from gradysim.scenario.schema.engine_keys import Key
from gradysim.scenario.schema.options import is_ignored, is_option, network_name
from gradysim.scenario.schema.values import Setting, SettingReader

_ANY_NAME = compile_pattern("*")


@dataclass(frozen=True, eq=False)
class Line:
    """A line that sets parameters.

    Attributes:
        order: Its position in the order of the search; of the lines that match, the first is in force.
        entry: The line as it is written, with values instead of variables.
        pattern: Its key, compiled.
        parts: The patterns of the network, of the name below it and of the rest, which may be missing; None
            if `**` leaves open where they end.
        differs: Whether its value differs between parameters: it is drawn, or depends on an index.
    """

    order: int
    entry: Entry
    pattern: Pattern
    parts: list[Pattern] | None
    differs: bool

    @property
    def is_default(self) -> bool:
        """Whether it says `default`, which stops the search and leaves the default."""
        return self.entry.text == "default"

    def overrides(self, other: "Line") -> bool:
        """Return whether it comes before the other from another section or file, so on purpose."""
        return not self.stands_with(other) and self.order < other.order

    def stands_with(self, other: "Line") -> bool:
        """Return whether both are in one section of one file."""
        here, there = ((line.entry.rank, line.entry.source.file) for line in (self, other))
        return here == there

    @property
    def name_pattern(self) -> Pattern | None:
        """The part that names something below the network, if it is certain."""
        return self.parts[1] if self.parts else None

    @property
    def rest_pattern(self) -> Pattern | None:
        """The part below that name, if there is one and it is certain."""
        return self.parts[2] if self.parts and len(self.parts) == 3 else None


class Row(NamedTuple):
    """A parameter that lines are about.

    Attributes:
        key: The parameter.
        path: Its path below the subject, such as `wlan[1].radio.transmitter.power`.
        own: Lines in the order of the search: those about this subject alone, or all if `general` is None.
        general: The row of other lines, which many subjects share.
    """

    key: Key
    path: str
    own: tuple[Line, ...] = ()
    general: "Row | None" = None

    @property
    def line(self) -> Line:
        """The line in force: the first of all."""
        if self.general is None:
            return self.own[0]
        return min(self.own[0], self.general.own[0], key=_order)

    @property
    def lines(self) -> tuple[Line, ...]:
        """All lines in the order of the search. The first is in force and hides the others."""
        if self.general is None:
            return self.own
        return tuple(sorted({*self.own, *self.general.own}, key=_order))


_order = attrgetter("order")

Rows = Mapping[str, Row]
"""The rows of one subject by path, in the order of its schema."""


class Schema:
    """The keys of a kind of subject by their paths, which are found by a pattern."""

    def __init__(self, keys: Mapping[str, Key]) -> None:
        """Take the keys by path; the path `""` is that of the subject itself."""
        self.keys = keys
        self._indices = {path: index for index, path in enumerate(keys)}
        self._by_name: dict[str, list[str]] = {}  # by each name in it, and by `wlan[` for `wlan[0]`
        self._by_tail: dict[str, list[str]] = {}
        for path in keys:
            names = path.split(".")
            self._by_tail.setdefault(names[-1], []).append(path)
            for name in {*names, *(f"{name.partition('[')[0]}[" for name in names if "[" in name)}:
                self._by_name.setdefault(name, []).append(path)

    def matching(self, pattern: Pattern | None, prefix: str) -> Sequence[str]:
        """Return the paths that match if `prefix` precedes them; `""` alone for a missing pattern."""
        if pattern is None:
            return [""] if "" in self.keys else []
        if pattern.literal is not None and not prefix:
            return [pattern.literal] if pattern.literal and pattern.literal in self.keys else []
        paths = self.may_match(pattern)
        if pattern.landmark:
            paths = min(paths, self._by_name.get(pattern.landmark, ()), key=len)
        return [path for path in paths if path and pattern.matches(prefix + path)]

    def in_order(self, rows: Mapping[str, Row]) -> Rows:
        """Return rows by path in the order of the keys."""
        return {path: rows[path] for path in sorted(rows, key=self._indices.__getitem__)}

    def may_match(self, pattern: Pattern) -> Collection[str]:
        """Return the paths that can match with something before them, judged by their last names."""
        tail = pattern.tail
        return self.keys if tail is None or tail.literal is None else self._by_tail.get(tail.literal, ())


class Names(NamedTuple):
    """The patterns that match the name of a subject. Subjects with equal ones have the same rows.

    Attributes:
        general: The ids of those that match several names.
        literal: The name, if lines are about it alone; otherwise "".
    """

    general: tuple[str, ...]
    literal: str


def id_of(name: Pattern) -> str:
    """Return an id of the pattern of a name, which is `=` and the name if it is one name alone."""
    return name.text if name.literal is None else f"={name.literal}"


class _Reading(NamedTuple):
    """A line whose key ends so for subjects whose name has a certain pattern."""

    line: Line
    rest: Pattern | None
    prefix: str


class Lines:
    """The lines of a configuration that set parameters, in the order of the search.

    Attributes:
        network: What paths begin with.
        all: The lines, without those that only OMNeT++ reads.
    """

    def __init__(self, entries: Sequence[Entry]) -> None:
        """Index the entries. Raises ConfigError for all bad patterns."""
        self.network = network_name(entries)
        self.all: list[Line] = []
        errors = ErrorCollector()
        for order, entry in enumerate(entries):
            if not is_option(entry) and not is_ignored(entry):
                with errors.collecting():
                    self.all.append(_compiled(order, entry))
        errors.raise_all()
        self._readings: dict[str, list[_Reading]] = {}  # by the pattern of the name
        self._general: dict[str, Pattern] = {}
        self._of_group: dict[str, list[Pattern]] = {}
        self._names: dict[str, Names] = {}
        self._alike: dict[Names, Names] = {}  # each once, for a million nodes
        self._uncertain: list[Line] = []
        self._matching: dict[tuple[Schema, str | None, str], Sequence[str]] = {}
        self._rows: dict[tuple[tuple[str, ...], Schema], Rows] = {}
        for line in self.all:
            self._add(line)

    def _add(self, line: Line) -> None:
        if line.parts is not None:
            if line.parts[0].matches(self.network):
                self._read(line.parts[1], _Reading(line, line.rest_pattern, ""))
        elif (below := line.pattern.below_anything) is not None:
            name, rest = below
            self._read(name, _Reading(line, rest, ""))
            self._read(_ANY_NAME, _Reading(line, line.pattern, "."))
        elif (parts := line.pattern.below_any_name) is not None:
            if parts[0].matches(self.network):
                self._read(_ANY_NAME, _Reading(line, parts[1], "."))
        else:
            self._uncertain.append(line)

    def _read(self, name: Pattern, reading: _Reading) -> None:
        self._readings.setdefault(id_of(name), []).append(reading)
        if name.literal is None:
            self._general.setdefault(id_of(name), name)

    def names(self, name: str) -> Names:
        """Return the patterns that match the name of a subject."""
        known = self._names.get(name)
        if known is not None:
            return known
        group = name.partition("[")[0]
        of_group = self._of_group.get(group)
        if of_group is None:
            all_of_them = self._general.values()
            of_group = self._of_group[group] = [each for each in all_of_them if each.group in (None, group)]
        general = tuple([id_of(pattern) for pattern in of_group if pattern.matches(name)])
        is_alone = f"={name}" in self._readings or bool(self._uncertain)
        names = Names(general, name if is_alone else "")
        names = self._names[name] = self._alike.setdefault(names, names)
        return names

    def patterns_of(self, names: Iterable[str]) -> set[str]:
        """Return the ids of the patterns that match one of the names; those of names alone included."""
        found: set[str] = set()
        for general, literal in map(self.names, names):
            found.update(general)
            if literal:
                found.add(f"={literal}")
        return found

    def rows(self, names: Names, schema: Schema) -> Rows:
        """Return the rows of the subjects with these names."""
        known = self._rows.get((names.general, schema))
        if known is None:
            found = self._found(names.general, schema)
            rows = {path: Row(schema.keys[path], path, tuple(lines)) for path, lines in found.items()}
            known = self._rows[names.general, schema] = schema.in_order(rows)
        if not names.literal:
            return known
        own = self._found([f"={names.literal}"], schema)
        for line in self._uncertain:
            for path in schema.may_match(line.pattern):
                if line.pattern.matches(".".join(filter(None, (self.network, names.literal, path)))):
                    own.setdefault(path, {})[line] = None
        if not own:
            return known
        rows = {
            path: Row(schema.keys[path], path, tuple(sorted(lines, key=_order)), known.get(path))
            for path, lines in own.items()
        }
        return schema.in_order({**known, **rows})

    def _found(self, names: Iterable[str], schema: Schema) -> dict[str, dict[Line, None]]:
        """Return the lines for each path in the order of the search, each once."""
        readings = [reading for name in names for reading in self._readings.get(name, ())]
        found: dict[str, dict[Line, None]] = {}
        for line, rest, prefix in sorted(readings, key=lambda reading: reading.line.order):
            for path in self._paths(schema, rest, prefix):
                found.setdefault(path, {})[line] = None
        return found

    def _paths(self, schema: Schema, rest: Pattern | None, prefix: str) -> Sequence[str]:
        known = (schema, None if rest is None else rest.text, prefix)
        paths = self._matching.get(known)
        if paths is None:
            paths = self._matching[known] = schema.matching(rest, prefix)
        return paths


def _compiled(order: int, entry: Entry) -> Line:
    try:
        pattern = compile_pattern(entry.key)
    except BadValue as error:
        text = f"{entry.key}: {error.problem}"
        raise ConfigError(text, entry.source, expected=error.expected, hint=error.hint) from error
    parts = pattern.split()
    differs = differs_between_parameters(entry.text)
    return Line(order, entry, pattern, parts if parts and len(parts) > 1 else None, differs)


def rows_in_force(struct: str, rows: Iterable[Row]) -> dict[str, Row]:
    """Return the row of each field of a struct. Of two keys for one field, the first line is in force."""
    first: dict[str, Row] = {}
    for row in rows:
        if row.key.struct == struct:
            other = first.get(row.key.field)
            if other is None or row.line.order < other.line.order:
                first[row.key.field] = row
    return first


def read_struct(
    struct: str, rows: Iterable[Row], settings: SettingReader, errors: ErrorCollector, prefix: str = ""
) -> dict[str, Setting]:
    """Return the fields of one struct that lines set. `errors` takes the errors of values.

    `prefix` is what precedes the paths of the rows in names of parameters, `uavs[3].`.
    """
    read: dict[str, Setting] = {}
    for field, row in rows_in_force(struct, rows).items():
        if not row.line.is_default:
            with errors.collecting():
                read[field] = settings.setting(row.line.entry, row.key.kind, prefix + row.path)
    return read
