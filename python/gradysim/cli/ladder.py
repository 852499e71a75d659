"""`gradysim ladder`: a metric at each level of realism, and its change from level to level."""

import sys
from dataclasses import asdict
from typing import Annotated

from cyclopts import Parameter
from rich.table import Column, Table
from rich.text import Text

from gradysim.cli.campaign import campaign_of, print_json, save
from gradysim.cli.console import console, interval_text, number_column, report_table, text_column
from gradysim.cli.errors import FAILED, OK, report_error
from gradysim.cli.options import CampaignOptions, FigureOption, FileArgument, RunCountOption
from gradysim.ladder.ladder import Rung, climb, largest_drop
from gradysim.results.confidence_interval import Estimate
from gradysim.scenario.errors import ConfigError, nearest

DEFAULTS = CampaignOptions()


def climb_ladder(
    file: FileArgument,
    /,
    *,
    metric: Annotated[
        str,
        Parameter(
            help="Quantity, by the name that `gradysim means` prints, such as `groundStation collected`."
        ),
    ],
    levels: Annotated[
        str | None, Parameter(help="A..B: only these levels, by number or name; by default all.")
    ] = None,
    run_count: RunCountOption = 20,
    output: FigureOption = None,
    options: CampaignOptions = DEFAULTS,
) -> int:
    """Carry out `gradysim ladder`, and return the exit code."""
    try:
        with campaign_of(file, options, run_count) as (campaign, executor):
            chosen = levels_between(levels, [level.name for level in campaign.levels])
            rungs = list(climb(campaign, metric, chosen, executor))
        if output is not None:
            from gradysim.ladder.figures import ladder_numbers

            save(output, ladder_numbers(rungs, metric, len(campaign)), file, options)
    except (ConfigError, ImportError, OSError) as error:
        return report_error(error)
    if options.as_json:
        print_json({"metric": metric, "runs": len(campaign), "levels": [rung_json(rung) for rung in rungs]})
    else:
        runs = "1 run" if len(campaign) == 1 else f"{len(campaign)} runs"
        console().print(ladder_table(rungs, f"{metric}, {runs} of {campaign.config} at each level"))
        _tell_first_failure(rungs, len(campaign))
    return FAILED if any(rung.failures for rung in rungs) else OK


def _tell_first_failure(rungs: list[Rung], run_count: int) -> None:
    failed = [rung for rung in rungs if rung.failures]
    if failed:
        levels = ", ".join(
            f"{rung.number} {rung.level.name} ({len(rung.failures)} of {run_count})" for rung in failed
        )
        index, failure = min(failed[0].failures.items())
        print(
            f"runs failed at level {levels}; level {failed[0].number}, run {index}: {failure}",
            file=sys.stderr,
        )


def rung_json(rung: Rung) -> dict[str, object]:
    """Return a level for other programs."""
    return {
        "level": rung.level.name,
        "metric": None if rung.metric is None else asdict(rung.metric),
        "change": None if rung.change is None else asdict(rung.change),
        "loss": rung.loss,
        "loss_ratio": rung.loss_ratio,
        "exceptions": [{"run": index} | asdict(each) for index, each in sorted(rung.failures.items())],
    }


def levels_between(text: str | None, names: list[str]) -> range:
    """Return the numbers of the levels of `--levels A..B`, where A and B are numbers or names.

    Raises ConfigError if there is no such level, or if B is before A.
    """
    if text is None:
        return range(len(names))
    first, dots, last = text.partition("..")
    ends = [_number_of(each.strip(), names) for each in (first, last if dots else first)]
    if ends[1] < ends[0]:
        from gradysim.scenario.errors import ConfigError

        raise ConfigError(f"--levels {text}: expected the more ideal level first")
    return range(ends[0], ends[1] + 1)


def _number_of(text: str, names: list[str]) -> int:
    if text in names:
        return names.index(text)
    if text.isdecimal() and int(text) < len(names):
        return int(text)
    raise ConfigError(
        f"--levels: no level `{text}`",
        expected=f"0 to {len(names) - 1}, or one of {', '.join(names)}",
        suggestion=nearest(text, names),
    )


def ladder_table(rungs: list[Rung], title: str) -> Table:
    """Return a row for each level. An arrow marks the largest drop."""
    table = report_table(
        Column("level", no_wrap=True),
        text_column("adds"),
        *map(number_column, ("mean ± 95 %", "change ± 95 %")),
        text_column("most frequent loss"),
        title=title,
    )
    worst = largest_drop(rungs)
    for rung in rungs:
        loss = f"{rung.loss.replace('_', ' ')} {rung.loss_ratio:.1%}" if rung.loss else ""
        change = "" if rung.change is None else text_of(rung.change, sign="+")
        mark = " ◀" if rung is worst else ""
        table.add_row(
            Text(f"{rung.number} {rung.level.name}"),
            Text(rung.level.adds),
            text_of(rung.metric),
            f"{change}{mark}",
            loss,
            style="bold" if rung is worst else None,
        )
    return table


def text_of(estimate: Estimate | None, sign: str = "") -> str:
    """Return `12.3 ± 0.4`, with four significant digits, or `0.9 [0.56, 1]`; "failed" without a number."""
    if estimate is None:
        return "failed"
    interval = interval_text(estimate.mean, estimate.low, estimate.high, ".2g", "± ")
    return " ".join(filter(None, [f"{estimate.mean:{sign}.4g}", interval]))
