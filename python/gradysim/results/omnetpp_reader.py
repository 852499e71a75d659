"""Reads OMNeT++'s result files in SQLite, those of gradysim and of OMNeT++ itself, for scripts."""

import contextlib
import json
import math
import os
from array import array
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gradysim.results.file_checksum import has_checksum, verify_checksum
from gradysim.results.pack import opened as opened_pack
from gradysim.results.quantity import Names, name_filter

if TYPE_CHECKING:
    import sqlite3

Paths = str | os.PathLike[str] | Iterable[str | os.PathLike[str]]
"""A file, or several."""

Row = dict[str, Any]

_COLUMNS = ("runID", "module", "name", "value", "vectime", "vecvalue", "unit", "title", "source")
"""Names that an iteration variable cannot have as a column, even if its file does not use them."""


def read_scalars(paths: Paths, names: Names | None = None) -> list[Row]:
    """Return a row for each scalar of `.sca` files; `pandas.DataFrame` makes a table of them.

    The columns are `runID`, `module`, `name` and `value`, a float. Then follow, as strings, the iteration
    variables, the run attributes (`configname`, `mode`, `repetition`, …) and the attributes of the scalar
    (`unit`, …). A variable with the name of another column is `$name`, `$value` and so on. Of other columns
    with equal names the first is kept. `names` selects scalars, `"heard:last"` or
    `["heard:last", "position?:*"]`; None for all.

    Raises OSError for a file that cannot be read and for a damaged pack, and ValueError for a file of another
    kind.
    """
    return _rows(paths, "scalar", names, _values)


def read_vectors(paths: Paths, names: Names | None = None) -> list[Row]:
    """Return a row for each vector of `.vec` files; `pandas.DataFrame` makes a table of them.

    The columns are those of `read_scalars`, with `vectime` (seconds) and `vecvalue` instead of `value`:
    arrays of floats, for `numpy.asarray`. `names` selects vectors, `"heard:vector"`, since trajectories may
    be very large.

    Raises OSError for a file that cannot be read, and ValueError for a file of another kind.
    """
    return _rows(paths, "vector", names, _series)


def run_attributes(path: Path) -> dict[str, str]:
    """Return `runID` and the run attributes in a file; an empty dict if it is missing or of another kind."""
    try:
        with _opened(path) as connection:
            query = "SELECT attrName, attrValue FROM runAttr"
            ((name,),) = connection.execute("SELECT runName FROM run")
            return {"runID": name, **dict(connection.execute(query))}
    except (OSError, ValueError):
        return {}


def recorded_modules(path: Path) -> set[str]:
    """Return the modules that have vectors in a file; an empty set if it is missing or of another kind."""
    try:
        with _opened(path) as connection:
            return {module for (module,) in connection.execute("SELECT DISTINCT moduleName FROM vector")}
    except (OSError, ValueError):
        return set()


def check_structure(path: Path) -> None:
    """Raise ValueError for a file of another kind or with damaged pages, and OSError if it cannot be read."""
    with _opened(path) as connection:
        ((found,),) = connection.execute("PRAGMA integrity_check(1)")
        ((pages, size),) = connection.execute("SELECT * FROM pragma_page_count, pragma_page_size")
        ((_,),) = connection.execute("SELECT runName FROM run")
        if found != "ok":
            raise ValueError(found)
        if pages * size != path.stat().st_size:
            raise ValueError("its last page is incomplete")


def _rows(
    paths: Paths,
    kind: str,
    names: Names | None,
    data_of: Callable[["sqlite3.Connection", Collection[int]], Mapping[int, Row]],
) -> list[Row]:
    fits = name_filter(names)
    rows: list[Row] = []
    for path in [paths] if isinstance(paths, str | os.PathLike) else paths:
        with _opened(Path(path)) as connection:
            runs = _runs(connection)
            own = _texts(connection, f"{kind}Id, attrName, attrValue FROM {kind}Attr")
            query = f"SELECT {kind}Id, runId, moduleName, {kind}Name FROM {kind} ORDER BY {kind}Id"
            found = [row for row in connection.execute(query) if fits(row[3])]
            data = data_of(connection, {item for item, *_ in found})
            for item, run, module, name in found:
                run_name, attributes = runs[run]
                row = {"runID": run_name, "module": module, "name": name, **data[item]}
                for more in (attributes, own.get(item, {})):
                    row.update((key, text) for key, text in more.items() if key not in row)
                rows.append(row)
    return rows


def _values(connection: "sqlite3.Connection", items: Collection[int]) -> dict[int, Row]:
    query = "SELECT scalarId, scalarValue FROM scalar"
    return {item: {"value": _number(value)} for item, value in connection.execute(query) if item in items}


def _series(connection: "sqlite3.Connection", items: Collection[int]) -> dict[int, Row]:
    exponents = dict(connection.execute("SELECT vectorId, simtimeExp FROM vector JOIN run USING (runId)"))
    found = {item: (array("d"), array("d"), 10 ** -exponents[item]) for item in items}
    # In one query, by time: OMNeT++'s own files have no index. The plus sign keeps SQLite from using the
    # index of our files, which takes twice as long if most vectors are read.
    query = (
        "SELECT vectorId, simtimeRaw, value FROM vectorData "
        "WHERE +vectorId IN (SELECT value FROM json_each(?)) ORDER BY rowid"
    )
    for item, raw, value in connection.execute(query, (json.dumps(list(items)),)):
        times, values, per_second = found[item]
        times.append(raw / per_second)
        values.append(_number(value))
    return {item: {"vectime": times, "vecvalue": values} for item, (times, values, _) in found.items()}


def _runs(connection: "sqlite3.Connection") -> dict[int, tuple[str, dict[str, str]]]:
    """Return {id: (name of the run, its iteration variables and attributes)}."""
    variables = _texts(connection, "runId, itervarName, itervarValue FROM runItervar")
    attributes = _texts(connection, "runId, attrName, attrValue FROM runAttr")
    runs = {}
    for run, name in connection.execute("SELECT runId, runName FROM run"):
        told = attributes.get(run, {})
        taken = {*_COLUMNS, *told}
        iterations = {
            f"${variable}" if variable in taken else variable: value
            for variable, value in variables.get(run, {}).items()
        }
        runs[run] = (name, {**iterations, **told})
    return runs


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
    """Open a file read-only. Raises OSError and ValueError, with its name, also for what the block raises."""
    import sqlite3

    if has_checksum(path):
        with opened_pack(path) as connection:
            yield connection
        return
    # Files are replaced as a whole, never changed, so that no lock is needed.
    uri = f"{path.resolve().as_uri()}?mode=ro&immutable=1"
    try:
        with contextlib.closing(sqlite3.connect(uri, uri=True)) as connection:
            if connection.execute("SELECT 1 FROM sqlite_schema WHERE name LIKE 'packed%'").fetchall():
                verify_checksum(path)
            yield connection
    except (OSError, MemoryError):
        raise
    except Exception as error:  # of SQLite, or about a value that it returned
        reason = str(error) or type(error).__name__
        raise ValueError(f"{path}: {reason}; expected a file of OMNeT++'s results in SQLite") from error
