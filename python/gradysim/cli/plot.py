"""`gradysim plot`: figures of a study."""

from collections.abc import Iterable

from gradysim.cli.errors import OK, say_mistake
from gradysim.cli.options import PlotOptions, ResultsArgument
from gradysim.cli.study import read_study, warn_of_mixed_runs


def draw_figure(directory: ResultsArgument, /, options: PlotOptions) -> int:
    """Draw a figure of the runs in a directory, and write its numbers and their origin beside it."""
    from gradysim.plots import save_figure
    from gradysim.scenario.errors import ConfigError

    try:
        study = read_study(directory)
        runs = study.where(**_wanted(options.where))
        files = save_figure(
            options.output,
            runs,
            kind=options.kind,
            columns=options.columns,
            log=options.log,
            x=options.x,
            y=options.y,
            by=options.by or None,
            baseline=options.baseline,
            omit=options.omit,
        )
    except (ConfigError, ImportError, OSError, ValueError) as mistake:
        return say_mistake(mistake)
    warn_of_mixed_runs(directory, runs)
    figure, numbers, origin = files
    print(f"drawn in {figure}; numbers in {numbers}, origin in {origin}")
    return OK


def _wanted(conditions: Iterable[str]) -> dict[str, list[str]]:
    """Return {variable: values}. Raises ConfigError."""
    from gradysim.scenario.errors import ConfigError

    wanted: dict[str, list[str]] = {}
    for condition in conditions:
        variable, equals, value = condition.partition("=")
        if not equals:
            raise ConfigError(f"--where {condition}: expected VARIABLE=VALUE")
        wanted.setdefault(variable, []).append(value)
    return wanted
