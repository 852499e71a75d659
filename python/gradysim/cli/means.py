"""`gradysim means`: means over the runs in a directory, as a table or as CSV."""

import sys
from collections.abc import Sequence
from typing import Annotated, TextIO

from cyclopts import Parameter
from rich.table import Table
from rich.text import Text

from gradysim.cli.console import console, interval_text, number_column, report_table, text_column, write_csv
from gradysim.cli.errors import OK, report_error
from gradysim.cli.options import Names, ResultsArgument
from gradysim.cli.study import check_quantities, read_study, warn_of_mixed_runs
from gradysim.results.means import Mean, means
from gradysim.scenario.errors import ConfigError

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
    """Carry out `gradysim means`, and return the exit code."""
    try:
        wanted = (*quantities, *metric)
        results = read_study(directory)
        found = means(results, wanted or None)
        check_quantities(wanted, (mean.quantity for mean in found), directory, results.quantities)
    except (ConfigError, OSError) as error:
        return report_error(error)
    warn_of_mixed_runs(directory, results)
    if as_csv:
        write_means(found, sys.stdout)
    else:
        console().print(means_table(found))
    return OK


def means_table(means: Sequence[Mean]) -> Table:
    """Return a row for each mean. A configuration and mode shared by all rows become the title.

    Names and values come from files: `Text` does not parse their brackets as markup.
    """
    shared = {"config": "{}", "mode": "{} mode"}
    varying = [name for name in shared if len({getattr(mean, name) for mean in means}) > 1]
    title = [text.format(getattr(means[0], name)) for name, text in shared.items() if name not in varying]
    variables = list(dict.fromkeys(name for mean in means for name in mean.iterations))
    some_left_out = any(mean.left_out for mean in means)
    table = report_table(
        *map(text_column, [*varying, *(f"${name}" for name in variables), "quantity"]),
        *map(number_column, ("runs", "mean", "± (95 %)")),
        *([text_column("left out")] if some_left_out else []),
        title=", ".join(title),
    )
    for mean in means:
        cells = [getattr(mean, name) for name in varying]
        cells += [str(mean.iterations.get(name, "")) for name in variables]
        cells += [mean.quantity, str(mean.runs), "" if mean.mean is None else f"{mean.mean:.6g}"]
        cells += [interval_text(mean.mean, mean.low, mean.high, ".3g")]
        table.add_row(*map(Text, [*cells, *([mean.left_out] if some_left_out else [])]))
    return table


def write_means(means: Sequence[Mean], output: TextIO) -> None:
    """Write CSV with a line for each mean."""
    write_csv(output, _BEFORE, _AFTER, [(mean.iterations, vars(mean)) for mean in means])
