"""Result files of runs, DIR/CONFIG-#RUN.MODE.json: their names, writing them, and `--resume`."""

import errno
import hashlib
import json
import os
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, get_args

from gradysim.results.durable import bytes_in, replacing
from gradysim.results.pack import packed_bytes
from gradysim.results.result import Mode, RunResult, plain_iterations
from gradysim.scenario.resolve.runs import HASH_DIGITS, hash_of
from gradysim.scenario.scenario import Scenario

CHECKSUM = "checksum"
"""The last field of a result file: hash of the file with an empty string in its place."""

_RUN_FILE = re.compile(rf".+-#\d+\.({'|'.join(get_args(Mode))})\.json")
_FORMER_NAMES = {"fates": "outcomes", "frame_fates": "frame_outcomes", "message_fates": "message_outcomes"}
"""Names of fields in the files of earlier versions."""

_NO_CHECKSUM = f'"{CHECKSUM}": ""\n}}\n'


def run_file(directory: Path, config: str, run: int, mode: Mode, suffix: str = ".json") -> Path:
    """Return the file of one run; the suffix `.sca` is for its scalars, `.vec` for its vectors."""
    return directory / f"{_stem(config, run, mode)}{suffix}"


def is_run_file(name: str) -> bool:
    """Return whether a file has the name of a result file."""
    return _RUN_FILE.fullmatch(name) is not None


def run_name(scenario: Scenario, mode: Mode) -> str:
    """Return the name of a run for files that its protocols write; "" if the configuration has one run."""
    return _stem(scenario.config, scenario.run_number, mode) if scenario.run_count > 1 else ""


def _stem(config: str, run: int, mode: Mode) -> str:
    return f"{config}-#{run}.{mode}"


def files_changed_since(
    scenario: Scenario, mode: Mode, directory: Path, outcomes_at: Iterable[int] = ()
) -> tuple[str, ...] | None:
    """Return the files in settings, such as protocols, that have changed since the run.

    None if the run is not done: `directory` does not have a complete result of it with the same settings,
    seed and outcomes at the nodes `outcomes_at`, by their ids.
    """
    result = _read(run_file(directory, scenario.config, scenario.run_number, mode))
    if (
        not _has_settings_of(scenario, result)
        or result.get("interrupted") is not False
        or not _has_outcomes_at(outcomes_at, result.get("nodes"))
    ):
        return None
    return _changed(result.get("file_hashes"), scenario.file_hashes)


def has_other_settings(scenario: Scenario, mode: Mode, directory: Path) -> bool:
    """Return whether `directory` has a result of the run with other settings or another seed."""
    result = _read(run_file(directory, scenario.config, scenario.run_number, mode))
    return bool(result) and not _has_settings_of(scenario, result)


def has_another_number(scenario: Scenario, mode: Mode, directory: Path) -> bool:
    """Return whether `directory` has a result of its run number with other values or another repetition."""
    result = _read(run_file(directory, scenario.config, scenario.run_number, mode))
    expected = (scenario.repetition, plain_iterations(scenario.iterations))
    return bool(result) and (result.get("repetition"), result.get("iterations")) != expected


def has_complete_result(scenario: Scenario, mode: Mode, directory: Path) -> bool:
    """Return whether `directory` has a complete result of the run, with any settings."""
    result = _read(run_file(directory, scenario.config, scenario.run_number, mode))
    return result.get("interrupted") is False


def outputs_of_other_settings(scenario: Scenario, mode: Mode, directory: Path) -> list[Path]:
    """Return the other files of a result of the run with other settings or another seed, if there is one."""
    result = _read(run_file(directory, scenario.config, scenario.run_number, mode))
    hashes = result.get("output_hashes")
    if not result or _has_settings_of(scenario, result) or not isinstance(hashes, dict):
        return []
    return [directory / Path(name).name for name in hashes]


def _has_settings_of(scenario: Scenario, result: Mapping[str, Any]) -> bool:
    expected = {
        "seed": scenario.seed,
        "settings_hash": scenario.settings_hash,
        "repetition": scenario.repetition,  # another `repeat` changes the run numbers
        "iterations": plain_iterations(scenario.iterations),
    }
    return expected.items() <= {name: result.get(name) for name in expected}.items()


def has_written(scenario: Scenario, mode: Mode, directory: Path, files: Iterable[Path]) -> bool:
    """Return whether all these files are complete, and belong to the run whose result is in `directory`."""
    files = list(files)
    if not files:
        return True
    known = _read(run_file(directory, scenario.config, scenario.run_number, mode)).get("output_hashes")
    hashes = known if isinstance(known, dict) else {}
    return all((found := hash_of(file)) and hashes.get(file.name) == found for file in files)


def _read(file: Path) -> dict[str, Any]:
    """Return the JSON object in a result file; an empty dict if it is missing or damaged. Raises OSError."""
    try:
        return read_run_file(file)
    except (FileNotFoundError, NotADirectoryError, ValueError):
        return {}


def _changed(before: object, now: Mapping[str, str]) -> tuple[str, ...]:
    known = before if isinstance(before, dict) else {}
    return tuple(sorted(name for name in {*known, *now} if known.get(name) != now.get(name)))


def _has_outcomes_at(outcomes_at: Iterable[int], nodes: object) -> bool:
    listed = nodes if isinstance(nodes, list) else []
    needed = {"frame_outcomes", "message_outcomes"}
    return {node.get("id") for node in listed if isinstance(node, dict) and needed <= node.keys()}.issuperset(
        outcomes_at
    )


def write_run_file(result: RunResult, directory: Path, written: Iterable[Path] = ()) -> Path:
    """Write `result` into `directory`, which is created if missing, and return the file's path.

    `written` are other complete files of the run; the result file has their names and hashes.

    An earlier file of the same configuration, run and mode is replaced as a whole or not at all, since other
    processes may read or write it. Raises OSError, with the name of the file, if it cannot be written.
    """
    path = run_file(directory, result.config, result.run, result.mode)
    hashes = {file.name: _hash_of_written(file) for file in written}
    content = {**result.to_json_object(), "output_hashes": hashes, CHECKSUM: ""}
    text = json.dumps(content, indent=2) + "\n"
    with replacing(path) as unfinished:
        unfinished.write_text(with_checksum(text), encoding="utf-8")
    return path


def with_checksum(text: str) -> str:
    """Return the text of a result file, which ends with an empty checksum, with its actual checksum."""
    return text.removesuffix(_NO_CHECKSUM) + _NO_CHECKSUM.replace('""', f'"{_hash_of_text(text)}"')


def read_run_file(file: Path) -> dict[str, Any]:
    """Return the JSON object in a result file, which may be in a pack. One without a checksum is accepted.

    Raises:
        OSError: It cannot be read.
        ValueError: It is not a JSON object, or its checksum does not match.
    """
    return parsed(bytes_of(file))


def parsed(content: bytes) -> dict[str, Any]:
    """Return the JSON object in the content of a result file. Raises ValueError as `read_run_file`."""
    text = content.replace(b"\r\n", b"\n").decode("utf-8")  # Windows has other ends of lines
    try:
        found = json.loads(text)
    except RecursionError as error:
        raise ValueError("it is too deeply nested") from error
    if not isinstance(found, dict):
        raise ValueError("it is not a JSON object")
    checksum = found.get(CHECKSUM)
    if checksum is not None:
        begin, _, end = text.rpartition(f'"{checksum}"')
        if _hash_of_text(f'{begin}""{end}') != checksum:
            raise ValueError(f"its content does not fit its {CHECKSUM}")
    return _with_names_of_now(found) if "fates" in found else found


def _with_names_of_now(result: Mapping[str, Any]) -> dict[str, Any]:
    """Return the result of an earlier version with the names that its fields have now."""
    found = _renamed(result)
    if isinstance(nodes := found.get("nodes"), list):
        found["nodes"] = [_renamed(node) if isinstance(node, dict) else node for node in nodes]
    return found


def _renamed(fields: Mapping[str, Any]) -> dict[str, Any]:
    return {_FORMER_NAMES.get(name, name): value for name, value in fields.items()}


def bytes_of(file: Path) -> bytes:
    """Return the content of a result file, which may be in a pack. Raises OSError."""
    try:
        return bytes_in(file)
    except (FileNotFoundError, NotADirectoryError):
        packed = packed_bytes(file)
        if packed is None:
            raise
        return packed


def hash_of_run_file(file: Path) -> str:
    """Return the hash of a result file, which may be in a pack. Raises OSError."""
    return _hash(bytes_of(file))


def _hash_of_written(file: Path) -> str:
    found = hash_of(file)
    if not found:
        raise OSError(errno.EIO, os.strerror(errno.EIO), str(file))
    return found


def _hash_of_text(text: str) -> str:
    return _hash(text.encode())


def _hash(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()[:HASH_DIGITS]
