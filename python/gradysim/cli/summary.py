"""What came out of one run, for people: times, nodes and what they tracked, fates."""

from collections.abc import Mapping
from numbers import Real

from rich import box
from rich.console import Console, Group, RenderableType
from rich.table import Table
from rich.text import Text

from gradysim.cli.count_tables import CountTables
from gradysim.cli.fates_at_nodes import (
    fates_at_nodes,
    interferer_table,
    kinds_overheard,
    messages_from_nodes,
)
from gradysim.protocol.plain_value import plain_value, readable_number
from gradysim.results.delays import Delays
from gradysim.results.run_result import NodeResult, RunResult
from gradysim.scenario.runs.iterations import text_of_iterations

MAX_VALUE_LENGTH = 200
"""Characters shown of one tracked variable; all of it is in the JSON."""

MAX_NODES, NODES_OF_MANY = 50, 20
"""Nodes up to which all are shown, and how many are shown of more."""

FATE_TITLES = {
    "frames": "Fates of frames, a copy for each radio",
    "copies": "Fates of messages, a copy for each receiver",
    "messages": "Messages",
}

OF_OPTIONS = {
    *("preamble_undetected", "header_error", "captured", "channel_access_failure"),
    *("rts", "rts overheard", "cts", "cts overheard"),
}
"""Fates and kinds of frames that take no room in the summaries of those who do not use them."""


def print_summary(result: RunResult, console: Console) -> None:
    """Print the summary of `result`."""
    console.print(summary(result))


def summary(result: RunResult) -> RenderableType:
    """Return the summary of `result` as something that rich can print."""
    parts: list[RenderableType] = [heading(result), cost(result)]
    if result.nodes:
        shown, rest = some_of(result.nodes)
        parts += [title("Nodes"), node_table(shown), *rest]
    for what, kinds in result.fates.items():
        if has_counts(kinds):
            parts += [title(FATE_TITLES.get(what, what)), CountTables("fate", counted(kinds))]
    if result.message_delays:
        parts += [title("Delays of messages, from protocol to protocol"), delay_table(result.message_delays)]
    return Group(*parts, *at_nodes(result))


def at_nodes(result: RunResult) -> list[RenderableType]:
    """Return what became of frames at the nodes that the run was asked for, and of messages from them."""
    told = tuple(node for node in result.nodes if node.frame_fates is not None)
    if not told:
        return []
    shown, rest = some_of(told)
    frames, messages = (names_of(result.fates[what]) for what in ("frames", "messages"))
    parts = [title("Fates of frames at nodes, whoever they were for"), fates_at_nodes(shown, frames)]
    if overheard := kinds_overheard(shown):
        parts.append(Text(f"of {overheard}, frames for other nodes that were overheard count, too"))
    if any(node.interferers for node in shown):
        parts += [title("Lost to interference, and to whose frames"), interferer_table(shown)]
    parts += [title("Messages from nodes and what became of them"), messages_from_nodes(shown, messages)]
    return [*parts, *rest]


def some_of(nodes: tuple[NodeResult, ...]) -> tuple[tuple[NodeResult, ...], list[Text]]:
    """Return the nodes that are shown, and what is said of the others if there are any."""
    if len(nodes) <= MAX_NODES:
        return nodes, []
    left = len(nodes) - NODES_OF_MANY
    return nodes[:NODES_OF_MANY], [Text(f"… and {left:,} more nodes; --json has all")]


def names_of(kinds: Mapping[str, Mapping[str, int]]) -> dict[str, None]:
    """Return all fates in their order, whether there were any or not."""
    return dict.fromkeys(fate for counts in kinds.values() for fate in counts)


def title(text: str) -> Text:
    """Return the line above a table."""
    return Text(f"\n{text}", style="bold")


def heading(result: RunResult) -> Text:
    """Return which run this was, and whether it ended early."""
    text = Text(f"{result.config} run {result.run}", style="bold")
    values = f"{text_of_iterations(result.iterations)}, " if result.iterations else ""
    text.append(f"  {values}seed {result.seed}, {result.mode} mode", style="not bold")
    if result.interrupted:
        text.append(f"\ninterrupted at {result.sim_time_s:,.9g} s of simulated time", style="bold red")
    return text


def cost(result: RunResult) -> Text:
    """Return the times, the events and the fingerprint, one line each."""
    speed = f" ({result.sim_time_s / result.wall_s:,.0f} x real time)" if result.wall_s > 0 else ""
    lines = [
        f"simulated time  {result.sim_time_s:,.9g} s",
        f"wall time       {result.wall_s:.3f} s{speed}, {result.cpu_s:.3f} s of processor time",
        f"events          {result.events:,}",
    ]
    if result.fingerprint is not None:
        lines.append(f"fingerprint     {result.fingerprint}")
    return Text("\n".join(lines))


def node_table(nodes: tuple[NodeResult, ...]) -> Table:
    """Return a row per node: where it is and what it tracked."""
    table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False, collapse_padding=True)
    table.add_column("id", justify="right", no_wrap=True)
    table.add_column("name", overflow="fold")
    table.add_column("protocol", overflow="fold")
    table.add_column("position in m", justify="right", no_wrap=True)
    table.add_column("tracked variables", overflow="fold")
    for node in nodes:
        table.add_row(
            Text(str(node.id)),
            Text(node.name),
            Text(node.protocol),
            Text(", ".join(map(metres, node.position))),
            Text("\n".join(map(tracked, node.tracked_variables.items()))),
        )
    return table


def delay_table(delays: Mapping[str, Delays]) -> Table:
    """Return a row per kind of message: how many were received, and how long they took."""
    table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
    table.add_column("kind", no_wrap=True)
    for column in ("received", "mean", "median", "95 %", "longest"):
        table.add_column(column, justify="right", no_wrap=True)
    for kind, each in delays.items():
        times_s = (each.mean_s, each.quantile_s(0.5), each.quantile_s(0.95), each.max_s)
        table.add_row(kind, f"{each.count:,}", *map(milliseconds, times_s))
    return table


def milliseconds(time_s: float) -> str:
    """Return a time to four digits, or to the millisecond if it is longer than that."""
    time_ms = time_s * 1e3
    return f"{time_ms:,.0f} ms" if time_ms >= 1000 else f"{time_ms:.4g} ms"


def metres(coordinate: float) -> str:
    """Return a coordinate to a tenth of a metre; what rounds to zero has no sign."""
    return f"{coordinate:z.1f}"


def tracked(variable: tuple[str, object]) -> str:
    """Return the line of a tracked variable. Lone surrogates, which no output can hold, are escaped."""
    name, value = variable
    return f"{name} = {short(value)}".encode(errors="backslashreplace").decode()


def short(value: object) -> str:
    """Return `value` as text of at most `MAX_VALUE_LENGTH` characters."""
    is_nan = isinstance(value, Real) and value != value
    text = "nan" if is_nan else str(_readable(plain_value(value)))
    return text if len(text) <= MAX_VALUE_LENGTH else text[: MAX_VALUE_LENGTH - 1] + "…"


def _readable(plain: object) -> object:
    """Return a plain value with all its numbers as people read them."""
    if isinstance(plain, float):
        return readable_number(plain)
    if isinstance(plain, list):
        return [_readable(item) for item in plain]
    if isinstance(plain, dict):
        return {key: _readable(item) for key, item in plain.items()}
    return plain


def counted(kinds: Mapping[str, Mapping[str, int]]) -> dict[str, dict[str, int]]:
    """Return {kind: {fate: count}} for people, without what belongs to an option and of which was nothing."""
    met = {fate for counts in kinds.values() for fate, count in counts.items() if count}
    return {
        kind: {
            fate.replace("_", " "): count
            for fate, count in counts.items()
            if fate in met or fate not in OF_OPTIONS
        }
        for kind, counts in kinds.items()
        if any(counts.values()) or kind not in OF_OPTIONS
    }


def has_counts(kinds: Mapping[str, Mapping[str, int]]) -> bool:
    """Return whether anything was counted at all."""
    return any(any(fates.values()) for fates in kinds.values())
