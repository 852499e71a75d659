"""The results of a directory: those in its JSON files and those in its packs, as one collection.

A JSON file takes precedence over a packed one. Of several packs the one with the newest file does.
"""

import os
import shlex
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from gradysim.results.files import bytes_of, is_run_file, parsed
from gradysim.results.pack import PackedFile, packed_files, packed_summaries, packs_of
from gradysim.results.run_summary import Conditions, RunSummary, in_order
from gradysim.scenario.errors import ConfigError, Source

_FIELDS = {"config", "mode", "run", "interrupted", "outcomes", "nodes", "iterations"}
"""Fields that distinguish the result of a run from other JSON files."""


def read_results(directory: Path) -> list[RunSummary]:
    """Return summaries of the runs in a directory or pack, sorted by configuration, mode and run.

    Other files and interrupted runs are left out. Raises ConfigError for a damaged file, and OSError.
    """
    loose = loose_files(directory)  # before the packs: a file that `gradysim pack` removes is in one of them
    found: dict[str, tuple[int, RunSummary, bool]] = {}
    for pack in packs_of(directory):
        for state, summary, interrupted in packed_summaries(pack, directory):
            name = summary.file_name
            if name in loose and loose[name] != state:
                continue
            if name not in found or found[name][0] < state.time_ns:
                found[name] = state.time_ns, summary, interrupted
    complete = [summary for _, summary, interrupted in found.values() if not interrupted]
    known: dict[str, Conditions] = {}
    for name in loose.keys() - found.keys():
        result = result_in(directory / name)
        if result is not None and not result["interrupted"]:
            summary = RunSummary.of(result, directory / name)
            conditions = known.setdefault(summary.conditions.key, summary.conditions)
            complete.append(replace(summary, conditions=conditions))
    return in_order(complete)


def loose_files(directory: Path) -> dict[str, PackedFile]:
    """Return the JSON files in a directory by name; none for a pack. Raises OSError."""
    if directory.is_file():
        return {}
    with os.scandir(directory) as entries:
        return {
            entry.name: PackedFile(status.st_size, status.st_mtime_ns)
            for entry in entries
            if entry.name.endswith(".json") and entry.is_file() and (status := entry.stat())
        }


def result_in(file: Path) -> dict[str, Any] | None:
    """Return the JSON object in a result file; None for another JSON file.

    Raises ConfigError for a damaged one, and OSError.
    """
    return result_of(bytes_of(file), file)


def result_of(content: bytes, file: Path) -> dict[str, Any] | None:
    """Return the JSON object in the content of a file as `result_in` does."""
    try:
        result = parsed(content)
    except ValueError as error:
        if is_run_file(file.name):
            raise ConfigError(
                f"it is damaged: {error}",
                Source(file, 0),
                expected="the file as its run left it; to do the run again, use"
                f" `gradysim run FILE --result-dir {shlex.quote(str(file.parent))} --resume`",
            ) from error
        return None
    return result if result.keys() >= _FIELDS else None


def has_files_for_omnetpp_alone(directory: Path) -> bool:
    """Return whether a directory has `.sca` or `.vec` files, but no result of a run."""
    if directory.is_file():
        return False
    others = any(file.suffix in (".sca", ".vec") for file in directory.iterdir())
    return others and not any(_results_in(directory))


def result_names(directory: Path) -> set[str]:
    """Return the names of JSON files in a directory and in its packs. Raises OSError."""
    packed = (name for pack in packs_of(directory) for name in packed_files(pack))
    return {*(loose_files(directory) if directory.is_dir() else ()), *packed}


def _results_in(directory: Path) -> Iterator[str]:
    for name in result_names(directory):
        if result_in(directory / name) is not None:
            yield name
