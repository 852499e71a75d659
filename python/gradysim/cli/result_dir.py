"""The folder of --result-dir, and the names of files in it: tried before runs that take hours."""

import errno
import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.cli.arguments import Mode
from gradysim.cli.asked import Asked
from gradysim.cli.files_of_run import files_for_omnetpp
from gradysim.cli.simulators import capture_files_of

if TYPE_CHECKING:
    from gradysim.scenario.scenario import Scenario

_LONGEST_PID = 2**22
"""As Linux counts. Files that are being written have the number of the process at the end of their names."""


def make_result_dir(directory: Path) -> None:
    """Make the folder of --result-dir. Raises ConfigError, which names the option."""
    from gradysim.scenario.errors.config_error import ConfigError

    try:
        directory.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        reason = "it is no folder" if os.path.lexists(directory) else error.strerror or str(error)
        raise ConfigError(f"--result-dir {directory}: {reason}; expected a folder, or a new name") from error


def check_may_be_written_to(directory: Path) -> None:
    """Raise ConfigError, which names the option, if no file can be made in it."""
    from gradysim.scenario.errors.config_error import ConfigError

    if not os.access(directory, os.W_OK | os.X_OK):
        raise ConfigError(f"--result-dir {directory}: it takes no files from you; expected another folder")


def check_sqlite(asked: Asked) -> None:
    """Raise ConfigError for files that this Python cannot write, before runs that take hours."""
    if not (asked.scalars or asked.vectors):
        return
    try:
        import sqlite3  # noqa: F401
    except ImportError as error:
        from gradysim.scenario.errors.config_error import ConfigError

        option = "--scalars" if asked.scalars else f"--vectors {asked.vectors[0]}"
        raise ConfigError(f"{option}: {error}; expected a Python with the module sqlite3") from error


def check_file_names(scenarios: "Sequence[Scenario]", mode: Mode, asked: Asked) -> None:
    """Raise ConfigError for a name of a file that is too long for the folder, before the first run begins."""
    from gradysim.scenario.errors.config_error import ConfigError

    last = scenarios[-1]  # with the longest number
    folders = (asked.directory, *asked.directory.parents)
    there = next((folder for folder in folders if folder.is_dir()), Path())  # captures make theirs themselves
    for file in _all_files(last, mode, asked):
        try:
            os.lstat(there / file.name)
        except OSError as error:
            if error.errno == errno.ENAMETOOLONG:
                raise ConfigError(
                    f"--result-dir {asked.directory}: {file.name} would be too long a name of a file in it;"
                    " expected a shorter name of the configuration"
                ) from error


def _all_files(scenario: "Scenario", mode: Mode, asked: Asked) -> Iterator[Path]:
    """Give the files that a run will write, those that are renamed once they are complete as until then."""
    from gradysim.results.files import run_file

    yield from capture_files_of(scenario, asked)
    complete = files_for_omnetpp(scenario, mode, asked)
    if asked.result_dir is not None:
        complete.append(run_file(asked.directory, scenario.config, scenario.run_number, mode))
    for file in complete:
        yield file.with_name(f"{file.name}.{_LONGEST_PID}")
