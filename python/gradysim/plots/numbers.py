"""Numbers of a figure: computed by each kind of figure, drawn, and written as CSV."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from gradysim.results.confidence_interval import Estimate, estimate
from gradysim.results.quantity import quantities
from gradysim.results.quantity_table import OF_RUN, grouped, values_of, variables_of
from gradysim.results.result import RunResult
from gradysim.results.run_summary import RunSummary
from gradysim.results.run_table import Runs
from gradysim.scenario.errors import BadValue, ConfigError, unknown_name
from gradysim.scenario.parse.expressions import parse_value
from gradysim.scenario.parse.units import UNITS, Quantity

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class Curve:
    """One curve of a figure, or one set of bars.

    Attributes:
        values: Values that distinguish the curve, `{"mode": "prototype"}`.
        columns: Its numbers, {heading: column}. The first column is the x axis.
    """

    values: Mapping[str, object]
    columns: Mapping[str, Sequence[Any]]

    @property
    def label(self) -> str:
        """Text for the legend."""
        return ", ".join(
            str(value) if name in (*OF_RUN, "node") and name not in ("run", "seed") else f"{name} = {value}"
            for name, value in self.values.items()
        )

    @property
    def x(self) -> Sequence[Any]:
        """The column of the x axis."""
        return next(iter(self.columns.values()))


@dataclass(frozen=True)
class Numbers:
    """Content of a figure.

    Attributes:
        draw: Draws the content into axes, and returns them.
        caption: Meaning of the numbers, and the number of runs.
        categories: Values of an x axis without numbers, in order.
        height_in: Height of the figure in inches; None for the usual one.
    """

    draw: Callable[["Axes", "Numbers"], "Axes"]
    curves: Sequence[Curve]
    x_label: str
    y_label: str
    caption: str
    categories: Sequence[str] = ()
    height_in: float | None = None

    def into(self, axes: "Axes") -> "Axes":
        """Draw the content into axes, and return them."""
        return self.draw(axes, self)


@dataclass(frozen=True)
class XAxis:
    """Values of an iteration variable on an axis.

    Attributes:
        label: Name of the variable, with its unit.
        positions: {value in the results: number, or string if not all values are numbers}, in the order of
            axis.
    """

    label: str
    positions: Mapping[Any, Any]

    @property
    def categories(self) -> tuple[str, ...]:
        """The values, if they are not numbers."""
        values = list(self.positions.values())
        return tuple(values) if any(isinstance(value, str) for value in values) else ()


def x_axis(runs: Runs, variable: str) -> XAxis:
    """Return the axis of a variable. Values with units of one dimension are numbers in one unit.

    Raises ConfigError for an unknown variable.
    """
    values = runs.values(variable)
    numbers = {value: _quantity(value) for value in values}
    known = [number for number in numbers.values() if number is not None]
    if len(known) < len(values) or not all(number.has_dimension_of(known[0]) for number in known):
        return XAxis(variable, {value: str(value) for value in values})
    unit = known[0].unit
    if unit is None:
        positions = {value: float(number.number) for value, number in numbers.items() if number}
    else:
        if any(number.unit != unit for number in known):  # the SI unit
            unit = next(
                each
                for each in UNITS.values()
                if each.dimension is unit.dimension and each.factor == 1 and not each.logarithmic
            )
        positions = {value: number.to(unit) for value, number in numbers.items() if number}
    label = f"{variable} ({unit.name})" if unit else variable
    return XAxis(label, dict(sorted(positions.items(), key=lambda each: each[1])))


def _quantity(value: object) -> Quantity | None:
    try:
        parsed = parse_value(str(value))
    except BadValue:
        return None
    return parsed if isinstance(parsed, Quantity) else None


def series_of(
    runs: Runs, by: Iterable[str] | None, x: str | None = None
) -> list[tuple[dict[str, Any], list[RunSummary]]]:
    """Return (values of `by`, runs) of each curve. Runs that differ by more than `x` are not mixed.

    By default `by` is all other variables that differ. Raises ConfigError if a given `by` omits one.
    """
    variables = [name for name in runs.variables if name not in ("run", "seed", x)]
    given = by is not None
    chosen = list(by or ())
    for name in chosen:
        runs.values(name)  # an unknown one raises
    for name in variables:
        if name not in chosen and _differs(runs, name, [*chosen, *([x] if x else [])]):
            if given:
                raise ConfigError(
                    f"the runs differ in `{name}`, too",
                    expected=f"--by {' '.join([*chosen, name])}, or one value: --where {name}=VALUE",
                )
            chosen.append(name)
    found = grouped(runs, lambda run: values_of(run, chosen))
    return [(dict(zip(chosen, values, strict=True)), alike) for values, alike in found.items()]


def _differs(runs: Runs, name: str, within: Sequence[str]) -> bool:
    groups = grouped(runs, lambda run: values_of(run, within)).values()
    return any(len({variables_of(run).get(name) for run in alike}) > 1 for alike in groups)


def check_quantity(runs: Runs, quantity: str, known: Iterable[str] = ()) -> None:
    """Check a name of `runs.quantities`, or of the `known` ones. Raises ConfigError."""
    names = list(known) or runs.quantities
    if quantity not in names:
        raise unknown_name(f"no quantity is called `{quantity}`", quantity, names)


def label_of(quantity: str) -> str:
    """Return the label of an axis: `delay (s)` for `delay in s`, `processor time (s)` for `cpu_s`."""
    declared = quantities(RunResult).get(quantity)
    if declared is not None:
        name = declared.summary or quantity
        return f"{name} ({declared.unit})" if declared.unit else name
    name, _, unit = quantity.rpartition(" in ")
    return f"{name} ({unit})" if name else quantity


def caption_of(shown: str, counts: Iterable[int], what: str = "run") -> str:
    """Return `mean, 95 % interval, n = 10 runs`. Single runs have no interval."""
    interval = "95 % interval, " if max(counts := list(counts), default=0) > 1 else ""
    return f"{shown}, {interval}{number_of_runs(counts, what)}"


def number_of_runs(counts: Iterable[int], what: str = "run") -> str:
    """Return `n = 8 to 10 runs`."""
    least, most = min(counts := list(counts), default=0), max(counts, default=0)
    number = f"{least} to {most}" if least < most else str(most)
    return f"n = {number} {what}{'s' if most != 1 else ''}"


def mean_columns(groups: Sequence[Sequence[float]], *, binary: bool = False) -> dict[str, list[Any]]:
    """Return the columns of the means of groups of numbers, with 95 % confidence intervals."""
    found = [estimate(group, binary=binary) for group in groups]
    return {"runs": [len(group) for group in groups], **columns_of(found)}


def columns_of(found: Sequence[Estimate]) -> dict[str, list[Any]]:
    """Return the columns of means and of the ends of their intervals."""
    return {name: [getattr(each, name) for each in found] for name in ("mean", "low", "high")}


def band(curve: Curve) -> tuple[list[float], list[float]]:
    """Return lower and upper ends of the intervals; NaN if there is none, as for a single run."""
    low, high = (
        [math.nan if end is None else end for end in curve.columns[name]] for name in ("low", "high")
    )
    return low, high


def bars(
    means: Sequence[float], low: Sequence[float | None], high: Sequence[float | None]
) -> tuple[list[float], list[float]]:
    """Return the lengths of error bars below and above the means, which are 0 without an interval."""
    below = [0.0 if end is None else mean - end for mean, end in zip(means, low, strict=True)]
    above = [0.0 if end is None else end - mean for mean, end in zip(means, high, strict=True)]
    return below, above
