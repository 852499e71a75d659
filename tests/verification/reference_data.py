"""Figures of other simulators for comparisons: the CSV files of the directory reference."""

import csv
from pathlib import Path

Row = dict[str, str]

_FOLDER = Path(__file__).parent / "reference"


def rows(name: str, **wanted: object) -> list[Row]:
    """Return the rows of reference/NAME.csv whose columns have the given values.

    Raises ValueError if there are none: a comparison with nothing would always agree.
    """
    with (_FOLDER / f"{name}.csv").open(newline="") as file:
        found = [
            row
            for row in csv.DictReader(file)
            if all(row[column] == str(value) for column, value in wanted.items())
        ]
    if not found:
        raise ValueError(f"{name}.csv has no rows with {wanted}")
    return found
