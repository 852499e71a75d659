"""Reports keys that match nothing. A misspelled name is an error and never a default value.

There are two checks of keys: names of nodes first, and parameters once the classes of the protocols are
loaded, which declare some of them. Each error has the nearest valid key, if there is one.
"""

import re
from collections.abc import Iterable, Sequence

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.errors import ConfigError, ErrorCollector, Source, nearest
from gradysim.scenario.parse.distributions import distribution_in
from gradysim.scenario.parse.patterns import Pattern, compile_pattern
from gradysim.scenario.resolve.groups import Group
from gradysim.scenario.resolve.lines import Line, Lines, id_of
from gradysim.scenario.resolve.resolution import Resolution, is_misspelled_class, node_schema
from gradysim.scenario.schema.keys import (
    NETWORK_KEYS,
    NETWORK_MODULES,
    NODE_KEYS,
    PROTOCOL_CLASS,
    WLAN,
    WLAN_KEYS,
    interface_in,
    written_for,
)
from gradysim.scenario.schema.parameters import annotations_of, parameters_of


class NoSuchNodeError(ConfigError):
    """A key names a node or a group that does not exist."""


def check_names(lines: Lines, groups: list[Group], errors: ErrorCollector) -> list[Source]:
    """Report keys that name no node, no group and no other part of the network.

    Returns the lines about nodes that this run does not have, and other runs may have.
    """
    elsewhere: list[Source] = []
    known = lines.patterns_of(
        [
            *NETWORK_MODULES,
            *(name for group in groups for name in (group.size_key, group.name)),
            *(name for group in groups for name in group.node_names() or [f"{group.name}[0]"]),
        ]
    )
    by_name = {group.name: group for group in groups}
    for line in lines.all:
        name = line.name_pattern
        if name is None:
            continue
        assert line.parts is not None
        if not line.parts[0].matches(lines.network):
            errors.add(_unknown_name(line, groups, lines))
        elif id_of(name) not in known:
            group = by_name.get(name.group or "")
            size = group.size_line if group else None
            if group is None or size is None:
                errors.add(_unknown_name(line, groups, lines))
            elif (
                size.entry.rank < line.entry.rank or distribution_in(size.entry.text) or group.has_wrong_size
            ):
                pass  # a more specific section has reduced the group, or another seed may draw the index
            elif "${" in size.entry.source.value:
                elsewhere.append(line.entry.source)
            else:
                errors.add(_unknown_name(line, groups, lines))
    return elsewhere


def check_parameters(resolution: Resolution, errors: ErrorCollector) -> None:
    """Report keys that name no parameter: lines without a row.

    Those that name no node are reported before.
    """
    lines, groups = resolution.lines, resolution.groups
    matched = resolution.matched()
    unmatched = [line for line in lines.all if line not in matched]
    if not unmatched:
        return
    named: dict[str, set[type[IProtocol]]] = {}
    for node, kind in resolution.kinds.items():
        for text in lines.patterns_of([node]):
            named.setdefault(text, set()).add(kind.protocol.cls)
    all_classes = {kind.protocol.cls for kind in resolution.kinds.values()}
    others = lines.patterns_of(
        [*NETWORK_MODULES, *(group.name for group in groups if group.size is not None)]
    )
    for line in unmatched:
        name, rest = line.name_pattern, line.rest_pattern
        text = id_of(name) if name else ""
        is_elsewhere = name is not None and text not in named and text not in others
        if is_elsewhere and rest and (_is_of_nodes(rest) or rest.literal_prefix().startswith(_PROTOCOL)):
            continue  # the group is empty, or smaller than this key was written for
        classes = sorted(named.get(text) or all_classes, key=lambda cls: cls.__name__)
        errors.add(_unknown_parameter(line, groups, classes))


def _is_of_nodes(rest: Pattern) -> bool:
    return bool(node_schema(1).matching(rest, ""))


_PROTOCOL = "protocol."


def _sizes_that_lack(lines: Lines, groups: Sequence[Group]) -> list[str]:
    """Return `numUavs` and so on, of the groups that keys name and that have no number of nodes."""
    known = {group.name for group in groups}
    names = (line.parts[1].text.partition("[") for line in lines.all if line.parts)
    lacking = dict.fromkeys(name for name, bracket, _ in names if bracket and name not in known)
    return [f"num{name[:1].upper()}{name[1:]}" for name in lacking]


def _unknown_name(line: Line, groups: Sequence[Group], lines: Lines) -> ConfigError:
    """Return the error for a key that names no node and no part of the network."""
    key, source, network = line.entry.key, line.entry.source, lines.network
    if not line.parts or not line.parts[0].matches(network):
        return ConfigError(
            f"`{key}` does not begin with `*.` or `**.`, nor with the network's name `{network}.`",
            source,
            expected="a key such as `*.uavs[*].mobility.speed`",
            suggestion=_nearest_key(key, groups, ()),
        )
    problem = f"`{key}` matches no node"
    base, bracket, _ = line.parts[1].text.partition("[")
    if re.fullmatch(r"num(?!ber)[a-z]\w*", base) and len(line.parts) == 2:
        size = f"*.num{base[3].upper()}{base[4:]}"
        expected = "a capital letter where the group's name begins"
        return NoSuchNodeError(problem, source, expected=expected, suggestion=size)
    if len(line.parts) == 2 and (size := nearest(base, _sizes_that_lack(lines, groups))):
        expected = "the number of nodes of a group"
        return NoSuchNodeError(problem, source, expected=expected, suggestion=f"*.{size}")
    match = nearest(base, [*(group.name for group in groups), *NETWORK_MODULES])
    group = next((group for group in groups if group.name == match), None)
    suggestion, hint = "", "" if group else _instead_of_module([base])
    if match and not hint:
        parts = [line.parts[0].text, group.written if group else match]
        suggestion = ".".join([*parts, *(part.text for part in line.parts[2:])])
    elif not hint and not bracket and is_misspelled_class(line.rest_pattern):
        suggestion = f"{line.parts[0].text}.{base}.{PROTOCOL_CLASS.path}"
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


def _unknown_parameter(
    line: Line, groups: Sequence[Group], classes: Sequence[type[IProtocol]]
) -> ConfigError:
    """Return the error for a key that names no parameter. `classes` are those of the nodes it names."""
    key, source = line.entry.key, line.entry.source
    rest = line.rest_pattern
    names_node = line.parts is not None and line.parts[1].text.partition("[")[0] not in NETWORK_MODULES
    if rest is not None and names_node and rest.text.startswith(_PROTOCOL) and classes:
        return _unknown_protocol_parameter(line, rest, classes)
    problem, expected = f"`{key}` matches no parameter", "the name of one"
    interface = interface_in(key)
    if interface and _is_of_first_interface(key[interface.end() :]):  # the nearest key would be this one
        expected = "one of an interface that `numWlanInterfaces` of the node counts"
        return ConfigError(problem, source, expected=expected)
    if rest is not None and not names_node and rest.text.startswith("obstacle["):
        expected = "one of an obstacle that `*.environment.numObstacles` counts"
    if hint := _instead_of_module(key.split(".")[1 if key.startswith("**.") else 2 :]):
        return ConfigError(problem, source, expected=expected, hint=hint)
    suggestion = written_for(_nearest_key(key, groups, classes, _prefix_of_nodes(line, groups)), key)
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


def _prefix_of_nodes(line: Line, groups: Sequence[Group]) -> str:
    """Return the start of keys of the nodes that a key names, `*.uavs[*].`, or "" if it names none."""
    if not line.parts or len(line.parts) != 3:
        return ""
    network, name, _ = line.parts
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


def _unknown_protocol_parameter(line: Line, rest: Pattern, classes: Sequence[type[IProtocol]]) -> ConfigError:
    key, source = line.entry.key, line.entry.source
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
