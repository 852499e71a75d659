"""Reports keys that match nothing. A misspelled name is an error and never a default value.

There are two checks of keys: names of nodes first, and parameters once the classes of the protocols are
loaded, which declare some of them. Each error has the nearest valid key, if there is one.
"""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from fnmatch import fnmatchcase
from typing import NamedTuple

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.distributions import distribution_in
from gradysim.scenario.errors import ConfigError, ErrorCollector, Source, nearest
from gradysim.scenario.groups import Group
from gradysim.scenario.ini import Entry
from gradysim.scenario.keys import (
    GROUP_SIZE,
    NETWORK_KEYS,
    NETWORK_MODULES,
    NODE_KEYS,
    OBSTACLE_KEYS,
    PROTOCOL_CLASS,
    PROTOCOL_KEYS,
    WLAN,
    WLAN_KEYS,
    at_interface,
    interface_in,
    obstacle_path,
    written_for,
)
from gradysim.scenario.lookup import Found, Lookup, is_ignored
from gradysim.scenario.options import NETWORK, OPTIONS, REFUSED_OPTIONS, SECTION_OPTIONS
from gradysim.scenario.parameters import annotations_of, parameters_of
from gradysim.scenario.pattern_index import TextIndex
from gradysim.scenario.patterns import Pattern, compile_pattern


class NoSuchNodeError(ConfigError):
    """A key names a node or a group that does not exist."""


class ProtocolAndInterfaces(NamedTuple):
    """What decides which keys a node has.

    Attributes:
        protocol: The class of its protocol.
        interface_count: The number of its network interfaces.
    """

    protocol: type[IProtocol]
    interface_count: int


def check_option(entry: Entry) -> None:
    """Raise ConfigError if the option does not exist or cannot be set there."""
    key = entry.key
    if key in SECTION_OPTIONS and entry.source.is_override:
        raise ConfigError(f"`{key}` belongs to a section", entry.source, expected="it in the file")
    if key in (*OPTIONS, *SECTION_OPTIONS, NETWORK) or is_ignored(entry):
        return
    for option, instead in REFUSED_OPTIONS.items():
        if fnmatchcase(key, option):
            raise ConfigError(f"`{key}` is an option that only OMNeT++ has: {instead}", entry.source)
    match = nearest(key, [*OPTIONS, *SECTION_OPTIONS, NETWORK, "result-dir"])
    if re.fullmatch(r"num[A-Z]\w*", key):
        match = f"*.{key}"
    raise ConfigError(
        f"there is no option `{key}`",
        entry.source,
        expected="an option, or a parameter such as `*.uavs[*].mobility.speed`",
        suggestion=match,
    )


def check_names(lookup: Lookup, groups: list[Group], errors: ErrorCollector) -> list[Source]:
    """Report keys that name no node, no group and no other part of the network.

    Returns the lines about nodes that this run does not have, and other runs may have.
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
    for found in lookup.found:
        name = found.name_pattern()
        if name is None:
            continue
        is_known = names.has_match(name)
        is_of_network = found.parts and found.parts[0].matches(lookup.network)
        if is_of_network and (is_known or _is_beyond_overridden_size(found, groups)):
            continue
        if is_of_network and _is_beyond_drawn_size(found, groups):
            continue
        if is_of_network and _is_beyond_varying_size(found, groups):
            elsewhere.append(found.entry.source)
        else:
            errors.add(_unknown_name(found, groups, lookup.network))
    return elsewhere


def check_parameters(
    lookup: Lookup,
    groups: list[Group],
    kinds: Mapping[str, ProtocolAndInterfaces],
    obstacles: int,
    errors: ErrorCollector,
) -> None:
    """Report keys that name no parameter.

    Args:
        lookup: The entries. Those whose names are unknown match nothing here; they are reported before.
        groups: The groups of nodes.
        kinds: What decides about the keys of each node, by the node's name.
        obstacles: The number of obstacles that have keys.
        errors: Takes the errors.
    """
    check = _ParameterCheck(lookup.network, groups, kinds, obstacles)
    for found in lookup.found:
        if not check.matches(found):
            errors.add(check.error(found))


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

    def error(self, found: Found) -> ConfigError:
        name = found.name_pattern()
        kinds = (self._kinds_named(name) if name else set()) or set(self._rests)
        classes = sorted({kind.protocol for kind in kinds}, key=lambda cls: cls.__name__)
        return _unknown_parameter(found, self._groups, classes)

    def _is_below(self, name: Pattern, rest: Pattern) -> bool:
        """Return whether something with such a name has a parameter with that rest."""
        return (
            any(name.matches(module) and rests.has_match(rest) for module, rests in self._of_modules.items())
            or (rest.matches(GROUP_SIZE.path) and self._group_names.has_match(name))
            or any(self._rests[kind].has_match(rest) for kind in self._kinds_named(name))
        )

    def _matches_from_somewhere(self, found: Found) -> bool:
        """Return whether a key matches whose `**` makes the place of the name uncertain."""
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
        """Yield all paths, except those that end differently than the key."""
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
    """Return the paths below a node."""
    further = [at_interface(key.path, index) for index in range(1, kind.interface_count) for key in WLAN_KEYS]
    parameters = [f"protocol.{name}" for name in parameters_of(kind.protocol)]
    return [key.path for key in NODE_KEYS] + further + parameters


def _is_beyond_overridden_size(found: Found, groups: list[Group]) -> bool:
    """Return whether a key names an index that existed until a more specific section reduced the group."""
    size = _size_of_indexed_group(found, groups)
    return size is not None and size.rank < found.rank


def _is_beyond_varying_size(found: Found, groups: list[Group]) -> bool:
    """Return whether a key names an index of a group whose size depends on iteration variables."""
    size = _size_of_indexed_group(found, groups)
    return size is not None and "${" in size.entry.source.value


def _is_beyond_drawn_size(found: Found, groups: list[Group]) -> bool:
    """Return whether a key names an index of a group whose size is drawn: other seeds may have it."""
    size = _size_of_indexed_group(found, groups)
    return size is not None and bool(distribution_in(size.entry.text))


def _size_of_indexed_group(found: Found, groups: list[Group]) -> Found | None:
    """What says the size of the group of which a key names an index."""
    name = found.name_pattern()
    group_name, bracket, _ = name.literal_prefix().partition("[") if name else ("", "", "")
    sizes = (group.size_found for group in groups if bracket and group.name == group_name)
    return next((size for size in sizes if size), None)


_PROTOCOL = "protocol."


def _unknown_name(found: Found, groups: Sequence[Group], network: str) -> ConfigError:
    """Return the error for a key that names no node and no part of the network."""
    key, source = found.entry.key, found.entry.source
    if not found.parts or not found.parts[0].matches(network):
        return ConfigError(
            f"`{key}` does not begin with `*.` or `**.`, nor with the network's name `{network}.`",
            source,
            expected="a key such as `*.uavs[*].mobility.speed`",
            suggestion=nearest(key, _written_keys(key, groups, ())),
        )
    problem = f"`{key}` matches no node"
    base, bracket, _ = found.parts[1].text.partition("[")
    if re.fullmatch(r"num(?!ber)[a-z]\w*", base) and len(found.parts) == 2:
        size = f"*.num{base[3].upper()}{base[4:]}"
        expected = "a capital letter where the group's name begins"
        return NoSuchNodeError(problem, source, expected=expected, suggestion=size)
    match = nearest(base, [*(group.name for group in groups), *NETWORK_MODULES])
    group = next((group for group in groups if group.name == match), None)
    suggestion, hint = "", "" if group else _instead_of_module([base])
    if match and not hint:
        parts = [found.parts[0].text, group.written if group else match]
        suggestion = ".".join([*parts, *(part.text for part in found.parts[2:])])
    elif not hint and not bracket and is_misspelled_class(found.rest_pattern()):
        suggestion = f"{found.parts[0].text}.{base}.{PROTOCOL_CLASS.path}"
    elif not hint and not bracket:
        suggestion = nearest(key, _written_keys(key, groups, ()))
    if group is not None and group.name == base:
        has = f"nodes {base}[0] to {base}[{group.size - 1}]" if group.size else "one node, without index"
        expected = f"`{base}` as it is, with {has}"
    elif bracket and not (suggestion or hint):
        problem += f": nothing says how many `{base}` there are"
        expected = f"`*.num{base[:1].upper()}{base[1:]} = ...`"
    elif groups:
        expected = f"one of {', '.join(f'`{group.written}`' for group in groups)}"
    else:
        name = base if base.isidentifier() else "uav"
        expected = f'a line that makes one, such as `*.{name}.{PROTOCOL_CLASS.path} = "file.py:Class"`'
    return NoSuchNodeError(problem, source, expected=expected, suggestion=suggestion, hint=hint)


def is_misspelled_class(rest: Pattern | None) -> bool:
    """Return whether the rest of a key is a misspelled `protocol.class`."""
    if rest is None or rest.literal is None or rest.literal == PROTOCOL_CLASS.path:
        return False
    paths = [key.path for key in PROTOCOL_KEYS]
    return rest.literal == "protocol" or nearest(rest.literal, paths, strict=True) == PROTOCOL_CLASS.path


def _unknown_parameter(
    found: Found, groups: Sequence[Group], classes: Sequence[type[IProtocol]]
) -> ConfigError:
    """Return the error for a key that names no parameter. `classes` are those of the nodes it names."""
    key, source = found.entry.key, found.entry.source
    rest = found.rest_pattern()
    names_node = found.parts is not None and found.parts[1].text.partition("[")[0] not in NETWORK_MODULES
    if rest is not None and names_node and rest.text.startswith(_PROTOCOL) and classes:
        return _unknown_protocol_parameter(found, rest, classes)
    problem, expected = f"`{key}` matches no parameter", "the name of one"
    interface = interface_in(key)
    if interface and _is_of_first_interface(key[interface.end() :]):  # the nearest key would be this one
        expected = "one of an interface that `numWlanInterfaces` of the node counts"
        return ConfigError(problem, source, expected=expected)
    if rest is not None and not names_node and rest.text.startswith("obstacle["):
        expected = "one of an obstacle that `*.environment.numObstacles` counts"
    if hint := _instead_of_module(key.split(".")[1 if key.startswith("**.") else 2 :]):
        return ConfigError(problem, source, expected=expected, hint=hint)
    suggestion = written_for(_nearest_key(found, groups, classes), key)
    return ConfigError(problem, source, expected=expected, suggestion=suggestion)


def _is_of_first_interface(end: str) -> bool:
    """Return whether wlan[0] has a key with that end: `.radio.channelNumber`."""
    of_first = compile_pattern(f"{WLAN}{end}")
    return any(of_first.matches(key.path) for key in WLAN_KEYS)


def _nearest_key(found: Found, groups: Sequence[Group], classes: Sequence[type[IProtocol]]) -> str:
    key = found.entry.key
    rests = _written_rests(classes)
    prefix = _prefix_of_nodes(found, groups)
    if prefix:
        complete = [prefix + rest for rest in rests]
        similar = complete
    else:
        complete = [f"*.{network_key.written}" for network_key in NETWORK_KEYS]
        if key.startswith("**."):
            complete = [f"*{written}" for written in complete] + [f"**.{rest}" for rest in rests]
        similar = _written_keys(key, groups, classes)
    with_more_parts = [candidate for candidate in complete if _lacks_only_parts(key, candidate)]
    if len(with_more_parts) == 1:
        return with_more_parts[0]
    return nearest(key, similar)


def _prefix_of_nodes(found: Found, groups: Sequence[Group]) -> str:
    """Return the start of keys of the nodes that a key names, `*.uavs[*].`, or "" if it names none."""
    if not found.parts or len(found.parts) != 3:
        return ""
    network, name, _ = found.parts
    for group in groups:
        if name.literal == group.name:  # with nodes that have an index, it was forgotten
            return f"{network.text}.{group.written}."
    names_node = any(name.matches(node) for group in groups for node in group.node_names())
    return f"{network.text}.{name.text}." if names_node else ""


def _lacks_only_parts(key: str, candidate: str) -> bool:
    """Return whether the candidate has all parts of the key in their order, and the same last part."""
    interface = interface_in(key)
    wanted = (key.replace(interface[0], "wlan[*]") if interface else key).split(".")
    remaining = iter(candidate.split("."))
    return wanted[-1] == candidate.rpartition(".")[2] and all(part in remaining for part in wanted)


def _unknown_protocol_parameter(
    found: Found, rest: Pattern, classes: Sequence[type[IProtocol]]
) -> ConfigError:
    key, source = found.entry.key, found.entry.source
    name = rest.text.removeprefix(_PROTOCOL)
    parameters = sorted(
        {"class", "typename", *(parameter for cls in classes for parameter in parameters_of(cls))}
    )
    problem = f"`{name}` is not a parameter of {' or '.join(cls.__name__ for cls in classes)}"
    expected = f"one of {', '.join(parameters)}"
    attribute = next((value for cls in classes if (value := getattr(cls, name, None)) is not None), None)
    if attribute is None and any(_has_no_value(cls, name) for cls in classes):
        has = "its value in the class is None" if any(hasattr(cls, name) for cls in classes) else "no value"
        problem += f": the class gives it {has}" if has == "no value" else f": {has}"
        return ConfigError(f"{problem}, and not a value such as `{name} = 0`", source, expected=expected)
    if attribute is not None:
        problem += f", it is of type {type(attribute).__name__} and not a plain public value"
    match = nearest(name, parameters)
    suggestion = f"{key.removesuffix(name)}{match}" if match else ""
    return ConfigError(problem, source, expected=expected, suggestion=suggestion)


def _has_no_value(cls: type[IProtocol], name: str) -> bool:
    """Return whether nodes have the attribute: it is declared, None, or set by the constructor."""
    names_in_constructor = getattr(getattr(cls.__init__, "__code__", None), "co_names", ())
    declared = any(name in annotations_of(base) for base in cls.__mro__ if base not in IProtocol.__mro__)
    return declared or hasattr(cls, name) or name in names_in_constructor


def _written_rests(classes: Sequence[type[IProtocol]]) -> list[str]:
    """Return all keys below a node, as users write them."""
    parameters = [f"{_PROTOCOL}{name}" for cls in classes for name in parameters_of(cls)]
    return [key.written for key in NODE_KEYS] + parameters


def _written_keys(key: str, groups: Sequence[Group], classes: Sequence[type[IProtocol]]) -> list[str]:
    """Return all keys as users write them; only their ends if `key` begins with `**.`."""
    keys = [f"*.{network_key.written}" for network_key in NETWORK_KEYS]
    for group in groups:
        keys.append(f"*.{group.size_key}")
        keys += [f"*.{group.written}.{rest}" for rest in _written_rests(classes)]
    if not key.startswith("**."):
        return keys
    parts = key.count(".")
    return list(dict.fromkeys("**." + ".".join(written.split(".")[-parts:]) for written in keys))


# Modules of INET without keys: what to use instead.
_APPS = "the protocol of a node sends its messages, see `protocol.class`"
_OBSTACLES = "obstacles are below `environment`: `gradysim keys environment`"
_NO_ADDRESSES = "nodes are addressed by their ids, delete this line"
_NO_ENERGY = "there are no energy models, delete this line"

_HERE = {
    "app": _APPS,
    "numApps": _APPS,
    "physicalEnvironment": _OBSTACLES,
    "configurator": _NO_ADDRESSES,
    "ipv4": _NO_ADDRESSES,
    "energyStorage": _NO_ENERGY,
    "energyGenerator": _NO_ENERGY,
    "energyManagement": _NO_ENERGY,
    "energyConsumer": _NO_ENERGY,
}


def _instead_of_module(parts: Iterable[str]) -> str:
    """Return a hint for a key that names a module of INET, "; ...", or ""."""
    names = (part.partition("[")[0] for part in parts)
    return next((f"; {_HERE[name]}" for name in names if name in _HERE), "")
