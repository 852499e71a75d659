"""Writes DIR/CONFIG-#RUN.MODE.sca: the numbers and histograms of a run, for OMNeT++'s analysis tools."""

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.results.database import RUN_ID, new_database, storable
from gradysim.results.histograms import Histogram, rows_of_bins
from gradysim.results.run_identity import RunIdentity
from gradysim.results.scalars import Scalar

if TYPE_CHECKING:
    import sqlite3


def write_scalar_file(
    scalars: Iterable[Scalar], identity: RunIdentity, path: Path, histograms: Iterable[Histogram] = ()
) -> None:
    """Write the whole file or nothing. Raises OSError, with its name."""
    with new_database(path, identity) as connection:
        for scalar in scalars:
            inserted = connection.execute(
                "INSERT INTO scalar (runId, moduleName, scalarName, scalarValue) VALUES (?, ?, ?, ?)",
                (RUN_ID, storable(scalar.module), storable(scalar.name), scalar.value),
            )
            connection.executemany(
                "INSERT INTO scalarAttr VALUES (?, ?, ?)",
                [(inserted.lastrowid, name, storable(value)) for name, value in scalar.attributes.items()],
            )
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
        "statStddev": values.stddev_s if values.count > 1 else None,  # as OMNeT++ has it
        "statSum": values.sum_s,
        "statSqrsum": values.sum_of_squares_s2,
        "statMin": values.min_s,
        "statMax": values.max_s,
    }
    inserted = connection.execute(
        f"INSERT INTO statistic ({', '.join(row)}) VALUES ({', '.join('?' * len(row))})", tuple(row.values())
    )
    connection.executemany(
        "INSERT INTO statisticAttr VALUES (?, ?, ?)",
        [(inserted.lastrowid, name, value) for name, value in histogram.attributes.items()],
    )
    connection.executemany(
        "INSERT INTO histogramBin VALUES (?, ?, ?)",
        [(inserted.lastrowid, *bin_row) for bin_row in rows_of_bins(values)],
    )
