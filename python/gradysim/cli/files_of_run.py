"""The names of the files that `gradysim run` was asked to write of a run, beside its result."""

from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.cli.arguments import Mode
from gradysim.cli.asked import Asked
from gradysim.cli.simulators import capture_files_of

if TYPE_CHECKING:
    from gradysim.scenario.scenario import Scenario


def omnetpp_file(scenario: "Scenario", mode: Mode, asked: Asked, suffix: str) -> Path:
    """Return the file of a run's scalars, `.sca`, or vectors, `.vec`."""
    from gradysim.results.files import run_file

    return run_file(asked.directory, scenario.config, scenario.run_number, mode, suffix)


def files_beside_result(scenario: "Scenario", mode: Mode, asked: Asked) -> list[Path]:
    """Return all files of a run that are asked for, but for that of its result."""
    return [*capture_files_of(scenario, asked), *files_for_omnetpp(scenario, mode, asked)]


def files_for_omnetpp(scenario: "Scenario", mode: Mode, asked: Asked) -> list[Path]:
    """Return the file of scalars and that of vectors, as far as they are asked for, in this order."""
    suffixes = [*([".sca"] if asked.scalars else []), *([".vec"] if asked.vectors else [])]
    return [omnetpp_file(scenario, mode, asked, suffix) for suffix in suffixes]
