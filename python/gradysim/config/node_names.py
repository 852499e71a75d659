"""The nodes that options of the command line name: `uavs[0]`, `uavs`, `all`."""

from collections.abc import Iterable

from gradysim.config.errors.config_error import ConfigError
from gradysim.config.errors.nearest import did_you_mean
from gradysim.config.node.node_spec import NodeSpec
from gradysim.config.scenario import Scenario

ALL = "all"
"""Stands for every node, unless a node or a group has that name."""


def nodes_named(scenario: Scenario, names: Iterable[str], option: str) -> list[NodeSpec]:
    """Return the nodes of these names, each once, in the order of ids.

    `names` are those of nodes (`uavs[0]`), of groups (`uavs`), or `ALL`; `option` is what they were given to,
    `--pcap`. Raises ConfigError for a name that the scenario has not.
    """
    chosen = {node.id: node for name in names for node in _nodes_of(scenario, name, option)}
    return [chosen[node_id] for node_id in sorted(chosen)]


def _nodes_of(scenario: Scenario, name: str, option: str) -> Iterable[NodeSpec]:
    found = [node for node in scenario.nodes if name in (node.name, node.group)]
    if found:
        return found
    if name == ALL:
        return scenario.nodes
    groups = list(dict.fromkeys(node.group for node in scenario.nodes))
    candidates = [*groups, *(node.name for node in scenario.nodes), ALL]
    suggestion = did_you_mean(name, candidates)
    where = f" in run {scenario.run_number}" if scenario.run_count > 1 else ""  # others may have it
    raise ConfigError(
        f"{option} {name}: no such node{where}; expected a node such as {scenario.nodes[0].name}, "
        f"a group ({', '.join(groups)}) or {ALL}{suggestion}"
        if scenario.nodes
        else f"{option} {name}: no such node; the scenario has none"
    )
