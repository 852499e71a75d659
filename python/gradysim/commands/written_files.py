"""The files that a run of `gradysim run` leaves behind."""

import errno
import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.commands.arguments import Mode
from gradysim.commands.asked import Asked
from gradysim.commands.simulators import capture_files_of, nodes_of_vectors

if TYPE_CHECKING:
    from gradysim.config.scenario import Scenario
    from gradysim.results.run_result import RunResult


_LONGEST_PID = 2**22
"""As Linux counts. Files that are being written have the number of the process at the end of their names."""


def check_can_be_written(asked: Asked) -> None:
    """Raise ConfigError for files that this Python cannot write, before runs that take hours."""
    if not (asked.scalars or asked.vectors):
        return
    try:
        import sqlite3  # noqa: F401
    except ImportError as error:
        from gradysim.config.errors.config_error import ConfigError

        option = "--scalars" if asked.scalars else f"--vectors {asked.vectors[0]}"
        raise ConfigError(f"{option}: {error}; expected a Python with the module sqlite3") from error


def check_names_fit(scenarios: "Sequence[Scenario]", mode: Mode, asked: Asked) -> None:
    """Raise ConfigError for a name of a file that is too long for the folder, before the first run begins."""
    from gradysim.config.errors.config_error import ConfigError

    last = max(scenarios, key=lambda scenario: scenario.run_number)
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
    from gradysim.results.run_file import run_file

    yield from capture_files_of(scenario, asked)
    complete = _for_omnetpp(scenario, mode, asked)
    if asked.result_dir is not None:
        complete.append(run_file(asked.directory, scenario.config, scenario.run_number, mode))
    for file in complete:
        yield file.with_name(f"{file.name}.{_LONGEST_PID}")


def write_files(scenario: "Scenario", result: "RunResult", asked: Asked) -> Iterator[str]:
    """Write what was asked for of a run, and give a line about each file.

    Captures are there already: radios write them. Files for OMNeT++ that an earlier run left under names of
    this one are removed first, also those that it replaces, if there is room for them. Raises OSError, with
    the name of the file.

    The result comes first: it is there if the disk has no room for the others. Once they are complete it is
    written again, and names them.
    """
    from gradysim.results.run_file import write_run_file

    if asked.writes_files:
        yield from _remove_of_earlier_runs(scenario, result.mode, asked)
    if asked.result_dir is not None:
        yield f"written to {write_run_file(result, asked.result_dir)}"
    if asked.scalars or asked.vectors:
        yield from _write_for_omnetpp(scenario, result, asked)
    for capture in capture_files_of(scenario, asked):
        yield f"captured in {capture}"
    if asked.result_dir is not None and (others := _beside_result(scenario, result.mode, asked)):
        write_run_file(result, asked.result_dir, others)


def _remove_of_earlier_runs(scenario: "Scenario", mode: Mode, asked: Asked) -> Iterator[str]:
    """Remove what a reader would take for scalars or vectors of this run, and are those of another one."""
    for suffix, is_replaced in ((".sca", asked.scalars), (".vec", bool(asked.vectors))):
        path = omnetpp_file(scenario, mode, asked, suffix)
        if path.is_file():
            path.unlink()
            if not is_replaced:
                yield f"removed {path}, of an earlier run"


def _write_for_omnetpp(scenario: "Scenario", result: "RunResult", asked: Asked) -> Iterator[str]:
    from gradysim.results.histograms import histograms
    from gradysim.results.run_identity import identity_of
    from gradysim.results.scalar_file import write_scalar_file
    from gradysim.results.scalars import scalars
    from gradysim.results.vector_file import vectors_of, write_vector_file

    identity = identity_of(result, scenario, asked.directory)
    if asked.scalars:
        path = omnetpp_file(scenario, result.mode, asked, ".sca")
        distributions = histograms(result, scenario.network)
        write_scalar_file(scalars(result, scenario.network), identity, path, distributions)
        yield f"scalars in {path}"
    if asked.vectors:
        path = omnetpp_file(scenario, result.mode, asked, ".vec")
        write_vector_file(vectors_of(result, scenario.network), identity, path)
        yield f"vectors in {path}"


def omnetpp_file(scenario: "Scenario", mode: Mode, asked: Asked, suffix: str) -> Path:
    """Return the file of a run's scalars, `.sca`, or vectors, `.vec`."""
    from gradysim.results.run_file import run_file

    return run_file(asked.directory, scenario.config, scenario.run_number, mode, suffix)


def _beside_result(scenario: "Scenario", mode: Mode, asked: Asked) -> list[Path]:
    """Return all files of a run that are asked for, but for that of its result."""
    return [*capture_files_of(scenario, asked), *_for_omnetpp(scenario, mode, asked)]


def _for_omnetpp(scenario: "Scenario", mode: Mode, asked: Asked) -> list[Path]:
    suffixes = [*([".sca"] if asked.scalars else []), *([".vec"] if asked.vectors else [])]
    return [omnetpp_file(scenario, mode, asked, suffix) for suffix in suffixes]


def are_there(scenario: "Scenario", mode: Mode, asked: Asked) -> bool:
    """Whether all that is asked for beside its result is there as the run left it, with the labels of now."""
    from gradysim.results.run_file import has_written

    files = _for_omnetpp(scenario, mode, asked)
    return (
        has_written(scenario, mode, asked.directory, _beside_result(scenario, mode, asked))
        and _have_labels(files, scenario, mode)
        and _has_vectors(files, scenario, asked)
    )


def _have_labels(files: Sequence[Path], scenario: "Scenario", mode: Mode) -> bool:
    """Whether files for OMNeT++ are those of one run, with the attributes that it has now."""
    from gradysim.results.database import storable
    from gradysim.results.read_files import run_attributes
    from gradysim.results.run_identity import lasting_attributes

    expected = {name: storable(text) for name, text in lasting_attributes(scenario, mode).items()}
    found = [run_attributes(file) for file in files]
    return all(
        expected.items() <= attributes.items() and attributes["runID"] == found[0]["runID"]
        for attributes in found
    )


def _has_vectors(files: Sequence[Path], scenario: "Scenario", asked: Asked) -> bool:
    """Whether the last of the files has vectors of all nodes that are asked for."""
    from gradysim.results.read_files import recorded_modules

    expected = {f"{scenario.network}.{node.name}.mobility" for node in nodes_of_vectors(scenario, asked)}
    return not expected or expected <= recorded_modules(files[-1])
