"""What checks and builds the runs of either mode, and which of their nodes options name."""

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from gradysim.cli.arguments import Mode
from gradysim.cli.asked import Asked

if TYPE_CHECKING:
    from gradysim.cli.execution import Run
    from gradysim.scenario.node.node_spec import NodeSpec
    from gradysim.scenario.scenario import Scenario


class Check(Protocol):
    """Checks a scenario, and says what is wrong by a ConfigError."""

    def __call__(self, scenario: "Scenario", *, is_built_next: bool) -> None:
        """Check it, but for what its run checks when `is_built_next`: a network is checked by building it."""


def simulator(mode: Mode, asked: Asked) -> "tuple[Check, Callable[[Scenario], Run]]":
    """Return what checks a scenario for `mode` and what builds its run; the other mode is not imported.

    Raises ConfigError for options that need frames and a mode without.
    """
    if mode == "prototype":
        from gradysim.prototype.run import PrototypeRun
        from gradysim.prototype.simulation import check_scenario

        require_no_names("--pcap", asked.pcap, "no frames to capture")
        require_no_names("--fates-at", asked.fates_at, "no fates of frames")

        def check_all(scenario: "Scenario", *, is_built_next: bool) -> None:
            check_scenario(scenario)

        def build_prototype(scenario: "Scenario") -> "Run":
            return PrototypeRun(scenario, vectors_of=_ids(nodes_of_vectors(scenario, asked)))

        return check_all, build_prototype

    from gradysim.integrated.network import check_scenario as check_network
    from gradysim.integrated.run import IntegratedRun

    def check(scenario: "Scenario", *, is_built_next: bool) -> None:
        if not is_built_next:
            check_network(scenario)

    def build(scenario: "Scenario") -> "Run":
        return IntegratedRun(
            scenario,
            captures(scenario, asked),
            fates_at=ids_of_fates(scenario, asked),
            vectors_of=_ids(nodes_of_vectors(scenario, asked)),
        )

    return check, build


def require_no_names(option: str, names: Iterable[str], reason: str) -> None:
    """Raise ConfigError if an option was given names of nodes, which prototype mode can do nothing for."""
    from gradysim.scenario.errors.config_error import ConfigError

    for name in names:
        raise ConfigError(f"{option} {name}: prototype mode has {reason}; expected --mode integrated")


def check_names(scenarios: "Sequence[Scenario]", asked: Asked) -> None:
    """Raise ConfigError for a name that an option was given, and that no node has in any of these runs."""
    from gradysim.scenario.node_names import check_node_names

    for option, names in (
        ("--pcap", asked.pcap),
        ("--fates-at", asked.fates_at),
        ("--vectors", asked.vectors),
    ):
        check_node_names(scenarios, names, option)


def ids_of_fates(scenario: "Scenario", asked: Asked) -> list[int]:
    """Return the ids of the nodes that --fates-at names."""
    from gradysim.scenario.node_names import nodes_named

    return _ids(nodes_named(scenario, asked.fates_at))


def nodes_of_vectors(scenario: "Scenario", asked: Asked) -> "list[NodeSpec]":
    """Return the nodes that --vectors names."""
    from gradysim.scenario.node_names import nodes_named

    return nodes_named(scenario, asked.vectors)


def captures(scenario: "Scenario", asked: Asked) -> dict[int, Path]:
    """Return {id of a node: its capture file} of one run."""
    from gradysim.integrated.capture import capture_files

    return capture_files(scenario, asked.pcap, asked.directory)


def capture_files_of(scenario: "Scenario", asked: Asked) -> list[Path]:
    """Return the capture files of all radios of the nodes that --pcap names."""
    if not asked.pcap:
        return []
    from gradysim.integrated.capture import files_of_interfaces

    return list(files_of_interfaces(scenario, captures(scenario, asked)).values())


def _ids(nodes: "Iterable[NodeSpec]") -> list[int]:
    return [node.id for node in nodes]
