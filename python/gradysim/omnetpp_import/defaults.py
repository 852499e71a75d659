"""What a file of OMNeT++ does not say: the defaults of its NED file, and lines that only the user knows."""

import contextlib
from collections.abc import Iterable, Iterator
from pathlib import Path

from gradysim.omnetpp_import.ned import NedNetwork, NedNode
from gradysim.omnetpp_import.outcome import Action, Outcome
from gradysim.omnetpp_import.protocol_lines import reference
from gradysim.omnetpp_import.tables import (
    CLASS_TO_WRITE,
    DEFAULT_MOBILITY,
    DEFAULT_PROTOCOL,
    MOBILITY_DEFAULTS,
    NODE_TYPES,
    NOT_MODELLED_NODES,
    VALUES,
)
from gradysim.scenario.errors import BadValue, Source
from gradysim.scenario.parse.functions import is_quoted, unquoted
from gradysim.scenario.parse.ini import Entry
from gradysim.scenario.parse.patterns import PatternIndex, compile_pattern
from gradysim.scenario.schema.keys import CIRCLE, PROTOCOL_CLASS, PROTOCOL_KEYS, RECTANGLE, engine_key

_MEDIA = engine_key("medium.typename").kind.names

_SOME_OTHER = 999_999
"""Index of a node that only lines for all nodes match."""


_NETWORK = "N"

Lines = PatternIndex[Entry]
"""Lines by the patterns of their keys; whatever network a line names is the one of the file."""


def indexed(entries: Iterable[Entry]) -> Lines:
    """Return lines by their patterns."""
    index = Lines()
    for entry in entries:
        network, dot, path = entry.key.partition(".")
        if dot:
            with contextlib.suppress(BadValue):  # not a pattern
                key = f"{_NETWORK}.{path}" if network.isidentifier() else entry.key
                index.add(compile_pattern(key), entry)
    return index


def translated_lines(outcomes: Iterable[Outcome]) -> Iterator[Entry]:
    """Yield the lines of the translated file, and those that the user writes."""
    return (
        Entry(key, text, outcome.entry.source if outcome.entry else Source(Path(), 0))
        for outcome in outcomes
        if outcome.action is not Action.NOT_MODELLED
        for key, equals, text in [outcome.text.partition(" = ")]
        if equals
    )


def defaults_of(network: NedNetwork, entries: Lines, lines: Lines, in_force: Lines) -> Iterator[Outcome]:
    """Yield the defaults of a network, except those that lines in force in all configurations override.

    Args:
        network: The network.
        entries: All lines of the file, as they were.
        lines: The translated lines.
        in_force: Those of the translated lines that are in force in all configurations of the network.
    """

    def default(path: str, first: str, value: str) -> Iterator[Outcome]:
        if not _is_set(first, in_force):
            yield Outcome(Action.ADDED, None, f"*.{path} = {value}", f"default of {network.source}")

    def not_modelled(path: str, typename: str, note: str) -> Outcome:
        line = f'*.{path} = "{typename}"'
        return Outcome(Action.NOT_MODELLED, None, line, f"default of {network.source}; {note}")

    medium = VALUES["radioMedium.typename"].get(network.medium, network.medium)
    if medium in _MEDIA:
        yield from default("radioMedium.typename", "radioMedium.typename", f'"{medium}"')
    elif medium and not _is_set("radioMedium.typename", in_force):
        yield not_modelled("radioMedium.typename", medium, f"expected one of {', '.join(_MEDIA)}")
    for node in network.nodes:
        if node.type in NOT_MODELLED_NODES:
            yield not_modelled(f"{node.written}.typename", node.type, NOT_MODELLED_NODES[node.type])
        size = network.sizes.get(node.size, node.size)
        if size.isdigit():
            yield from default(node.size_key, node.size_key, size)
        for path, value in NODE_TYPES[node.type].items():
            first = path.replace("[*]", "[0]")
            yield from default(f"{node.written}.{path}", f"{node.first}.{first}", value)
        mobility = _mobility(node, entries)
        typename = "mobility.typename"
        yield from default(f"{node.written}.{typename}", f"{node.first}.{typename}", f'"{DEFAULT_MOBILITY}"')
        for name, value in {
            **MOBILITY_DEFAULTS.get(mobility, {}),
            **_positions_of(node, mobility, entries, lines),
        }.items():
            yield from default(f"{node.written}.mobility.{name}", f"{node.first}.mobility.{name}", value)


def _mobility(node: NedNode, entries: Lines) -> str:
    """Return the first mobility that the file gives a node."""
    text = next(_texts_for(f"{node.first}.mobility.typename", entries), DEFAULT_MOBILITY)
    return unquoted(text) if is_quoted(text) else text


def _positions_of(node: NedNode, mobility: str, entries: Lines, lines: Lines) -> dict[str, str]:
    """Return {parameter: value} of where a node starts if no line says it."""
    if mobility in (CIRCLE, RECTANGLE):
        return {}
    reads_display = "false" not in _texts_for(f"{node.first}.mobility.initFromDisplayString", entries)
    if reads_display and node.position:
        return {"initialX": f"{node.position[0]}m", "initialY": f"{node.position[1]}m"}
    start = f"{node.first}.mobility.initial"
    positions: dict[str, str] = {}
    for axis in "XY":
        area = [
            next(_texts_for(f"{node.first}.mobility.constraintArea{end}{axis}", entries), "")
            for end in ("Min", "Max")
        ]
        if not _is_set(f"{start}{axis}", lines) and all(area):
            positions[f"initial{axis}"] = f"uniform({area[0]}, {area[1]})"
    return positions


def _is_set(path: str, lines: Lines) -> bool:
    return next(_texts_for(path, lines), None) is not None


def _texts_for(path: str, lines: Lines) -> Iterator[str]:
    """Yield the values of the lines that match a path below the network."""
    return (entry.text for entry in lines.matching(f"{_NETWORK}.{path}"))


def missing_classes(network: NedNetwork, entries: Lines, lines: Lines, in_force: Lines) -> Iterator[Outcome]:
    """Yield a line for the protocol of each group of nodes for which `lines` have none.

    A single node also needs one if only a line with wildcards matches it. Arguments are as for `defaults_of`.
    """
    for node in network.nodes:
        last = f"{node.name}[{_SOME_OTHER}]" if node.size else node.name
        app = next(_texts_for(f"{node.first}.app[0].typename", entries), "").strip('"')
        by_default = DEFAULT_PROTOCOL if app in ("", "UdpCommunicationApp") else ""
        if found := _protocol_lines(last, lines):
            chosen = found[0]
            if not node.size and not any(
                f".{node.name}." in line.key for line in found if chosen.text == line.text
            ):
                key = f"*.{last}.protocol.{chosen.key.rpartition('.')[2]}"
                note = "a single node is one that a line names"
                yield Outcome(Action.ADDED, None, f"{key} = {chosen.text}", note)
        elif not by_default:
            what = f"in Python, what {app} does" if app else "what the node runs"
            if _protocol_lines(node.first, lines):
                what = "what the others run"
            yield Outcome(Action.TO_WRITE, None, f"*.{node.written}.{CLASS_TO_WRITE}", what)
        if by_default and not _protocol_lines(last, in_force):
            line = f"*.{node.written}.{PROTOCOL_CLASS.path} = {reference(by_default)}"
            yield Outcome(Action.ADDED, None, line, f"default of {node.type}")


def _protocol_lines(name: str, lines: Lines) -> list[Entry]:
    """Return the lines for the protocol of a node; those for its class come first."""
    return [line for key in PROTOCOL_KEYS for line in lines.matching(f"{_NETWORK}.{name}.{key.path}")]
