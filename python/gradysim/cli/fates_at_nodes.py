"""What became of frames at single nodes and of messages from them, for the summary of a run."""

from collections.abc import Iterable, Mapping

from rich import box
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from gradysim.cli.count_tables import CountTables
from gradysim.results.run_result import NodeResult

MAX_INTERFERERS = 10
"""Interferers that are shown of one node: those with the most copies."""


def fates_at_nodes(nodes: Iterable[NodeResult], fates: Iterable[str]) -> RenderableType:
    """Return a row for each kind of frame at each node, and a column for each of `fates` that there was."""
    rows = {
        f"{node.name} {kind}": counts for node in nodes for kind, counts in (node.frame_fates or {}).items()
    }
    if not rows:
        return Text("no frame was strong enough to be received there")
    return _tables("at", rows, fates)


def messages_from_nodes(nodes: Iterable[NodeResult], fates: Iterable[str]) -> RenderableType:
    """Return the same for each kind of message from each node, from each interface where it has several."""
    rows = {
        f"{_sender(node, interface)} {kind}": counts
        for node in nodes
        for interface, kinds in (node.message_fates or {}).items()
        for kind, counts in kinds.items()
    }
    return _tables("from", rows, fates) if rows else Text("no protocol sent a message there")


def _sender(node: NodeResult, interface: str) -> str:
    return f"{node.name}.{interface}" if len(node.message_fates or {}) > 1 else node.name


def _tables(corner: str, rows: Mapping[str, Mapping[str, int]], fates: Iterable[str]) -> CountTables:
    met = {fate for counts in rows.values() for fate in counts}
    return CountTables(
        corner,
        {
            fate.replace("_", " "): {row: counts.get(fate, 0) for row, counts in rows.items()}
            for fate in fates
            if fate in met
        },
    )


def kinds_overheard(nodes: Iterable[NodeResult]) -> str:
    """Name the kinds of frames that are for one node and that these also heard of others; "" without any."""
    kinds = dict.fromkeys(kind for node in nodes for kind in node.frame_fates or {} if kind != "broadcast")
    *others, last = kinds or [""]
    return f"{', '.join(others)} and {last}" if others else last


def interferer_table(nodes: Iterable[NodeResult]) -> Table:
    """Return a row for each node that lost frames to interference: how many, and to whom."""
    table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
    table.add_column("at", no_wrap=True)
    table.add_column("copies lost", justify="right", no_wrap=True)
    table.add_column("with frames of", overflow="fold")
    for node in nodes:
        if node.interferers:
            lost = sum(counts.get("interference", 0) for counts in (node.frame_fates or {}).values())
            table.add_row(Text(node.name), f"{lost:,}", Text(_most(node.interferers.items())))
    return table


def _most(interferers: Iterable[tuple[str, int]]) -> str:
    """Name those of most copies, of equal ones the first."""
    by_copies = sorted(interferers, key=lambda interferer: -interferer[1])
    told = [f"{name} {copies:,}" for name, copies in by_copies[:MAX_INTERFERERS]]
    left = len(by_copies) - len(told)
    return ", ".join([*told, *([f"… and {left:,} more"] if left else [])])
