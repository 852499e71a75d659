"""What checks and builds the runs of either mode, with capture files and fates at single nodes or without."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from gradysim.commands.arguments import Mode

if TYPE_CHECKING:
    from gradysim.config.scenario import Scenario
    from gradysim.report.supervised_run import Run


class Check(Protocol):
    """Checks a scenario, and says what is wrong by a ConfigError."""

    def __call__(self, scenario: "Scenario", *, is_built_next: bool) -> None:
        """Check it, but for what its run checks when `is_built_next`: a network is checked by building it."""


def simulator(
    mode: Mode, pcap: Sequence[str] = (), fates_at: Sequence[str] = (), result_dir: Path | None = None
) -> "tuple[Check, Callable[[Scenario], Run]]":
    """Return what checks a scenario for `mode` and what builds its run; the other mode is not imported.

    Raises ConfigError for options that need frames and a mode without.
    """
    if mode == "prototype":
        from gradysim.prototype.run import PrototypeRun
        from gradysim.prototype.simulation import check_scenario

        require_no_names("--pcap", pcap, "no frames to capture")
        require_no_names("--fates-at", fates_at, "no fates of frames")

        def check_all(scenario: "Scenario", *, is_built_next: bool) -> None:
            check_scenario(scenario)

        return check_all, PrototypeRun

    from gradysim.integrated.network import check_scenario as check_network
    from gradysim.integrated.run import IntegratedRun

    def check(scenario: "Scenario", *, is_built_next: bool) -> None:
        if not is_built_next:
            check_network(scenario)
        captures(scenario, pcap, result_dir)
        ids_of_fates(scenario, fates_at)

    def build(scenario: "Scenario") -> "Run":
        return IntegratedRun(
            scenario, captures(scenario, pcap, result_dir), fates_at=ids_of_fates(scenario, fates_at)
        )

    return check, build


def require_no_names(option: str, names: Sequence[str], reason: str) -> None:
    """Raise ConfigError if an option was given names of nodes, which prototype mode can do nothing for."""
    from gradysim.config.errors.config_error import ConfigError

    if names:
        raise ConfigError(f"{option} {names[0]}: prototype mode has {reason}; expected --mode integrated")


def ids_of_fates(scenario: "Scenario", fates_at: Sequence[str]) -> list[int]:
    """Return the ids of the nodes that --fates-at names. Raises ConfigError for an unknown name."""
    from gradysim.config.node_names import nodes_named

    return [node.id for node in nodes_named(scenario, fates_at, "--fates-at")]


def captures(scenario: "Scenario", pcap: Sequence[str], result_dir: Path | None) -> dict[int, Path]:
    """Return {id of a node: its capture file} of one run. Raises ConfigError for an unknown name."""
    from gradysim.integrated.capture import capture_files

    return capture_files(scenario, pcap, Path("results") if result_dir is None else result_dir)


def files_written(scenario: "Scenario", captures: Mapping[int, Path]) -> Iterable[Path]:
    """Return the capture files of all radios of these nodes."""
    from gradysim.integrated.capture import files_of_interfaces

    return files_of_interfaces(scenario, captures).values()
