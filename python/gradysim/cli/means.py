"""`gradysim means`: means over the runs in a directory, as a table for people and as CSV."""

import csv
import shlex
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TextIO

from cyclopts import Parameter

from gradysim.cli.errors import OK, say_mistake

if TYPE_CHECKING:
    from rich.table import Table

    from gradysim.results.means import Mean

_BEFORE = ("config", "mode")
_AFTER = ("quantity", "runs", "mean", "half_width", "left_out")


def print_means(
    directory: Annotated[Path, Parameter(name="DIR", help="The directory of `run --result-dir`.")],
    /,
    *quantities: Annotated[
        str,
        Parameter(
            name="QUANTITY",
            help="Quantities to print, by name, such as `uavs[*] heard` or `*delay*`: `*` is any letters, `?`"
            " any single one. Default: all.",
        ),
    ],
    as_csv: Annotated[
        bool, Parameter(name="--csv", negative="", help="Print CSV, with all digits, for other programs.")
    ] = False,
) -> int:
    """Print means over runs, of tracked variables, outcomes and delays, with 95 % confidence intervals."""
    from gradysim.cli.console import console
    from gradysim.results.means import (
        has_files_for_omnetpp_alone,
        means,
        of_different_files,
        of_different_settings,
        read_results,
        repeated,
    )
    from gradysim.results.quantity import name_filter
    from gradysim.scenario.errors import ConfigError, nearest

    quoted = shlex.quote(str(directory))
    try:
        if not directory.is_dir():
            reason = "it is not a directory" if directory.exists() else "there is no such directory"
            raise ConfigError(f"{directory}: {reason}; expected that of `gradysim run FILE --result-dir DIR`")
        results = read_results(directory)
        if not results:
            reason = (
                "no results" if not has_files_for_omnetpp_alone(directory) else "only .sca and .vec files"
            )
            raise ConfigError(
                f"{directory}: it has {reason} of complete runs; expected the JSON files of"
                f" `gradysim run FILE --result-dir {quoted}`"
            )
        found = means(results)
        names = dict.fromkeys(mean.quantity for mean in found)
        for quantity in quantities:
            if not any(map(name_filter(quantity), names)):
                raise ConfigError(
                    f"{directory}: no quantity is called `{quantity}`",
                    expected=f"one that `gradysim means {quoted}` prints",
                    suggestion=nearest(quantity, names),
                )
    except (ConfigError, OSError) as mistake:
        return say_mistake(mistake)
    if (pair := of_different_settings(results)) is not None:
        print(
            f"{directory}: warning: {pair[0]} and {pair[1]} have different settings (`settings_hash`), and"
            " their mean mixes both; expected a directory for each",
            file=sys.stderr,
        )
    elif (changed := of_different_files(results)) is not None:
        print(
            f"{directory}: warning: {changed[2]} changed between {changed[0]} and {changed[1]}"
            " (`file_hashes`), so they cannot be compared; expected one version of it: run"
            f" `gradysim run FILE --result-dir {quoted} --resume`",
            file=sys.stderr,
        )
    if repetitions := repeated(results):
        original, repetition = repetitions[0]
        print(
            f"{directory}: warning: {len(repetitions)} of {len(results)} runs repeat another one with the"
            f" same seed and results, such as {repetition} and {original}: the intervals are too narrow;"
            " expected a seed for each, as `seed-set = ${runnumber}`, the default, sets it",
            file=sys.stderr,
        )
    fits = name_filter(quantities or None)
    found = [mean for mean in found if fits(mean.quantity)]
    if as_csv:
        write_csv(found, sys.stdout)
    else:
        console().print(means_table(found))
    return OK


def means_table(means: "Sequence[Mean]") -> "Table":
    """Return a row for each mean; the configuration and mode that all have in common are the title.

    Names and values come from files: `Text` does not take their brackets for markup.
    """
    from rich import box
    from rich.table import Table
    from rich.text import Text

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
        cells += ["" if mean.half_width is None else f"{mean.half_width:.3g}"]
        table.add_row(*map(Text, [*cells, *([mean.left_out] if some_left_out else [])]))
    return table


def write_csv(means: "Sequence[Mean]", output: TextIO) -> None:
    """Write a heading and a line for each mean, with all digits.

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
        numbers = ["" if number is None else number for number in (mean.mean, mean.half_width)]
        yield [mean.config, mean.mode, *values, mean.quantity, mean.runs, *numbers, mean.left_out]


def _variables(means: "Sequence[Mean]") -> list[str]:
    return list(dict.fromkeys(name for mean in means for name in mean.iterations))
