"""Result files of runs, DIR/CONFIG-#RUN.MODE.json: their names, writing them, and `--resume`."""

import contextlib
import json
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from gradysim.results.result import Mode, RunResult, plain_iterations
from gradysim.scenario.runs import hash_of
from gradysim.scenario.scenario import Scenario


def run_file(directory: Path, config: str, run: int, mode: Mode, suffix: str = ".json") -> Path:
    """Return the file of one run; the suffix `.sca` is for its scalars, `.vec` for its vectors."""
    return directory / f"{_stem(config, run, mode)}{suffix}"


def run_name(scenario: Scenario, mode: Mode) -> str:
    """Return the name of a run for files that its protocols write; "" if the configuration has one run."""
    return _stem(scenario.config, scenario.run_number, mode) if scenario.run_count > 1 else ""


def _stem(config: str, run: int, mode: Mode) -> str:
    return f"{config}-#{run}.{mode}"


def files_changed_since(
    scenario: Scenario, mode: Mode, directory: Path, fates_at: Iterable[int] = ()
) -> tuple[str, ...] | None:
    """Return the files that settings name, such as protocols, that changed since the run was done.

    None if the run is not done: `directory` has no complete result of it with the same settings and seed, and
    with the outcomes at the nodes `fates_at`, by their ids.
    """
    result = _read(run_file(directory, scenario.config, scenario.run_number, mode))
    expected = {
        "interrupted": False,
        "seed": scenario.seed,
        "settings_hash": scenario.settings_hash,
        "repetition": scenario.repetition,  # another `repeat` changes the run numbers
        "iterations": plain_iterations(scenario.iterations),
    }
    if not (
        expected.items() <= {name: result.get(name) for name in expected}.items()
        and _has_fates_at(fates_at, result.get("nodes"))
    ):
        return None
    return _changed(result.get("file_hashes"), scenario.file_hashes)


def has_written(scenario: Scenario, mode: Mode, directory: Path, files: Iterable[Path]) -> bool:
    """Return whether all these files are complete, and of the run whose result is in `directory`."""
    known = _read(run_file(directory, scenario.config, scenario.run_number, mode)).get("output_hashes")
    hashes = known if isinstance(known, dict) else {}
    return all((found := hash_of(file)) and hashes.get(file.name) == found for file in files)


def _read(file: Path) -> dict[str, Any]:
    """Return the JSON object in a file; an empty dict if there is none, or if it cannot be read."""
    try:
        found = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):  # missing, not JSON, or too deeply nested
        return {}
    return found if isinstance(found, dict) else {}


def _changed(before: object, now: Mapping[str, str]) -> tuple[str, ...]:
    known = before if isinstance(before, dict) else {}
    return tuple(sorted(name for name in {*known, *now} if known.get(name) != now.get(name)))


def _has_fates_at(fates_at: Iterable[int], nodes: object) -> bool:
    told = nodes if isinstance(nodes, list) else []
    asked = {"frame_fates", "message_fates"}
    return {node.get("id") for node in told if isinstance(node, dict) and asked <= node.keys()}.issuperset(
        fates_at
    )


def write_run_file(result: RunResult, directory: Path, written: Iterable[Path] = ()) -> Path:
    """Write `result` into `directory`, which is created if missing, and return the file's path.

    `written` are other complete files of the run; the result file has their names and hashes.

    An earlier file of the same configuration, run and mode is replaced, by the complete file or not at all:
    other processes may read it, or write it too. Raises OSError, with the name of the file, when it cannot be
    written.
    """
    directory.mkdir(parents=True, exist_ok=True)
    path = run_file(directory, result.config, result.run, result.mode)
    hashes = {file.name: found for file in written if (found := hash_of(file))}
    content = {**result.to_json_object(), "output_hashes": hashes}
    unfinished = path.with_name(f"{path.name}.{os.getpid()}")
    try:
        unfinished.write_text(json.dumps(content, indent=2) + "\n", encoding="utf-8")
        unfinished.replace(path)
    except BaseException as error:
        with contextlib.suppress(OSError):  # a read-only directory
            unfinished.unlink(missing_ok=True)
        if isinstance(error, OSError):  # of a full disk, without the name of the file
            raise OSError(error.errno, error.strerror, str(path)) from error
        raise
    return path
