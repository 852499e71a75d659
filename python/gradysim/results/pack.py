"""Packs: the result files of many runs in one SQLite file, which is also a `.sca` file of OMNeT++.

The packs of a directory are in its directory `packs`. OMNeT++'s tables have the runs and the numbers that
`gradysim means` averages. Four more tables have the result files: `packedRun` and `packedConditions` what a
`RunSummary` has, `packedText` the compressed files, and `packedDictionary` what they were compressed with. A
pack is replaced as a whole, so it never changes while it is read. It ends with a checksum of all that, which
each process verifies before it reads anything else.
"""

import contextlib
import errno
import json
import os
import zlib
from collections.abc import Iterator, Mapping
from dataclasses import asdict
from pathlib import Path
from struct import Struct
from typing import TYPE_CHECKING, Any, NamedTuple

from gradysim.results.file_checksum import verify_checksum
from gradysim.results.run_summary import Conditions, RunSummary

if TYPE_CHECKING:
    import sqlite3

PACKS = "packs"
"""Directory of packs in a directory of results."""

DEFAULT_NAME = "runs.sca"

TABLES: Mapping[str, Mapping[str, str]] = {
    "packedConditions": {
        "conditionsId": "INTEGER PRIMARY KEY",
        "layout": "TEXT NOT NULL",
        "conditions": "TEXT NOT NULL",
    },
    "packedRun": {
        "runId": "INTEGER PRIMARY KEY REFERENCES run(runId) ON DELETE CASCADE",
        "fileName": "BLOB NOT NULL UNIQUE",
        "fileSize": "INTEGER NOT NULL",
        "fileTimeNs": "INTEGER NOT NULL",
        "conditionsId": "INTEGER NOT NULL REFERENCES packedConditions(conditionsId)",
        "interrupted": "INTEGER NOT NULL",
        "run": "INTEGER NOT NULL",
        "seed": "INTEGER",
        "numbers": "BLOB NOT NULL",
        "leftOut": "TEXT",
    },
    "packedDictionary": {
        "dictionaryId": "INTEGER PRIMARY KEY",
        "study": "TEXT NOT NULL UNIQUE",
        "text": "BLOB NOT NULL",
    },
    "packedText": {
        "runId": "INTEGER PRIMARY KEY REFERENCES run(runId) ON DELETE CASCADE",
        "dictionaryId": "INTEGER NOT NULL REFERENCES packedDictionary(dictionaryId)",
        "text": "BLOB NOT NULL",
    },
}
"""{table: {column: its type}}, in addition to those of OMNeT++."""


class PackedFile(NamedTuple):
    """State of a result file when it was packed.

    Attributes:
        size: Bytes.
        time_ns: Time of its last change.
    """

    size: int
    time_ns: int


def packs_of(path: Path) -> list[Path]:
    """Return the packs of a directory of results. `path` may also be a pack itself."""
    if path.is_file():
        return [path]
    try:
        return sorted(file for file in (path / PACKS).iterdir() if file.suffix == ".sca" and file.is_file())
    except (FileNotFoundError, NotADirectoryError):
        return []


def packed_files(pack: Path) -> dict[str, PackedFile]:
    """Return the result files in a pack by name. Raises OSError."""
    with opened(pack) as connection:
        rows = connection.execute("SELECT fileName, fileSize, fileTimeNs FROM packedRun")
        return {name_of(name): _state(size, time_ns) for name, size, time_ns in rows}


def _state(size: object, time_ns: object) -> PackedFile:
    if not (isinstance(size, int) and isinstance(time_ns, int)):
        raise TypeError(f"expected integers, got {size!r} and {time_ns!r}")
    return PackedFile(size, time_ns)


def packed_bytes(file: Path) -> bytes | None:
    """Return the content of a result file in the newest pack that has it; None if no pack has it.

    Raises OSError.
    """
    found: list[tuple[int, bytes]] = []
    for pack in packs_of(file.parent):
        with opened(pack) as connection:
            found += connection.execute(
                "SELECT fileTimeNs, unpacked(packedText.text, packedDictionary.text) FROM packedRun"
                " JOIN packedText USING (runId) JOIN packedDictionary USING (dictionaryId)"
                " WHERE fileName = ?",
                (stored_name(file.name),),
            )
    return max(found)[1] if found else None


def packed_texts(pack: Path) -> Iterator[tuple[str, PackedFile, bytes]]:
    """Yield name, state and content of each result file in a pack. Raises OSError."""
    with opened(pack) as connection:
        rows = connection.execute(
            "SELECT fileName, fileSize, fileTimeNs, unpacked(packedText.text, packedDictionary.text)"
            " FROM packedRun JOIN packedText USING (runId) JOIN packedDictionary USING (dictionaryId)"
            " ORDER BY runId"
        )
        for name, size, time_ns, text in rows:
            yield name_of(name), _state(size, time_ns), text


def packed_summaries(pack: Path, directory: Path) -> Iterator[tuple[PackedFile, RunSummary, bool]]:
    """Yield the summary of each run in a pack, and whether the run was interrupted.

    `directory` is that of the summaries. Raises OSError.
    """
    with opened(pack) as connection:
        known = {
            key: (_conditions(text), Struct(layout).unpack)
            for key, layout, text in connection.execute("SELECT * FROM packedConditions")
        }
        rows = connection.execute(
            "SELECT conditionsId, fileName, fileSize, fileTimeNs, interrupted, run, seed, numbers, leftOut"
            " FROM packedRun ORDER BY runId"
        )
        for key, name, size, time_ns, interrupted, run, seed, numbers, left_out in rows:
            conditions, row_of = known[key]
            others = json.loads(left_out) if left_out else {}
            summary = RunSummary(conditions, run, seed, row_of(numbers), others, directory, name_of(name))
            yield _state(size, time_ns), summary, bool(interrupted)


def conditions_of(summary: RunSummary) -> tuple[str, str, bytes]:
    """Return the layout of the numbers of a run, its conditions as a JSON object, and its numbers."""
    layout = "<" + "".join("q" if _is_integer(number) else "d" for number in summary.row)
    plain = {
        name: sorted(value) if isinstance(value, frozenset) else value
        for name, value in asdict(summary.conditions).items()
    }
    return layout, json.dumps(plain), Struct(layout).pack(*summary.row)


def _conditions(text: str) -> Conditions:
    plain: dict[str, Any] = json.loads(text)
    names = {name: tuple(plain[name]) for name in ("averages", "quantities")}
    sets = {name: frozenset(plain[name]) for name in ("hidden_at_zero", "unlisted")}
    return Conditions(**{**plain, **names, **sets, "variables": tuple(map(tuple, plain["variables"]))})


def _is_integer(number: float) -> bool:
    return isinstance(number, int) and -(2**63) <= number < 2**63


def stored_name(name: str) -> bytes:
    """Return the name of a file as packs have it: names in Linux need not be UTF-8."""
    return name.encode(errors="surrogateescape")


def name_of(stored: bytes) -> str:
    """Return the name of a file in a pack. Raises ValueError for a path, which might leave the directory."""
    name = stored.decode(errors="surrogateescape")
    if name != os.path.basename(name):
        raise ValueError(f"expected the name of a file, got `{name}`")
    return name


class Compressor:
    """Compresses result files that resemble a sample. Those of a study differ in a tenth of their text."""

    def __init__(self, dictionary: bytes) -> None:
        """Take the sample, which is needed again for `unpacked`."""
        self._new = zlib.compressobj(zdict=dictionary)

    def packed(self, text: bytes) -> bytes:
        """Return the compressed text."""
        compressor = self._new.copy()
        return compressor.compress(text) + compressor.flush()


def unpacked(text: bytes, dictionary: bytes) -> bytes:
    """Return a text that a `Compressor` with this sample compressed."""
    return zlib.decompressobj(zdict=dictionary).decompress(text)


@contextlib.contextmanager
def opened(pack: Path) -> Iterator["sqlite3.Connection"]:
    """Open a pack read-only. Raises OSError, with its name, also for what the block raises."""
    import sqlite3

    try:
        verify_checksum(pack)
        connection = sqlite3.connect(f"{pack.resolve().as_uri()}?mode=ro&immutable=1", uri=True)
        try:
            connection.create_function("unpacked", 2, unpacked, deterministic=True)
            yield connection
        finally:
            connection.close()
    except (OSError, MemoryError):
        raise
    except Exception as error:  # of SQLite, or about a value that it returned
        reason = str(error) or type(error).__name__
        problem = f"not a pack, or damaged: {reason}; expected a copy, or pack the results again"
        raise OSError(errno.EIO, problem, str(pack)) from error
