"""Reads result files with OMNeT++'s tables, those of gradysim and of OMNeT++ itself, for scripts."""

import contextlib
import math
import os
from array import array
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import sqlite3

Paths = str | os.PathLike[str] | Iterable[str | os.PathLike[str]]
"""A file, or several."""

Row = dict[str, Any]


def read_scalars(paths: Paths) -> list[Row]:
    """Return a row for each scalar of `.sca` files; `pandas.DataFrame` makes a table of them.

    The columns are `runID`, `module`, `name` and `value`, a float, then, all of them texts, the iteration
    variables, the run attributes (`configname`, `mode`, `repetition`, …) and the attributes of the scalar
    itself (`unit`, …). Of columns of one name the first is kept.

    Raises OSError for a file that cannot be read, and ValueError for one that is no such file.
    """

    def numbers(_: "sqlite3.Connection", __: int, value: float | None) -> Row:
        return {"value": _number(value)}

    return _rows(paths, "scalar", "scalarValue", numbers)


def read_vectors(paths: Paths) -> list[Row]:
    """Return a row for each vector of `.vec` files; `pandas.DataFrame` makes a table of them.

    The columns are those of `read_scalars`, but for `vectime` (seconds) and `vecvalue` in the place of
    `value`: arrays of floats, which numpy takes as they are (`numpy.asarray`).

    Raises OSError for a file that cannot be read, and ValueError for one that is no such file.
    """

    def series(connection: "sqlite3.Connection", vector_id: int, exponent: int) -> Row:
        query = "SELECT simtimeRaw, value FROM vectorData WHERE vectorId = ? ORDER BY rowid"
        times, values = array("d"), array("d")
        for raw, value in connection.execute(query, (vector_id,)):
            times.append(raw / 10**-exponent if exponent < 0 else float(raw * 10**exponent))
            values.append(_number(value))
        return {"vectime": times, "vecvalue": values}

    return _rows(paths, "vector", "(SELECT simtimeExp FROM run WHERE run.runId = vector.runId)", series)


def recorded_modules(path: Path) -> set[str]:
    """Return the modules that have vectors in a file; none if it is not there, or no such file."""
    try:
        with _opened(path) as connection:
            return {module for (module,) in connection.execute("SELECT DISTINCT moduleName FROM vector")}
    except (OSError, ValueError):
        return set()


def _rows(
    paths: Paths, kind: str, column: str, data: Callable[["sqlite3.Connection", int, Any], Row]
) -> list[Row]:
    rows: list[Row] = []
    for path in [paths] if isinstance(paths, str | os.PathLike) else paths:
        with _opened(Path(path)) as connection:
            runs = _runs(connection)
            own = _texts(connection, f"{kind}Id, attrName, attrValue FROM {kind}Attr")
            query = f"SELECT {kind}Id, runId, moduleName, {kind}Name, {column} FROM {kind} ORDER BY {kind}Id"
            for item, run, module, name, value in connection.execute(query).fetchall():
                run_name, attributes = runs[run]
                row = {"runID": run_name, "module": module, "name": name, **data(connection, item, value)}
                for more in (attributes, own.get(item, {})):
                    row.update((key, text) for key, text in more.items() if key not in row)
                rows.append(row)
    return rows


def _runs(connection: "sqlite3.Connection") -> dict[int, tuple[str, dict[str, str]]]:
    """Return {id: (name of the run, its iteration variables and attributes)}."""
    variables = _texts(connection, "runId, itervarName, itervarValue FROM runItervar")
    attributes = _texts(connection, "runId, attrName, attrValue FROM runAttr")
    return {
        run: (name, {**attributes.get(run, {}), **variables.get(run, {})})
        for run, name in connection.execute("SELECT runId, runName FROM run")
    }


def _texts(connection: "sqlite3.Connection", columns: str) -> dict[int, dict[str, str]]:
    """Return {id: {name: value}} of three columns."""
    found: dict[int, dict[str, str]] = {}
    for item, name, value in connection.execute(f"SELECT {columns} ORDER BY rowid"):
        found.setdefault(item, {})[name] = value
    return found


def _number(value: float | None) -> float:
    return math.nan if value is None else float(value)


@contextlib.contextmanager
def _opened(path: Path) -> Iterator["sqlite3.Connection"]:
    """Open a file to read from it, while nothing changes it."""
    import sqlite3

    path.open("rb").close()  # which says why it cannot be read; SQLite does not
    connection = sqlite3.connect(f"{path.resolve().as_uri()}?mode=ro", uri=True)
    try:
        yield connection
    except sqlite3.Error as error:
        raise ValueError(f"{path}: {error}; expected a file of OMNeT++'s results in SQLite") from error
    finally:
        connection.close()
