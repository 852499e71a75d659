"""Reception over distance: against the closed form at every rate, and against INET's runs.

50,000 frames per point: a ratio of one half has a standard error of 0.0022. A correct engine exceeds 0.01
with a probability of 8e-6 at the worst point, below 0.1 % over all points. INET's ratios come from 1998
frames.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from math import sqrt
from pathlib import Path
from typing import TYPE_CHECKING

from verification.finding import Finding
from verification.nist import (
    DSSS_RATES_MBPS,
    OFDM_RATES_MBPS,
    received_power_w,
    success_probability,
)
from verification.reference_data import rows
from verification.reference_run import run_reference, tracked
from verification.sampling import fisher_p, least_p

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FRAMES = 50_000
INTERVAL_S = 0.002
MPDU_BYTES = 100
NOISE_W = 1e-14
TX_POWER_W = 0.02
SHARES = (0.97, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1, 0.03, 0.003)
CASES = ("Def24", "Def6", "Snr24", "Snr6", "Snr6NoThr", "SnrB1")


@dataclass(frozen=True)
class Point:
    distance_m: float
    expected: float
    received: int

    @property
    def share(self) -> float:
        return self.received / FRAMES


def measure(config: str, distances_m: list[float], seed: int, overrides: list[str]) -> list[int]:
    """Return the frames received at each distance."""
    end_s = 1 + FRAMES * INTERVAL_S
    result = run_reference(
        "link",
        config,
        seed=seed,
        overrides=[
            *overrides,
            f"*.receivers.count = {len(distances_m)}",
            *(
                f"*.receivers[{index}].mobility.initialX = {distance_m}m"
                for index, distance_m in enumerate(distances_m)
            ),
            f"*.sender.protocol.interval = {INTERVAL_S}s",
            f"*.sender.protocol.stop = {end_s - INTERVAL_S / 2}s",
            f"sim-time-limit = {end_s}s",
        ],
    )
    assert tracked(result, "sent") == [FRAMES]
    return tracked(result, "received", "receivers")


def closed_form(
    rate_mbps: float,
    tx_power_w: float,
    distance_m: float,
    threshold_db: float = -20.0,
    sensitivity_dbm: float = -120.0,
) -> float:
    power_w = received_power_w(tx_power_w, distance_m)
    snir = power_w / NOISE_W
    if power_w < 10 ** (sensitivity_dbm / 10) * 1e-3 or snir <= 10 ** (threshold_db / 10):
        return 0.0
    return success_probability(rate_mbps, snir, MPDU_BYTES)


def distance_of(share: float, rate_mbps: float) -> float:
    """Return the distance with that ratio of receptions, in meters to the millimeter."""
    near, far = 1.0, 1e6
    for _ in range(100):
        middle = sqrt(near * far)
        if closed_form(rate_mbps, TX_POWER_W, middle) > share:
            near = middle
        else:
            far = middle
    return round(near, 3)


@cache
def curve(rate_mbps: float) -> list[Point]:
    """Return points around one half of receptions, with 20 mW, without sensitivity and threshold."""
    distances_m = [distance_of(share, rate_mbps) for share in SHARES]
    received = measure(
        "Far",
        distances_m,
        seed=int(10 * rate_mbps),
        overrides=[
            f'**.wlan[*].opMode = "{"b" if rate_mbps in DSSS_RATES_MBPS else "g(erp)"}"',
            f"**.wlan[*].bitrate = {rate_mbps}Mbps",
        ],
    )
    return [
        Point(distance_m, closed_form(rate_mbps, TX_POWER_W, distance_m), count)
        for distance_m, count in zip(distances_m, received, strict=True)
    ]


@cache
def case_curve(case: str) -> list[Point]:
    """Return the points of the configuration of that name, at the distances of INET's runs."""
    runs = rows("inet_link", case=case)
    distances_m = [float(row["distance_m"]) for row in runs]
    received = measure(case, distances_m, seed=1000 + CASES.index(case), overrides=[])
    return [
        Point(
            distance_m,
            closed_form(
                float(row["bitrate_mbps"]),
                float(row["tx_power_w"]),
                distance_m,
                float(row["snir_threshold_db"]),
                float(row["sensitivity_dbm"]),
            ),
            count,
        )
        for row, distance_m, count in zip(runs, distances_m, received, strict=True)
    ]


def test_every_rate_follows_the_closed_form(
    report: Callable[[Finding], None], picture: Callable[[str, Callable[[Path], None]], None]
) -> None:
    curves = {rate: curve(rate) for rate in (*DSSS_RATES_MBPS, *OFDM_RATES_MBPS)}
    picture("reception_by_rate.png", lambda path: draw_rates(path, curves))
    points = [point for points in curves.values() for point in points]
    worst = max(abs(point.share - point.expected) for point in points)
    report(
        Finding(
            "reception over distance, 12 rates, against the closed form (NIST model, free space)",
            f"share received differs by at most {worst:.4f} at {len(points)} points",
            "0.01 at every point",
            "4.5 standard errors of a share of one half of 50,000 frames: false alarms below 0.1 %",
            worst <= 0.01,
        )
    )


def test_the_cases_of_inet_follow_the_closed_form(report: Callable[[Finding], None]) -> None:
    points = [point for case in CASES for point in case_curve(case)]
    worst = max(abs(point.share - point.expected) for point in points)
    report(
        Finding(
            "the same with INET's sensitivity and SNIR thresholds, against the closed form",
            f"share received differs by at most {worst:.4f} at {len(points)} points",
            "0.01 at every point",
            "as above",
            worst <= 0.01,
        )
    )


def test_the_cases_of_inet_agree_with_its_runs(
    report: Callable[[Finding], None], picture: Callable[[str, Callable[[Path], None]], None]
) -> None:
    picture("reception_inet.png", draw_cases)
    p_values = [
        fisher_p(point.received, FRAMES, int(row["received"]), int(row["sent"]))
        for case in CASES
        for point, row in zip(case_curve(case), rows("inet_link", case=case), strict=True)
    ]
    limit = least_p(len(p_values))
    report(
        Finding(
            "reception over distance, 6 cases, against INET's runs of 1998 frames",
            f"least p-value {min(p_values):.2g} of {len(p_values)} points",
            f"p ≥ {limit:.2g} at every point",
            "sampling error at 99 % for all points together (Fisher's exact test, Bonferroni): "
            "false alarms at most 1 %",
            min(p_values) >= limit,
        )
    )


def draw_rates(path: Path, curves: dict[float, list[Point]]) -> None:
    from matplotlib import colormaps

    from verification.figure import save

    def draw(rates: tuple[float, ...], title: str) -> "Callable[[Axes], None]":
        def panel(axes: "Axes") -> None:
            for index, rate in enumerate(rates):
                color = colormaps["viridis"](0.9 * index / (len(rates) - 1))
                points = curves[rate]
                near, far = points[0].distance_m * 0.93, points[-1].distance_m * 1.05
                distances_m = [near + (far - near) * step / 200 for step in range(201)]
                shares = [closed_form(rate, TX_POWER_W, distance_m) for distance_m in distances_m]
                axes.plot([d / 1000 for d in distances_m], shares, color=color, lw=1, label=f"{rate:g} Mbps")
                axes.plot(
                    [point.distance_m / 1000 for point in points],
                    [point.share for point in points],
                    "o",
                    color=color,
                    ms=3.5,
                )
            axes.set(title=title, xlabel="distance (km)", ylabel="share of frames received")
            axes.set_title(title, fontsize=9)
            axes.set_xlim(
                right=1.25 * max(point.distance_m for rate in rates for point in curves[rate]) / 1000
            )
            axes.legend(fontsize=7.5, loc="upper right")

        return panel

    save(
        path,
        "Reception over distance: gradysim (dots, 50,000 frames each) and closed form (lines)\n"
        "20 mW, noise -110 dBm, 100 B frames, sensitivity and SNIR threshold out of the way",
        draw(OFDM_RATES_MBPS, "802.11g (OFDM)"),
        draw(DSSS_RATES_MBPS, "802.11b (DSSS, CCK)"),
        height=4.0,
    )


def draw_cases(path: Path) -> None:
    from verification.figure import INET, MODEL, OURS, save

    titles = {
        "Snr24": "24 Mbps",
        "Snr6": "6 Mbps, SNIR threshold 4 dB",
        "Snr6NoThr": "6 Mbps, no threshold",
        "SnrB1": "1 Mbps (DSSS), SNIR threshold 4 dB",
    }

    def draw(case: str) -> "Callable[[Axes], None]":
        def panel(axes: "Axes") -> None:
            runs = rows("inet_link", case=case)
            first = runs[0]
            distances_m = [33 + step * 0.05 for step in range(601)]
            parameters = [
                float(first[column]) for column in ("bitrate_mbps", "tx_power_w", "snir_threshold_db")
            ]
            axes.plot(
                distances_m,
                [closed_form(parameters[0], parameters[1], d, parameters[2]) for d in distances_m],
                color=MODEL,
                lw=1,
                label="closed form",
            )
            for label, color, marker, size, shares in (
                ("INET 4.5", INET, "o", 7.0, [int(row["received"]) / int(row["sent"]) for row in runs]),
                ("gradysim", OURS, "x", 5.0, [point.share for point in case_curve(case)]),
            ):
                axes.plot(
                    [float(row["distance_m"]) for row in runs],
                    shares,
                    marker,
                    color=color,
                    ms=size,
                    mfc="none",
                    label=label,
                )
            axes.set(xlim=(33, 63), xlabel="distance (m)", ylabel="share of frames received")
            axes.set_title(titles[case], fontsize=9)
            axes.legend(fontsize=7.5)

        return panel

    save(
        path,
        "Reception over distance, 100 B frames: gradysim and INET",
        *map(draw, titles),
        columns=2,
        height=2.9,
    )
