"""Tables of outcomes for the summary of a run: of the whole network, and at single nodes."""

from collections.abc import Iterable, Mapping

from rich import box
from rich.console import Console, ConsoleOptions, RenderableType, RenderResult
from rich.measure import Measurement
from rich.table import Table
from rich.text import Text

from gradysim.results.outcomes import Counts
from gradysim.results.result import NodeResult

MAX_INTERFERERS = 10
"""Interferers that are shown of one node: those with the most receptions."""

OF_OPTIONS = {
    *("preamble_undetected", "header_error", "captured", "channel_access_failure"),
    *("rts", "rts overheard", "cts", "cts overheard"),
}
"""Outcomes and kinds of frames that belong to options. They are shown only where they occurred."""


class CountTables:
    """The counts of {column: {row: count}}: one table, or several if the console is too narrow for it.

    A table that is squeezed into a narrow console would lose digits.
    """

    def __init__(self, corner: str, columns: Mapping[str, Mapping[str, int]]) -> None:
        """Take the counts, and the heading of the names of rows."""
        self._corner = corner
        self._columns = columns

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Yield tables of as many columns as fit beside each other, at least one."""
        if self._fits(self._columns, console, options):
            yield self._table(self._columns)
            return
        shown: dict[str, Mapping[str, int]] = {}
        for column, counts in self._columns.items():
            wider = {**shown, column: counts}
            if shown and not self._fits(wider, console, options):
                yield self._table(shown)
                yield Text()
                wider = {column: counts}
            shown = wider
        yield self._table(shown)

    def _fits(
        self, columns: Mapping[str, Mapping[str, int]], console: Console, options: ConsoleOptions
    ) -> bool:
        unlimited = options.update(max_width=10_000)
        return Measurement.get(console, unlimited, self._table(columns)).maximum <= options.max_width

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


def network_outcomes(counts: Counts) -> CountTables | None:
    """Return a column for each kind, and a row for each outcome; None if nothing was counted."""
    if not any(any(outcomes.values()) for outcomes in counts.values()):
        return None
    met = {outcome for outcomes in counts.values() for outcome, count in outcomes.items() if count}
    return CountTables(
        "outcome",
        {
            kind: {
                outcome.replace("_", " "): count
                for outcome, count in outcomes.items()
                if outcome in met or outcome not in OF_OPTIONS
            }
            for kind, outcomes in counts.items()
            if any(outcomes.values()) or kind not in OF_OPTIONS
        },
    )


def frames_at_nodes(nodes: Iterable[NodeResult], network: Counts) -> RenderableType:
    """Return a row for each kind of frame at each node, and a column for each outcome that occurred.

    Columns are in the order of the outcomes of the network.
    """
    rows = {
        f"{node.name} {kind}": counts for node in nodes for kind, counts in (node.frame_fates or {}).items()
    }
    if not rows:
        return Text("no frame was strong enough to be received there")
    return _node_tables("at", rows, network)


def messages_from_nodes(nodes: Iterable[NodeResult], network: Counts) -> RenderableType:
    """Return the same for each kind of message from each node, by interface where it has several."""
    rows = {
        f"{_sender(node, interface)} {kind}": counts
        for node in nodes
        for interface, kinds in (node.message_fates or {}).items()
        for kind, counts in kinds.items()
    }
    return _node_tables("from", rows, network) if rows else Text("no protocol sent a message there")


def _sender(node: NodeResult, interface: str) -> str:
    return f"{node.name}.{interface}" if len(node.message_fates or {}) > 1 else node.name


def _node_tables(corner: str, rows: Counts, network: Counts) -> CountTables:
    met = {outcome for counts in rows.values() for outcome in counts}
    columns = dict.fromkeys(outcome for counts in network.values() for outcome in counts if outcome in met)
    return CountTables(
        corner,
        {
            outcome.replace("_", " "): {row: counts.get(outcome, 0) for row, counts in rows.items()}
            for outcome in columns
        },
    )


def kinds_overheard(nodes: Iterable[NodeResult]) -> str:
    """Return the kinds of frames for one node that the nodes also overheard of others; "" if none."""
    kinds = dict.fromkeys(kind for node in nodes for kind in node.frame_fates or {} if kind != "broadcast")
    *others, last = kinds or [""]
    return f"{', '.join(others)} and {last}" if others else last


def interferer_table(nodes: Iterable[NodeResult]) -> Table:
    """Return a row for each node that lost frames to interference: how many, and frames of which nodes."""
    table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
    table.add_column("at", no_wrap=True)
    table.add_column("frames lost", justify="right", no_wrap=True)
    table.add_column("with frames of", overflow="fold")
    for node in nodes:
        if node.interferers:
            lost = sum(counts.get("interference", 0) for counts in (node.frame_fates or {}).values())
            table.add_row(Text(node.name), f"{lost:,}", Text(_strongest(node.interferers.items())))
    return table


def _strongest(interferers: Iterable[tuple[str, int]]) -> str:
    """Return those with the most receptions, of equal ones the first."""
    ordered = sorted(interferers, key=lambda interferer: -interferer[1])
    shown = [f"{name} {count:,}" for name, count in ordered[:MAX_INTERFERERS]]
    left = len(ordered) - len(shown)
    return ", ".join([*shown, *([f"… and {left:,} more"] if left else [])])
