"""Reports keys that match nothing. A misspelled name is an error and never a default value.

There are two checks of keys: names of nodes first, and parameters once the classes of the protocols are
loaded, which declare some of them. Each error has the nearest valid key, if there is one.
"""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from fnmatch import fnmatchcase
from itertools import chain
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
from gradysim.scenario.lookup import Candidate, Found, Lookup, is_ignored
from gradysim.scenario.parameters import annotations_of, parameters_of
from gradysim.scenario.patterns import Pattern, compile_pattern
from gradysim.scenario.schema import NETWORK, OPTIONS, REFUSED_OPTIONS, SECTION_OPTIONS


class NoSuchNodeError(ConfigError):
    """A key names a node or a group that does not exist."""


class ProtocolAndInterfaces(NamedTuple):
    """What decides which keys a node has."""

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


class _Names:
    """Names below the network, indexed by their parts before the bracket."""

    def __init__(self, names: Iterable[str]) -> None:
        self._groups: dict[str, dict[str, None]] = {}
        for name in names:
            self._groups.setdefault(name.partition("[")[0], {})[name] = None

    def matching(self, pattern: Pattern) -> Iterator[str]:
        """Yield the names that a pattern matches."""
        if pattern.literal is not None:
            group = self._groups.get(pattern.literal.partition("[")[0], {})
            return iter([pattern.literal] if pattern.literal in group else [])
        groups = self._groups.values() if pattern.group is None else [self._groups.get(pattern.group, {})]
        return filter(pattern.matches, chain.from_iterable(groups))

    def has_match(self, pattern: Pattern) -> bool:
        """Return whether a pattern matches one of the names."""
        return next(self.matching(pattern), None) is not None

    def __iter__(self) -> Iterator[str]:
        return chain.from_iterable(self._groups.values())


def check_names(lookup: Lookup, groups: list[Group], errors: ErrorCollector) -> list[Source]:
    """Report keys that name no node, no group and no other part of the network.

    Returns the lines about nodes that this run does not have, and other runs may have.
    """
    elsewhere: list[Source] = []
    names = _Names(
        [
            *NETWORK_MODULES,
            *(name for group in groups for name in (group.size_key, group.name)),
            *(name for group in groups for name in group.node_names() or [f"{group.name}[0]"]),
        ]
    )
    for found in lookup.found:
        name = found.name_pattern()
        if name is None:
            continue
        assert found.parts is not None
        if not found.parts[0].matches(lookup.network):
            errors.add(_unknown_name(found, groups, lookup))
        elif not names.has_match(name):
            group = next((group for group in groups if group.name == name.group), None)
            size = group.size_found if group else None
            if group is None or size is None:
                errors.add(_unknown_name(found, groups, lookup))
            elif (
                size.entry.rank < found.entry.rank or distribution_in(size.entry.text) or group.has_wrong_size
            ):
                pass  # a more specific section has reduced the group, or another seed may draw the index
            elif "${" in size.entry.source.value:
                elsewhere.append(found.entry.source)
            else:
                errors.add(_unknown_name(found, groups, lookup))
    return elsewhere


def check_parameters(
    lookup: Lookup,
    groups: list[Group],
    kinds: Mapping[str, ProtocolAndInterfaces],
    obstacles: int,
    errors: ErrorCollector,
) -> None:
    """Report keys that name no parameter. Those that name no node are reported before.

    `kinds` are by the names of nodes, and `obstacles` is the number of obstacles that have keys.
    """
    of_node = [key.path for key in NODE_KEYS]
    of_network = [key.path for key in NETWORK_KEYS if key not in OBSTACLE_KEYS]
    of_network += [obstacle_path(key, index) for index in range(obstacles) for key in OBSTACLE_KEYS]
    modules: dict[str, list[str]] = {}
    for path in of_network:
        module, end = path.split(".", 1)
        modules.setdefault(module, []).append(end)
    nodes: dict[ProtocolAndInterfaces, list[str]] = {}
    for node, kind in kinds.items():
        nodes.setdefault(kind, []).append(node)
    below: list[tuple[_Names, Iterable[str]]] = [
        (_Names(group.size_key for group in groups), [""]),
        (_Names(group.name for group in groups), [GROUP_SIZE.path]),
        (_Names(f"{group.name}[0]" for group in groups if group.size == 0), of_node),
        *((_Names([module]), rests) for module, rests in modules.items()),
        *((_Names(names), _rests_of(kind)) for kind, names in nodes.items()),
    ]
    matched = {
        candidate.found
        for names, rests in below
        for rest in rests
        for candidate in lookup.candidates(rest).every
        if _matches(candidate, names, rest, lookup.network)
    }
    of_any_node = {candidate.found for rest in of_node for candidate in lookup.candidates(rest).every}
    all_nodes = _Names(kinds)
    others = _Names([*NETWORK_MODULES, *(group.name for group in groups if group.size is not None)])
    for found in lookup.found:
        if found in matched:
            continue
        name, rest = found.name_pattern(), found.rest_pattern()
        named = {kinds[node] for node in all_nodes.matching(name)} if name else set()
        is_elsewhere = name is not None and not named and not others.has_match(name)
        if is_elsewhere and rest and (found in of_any_node or rest.literal_prefix().startswith(_PROTOCOL)):
            continue  # the group is empty, or smaller than this key was written for
        classes = sorted({kind.protocol for kind in named or nodes}, key=lambda cls: cls.__name__)
        errors.add(_unknown_parameter(found, groups, classes))


def _matches(candidate: Candidate, names: _Names, rest: str, network: str) -> bool:
    """Return whether an entry that can match a rest does so below one of the names."""
    if candidate.name is not None:
        return names.has_match(candidate.name)
    return any(candidate.matches(network, rest, name) for name in names)


def _rests_of(kind: ProtocolAndInterfaces) -> list[str]:
    """Return the paths below a node."""
    further = [at_interface(key.path, index) for index in range(1, kind.interface_count) for key in WLAN_KEYS]
    parameters = [f"protocol.{name}" for name in parameters_of(kind.protocol)]
    return [key.path for key in NODE_KEYS] + further + parameters


_PROTOCOL = "protocol."


def _sizes_that_lack(lookup: Lookup, groups: Sequence[Group]) -> list[str]:
    """Return `numUavs` and so on, of the groups that keys name and that have no number of nodes."""
    known = {group.name for group in groups}
    names = (found.parts[1].text.partition("[") for found in lookup.found if found.parts)
    lacking = dict.fromkeys(name for name, bracket, _ in names if bracket and name not in known)
    return [f"num{name[:1].upper()}{name[1:]}" for name in lacking]


def _unknown_name(found: Found, groups: Sequence[Group], lookup: Lookup) -> ConfigError:
    """Return the error for a key that names no node and no part of the network."""
    key, source, network = found.entry.key, found.entry.source, lookup.network
    if not found.parts or not found.parts[0].matches(network):
        return ConfigError(
            f"`{key}` does not begin with `*.` or `**.`, nor with the network's name `{network}.`",
            source,
            expected="a key such as `*.uavs[*].mobility.speed`",
            suggestion=_nearest_key(key, groups, ()),
        )
    problem = f"`{key}` matches no node"
    base, bracket, _ = found.parts[1].text.partition("[")
    if re.fullmatch(r"num(?!ber)[a-z]\w*", base) and len(found.parts) == 2:
        size = f"*.num{base[3].upper()}{base[4:]}"
        expected = "a capital letter where the group's name begins"
        return NoSuchNodeError(problem, source, expected=expected, suggestion=size)
    if len(found.parts) == 2 and (size := nearest(base, _sizes_that_lack(lookup, groups))):
        expected = "the number of nodes of a group"
        return NoSuchNodeError(problem, source, expected=expected, suggestion=f"*.{size}")
    match = nearest(base, [*(group.name for group in groups), *NETWORK_MODULES])
    group = next((group for group in groups if group.name == match), None)
    suggestion, hint = "", "" if group else _instead_of_module([base])
    if match and not hint:
        parts = [found.parts[0].text, group.written if group else match]
        suggestion = ".".join([*parts, *(part.text for part in found.parts[2:])])
    elif not hint and not bracket and is_misspelled_class(found.rest_pattern()):
        suggestion = f"{found.parts[0].text}.{base}.{PROTOCOL_CLASS.path}"
    elif not hint and not bracket:
        suggestion = _nearest_key(key, groups, ())
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
    suggestion = written_for(_nearest_key(key, groups, classes, _prefix_of_nodes(found, groups)), key)
    return ConfigError(problem, source, expected=expected, suggestion=suggestion)


def _is_of_first_interface(end: str) -> bool:
    """Return whether wlan[0] has a key with that end: `.radio.channelNumber`."""
    of_first = compile_pattern(f"{WLAN}{end}")
    return any(of_first.matches(key.path) for key in WLAN_KEYS)


def _nearest_key(
    key: str, groups: Sequence[Group], classes: Sequence[type[IProtocol]], prefix: str = ""
) -> str:
    """Return the key that may be meant, as users write it: one with more parts, or a similar one.

    It begins with `prefix`, if that is given, and otherwise as `key` does, with `*.` or `**.`.
    """
    rests = [node_key.written for node_key in NODE_KEYS]
    rests += [f"{_PROTOCOL}{name}" for cls in classes for name in parameters_of(cls)]
    keys = [prefix + rest for rest in rests]
    if not prefix:
        keys = [f"*.{network_key.written}" for network_key in NETWORK_KEYS]
        for group in groups:
            keys += [f"*.{group.size_key}", *(f"*.{group.written}.{rest}" for rest in rests)]
    similar = keys
    if key.startswith("**."):
        keys = [f"**.{rest}" for rest in rests] + [f"*{written}" for written in keys]
        parts = key.count(".")
        similar = list(dict.fromkeys("**." + ".".join(written.split(".")[-parts:]) for written in keys))
    longer = sorted((len(written.split(".")), written) for written in keys if _lacks_only_parts(key, written))
    is_clear = len(longer) == 1 or (len(longer) > 1 and longer[0][0] < longer[1][0])
    return longer[0][1] if is_clear else nearest(key, similar)


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
    attribute = next((value for cls in classes if (value := getattr(cls, name, None)) is not None), None)
    match = nearest(name, parameters)
    if attribute is not None:
        problem += f", it is of type {type(attribute).__name__} and not a plain public value"
    elif any(hasattr(cls, name) or _is_declared(cls, name) for cls in classes):
        is_none = any(hasattr(cls, name) for cls in classes)
        has = "its value in the class is None" if is_none else "the class gives it no value"
        problem += f": {has}, and not a value such as `{name} = 0`"
        match = ""
    suggestion = f"{key.removesuffix(name)}{match}" if match else ""
    return ConfigError(problem, source, expected=f"one of {', '.join(parameters)}", suggestion=suggestion)


def _is_declared(cls: type[IProtocol], name: str) -> bool:
    """Return whether the class declares an attribute without a value, or its constructor sets it."""
    names_in_constructor = getattr(getattr(cls.__init__, "__code__", None), "co_names", ())
    bases = (base for base in cls.__mro__ if base not in IProtocol.__mro__)
    return name in names_in_constructor or any(name in annotations_of(base) for base in bases)


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
