"""Results of a run as text: a line, a summary that fits a screen, or all details."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from numbers import Real

from rich.console import Console, ConsoleOptions, Group, RenderableType, RenderResult
from rich.measure import Measurement
from rich.table import Column, Table
from rich.text import Text

from gradysim.cli.console import number_column, report_table, text_column
from gradysim.protocol.plain_value import as_float, plain_value, readable_number
from gradysim.results.delays import Delays
from gradysim.results.outcomes import LEDGERS, Counts, outcome_ratios
from gradysim.results.quantity import quantities
from gradysim.results.result import NodeResult, RunResult
from gradysim.scenario.resolve.sweep import text_of_iterations

MAX_VALUE_LENGTH = 200
"""Characters shown of one tracked variable; the JSON object is complete."""

MAX_CELL_LENGTH = 24
"""The same in a column of a tracked variable."""

POSITION = "position in\xa0m"

MAX_ROWS = 12
"""Rows of nodes, or of groups if there are more nodes."""

MAX_NODES, NODES_OF_MANY = 50, 20
"""Number of nodes of which the details are shown, and number of nodes shown of more."""

ARRIVED = {
    "unicast messages acknowledged": "unicast acknowledged",
    "broadcast frames delivered": "broadcast delivered",
}
"""Ratios in the line of a run, and their names there."""

MAX_INTERFERERS = 10
"""Interferers that are shown of one node: those with the most receptions."""

OF_OPTIONS = {
    *("preamble_undetected", "header_error", "captured", "channel_access_failure"),
    *("rts", "rts overheard", "cts", "cts overheard"),
}
"""Outcomes and kinds of frames that belong to options. They are shown only where they occurred."""


def print_summary(result: RunResult, console: Console, *, details: bool = False) -> None:
    """Print the summary of `result`: what fits a screen, or all details."""
    console.print(detailed_summary(result) if details else summary(result))


def summary(result: RunResult) -> RenderableType:
    """Return what fits a screen: a row for each node or group, and for each kind of frame and message."""
    parts: list[RenderableType] = [heading(result), Text(cost(result))]
    if result.nodes:
        few = len(result.nodes) <= MAX_ROWS
        parts += [Text(), table_of_nodes(result.nodes) if few else table_of_groups(result.nodes)]
    for ledger, counts in result.outcomes.items():
        delays = result.message_delays if ledger == "messages" else {}
        if (table := table_of_kinds(LEDGERS[ledger].label, counts, delays)) is not None:
            parts += [Text(), table]
    return Group(*parts, *at_nodes(result))


def detailed_summary(result: RunResult) -> RenderableType:
    """Return all numbers of a run, with tables of nodes, outcomes and delays."""
    parts: list[RenderableType] = [heading(result), Text("\n".join(numbers(result)))]
    if result.nodes:
        shown, rest = some_of(result.nodes)
        parts += [title("Nodes"), node_table(shown), *rest]
    for ledger, counts in result.outcomes.items():
        if (table := network_outcomes(counts)) is not None:
            parts += [title(LEDGERS[ledger].title), table]
    if result.message_delays:
        parts += [title("Delays of messages, from protocol to protocol"), delay_table(result.message_delays)]
    return Group(*parts, *at_nodes(result))


def run_line(result: RunResult, which: str, width: int) -> str:
    """Return the line of one run of several: `which` it is, and its numbers, as many as fit into `width`."""
    line = which
    parts = [f"interrupted at {result.sim_time_s:,.9g} s"] if result.interrupted else []
    for part in [*parts, *key_numbers(result), f"{result.wall_s:.3f} s"]:
        if len(line) + 2 + len(part) <= width:
            line += f"  {part}"
    return line


def key_numbers(result: RunResult) -> Iterator[str]:
    """Yield the means of tracked variables by group, and the shares of messages that arrived."""
    groups = _groups(result.nodes)
    for group, nodes in groups.items():
        prefix = f"{group} " if len(groups) > 1 else ""
        for name in _variables(nodes):
            numbers = _numbers(nodes, name)
            if numbers:
                yield _printable(f"{prefix}{name} {sum(numbers) / len(numbers):.5g}")
    for average in outcome_ratios(result.outcomes):
        if average.name in ARRIVED:
            yield f"{ARRIVED[average.name]} {100 * average.value:.4g} %"


def cost(result: RunResult) -> str:
    """Return how much time was simulated, in which time."""
    speed = f" ({result.sim_time_s / result.wall_s:,.0f} x real time)" if result.wall_s > 0 else ""
    return f"{result.sim_time_s:,.9g} s simulated in {result.wall_s:.3f} s{speed}, {result.events:,} events"


def table_of_nodes(nodes: tuple[NodeResult, ...]) -> "WideTable":
    """Return a row for each node, and a column for each tracked variable."""
    columns = {POSITION: [", ".join(map(meters, node.position)) for node in nodes]}
    for name in _variables(nodes):
        columns[_printable(name)] = [
            _cell(node.tracked_variables[name]) if name in node.tracked_variables else "" for node in nodes
        ]
    return WideTable("node", [node.name for node in nodes], columns, left_out=POSITION)


def table_of_groups(nodes: tuple[NodeResult, ...]) -> RenderableType:
    """Return a row for each group of nodes, and a column for each tracked variable."""
    groups = _groups(nodes)
    left = len(groups) - MAX_ROWS
    shown = dict(list(groups.items())[:MAX_ROWS])
    columns = {"nodes": [f"{len(group):,}" for group in shown.values()]}
    has_ranges = False
    for name in _variables(nodes):
        cells = [_cells_of_group(group, name) for group in shown.values()]
        columns[_printable(name)] = ["".join(cell) for cell in cells]
        has_ranges |= any(len(cell) > 1 for cell in cells)
    notes = [Text(f"… and {left:,} more; --details has them")] if left > 0 else []
    notes += [Text("mean (lowest..highest) of the nodes of a group")] if has_ranges else []
    return Group(WideTable("group", list(shown), columns), *notes)


def _groups(nodes: Iterable[NodeResult]) -> dict[str, list[NodeResult]]:
    """Return {`uavs`: its nodes}."""
    groups: dict[str, list[NodeResult]] = {}
    for node in nodes:
        groups.setdefault(node.name.partition("[")[0], []).append(node)
    return groups


def _variables(nodes: Iterable[NodeResult]) -> list[str]:
    return list(dict.fromkeys(name for node in nodes for name in node.tracked_variables))


def _numbers(nodes: Iterable[NodeResult], name: str) -> list[float]:
    """Return the finite numbers of a tracked variable, without truth values."""
    values = (node.tracked_variables.get(name) for node in nodes)
    numbers = (as_float(value) for value in values if not isinstance(value, bool))
    return [number for number in numbers if number is not None and math.isfinite(number)]


def _cell(value: object) -> str:
    return _printable(short(value, MAX_CELL_LENGTH))


def _cells_of_group(nodes: Iterable[NodeResult], name: str) -> tuple[str, ...]:
    """Return the value that all nodes have; or their mean and their range; or how many values there are."""
    values = [node.tracked_variables[name] for node in nodes if name in node.tracked_variables]
    texts = set(map(_cell, values))
    if len(texts) < 2:
        return tuple(texts)
    numbers = _numbers(nodes, name)
    if len(numbers) < len(values):
        return (f"{len(texts)} values",)
    return (f"{sum(numbers) / len(numbers):.4g}", f" ({min(numbers):.4g}..{max(numbers):.4g})")


def table_of_kinds(label: str, counts: Counts, delays: Mapping[str, Delays]) -> "WideTable | None":
    """Return a row for each kind of frame or message, with the outcomes and delays that there were.

    Frames that were overheard are left out. None if there is nothing.
    """
    shown = {
        kind: outcomes
        for kind, outcomes in counts.items()
        if any(outcomes.values()) and not kind.endswith(" overheard")
    }
    met = dict.fromkeys(name for outcomes in shown.values() for name, count in outcomes.items() if count)
    columns = {
        name.replace("_", " "): [f"{outcomes.get(name, 0):,}" for outcomes in shown.values()] for name in met
    }
    if any(kind in delays for kind in shown):
        of_kinds = [delays.get(kind) for kind in shown]
        columns["mean delay"] = ["" if each is None else milliseconds(each.mean_s) for each in of_kinds]
        columns["95th percentile"] = [
            "" if each is None else milliseconds(each.quantile_s(0.95)) for each in of_kinds
        ]
    return WideTable(label, list(shown), columns) if shown else None


def at_nodes(result: RunResult) -> list[RenderableType]:
    """Return the outcomes at the nodes of `--outcomes-at`, and of messages from them."""
    chosen = tuple(node for node in result.nodes if node.frame_outcomes is not None)
    if not chosen:
        return []
    shown, rest = some_of(chosen)
    parts: list[RenderableType] = [title("Outcomes of frames at nodes, for any destination")]
    parts.append(frames_at_nodes(shown, result.outcomes["frames"]))
    if overheard := kinds_overheard(shown):
        parts.append(Text(f"of {overheard}, frames for other nodes that were overheard count, too"))
    if any(node.interferers for node in shown):
        parts += [title("Lost to interference, and with frames of which nodes"), interferer_table(shown)]
    parts.append(title("Messages from nodes and their outcomes"))
    parts.append(messages_from_nodes(shown, result.outcomes["messages"]))
    return [*parts, *rest]


def some_of(nodes: tuple[NodeResult, ...]) -> tuple[tuple[NodeResult, ...], list[Text]]:
    """Return the nodes that are shown, and a line about the others if there are any."""
    if len(nodes) <= MAX_NODES:
        return nodes, []
    left = len(nodes) - NODES_OF_MANY
    return nodes[:NODES_OF_MANY], [Text(f"… and {left:,} more nodes; --json has all")]


def title(text: str) -> Text:
    """Return the line above a table."""
    return Text(f"\n{text}", style="bold")


def heading(result: RunResult) -> Text:
    """Return which run this was, and whether it ended early."""
    text = Text(f"{result.config} run {result.run}", style="bold")
    values = f"{text_of_iterations(result.iterations)}, " if result.iterations else ""
    about = f"  {values}seed {result.seed}, {result.mode} mode, result hash {result.result_hash}"
    text.append(about, style="not bold")
    if result.interrupted:
        text.append(f"\ninterrupted at {result.sim_time_s:,.9g} s of simulated time", style="bold red")
    return text


def numbers(result: RunResult) -> Iterator[str]:
    """Yield a line for each number that is declared with a label for the summary."""
    shown = {name: quantity for name, quantity in quantities(RunResult).items() if quantity.summary}
    width = max(len(quantity.summary) for quantity in shown.values())
    for name, quantity in shown.items():
        value = getattr(result, name)
        if value is not None:
            unit = f" {quantity.unit}" if quantity.unit else ""
            speed = (
                f" ({result.sim_time_s / value:,.0f} x real time)" if name == "wall_s" and value > 0 else ""
            )
            yield f"{quantity.summary:{width}}  {value:{quantity.digits}}{unit}{speed}"


def node_table(nodes: tuple[NodeResult, ...]) -> Table:
    """Return a row for each node: its position and its tracked variables."""
    table = report_table(
        number_column("id"),
        text_column("name"),
        text_column("protocol"),
        number_column("position in m"),
        text_column("tracked variables"),
    )
    table.collapse_padding = True
    for node in nodes:
        table.add_row(
            Text(str(node.id)),
            Text(node.name),
            Text(node.protocol),
            Text(", ".join(map(meters, node.position))),
            Text("\n".join(map(tracked, node.tracked_variables.items()))),
        )
    return table


def delay_table(delays: Mapping[str, Delays]) -> Table:
    """Return a row for each kind of message: number of receptions and delays."""
    times = ("received", "mean", "median", "95th percentile", "longest")
    table = report_table(Column("kind", no_wrap=True), *map(number_column, times))
    for kind, each in delays.items():
        times_s = (each.mean_s, each.quantile_s(0.5), each.quantile_s(0.95), each.max_s)
        table.add_row(kind, f"{each.count:,}", *map(milliseconds, times_s))
    return table


def milliseconds(time_s: float) -> str:
    """Return a time with four digits, from 1 s on to the millisecond."""
    time_ms = time_s * 1e3
    return f"{time_ms:,.0f} ms" if time_ms >= 1000 else f"{time_ms:.4g} ms"


def meters(coordinate: float) -> str:
    """Return a coordinate to a tenth of a meter; one that rounds to zero has no sign."""
    return f"{coordinate:z.1f}"


def tracked(variable: tuple[str, object]) -> str:
    """Return the line of a tracked variable. Lone surrogates, which cannot be encoded, are escaped."""
    name, value = variable
    return _printable(f"{name} = {short(value)}")


def _printable(text: str) -> str:
    return text.encode(errors="backslashreplace").decode()


def short(value: object, length: int = MAX_VALUE_LENGTH) -> str:
    """Return `value` as a string of at most `length` characters."""
    is_nan = isinstance(value, Real) and value != value
    text = "nan" if is_nan else str(_readable(plain_value(value)))
    return text if len(text) <= length else text[: length - 1] + "…"


def _readable(plain: object) -> object:
    """Return a plain value with all its numbers rounded for people."""
    if isinstance(plain, float):
        return readable_number(plain)
    if isinstance(plain, list):
        return [_readable(item) for item in plain]
    if isinstance(plain, dict):
        return {key: _readable(item) for key, item in plain.items()}
    return plain


class WideTable:
    """A table, or several if the console is too narrow for all columns.

    A table that is squeezed into a narrow console would lose digits.
    """

    def __init__(
        self,
        corner: str,
        rows: Sequence[str],
        columns: Mapping[str, Sequence[str]],
        sums: Mapping[str, str] | None = None,
        left_out: str = "",
    ) -> None:
        """Take the names of rows, with their heading, {heading: cells} of the others, and {heading: sum}.

        The column `left_out` is left out if the console is too narrow for all.
        """
        self._corner = corner
        self._rows = rows
        self._columns = columns
        self._sums = sums
        self._left_out = left_out

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Yield tables of as many columns as fit beside each other, at least one."""
        if self._fits(self._columns, console, options):
            yield self._table(self._columns)
            return
        shown: dict[str, Sequence[str]] = {}
        for heading, cells in self._columns.items():
            if heading == self._left_out and len(self._columns) > 1:
                continue
            wider = {**shown, heading: cells}
            if shown and not self._fits(wider, console, options):
                yield self._table(shown)
                yield Text()
                wider = {heading: cells}
            shown = wider
        yield self._table(shown)

    def _fits(self, columns: Mapping[str, Sequence[str]], console: Console, options: ConsoleOptions) -> bool:
        unlimited = options.update(max_width=10_000)
        return Measurement.get(console, unlimited, self._table(columns)).maximum <= options.max_width

    def _table(self, columns: Mapping[str, Sequence[str]]) -> Table:
        numbers = [number_column(heading.replace(" ", "\n")) for heading in columns]
        table = report_table(Column(Text(self._corner), no_wrap=True), *numbers)
        for row, *cells in zip(self._rows, *columns.values(), strict=True):
            table.add_row(*map(Text, (row, *cells)))
        if self._sums is not None:
            table.add_section()
            table.add_row("sum", *(self._sums[heading] for heading in columns))
        return table


def count_table(corner: str, columns: Mapping[str, Mapping[str, int]]) -> WideTable:
    """Return the counts of {column: {row: count}}, with sums."""
    rows = list(dict.fromkeys(row for counts in columns.values() for row in counts))
    return WideTable(
        corner,
        rows,
        {name: [f"{counts.get(row, 0):,}" for row in rows] for name, counts in columns.items()},
        {name: f"{sum(counts.values()):,}" for name, counts in columns.items()},
    )


def network_outcomes(counts: Counts) -> WideTable | None:
    """Return a column for each kind, and a row for each outcome; None if nothing was counted."""
    if not any(any(outcomes.values()) for outcomes in counts.values()):
        return None
    met = {outcome for outcomes in counts.values() for outcome, count in outcomes.items() if count}
    return count_table(
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
        f"{node.name} {kind}": counts
        for node in nodes
        for kind, counts in (node.frame_outcomes or {}).items()
    }
    if not rows:
        return Text("no frame was strong enough to be received there")
    return _node_tables("at", rows, network)


def messages_from_nodes(nodes: Iterable[NodeResult], network: Counts) -> RenderableType:
    """Return the same for each kind of message from each node, by interface where it has several."""
    rows = {
        f"{_sender(node, interface)} {kind}": counts
        for node in nodes
        for interface, kinds in (node.message_outcomes or {}).items()
        for kind, counts in kinds.items()
    }
    return _node_tables("from", rows, network) if rows else Text("no protocol sent a message there")


def _sender(node: NodeResult, interface: str) -> str:
    return f"{node.name}.{interface}" if len(node.message_outcomes or {}) > 1 else node.name


def _node_tables(corner: str, rows: Counts, network: Counts) -> WideTable:
    met = {outcome for counts in rows.values() for outcome in counts}
    columns = dict.fromkeys(outcome for counts in network.values() for outcome in counts if outcome in met)
    return count_table(
        corner,
        {
            outcome.replace("_", " "): {row: counts.get(outcome, 0) for row, counts in rows.items()}
            for outcome in columns
        },
    )


def kinds_overheard(nodes: Iterable[NodeResult]) -> str:
    """Return the kinds of frames for one node that the nodes also overheard of others; "" if none."""
    kinds = dict.fromkeys(kind for node in nodes for kind in node.frame_outcomes or {} if kind != "broadcast")
    *others, last = kinds or [""]
    return f"{', '.join(others)} and {last}" if others else last


def interferer_table(nodes: Iterable[NodeResult]) -> Table:
    """Return a row for each node that lost frames to interference: how many, and frames of which nodes."""
    table = report_table(
        Column("at", no_wrap=True), number_column("frames lost"), text_column("with frames of")
    )
    for node in nodes:
        if node.interferers:
            lost = sum(counts.get("interference", 0) for counts in (node.frame_outcomes or {}).values())
            table.add_row(Text(node.name), f"{lost:,}", Text(_strongest(node.interferers.items())))
    return table


def _strongest(interferers: Iterable[tuple[str, int]]) -> str:
    """Return those with the most receptions, of equal ones the first."""
    ordered = sorted(interferers, key=lambda interferer: -interferer[1])
    shown = [f"{name} {count:,}" for name, count in ordered[:MAX_INTERFERERS]]
    left = len(ordered) - len(shown)
    return ", ".join([*shown, *([f"… and {left:,} more"] if left else [])])
