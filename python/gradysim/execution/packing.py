"""Writes packs: the result files of a directory into one file, and back."""

import contextlib
import errno
import json
import os
import shutil
from collections.abc import Iterable, Iterator, Mapping, Sequence
from hashlib import sha256
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gradysim.execution.run_lock import all_runs_locked, remove_left_over_files
from gradysim.results.durable import bytes_in, check_replaceable, replacing, replacing_all
from gradysim.results.file_checksum import append_checksum, remove_checksum
from gradysim.results.omnetpp import TABLES as OMNETPP_TABLES
from gradysim.results.omnetpp import RunIdentity, create_tables, insert_run, open_unfinished, storable
from gradysim.results.pack import (
    DEFAULT_NAME,
    PACKS,
    TABLES,
    Compressor,
    PackedFile,
    conditions_of,
    name_of,
    packed_files,
    packed_texts,
    packs_of,
    stored_name,
)
from gradysim.results.result_dir import loose_files, result_of
from gradysim.results.run_summary import RunSummary
from gradysim.scenario.resolve.sweep import text_of_iterations

if TYPE_CHECKING:
    import sqlite3

Content = tuple[str, PackedFile, bytes]
"""Name, state and content of a result file."""

_MODULE = "network"
"""Module of the scalars, whose names are those of `gradysim means`."""

_TABLES_OF_RUNS = ("run", "runAttr", "runItervar", "scalar", "packedRun", "packedText")


def default_pack(directory: Path) -> Path:
    """Return the pack of a directory that is written by default."""
    return directory / PACKS / DEFAULT_NAME


def pack(directory: Path, file: Path, *, remove: bool = False) -> int:
    """Add the results of a directory to the pack `file`, and return how many are new or changed.

    The results in other packs of the directory are added, too. What the pack has already stays. It is
    replaced as a whole or not at all. With `remove`, it is then read again. The JSON files that it has, byte
    for byte, and the other packs are removed.

    Raises:
        RunLockedError: A run is being computed in the directory.
        ConfigError: A result file is damaged.
        OSError: A file cannot be read or written, or differs from what the pack has. Nothing is removed.
    """
    check_replaceable(file)
    remove_left_over_files(directory)
    with all_runs_locked(directory):
        known = packed_files(file) if file.exists() else {}
        loose = loose_files(directory)
        others = [each for each in packs_of(directory) if not (file.exists() and file.samefile(each))]
        found = _newest([known, *map(packed_files, others)]) | loose
        changed = {name: state for name, state in found.items() if known.get(name) != state}
        added = _write(file, _contents(directory, changed, loose, others), directory)
        if remove and file.exists():
            for packed in _packed_copies(file, directory, loose, others):
                packed.unlink()
            _remove(others)
    return added


def unpack(directory: Path, packs: Iterable[Path], *, remove: bool = False) -> int:
    """Write the result files in packs into a directory, and return their number.

    JSON files in the directory stay as they are. With `remove`, the packs are then removed, if the directory
    has all their results. Raises RunLockedError, ConfigError and OSError as `pack`.
    """
    packs = list(packs)
    with all_runs_locked(directory):
        newest = _newest(map(packed_files, packs))
        loose = loose_files(directory)
        written: dict[str, bytes] = {}
        with replacing_all() as unfinished:
            for each in packs:
                for name, state, content in packed_texts(each):
                    if newest[name] == state and name not in loose and name not in written:
                        file = unfinished(directory / name)
                        file.write_bytes(content)
                        os.utime(file, ns=(state.time_ns, state.time_ns))
                        written[name] = _digest(content)
        if remove:
            for name in newest:
                _check_unpacked(directory / name, written.get(name))
            _remove(packs)
    return len(written)


def _check_unpacked(file: Path, digest: bytes | None) -> None:
    """Raise OSError unless a file has what was written, or was there before with a result."""
    content = bytes_in(file)
    if digest is None and result_of(content, file) is None:
        raise OSError(errno.EIO, "not a result; expected the one in the packs, which stay", str(file))
    if digest not in (None, _digest(content)):
        raise OSError(errno.EIO, "not what was unpacked; the packs stay", str(file))


def _digest(content: bytes) -> bytes:
    return sha256(content).digest()


def _packed_copies(
    file: Path, directory: Path, loose: Mapping[str, PackedFile], others: Iterable[Path]
) -> list[Path]:
    """Return the JSON files of a directory that a pack has, byte for byte.

    Raises OSError if such a file differs, and if the pack lacks a result of other packs.
    """
    packed = {name: (state, _digest(content)) for name, state, content in packed_texts(file)}
    copies = [name for name in loose if name in packed and packed[name][0] == loose[name]]
    for name in copies:
        if _digest(bytes_in(directory / name)) != packed[name][1]:
            problem = f"not as it was packed in {file}; nothing was removed"
            raise OSError(errno.EIO, problem, str(directory / name))
    for each in others:
        for name, state, content in packed_texts(each):
            kept, digest = packed.get(name, (None, b""))
            is_replaced = kept is not None and (kept == loose.get(name) or kept.time_ns > state.time_ns)
            if not is_replaced and digest != _digest(content):
                raise OSError(errno.EIO, f"its {name} is not in {file}; nothing was removed", str(each))
    return [directory / name for name in copies]


def _remove(packs: Iterable[Path]) -> None:
    for each in packs:
        each.unlink()
        with contextlib.suppress(OSError):  # it has other packs
            if each.parent.name == PACKS:
                each.parent.rmdir()


def _newest(several: Iterable[Mapping[str, PackedFile]]) -> dict[str, PackedFile]:
    """Return the newest state of each file in several packs."""
    newest: dict[str, PackedFile] = {}
    for files in several:
        for name, state in files.items():
            if name not in newest or newest[name].time_ns < state.time_ns:
                newest[name] = state
    return newest


def _contents(
    directory: Path, wanted: Mapping[str, PackedFile], loose: Mapping[str, PackedFile], packs: Iterable[Path]
) -> Iterator[Content]:
    """Yield the wanted result files: loose ones, then those in packs."""
    for name in sorted(wanted.keys() & loose.keys()):
        yield name, loose[name], bytes_in(directory / name)
    left = {name: state for name, state in wanted.items() if name not in loose}
    for each in packs:
        for name, state, content in packed_texts(each):
            if left.get(name) == state:
                del left[name]
                yield name, state, content


def _write(file: Path, contents: Iterable[Content], directory: Path) -> int:
    """Add result files to a pack, which is created if missing, and return their number."""
    import sqlite3

    results = (
        (content, result)
        for content in contents
        if (result := result_of(content[2], directory / content[0])) is not None
    )
    first = next(results, None)
    if first is None:
        return 0
    with replacing(file) as unfinished:
        if file.exists():
            shutil.copyfile(file, unfinished)
            remove_checksum(unfinished)
        try:
            connection = open_unfinished(unfinished)
            try:
                added = _Writer(connection).add(chain([first], results))
            finally:
                connection.close()
        except sqlite3.Error as error:
            raise OSError(errno.EIO, str(error), str(file)) from error
        append_checksum(unfinished)
        return added


class _Writer:
    """Adds result files to a pack that no other process has opened."""

    def __init__(self, connection: "sqlite3.Connection") -> None:
        self._connection = connection
        if not connection.execute("SELECT 1 FROM sqlite_schema LIMIT 1").fetchall():
            create_tables(connection, {**OMNETPP_TABLES, **TABLES})
        query = connection.execute("SELECT * FROM packedConditions")
        self._conditions = {(layout, conditions): key for key, layout, conditions in query}
        query = connection.execute("SELECT study, dictionaryId, text FROM packedDictionary")
        self._compressors = {study: (key, Compressor(text)) for study, key, text in query}

    def add(self, results: Iterable[tuple[Content, Mapping[str, Any]]]) -> int:
        """Add result files with their JSON objects, and return their number."""
        query = self._connection.execute("SELECT fileName, runId FROM packedRun")
        known: dict[bytes, int] = dict(query)
        replaced = []
        next_id = max(known.values(), default=0) + 1
        count = 0
        for (name, state, content), result in results:
            file_name = stored_name(name)
            if file_name in known:
                self._connection.execute("DELETE FROM packedRun WHERE fileName = ?", (file_name,))
                replaced.append(known[file_name])
            self._add(next_id + count, file_name, state, content, result)
            count += 1
        for table in _TABLES_OF_RUNS:
            self._connection.execute(
                f"DELETE FROM {table} WHERE runId IN (SELECT value FROM json_each(?))",
                (json.dumps(replaced),),
            )
        self._connection.execute("CREATE INDEX IF NOT EXISTS scalar_idx ON scalar (scalarName, runId)")
        self._connection.execute("COMMIT")
        return count

    def _add(
        self, run_id: int, file_name: bytes, state: PackedFile, content: bytes, result: Mapping[str, Any]
    ) -> None:
        summary = RunSummary.of(result)
        insert_run(self._connection, _identity_of(file_name, result), run_id)
        self._insert(
            "scalar (runId, moduleName, scalarName, scalarValue)",
            [(run_id, _MODULE, storable(name), value) for name, value in summary.numbers.items()],
        )
        layout, conditions, numbers = conditions_of(summary)
        key = self._conditions.get((layout, conditions))
        if key is None:
            key = self._conditions[layout, conditions] = len(self._conditions) + 1
            self._insert("packedConditions", [(key, layout, conditions)])
        left_out = json.dumps(summary.left_out) if summary.left_out else None
        row = (key, result["interrupted"], summary.run, summary.seed, numbers, left_out)
        self._insert("packedRun", [(run_id, file_name, state.size, state.time_ns, *row)])
        dictionary, compressor = self._compressor(f"{result['config']} {result['mode']}", content)
        self._insert("packedText", [(run_id, dictionary, compressor.packed(content))])

    def _compressor(self, study: str, content: bytes) -> tuple[int, Compressor]:
        """Return the compressor for the files of a study, which the first one is a sample of, and its id."""
        study = storable(study)
        if study not in self._compressors:
            key = len(self._compressors) + 1
            self._compressors[study] = key, Compressor(content)
            self._insert("packedDictionary", [(key, study, content)])
        return self._compressors[study]

    def _insert(self, table: str, rows: Sequence[Sequence[object]]) -> None:
        if rows:
            marks = ", ".join("?" * len(rows[0]))
            self._connection.executemany(f"INSERT INTO {table} VALUES ({marks})", rows)


def _identity_of(file_name: bytes, result: Mapping[str, Any]) -> RunIdentity:
    """Return what OMNeT++'s tools tell runs apart by, as far as the result file has it."""
    iterations = {name: str(value) for name, value in result["iterations"].items()}
    variables = text_of_iterations(iterations)
    attributes = {
        "configname": result["config"],
        "experiment": result["config"],
        "iterationvars": variables,
        "measurement": variables,
        "mode": result["mode"],
        "repetition": str(result.get("repetition", 0)),
        "replication": f"#{result.get('repetition', 0)}",
        "runnumber": str(result["run"]),
        "seedset": str(result.get("seed", "")),
        "settings_hash": str(result.get("settings_hash", "")),
    }
    named = {name: text for name, text in iterations.items() if not name.isdigit()}
    return RunIdentity(storable(name_of(file_name)).removesuffix(".json"), attributes, named, ())
