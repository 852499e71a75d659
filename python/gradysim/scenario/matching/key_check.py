"""Finds the keys that match nothing: a misspelt group, parameter or option has to be an error, not a default.

Two checks, since the parameters of protocols are known only when their classes are loaded, and a misspelt
group is better reported than the missing class that follows from it.
"""

import re
from collections.abc import Iterator, Mapping
from fnmatch import fnmatchcase
from typing import NamedTuple

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.distributions import distribution_in
from gradysim.scenario.errors.config_error import ConfigError
from gradysim.scenario.errors.nearest import did_you_mean
from gradysim.scenario.errors.source import Source
from gradysim.scenario.file.reader import Entry
from gradysim.scenario.keys import (
    GROUP_SIZE,
    NETWORK_KEYS,
    NETWORK_MODULES,
    NODE_KEYS,
    OBSTACLE_KEYS,
    WLAN_KEYS,
    at_interface,
    obstacle_path,
)
from gradysim.scenario.matching.groups import Group
from gradysim.scenario.matching.key_suggestion import unknown_name_text, unknown_parameter_text
from gradysim.scenario.matching.lookup import Found, Lookup, is_ignored
from gradysim.scenario.matching.text_index import TextIndex
from gradysim.scenario.options import NETWORK, OPTIONS, REFUSED_OPTIONS, SECTION_OPTIONS
from gradysim.scenario.parameters import parameters_of
from gradysim.scenario.patterns import Pattern


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
    names = TextIndex(
        [
            *NETWORK_MODULES,
            *(group.size_key for group in groups),
            *(group.name for group in groups),
            *(name for group in groups for name in group.node_names() or [f"{group.name}[0]"]),
        ]
    )
    for found in _in_order_of_text(lookup):
        name = found.name_pattern()
        if name is None:
            continue
        is_known = names.has_match(name)
        is_of_network = found.parts and found.parts[0].matches(lookup.network)
        if is_of_network and (is_known or _is_beyond_overridden_size(found, groups)):
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
        rests = {kind: _rests_of(kind) for kind in dict.fromkeys(kinds.values())}
        of_modules: dict[str, list[str]] = {}
        for path in self._network_paths:
            module, rest = path.split(".", 1)
            of_modules.setdefault(module, []).append(rest)
        self._rests = {kind: TextIndex(texts) for kind, texts in rests.items()}
        self._of_modules = {module: TextIndex(texts) for module, texts in of_modules.items()}
        self._of_any_node = TextIndex(key.path for key in NODE_KEYS)
        self._size_keys = TextIndex(group.size_key for group in groups)
        self._group_names = TextIndex(group.name for group in groups)
        self._nodes = TextIndex(kinds)
        self._first_of_empty_groups = TextIndex(f"{group.name}[0]" for group in groups if group.size == 0)
        self._single_parts = TextIndex(
            [*NETWORK_MODULES, *(group.name for group in groups if group.size is not None)]
        )
        self._below_any_name = TextIndex(
            f".{rest}"
            for texts in (
                *of_modules.values(),
                *rests.values(),
                [GROUP_SIZE.path] if groups else [],
                [key.path for key in NODE_KEYS] if any(group.size == 0 for group in groups) else [],
            )
            for rest in texts
        )
        self._kinds_of: dict[str, set[ProtocolAndInterfaces]] = {}

    def matches(self, found: Found) -> bool:
        name, rest = found.name_pattern(), found.rest_pattern()
        if name is None:
            return self._matches_from_somewhere(found)
        if rest is None:
            return self._size_keys.has_match(name)
        if self._is_below(name, rest):
            return True
        if self._kinds_named(name) or self._single_parts.has_match(name):
            return False
        # The group is empty, or smaller than this key was written for.
        return rest.literal_prefix().startswith("protocol.") or self._of_any_node.has_match(rest)

    def error_text(self, found: Found) -> str:
        name = found.name_pattern()
        kinds = (self._kinds_named(name) if name else set()) or set(self._rests)
        classes = sorted({kind.protocol for kind in kinds}, key=lambda cls: cls.__name__)
        return unknown_parameter_text(found, self._groups, classes)

    def _is_below(self, name: Pattern, rest: Pattern) -> bool:
        """Whether something of such a name has a parameter with that rest."""
        return (
            any(name.matches(module) and rests.has_match(rest) for module, rests in self._of_modules.items())
            or (rest.matches(GROUP_SIZE.path) and self._group_names.has_match(name))
            or any(self._rests[kind].has_match(rest) for kind in self._kinds_named(name))
        )

    def _matches_from_somewhere(self, found: Found) -> bool:
        """The same for a key of which `**` makes uncertain where the name stands."""
        if found.pattern.below_anything is None:
            return any(found.pattern.matches(path) for path in self._paths_like(found))
        name, rest = found.pattern.below_anything
        if self._below_any_name.has_match(found.pattern):
            return True
        if rest is None:
            return self._size_keys.has_match(name)
        if self._is_below(name, rest):
            return True
        return self._first_of_empty_groups.has_match(name) and self._of_any_node.has_match(rest)

    def _kinds_named(self, name: Pattern) -> set[ProtocolAndInterfaces]:
        if name.literal is not None:
            return {self._kinds[name.literal]} if name.literal in self._kinds else set()
        if name.text not in self._kinds_of:
            self._kinds_of[name.text] = {self._kinds[node] for node in self._nodes.matches(name)}
        return self._kinds_of[name.text]

    def _paths_like(self, found: Found) -> Iterator[str]:
        """All paths, without those that end in another way than the key does."""
        yield from (f"{self._network}.{path}" for path in self._network_paths)
        for group in self._groups:
            yield f"{self._network}.{group.size_key}"
            yield f"{self._network}.{group.name}.{GROUP_SIZE.path}"
            if group.size == 0:
                yield from (f"{self._network}.{group.name}[0].{key.path}" for key in NODE_KEYS)
        rests = {
            kind: [rest for rest in texts if found.may_end_in(rest)] for kind, texts in self._rests.items()
        }
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
    return size is not None and bool(distribution_in(size.entry.text))


def _size_of_indexed_group(found: Found, groups: list[Group]) -> Found | None:
    """What says the size of the group of which a key names an index."""
    name = found.name_pattern()
    group_name, bracket, _ = name.literal_prefix().partition("[") if name else ("", "", "")
    sizes = (group.size_found for group in groups if bracket and group.name == group_name)
    return next((size for size in sizes if size), None)
