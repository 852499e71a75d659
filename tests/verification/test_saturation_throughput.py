"""Saturation throughput: against INET, against ns-3 with the same timing, and Bianchi's model."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from statistics import fmean
from typing import TYPE_CHECKING

import pytest

from verification.bianchi import Timing, throughput_bps
from verification.finding import Finding
from verification.reference_data import rows
from verification.reference_run import run_reference, tracked

if TYPE_CHECKING:
    from matplotlib.axes import Axes

pytestmark = pytest.mark.verify

MEASURED_S = 4.0
PAYLOAD_BITS = 8000
SEEDS = range(5)
TOLERANCE = 0.03

LARGE = (15, 20, 30)
"""Numbers of stations with many collisions."""

# Of a data frame of 1064 B and an ACK at 24 Mbps (6 Mbps in A6, 11 Mbps in b). A collision ends with EIFS for
# stations that receive it (INET), or with DIFS for all: nearly so in ns-3, where an undetected preamble does
# not start EIFS.
_OFDM_EIFS_MINUS_DIFS_S = 60e-6  # SIFS 16 µs (g: 10 µs and 6 µs of signal extension), ACK at 6 Mbps 44 µs
TIMINGS = {
    "G54": Timing(9e-6, (180 + 16 + 28 + 34) * 1e-6, (180 + 34) * 1e-6, 15, 6),
    "G24": Timing(9e-6, (376 + 16 + 28 + 34) * 1e-6, (376 + 34) * 1e-6, 15, 6),
    "A6": Timing(9e-6, (1444 + 16 + 44 + 34) * 1e-6, (1444 + 34) * 1e-6, 15, 6),
    "B11": Timing(20e-6, (966 + 10 + 203 + 50) * 1e-6, (966 + 50) * 1e-6, 31, 5),
}
MODELLED = {6: "A6", 54: "G54"}  # the times of 802.11a, by rate in Mbps; at 54 Mbps they are those of g(erp)
EIFS_MINUS_DIFS_S = dict.fromkeys(TIMINGS, _OFDM_EIFS_MINUS_DIFS_S) | {"B11": 314e-6}


def with_eifs(config: str) -> Timing:
    """Return the times of a configuration; after a collision by INET's rules."""
    timing = TIMINGS[config]
    return replace(timing, collision_s=timing.collision_s + EIFS_MINUS_DIFS_S[config])


def config_of(row: dict[str, str]) -> str:
    return f"{row['op_mode'][0].upper()}{row['bitrate_mbps']}"


@cache
def throughput_mbps(config: str, stations: int, seed: int) -> float:
    """Return the received payload from 1 s to 5 s. The stations are on a circle of 10 m around the sink."""
    result = run_reference("saturation", f"{config}Circle{stations}", seed=seed)
    return sum(tracked(result, "received_bytes")) * 8 / MEASURED_S / 1e6


def mean_mbps(config: str, stations: int) -> float:
    return fmean(throughput_mbps(config, stations, seed) for seed in SEEDS)


def inet_mbps() -> dict[tuple[str, int], float]:
    """Return INET's mean over its seeds, weighted by their times."""
    runs: dict[tuple[str, int], list[tuple[float, float]]] = {}
    for row in rows("inet_saturation"):
        key = config_of(row), int(row["stations"])
        runs.setdefault(key, []).append((float(row["goodput_mbps"]), float(row["measured_s"])))
    return {
        key: sum(mbps * seconds for mbps, seconds in values) / sum(seconds for _, seconds in values)
        for key, values in runs.items()
    }


def ns3_mbps(rate_mbps: int) -> dict[int, float]:
    """Return ns-3's throughput in 802.11a, by number of stations.

    Its times at 54 Mbps are those of g(erp).
    """
    return {
        int(row["n"]): float(row["ns3_mbps_mean"])
        for row in rows("ns3_saturation", std="a", rate_mbps=rate_mbps)
    }


def test_throughput_agrees_with_inet(report: Callable[[Finding], None]) -> None:
    off = {key: mean_mbps(*key) / mbps - 1 for key, mbps in inet_mbps().items()}
    (config, stations), worst = max(off.items(), key=lambda item: abs(item[1]))
    report(
        Finding(
            "saturation throughput, 1 to 30 stations at 6, 11, 24 and 54 Mbps, against INET",
            f"differs by at most {worst:+.2%} ({config}, {stations} stations), "
            f"{fmean(off.values()):+.2%} on average of {len(off)}",
            "3 %",
            "the standard error of a run of 4 s is up to 1.2 %, and INET's figures come from 1 to 13 such "
            "runs; with ns-3's rules 30 stations at 54 Mbps have 9 % more",
            abs(worst) <= TOLERANCE,
        )
    )


def test_throughput_lies_between_inet_and_ns3(report: Callable[[Finding], None]) -> None:
    inet = inet_mbps()
    outside, apart = {}, {}
    for rate in (6, 54):
        for stations, ns3 in ns3_mbps(rate).items():
            ours, low, high = mean_mbps(f"A{rate}", stations), *sorted((ns3, inet[f"A{rate}", stations]))
            apart[rate, stations] = high / low - 1
            if high / low - 1 <= TOLERANCE:
                low, high = high / (1 + TOLERANCE), low * (1 + TOLERANCE)
            outside[rate, stations] = max(low / ours - 1, ours / high - 1, 0.0)
    (rate, stations), worst = max(outside.items(), key=lambda item: item[1])
    report(
        Finding(
            "saturation throughput of 802.11a at 6 and 54 Mbps, 1 to 30 stations, against INET and ns-3",
            f"outside of their interval by at most {worst:.2%} ({rate} Mbps, {stations} stations); they "
            f"differ by up to {max(apart.values()):.1%}",
            "1 %",
            "the interval: within 3 % of both where they agree, from one to the other where they differ; "
            "1 % is two standard errors of a run of 4 s",
            worst <= 0.01,
        )
    )


def test_throughput_of_many_stations_agrees_with_the_model(report: Callable[[Finding], None]) -> None:
    ours = {
        (rate, stations): throughput_mbps(f"A{rate}", stations, 0) for rate in (6, 54) for stations in LARGE
    }
    off = {
        (rate, stations): mbps * 1e6 / throughput_bps(stations, PAYLOAD_BITS, with_eifs(MODELLED[rate])) - 1
        for (rate, stations), mbps in ours.items()
    }
    (rate, stations), worst = max(off.items(), key=lambda item: abs(item[1]))
    report(
        Finding(
            "saturation throughput of 802.11a at 6 and 54 Mbps, 15 to 30 stations, against Bianchi's model "
            "with EIFS",
            f"differs by at most {worst:+.2%} ({rate} Mbps, {stations} stations)",
            "3 %",
            "the standard error of a run of 4 s is up to 0.7 %; one retry less costs 30 stations 0.8 %, and "
            "those of the model never end",
            abs(worst) <= TOLERANCE,
        )
    )


def test_under_its_rules_throughput_agrees_closely_with_ns3(report: Callable[[Finding], None]) -> None:
    off = {
        (rate, stations): mean_mbps(f"A{rate}Ns3", stations) / mbps - 1
        for rate in (6, 54)
        for stations, mbps in ns3_mbps(rate).items()
    }
    (rate, stations), worst = max(off.items(), key=lambda item: abs(item[1]))
    report(
        Finding(
            "saturation throughput of 802.11a at 6 and 54 Mbps, 1 to 30 stations, with as_ns3.ini, "
            "against ns-3",
            f"differs by at most {worst:+.2%} ({rate} Mbps, {stations} stations), {fmean(off.values()):+.2%} "
            "on average",
            "1 %",
            "two standard errors of a run of 4 s; at 54 Mbps ten stations differ by 3.7 % without preamble "
            "detection",
            abs(worst) <= 0.01,
        )
    )


def test_picture(picture: Callable[[str, Callable[[Path], None]], None]) -> None:
    picture("saturation_throughput.png", draw)


def draw(path: Path) -> None:
    from verification.figure import INET, MODEL, NS3, OURS, save

    def panel(config: str, title: str) -> "Callable[[Axes], None]":
        def draw_panel(axes: "Axes") -> None:
            counts = [1, 2, 5, 10, 20, 30]
            for model, style, label in (
                (TIMINGS[config], "--", "DIFS"),
                (with_eifs(config), ":", "EIFS"),
            ):
                axes.plot(
                    range(1, 31),
                    [throughput_bps(stations, PAYLOAD_BITS, model) / 1e6 for stations in range(1, 31)],
                    style,
                    color=MODEL,
                    lw=1.2,
                    label=f"Bianchi, {label} after a collision",
                )
            inet = [(stations, mbps) for (name, stations), mbps in inet_mbps().items() if name == config]
            if inet:
                axes.plot(*zip(*inet, strict=True), "o", color=INET, ms=7, mfc="none", label="INET 4.5")
            if config in ("G54", "A6"):
                ns3 = ns3_mbps(int(config[1:]))
                axes.plot(
                    *zip(*ns3.items(), strict=True), "^", color=NS3, ms=6, mfc="none", label="ns-3 3.44"
                )
                under_its_rules = [mean_mbps(f"A{config[1:]}Ns3", stations) for stations in ns3]
                axes.plot([*ns3], under_its_rules, "+", color=OURS, ms=7, label="gradysim, rules of ns-3")
            ours = [throughput_mbps(config, stations, 0) for stations in counts]
            axes.plot(counts, ours, "x-", color=OURS, ms=5, lw=0.8, label="gradysim")
            axes.set(
                xlabel="stations",
                ylabel="throughput (Mbps of payload)",
            )
            axes.set_ylim(0.6 * min(ours), 1.1 * max(ours))
            axes.set_title(title, fontsize=9)
            axes.legend(fontsize=7.5, loc="lower left")

        return draw_panel

    save(
        path,
        "Saturation throughput, 1000 B payloads, unicast with ACK, no RTS",
        panel("G54", "802.11g (ns-3: 802.11a), 54 Mbps"),
        panel("G24", "802.11g, 24 Mbps"),
        panel("A6", "802.11a, 6 Mbps"),
        panel("B11", "802.11b, 11 Mbps"),
        columns=2,
    )
