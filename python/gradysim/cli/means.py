"""`gradysim means`: means over the runs in a directory, as a table or as CSV."""

import csv
import sys
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Annotated, TextIO

from cyclopts import Parameter

from gradysim.cli.errors import OK, say_mistake
from gradysim.cli.options import Names, ResultsArgument
from gradysim.cli.study import check_quantities, read_study, warn_of_mixed_runs

if TYPE_CHECKING:
    from rich.table import Table

    from gradysim.results.means import Mean

_BEFORE = ("config", "mode")
_AFTER = ("quantity", "runs", "mean", "low", "high", "left_out")


def print_means(
    directory: ResultsArgument,
    /,
    *quantities: Annotated[
        str,
        Parameter(
            name="QUANTITY",
            help="Quantities to print, by name, such as `uavs[*] heard` or `*delay*`: `*` is any letters, `?`"
            " any single one. Default: all but numbers of the run itself, such as `cpu_s` and `events`.",
        ),
    ],
    metric: Annotated[Names, Parameter(help="The same as QUANTITY, as other commands have it.")] = (),
    as_csv: Annotated[
        bool, Parameter(name="--csv", negative="", help="Print CSV, with all digits, for other programs.")
    ] = False,
) -> int:
    """Print means over runs, of tracked variables, outcomes and delays, with 95 % confidence intervals."""
    from gradysim.cli.console import console
    from gradysim.results.means import means
    from gradysim.scenario.errors import ConfigError

    try:
        wanted = (*quantities, *metric)
        results = read_study(directory)
        found = means(results, wanted or None)
        check_quantities(wanted, (mean.quantity for mean in found), directory, results.quantities)
    except (ConfigError, OSError) as mistake:
        return say_mistake(mistake)
    warn_of_mixed_runs(directory, results)
    if as_csv:
        write_csv(found, sys.stdout)
    else:
        console().print(means_table(found))
    return OK


def means_table(means: "Sequence[Mean]") -> "Table":
    """Return a row for each mean. A configuration and mode shared by all rows become the title.

    Names and values come from files: `Text` does not parse their brackets as markup.
    """
    from rich import box
    from rich.table import Table
    from rich.text import Text

    from gradysim.cli.console import interval_text

    config, mode = {mean.config for mean in means}, {mean.mode for mean in means}
    title = [*(config if len(config) == 1 else ()), *(f"{m} mode" for m in mode if len(mode) == 1)]
    table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False, title_justify="left")
    if title:
        table.title = Text(", ".join(title), style="table.title")
    variables = _variables(means)
    headings = [*(["config"] if len(config) > 1 else []), *(["mode"] if len(mode) > 1 else [])]
    for heading in [*headings, *(f"${name}" for name in variables), "quantity"]:
        table.add_column(Text(heading), overflow="fold")
    for heading in ("runs", "mean", "± (95 %)"):
        table.add_column(heading, justify="right", no_wrap=True)
    some_left_out = any(mean.left_out for mean in means)
    if some_left_out:
        table.add_column("left out", overflow="fold")
    for mean in means:
        cells = [mean.config] if len(config) > 1 else []
        cells += [mean.mode] if len(mode) > 1 else []
        cells += [str(mean.iterations.get(name, "")) for name in variables]
        cells += [mean.quantity, str(mean.runs)]
        cells += ["" if mean.mean is None else f"{mean.mean:.6g}"]
        cells += [interval_text(mean.mean, mean.low, mean.high, ".3g")]
        table.add_row(*map(Text, [*cells, *([mean.left_out] if some_left_out else [])]))
    return table


def write_csv(means: "Sequence[Mean]", output: TextIO) -> None:
    """Write a header and a line for each mean, with all digits.

    A variable with the name of another column, such as `mode`, gets the column `$mode`.
    """
    writer = csv.writer(output, lineterminator="\n")
    variables = _variables(means)
    taken = {*_BEFORE, *_AFTER}
    headings = [f"${name}" if name in taken else name for name in variables]
    writer.writerow([*_BEFORE, *headings, *_AFTER])
    writer.writerows(_rows(means, variables))


def _rows(means: "Sequence[Mean]", variables: Sequence[str]) -> Iterator[list[object]]:
    for mean in means:
        values = [mean.iterations.get(name, "") for name in variables]
        numbers = ["" if number is None else number for number in (mean.mean, mean.low, mean.high)]
        yield [mean.config, mean.mode, *values, mean.quantity, mean.runs, *numbers, mean.left_out]


def _variables(means: "Sequence[Mean]") -> list[str]:
    return list(dict.fromkeys(name for mean in means for name in mean.iterations))
