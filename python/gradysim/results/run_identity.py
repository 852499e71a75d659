"""What tells a run from all others, in the words of OMNeT++'s result files."""

import os
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime, timedelta
from pathlib import Path

from gradysim.results.run_result import Mode, RunResult
from gradysim.scenario.runs.iterations import PREDEFINED
from gradysim.scenario.scenario import Scenario


@dataclass(frozen=True)
class RunIdentity:
    """The same in all files of one run: readers take them for one run by it.

    Attributes:
        name: No other run has it.
        attributes: Run attributes by name.
        iterations: The value of each iteration variable that has a name, as the .ini file writes it.
        settings: The lines of the .ini file that this run consists of, overrides first.
    """

    name: str
    attributes: Mapping[str, str]
    iterations: Mapping[str, str]
    settings: tuple[tuple[str, str], ...]


def identity_of(result: RunResult, scenario: Scenario, directory: Path) -> RunIdentity:
    """Return the identity of a run that has just ended, whose results go to `directory`."""
    began = datetime.now() - timedelta(seconds=result.wall_s)
    attributes = {
        **lasting_attributes(scenario, result.mode, interrupted=result.interrupted),
        "inifile": str(scenario.file),
        "datetime": f"{began:%Y%m%d-%H:%M:%S}",
        "datetimef": f"{began:%Y%m%d-%H%M%S}",
        "processid": str(os.getpid()),
        "resultdir": str(directory),
    }
    return RunIdentity(
        name=f"{result.config}-{result.run}-{attributes['datetime']}-{attributes['processid']}",
        attributes=dict(sorted(attributes.items())),
        iterations={name: text for name, text in sorted(result.iterations.items()) if not name.isdigit()},
        settings=tuple((entry.key, entry.text) for entry in scenario.entries),
    )


def lasting_attributes(scenario: Scenario, mode: Mode, *, interrupted: bool = False) -> dict[str, str]:
    """Return the attributes of a run that are the same when it is done again, from wherever it is started."""
    known = scenario.variables
    return {
        **{name: known[name] for name in PREDEFINED if name in known and name != "inifile"},
        "mode": mode,
        "settings_hash": scenario.settings_hash,
        "interrupted": str(interrupted).lower(),
    }
