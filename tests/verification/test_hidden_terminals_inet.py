"""Two stations, hidden from each other or not, saturate a sink with and without RTS/CTS: against INET."""

from collections.abc import Callable
from functools import cache
from pathlib import Path
from statistics import fmean
from typing import TYPE_CHECKING

import pytest

from verification.finding import Finding
from verification.reference_data import rows
from verification.reference_run import run_reference, tracked
from verification.sampling import least_p, weakest, welch_p

if TYPE_CHECKING:
    from matplotlib.axes import Axes

pytestmark = pytest.mark.verify

SEEDS = range(6)
BY_DEFAULT = "**.inetStationRetryCounters = false"
HIDDEN = ("Hidden24", "Hidden24RtsCts", "Hidden6", "Hidden6RtsCts")
CONFIGS = (*HIDDEN, "Pair24", "Pair24RtsCts", "Pair6", "Pair6RtsCts", "Alone24RtsCts", "Alone6RtsCts")
"""One station without RTS/CTS is part of the comparison of saturation throughput."""
MEASURED = ("received", "frames")
Counts = dict[str, int]


@cache
def counts(config: str, seed: int, *overrides: str) -> Counts:
    """Return received messages, frames of the stations, RTS among them, and dropped messages."""
    result = run_reference("hidden_inet", config, seed=seed, overrides=overrides)
    frames = result.outcomes["frames"]
    return {
        "received": sum(tracked(result, "received")),
        "frames": sum(frames["unicast"].values()) + sum(frames["rts"].values()),
        "given_up": result.outcomes["messages"]["unicast"]["retry_limit"],
    }


def ours(config: str, column: str, *overrides: str) -> list[int]:
    return [counts(config, seed, *overrides)[column] for seed in SEEDS]


def by_default(config: str, column: str) -> list[int]:
    return ours(config, column, BY_DEFAULT)


def inet(config: str, column: str) -> list[int]:
    return [int(row[column]) for row in rows("inet_hidden", config=config)]


def off(counts_of: Callable[[str, str], list[int]], config: str, column: str) -> float:
    """Return the difference of our mean from INET's, relative to it."""
    return fmean(counts_of(config, column)) / fmean(inet(config, column)) - 1


def test_counts_agree_with_inet(
    report: Callable[[Finding], None], picture: Callable[[str, Callable[[Path], None]], None]
) -> None:
    picture("hidden_terminals_inet.png", draw)
    compared = [(config, column) for config in CONFIGS for column in MEASURED]
    compared += [(config, "given_up") for config in HIDDEN]
    p_values = {key: welch_p(ours(*key), inet(*key)) for key in compared}
    (config, column), p = weakest(p_values)
    worst = max(CONFIGS, key=lambda config: abs(off(ours, config, "received")))
    limit = least_p(len(p_values))
    differing = ", ".join(f"{off(by_default, config, 'received'):+.1%} ({config})" for config in HIDDEN)
    report(
        Finding(
            "two hidden stations, two that hear each other and one alone at 6 and 24 Mbps, with and without "
            "RTS/CTS, with INET's contention window: messages received, frames, messages given up, against "
            "INET",
            f"messages received differ by at most {off(ours, worst, 'received'):+.2%} ({worst}); least "
            f"p-value {p:.2g} of {len(p_values)} ({config}, {column.replace('_', ' ')}); by default "
            f"{differing}",
            f"p ≥ {limit:.2g} for each",
            "sampling error at 99 % for all together (Welch's t test, Bonferroni)",
            p >= limit,
        )
    )


def draw(path: Path) -> None:
    from verification.figure import INET, MODEL, OURS, save

    payload_bits = 8000

    def panel(rate: int) -> "Callable[[Axes], None]":
        def draw_panel(axes: "Axes") -> None:
            configs = [f"{place}{rate}{rts}" for place in ("Pair", "Hidden") for rts in ("", "RtsCts")]
            simulated_s = {
                config: float(rows("inet_hidden", config=config)[0]["simulated_s"]) for config in configs
            }

            def mbps(config: str, received: list[int]) -> float:
                return fmean(received) * payload_bits / simulated_s[config] / 1e6

            bars = {
                "INET 4.5": (INET, inet),
                "gradysim, INET's window": (OURS, ours),
                "gradysim": (MODEL, by_default),
            }
            for index, (label, (color, counts_of)) in enumerate(bars.items()):
                places = [place + 0.27 * (index - 1) for place in range(len(configs))]
                heights = [mbps(config, counts_of(config, "received")) for config in configs]
                axes.bar(places, heights, 0.25, color=color, label=label)
            names = [f"{place}{rts}" for place in ("in hearing", "hidden") for rts in ("", "\nRTS/CTS")]
            axes.set_xticks(range(len(configs)), names)
            axes.set_ylabel("throughput (Mbps of payload)")
            axes.set_title(f"{rate} Mbps", fontsize=9)
            axes.set_ylim(top=axes.get_ylim()[1] * 1.25)
            axes.legend(fontsize=7.5, loc="upper right")

        return draw_panel

    save(path, "Two stations and a sink, 1000 B payloads", panel(24), panel(6))
