"""Lint checks: settings that are valid but probably not intended. They do not stop a run."""

import re
from collections import Counter, deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.errors import BadValue, Source
from gradysim.scenario.node_spec import NodeSpec
from gradysim.scenario.parse.expressions import ParameterContext, differs_between_parameters, parse_value
from gradysim.scenario.parse.ini import Entry, Section
from gradysim.scenario.parse.patterns import Pattern, PatternIndex, compile_pattern
from gradysim.scenario.parse.units import Dimension, Quantity
from gradysim.scenario.resolve.runs import UnreadVariables
from gradysim.scenario.scenario import Scenario
from gradysim.scenario.schema.keys import (
    BAND_BESIDE_FREQUENCY,
    BAND_OF_CHANNEL,
    CENTER_FREQUENCY,
    STATIONARY,
    has_radios,
)
from gradysim.scenario.schema.options import is_ignored, is_option
from gradysim.scenario.schema.parameters import annotations_of, unit_of


@dataclass(frozen=True)
class Finding:
    """A line that is valid but probably not intended.

    Attributes:
        source: The line.
        message: What is wrong and what is expected, without the source.
    """

    source: Source
    message: str

    @property
    def file(self) -> Path:
        """The file of the line."""
        return self.source.file

    @property
    def line(self) -> int:
        """The number of the line; 0 for an override."""
        return self.source.line

    @property
    def key(self) -> str:
        """The key of the line, as written."""
        return self.source.key

    def __str__(self) -> str:
        return f"{self.source}: warning: {self.message}"


def by_line(findings: Iterable[Finding]) -> list[Finding]:
    """Return findings without repetitions, in the order of their files and lines."""
    return sorted(dict.fromkeys(findings), key=lambda finding: (finding.file, finding.line))


def source_beside(source: Source, other: Source) -> str:
    """Return how a message at `source` names another line: "line 7, `*.key`,", or its full source."""
    if other.is_override:
        return f"`{other}`"
    is_near = other.file == source.file and not source.is_override
    return f"{f'line {other.line}' if is_near else other}, `{other.key}`,"


def lint(scenarios: Sequence[Scenario]) -> list[Finding]:
    """Check the lines of a configuration, given the scenarios of its runs. Both modes have these findings."""
    first = scenarios[0]
    medium = first.medium.get("typename")
    has_powers = medium is None or has_radios(medium.value)
    findings = shadowed_lines(first.sections, has_powers=has_powers)
    findings += unread_variables(first.unread_variables, first.lines)
    for nodes in {id(scenario.nodes): scenario.nodes for scenario in scenarios}.values():
        findings += bands_beside_frequencies(nodes)
        findings += doubtful_times(nodes)
        findings += nodes_on_one_point(nodes)
    return by_line(findings)


# Shadowed lines: `**.speed = ...`, then `*.uavs[0].mobility.speed = ...`. The first line that fits is in
# force, as in OMNeT++. Lines in different sections or files are meant to be overridden.

_NO_DOT = "\0\0\0"
"""Stands for what a wildcard within one name matches. `*` matches it; a range and a name do not."""

_ANYTHING = ".".join([_NO_DOT] * 10)
"""Stands for what `**` matches. It is longer than any path, so that no row of `*` matches it."""

_INSTEAD: dict[str, tuple[str, ...]] = {
    "channelNumber": ("centerFrequency",),
    "centerFrequency": ("channelNumber",),
    "protocol.class": ("protocol.typename",),
    "protocol.typename": ("protocol.class",),
} | {
    end: others
    for axis in "XYZ"
    for end, others in {
        f"initial{axis}": (f"lineStart{axis}", f"lineStep{axis}", f"separation{axis}"),
        f"lineStart{axis}": (f"initial{axis}", f"separation{axis}"),
        f"lineStep{axis}": (f"initial{axis}", f"separation{axis}"),
        f"separation{axis}": (f"initial{axis}", f"lineStart{axis}", f"lineStep{axis}"),
    }.items()
}
"""{end of a key: ends of other keys that set the same thing}."""

INSTEAD_WITH_POWERS = _INSTEAD | {
    "transmitter.power": ("transmitter.communicationRange",),
    "transmitter.communicationRange": ("transmitter.power",),
    "communicationRange": ("transmitter.power",),
}
"""The same for media where a range stands for the power that it takes."""

_NONE_BY_DEFAULT = ("transmitter.power", "communicationRange", "protocol.class", "protocol.typename")
"""Ends of keys whose default says nothing about the other key."""

_COUNT = re.compile(r"(.*\.)(?:num([A-Z])(\w*)|([a-z])(\w*)\.count)", re.ASCII)
"""`*.numUavs` and `*.uavs.count`."""


def shadowed_lines(sections: Iterable[Section], *, has_powers: bool = True) -> list[Finding]:
    """Return lines that have no effect because a line above them fits as well.

    Args:
        sections: Sections that make a valid scenario.
        has_powers: Whether the radio medium knows powers. Otherwise a range is only a range.
    """
    instead = INSTEAD_WITH_POWERS if has_powers else _INSTEAD
    return [finding for section in sections for finding in _shadowed_in(section, instead)]


def _shadowed_in(section: Section, instead: Mapping[str, Sequence[str]]) -> Iterator[Finding]:
    lines = _LinesAbove(instead)
    for entry in section.entries:
        if is_ignored(entry):
            continue
        above = lines.in_force(entry)
        if above is None:
            lines.add(entry)
        elif above.source.file == entry.source.file:
            why = "fits as well and comes first; expected the special line above the general one"
            if above.key in (entry.key, *keys_instead(entry.key, instead)):
                why = "says the same thing and comes first; expected one of them"
            where = source_beside(entry.source, above.source)
            yield Finding(entry.source, f"`{entry.key}` has no effect: {where} {why}")


class _LinesAbove:
    """The lines above another one. `instead` has the other keys that set the same thing."""

    def __init__(self, instead: Mapping[str, Sequence[str]]) -> None:
        self._instead = instead
        self._same_key: dict[str, Entry] = {}
        self._general: PatternIndex[Entry] = PatternIndex()

    def add(self, entry: Entry) -> None:
        """Add a line below the others."""
        self._same_key.setdefault(entry.key, entry)
        pattern = compile_pattern(entry.key)
        if not is_option(entry) and _is_general(pattern):
            self._general.add(pattern, entry)

    def in_force(self, entry: Entry) -> Entry | None:
        """Return the line that is in force wherever `entry` fits, if it says something else."""
        for key in (entry.key, *keys_instead(entry.key, self._instead)):
            above = self._same_key.get(key) or _first_that_covers(compile_pattern(key), self._general)
            if above is None or (above.text == entry.text and (key == entry.key or _COUNT.fullmatch(key))):
                continue
            if key == entry.key or above.text != "default" or not key.endswith(_NONE_BY_DEFAULT):
                return above
        return None


def keys_instead(key: str, instead: Mapping[str, Sequence[str]]) -> list[str]:
    """Return the other keys that set the same thing."""
    if match := _COUNT.fullmatch(key):
        network, initial, rest, small_initial, others = match.groups()
        if initial:
            return [f"{network}{initial.lower()}{rest}.count"]
        return [f"{network}num{small_initial.upper()}{others}"]
    return [
        key.removesuffix(end) + other
        for end, others in instead.items()
        if key.endswith(f".{end}")
        for other in others
    ]


def _is_general(pattern: Pattern) -> bool:
    """Return whether the pattern may match more than one parameter of one node."""
    parts = pattern.split()
    return parts is None or any(part.literal is None for part in parts[1:])


def _first_that_covers(pattern: Pattern, above: PatternIndex[Entry]) -> Entry | None:
    """Return the first of the lines above that fits wherever `pattern` does."""
    path = "".join(
        token.literal or (_ANYTHING if token.spans_dots else _example_of(token.text))
        for token in pattern.tokens
    )
    return next(iter(above.matching(path)), None)


def _example_of(wildcard: str) -> str:
    """Return an example of a wildcard within one name. A range keeps its brackets: `[*]` covers `[0..3]`."""
    return f"[{_NO_DOT}]" if wildcard.startswith("[") else _NO_DOT


def unread_variables(unread: Iterable[UnreadVariables], lines: Sequence[Entry]) -> list[Finding]:
    """Return lines that iterate over values that no run reads, so that the runs are alike.

    `**.rtsThreshold = ${rts=3000B, 100B}` is an example, if a line with another key overrides it. `lines` are
    those of the configuration in the order of the search.
    """
    findings = []
    for each in unread:
        source = each.source
        instead = each.instead or _line_above_in_force(source, lines)
        why = "; expected a line that some run reads"
        if instead is not None:
            where = source_beside(source, instead)
            why = f": {where} is in force; expected an override with the same key, which makes no such runs"
        variables = " and ".join(f"${name}" for name in each.names)
        text = f"no run reads `{source.key}`, and runs that differ in {variables} alone are alike{why}"
        findings.append(Finding(source, text))
    return findings


def _line_above_in_force(source: Source, lines: Sequence[Entry]) -> Source | None:
    """Return the line that is in force instead, by whatever key, in any section or file."""
    above = _LinesAbove(INSTEAD_WITH_POWERS)
    for line in lines:
        if line.source == source:
            found = above.in_force(line)
            return found.source if found else None
        if not is_ignored(line):
            above.add(line)
    return None


def bands_beside_frequencies(nodes: Iterable[NodeSpec]) -> list[Finding]:
    """Return each `radio.bandName` that no interface reads, since `radio.centerFrequency` is set, too."""
    unread: dict[Source, Source] = {}
    read: set[Source] = set()
    for wlan in {id(wlan): wlan for spec in nodes for wlan in spec.wlan}.values():
        carrier = wlan.radio.get(CENTER_FREQUENCY.field)
        beside = wlan.band.get(BAND_BESIDE_FREQUENCY.field)
        if carrier is not None and beside is not None:
            unread.setdefault(beside.source, carrier.source)
        in_use = (carrier, wlan.band.get(BAND_OF_CHANNEL.field))
        read.update(setting.source for setting in in_use if setting is not None)
    return [
        Finding(
            band,
            f"`{band.key}` has no effect: {source_beside(band, center)} selects the channel; expected one of"
            " them, or a channelNumber in that band",
        )
        for band, center in unread.items()
        if band not in read
    ]


def nodes_on_one_point(nodes: Sequence[NodeSpec]) -> list[Finding]:
    """Return the line of the first of several nodes that stand on one point, and cannot leave it.

    Nodes that can move often start together.
    """
    at_point: dict[tuple[float, float, float], list[NodeSpec]] = {}
    for spec in nodes:
        typename = spec.mobility.get("typename")
        if typename is not None and typename.value == STATIONARY:
            at_point.setdefault(spec.initial_position, []).append(spec)
    findings = []
    for point, together in at_point.items():
        source = together[0].protocol_sources.get("") if len(together) > 1 else None
        if source is not None:
            first, second, *others = (spec.name for spec in together)
            names = f"{first} and {second}" if not others else f"{first}, {second} and {len(others)} more"
            where = ", ".join(f"{coordinate:g}" for coordinate in point)
            findings.append(
                Finding(
                    source,
                    f"{names} stand on one point, ({where}) m; expected a place for each, such as"
                    f" `*.{together[0].group}[*].mobility.lineStepX = 10m`",
                )
            )
    return findings


# Doubtful times: `interval = 5m` is five meters. A minute is `min`. Parameters whose unit is declared refuse
# quantities of another kind. Only their names tell what the other parameters measure.

_ENDS_OF_TIMES = ("interval", "timeout", "period", "delay", "duration")

_NAMES_OF_TIMES = ("jitter", "spread", "offset")
"""Names of times, unless another word stands before them."""

_METERS_IN_A_LIST = re.compile(r"[\d.]\s*m\b|\{[^{},.]*[,.][^{}]*\}\s*m\b", re.ASCII)
"""`${5m, 10m}`, `${5, 10}m` and `${5..10}m`, but not `${runnumber}m`."""


def doubtful_times(nodes: Iterable[NodeSpec]) -> list[Finding]:
    """Return lines that give a protocol parameter with the name of a time another unit."""
    findings: dict[Source, Finding] = {}
    seen: set[int] = set()  # nodes with the same lines in force share their sources
    for spec in nodes:
        is_new = id(spec.protocol_sources) not in seen
        seen.add(id(spec.protocol_sources))
        for name, source in spec.protocol_sources.items():
            if source in findings or not (is_new or differs_between_parameters(source.value)):
                continue
            folded = name.casefold()
            if folded not in _NAMES_OF_TIMES and not folded.endswith(_ENDS_OF_TIMES):
                continue
            unit = _unit_other_than_time(source.value, f"{spec.name}.protocol.{name}")
            if unit and unit_of(spec.protocol, name) is None:
                hint = "; a minute is `min`" if unit == "m" else ""
                declaration = f'`{name}: Annotated[float, "{unit}"]` in {spec.protocol.__name__}'
                findings[source] = Finding(
                    source,
                    f"`{name}` is given in `{unit}`, but has the name of a time{hint} (if it is not a time,"
                    f" declare it: {declaration})",
                )
    return list(findings.values())


def _unit_other_than_time(text: str, path: str) -> str:
    """Return the name of the unit of a value; "" if it has none or is a time."""
    try:
        value = parse_value(text, ParameterContext(0, path))
    except BadValue:  # with a variable in it, or a list of values
        return "m" if "${" in text and '"' not in text and _METERS_IN_A_LIST.search(text) else ""
    if not isinstance(value, Quantity) or value.unit is None or value.unit.dimension is Dimension.TIME:
        return ""
    return value.unit.name


class RunLint:
    """Checks of a run that need its protocols: overwritten parameters, and containers shared by all nodes."""

    def __init__(self, scenario: Scenario) -> None:
        """Note the mutable containers in the class bodies. No protocol of the run must exist yet."""
        self._nodes = scenario.nodes
        self._overwritten: dict[tuple[type, str], Finding] = {}
        counts = Counter(spec.protocol for spec in self._nodes)
        first = {spec.protocol: spec for spec in reversed(self._nodes)}
        users: dict[type, list[type[IProtocol]]] = {}
        for protocol in counts:
            for cls in protocol.__mro__:
                users.setdefault(cls, []).append(protocol)
        self._containers = [
            (first[protocols[0]], cls, name, value, _elements(value))
            for cls, protocols in users.items()
            if sum(counts[protocol] for protocol in protocols) > 1
            for name, value in vars(cls).items()
            if isinstance(value, list | dict | set | deque) and _is_shared_by_accident(cls, name)
        ]

    def after_initialize(self, protocols: Iterable[IProtocol]) -> None:
        """Compare the parameters of all protocols, in the order of the nodes, with those of the .ini file."""
        for spec, protocol in zip(self._nodes, protocols, strict=True):
            for name, given in spec.protocol_parameters.items():
                value = getattr(protocol, name, given)
                if type(value) is not type(given) or value == given:
                    continue
                source = spec.protocol_sources.get(name)
                if source is not None and (spec.protocol, name) not in self._overwritten:
                    self._overwritten[spec.protocol, name] = Finding(
                        source,
                        f"`{name}` of {spec.protocol.__name__} is {value!r} after `initialize`, which"
                        f" replaces the value {given!r} of this line; expected its default in the class body"
                        f" alone, `{name} = ...`, and another name for a value computed from it",
                    )

    def findings(self) -> list[Finding]:
        """Return what was found up to now, once per class and parameter or container."""
        changed = [
            Finding(
                spec.protocol_sources.get("", Source(Path(cls.__module__), 0)),
                f"`{name}` in the class body of {cls.__name__} is one {type(value).__name__} for all nodes,"
                f" and the run changed it; expected `self.{name} = ...` in `initialize`, or"
                f" `{name}: ClassVar[...]` if the nodes are meant to share it",
            )
            for spec, cls, name, value, before in self._containers
            if not _is_same(before, _elements(value))
        ]
        return by_line([*self._overwritten.values(), *changed])


def _is_shared_by_accident(cls: type, name: str) -> bool:
    is_class_variable = "ClassVar" in str(annotations_of(cls).get(name, ""))
    return not name.startswith("__") and not is_class_variable


def _elements(container: Iterable[object]) -> list[object]:
    """Return what is in a container, and for a dict its values, too."""
    return [*container, *(container.values() if isinstance(container, dict) else ())]


def _is_same(before: Sequence[object], after: Sequence[object]) -> bool:
    return len(before) == len(after) and all(map(lambda one, other: one is other, before, after))
