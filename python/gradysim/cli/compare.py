"""`gradysim compare`: what changes between two sets of runs, by pairs of the same seed."""

import csv
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TextIO

from cyclopts import Parameter

from gradysim.cli.errors import OK, say_mistake
from gradysim.cli.options import CompareOptions, ResultsArgument
from gradysim.cli.study import check_quantities, conditions, read_study, warn_of_mixed_runs

if TYPE_CHECKING:
    from rich.table import Table

    from gradysim.results.compare import Change, Pairs
    from gradysim.results.confidence_interval import Estimate
    from gradysim.results.run_table import Runs

_ROUNDING = 1e-12
"""Relative error of a mean of floats, at most."""

DEFAULTS = CompareOptions()

_BEFORE = ("quantity", "pairs")
_AFTER = tuple(f"{name}{end}" for name in ("first", "second", "difference") for end in ("", "_low", "_high"))


@dataclass(frozen=True)
class Side:
    """One of the two sets of runs.

    Attributes:
        name: Heading of its column.
        directory: Directory of its runs.
    """

    name: str
    directory: Path
    runs: "Runs"


def compare(
    first: ResultsArgument,
    second: Annotated[Path | None, Parameter(name="DIR", help="The directory to compare it with.")] = None,
    /,
    *,
    options: CompareOptions = DEFAULTS,
) -> int:
    """Compare two studies, or two modes or configurations of one, by pairs of runs with the same seed."""
    from gradysim.cli.console import console
    from gradysim.results.compare import pair_runs
    from gradysim.scenario.errors import ConfigError

    try:
        before, after = _sides(first, second, options)
        pairs = pair_runs(before.runs, after.runs)
        changes = pairs.changes(options.metric or None)
        check_quantities(
            options.metric,
            [change.quantity for change in changes],
            first,
            [*before.runs.quantities, *after.runs.quantities],
        )
        losses = pairs.losses()
        if options.output is not None:
            from gradysim.plots import save_changes

            files = save_changes(options.output, changes, pairs, before.name, after.name)
    except (ConfigError, ImportError, OSError) as mistake:
        return say_mistake(mistake)
    for directory, runs in {side.directory: side.runs for side in (before, after)}.items():
        warn_of_mixed_runs(directory, runs)
    warn_of_ranges(pairs)
    for side, other, left_out in zip((before, after), (after, before), pairs.left_out, strict=True):
        if left_out:
            print(
                f"{side.name}: left out {left_out} run{'s' if left_out > 1 else ''} without a partner of the"
                f" same seed in {other.name}",
                file=sys.stderr,
            )
    if options.as_csv:
        write_csv([*changes, *losses], sys.stdout)
        return OK
    names = before.name, after.name
    console().print(changes_table(changes, names))
    if losses:
        print()
        console().print(changes_table(losses, names, "losses, shares of receptions"))
    if any(change.difference and change.difference.excludes_zero for change in [*changes, *losses]):
        print("\n* the interval of the difference excludes 0")
    if options.output is not None:
        figure, numbers, origin = files
        print(f"drawn in {figure}; numbers in {numbers}, origin in {origin}")
    return OK


def warn_of_ranges(pairs: "Pairs") -> None:
    """Warn if runs of the two modes have different ranges: then that explains what differs."""
    from gradysim.scenario.ranges import are_alike

    for first, second in pairs.runs:
        one_m, other_m = first.number("range_m"), second.number("range_m")
        if first.mode == second.mode or one_m is None or other_m is None or are_alike(one_m, other_m):
            continue
        print(
            f"warning: in run {first.run} nodes reach {one_m:.4g} m in {first.mode} mode, and"
            f" {other_m:.4g} m in {second.mode} mode; expected one range for both, such as"
            f" `**.wlan[*].radio.transmitter.communicationRange = {min(one_m, other_m):.4g}m`",
            file=sys.stderr,
        )
        return


def _sides(first: Path, second: Path | None, options: CompareOptions) -> tuple[Side, Side]:
    """Return the two sets of runs. Raises ConfigError and OSError."""
    from gradysim.scenario.errors import ConfigError, nearest

    where = conditions(options.where)
    if second is not None:
        if options.by is not None:
            raise ConfigError(f"--by {options.by}: there are two directories to compare; expected one")
        if options.baseline is not None:
            raise ConfigError(f"--baseline {options.baseline}: expected --by VARIABLE, too")
        are_named = first.name and second.name and first.name != second.name
        before, after = (
            Side(each.name if are_named else str(each), each, read_study(each).where(**where))
            for each in (first, second)
        )
        return before, after
    if options.by is None:
        raise ConfigError("there is nothing to compare", expected="a second directory, or --by VARIABLE")
    runs = read_study(first).where(**where)
    values = runs.values(options.by)
    if len(values) != 2:
        raise ConfigError(
            f"--by {options.by}: the runs have {len(values)} value{'s' if len(values) > 1 else ''} of it"
            f" ({', '.join(map(str, values))})",
            expected=f"two: --where {options.by}=VALUE {options.by}=VALUE",
        )
    names = list(map(str, values))
    if options.baseline is not None:
        if options.baseline not in names:
            raise ConfigError(
                f"--baseline {options.baseline}: no run has {options.by} = {options.baseline}",
                expected=f"one of {', '.join(names)}",
                suggestion=nearest(options.baseline, names),
            )
        if options.baseline == names[1]:
            values.reverse()
    before, after = (Side(str(value), first, runs.where(**{options.by: value})) for value in values)
    return before, after


def changes_table(changes: "Sequence[Change]", names: tuple[str, str], what: str = "") -> "Table":
    """Return a row for each change. Values shared by all rows become the title.

    Names and values come from files: `Text` does not parse their brackets as markup.
    """
    from rich import box
    from rich.table import Table
    from rich.text import Text

    from gradysim.results.compare import varying_values

    varying = varying_values(changes)
    table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False, title_justify="left")
    if title := ", ".join(filter(None, [_title(changes, varying), what])):
        table.title = Text(title, style="table.title")
    for heading in [*(f"${name}" for name in varying), "quantity"]:
        table.add_column(Text(heading))
    for heading in (*names, "difference", "± (95 %)", "pairs"):
        table.add_column(Text(heading), justify="right", no_wrap=True)
    for change in changes:
        cells = [str(change.values.get(name, "")) for name in varying]
        cells += [change.quantity, _number(change.first, ".4g"), _number(change.second, ".4g")]
        cells += [_difference(change), _interval(change.difference)]
        table.add_row(*map(Text, [*cells, str(change.pairs)]))
    return table


def _title(changes: "Sequence[Change]", varying: Sequence[str]) -> str:
    values = changes[0].values if changes else {}
    shown = {"config": "{}", "mode": "{} mode"}
    return ", ".join(
        shown.get(name, f"{name} = {{}}").format(value)
        for name, value in values.items()
        if name not in varying
    )


def _number(estimate: "Estimate | None", digits: str) -> str:
    if estimate is None:
        return ""
    return f"{estimate.mean:{digits}}" if estimate.mean else "0"


def _difference(change: "Change") -> str:
    """Return the difference, without what is only the rounding error of the means."""
    if change.difference is None or change.first is None:
        return ""
    is_rounded = abs(change.difference.mean) < _ROUNDING * abs(change.first.mean)
    return "0" if is_rounded else _number(change.difference, "+.4g")


def _interval(estimate: "Estimate | None") -> str:
    from gradysim.cli.console import interval_text

    if estimate is None or estimate.low is None:
        return ""
    text = interval_text(estimate.mean, estimate.low, estimate.high, ".3g")
    return f"{text} {'*' if estimate.excludes_zero else ' '}"


def write_csv(changes: "Sequence[Change]", output: TextIO) -> None:
    """Write a header and a line for each change, with all digits."""
    writer = csv.writer(output, lineterminator="\n")
    variables = list(dict.fromkeys(name for change in changes for name in change.values))
    taken = {*_BEFORE, *_AFTER}
    headings = [f"${name}" if name in taken else name for name in variables]
    writer.writerow([*headings, *_BEFORE, *_AFTER])
    writer.writerows(_rows(changes, variables))


def _rows(changes: "Sequence[Change]", variables: Sequence[str]) -> Iterator[list[object]]:
    for change in changes:
        numbers: list[object] = []
        for estimate in (change.first, change.second, change.difference):
            numbers += [None] * 3 if estimate is None else [estimate.mean, estimate.low, estimate.high]
        values = [change.values.get(name, "") for name in variables]
        cells = ["" if number is None else number for number in numbers]
        yield [*values, change.quantity, change.pairs, *cells]
