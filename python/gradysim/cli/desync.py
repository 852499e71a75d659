"""`gradysim desync`: which timers send into each other, and the jitter that they need."""

from dataclasses import asdict
from typing import Annotated

from cyclopts import Parameter
from rich.table import Table

from gradysim.cli.campaign import campaign_of, print_json, save
from gradysim.cli.console import console, number_column, report_table
from gradysim.cli.errors import FAILED, OK, report_error
from gradysim.cli.options import CampaignOptions, FigureOption, FileArgument, RunCountOption
from gradysim.ladder.desync import Desync, desynchronize
from gradysim.ladder.desync_words import desync_sentences, text_of_time
from gradysim.scenario.errors import ConfigError

DEFAULTS = CampaignOptions()


def desynchronize_timers(
    file: FileArgument,
    /,
    *,
    metric: Annotated[
        str | None,
        Parameter(help="Quantity to print for each jitter, by the name that `gradysim means` prints."),
    ] = None,
    run_count: RunCountOption = 4,
    output: FigureOption = None,
    options: CampaignOptions = DEFAULTS,
) -> int:
    """Carry out `gradysim desync`, and return the exit code."""
    try:
        with campaign_of(file, options, run_count) as (campaign, executor):
            found = desynchronize(campaign, executor, metric)
        if output is not None and found.trials:
            from gradysim.ladder.figures import jitter_numbers

            save(output, jitter_numbers(found), file, options, log=("x",))
    except (ConfigError, ImportError, OSError) as error:
        return report_error(error)
    if options.as_json:
        print_json(asdict(found))
    else:
        terminal = console()
        terminal.print(*desync_sentences(found), sep="\n", markup=False, highlight=False)
        if found.trials:
            terminal.print()
            terminal.print(curve_table(found, metric))
    return FAILED if len(found.failures) == found.runs_per_trial else OK


def curve_table(found: Desync, metric: str | None) -> Table:
    """Return a row for each jitter. An arrow marks the recommended one."""
    has_failures = any(trial.failures for trial in found.trials)
    headings = [
        "jitter",
        "delivered",
        *(["failed runs"] if has_failures else []),
        *([metric] if metric else []),
    ]
    table = report_table(*map(number_column, headings))
    for trial in found.trials:
        is_chosen = trial.jitter_s == found.jitter_s
        cells = [text_of_time(trial.jitter_s), f"{trial.delivery:.1%}"]
        if has_failures:
            cells.append(str(len(trial.failures) or ""))
        if metric:
            cells.append("" if trial.metric is None else f"{trial.metric:.5g}")
        cells[-1] += " ◀" if is_chosen else ""
        table.add_row(*cells, style="bold" if is_chosen else None)
    return table
