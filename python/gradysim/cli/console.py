"""Console for reports, and how they print tables, CSV and intervals."""

import csv
import math
import os
import sys
from collections.abc import Mapping, Sequence
from itertools import chain
from typing import TextIO

from rich import box
from rich.console import Console
from rich.table import Column, Table
from rich.text import Text

_NO_BOUND = 10_000
"""Width in columns. Tables are as wide as they need to be."""


class _Console(Console):
    def on_broken_pipe(self) -> None:
        """Raise the BrokenPipeError, which `main` handles. Rich would exit."""
        raise


def console(output: TextIO | None = None) -> Console:
    """Return a console for `output`, by default standard output.

    A terminal has a width, or COLUMNS sets one. A file or a pipe does not: each row of a table is one line
    for programs such as grep, and nothing is truncated.
    """
    target = sys.stdout if output is None else output
    has_width = target.isatty() or "COLUMNS" in os.environ
    return _Console(
        file=target, width=None if has_width else _NO_BOUND, markup=False, emoji=False, highlight=False
    )


def interval_text(
    mean: float | None, low: float | None, high: float | None, digits: str, plus_minus: str = ""
) -> str:
    """Return half the width of an interval after `plus_minus`, or both ends if the mean is not in the middle.

    `digits` is a format specification. A single number has no interval: "".
    """
    if mean is None or low is None or high is None:
        return ""
    # Three digits do not show a difference of 0.5 %, which may be the rounding error of the mean.
    if math.isclose(mean - low, high - mean, rel_tol=0.005, abs_tol=1e-9 * abs(mean)):
        return f"{plus_minus}{high / 2 - low / 2:{digits}}"
    return f"[{low:{digits}}, {high:{digits}}]"


def report_table(*columns: Column, title: str = "") -> Table:
    """Return an empty table. A title comes from files: `Text` does not parse its brackets as markup."""
    return Table(
        *columns,
        title=Text(title, style="table.title") if title else None,
        title_justify="left",
        box=box.SIMPLE_HEAD,
        show_edge=False,
        pad_edge=False,
    )


def text_column(heading: str) -> Column:
    """Return a column of texts, which fold if the terminal is narrow."""
    return Column(Text(heading), overflow="fold")


def number_column(heading: str) -> Column:
    """Return a column of numbers, each on one line."""
    return Column(Text(heading), justify="right", no_wrap=True)


def write_csv(
    output: TextIO,
    before: Sequence[str],
    after: Sequence[str],
    rows: Sequence[tuple[Mapping[str, object], Mapping[str, object]]],
) -> None:
    """Write a header and a line for each row, with all digits.

    A row is a pair of its values of variables and of its other cells. Columns of variables stand between the
    columns `before` and `after`. One with the name of another column, such as `mode`, is called `$mode`.
    """
    writer = csv.writer(output, lineterminator="\n")
    variables = list(dict.fromkeys(name for values, _ in rows for name in values))
    headings = [f"${name}" if name in (*before, *after) else name for name in variables]
    writer.writerow([*before, *headings, *after])
    for values, cells in rows:
        known = [cells[name] for name in before], map(values.get, variables), [cells[name] for name in after]
        writer.writerow(chain(*known))
