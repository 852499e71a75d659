"""Translates single lines: kept, renamed, left out, or to be written by the user."""

import fnmatch
import re
from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache

from gradysim.omnetpp_import.outcome import Action, Outcome, left_out, not_modelled, renamed
from gradysim.omnetpp_import.protocol_lines import ProtocolTranslator
from gradysim.omnetpp_import.scene import PART, Scene, number_of
from gradysim.omnetpp_import.tables import (
    AS_HERE,
    GEOGRAPHIC,
    NO_AREA,
    NO_MEANING,
    NO_NODE_TYPE,
    NO_RADIO_TYPE,
    NODE_TYPES,
    NOT_MODELLED,
    NOT_MODELLED_NODES,
    RENAMED,
    SCALAR_RADIOS,
    TO_WRITE,
    UNIT_DISK,
    UNIT_DISK_MEDIUM,
    VALUES,
)
from gradysim.omnetpp_import.values import wrong_value
from gradysim.protocol.defaults import MOST_INTERFACES
from gradysim.scenario.errors import BadValue
from gradysim.scenario.parse.ini import Entry, Section
from gradysim.scenario.parse.patterns import Pattern, compile_pattern
from gradysim.scenario.schema.engine_keys import Key
from gradysim.scenario.schema.keys import MOBILITY_KEYS, NETWORK_KEYS, NETWORK_MODULES, NODE_KEYS, WLAN
from gradysim.scenario.schema.options import (
    NETWORK,
    OPTIONS,
    REFUSED_OPTIONS,
    SECTION_OPTIONS,
    is_ignored,
    is_option,
)


class LineTranslator:
    """Translates the lines of a file."""

    def __init__(
        self, orders: Mapping[str, Sequence[Section]], size_keys: Mapping[str, str], folder: str
    ) -> None:
        """Take all lines of the file.

        Args:
            orders: The sections in which the lines of each section are looked up, its own one first.
            size_keys: {parameter of the network: the key for the number of nodes here}.
            folder: The directory of the file, from that of the translation.
        """
        entries = [entry for own, *_ in orders.values() for entry in own.entries]
        self._size_keys = size_keys
        self._scene = Scene(orders)
        self._protocols = ProtocolTranslator(entries, self._scene, folder)
        self._has_area = any(
            entry.key.endswith("mobility.typename")
            and re.search("LinearMobility|RectangleMobility", entry.text)
            for entry in entries
        )

    def outcome(self, entry: Entry) -> Outcome:
        """Return what becomes of a line."""
        if is_option(entry):
            return _option(entry)
        parts = PART.findall(entry.key)
        if is_ignored(entry):
            return left_out(entry, "only OMNeT++ reads it")
        if len(parts) == 2 and parts[1] in self._size_keys:
            return renamed(entry, f"{parts[0]}.{self._size_keys[parts[1]]}")
        name = parts[-1]
        if outcome := self._protocols.outcome(entry, parts):
            return outcome
        if name in GEOGRAPHIC and parts[-2] == "mobility":
            return self._geographic(entry, ".".join(parts[:-1]), GEOGRAPHIC[name])
        if name.startswith("constraintArea") and not self._has_area:
            return left_out(entry, NO_AREA)
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
        kinds = {each.path: each.kind for each in keys}
        if wrong := wrong_value(entry, key, text, kinds) if keys else "there is no such parameter":
            if all(each.kind.names and each not in MOBILITY_KEYS for each in keys):  # one of some models
                return not_modelled(entry, wrong)
            return Outcome(Action.TO_WRITE, entry, f"{key} = ...", f"{text}: {wrong}")
        is_same = (key, text) == (entry.key, entry.text)
        return Outcome(Action.KEPT if is_same else Action.RENAMED, entry, line)

    def _geographic(self, entry: Entry, mobility: str, coordinate: str) -> Outcome:
        """Place a latitude, longitude or altitude relative to the origin of the scene."""
        target = f"{mobility}.{coordinate}"
        if not self._scene.is_geographic(mobility):
            return left_out(entry, "without coordinateSystemModule it had no effect")
        try:
            value = number_of("m" if coordinate == "initialZ" else "deg", entry.text)
            meters = self._scene.coordinate_m(entry, "XYZ".index(coordinate[-1]), value)
        except BadValue as error:
            return Outcome(Action.TO_WRITE, entry, f"{target} = ...", f"{entry.text}: {error}")
        return renamed(
            entry, target, f"{round(meters, 3) + 0.0:g}m" if abs(meters) < 1e3 else f"{meters:.3f}m"
        )


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
        return left_out(entry, NO_RADIO_TYPE) if is_scalar else not_modelled(entry, NO_RADIO_TYPE)
    return None


def _without_counterpart(entry: Entry, parts: Sequence[str]) -> Outcome:
    """Return the outcome of a line whose key does not exist here."""
    values = set(_values_in(entry.text))
    if len(parts) == 3 and parts[0] != "**" and parts[-1] == "typename":  # the type of a node
        is_known = values <= NODE_TYPES.keys() - NOT_MODELLED_NODES.keys()
        return left_out(entry, NO_NODE_TYPE) if is_known else not_modelled(entry, NO_NODE_TYPE)
    names = [re.sub(r"[\[{].*", "", part) for part in parts[1:]]
    if reason := _MEANINGLESS.of_first(names):
        return left_out(entry, reason)
    reason = _NOT_MODELLED.of_first(reversed(names))
    if any(entry.key.endswith(f".{end}") and values <= as_here for end, as_here in AS_HERE.items()):
        return left_out(entry, reason or "it is so here")
    return not_modelled(entry, reason or "there is no such parameter")


class _Reasons:
    """Reasons, each with the patterns of names that it is for."""

    def __init__(self, reasons: Mapping[str, str]) -> None:
        self._reasons = tuple(reasons)
        patterns = ("|".join(map(fnmatch.translate, names.split())) for names in reasons.values())
        self._pattern = re.compile("|".join(f"({pattern})" for pattern in patterns))

    def of_first(self, names: Iterable[str]) -> str:
        """Return the reason for the first name that one of the patterns matches; "" if there is none."""
        matches = (match for name in names if (match := self._pattern.match(name)))
        match = next(matches, None)
        return self._reasons[match.lastindex - 1] if match and match.lastindex else ""


_MEANINGLESS, _NOT_MODELLED = _Reasons(NO_MEANING), _Reasons(NOT_MODELLED)


def _values_in(text: str) -> list[str]:
    """Return the strings in a value, which may be an iteration; the value if it has none."""
    return re.findall(r'"([^"]*)"', text) or [text]


def _option(entry: Entry) -> Outcome:
    if entry.key in (*OPTIONS, *SECTION_OPTIONS, NETWORK):
        return Outcome(Action.KEPT, entry, f"{entry.key} = {entry.text}")
    if is_ignored(entry):
        return left_out(entry, "only OMNeT++ reads it")
    for option, instead in REFUSED_OPTIONS.items():
        if fnmatch.fnmatchcase(entry.key, option):
            return not_modelled(entry, instead)
    return not_modelled(entry, "there is no such option")


def _with_values(text: str, values: Mapping[str, str]) -> str:
    """Replace each quoted value that has another name here."""
    return re.sub(r'"([^"]*)"', lambda match: f'"{values.get(match[1], match[1])}"', text)


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
    parts_of_key = PART.findall(key) if key.count(".") > 1 else ()
    if len(parts_of_key) > 2 and not _UNCERTAIN.search(" ".join(parts_of_key[:2])):
        _, name, *below = parts_of_key
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
