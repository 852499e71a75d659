"""What came out of one run, for people: times, nodes and what they tracked, fates."""

from collections.abc import Mapping
from numbers import Real

from rich import box
from rich.console import Console, ConsoleOptions, Group, RenderableType, RenderResult
from rich.measure import Measurement
from rich.table import Table
from rich.text import Text

from gradysim.config.iterations import text_of_iterations
from gradysim.protocol.plain_value import plain_value
from gradysim.results.run_result import NodeResult, RunResult

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
        shown = result.nodes if len(result.nodes) <= MAX_NODES else result.nodes[:NODES_OF_MANY]
        parts += [title("Nodes"), node_table(shown)]
        if len(shown) < len(result.nodes):
            parts.append(Text(f"… and {len(result.nodes) - len(shown):,} more nodes; --json has all"))
    for what, kinds in result.fates.items():
        if has_counts(kinds):
            parts += [title(FATE_TITLES.get(what, what)), FateTables(counted(kinds))]
    return Group(*parts)


def title(text: str) -> Text:
    """Return the line above a table."""
    return Text(f"\n{text}", style="bold")


def heading(result: RunResult) -> Text:
    """Return which run this was, and whether it ended early."""
    text = Text(f"{result.config} run {result.run}", style="bold")
    values = f"{text_of_iterations(result.iterations)}, " if result.iterations else ""
    text.append(f"  {values}seed {result.seed}, {result.mode} mode", style="not bold")
    if result.interrupted:
        text.append(f"\ninterrupted at {result.sim_time_s:g} s of simulated time", style="bold red")
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
    text = "nan" if is_nan else str(plain_value(value))
    return text if len(text) <= MAX_VALUE_LENGTH else text[: MAX_VALUE_LENGTH - 1] + "…"


def counted(kinds: Mapping[str, Mapping[str, int]]) -> dict[str, dict[str, int]]:
    """Return {kind: {fate: count}} without what belongs to an option, and of which there was nothing."""
    met = {fate for counts in kinds.values() for fate, count in counts.items() if count}
    return {
        kind: {fate: count for fate, count in counts.items() if fate in met or fate not in OF_OPTIONS}
        for kind, counts in kinds.items()
        if any(counts.values()) or kind not in OF_OPTIONS
    }


def has_counts(kinds: Mapping[str, Mapping[str, int]]) -> bool:
    """Return whether anything was counted at all."""
    return any(any(fates.values()) for fates in kinds.values())


class FateTables:
    """The fates of {kind: {fate: count}}: one table, or several if the console has no room for it.

    A table that is squeezed into a narrow console loses digits.
    """

    def __init__(self, kinds: Mapping[str, Mapping[str, int]]) -> None:
        self._kinds = kinds

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Yield tables of as many kinds as fit beside each other, at least one."""
        unlimited = options.update(max_width=10_000)
        shown: dict[str, Mapping[str, int]] = {}
        for kind, counts in self._kinds.items():
            wider = {**shown, kind: counts}
            if shown and Measurement.get(console, unlimited, fate_table(wider)).maximum > options.max_width:
                yield fate_table(shown)
                yield Text()
                wider = {kind: counts}
            shown = wider
        yield fate_table(shown)


def fate_table(kinds: Mapping[str, Mapping[str, int]]) -> Table:
    """Return a row per fate and a column per kind, of {kind: {fate: count}}."""
    table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
    table.add_column("fate", no_wrap=True)
    for kind in kinds:
        table.add_column(Text(kind.replace(" ", "\n")), justify="right", no_wrap=True)
    fates = list(dict.fromkeys(fate for counts in kinds.values() for fate in counts))
    for fate in fates:
        table.add_row(
            Text(fate.replace("_", " ")), *(f"{counts.get(fate, 0):,}" for counts in kinds.values())
        )
    table.add_section()
    table.add_row("sum", *(f"{sum(counts.values()):,}" for counts in kinds.values()))
    return table
