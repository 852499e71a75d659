"""OMNeT++ 6's result files: databases of SQLite with these tables, the same for scalars and for vectors."""

import contextlib
import errno
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.results.run_identity import RunIdentity

if TYPE_CHECKING:
    import sqlite3

SIMTIME_EXPONENT = -12
"""Times are whole numbers of 10 to the power of it seconds: picoseconds, those of the engine."""

_NO_NAME = "INTEGER NOT NULL REFERENCES {table}({key}) ON DELETE CASCADE"
_KEY = "INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL"
_OF_RUN = _NO_NAME.format(table="run", key="runId")
_TEXT = "TEXT NOT NULL"
_WHOLE = "INTEGER NOT NULL"


def _attributes(table: str, key: str) -> dict[str, str]:
    return {key: _NO_NAME.format(table=table, key=key), "attrName": _TEXT, "attrValue": _TEXT}


TABLES: Mapping[str, Mapping[str, str]] = {
    "run": {"runId": _KEY, "runName": _TEXT, "simtimeExp": _WHOLE},
    "runAttr": _attributes("run", "runId"),
    "runItervar": {"runId": _OF_RUN, "itervarName": _TEXT, "itervarValue": _TEXT},
    "runConfig": {"runId": _OF_RUN, "configKey": _TEXT, "configValue": _TEXT, "configOrder": _WHOLE},
    "scalar": {
        "scalarId": _KEY,
        "runId": _OF_RUN,
        "moduleName": _TEXT,
        "scalarName": _TEXT,
        "scalarValue": "REAL",
    },
    "scalarAttr": _attributes("scalar", "scalarId"),
    "parameter": {
        "paramId": _KEY,
        "runId": _OF_RUN,
        "moduleName": _TEXT,
        "paramName": _TEXT,
        "paramValue": _TEXT,
    },
    "paramAttr": _attributes("parameter", "paramId"),
    "statistic": {
        "statId": _KEY,
        "runId": _OF_RUN,
        "moduleName": _TEXT,
        "statName": _TEXT,
        "isHistogram": _WHOLE,
        "isWeighted": _WHOLE,
        "statCount": _WHOLE,
        **dict.fromkeys(("statMean", "statStddev", "statSum", "statSqrsum", "statMin", "statMax"), "REAL"),
        **dict.fromkeys(
            ("statWeights", "statWeightedSum", "statSqrSumWeights", "statWeightedSqrSum"), "REAL"
        ),
    },
    "statisticAttr": _attributes("statistic", "statId"),
    "histogramBin": {
        "statId": _NO_NAME.format(table="statistic", key="statId"),
        "lowerEdge": "REAL NOT NULL",
        "binValue": "REAL NOT NULL",
    },
    "vector": {
        "vectorId": _KEY,
        "runId": _OF_RUN,
        "moduleName": _TEXT,
        "vectorName": _TEXT,
        "vectorCount": "INTEGER",
        **dict.fromkeys(("vectorMin", "vectorMax", "vectorSum", "vectorSumSqr"), "REAL"),
        **dict.fromkeys(("startEventNum", "endEventNum", "startSimtimeRaw", "endSimtimeRaw"), "INTEGER"),
    },
    "vectorAttr": _attributes("vector", "vectorId"),
    "vectorData": {
        "vectorId": _NO_NAME.format(table="vector", key="vectorId"),
        "eventNumber": _WHOLE,
        "simtimeRaw": _WHOLE,
        "value": "REAL",
    },
}
"""{table: {column: its type}}. Numbers that may be NaN may be NULL, as which SQLite keeps it."""

RUN_ID = 1
"""Of the only run in a file."""


@contextlib.contextmanager
def new_database(path: Path, identity: RunIdentity) -> Iterator["sqlite3.Connection"]:
    """Make a file with these tables and what tells of its run; what is done inside adds the rest.

    An earlier file of the name is replaced, by the whole of this one or not at all. Folders are made when
    missing. Raises OSError, with the name of the file, when it cannot be written.
    """
    import sqlite3

    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_name(f"{path.name}.{os.getpid()}")
    unfinished.unlink(missing_ok=True)
    try:
        connection = sqlite3.connect(unfinished, isolation_level=None)
        try:
            # Nobody else opens the file until it is complete, and it is thrown away if it never is.
            connection.execute("PRAGMA journal_mode = OFF")
            connection.execute("PRAGMA synchronous = OFF")
            connection.execute("BEGIN")
            for table, columns in TABLES.items():
                listed = ", ".join(f"{name} {kind}" for name, kind in columns.items())
                connection.execute(f"CREATE TABLE {table} ({listed})")
            _insert_run(connection, identity)
            yield connection
            connection.execute("COMMIT")
        finally:
            connection.close()
        unfinished.replace(path)
    except BaseException as error:
        with contextlib.suppress(OSError):  # a folder that is read-only
            unfinished.unlink(missing_ok=True)
        if isinstance(error, sqlite3.Error):
            raise OSError(errno.EIO, str(error), str(path)) from error
        if isinstance(error, OSError):
            raise OSError(error.errno, error.strerror, str(path)) from error
        raise


def storable(text: str) -> str:
    """Return the text without what UTF-8 has no bytes for, such as a half of a surrogate pair."""
    return text.encode(errors="backslashreplace").decode()


def _insert_run(connection: "sqlite3.Connection", identity: RunIdentity) -> None:
    connection.execute(
        "INSERT INTO run VALUES (?, ?, ?)", (RUN_ID, storable(identity.name), SIMTIME_EXPONENT)
    )
    for table, values in (("runAttr", identity.attributes), ("runItervar", identity.iterations)):
        connection.executemany(
            f"INSERT INTO {table} VALUES (?, ?, ?)",
            [(RUN_ID, storable(name), storable(value)) for name, value in values.items()],
        )
    connection.executemany(
        "INSERT INTO runConfig VALUES (?, ?, ?, ?)",
        [
            (RUN_ID, storable(key), storable(value), order)
            for order, (key, value) in enumerate(identity.settings)
        ],
    )
