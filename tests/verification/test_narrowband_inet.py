"""IEEE 802.15.4 against INET's runs: reception over distance, and contention around a sink.

INET never drops a message that was not on the air yet, however often the channel is busy. The standard drops
it, and so does gradysim. A saturated station that retries behaves like one that starts with its next message.
So all else is compared directly. Access failures are compared with runs of INET with the standard's rule.

In INET a frame that arrives at the instant in which an assessment ends does not make the channel busy; here
it does. This matters in rings of stations that answer each other, not around a sink. Rings are compared with
runs of INET in which the assessment ended last.
"""

from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from statistics import fmean
from typing import TYPE_CHECKING

import pytest

from verification.finding import Finding
from verification.narrowband_circle import circle
from verification.reference_data import Row, rows
from verification.reference_run import run_reference, tracked
from verification.sampling import fisher_p, least_p, weakest, welch_p

if TYPE_CHECKING:
    from matplotlib.axes import Axes

pytestmark = pytest.mark.verify

CASES = {"General": "noise", "Threshold": "SNIR threshold", "LessNoise": "sensitivity"}
"""Limit of reception in each case."""
FRAMES = 20_000
INTERVAL_S = 0.01

STATIONS = (1, 2, 5, 10, 20)
SEEDS = range(8)
CONFIGS = {"lost": "Inet", "decoded": "InetDecoding"}
COUNTED_S = 21

RING = (5, 10)
RING_SEEDS = range(20)

RECEIVED, DUPLICATES, FRAMES_SENT = "received", "duplicates", "frames"
NO_ACCESS, NO_ACK, ACKNOWLEDGED = "access_failures", "no_acks", "acknowledged"
TOLERANCE = 0.03
REASON = (
    "99 % for all together (Welch's t test, Bonferroni); the standard error of INET's messages received is "
    "at most 0.7 %; a wrong interframe space would change up to 16 % of them"
)
Counts = dict[str, int]


@cache
def received(case: str) -> tuple[int, ...]:
    """Return the frames out of FRAMES that arrive at each distance of INET's runs."""
    distances_m = [row["distance_m"] for row in rows("inet_narrowband_link", case=case)]
    end_s = 1 + FRAMES * INTERVAL_S
    overrides = [
        f"*.receivers.count = {len(distances_m)}",
        *(f"*.receivers[{i}].mobility.initialX = {distance}m" for i, distance in enumerate(distances_m)),
        f"*.sender.protocol.interval = {INTERVAL_S}s",
        f"*.sender.protocol.stop = {end_s - INTERVAL_S / 2}s",
        f"sim-time-limit = {end_s + 0.5}s",
    ]
    result = run_reference("narrowband_link", case, seed=list(CASES).index(case), overrides=overrides)
    assert tracked(result, "sent") == [FRAMES]
    return tuple(tracked(result, "received", "receivers"))


def test_reception_over_distance_agrees_with_inet(report: Callable[[Finding], None]) -> None:
    p_values = {
        (case, row["distance_m"]): fisher_p(count, FRAMES, int(row["received"]), int(row["sent"]))
        for case in CASES
        for count, row in zip(received(case), rows("inet_narrowband_link", case=case), strict=True)
    }
    (case, distance_m), least = weakest(p_values)
    limit = least_p(len(p_values))
    report(
        Finding(
            "802.15.4: reception over distance, where noise, the SNIR threshold or the sensitivity decides, "
            "against INET's runs of 2000 frames",
            f"least p-value {least:.2g} of {len(p_values)} points ({CASES[case]}, {distance_m} m)",
            f"p ≥ {limit:.2g} at every point",
            "sampling error at 99 % for all points together (Fisher's exact test, Bonferroni); threshold and "
            "sensitivity, 0.2 m between all and nothing, leave no room",
            least >= limit,
        )
    )


@cache
def ours(overlap: str, acks: bool, stations: int) -> tuple[Counts, ...]:
    """Return our counts for each seed, from the start on."""

    def count(seed: int) -> Counts:
        overrides = ["*.sink.protocol.count_from = 0s", *circle(stations, acks)]
        result = run_reference("narrowband_contention", CONFIGS[overlap], seed=seed, overrides=overrides)
        frames, messages = result.outcomes["frames"]["unicast"], result.outcomes["messages"]["unicast"]
        (arrived,) = tracked(result, "received", "sink")
        return {
            RECEIVED: arrived,
            DUPLICATES: frames["delivered"] - arrived,
            FRAMES_SENT: sum(frames.values()),
            NO_ACCESS: messages["channel_access_failure"],
            NO_ACK: messages["retry_limit"],
        }

    return tuple(map(count, SEEDS))


@cache
def inet(overlap: str, acks: bool, stations: int) -> tuple[Row, ...]:
    return tuple(rows("inet_narrowband_contention", overlap=overlap, acks=int(acks), n=stations))


def counts(runs: tuple[Row, ...], quantity: str) -> list[int]:
    """Return the counts of the runs that have the quantity."""
    return [int(row[quantity]) for row in runs if row[quantity]]


def quantities(overlap: str, acks: bool) -> Iterator[tuple[int, str, list[int], list[int]]]:
    """Yield stations, quantity, our counts and INET's, for quantities that vary between runs."""
    for n in STATIONS:
        for quantity in (RECEIVED, FRAMES_SENT, DUPLICATES, NO_ACK, NO_ACCESS):
            mine = [run[quantity] for run in ours(overlap, acks, n)]
            theirs = counts(inet(overlap, acks, n), quantity)
            if theirs and (len(set(mine)) > 1 or mine[0] != theirs[0] or len(set(theirs)) > 1):
                yield n, quantity, mine, theirs


@pytest.mark.parametrize("acks", [False, True])
@pytest.mark.parametrize("overlap", CONFIGS)
def test_contention_agrees_with_inet(overlap: str, acks: bool, report: Callable[[Finding], None]) -> None:
    compared = list(quantities(overlap, acks))
    p_values = {(n, quantity): welch_p(mine, theirs) for n, quantity, mine, theirs in compared}
    off = {
        n: fmean(mine) / fmean(theirs) - 1 for n, quantity, mine, theirs in compared if quantity == RECEIVED
    }
    worst = max(off, key=lambda n: abs(off[n]))
    (n, quantity), least = weakest(p_values)
    what = "whatever overlaps is lost" if overlap == "lost" else "bit errors decide what overlaps"
    report(
        Finding(
            f"802.15.4: contention of 1 to 20 stations {'with' if acks else 'without'} ACKs, {what}, "
            "against INET",
            f"messages received differ by at most {off[worst]:+.2%} ({worst} stations); least p-value "
            f"{least:.2g} of {len(p_values)} ({quantity.replace('_', ' ')}, {n} stations)",
            "messages received: 3 %; they, frames, duplicates, missing ACKs, access failures: sampling error",
            REASON,
            abs(off[worst]) <= TOLERANCE and least >= least_p(len(p_values)),
        )
    )


@cache
def in_a_ring(stations: int) -> tuple[Counts, ...]:
    """Return for each seed: frames, acknowledged messages, and messages dropped without an ACK."""

    def count(seed: int) -> Counts:
        to_the_next = [
            f"*.stations[{index}].protocol.destination = {(index + 1) % stations + 1}"
            for index in range(stations)
        ]
        result = run_reference(
            "narrowband_contention",
            "Ring",
            seed=seed,
            overrides=[*to_the_next, *circle(stations, acks=True)],
        )
        messages = result.outcomes["messages"]["unicast"]
        return {
            FRAMES_SENT: sum(result.outcomes["frames"]["unicast"].values()),
            ACKNOWLEDGED: messages["acknowledged"],
            NO_ACK: messages["retry_limit"],
        }

    return tuple(map(count, RING_SEEDS))


def test_stations_that_also_answer_agree_with_inet(report: Callable[[Finding], None]) -> None:
    p_values, off = {}, {}
    for n in RING:
        table = tuple(rows("inet_narrowband_ring", n=n, assessment="late"))
        for quantity in (FRAMES_SENT, ACKNOWLEDGED, NO_ACK):
            mine, theirs = [run[quantity] for run in in_a_ring(n)], counts(table, quantity)
            p_values[n, quantity] = welch_p(mine, theirs)
            off[n, quantity] = fmean(mine) / fmean(theirs) - 1
    (n, quantity), least = weakest(p_values)
    limit = least_p(len(p_values))
    report(
        Finding(
            "802.15.4: rings of 5 and 10 stations, each of which sends to the next, against INET with "
            "assessments that end last of their instant",
            "; ".join(f"{n} stations, {what.replace('_', ' ')}: {off[n, what]:+.2%}" for n, what in off)
            + f"; least p-value {least:.2g}",
            f"p ≥ {limit:.2g} for each of the {len(p_values)}",
            "sampling error at 99 % for all together (Welch's t test, Bonferroni)",
            least >= limit,
        )
    )


def test_picture(picture: Callable[[str, Callable[[Path], None]], None]) -> None:
    picture("narrowband_inet.png", draw)


def draw(path: Path) -> None:
    from verification.figure import INET, OURS, save

    def distances(axes: "Axes") -> None:
        for case, style in zip(CASES, ("-", "--", ":"), strict=True):
            table = rows("inet_narrowband_link", case=case)
            distances_m = [float(row["distance_m"]) for row in table]
            axes.plot(
                distances_m,
                [count / FRAMES for count in received(case)],
                style,
                color=OURS,
                lw=1,
                label=CASES[case],
            )
            axes.plot(
                distances_m,
                [int(row["received"]) / int(row["sent"]) for row in table],
                "o",
                color=INET,
                mfc="none",
            )
        axes.set(xlabel="distance in m", ylabel="share of frames received", title="one sender")
        axes.legend(fontsize=7)

    def contention(overlap: str) -> "Callable[[Axes], None]":
        def panel(axes: "Axes") -> None:
            for acks, quantity, style, label in (
                (False, RECEIVED, "-", "received, without ACKs"),
                (True, RECEIVED, "--", "received, with ACKs"),
                (True, DUPLICATES, "-.", "duplicates"),
                (True, NO_ACK, ":", "given up without ACK"),
            ):
                mine = [fmean(run[quantity] for run in ours(overlap, acks, n)) / COUNTED_S for n in STATIONS]
                theirs = [fmean(counts(inet(overlap, acks, n), quantity)) / COUNTED_S for n in STATIONS]
                axes.plot(STATIONS, mine, style, color=OURS, lw=1, label=label)
                axes.plot(STATIONS, theirs, "o", color=INET, mfc="none")
            axes.set(
                xlabel="stations", ylabel="per second", title=f"what overlaps: {overlap}", ylim=(0, None)
            )
            axes.legend(fontsize=7, loc=(0.02, 0.16))

        return panel

    save(
        path,
        "IEEE 802.15.4: gradysim (lines) and INET (circles)",
        distances,
        *map(contention, CONFIGS),
    )
