"""Writes DIR/CONFIG-#RUN.MODE.vec: what numbers were over time, for OMNeT++'s analysis tools."""

import math
from collections.abc import Iterable, Iterator
from heapq import merge
from itertools import repeat
from operator import mul
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.results.database import RUN_ID, new_database, storable
from gradysim.results.run_identity import RunIdentity
from gradysim.results.run_result import RunResult
from gradysim.results.vector import Values, Vector

if TYPE_CHECKING:
    import sqlite3

NO_EVENT = 0
"""In the place of the number of the event at which a row was recorded: the two modes count other events."""


def vectors_of(result: RunResult, network: str) -> Iterator[tuple[str, Vector]]:
    """Give the vectors of a run, each with the path of its module, which begins with `network`."""
    for node in result.nodes:
        for vector in node.vectors or ():
            yield f"{network}.{node.name}.{vector.part}", vector


def write_vector_file(vectors: Iterable[tuple[str, Vector]], identity: RunIdentity, path: Path) -> None:
    """Write the whole file or nothing. Raises OSError, with its name.

    `vectors` are each with the path of its module, as `vectors_of` gives them.
    """
    with new_database(path, identity) as connection:
        rows = [
            zip(
                vector.times_ps,
                repeat(_insert(connection, module, vector), len(vector.times_ps)),
                vector.values,
                strict=True,
            )
            for module, vector in vectors
        ]
        connection.executemany(
            f"INSERT INTO vectorData (simtimeRaw, vectorId, value, eventNumber) VALUES (?, ?, ?, {NO_EVENT})",
            merge(*rows),  # by time; vectors have different ids, so that values are never compared
        )
        connection.execute("CREATE INDEX vectorData_idx ON vectorData (vectorId)")


def _insert(connection: "sqlite3.Connection", module: str, vector: Vector) -> int | None:
    """Insert a vector without its rows, and return its id."""
    times = vector.times_ps
    values = (
        *(RUN_ID, storable(module), f"{storable(vector.name)}:vector", len(times)),
        *_statistics(vector.values),
        *(NO_EVENT, NO_EVENT, *((times[0], times[-1]) if times else (0, 0))),
    )
    columns = (
        "runId, moduleName, vectorName, vectorCount, vectorMin, vectorMax, vectorSum, vectorSumSqr,"
        " startEventNum, endEventNum, startSimtimeRaw, endSimtimeRaw"
    )
    marks = ", ".join("?" * len(values))
    inserted = connection.execute(f"INSERT INTO vector ({columns}) VALUES ({marks})", values)
    connection.executemany(
        "INSERT INTO vectorAttr VALUES (?, ?, ?)",
        [(inserted.lastrowid, name, storable(value)) for name, value in _attributes(vector)],
    )
    return inserted.lastrowid


def _statistics(values: Values) -> tuple[float, float, float, float]:
    """Return least, greatest, sum and sum of squares; as of sums in general, NaN is passed on by the sums."""
    numbers = values if not any(map(math.isnan, values)) else [v for v in values if not math.isnan(v)]
    return (
        min(numbers, default=math.inf),
        max(numbers, default=-math.inf),
        sum(values),
        sum(map(mul, values, values)),
    )


def _attributes(vector: Vector) -> Iterator[tuple[str, str]]:
    yield "title", vector.name
    yield "source", vector.name
    yield "recordingmode", "vector"
    # A variable keeps its value until it is set again; a vehicle moves on between two telemetries.
    yield "interpolationmode", "linear" if vector.part == "mobility" else "sample-hold"
    if vector.unit:
        yield "unit", vector.unit
