"""Beacons whose first sends fall into a short window, so that stations contend: against INET's ten seeds."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from statistics import fmean, stdev
from typing import TYPE_CHECKING

import gradysim.integrated.run
from verification.finding import Finding
from verification.reference_data import rows
from verification.reference_run import load_reference, received_in_error, tracked
from verification.sampling import least_p, welch_p

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WINDOWS = {10_000: "Window10ms", 2_000: "Window2ms"}
"""{window in microseconds: configuration}"""
SEEDS = range(100)
COLUMNS = ("received", "received_in_error")
MEASURED = [(window_us, column) for window_us in WINDOWS for column in COLUMNS]


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
def ours(window_us: int) -> list[tuple[int, int]]:
    """Frames received and received in error by all nodes, for each seed."""
    scenario = load_reference("beacons", WINDOWS[window_us])
    results = (gradysim.integrated.run.run(replace(scenario, seed=seed)) for seed in SEEDS)
    return [(sum(tracked(result, "received")), received_in_error(result)) for result in results]


def samples(window_us: int, column: str) -> Samples:
    index = COLUMNS.index(column)
    theirs = [int(row[column]) for row in rows("inet_window", window_us=window_us)]
    return Samples([counts[index] for counts in ours(window_us)], theirs)


def test_counts_agree_with_inets_ten_seeds(
    report: Callable[[Finding], None], picture: Callable[[str, Callable[[Path], None]], None]
) -> None:
    picture("contention_windows.png", draw)
    found = {key: samples(*key) for key in MEASURED}
    limit = least_p(len(found))
    text = "; ".join(
        f"{column.replace('_', ' ')} in {window_us // 1000} ms: {sample.difference:+.2%} (p = {sample.p:.2g})"
        for (window_us, column), sample in found.items()
    )
    report(
        Finding(
            "contention windows of 10 ms (50 nodes) and 2 ms (20 nodes), 100 seeds, against INET's 10",
            text,
            f"p ≥ {limit:.2g} for each of the four",
            "sampling error at 99 % for all four together (Welch's t test, Bonferroni): false alarms at "
            "most 1 %",
            min(sample.p for sample in found.values()) >= limit,
        )
    )


def draw(path: Path) -> None:
    from verification.figure import INET, OURS, save

    def panel(window_us: int, column: str) -> "Callable[[Axes], None]":
        def draw_panel(axes: "Axes") -> None:
            sample = samples(window_us, column)
            for index, (colour, values) in enumerate(((INET, sample.inet), (OURS, sample.ours))):
                # Side by side in the order of the seeds; a bar for mean and standard error.
                places = [index + 0.6 * (k + 0.5) / len(values) - 0.3 for k in range(len(values))]
                axes.plot(places, values, "o", color=colour, ms=3, mfc="none", alpha=0.7)
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
            axes.set(xticks=[0, 1], xticklabels=["INET 4.5", "gradysim"], xlim=(-0.6, 1.6), ylabel="frames")
            axes.set_title(f"{window_us // 1000} ms: {column.replace('_', ' ')}", fontsize=9)

        return draw_panel

    save(
        path,
        "Frames of all nodes in 60 s, one dot for each seed; bars: mean, 99 % interval",
        *(panel(*key) for key in MEASURED),
        columns=2,
        height=2.9,
    )
