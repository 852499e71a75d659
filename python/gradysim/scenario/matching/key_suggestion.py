"""What to say about a key that matches nothing: what was expected there, and the nearest valid key."""

import re
from collections.abc import Sequence

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.errors.nearest import did_you_mean, misspelt, nearest
from gradysim.scenario.keys import (
    NETWORK_KEYS,
    NETWORK_MODULES,
    NODE_KEYS,
    PROTOCOL_CLASS,
    PROTOCOL_KEYS,
    WLAN,
    WLAN_KEYS,
    interface_in,
    written_for,
)
from gradysim.scenario.matching.groups import Group
from gradysim.scenario.matching.inet_modules import instead_of_module
from gradysim.scenario.matching.lookup import Found
from gradysim.scenario.parameters import annotations_of, parameters_of
from gradysim.scenario.patterns import Pattern, compile_pattern

_PROTOCOL = "protocol."


def unknown_name_text(found: Found, groups: Sequence[Group], network: str) -> str:
    """The message for a key that names no node and no part of the network."""
    key = found.entry.key
    if not found.parts or not found.parts[0].matches(network):
        problem = f"`{key}` does not begin with `*.` or `**.`, nor with the network's name `{network}.`"
        hint = did_you_mean(key, _written_keys(key, groups, ()))
        return f"{problem}; expected a key such as `*.uavs[*].mobility.speed`{hint}"
    base, bracket, _ = found.parts[1].text.partition("[")
    if re.fullmatch(r"num(?!ber)[a-z]\w*", base) and len(found.parts) == 2:
        size = f"`*.num{base[3].upper()}{base[4:]}`"
        return f"`{key}` matches no node; expected a capital letter where the group's name begins: {size}"
    inets = instead_of_module([base])
    match = nearest(base, [*(group.name for group in groups), *NETWORK_MODULES])
    group = next((group for group in groups if group.name == match), None)
    if inets and not any(group.name == match for group in groups):
        hint = inets
    elif match is not None:
        nearest_parts = [found.parts[0].text, group.written if group else match]
        nearest_parts += [part.text for part in found.parts[2:]]
        hint = f"; did you mean `{'.'.join(nearest_parts)}`?"
    elif not bracket and is_misspelt_class(found.rest_pattern()):
        hint = f"; did you mean `{found.parts[0].text}.{base}.{PROTOCOL_CLASS.path}`?"
    else:
        hint = "" if bracket else did_you_mean(key, _written_keys(key, groups, ()))
    if group is not None and group.name == base:
        has = f"nodes {base}[0] to {base}[{group.size - 1}]" if group.size else "one node, without index"
        return f"`{key}` matches no node; expected `{base}` as it is, with {has}{hint}"
    if bracket and not hint:
        size = f"`*.num{base[:1].upper()}{base[1:]} = ...`"
        return f"`{key}` matches no node: nothing says how many `{base}` there are; expected {size}"
    if not groups:
        line = f'`*.{base if base.isidentifier() else "uav"}.{PROTOCOL_CLASS.path} = "file.py:Class"`'
        return f"`{key}` matches no node; expected a line that makes one, such as {line}{hint}"
    names = ", ".join(f"`{group.written}`" for group in groups)
    return f"`{key}` matches no node; expected one of {names}{hint}"


def is_misspelt_class(rest: Pattern | None) -> bool:
    """Whether what stands below a node's name was meant as `protocol.class`, and is something else."""
    if rest is None or rest.literal is None or rest.literal == PROTOCOL_CLASS.path:
        return False
    paths = [key.path for key in PROTOCOL_KEYS]
    return rest.literal == "protocol" or misspelt(rest.literal, paths) == PROTOCOL_CLASS.path


def unknown_parameter_text(found: Found, groups: Sequence[Group], classes: Sequence[type[IProtocol]]) -> str:
    """The message for a key that names no parameter. `classes` are those of the nodes it names."""
    key = found.entry.key
    rest = found.rest_pattern()
    names_node = found.parts is not None and found.parts[1].text.partition("[")[0] not in NETWORK_MODULES
    if rest is not None and names_node and rest.text.startswith(_PROTOCOL) and classes:
        return _unknown_protocol_parameter_text(key, rest, classes)
    expected = "the name of one"
    if rest is not None and not names_node and rest.text.startswith("obstacle["):
        expected = "one of an obstacle that `*.environment.numObstacles` counts"
    interface = interface_in(key)
    if interface and _is_of_first_interface(key[interface.end() :]):  # the nearest key would be this one
        expected = "one of an interface that `numWlanInterfaces` of the node counts"
        return f"`{key}` matches no parameter; expected {expected}"
    below_node = key.split(".")[1 if key.startswith("**.") else 2 :]
    hint = instead_of_module(below_node) or written_for(_hint(found, groups, classes), key)
    return f"`{key}` matches no parameter; expected {expected}{hint}"


def _is_of_first_interface(end: str) -> bool:
    """Whether there is such a key below wlan[0]: `.radio.channelNumber`."""
    of_first = compile_pattern(f"{WLAN}{end}")
    return any(of_first.matches(key.path) for key in WLAN_KEYS)


def _hint(found: Found, groups: Sequence[Group], classes: Sequence[type[IProtocol]]) -> str:
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
        return f"; did you mean `{with_more_parts[0]}`?"
    return did_you_mean(key, similar)


def _prefix_of_nodes(found: Found, groups: Sequence[Group]) -> str:
    """What keys of the nodes that a key names begin with, `*.uavs[*].`, or "" if it names none."""
    if not found.parts or len(found.parts) != 3:
        return ""
    network, name, _ = found.parts
    for group in groups:
        if name.literal == group.name:  # with nodes that have an index, it was forgotten
            return f"{network.text}.{group.written}."
    names_node = any(name.matches(node) for group in groups for node in group.node_names())
    return f"{network.text}.{name.text}." if names_node else ""


def _lacks_only_parts(key: str, candidate: str) -> bool:
    """Whether all parts of the key are in the candidate, in that order, and the last one is its last one."""
    interface = interface_in(key)
    wanted = (key.replace(interface[0], "wlan[*]") if interface else key).split(".")
    remaining = iter(candidate.split("."))
    return wanted[-1] == candidate.rpartition(".")[2] and all(part in remaining for part in wanted)


def _unknown_protocol_parameter_text(key: str, rest: Pattern, classes: Sequence[type[IProtocol]]) -> str:
    name = rest.text.removeprefix(_PROTOCOL)
    parameters = sorted(
        {"class", "typename", *(parameter for cls in classes for parameter in parameters_of(cls))}
    )
    whose = " or ".join(cls.__name__ for cls in classes)
    expected = f"expected one of {', '.join(parameters)}"
    attribute = next((value for cls in classes if (value := getattr(cls, name, None)) is not None), None)
    if attribute is None and any(_has_no_value(cls, name) for cls in classes):
        is_none = any(hasattr(cls, name) for cls in classes)
        problem = "its value in the class is None, and none" if is_none else "it has no value in the class,"
        return f"`{name}` is no parameter of {whose}, {problem} such as `{name} = 0`; {expected}"
    match = nearest(name, parameters)
    hint = f"; did you mean `{key.removesuffix(name)}{match}`?" if match else ""
    why = (
        ""
        if attribute is None
        else f", it is of type {type(attribute).__name__} and not a plain public value"
    )
    return f"`{name}` is no parameter of {whose}{why}; {expected}{hint}"


def _has_no_value(cls: type[IProtocol], name: str) -> bool:
    """Whether it is an attribute of the nodes, declared, None or set by the constructor."""
    names_in_constructor = getattr(getattr(cls.__init__, "__code__", None), "co_names", ())
    declared = any(name in annotations_of(base) for base in cls.__mro__ if base not in IProtocol.__mro__)
    return declared or hasattr(cls, name) or name in names_in_constructor


def _written_rests(classes: Sequence[type[IProtocol]]) -> list[str]:
    """All keys below a node, as people write them."""
    parameters = [f"{_PROTOCOL}{name}" for cls in classes for name in parameters_of(cls)]
    return [key.written for key in NODE_KEYS] + parameters


def _written_keys(key: str, groups: Sequence[Group], classes: Sequence[type[IProtocol]]) -> list[str]:
    """All keys as people write them; only their ends if `key` begins with `**.`."""
    keys = [f"*.{network_key.written}" for network_key in NETWORK_KEYS]
    for group in groups:
        keys.append(f"*.{group.size_key}")
        keys += [f"*.{group.written}.{rest}" for rest in _written_rests(classes)]
    if not key.startswith("**."):
        return keys
    parts = key.count(".")
    return list(dict.fromkeys("**." + ".".join(written.split(".")[-parts:]) for written in keys))
