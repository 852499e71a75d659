"""Writes DIR/CONFIG-#RUN.MODE.sca: the single numbers of a run, for OMNeT++'s analysis tools."""

from collections.abc import Iterable
from pathlib import Path

from gradysim.results.database import RUN_ID, new_database, storable
from gradysim.results.run_identity import RunIdentity
from gradysim.results.scalars import Scalar


def write_scalar_file(scalars: Iterable[Scalar], identity: RunIdentity, path: Path) -> None:
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
