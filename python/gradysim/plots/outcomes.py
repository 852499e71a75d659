"""Outcomes of frames and messages: the ratio of each outcome as stacked bars."""

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from gradysim.plots.figure import COLORS, set_texts
from gradysim.plots.numbers import (
    Curve,
    Numbers,
    check_quantity,
    mean_columns,
    number_of_runs,
    series_of,
    x_axis,
)
from gradysim.results.outcomes import Outcomes, decided
from gradysim.results.quantity_table import variables_of
from gradysim.results.run_table import Runs, outcomes_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_COLORS = {
    "delivered": "#009E73",
    "acknowledged": "#009E73",
    "sent": "#009E73",
    "below sensitivity": "#DDDDDD",
}
"""Colors of arrived and of distant frames; the other outcomes have the other colors."""

_HATCHES = ("", "////", "xxxx")
"""Hatches of the first, second and third round of colors."""

_WIDTH = 0.7
"""Width of the bars of a category, relative to the distance of two categories."""


def outcomes_numbers(
    runs: Runs, *, y: str, x: str | None = None, by: Iterable[str] | None = None, omit: Iterable[str] = ()
) -> Numbers:
    """Return the ratio of each outcome for each value of `x`, averaged over runs.

    `y` is `broadcast frames`, `unicast messages` and so on: a kind, and a ledger of `outcomes`. `omit` names
    outcomes to leave out, such as `below sensitivity`. Ratios refer to the others. Raises ConfigError.
    """
    by_run = {id(run): outcomes_of(run) for run in runs}
    check_quantity(runs, y, _names(by_run.values()))
    kind, _, ledger = y.rpartition(" ")
    counts = {run: _counts(each, ledger, kind, set(omit)) for run, each in by_run.items()}
    axis = x_axis(runs, x) if x else None
    bars: list[tuple[dict[str, Any], list[dict[str, int]]]] = []
    for x_value in axis.positions if axis else [None]:
        for values, alike in series_of(runs, by, x):
            found = [
                counts[id(run)]
                for run in alike
                if sum(counts[id(run)].values()) and (x is None or variables_of(run).get(x) == x_value)
            ]
            if found:
                bars.append(({**({x: x_value} if x else {}), **values}, found))
    outcomes = dict.fromkeys(name for _, found in bars for each in found for name, n in each.items() if n)
    curves = []
    for outcome in outcomes:
        shares = [[each.get(outcome, 0) / sum(each.values()) for each in found] for _, found in bars]
        variables = {name: [values[name] for values, _ in bars] for name in bars[0][0]}
        curves.append(Curve({"outcome": outcome}, {**variables, **mean_columns(shares)}))
    caption = f"mean shares, {number_of_runs(len(found) for _, found in bars)}"
    categories = [_name_of(values, x) for values, _ in bars]
    return Numbers(draw_outcomes, curves, x or "", f"share of {y}", caption, categories)


def outcome_names(runs: Runs) -> list[str]:
    """Return the names for `y`: `broadcast frames` and so on."""
    return _names(map(outcomes_of, runs))


def _names(outcomes: Iterable[Outcomes]) -> list[str]:
    names = {f"{kind} {ledger}" for each in outcomes for ledger, kinds in each.items() for kind in kinds}
    return sorted(names)


def draw_outcomes(axes: "Axes", numbers: Numbers) -> "Axes":
    """Draw a bar for each value, and in it a part for each outcome."""
    bottom = [0.0] * len(numbers.categories)
    others = [color for color in COLORS if color not in _COLORS.values()]
    taken = 0
    for curve in numbers.curves:
        outcome = str(curve.values["outcome"])
        color, hatch = _COLORS.get(outcome, ""), ""
        if not color:
            color, hatch = others[taken % len(others)], _HATCHES[taken // len(others) % len(_HATCHES)]
            taken += 1
        heights = curve.columns["mean"]
        axes.bar(range(len(bottom)), heights, _WIDTH, bottom, label=outcome, color=color, hatch=hatch)
        bottom = [low + height for low, height in zip(bottom, heights, strict=True)]
    set_texts(axes, numbers)
    axes.set_ylim(0, 1)
    handles, labels = axes.get_legend_handles_labels()
    if handles:  # in the order of the stack
        axes.legend(handles[::-1], labels[::-1], loc="center left", bbox_to_anchor=(1, 0.5))
    return axes


def _counts(outcomes: Outcomes, ledger: str, kind: str, omit: set[str]) -> dict[str, int]:
    counts = decided(outcomes.get(ledger, {}).get(kind, {}))
    return {outcome: count for outcome, count in counts.items() if outcome not in omit}


def _name_of(values: Mapping[str, object], x: str | None) -> str:
    """Return the text below a bar: the value of `x`, and the values that distinguish adjacent bars."""
    others = Curve({name: value for name, value in values.items() if name != x}, {}).label
    return "\n".join(filter(None, [str(values[x]) if x else "", others.replace(", ", "\n")]))
