"""Files of a run of `gradysim run`: their names, and how they are written."""

import contextlib
import errno
import logging
import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from gradysim.cli.options import Mode, RunOptions
from gradysim.integrated.capture import capture_files, files_of_interfaces
from gradysim.replay.sink import ReplaySink, Sinks
from gradysim.results.durable import LONGEST_PID, check_replaceable, finish, make_directory, unfinished_file
from gradysim.results.files import (
    has_complete_result,
    outputs_of_other_settings,
    run_file,
    write_run_file,
)
from gradysim.results.omnetpp import (
    identity_of,
    lasting_attributes,
    storable,
    vectors_of,
    write_scalar_file,
    write_vector_file,
)
from gradysim.results.omnetpp_reader import run_attributes
from gradysim.results.result import RunResult
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.node_spec import NodeSpec
from gradysim.scenario.scenario import Scenario, nodes_named


def ids_of_outcomes(scenario: Scenario, options: RunOptions) -> list[int]:
    """Return the ids of the nodes that --outcomes-at names."""
    return [node.id for node in nodes_named(scenario, options.outcomes_at)]


def nodes_of_vectors(scenario: Scenario, options: RunOptions) -> list[NodeSpec]:
    """Return the nodes that --vectors names."""
    return nodes_named(scenario, options.vectors)


def replay_file(scenario: Scenario, options: RunOptions) -> Path:
    """Return the page of a run's replay."""
    return run_file(options.directory, scenario.config, scenario.run_number, options.mode, ".html")


def replay_sink(scenario: Scenario, options: RunOptions) -> ReplaySink | None:
    """Return the sink for the replay of a run, and for its trace; None if neither is requested.

    The replay gets its name when the run has ended. Raises ConfigError if it cannot be written.
    """
    sinks: list[ReplaySink] = []
    if options.replay:
        from gradysim.replay.sink import ReplayWriter

        recorded = {node.id for node in nodes_named(scenario, options.replay)}
        is_all = len(recorded) == len(scenario.nodes)
        page = unfinished_file(replay_file(scenario, options))
        try:
            sinks.append(ReplayWriter(page, None if is_all else recorded))
        except OSError as error:
            raise ConfigError(f"cannot write the replay '{page}': {error.strerror}") from error
    if options.trace:
        from gradysim.replay.trace import Trace

        sinks.append(Trace(node.id for node in nodes_named(scenario, options.trace)))
    if len(sinks) < 2:
        return sinks[0] if sinks else None

    return Sinks(sinks)


def log_level(options: RunOptions) -> int:
    """Return the lowest level of printed log lines, as a number of `logging`."""
    name = options.log_level or ("warning" if options.quiet else "info")
    return logging.getLevelNamesMapping()[name.upper()]


def captures(scenario: Scenario, options: RunOptions) -> dict[int, Path]:
    """Return {id of a node: its capture file} of one run."""
    return capture_files(scenario, options.pcap, options.directory)


def captures_under_way(scenario: Scenario, options: RunOptions) -> dict[int, Path]:
    """Return {id of a node: the file that its radio writes}. It gets its name when the run has ended."""
    return {node_id: unfinished_file(file) for node_id, file in captures(scenario, options).items()}


def capture_files_of(scenario: Scenario, options: RunOptions) -> list[Path]:
    """Return the capture files of all radios of the nodes that --pcap names."""
    if not options.pcap:
        return []

    return list(files_of_interfaces(scenario, captures(scenario, options)).values())


def omnetpp_file(scenario: Scenario, options: RunOptions, suffix: str) -> Path:
    """Return the file of a run's scalars, `.sca`, or vectors, `.vec`."""
    return run_file(options.directory, scenario.config, scenario.run_number, options.mode, suffix)


def files_beside_result(scenario: Scenario, options: RunOptions) -> list[Path]:
    """Return all requested files of a run, except the result."""
    return [*files_of_the_run_itself(scenario, options), *files_for_omnetpp(scenario, options)]


def files_of_the_run_itself(scenario: Scenario, options: RunOptions) -> list[Path]:
    """Return the requested files that are written during the run."""
    replays = [replay_file(scenario, options)] if options.replay else []
    return [*capture_files_of(scenario, options), *replays]


def files_under_way(scenario: Scenario, options: RunOptions) -> list[Path]:
    """Return the names that these files have during the run."""
    return [unfinished_file(file) for file in files_of_the_run_itself(scenario, options)]


def remove_files_under_way(scenario: Scenario, options: RunOptions) -> None:
    """Remove what a run has written under these names, such as after a failure."""
    for file in files_under_way(scenario, options):
        with contextlib.suppress(OSError):
            file.unlink()


def check_outputs(scenario: Scenario, options: RunOptions) -> None:
    """Raise OSError if the place of an output of the run has something else than a regular file."""
    for file in _all_files(scenario, options):
        check_replaceable(file)


def files_for_omnetpp(scenario: Scenario, options: RunOptions) -> list[Path]:
    """Return the files of scalars and of vectors, if requested, in this order."""
    suffixes = [*([".sca"] if options.scalars else []), *([".vec"] if options.vectors else [])]
    return [omnetpp_file(scenario, options, suffix) for suffix in suffixes]


def make_result_dir(directory: Path) -> None:
    """Create the directory of --result-dir. Raises ConfigError, which names the option."""
    try:
        make_directory(directory)
    except OSError as error:
        reason = "it is not a directory" if os.path.lexists(directory) else error.strerror or str(error)
        raise ConfigError(
            f"--result-dir {directory}: {reason}; expected a directory, or a new name"
        ) from error


def check_may_be_written_to(directory: Path) -> None:
    """Raise ConfigError, which names the option, if the directory is not writable."""
    if not os.access(directory, os.W_OK | os.X_OK):
        raise ConfigError(f"--result-dir {directory}: it is not writable; expected another directory")


def check_sqlite(options: RunOptions) -> None:
    """Raise ConfigError for files that this Python cannot write, before long runs."""
    if not (options.scalars or options.vectors):
        return
    try:
        import sqlite3  # noqa: F401
    except ImportError as error:
        from gradysim.scenario.errors import ConfigError

        option = "--scalars" if options.scalars else f"--vectors {options.vectors[0]}"
        raise ConfigError(f"{option}: {error}; expected a Python with the module sqlite3") from error


def check_file_names(scenarios: Sequence[Scenario], options: RunOptions) -> None:
    """Raise ConfigError if the name of a file is too long for the directory, before the first run."""
    last = scenarios[-1]  # it has the longest number
    folders = (options.directory, *options.directory.parents)
    there = next((folder for folder in folders if folder.is_dir()), Path())  # captures create their own
    for file in _all_files(last, options):
        try:
            os.lstat(there / unfinished_file(file, LONGEST_PID).name)
        except OSError as error:
            if error.errno == errno.ENAMETOOLONG:
                raise ConfigError(
                    f"--result-dir {options.directory}: {file.name} is too long for a name of a file in it;"
                    " expected a shorter name of the configuration"
                ) from error


def _all_files(scenario: Scenario, options: RunOptions) -> Iterator[Path]:
    """Yield the files that a run will write."""
    yield from files_beside_result(scenario, options)
    if options.result_dir is not None:
        yield run_file(options.directory, scenario.config, scenario.run_number, options.mode)


def write_files(
    scenario: Scenario, result: RunResult, lacks_output: bool, options: RunOptions
) -> Iterator[str]:
    """Write the requested files of a run, and yield a line about each file.

    An interrupted run does not replace a complete result. If a capture or a replay lacks its end, as
    `lacks_output` says, none of them is kept. Files of an earlier run that would pass for files of this one
    are removed. Raises OSError, with the name of the file, also if a capture or a replay is missing.

    The result comes first, in case the disk has no room for the others. When they are complete, it is written
    again and names them.
    """
    if not options.is_writer:
        return
    mode, directory = options.mode, options.directory
    if result.interrupted and has_complete_result(scenario, mode, directory):
        yield f"kept {run_file(directory, scenario.config, scenario.run_number, mode)}, which is complete"
        return
    outdated = outputs_of_other_settings(scenario, mode, directory)
    if options.result_dir is not None:
        yield f"written to {write_run_file(result, options.result_dir)}"
    captured = [] if lacks_output else capture_files_of(scenario, options)
    replays = [replay_file(scenario, options)] if options.replay and not lacks_output else []
    if options.writes_files:
        yield from _remove_of_earlier_runs(scenario, options)
    for file in outdated:
        if file.suffix in _OF_THE_RUN_ITSELF and file.is_file():
            file.unlink()
            if file not in (*captured, *replays):
                yield f"removed {file}, of an earlier run"
    if options.scalars or options.vectors:
        yield from _write_for_omnetpp(scenario, result, options)
    for file in (*captured, *replays):
        finish(file)
    yield from (f"captured in {file}" for file in captured)
    yield from (f"replay in {file}" for file in replays)
    written = [*captured, *replays, *files_for_omnetpp(scenario, options)]
    if options.result_dir is not None and written:
        write_run_file(result, options.result_dir, written)


_OF_THE_RUN_ITSELF = (".pcap", ".html")
"""Suffixes of files that are written during the run."""


def _remove_of_earlier_runs(scenario: Scenario, options: RunOptions) -> Iterator[str]:
    """Remove scalars and vectors of other runs that a reader would take for files of this run.

    Files with the same settings stay until they are replaced.
    """
    for suffix, is_replaced in ((".sca", options.scalars), (".vec", bool(options.vectors))):
        path = omnetpp_file(scenario, options, suffix)
        if path.is_file() and not (is_replaced and have_labels([path], scenario, options.mode)):
            path.unlink()
            if not is_replaced:
                yield f"removed {path}, of an earlier run"


def have_labels(files: Sequence[Path], scenario: Scenario, mode: Mode) -> bool:
    """Return whether files for OMNeT++ are from one run, with its current attributes."""
    expected = {name: storable(text) for name, text in lasting_attributes(scenario, mode).items()}
    found = [run_attributes(file) for file in files]
    return all(
        expected.items() <= attributes.items() and attributes["runID"] == found[0]["runID"]
        for attributes in found
    )


def _write_for_omnetpp(scenario: Scenario, result: RunResult, options: RunOptions) -> Iterator[str]:
    identity = identity_of(result, scenario, options.directory)
    if options.scalars:
        path = omnetpp_file(scenario, options, ".sca")
        network = scenario.network
        write_scalar_file(result.scalars(network), identity, path, result.histograms(network))
        yield f"scalars in {path}"
    if options.vectors:
        path = omnetpp_file(scenario, options, ".vec")
        write_vector_file(vectors_of(result, scenario.network), identity, path)
        yield f"vectors in {path}"
