"""What checks and builds the runs of either mode, with capture files or without."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.commands.arguments import Mode

if TYPE_CHECKING:
    from gradysim.config.scenario import Scenario
    from gradysim.report.supervised_run import Run


def simulator(mode: Mode) -> "tuple[Callable[[Scenario], None], Callable[[Scenario], Run]]":
    """Return what checks a scenario for `mode` and what builds its run; the other mode is not imported."""
    if mode == "prototype":
        from gradysim.prototype.run import PrototypeRun
        from gradysim.prototype.simulation import check_scenario

        return check_scenario, PrototypeRun
    from gradysim.integrated.network import check_scenario
    from gradysim.integrated.run import IntegratedRun

    return check_scenario, IntegratedRun


def capturing_simulator(
    mode: Mode, pcap: Sequence[str], result_dir: Path | None
) -> "tuple[Callable[[Scenario], None], Callable[[Scenario], Run]]":
    """The same for runs that write capture files. Raises ConfigError for a mode without frames."""
    from gradysim.config.error import ConfigError

    if mode == "prototype":
        raise ConfigError(
            f"--pcap {pcap[0]}: prototype mode has no frames to capture; expected --mode integrated"
        )
    from gradysim.integrated.network import check_scenario
    from gradysim.integrated.run import IntegratedRun

    def check(scenario: "Scenario") -> None:
        check_scenario(scenario)
        captures(scenario, pcap, result_dir)

    return check, lambda scenario: IntegratedRun(scenario, captures(scenario, pcap, result_dir))


def captures(scenario: "Scenario", pcap: Sequence[str], result_dir: Path | None) -> dict[int, Path]:
    """Return {id of a node: its capture file} of one run. Raises ConfigError for an unknown name."""
    from gradysim.integrated.capture import capture_files

    return capture_files(scenario, pcap, Path("results") if result_dir is None else result_dir)


def files_written(scenario: "Scenario", captures: Mapping[int, Path]) -> Iterable[Path]:
    """Return the capture files of all radios of these nodes."""
    from gradysim.integrated.capture import files_of_interfaces

    return files_of_interfaces(scenario, captures).values()
