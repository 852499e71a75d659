"""Figures of a study: `gradysim plot` as functions.

Each function draws into axes of matplotlib and returns them. `runs` come from `gradysim.results.runs`. `y` is
the name of a quantity of `gradysim means`. `x` and `by` are names of variables: `config`, `mode` and those of
`${name=...}`. By default there is a curve for each combination of the other variables that differ.

    figure = gradysim.plots.new_figure()
    gradysim.plots.line(figure.subplots(), runs("results"), x="jitter", y="nodes[*] heard")

`save_figure` draws one and writes its files. `STYLE` are settings for `matplotlib.rc_context`.
"""

from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping
from inspect import signature
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gradysim.plots.cdf import cdf_numbers
from gradysim.plots.compare import changes_numbers
from gradysim.plots.figure import STYLE, check_file, new_figure, write_files
from gradysim.plots.line import diff_numbers, line_numbers
from gradysim.plots.map import map_numbers
from gradysim.plots.numbers import Numbers
from gradysim.plots.outcomes import outcome_names, outcomes_numbers
from gradysim.plots.time import time_numbers, vector_names
from gradysim.results.compare import Change, Pairs
from gradysim.results.run_summary import RunSummary
from gradysim.results.run_table import Runs
from gradysim.scenario.errors import ConfigError, unknown_name

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
    return line_numbers(runs, x=x, y=y, by=by).into(axes)


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
    return diff_numbers(runs, x=x, y=y, by=by, baseline=baseline).into(axes)


def cdf(axes: "Axes", runs: Runs, *, y: str, by: Iterable[str] | None = None) -> "Axes":
    """Draw the distribution of delays of messages, of a tracked variable of nodes, or of a number of runs."""
    return cdf_numbers(runs, y=y, by=by).into(axes)


def time(axes: "Axes", runs: Runs, *, y: str, by: Iterable[str] | None = None) -> "Axes":
    """Draw a tracked variable over simulated time, from the files of `gradysim run --vectors`."""
    return time_numbers(runs, y=y, by=by).into(axes)


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
    return outcomes_numbers(runs, x=x, y=y, by=by, omit=omit).into(axes)


def map(axes: "Axes", runs: Runs) -> "Axes":
    """Draw the paths of the nodes of the first run, from the files of `gradysim run --vectors`."""
    return map_numbers(runs).into(axes)


KINDS: Mapping[str, Callable[..., Numbers]] = {
    "line": line_numbers,
    "diff": diff_numbers,
    "cdf": cdf_numbers,
    "time": time_numbers,
    "outcomes": outcomes_numbers,
    "map": map_numbers,
}
"""Kinds of figures. The function of each computes its numbers, and its signature has the arguments."""

_NAMES: Mapping[str, Callable[[Runs], list[str]]] = defaultdict(
    lambda: lambda runs: runs.quantities, {"time": vector_names, "outcomes": outcome_names}
)
"""The valid values of `y`: for most kinds any quantity of the runs."""


def draw(
    runs: Runs, *, kind: str = "line", columns: int = 1, log: Iterable[str] = (), **arguments: Any
) -> "Figure":
    """Draw a figure, which a notebook shows. Arguments and exceptions are those of `save_figure`."""
    given = _given(runs, kind, arguments)
    return _drawn(KINDS[kind](runs, **given), new_figure(columns), log)


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
    given = _given(runs, kind, arguments)
    origin = {"kind": kind, **given, **({"log": list(log)} if log else {})}
    return _save(path, lambda: KINDS[kind](runs, **given), origin, runs, columns, log)


def _given(runs: Runs, kind: str, arguments: Mapping[str, Any]) -> dict[str, Any]:
    """Return the arguments for a kind of figure that are given. Raises ConfigError."""
    if kind not in KINDS:
        raise unknown_name(f"there is no figure of kind {kind}", kind, KINDS)
    given = {name: value for name, value in arguments.items() if value is not None and value != ()}
    _, *parameters = signature(KINDS[kind]).parameters.values()
    for each in parameters:
        if each.default is each.empty and each.name not in given:
            known = runs.variables if each.name == "x" else _NAMES[kind](runs)
            problem = f"--kind {kind} needs --{_option(each.name)}"
            raise ConfigError(problem, expected=f"one of {', '.join(known)}")
    takes = [each.name for each in parameters]
    for name in given:
        if name not in takes:
            raise ConfigError(
                f"--kind {kind} does not take --{_option(name)}",
                expected=" and ".join(f"--{_option(each)}" for each in takes) or "none of these",
            )
    return given


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
    return _save(path, lambda: numbers, origin, log=log)


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
    origin = {"compared": [first, second]}
    return _save(path, lambda: changes_numbers(changes, first, second), origin, pairs.all_runs)


def _save(
    path: str | Path,
    compute: Callable[[], Numbers],
    origin: Mapping[str, object],
    runs: Iterable[RunSummary] = (),
    columns: int = 1,
    log: Iterable[str] = (),
) -> tuple[Path, Path, Path]:
    """Compute and draw numbers, and write the three files. What can be wrong with the figure comes first."""
    path, runs = Path(path), list(runs)
    check_file(path, runs)
    empty = new_figure(columns)
    numbers = compute()

    from matplotlib import rc_context

    with rc_context(STYLE):
        return write_files(_drawn(numbers, empty, log), path, numbers, runs, origin)


def _drawn(numbers: Numbers, empty: "Figure", log: Iterable[str]) -> "Figure":
    """Return the figure with these numbers, on logarithmic axes for `log`."""
    from matplotlib import rc_context

    if numbers.height_in is not None:
        empty.set_figheight(numbers.height_in)
    with rc_context(STYLE):
        axes = numbers.into(empty.subplots())
        for axis in log:
            if getattr(axes.dataLim, f"minpos{axis}") == inf:
                raise ConfigError(f"--log {axis}: no value on this axis is positive")
            getattr(axes, f"set_{axis}scale")("log")
    return empty
