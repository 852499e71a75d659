"""`gradysim plot`: figures of a study."""

import sys
from pathlib import Path

from gradysim.cli.errors import OK, report_error
from gradysim.cli.options import PlotOptions, ResultsArgument
from gradysim.cli.study import conditions, drawn_text, read_study, warn_of_mixed_runs
from gradysim.plots import save_figure
from gradysim.results.quantity_table import variables_of
from gradysim.results.run_table import Runs
from gradysim.scenario.errors import ConfigError


def draw_figure(directory: ResultsArgument, /, options: PlotOptions) -> int:
    """Carry out `gradysim plot`, and return the exit code."""
    try:
        study = read_study(directory)
        runs = _with_variable(directory, study.where(**conditions(options.where)), options.x)
        files = save_figure(
            options.output,
            runs,
            kind=options.kind,
            columns=options.columns,
            log=options.log,
            x=options.x,
            y=options.metric,
            by=options.by or None,
            baseline=options.baseline,
            omit=options.omit,
        )
    except (ConfigError, ImportError, OSError, ValueError) as error:
        return report_error(error)
    warn_of_mixed_runs(directory, runs)
    print(drawn_text(files))
    return OK


def _with_variable(directory: Path, runs: Runs, variable: str | None) -> Runs:
    """Return the runs that have the variable of the x axis, and print the number of others."""
    kept = Runs(run for run in runs if variable in variables_of(run))
    if not len(kept) or len(kept) == len(runs):
        return runs  # each run has a value, or `variable` is not known
    left_out = len(runs) - len(kept)
    configs = " ".join(f"config={config}" for config in kept.values("config"))
    print(
        f"{directory}: left out {left_out} run{'s' if left_out > 1 else ''} without `{variable}`;"
        f" expected --where {configs}",
        file=sys.stderr,
    )
    return kept
