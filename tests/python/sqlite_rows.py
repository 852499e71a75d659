"""Asks files of results in SQLite, without the readers that are tested."""

import sqlite3
from contextlib import closing
from pathlib import Path


def rows_of(path: Path, query: str) -> list[tuple]:
    with closing(sqlite3.connect(path)) as connection:
        return connection.execute(query).fetchall()
