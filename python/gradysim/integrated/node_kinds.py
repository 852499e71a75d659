"""Nodes of a scenario that the same lines are in force for: what is true of one of them is true of all."""

from collections.abc import Iterable, Mapping, Sequence

from gradysim.scenario.node_spec import NodeSpec


def by_kind(nodes: Iterable[NodeSpec]) -> Mapping[object, Sequence[NodeSpec]]:
    """Group nodes: those with the same lines in force share their mappings."""
    kinds: dict[object, list[NodeSpec]] = {}
    for spec in nodes:
        kind = (spec.group, id(spec.protocol_sources), id(spec.mobility), *map(id, spec.wlan))
        kinds.setdefault(kind, []).append(spec)
    return kinds


def one_of_each_kind(nodes: Iterable[NodeSpec]) -> Iterable[NodeSpec]:
    """One node stands for all of its kind."""
    return [specs[0] for specs in by_kind(nodes).values()]
