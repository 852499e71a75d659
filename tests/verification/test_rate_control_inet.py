"""Frames at each rate with ARF and AARF over distance, against INET, if both follow the same rules."""

from collections.abc import Callable, Iterator
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

SEEDS = range(5)
ALIKE = ("ArfOnce", "AarfOnce", "ArfTimer")
BY_DEFAULT = ("Arf", "Aarf")
RATES_MBPS = (6, 9, 12, 18, 24, 36, 48, 54)
COLUMNS = ("received", *(f"frames_{mbps}" for mbps in RATES_MBPS))
PAYLOAD_BITS, BY_DEFAULT_S = 8000, 10.0
LEAST_SHARE = 0.01
"""Rates with a lower ratio of frames, during the increase from 6 Mbps, are not compared."""


@cache
def counts(config: str, distance_m: int, seed: int) -> dict[str, int]:
    """Return received messages, and frames at each rate."""
    place = f"*.stations[*].mobility.initialX = {distance_m}m"
    result = run_reference("rate_control_inet", config, seed=seed, overrides=[place])
    (received,) = tracked(result, "received")
    frames = result.nodes[1].frames_by_bitrate
    return dict(zip(COLUMNS, (received, *(frames.get(mbps * 10**6, 0) for mbps in RATES_MBPS)), strict=True))


def ours(config: str, distance_m: int, column: str) -> list[int]:
    return [counts(config, distance_m, seed)[column] for seed in SEEDS]


def inet(config: str, distance_m: int, column: str) -> list[int]:
    return [int(row[column]) for row in rows("inet_rate_control", case=config, distance_m=distance_m)]


def distances_m(config: str) -> list[int]:
    return sorted({int(row["distance_m"]) for row in rows("inet_rate_control", case=config)})


def share(config: str, distance_m: int, column: str) -> float:
    """Return the ratio of INET's frames at the rate of the column."""
    frames = {rate: fmean(inet(config, distance_m, rate)) for rate in COLUMNS[1:]}
    return frames[column] / sum(frames.values())


def compared() -> Iterator[tuple[str, int, str]]:
    for config in ALIKE:
        for distance in distances_m(config):
            yield config, distance, "received"
            yield from (
                (config, distance, rate)
                for rate in COLUMNS[1:]
                if share(config, distance, rate) >= LEAST_SHARE
            )


def off(config: str, distance_m: int) -> float:
    """Return the difference of our received messages from INET's, relative to INET's."""
    theirs = inet(config, distance_m, "received")
    return fmean(ours(config, distance_m, "received")) / fmean(theirs) - 1


def name(config: str, distance_m: int) -> str:
    return f"{config}, {distance_m} m"


def test_frames_at_each_rate_agree_with_inets(
    report: Callable[[Finding], None], picture: Callable[[str, Callable[[Path], None]], None]
) -> None:
    picture("rate_control_inet.png", draw)
    found = {place: welch_p(ours(*place), inet(*place)) for place in compared()}
    (config, distance, column), p = weakest(found)
    received = {
        (config, distance): off(config, distance) for config in ALIKE for distance in distances_m(config)
    }
    worst, by = max(received.items(), key=lambda item: abs(item[1]))
    by_default = {
        (config, distance): off(config, distance) for config in BY_DEFAULT for distance in distances_m(config)
    }
    least, most = min(by_default, key=by_default.__getitem__), max(by_default, key=by_default.__getitem__)
    limit = least_p(len(found))
    report(
        Finding(
            "ARF and AARF without repetitions, falling after one failure, rising after successes or by time "
            f"alone, at {len(received)} distances: messages received, frames at each rate, against INET",
            f"messages received differ by at most {by:+.2%} ({name(*worst)}); least p-value {p:.2g} of "
            f"{len(found)} ({name(config, distance)}, {column.replace('_', ' at ')}); with the defaults, "
            f"which mean other rules in INET, {by_default[least]:+.1%} ({name(*least)}) to "
            f"{by_default[most]:+.1%} ({name(*most)})",
            f"p ≥ {limit:.2g} for each",
            "sampling error at 99 % for all together (Welch's t test, Bonferroni; at least 4 runs of INET "
            f"against {len(SEEDS)}); one success more or less in the row before a faster rate changes the "
            "frames at it by 5 % to 23 %, two failures before a slower one by 31 % to 124 %",
            p >= limit,
        )
    )


def draw(path: Path) -> None:
    from verification.figure import INET, OURS, save

    def shares(config: str) -> "Callable[[Axes], None]":
        def draw_panel(axes: "Axes") -> None:
            distances = distances_m(config)
            places = [place[1:] for place in compared() if place[0] == config and place[2] != "received"]
            at = [distances.index(distance) for distance, _ in places]
            theirs = [share(config, *place) for place in places]
            all_ours = [
                sum(fmean(ours(config, distance, rate)) for rate in COLUMNS[1:]) for distance, _ in places
            ]
            shares_of_ours = [
                fmean(ours(config, *place)) / frames for place, frames in zip(places, all_ours, strict=True)
            ]
            axes.plot(at, theirs, "o", color=INET, ms=8, mfc="none", label="INET 4.5")
            axes.plot(at, shares_of_ours, "x", color=OURS, ms=5, label="gradysim")
            for (_, rate), x, y in zip(places, at, theirs, strict=True):
                axes.annotate(
                    rate.removeprefix("frames_"), (x, y), (7, -3), textcoords="offset points", fontsize=7.5
                )
            axes.set_xticks(range(len(distances)), [f"{distance} m" for distance in distances])
            axes.set_xlim(-0.4, len(distances) - 0.4)
            axes.set_ylabel("share of the frames, by rate in Mbps")
            axes.set_title(config, fontsize=9)
            axes.set_ylim(top=axes.get_ylim()[1] * 1.12)
            axes.legend(fontsize=7.5, loc="upper right", ncols=2)

        return draw_panel

    def by_default(axes: "Axes") -> None:
        for config, line in zip(BY_DEFAULT, ("-", "--"), strict=True):
            distances = distances_m(config)
            for label, color, counts_of in (("INET 4.5", INET, inet), ("gradysim", OURS, ours)):
                mbps = [
                    fmean(counts_of(config, distance, "received")) * PAYLOAD_BITS / BY_DEFAULT_S / 1e6
                    for distance in distances
                ]
                axes.plot(
                    range(len(distances)), mbps, f"{line}o", color=color, ms=4, label=f"{label}, {config}"
                )
            axes.set_xticks(range(len(distances)), [f"{distance} m" for distance in distances])
        axes.set_ylabel("throughput (Mbps of payload)")
        axes.set_title("with the defaults, which mean other rules in INET", fontsize=9)
        axes.legend(fontsize=7.5)

    save(
        path,
        "One station with ARF or AARF, 802.11g, 1000 B payloads",
        *map(shares, ALIKE),
        by_default,
        columns=2,
        width=5,
    )
