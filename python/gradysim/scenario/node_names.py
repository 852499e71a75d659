"""The nodes that options of the command line name: `uavs[0]`, `uavs`, `all`."""

from collections.abc import Iterable, Sequence

from gradysim.scenario.errors import ConfigError, nearest
from gradysim.scenario.node_spec import NodeSpec
from gradysim.scenario.scenario import Scenario

ALL = "all"
"""Stands for every node, unless a node or a group has that name."""


def nodes_named(scenario: Scenario, names: Iterable[str]) -> list[NodeSpec]:
    """Return the nodes with these names, each once, in the order of ids. Unknown names are ignored.

    `names` are those of nodes (`uavs[0]`), of groups (`uavs`), or `ALL`.
    """
    chosen = {node.id: node for name in names for node in _nodes_of(scenario, name)}
    return [chosen[node_id] for node_id in sorted(chosen)]


def check_node_names(scenarios: Sequence[Scenario], names: Iterable[str], option: str) -> None:
    """Raise ConfigError for the first name that exists in none of these runs of a configuration.

    `option` is the option that has the names, `--pcap`.
    """
    networks = list({id(scenario.nodes): scenario for scenario in scenarios}.values())
    for name in names:
        if not any(_nodes_of(scenario, name) for scenario in networks):
            raise _no_such_node(scenarios, name, option)


def _nodes_of(scenario: Scenario, name: str) -> Sequence[NodeSpec]:
    found = [node for node in scenario.nodes if name in (node.name, node.group)]
    return scenario.nodes if name == ALL and not found else found


def _no_such_node(scenarios: Sequence[Scenario], name: str, option: str) -> ConfigError:
    nodes = {node.name: node for scenario in scenarios for node in scenario.nodes}
    if not nodes:
        return ConfigError(f"{option} {name}: no such node; the scenario has none")
    groups = list(dict.fromkeys(node.group for node in nodes.values()))
    where = ""
    if len(scenarios) > 1:
        where = " in any of the runs"
    elif scenarios[0].run_count > 1:  # others may have it
        where = f" in run {scenarios[0].run_number}"
    return ConfigError(
        f"{option} {name}: no such node{where}",
        expected=f"a node such as {next(iter(nodes))}, a group ({', '.join(groups)}) or {ALL}",
        suggestion=nearest(name, [*groups, *nodes, ALL]),
    )
