"""`gradysim compare`: what changes between two sets of runs, by pairs of the same seed."""

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter
from rich.table import Table
from rich.text import Text

from gradysim.cli.console import console, interval_text, number_column, report_table, text_column, write_csv
from gradysim.cli.errors import OK, report_error
from gradysim.cli.options import CompareOptions, ResultsArgument
from gradysim.cli.study import check_quantities, conditions, drawn_text, read_study, warn_of_mixed_runs
from gradysim.results.compare import Change, Pairs, pair_runs, varying_values
from gradysim.results.confidence_interval import Estimate
from gradysim.results.run_table import Runs
from gradysim.scenario.errors import ConfigError, unknown_name
from gradysim.scenario.ranges import are_alike

_ROUNDING = 1e-12
"""Relative error of a mean of floats, at most."""

DEFAULTS = CompareOptions()

_ESTIMATES = ("first", "second", "difference")
_COLUMNS = ("quantity", "pairs", *(f"{name}{end}" for name in _ESTIMATES for end in ("", "_low", "_high")))


@dataclass(frozen=True)
class Side:
    """One of the two sets of runs.

    Attributes:
        name: Heading of its column.
        directory: Directory of its runs.
    """

    name: str
    directory: Path
    runs: Runs


def compare(
    first: ResultsArgument,
    second: Annotated[Path | None, Parameter(name="DIR", help="The directory to compare it with.")] = None,
    /,
    *,
    options: CompareOptions = DEFAULTS,
) -> int:
    """Carry out `gradysim compare`, and return the exit code."""
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
    except (ConfigError, ImportError, OSError) as error:
        return report_error(error)
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
        write_csv(sys.stdout, (), _COLUMNS, [_row(change) for change in [*changes, *losses]])
        return OK
    names = before.name, after.name
    console().print(changes_table(changes, names))
    if losses:
        print()
        console().print(changes_table(losses, names, "losses, shares of receptions"))
    if any(change.difference and change.difference.excludes_zero for change in [*changes, *losses]):
        print("\n* the interval of the difference excludes 0")
    if options.output is not None:
        print(drawn_text(files))
    return OK


def warn_of_ranges(pairs: Pairs) -> None:
    """Warn if runs of the two modes have different ranges: then that explains what differs."""
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
            problem = f"--baseline {options.baseline}: no run has {options.by} = {options.baseline}"
            raise unknown_name(problem, options.baseline, names)
        if options.baseline == names[1]:
            values.reverse()
    before, after = (Side(str(value), first, runs.where(**{options.by: value})) for value in values)
    return before, after


def changes_table(changes: Sequence[Change], names: tuple[str, str], what: str = "") -> Table:
    """Return a row for each change. Values shared by all rows become the title.

    Names and values come from files: `Text` does not parse their brackets as markup.
    """
    varying = varying_values(changes)
    table = report_table(
        *map(text_column, [*(f"${name}" for name in varying), "quantity"]),
        *map(number_column, (*names, "difference", "± (95 %)", "pairs")),
        title=", ".join(filter(None, [*_common_values(changes, varying), what])),
    )
    for change in changes:
        cells = [str(change.values.get(name, "")) for name in varying]
        cells += [change.quantity, _number(change.first, ".4g"), _number(change.second, ".4g")]
        cells += [_difference(change), _interval(change.difference)]
        table.add_row(*map(Text, [*cells, str(change.pairs)]))
    return table


def _common_values(changes: Sequence[Change], varying: Sequence[str]) -> list[str]:
    shown = {"config": "{}", "mode": "{} mode"}
    common = (
        {name: value for name, value in changes[0].values.items() if name not in varying} if changes else {}
    )
    return [shown.get(name, f"{name} = {{}}").format(value) for name, value in common.items()]


def _number(estimate: Estimate | None, digits: str) -> str:
    if estimate is None:
        return ""
    return f"{estimate.mean:{digits}}" if estimate.mean else "0"


def _difference(change: Change) -> str:
    """Return the difference, without what is only the rounding error of the means."""
    if change.difference is None or change.first is None:
        return ""
    is_rounded = abs(change.difference.mean) < _ROUNDING * abs(change.first.mean)
    return "0" if is_rounded else _number(change.difference, "+.4g")


def _interval(estimate: Estimate | None) -> str:
    if estimate is None or estimate.low is None:
        return ""
    text = interval_text(estimate.mean, estimate.low, estimate.high, ".3g")
    return f"{text} {'*' if estimate.excludes_zero else ' '}"


def _row(change: Change) -> tuple[Mapping[str, object], Mapping[str, object]]:
    """Return the values of a change and its other cells, for CSV."""
    cells: dict[str, object] = {"quantity": change.quantity, "pairs": change.pairs}
    for name in _ESTIMATES:
        estimate: Estimate | None = getattr(change, name)
        numbers = (None, None, None) if estimate is None else (estimate.mean, estimate.low, estimate.high)
        cells |= zip((name, f"{name}_low", f"{name}_high"), numbers, strict=True)
    return change.values, cells
