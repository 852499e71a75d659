"""Capture files: what the radios of some nodes sent and received, one pcap file for each radio."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.config.error import ConfigError
from gradysim.config.nearest import did_you_mean
from gradysim.config.scenario import NodeSpec, Scenario
from gradysim.integrated.engine_errors import errors_at, settings_by_target

if TYPE_CHECKING:
    from gradysim._netsim import Network

ALL = "all"
"""Stands for every node, unless a node or a group has that name."""


def capture_files(scenario: Scenario, names: Iterable[str], directory: Path) -> dict[int, Path]:
    """Return {id of a node: the file for what it sends and receives}, in the order of ids.

    `names` are those of nodes (`uavs[0]`), of groups (`uavs`), or `ALL`. The files are
    `directory`/CONFIG-#RUN-NODE.pcap. Raises ConfigError for a name that the scenario has not.
    """
    chosen = {node.id: node for name in names for node in nodes_named(scenario, name)}
    prefix = f"{scenario.config}-#{scenario.run_number}"
    return {node_id: directory / f"{prefix}-{chosen[node_id].name}.pcap" for node_id in sorted(chosen)}


def files_of_interfaces(scenario: Scenario, files: Mapping[int, Path]) -> dict[tuple[int, int], Path]:
    """Return {(id of a node, index of its interface): file}: that of wlan[1] is FILE-wlan1.pcap."""
    return {
        (node_id, index): file.with_name(f"{file.stem}-wlan{index}{file.suffix}") if index else file
        for node_id, file in files.items()
        for index in range(len(scenario.nodes[node_id].wlan))
    }


def nodes_named(scenario: Scenario, name: str) -> list[NodeSpec]:
    """Return the node or the nodes of the group of that name."""
    found = [node for node in scenario.nodes if name in (node.name, node.group)]
    if found:
        return found
    if name == ALL:
        return list(scenario.nodes)
    groups = list(dict.fromkeys(node.group for node in scenario.nodes))
    candidates = [*groups, *(node.name for node in scenario.nodes), ALL]
    suggestion = did_you_mean(name, candidates)
    raise ConfigError(
        f"--pcap {name}: no such node; expected a node such as {scenario.nodes[0].name}, "
        f"a group ({', '.join(groups)}) or {ALL}{suggestion}"
        if scenario.nodes
        else f"--pcap {name}: no such node; the scenario has none"
    )


def start_captures(network: "Network", scenario: Scenario, files: Mapping[int, Path]) -> None:
    """Open the capture files of all interfaces of these nodes; folders are made when missing.

    Raises ConfigError for a file that cannot be written, and for a medium without radios.
    """
    for (node_id, index), file in files_of_interfaces(scenario, files).items():
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise ConfigError(f"cannot write the capture file '{file}': {error}") from error
        with errors_at(settings_by_target("medium", scenario.medium)):
            network.capture(node_id, str(file), index)
