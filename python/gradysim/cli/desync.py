"""`gradysim desync`: which timers send into each other, and the jitter that they need."""

import sys
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from gradysim.cli.errors import FAILED, OK, say_mistake
from gradysim.cli.options import CampaignOptions, FigureOption, FileArgument, RunCountOption

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rich.table import Table

    from gradysim.ladder.clashes import Diagnosis, Pattern
    from gradysim.ladder.desync import Desync

DEFAULTS = CampaignOptions()

_RARE = 0.01
"""Ratio of clashes below which a pattern is not worth a line."""

_BECAUSE = {
    "synchronized": "fire together: {apart} apart, every {period}",
    "drifting": "drift past each other: they come close again and again, every {period}",
    "hidden": "come from nodes that do not hear each other, so that jitter does not help",
    "saturated": "fill the channel, so that jitter does not help: send less or shorter frames",
    "random": "meet by chance, {apart} apart",
}


def desynchronize_timers(
    file: FileArgument,
    /,
    *,
    metric: Annotated[
        str, Parameter(help="Quantity to print for each jitter, by the name that `gradysim means` prints.")
    ] = "events",
    run_count: RunCountOption = 4,
    output: FigureOption = None,
    options: CampaignOptions = DEFAULTS,
) -> int:
    """Find timers of nodes that send into each other, and the random delay (jitter) that they need."""
    from gradysim.cli.campaign import campaign_of, executor_of, save
    from gradysim.cli.console import console
    from gradysim.ladder.desync import desynchronize
    from gradysim.scenario.errors import ConfigError

    try:
        campaign = campaign_of(file, options, run_count)
        with executor_of(options) as executor:
            found = desynchronize(campaign, executor, metric)
        if output is not None and found.trials:
            from gradysim.ladder.figures import jitter_numbers

            save(output, jitter_numbers(found), file, options, log=("x",))
    except (ConfigError, ImportError, OSError) as mistake:
        return say_mistake(mistake)
    except Exception as failure:
        print(f"{options.config} run 0: {failure}", file=sys.stderr)
        return FAILED
    terminal = console()
    terminal.print(*sentences(found), sep="\n", markup=False, highlight=False)
    if found.trials:
        terminal.print()
        terminal.print(curve_table(found, metric))
    return OK


def sentences(found: "Desync") -> "Iterator[str]":
    """Yield what was found, in words."""
    diagnosis = found.diagnosis
    if not diagnosis.clashes:
        yield f"None of {diagnosis.receptions:,} receptions was lost to another frame."
        return
    yield (
        f"{diagnosis.clashes:,} of {diagnosis.receptions:,} receptions were lost to another frame"
        f" ({diagnosis.clashes / diagnosis.receptions:.1%})."
    )
    yield from sentences_about_patterns(diagnosis, 5)
    if found.jitter_s is None:
        yield "No jitter was tried: the clashes are too few, or jitter does not help against them."
        return
    named = " and ".join(f'timer "{timer}" of {group}' for group, timer in found.timers)
    first, best = found.trials[0], max(trial.delivery for trial in found.trials)
    chosen = next(trial for trial in found.trials if trial.jitter_s == found.jitter_s)
    yield (
        f"Delay {named} by a random time of up to {text_of_time(found.jitter_s)}: {first.delivery:.1%} of the"
        f" receptions arrive without it, {chosen.delivery:.1%} with it, and {best:.1%} at best"
        f" ({found.run_count} runs)."
    )


def sentences_about_patterns(diagnosis: "Diagnosis", most: int) -> "Iterator[str]":
    """Yield a line for each of the most frequent patterns of clashes; rare ones are left out."""
    for pattern in diagnosis.patterns[:most]:
        if pattern.count >= diagnosis.clashes * _RARE:
            yield f"  {pattern.count / diagnosis.clashes:4.0%} of them: {_text_of(pattern)}"


def _text_of(pattern: "Pattern") -> str:
    because = _BECAUSE[pattern.verdict].format(
        apart=text_of_time(pattern.apart_s), period=text_of_time(pattern.period_s)
    )
    names = " and ".join(map(str, pattern.origins)) if len(pattern.origins) > 1 else f"{pattern.origins[0]}"
    return f"{names}: {because}"


def text_of_time(seconds: float) -> str:
    """Return `40 ms`."""
    for unit, size in (("s", 1), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return "0 s" if seconds == 0 else f"{seconds * 1e9:.3g} ns"


def curve_table(found: "Desync", metric: str) -> "Table":
    """Return a row for each jitter. An arrow marks the recommended one."""
    from rich import box
    from rich.table import Table

    table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
    for heading in ("jitter", "delivered", metric):
        table.add_column(heading, justify="right", no_wrap=True)
    for trial in found.trials:
        is_chosen = trial.jitter_s == found.jitter_s
        table.add_row(
            text_of_time(trial.jitter_s),
            f"{trial.delivery:.1%}",
            f"{trial.metric:.5g}{' ◀' if is_chosen else ''}",
            style="bold" if is_chosen else None,
        )
    return table
