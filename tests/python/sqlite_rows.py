"""Reads result files in SQLite, without the readers under test."""

import sqlite3
from contextlib import closing
from pathlib import Path


def rows_of(path: Path, query: str) -> list[tuple]:
    with closing(sqlite3.connect(path)) as connection:
        return connection.execute(query).fetchall()
