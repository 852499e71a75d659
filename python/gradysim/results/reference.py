"""Writes the tables of fields in docs/reference/results.md: `python -m gradysim.results.reference FILE`."""

import re
import sys
from collections.abc import Iterator
from pathlib import Path

from gradysim.results.quantity import quantities
from gradysim.results.result import NodeResult, RunResult

_TABLE = re.compile(r"(<!-- fields of (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)


def with_tables(page: str) -> str:
    """Return a page with the tables between its comments `fields of CLASS` and `end` replaced."""
    classes = {cls.__name__: cls for cls in (RunResult, NodeResult)}
    return _TABLE.sub(lambda match: f"{match[1]}\n{table(classes[match[2]])}\n{match[3]}", page)


def table(result: type) -> str:
    """Return a Markdown table with a row for each field of a class of results."""
    lines = ["| field | what it is | unit | in `.sca` files | in `gradysim means` |", "|---|---|---|---|---|"]
    lines += (f"| {' | '.join(cells)} |" for cells in _rows(result))
    return "\n".join(lines) + "\n"


def _rows(result: type) -> Iterator[tuple[str, ...]]:
    for name, quantity in quantities(result).items():
        scalar, mean = (
            f"`{text}`" if text and "`" not in text else text for text in (quantity.scalar, quantity.mean)
        )
        yield f"`{name}`", quantity.text, quantity.unit, scalar, mean


if __name__ == "__main__":
    for file in map(Path, sys.argv[1:]):
        file.write_text(with_tables(file.read_text(encoding="utf-8")), encoding="utf-8")
