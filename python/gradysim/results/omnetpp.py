"""Writes OMNeT++ 6's result files: SQLite databases of scalars (`.sca`) and of vectors (`.vec`)."""

import contextlib
import errno
import math
import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from datetime import datetime, timedelta
from operator import mul
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.results.delays import Histogram, bin_rows
from gradysim.results.durable import replacing
from gradysim.results.quantity import Scalar
from gradysim.results.recorder import Values, Vector
from gradysim.results.result import Mode, RunResult
from gradysim.scenario.resolve.sweep import PREDEFINED
from gradysim.scenario.scenario import Scenario

if TYPE_CHECKING:
    import sqlite3

SIMTIME_EXPONENT = -12
"""Times are integers, in units of 10 to this power seconds: picoseconds, as in the engine."""

NO_EVENT = 0
"""Event number of all rows: the two modes count different events."""

_FOREIGN_KEY = "INTEGER NOT NULL REFERENCES {table}({key}) ON DELETE CASCADE"
_KEY = "INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL"
_OF_RUN = _FOREIGN_KEY.format(table="run", key="runId")
_TEXT = "TEXT NOT NULL"
_INTEGER = "INTEGER NOT NULL"


def _attributes(table: str, key: str) -> dict[str, str]:
    return {key: _FOREIGN_KEY.format(table=table, key=key), "attrName": _TEXT, "attrValue": _TEXT}


TABLES: Mapping[str, Mapping[str, str]] = {
    "run": {"runId": _KEY, "runName": _TEXT, "simtimeExp": _INTEGER},
    "runAttr": _attributes("run", "runId"),
    "runItervar": {"runId": _OF_RUN, "itervarName": _TEXT, "itervarValue": _TEXT},
    "runConfig": {"runId": _OF_RUN, "configKey": _TEXT, "configValue": _TEXT, "configOrder": _INTEGER},
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
        "isHistogram": _INTEGER,
        "isWeighted": _INTEGER,
        "statCount": _INTEGER,
        **dict.fromkeys(("statMean", "statStddev", "statSum", "statSqrsum", "statMin", "statMax"), "REAL"),
        **dict.fromkeys(
            ("statWeights", "statWeightedSum", "statSqrSumWeights", "statWeightedSqrSum"), "REAL"
        ),
    },
    "statisticAttr": _attributes("statistic", "statId"),
    "histogramBin": {
        "statId": _FOREIGN_KEY.format(table="statistic", key="statId"),
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
        "vectorId": _FOREIGN_KEY.format(table="vector", key="vectorId"),
        "eventNumber": _INTEGER,
        "simtimeRaw": _INTEGER,
        "value": "REAL",
    },
}
"""{table: {column: its type}}. Numbers that may be NaN may be NULL: SQLite stores NaN as NULL."""

RUN_ID = 1
"""Id of the only run in a file of one run."""


@dataclass(frozen=True)
class RunIdentity:
    """Identity of a run, the same in all of its files.

    Attributes:
        name: Unique among runs.
        attributes: Run attributes by name.
        iterations: Value of each named iteration variable, as the .ini file writes it.
        settings: Lines of the .ini file that make up this run, overrides first.
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
    """Return the attributes that stay the same if the run is repeated, from any directory."""
    known = scenario.variables
    return {
        **{name: known[name] for name in PREDEFINED if name in known and name != "inifile"},
        "mode": mode,
        "settings_hash": scenario.settings_hash,
        "interrupted": str(interrupted).lower(),
    }


@contextlib.contextmanager
def new_database(path: Path, identity: RunIdentity) -> Iterator["sqlite3.Connection"]:
    """Create a file with these tables and the rows about its run; the caller adds the others.

    An earlier file of that name is replaced as a whole or not at all. Missing directories are created. Raises
    OSError, with the name of the file, if it cannot be written.
    """
    import sqlite3

    with replacing(path) as unfinished:
        try:
            connection = open_unfinished(unfinished)
            try:
                create_tables(connection, TABLES)
                insert_run(connection, identity)
                yield connection
                connection.execute("COMMIT")
            finally:
                connection.close()
        except sqlite3.Error as error:
            raise OSError(errno.EIO, str(error), str(path)) from error


def open_unfinished(path: Path) -> "sqlite3.Connection":
    """Open an unfinished database in a transaction. An incomplete one is deleted, so it needs no journal."""
    import sqlite3

    # No other process opens it, so it needs no lock, which some file systems do not have.
    connection = sqlite3.connect(f"{path.resolve().as_uri()}?nolock=1", uri=True, isolation_level=None)
    for command in ("PRAGMA journal_mode = OFF", "PRAGMA synchronous = OFF", "BEGIN"):
        connection.execute(command)
    return connection


def create_tables(connection: "sqlite3.Connection", tables: Mapping[str, Mapping[str, str]]) -> None:
    """Create tables, given as {table: {column: its type}}."""
    for table, columns in tables.items():
        listed = ", ".join(f"{name} {kind}" for name, kind in columns.items())
        connection.execute(f"CREATE TABLE {table} ({listed})")


def storable(text: str) -> str:
    """Return the string with escapes for what UTF-8 cannot encode, such as half a surrogate pair."""
    return text.encode(errors="backslashreplace").decode()


def insert_run(connection: "sqlite3.Connection", identity: RunIdentity, run_id: int = RUN_ID) -> None:
    """Insert the rows about a run."""
    connection.execute(
        "INSERT INTO run VALUES (?, ?, ?)", (run_id, storable(identity.name), SIMTIME_EXPONENT)
    )
    for table, values in (("runAttr", identity.attributes), ("runItervar", identity.iterations)):
        connection.executemany(
            f"INSERT INTO {table} VALUES (?, ?, ?)",
            [(run_id, storable(name), storable(value)) for name, value in values.items()],
        )
    connection.executemany(
        "INSERT INTO runConfig VALUES (?, ?, ?, ?)",
        [
            (run_id, storable(key), storable(value), order)
            for order, (key, value) in enumerate(identity.settings)
        ],
    )


def _insert(
    connection: "sqlite3.Connection", table: str, row: Mapping[str, object], attributes: Mapping[str, str]
) -> int | None:
    """Insert a row and its attributes, and return its id."""
    columns, marks = ", ".join(row), ", ".join("?" * len(row))
    inserted = connection.execute(f"INSERT INTO {table} ({columns}) VALUES ({marks})", tuple(row.values()))
    connection.executemany(
        f"INSERT INTO {table}Attr VALUES (?, ?, ?)",
        [(inserted.lastrowid, name, storable(value)) for name, value in attributes.items()],
    )
    return inserted.lastrowid


def write_scalar_file(
    scalars: Iterable[Scalar], identity: RunIdentity, path: Path, histograms: Iterable[Histogram] = ()
) -> None:
    """Write a `.sca` file, as a whole or not at all. Raises OSError, with its name."""
    with new_database(path, identity) as connection:
        for scalar in scalars:
            row = {
                "runId": RUN_ID,
                "moduleName": storable(scalar.module),
                "scalarName": storable(scalar.name),
                "scalarValue": scalar.value,
            }
            _insert(connection, "scalar", row, scalar.attributes)
        for histogram in histograms:
            _insert_histogram(connection, histogram)


def _insert_histogram(connection: "sqlite3.Connection", histogram: Histogram) -> None:
    values = histogram.values
    row = {
        "runId": RUN_ID,
        "moduleName": storable(histogram.module),
        "statName": storable(histogram.name),
        "isHistogram": 1,
        "isWeighted": 0,
        "statCount": values.count,
        "statMean": values.mean_s,
        "statStddev": values.stddev_s if values.count > 1 else None,  # as in OMNeT++
        "statSum": values.sum_s,
        "statSqrsum": values.sum_of_squares_s2,
        "statMin": values.min_s,
        "statMax": values.max_s,
    }
    statistic = _insert(connection, "statistic", row, histogram.attributes)
    connection.executemany(
        "INSERT INTO histogramBin VALUES (?, ?, ?)", [(statistic, *bin_row) for bin_row in bin_rows(values)]
    )


def vectors_of(result: RunResult, network: str) -> Iterator[tuple[str, Vector]]:
    """Yield (path of its module, vector) for each vector of a run; paths begin with `network`."""
    for node in result.nodes:
        for vector in node.vectors or ():
            yield f"{network}.{node.name}.{vector.part}", vector


def write_vector_file(vectors: Iterable[tuple[str, Vector]], identity: RunIdentity, path: Path) -> None:
    """Write a `.vec` file, as a whole or not at all. Raises OSError, with its name.

    `vectors` are pairs (path of its module, vector), as `vectors_of` yields them.
    """
    with new_database(path, identity) as connection:
        for module, vector in vectors:
            vector_id = _insert_vector(connection, module, vector)
            connection.executemany(
                "INSERT INTO vectorData (simtimeRaw, vectorId, value, eventNumber)"
                f" VALUES (?, {vector_id}, ?, {NO_EVENT})",
                zip(vector.times_ps, vector.values, strict=True),
            )
        connection.execute("CREATE INDEX vectorData_idx ON vectorData (vectorId)")


def _insert_vector(connection: "sqlite3.Connection", module: str, vector: Vector) -> int | None:
    """Insert a vector without its rows, and return its id."""
    times = vector.times_ps
    row = {
        "runId": RUN_ID,
        "moduleName": storable(module),
        "vectorName": f"{storable(vector.name)}:vector",
        "vectorCount": len(times),
        **_statistics(vector.values),
        "startEventNum": NO_EVENT,
        "endEventNum": NO_EVENT,
        "startSimtimeRaw": times[0] if times else 0,
        "endSimtimeRaw": times[-1] if times else 0,
    }
    attributes = {
        "title": vector.name,
        "source": vector.name,
        "recordingmode": "vector",
        # A variable keeps its value until it is set again; a vehicle moves between two telemetry messages.
        "interpolationmode": "linear" if vector.part == "mobility" else "sample-hold",
        **({"unit": vector.unit} if vector.unit else {}),
    }
    return _insert(connection, "vector", row, attributes)


def _statistics(values: Values) -> dict[str, float]:
    """Return minimum, maximum, sum and sum of squares. The sums are NaN if a value is."""
    numbers = values if not any(map(math.isnan, values)) else [v for v in values if not math.isnan(v)]
    return {
        "vectorMin": min(numbers, default=math.inf),
        "vectorMax": max(numbers, default=-math.inf),
        "vectorSum": sum(values),
        "vectorSumSqr": sum(map(mul, values, values)),
    }
