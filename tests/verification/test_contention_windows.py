"""Beacons whose first sends are in a short window, so that stations contend: against INET's ten seeds."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from statistics import fmean, stdev
from typing import TYPE_CHECKING

import pytest

import gradysim.integrated.run
from verification.finding import Finding
from verification.reference_data import rows
from verification.reference_run import load_reference, received_in_error, tracked
from verification.sampling import least_p, welch_p

if TYPE_CHECKING:
    from matplotlib.axes import Axes

pytestmark = pytest.mark.verify

Window = tuple[int, int]
"""In microseconds, and the number of nodes with their first send in it."""

WINDOWS: dict[Window, str] = {(10_000, 50): "Window10ms", (2_000, 20): "Window2ms"}
"""{window: configuration}"""
CROWDED: dict[Window, str] = {
    (2_000, 30): "Window2ms30",
    (2_000, 50): "Window2ms50",
    (500, 50): "Window500us50",
}
"""The same, with enough collisions that EIFS matters: configurations with INET's EIFS."""
STANDARD_EIFS = "**.contention.inetEifs = false"
"""The default, for the configurations of CROWDED."""
SEEDS = range(100)
COLUMNS = ("received", "received_in_error")


@dataclass(frozen=True)
class Samples:
    """One count, per seed."""

    ours: list[int]
    inet: list[int]

    @property
    def p(self) -> float:
        return welch_p(self.ours, self.inet)

    @property
    def difference(self) -> float:
        return fmean(self.ours) / fmean(self.inet) - 1


@cache
def ours(window: Window, *overrides: str) -> list[tuple[int, int]]:
    """Return the frames received and received in error by all nodes, for each seed."""
    scenario = load_reference("beacons", (WINDOWS | CROWDED)[window], overrides=overrides)
    results = (gradysim.integrated.run.run(replace(scenario, seed=seed)) for seed in SEEDS)
    return [(sum(tracked(result, "received")), received_in_error(result)) for result in results]


def samples(window: Window, column: str, *overrides: str) -> Samples:
    index = COLUMNS.index(column)
    window_us, nodes = window
    theirs = [int(row[column]) for row in rows("inet_window", window_us=window_us, nodes=nodes)]
    return Samples([counts[index] for counts in ours(window, *overrides)], theirs)


def compare(windows: Iterable[Window], comparison: str, remark: str = "") -> Finding:
    found = {(window, column): samples(window, column) for window in windows for column in COLUMNS}
    limit = least_p(len(found))
    return Finding(
        comparison,
        "; ".join(
            f"{nodes} nodes, {window_us / 1000:g} ms, {column.replace('_', ' ')}: {sample.difference:+.2%} "
            f"(p = {sample.p:.2g})"
            for ((window_us, nodes), column), sample in found.items()
        )
        + remark,
        f"p ≥ {limit:.2g} for each of the {len(found)}",
        "sampling error at 99 % for all together (Welch's t test, Bonferroni): false alarms at most 1 %",
        min(sample.p for sample in found.values()) >= limit,
    )


def test_counts_agree_with_inets_ten_seeds(
    report: Callable[[Finding], None], picture: Callable[[str, Callable[[Path], None]], None]
) -> None:
    picture("contention_windows.png", draw)
    report(
        compare(
            WINDOWS,
            "contention windows of 10 ms (50 nodes) and 2 ms (20 nodes), 100 seeds, against INET's 10",
        )
    )


def test_counts_in_crowded_windows_agree_with_inets_ten_seeds(report: Callable[[Finding], None]) -> None:
    by_default = [samples(window, "received", STANDARD_EIFS).difference for window in CROWDED]
    report(
        compare(
            CROWDED,
            "contention windows of 2 ms (30, 50 nodes) and 0.5 ms (50 nodes), with INET's EIFS, 100 seeds, "
            "against INET's 10",
            "; with the standard's EIFS, the default, received: "
            + ", ".join(f"{difference:+.1%}" for difference in by_default),
        )
    )


def draw(path: Path) -> None:
    from verification.figure import INET, MODEL, OURS, save

    def panel(window: Window, column: str) -> "Callable[[Axes], None]":
        def draw_panel(axes: "Axes") -> None:
            sample = samples(window, column)
            columns = {"INET 4.5": (INET, sample.inet), "gradysim": (OURS, sample.ours)}
            if window in CROWDED:
                columns["standard's\nEIFS"] = (MODEL, samples(window, column, STANDARD_EIFS).ours)
            for index, (color, values) in enumerate(columns.values()):
                # Next to each other in the order of the seeds; a bar for mean and standard error.
                places = [index + 0.6 * (k + 0.5) / len(values) - 0.3 for k in range(len(values))]
                axes.plot(places, values, "o", color=color, ms=3, mfc="none", alpha=0.7)
                axes.errorbar(
                    index,
                    fmean(values),
                    stdev(values) / len(values) ** 0.5 * 2.58,
                    fmt="_",
                    color="black",
                    ms=22,
                    capsize=5,
                    zorder=5,
                )
            axes.set(
                xticks=range(len(columns)),
                xticklabels=list(columns),
                xlim=(-0.6, len(columns) - 0.4),
                ylabel="frames",
            )
            window_us, nodes = window
            axes.set_title(f"{nodes} nodes, {window_us / 1000:g} ms: {column.replace('_', ' ')}", fontsize=8)

        return draw_panel

    windows = [*WINDOWS, *CROWDED]
    save(
        path,
        "Frames of all nodes in 60 s, one dot for each seed; bars: mean, 99 % interval",
        *(panel(window, column) for column in COLUMNS for window in windows),
        columns=len(windows),
        width=2.9,
        height=2.9,
    )
