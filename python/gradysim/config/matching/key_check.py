"""Finds the keys that match nothing: a misspelt group, parameter or option has to be an error, not a default.

Two checks, since the parameters of protocols are known only when their classes are loaded, and a misspelt
group is better reported than the missing class that follows from it.
"""

import re
from collections.abc import Iterator, Mapping
from fnmatch import fnmatchcase
from typing import NamedTuple

from gradysim.config.errors.config_error import ConfigError
from gradysim.config.errors.nearest import did_you_mean
from gradysim.config.errors.source import Source
from gradysim.config.file.reader import Entry
from gradysim.config.keys import NETWORK_KEYS, NETWORK_MODULES, NODE_KEYS, WLAN_KEYS
from gradysim.config.keys.environment import OBSTACLE_KEYS, obstacle_path
from gradysim.config.keys.interface import at_interface
from gradysim.config.keys.node import GROUP_SIZE
from gradysim.config.keys.omnetpp_options import REFUSED_OPTIONS
from gradysim.config.keys.options import NETWORK, OPTIONS, SECTION_OPTIONS
from gradysim.config.matching.groups import Group
from gradysim.config.matching.key_suggestion import unknown_name_text, unknown_parameter_text
from gradysim.config.matching.lookup import Found, Lookup, is_ignored
from gradysim.config.protocol.parameters import parameters_of
from gradysim.config.value.drawing_functions import drawing_function_in
from gradysim.config.value.pattern import Pattern
from gradysim.protocol.interface import IProtocol


class NoSuchNodeError(ConfigError):
    """A key names a node or a group that is not there."""


class ProtocolAndInterfaces(NamedTuple):
    """What decides which keys a node has.

    Attributes:
        protocol: The class that it runs.
        interface_count: The number of its network interfaces.
    """

    protocol: type[IProtocol]
    interface_count: int


def check_option(entry: Entry) -> None:
    """Raise ConfigError if there is no such option, or if it cannot be given there."""
    key = entry.key
    if key in SECTION_OPTIONS and entry.source.is_override:
        raise ConfigError(f"`{key}` belongs to a section; expected it in the file", entry.source)
    if key in (*OPTIONS, *SECTION_OPTIONS, NETWORK) or is_ignored(entry):
        return
    for option, instead in REFUSED_OPTIONS.items():
        if fnmatchcase(key, option):
            raise ConfigError(f"`{key}` is an option that only OMNeT++ has: {instead}", entry.source)
    hint = did_you_mean(key, [*OPTIONS, *SECTION_OPTIONS, NETWORK, "result-dir"])
    if re.fullmatch(r"num[A-Z]\w*", key):
        hint = f"; did you mean `*.{key}`?"
    raise ConfigError(
        f"there is no option `{key}`; expected one, or a parameter such as `*.uavs[*].mobility.speed`{hint}",
        entry.source,
    )


def check_names(lookup: Lookup, groups: list[Group]) -> list[Source]:
    """Raise ConfigError for the first key that names no node, no group and no other part of the network.

    Returns the lines about nodes that this run has not, and others may have.
    """
    elsewhere: list[Source] = []
    names = {*NETWORK_MODULES, *(group.size_key for group in groups), *(group.name for group in groups)}
    for group in groups:
        names.update(group.node_names() or [f"{group.name}[0]"])
    known: dict[str, bool] = {}
    for found in _in_order_of_text(lookup):
        name = found.name_pattern()
        if name is None:
            continue
        if name.text not in known:
            known[name.text] = (
                any(map(name.matches, names)) if name.literal is None else name.literal in names
            )
        is_of_network = found.parts and found.parts[0].matches(lookup.network)
        if is_of_network and (known[name.text] or _is_beyond_overridden_size(found, groups)):
            continue
        if is_of_network and _is_beyond_drawn_size(found, groups):
            continue
        if not (is_of_network and _is_beyond_varying_size(found, groups)):
            error = NoSuchNodeError if is_of_network else ConfigError
            raise error(unknown_name_text(found, groups, lookup.network), found.entry.source)
        elsewhere.append(found.entry.source)
    return elsewhere


def check_parameters(
    lookup: Lookup, groups: list[Group], kinds: Mapping[str, ProtocolAndInterfaces], obstacles: int
) -> None:
    """Raise ConfigError for the first key that names no parameter.

    `kinds` are those of the nodes, by name; `obstacles` is the number of those that have keys.
    """
    check = _ParameterCheck(lookup.network, groups, kinds, obstacles)
    for found in _in_order_of_text(lookup):
        if not check.matches(found):
            raise ConfigError(check.error_text(found), found.entry.source)


class _ParameterCheck:
    def __init__(
        self, network: str, groups: list[Group], kinds: Mapping[str, ProtocolAndInterfaces], obstacles: int
    ) -> None:
        self._network = network
        self._network_paths = [key.path for key in NETWORK_KEYS if key not in OBSTACLE_KEYS]
        self._network_paths += [
            obstacle_path(key, index) for index in range(obstacles) for key in OBSTACLE_KEYS
        ]
        self._groups = groups
        self._kinds = kinds
        self._rests = {kind: _rests_of(kind) for kind in dict.fromkeys(kinds.values())}
        self._kinds_of: dict[str, set[ProtocolAndInterfaces]] = {}
        self._known: dict[tuple[ProtocolAndInterfaces, str], bool] = {}

    def matches(self, found: Found) -> bool:
        name, rest = found.name_pattern(), found.rest_pattern()
        if name is None:
            return any(found.pattern.matches(path) for path in self._paths_like(found))
        if rest is None:
            return any(name.matches(group.size_key) for group in self._groups)
        below = [path.split(".", 1) for path in self._network_paths if found.may_end_in(path)]
        if any(name.matches(module) and rest.matches(end) for module, end in below):
            return True
        if rest.matches(GROUP_SIZE.path) and any(name.matches(group.name) for group in self._groups):
            return True
        kinds = self._kinds_named(name)
        if not kinds:  # the group is empty, or smaller than this key was written for
            is_single_part = any(name.matches(other) for other in NETWORK_MODULES | self._indexed())
            return not is_single_part and (
                rest.literal_prefix().startswith("protocol.")
                or any(rest.matches(key.path) for key in NODE_KEYS)
            )
        return any(self._is_known(kind, rest) for kind in kinds)

    def error_text(self, found: Found) -> str:
        name = found.name_pattern()
        kinds = (self._kinds_named(name) if name else set()) or set(self._rests)
        classes = sorted({kind.protocol for kind in kinds}, key=lambda cls: cls.__name__)
        return unknown_parameter_text(found, self._groups, classes)

    def _indexed(self) -> set[str]:
        return {group.name for group in self._groups if group.size is not None}

    def _kinds_named(self, name: Pattern) -> set[ProtocolAndInterfaces]:
        if name.literal is not None:
            return {self._kinds[name.literal]} if name.literal in self._kinds else set()
        if name.text not in self._kinds_of:
            self._kinds_of[name.text] = {kind for node, kind in self._kinds.items() if name.matches(node)}
        return self._kinds_of[name.text]

    def _is_known(self, kind: ProtocolAndInterfaces, rest: Pattern) -> bool:
        if (kind, rest.text) not in self._known:
            self._known[kind, rest.text] = any(map(rest.matches, self._rests[kind]))
        return self._known[kind, rest.text]

    def _paths_like(self, found: Found) -> Iterator[str]:
        """All paths, without those that end in another way than the key does."""
        yield from (f"{self._network}.{path}" for path in self._network_paths)
        for group in self._groups:
            yield f"{self._network}.{group.size_key}"
            yield f"{self._network}.{group.name}.{GROUP_SIZE.path}"
            if group.size == 0:
                yield from (f"{self._network}.{group.name}[0].{key.path}" for key in NODE_KEYS)
        rests = {kind: [rest for rest in all if found.may_end_in(rest)] for kind, all in self._rests.items()}
        for node, kind in self._kinds.items():
            yield from (f"{self._network}.{node}.{rest}" for rest in rests[kind])


def _rests_of(kind: ProtocolAndInterfaces) -> list[str]:
    """The paths below a node."""
    further = [at_interface(key.path, index) for index in range(1, kind.interface_count) for key in WLAN_KEYS]
    parameters = [f"protocol.{name}" for name in parameters_of(kind.protocol)]
    return [key.path for key in NODE_KEYS] + further + parameters


def _in_order_of_text(lookup: Lookup) -> list[Found]:
    """The entries so that the first mistake of a file is the first that is reported."""
    return sorted(lookup.found, key=lambda found: (found.entry.source.line, found.order))


def _is_beyond_overridden_size(found: Found, groups: list[Group]) -> bool:
    """Whether a key names an index that the group had until a more specific section made it smaller."""
    size = _size_of_indexed_group(found, groups)
    return size is not None and size.rank < found.rank


def _is_beyond_varying_size(found: Found, groups: list[Group]) -> bool:
    """Whether a key names an index of a group whose size is another one in each combination of values."""
    size = _size_of_indexed_group(found, groups)
    return size is not None and "${" in size.entry.source.value


def _is_beyond_drawn_size(found: Found, groups: list[Group]) -> bool:
    """Whether a key names an index of a group whose size is drawn: runs of other seeds may have it."""
    size = _size_of_indexed_group(found, groups)
    return size is not None and bool(drawing_function_in(size.entry.text))


def _size_of_indexed_group(found: Found, groups: list[Group]) -> Found | None:
    """What says the size of the group of which a key names an index."""
    name = found.name_pattern()
    group_name, bracket, _ = name.literal_prefix().partition("[") if name else ("", "", "")
    sizes = (group.size_found for group in groups if bracket and group.name == group_name)
    return next((size for size in sizes if size), None)
