"""Translates single lines: kept, renamed, left out, or to be written by the user."""

import contextlib
import fnmatch
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import lru_cache
from pathlib import Path

from gradysim.omnetpp_import.tables import (
    AS_HERE,
    CLASS_NAMES,
    FILE_NAME,
    GEOGRAPHIC,
    LOCATION,
    NO_AREA,
    NO_MEANING,
    NO_NODE_TYPE,
    NO_RADIO_TYPE,
    NODE_TYPES,
    NOT_MODELLED,
    NOT_MODELLED_NODES,
    ORIGIN,
    PROTOCOL,
    RENAMED,
    SCALAR_RADIOS,
    TO_WRITE,
    UNIT_DISK,
    UNIT_DISK_MEDIUM,
    VALUES,
)
from gradysim.protocol.defaults import MOST_INTERFACES
from gradysim.protocol.position import geo_to_cartesian
from gradysim.scenario.errors import BadValue, ConfigError
from gradysim.scenario.expressions import ParameterContext, parse_value
from gradysim.scenario.functions import is_quoted, unquoted
from gradysim.scenario.ini import Entry
from gradysim.scenario.keys import MOBILITY_KEYS, NETWORK_KEYS, NETWORK_MODULES, NODE_KEYS, WLAN
from gradysim.scenario.lookup import is_ignored, is_option, read_scalar
from gradysim.scenario.parameter_types import number_in
from gradysim.scenario.patterns import Pattern, compile_pattern
from gradysim.scenario.schema import NETWORK, OPTIONS, REFUSED_OPTIONS, SECTION_OPTIONS, Key
from gradysim.scenario.sweep import name_iterations


class Action(Enum):
    """What was done with a line."""

    KEPT = "kept"
    RENAMED = "renamed"
    ADDED = "added"
    LEFT_OUT = "left out"
    NOT_MODELLED = "not modelled"
    TO_WRITE = "to write"


@dataclass(frozen=True)
class Outcome:
    """One line of the list.

    Attributes:
        action: What was done.
        entry: The line of the file; None for one that the file does not have.
        text: The line here, "" if there is none. For `TO_WRITE` the user completes it. For `NOT_MODELLED` it
            is the line there.
        note: Why, or what for.
    """

    action: Action
    entry: Entry | None = None
    text: str = ""
    note: str = ""

    @property
    def is_in_force(self) -> bool:
        """Whether the line is one of the translated file, and not a comment in it."""
        return bool(self.text) and self.action not in (Action.TO_WRITE, Action.NOT_MODELLED)


_PART = re.compile(r"(?:\[[^\]]*\]|\{[^}]*\}|[^.\[{])+")
"""A part of a key; ranges in brackets have dots of their own."""

CLASS_TO_WRITE = 'protocol.class = "FILE.py:CLASS"'


class LineTranslator:
    """Translates the lines of a file."""

    def __init__(self, entries: Sequence[Entry], size_keys: dict[str, str], folder: str) -> None:
        """Take all lines of the file.

        Args:
            entries: The lines of all sections.
            size_keys: {parameter of the network: the key for the number of nodes here}.
            folder: The directory of the file, from that of the translation.
        """
        self._size_keys = size_keys
        self._folder = folder
        self._has_area = any(
            entry.key.endswith("mobility.typename")
            and re.search("LinearMobility|RectangleMobility", entry.text)
            for entry in entries
        )
        self._of_protocols: dict[str, dict[str, Entry]] = {}
        for entry in entries:
            module, _, name = entry.key.rpartition(".")
            if module.endswith(".protocol"):
                self._of_protocols.setdefault(module, {})[name] = entry
        self._scene = [entry for entry in entries if "coordinateSystem." in entry.key]
        self._geographic_groups = {
            _group(entry.key)
            for entry in entries
            if entry.key.endswith(".coordinateSystemModule") and entry.text != '""'
        }

    def outcome(self, entry: Entry) -> Outcome:
        """Return what becomes of a line."""
        if is_option(entry):
            return _option(entry)
        parts = _PART.findall(entry.key)
        if is_ignored(entry):
            return _left_out(entry, "only OMNeT++ reads it")
        if len(parts) == 2 and parts[1] in self._size_keys:
            return _renamed(entry, f"{parts[0]}.{self._size_keys[parts[1]]}")
        name = parts[-1]
        if len(parts) > 2 and parts[-2] == "protocol":
            return self._protocol(entry, ".".join(parts[:-2]), name)
        if name in GEOGRAPHIC and parts[-2] == "mobility":
            return self._geographic(entry, ".".join(parts[:-1]), GEOGRAPHIC[name])
        if name.startswith("constraintArea") and not self._has_area:
            return _left_out(entry, NO_AREA)
        if outcome := _to_write(entry, ".".join(parts[:-1])) or _of_radio(entry):
            return outcome
        return self._parameter(entry, parts)

    def _parameter(self, entry: Entry, parts: Sequence[str]) -> Outcome:
        key = entry.key
        for before, after in RENAMED:
            key = before.sub(rf"\g<1>{after}", key)
        for end, values in VALUES.items():
            if f".{key}".endswith(f".{end}"):
                return self._checked(entry, key, _with_values(entry.text, values))
        if _own_keys(key):
            return self._checked(entry, key, entry.text)
        return _without_counterpart(entry, parts)

    def _checked(self, entry: Entry, key: str, text: str) -> Outcome:
        """Return the outcome of a line with a key of this simulator: its value may not be one."""
        line = f"{key} = {text}"
        keys = _own_keys(key)
        if wrong := _wrong_value(entry, key, text, keys):
            if all(each.kind.names and each not in MOBILITY_KEYS for each in keys):  # one of some models
                return _not_modelled(entry, wrong)
            return Outcome(Action.TO_WRITE, entry, f"{key} = ...", f"{text}: {wrong}")
        is_same = (key, text) == (entry.key, entry.text)
        return Outcome(Action.KEPT if is_same else Action.RENAMED, entry, line)

    def _geographic(self, entry: Entry, mobility: str, coordinate: str) -> Outcome:
        """Place a latitude, longitude or altitude relative to the origin of the scene."""
        target = f"{mobility}.{coordinate}"
        if not self._is_geographic(mobility):
            return _left_out(entry, "without coordinateSystemModule it had no effect")
        unit = "m" if coordinate == "initialZ" else "deg"
        origin = self._of_scene(ORIGIN[coordinate], unit)
        try:
            place = _number_in(unit, entry.text)
        except BadValue as error:
            return Outcome(Action.TO_WRITE, entry, f"{target} = ...", f"{entry.text}: {error}")
        axis = "XYZ".index(coordinate[-1])
        here, there = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
        here[axis], there[axis] = origin, place
        if axis == 1:  # meters per degree of longitude depend on the latitude of the scene
            here[0] = there[0] = self._of_scene("sceneLatitude", "deg")
        meters = geo_to_cartesian((here[0], here[1], here[2]), (there[0], there[1], there[2]))[axis]
        return _renamed(
            entry, target, f"{round(meters, 3) + 0.0:g}m" if abs(meters) < 1e3 else f"{meters:.3f}m"
        )

    def _is_geographic(self, mobility: str) -> bool:
        """Return whether nodes of that name have geographic positions."""
        group, groups = _group(mobility), self._geographic_groups
        return group in groups or any(
            fnmatch.fnmatchcase(group, each) for each in groups if not each.isidentifier()
        )

    def _of_scene(self, parameter: str, unit: str) -> float:
        for entry in self._scene:
            if entry.key.endswith(f"coordinateSystem.{parameter}"):
                with contextlib.suppress(BadValue):
                    return _number_in(unit, entry.text)
        return 0.0

    def _protocol(self, entry: Entry, node: str, name: str) -> Outcome:
        """Translate a parameter of a protocol. In GrADyS' project, several name a class in Python."""
        python = self._of_protocols.get(f"{node}.protocol", {})
        class_key = next((key for key in CLASS_NAMES if key in python), PROTOCOL)
        if name == "typename":
            protocol = unquoted(entry.text) if is_quoted(entry.text) else entry.text
            if protocol.startswith("Python"):
                return _left_out(entry, "another line names the class")
            what = f"in Python, what {protocol} does"
            return Outcome(Action.TO_WRITE, entry, f"{node}.{CLASS_TO_WRITE}", what)
        if name not in (*CLASS_NAMES, FILE_NAME, LOCATION, PROTOCOL):
            note = "if it is an attribute of your class"
            return Outcome(Action.TO_WRITE, entry, f"{entry.key} = {entry.text}", note)
        if name != class_key or FILE_NAME not in python:
            return _left_out(entry, "part of `protocol.class`")
        texts = {key: unquoted(other.text) for key, other in python.items() if is_quoted(other.text)}
        folders = [self._folder, texts.get(LOCATION, ".")]
        folders += [texts[PROTOCOL]] if class_key != PROTOCOL and PROTOCOL in texts else []
        file = Path(*folders) / f"{texts[FILE_NAME].removesuffix('.py')}.py"
        return _renamed(entry, f"{node}.protocol.class", f'"{file.as_posix()}:{texts[class_key]}"')


def _group(key: str) -> str:
    """Return the name below the network in a key, without its index."""
    parts = _PART.findall(key)
    return parts[1].partition("[")[0] if len(parts) > 1 else ""


def _to_write(entry: Entry, module: str) -> Outcome | None:
    """Return the outcome of a line whose counterpart only the user knows; None for another line."""
    for end, (line, purpose) in TO_WRITE.items():
        if entry.key.endswith(f".{end}"):
            is_of_module = line and not line.startswith("*")
            return Outcome(Action.TO_WRITE, entry, f"{module}.{line}" if is_of_module else line, purpose)
    return None


def _of_radio(entry: Entry) -> Outcome | None:
    """Return the outcome of a line that says what kind of radio a node has; None for another line."""
    for end, values in UNIT_DISK:
        if entry.key.endswith(f".{end}") and entry.text.strip('"') in values:
            return Outcome(Action.RENAMED, entry, f'*.radioMedium.typename = "{UNIT_DISK_MEDIUM}"')
    if entry.key.endswith((".radio.typename", ".radio[*].typename")):
        is_scalar = set(_values_in(entry.text)) <= SCALAR_RADIOS
        return _left_out(entry, NO_RADIO_TYPE) if is_scalar else _not_modelled(entry, NO_RADIO_TYPE)
    return None


def _without_counterpart(entry: Entry, parts: Sequence[str]) -> Outcome:
    """Return the outcome of a line whose key does not exist here."""
    values = set(_values_in(entry.text))
    if len(parts) == 3 and parts[0] != "**" and parts[-1] == "typename":  # the type of a node
        is_known = values <= NODE_TYPES.keys() - NOT_MODELLED_NODES.keys()
        return _left_out(entry, NO_NODE_TYPE) if is_known else _not_modelled(entry, NO_NODE_TYPE)
    names = [re.sub(r"[\[{].*", "", part) for part in parts[1:]]
    if reason := _MEANINGLESS.of_first(names):
        return _left_out(entry, reason)
    reason = _NOT_MODELLED.of_first(reversed(names))
    if any(entry.key.endswith(f".{end}") and values <= as_here for end, as_here in AS_HERE.items()):
        return _left_out(entry, reason or "it is so here")
    return _not_modelled(entry, reason or "there is no such parameter")


class _Reasons:
    """Reasons by the patterns of names that they are for."""

    def __init__(self, reasons: Mapping[str, str]) -> None:
        self._reasons = tuple(reasons.values())
        self._pattern = re.compile("|".join(f"({fnmatch.translate(pattern)})" for pattern in reasons))

    def of_first(self, names: Iterable[str]) -> str:
        """Return the reason for the first name that one of the patterns matches; "" if there is none."""
        matches = (match for name in names if (match := self._pattern.match(name)))
        match = next(matches, None)
        return self._reasons[match.lastindex - 1] if match and match.lastindex else ""


_MEANINGLESS, _NOT_MODELLED = _Reasons(NO_MEANING), _Reasons(NOT_MODELLED)


def _values_in(text: str) -> list[str]:
    """Return the strings in a value, which may be an iteration; the value if it has none."""
    return re.findall(r'"([^"]*)"', text) or [text]


def _left_out(entry: Entry, note: str) -> Outcome:
    return Outcome(Action.LEFT_OUT, entry, note=note)


def _not_modelled(entry: Entry, note: str) -> Outcome:
    return Outcome(Action.NOT_MODELLED, entry, f"{entry.key} = {entry.text}", note)


def _option(entry: Entry) -> Outcome:
    if entry.key in (*OPTIONS, *SECTION_OPTIONS, NETWORK):
        return Outcome(Action.KEPT, entry, f"{entry.key} = {entry.text}")
    if is_ignored(entry):
        return _left_out(entry, "only OMNeT++ reads it")
    for option, instead in REFUSED_OPTIONS.items():
        if fnmatch.fnmatchcase(entry.key, option):
            return _not_modelled(entry, instead)
    return _not_modelled(entry, "there is no such option")


def _renamed(entry: Entry, key: str, text: str = "") -> Outcome:
    line = f"{key} = {text or entry.text}"
    return Outcome(Action.KEPT if line == f"{entry.key} = {entry.text}" else Action.RENAMED, entry, line)


def _with_values(text: str, values: Mapping[str, str]) -> str:
    """Replace each quoted value that has another name here."""
    return re.sub(r'"([^"]*)"', lambda match: f'"{values.get(match[1], match[1])}"', text)


def _number_in(unit: str, text: str) -> float:
    """Return a number with or without a unit. Raises BadValue for anything else."""
    return float(number_in(unit).convert(parse_value(text)))


class _Keys:
    """Keys by their paths, and by the last name of these, which most patterns have, too."""

    def __init__(self, keys: Iterable[tuple[str, Key]]) -> None:
        """Take each key with its path; those of interfaces get the path of each index."""
        self._by_path = {
            path.replace(WLAN, f"wlan[{index}]"): key
            for path, key in keys
            for index in range(MOST_INTERFACES)
        }
        self._by_name: dict[str, dict[str, Key]] = {}
        for path, key in self._by_path.items():
            self._by_name.setdefault(path.rpartition(".")[2], {})[path] = key

    def matching(self, pattern: Pattern) -> list[Key]:
        """Return the keys that a pattern matches."""
        name = pattern.tail.literal if pattern.tail else None
        keys = self._by_path if name is None else self._by_name.get(name, {})
        return list(dict.fromkeys(key for path, key in keys.items() if pattern.matches(path)))


_OF_NODES = _Keys((key.path, key) for key in NODE_KEYS)
_OF_MODULES = {
    module: _Keys(
        (key.path.removeprefix(f"{module}."), key)
        for key in NETWORK_KEYS
        if key.path.startswith(f"{module}.")
    )
    for module in NETWORK_MODULES
}
_OF_NODES_IN_FULL = _Keys((f"N.n[0].{key.path}", key) for key in NODE_KEYS)
_OF_NETWORK_IN_FULL = _Keys((f"N.{key.path}", key) for key in NETWORK_KEYS)


_UNCERTAIN = re.compile(r"\*\*|\.\.|[{\\]")
"""What makes a part of a key more than one part, or not a pattern."""


def _own_keys(key: str) -> Sequence[Key]:
    """Return the keys of this simulator that the key of a line matches, judged by what is below a name."""
    network, name, *below = _PART.findall(key) if key.count(".") > 1 else (key, "")
    if below and not _UNCERTAIN.search(f"{network} {name}"):
        return _keys_below(name if name in NETWORK_MODULES else "", ".".join(below))
    try:
        pattern = compile_pattern(key)
    except BadValue:
        return ()
    parts = pattern.split()
    if parts is not None and len(parts) == 3:
        return _keys_below(parts[1].literal if parts[1].literal in NETWORK_MODULES else "", parts[2].text)
    rest = pattern.below_anything
    if rest and rest[1] and (found := _OF_NODES.matching(rest[1])):  # `**.host.mobility.speed`
        return found
    return _OF_NODES_IN_FULL.matching(pattern) + _OF_NETWORK_IN_FULL.matching(pattern)


@lru_cache(maxsize=4096)  # nodes have the same keys
def _keys_below(module: str, path: str) -> Sequence[Key]:
    """Return the keys that a pattern below a module of the network matches, or below a node if it is ""."""
    try:
        pattern = compile_pattern(path)
    except BadValue:
        return ()
    return (_OF_MODULES[module] if module else _OF_NODES).matching(pattern)


def _wrong_value(entry: Entry, key: str, text: str, keys: Sequence[Key]) -> str:
    """Return what is wrong with a value for these keys; "" if nothing is, or if it cannot be decided here."""
    if not keys:
        return "there is no such parameter"
    changed = Entry(key, text, entry.source)
    try:
        (named,), variables = name_iterations([changed])
    except ConfigError:  # a variable of another line
        return ""
    values = [named.text]
    for variable in variables:
        name = f"${{{variable.name}}}"
        values = [value.replace(name, each) for value in values for each in variable.values]
    for value in values:
        for each in keys:
            if each.kind.is_file or "${" in value:
                continue
            try:
                read_scalar(
                    Entry(key, value, entry.source), each.kind, "n", ParameterContext(0, f"n[0].{each.path}")
                )
            except ConfigError as error:
                return f"expected {error.expected}" if error.expected else error.problem
    return ""
