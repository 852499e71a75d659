"""The figures of other simulators that we compare with: the CSV files of the folder reference."""

import csv
from pathlib import Path

Row = dict[str, str]

_FOLDER = Path(__file__).parent / "reference"


def rows(name: str, **wanted: object) -> list[Row]:
    """The rows of reference/NAME.csv, those only whose columns have the values that are wanted.

    Raises ValueError if there are none: a comparison with nothing agrees with everything.
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
