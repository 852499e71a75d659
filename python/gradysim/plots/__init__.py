"""Figures of a study: `gradysim plot` as functions.

Each function draws into axes of matplotlib and returns them. `runs` come from `gradysim.results.runs`. `y` is
the name of a quantity of `gradysim means`. `x` and `by` are names of variables: `config`, `mode` and those of
`${name=...}`. By default there is a curve for each combination of the other variables that differ.

    figure = gradysim.plots.new_figure()
    gradysim.plots.line(figure.subplots(), runs("results"), x="jitter", y="nodes[*] heard")

`save_figure` draws one and writes its files. `STYLE` are settings for `matplotlib.rc_context`.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gradysim.plots.cdf import cdf_numbers, draw_cdf
from gradysim.plots.compare import changes_height_in, changes_numbers, draw_changes
from gradysim.plots.figure import STYLE, check_file, new_figure, write_files
from gradysim.plots.line import diff_numbers, draw_diff, draw_line, line_numbers
from gradysim.plots.map import draw_map, map_numbers
from gradysim.plots.numbers import Numbers
from gradysim.plots.outcomes import draw_outcomes, outcome_names, outcomes_numbers
from gradysim.plots.time import draw_time, time_numbers, vector_names
from gradysim.results.compare import Change, Pairs
from gradysim.results.run_summary import RunSummary
from gradysim.results.run_table import Runs
from gradysim.scenario.errors import ConfigError, nearest

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = [
    "STYLE",
    "cdf",
    "diff",
    "draw",
    "line",
    "map",
    "new_figure",
    "outcomes",
    "save_changes",
    "save_figure",
    "save_numbers",
    "time",
]


def line(axes: "Axes", runs: Runs, *, x: str, y: str, by: Iterable[str] | None = None) -> "Axes":
    """Draw the mean of `y` over the runs with each value of `x`, with 95 % intervals."""
    return draw_line(axes, line_numbers(runs, x=x, y=y, by=by))


def diff(
    axes: "Axes",
    runs: Runs,
    *,
    x: str,
    y: str,
    by: Iterable[str] | None = None,
    baseline: str | None = None,
) -> "Axes":
    """Draw the mean difference of `y` between runs of the same seed, with 95 % intervals.

    The first variable of `by` is compared: each of its values minus `baseline`, by default the first one.
    """
    return draw_diff(axes, diff_numbers(runs, x=x, y=y, by=by, baseline=baseline))


def cdf(axes: "Axes", runs: Runs, *, y: str, by: Iterable[str] | None = None) -> "Axes":
    """Draw the distribution of delays of messages, of a tracked variable of nodes, or of a number of runs."""
    return draw_cdf(axes, cdf_numbers(runs, y=y, by=by))


def time(axes: "Axes", runs: Runs, *, y: str, by: Iterable[str] | None = None) -> "Axes":
    """Draw a tracked variable over simulated time, from the files of `gradysim run --vectors`."""
    return draw_time(axes, time_numbers(runs, y=y, by=by))


def outcomes(
    axes: "Axes",
    runs: Runs,
    *,
    y: str,
    x: str | None = None,
    by: Iterable[str] | None = None,
    omit: Iterable[str] = (),
) -> "Axes":
    """Draw the outcomes of frames or messages, `y` = `broadcast frames`, as stacked bars without `omit`."""
    return draw_outcomes(axes, outcomes_numbers(runs, x=x, y=y, by=by, omit=omit))


def map(axes: "Axes", runs: Runs) -> "Axes":
    """Draw the paths of the nodes of the first run, from the files of `gradysim run --vectors`."""
    return draw_map(axes, map_numbers(runs))


_MOST_CATEGORIES = 5
"""Largest number of categories whose names fit next to each other."""


@dataclass(frozen=True)
class Kind:
    """A kind of figure.

    Attributes:
        numbers: Computes the numbers of the figure.
        draw: Draws them into axes.
        needs: Arguments that `numbers` must have.
        takes: Its other arguments.
        names: Returns the valid values of `y`.
    """

    numbers: Callable[..., Numbers]
    draw: Callable[["Axes", Numbers], "Axes"]
    needs: tuple[str, ...]
    takes: tuple[str, ...] = ()
    names: Callable[[Runs], list[str]] = lambda runs: runs.quantities


KINDS: Mapping[str, Kind] = {
    "line": Kind(line_numbers, draw_line, ("x", "y"), ("by",)),
    "diff": Kind(diff_numbers, draw_diff, ("x", "y"), ("by", "baseline")),
    "cdf": Kind(cdf_numbers, draw_cdf, ("y",), ("by",)),
    "time": Kind(time_numbers, draw_time, ("y",), ("by",), vector_names),
    "outcomes": Kind(outcomes_numbers, draw_outcomes, ("y",), ("x", "by", "omit"), outcome_names),
    "map": Kind(map_numbers, draw_map, ()),
}


def draw(
    runs: Runs, *, kind: str = "line", columns: int = 1, log: Iterable[str] = (), **arguments: Any
) -> "Figure":
    """Draw a figure, which a notebook shows. Arguments and exceptions are those of `save_figure`."""
    chosen, given = _chosen(runs, kind, arguments)
    return _drawn(chosen.numbers(runs, **given), chosen.draw, new_figure(columns), log)


def save_figure(
    path: str | Path,
    runs: Runs,
    *,
    kind: str = "line",
    columns: int = 1,
    log: Iterable[str] = (),
    **arguments: Any,
) -> tuple[Path, Path, Path]:
    """Draw a figure and write FILE.pdf (.png, .svg), FILE.csv with its numbers, FILE.json with their origin.

    Args:
        path: The file of the picture.
        runs: At least one.
        kind: A name in `KINDS`.
        columns: Width of the figure: 1 or 2 columns of a page.
        log: Axes with a logarithmic scale: "x", "y".
        arguments: Arguments of the function of this kind; None if not given.

    Raises:
        ConfigError: An argument is not valid.
        ImportError: matplotlib is missing.
        OSError: A file cannot be read or written.
    """
    path = Path(path)
    chosen, given = _chosen(runs, kind, arguments)
    check_file(path, list(runs))
    empty = new_figure(columns)
    numbers = chosen.numbers(runs, **given)
    origin = {"kind": kind, **given, **({"log": list(log)} if log else {})}
    return _save(path, numbers, chosen.draw, list(runs), origin, empty, log)


def _chosen(runs: Runs, kind: str, arguments: Mapping[str, Any]) -> tuple[Kind, dict[str, Any]]:
    """Return a kind of figure, and the arguments for it that are given. Raises ConfigError."""
    if kind not in KINDS:
        raise ConfigError(
            f"there is no figure of kind {kind}", expected=", ".join(KINDS), suggestion=nearest(kind, KINDS)
        )
    chosen = KINDS[kind]
    given = {name: value for name, value in arguments.items() if value is not None and value != ()}
    for name in chosen.needs:
        if name not in given:
            expected = ", ".join(runs.variables if name == "x" else chosen.names(runs))
            raise ConfigError(f"--kind {kind} needs --{_option(name)}", expected=f"one of {expected}")
    for name in given:
        if name not in (*chosen.needs, *chosen.takes):
            takes = [f"--{_option(each)}" for each in (*chosen.needs, *chosen.takes)]
            raise ConfigError(
                f"--kind {kind} does not take --{_option(name)}",
                expected=" and ".join(takes) or "none of these",
            )
    return chosen, given


def _option(argument: str) -> str:
    return "metric" if argument == "y" else argument


def save_numbers(
    path: str | Path, numbers: Numbers, origin: Mapping[str, object], *, log: Iterable[str] = ()
) -> tuple[Path, Path, Path]:
    """Draw means that do not come from files of results, and write the three files of `save_figure`.

    Args:
        path: The file of the picture.
        numbers: Means with intervals.
        origin: Where they come from, for the JSON file.
        log: Axes with a logarithmic scale: "x", "y".

    Raises:
        ConfigError: The format is unknown.
        ImportError: matplotlib is missing.
        OSError: A file cannot be written.
    """

    def draw(axes: "Axes", numbers: Numbers) -> "Axes":
        draw_line(axes, numbers)
        if len(numbers.categories) > _MOST_CATEGORIES:
            axes.tick_params("x", rotation=30)
        return axes

    path = Path(path)
    check_file(path, [])
    return _save(path, numbers, draw, (), origin, new_figure(), log)


def save_changes(
    path: str | Path, changes: Iterable[Change], pairs: Pairs, first: str, second: str
) -> tuple[Path, Path, Path]:
    """Draw the changes between two sets of runs, and write the three files of `save_figure`.

    Args:
        path: The file of the picture.
        changes: Some of `pairs.changes()`. They are drawn in percent of the mean of the first set.
        pairs: The compared runs.
        first: Name of the first set.
        second: Name of the second set.

    Raises:
        ConfigError: The format is unknown, or no change can be drawn.
        ImportError: matplotlib is missing.
        OSError: A file cannot be read or written.
    """
    path = Path(path)
    check_file(path, pairs.all_runs)
    numbers = changes_numbers(changes, first, second)
    empty = new_figure()
    empty.set_figheight(changes_height_in(numbers))
    return _save(path, numbers, draw_changes, pairs.all_runs, {"compared": [first, second]}, empty)


def _save(
    path: Path,
    numbers: Numbers,
    draw: Callable[["Axes", Numbers], "Axes"],
    runs: Sequence[RunSummary],
    origin: Mapping[str, object],
    empty: "Figure",
    log: Iterable[str] = (),
) -> tuple[Path, Path, Path]:
    """Draw numbers into an empty figure, and write the three files."""
    from matplotlib import rc_context

    with rc_context(STYLE):
        return write_files(_drawn(numbers, draw, empty, log), path, numbers, runs, origin)


def _drawn(
    numbers: Numbers, draw: Callable[["Axes", Numbers], "Axes"], empty: "Figure", log: Iterable[str]
) -> "Figure":
    """Return the figure with these numbers, on logarithmic axes for `log`."""
    from matplotlib import rc_context

    with rc_context(STYLE):
        axes = draw(empty.subplots(), numbers)
        for axis in log:
            if getattr(axes.dataLim, f"minpos{axis}") == inf:
                raise ConfigError(f"--log {axis}: no value on this axis is positive")
            getattr(axes, f"set_{axis}scale")("log")
    return empty
