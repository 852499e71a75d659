"""Counts in rows and columns, with their sums, for consoles of any width."""

from collections.abc import Mapping

from rich import box
from rich.console import Console, ConsoleOptions, RenderResult
from rich.measure import Measurement
from rich.table import Table
from rich.text import Text


class CountTables:
    """The counts of {column: {row: count}}: one table, or several if the console has no room for it.

    A table that is squeezed into a narrow console loses digits.
    """

    def __init__(self, corner: str, columns: Mapping[str, Mapping[str, int]]) -> None:
        """Take the counts, and what stands above the names of the rows."""
        self._corner = corner
        self._columns = columns

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Yield tables of as many columns as fit beside each other, at least one."""
        unlimited = options.update(max_width=10_000)
        shown: dict[str, Mapping[str, int]] = {}
        for column, counts in self._columns.items():
            wider = {**shown, column: counts}
            if shown and Measurement.get(console, unlimited, self._table(wider)).maximum > options.max_width:
                yield self._table(shown)
                yield Text()
                wider = {column: counts}
            shown = wider
        yield self._table(shown)

    def _table(self, columns: Mapping[str, Mapping[str, int]]) -> Table:
        table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
        table.add_column(self._corner, no_wrap=True)
        for column in columns:
            table.add_column(Text(column.replace(" ", "\n")), justify="right", no_wrap=True)
        for row in dict.fromkeys(row for counts in columns.values() for row in counts):
            table.add_row(Text(row), *(f"{counts.get(row, 0):,}" for counts in columns.values()))
        table.add_section()
        table.add_row("sum", *(f"{sum(counts.values()):,}" for counts in columns.values()))
        return table
