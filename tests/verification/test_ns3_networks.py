"""Hidden stations, chains, stars, pairs and broadcasts with as_ns3.ini: messages received, against ns-3."""

from collections.abc import Callable
from functools import cache
from statistics import fmean

import pytest

from gradysim.scenario.parse.ini import read_ini
from gradysim.scenario.parse.sections import config_names
from verification.finding import Finding
from verification.reference_data import rows
from verification.reference_run import FOLDER, load_reference, run_reference
from verification.sampling import least_p, welch_p

NAME = "ns3_networks"
VERSION, OLDER_VERSION = "3.44", "3.37"
SEEDS = range(5)
TOLERANCE = 0.03

STATIONS_DIFFER = "Chain6Near"
"""Network whose stations share the channel in another way than with YansWifiPhy; the guide says why."""

Sample = tuple[float, ...]
"""Received messages of one station, for each seed."""


def networks() -> list[str]:
    return [config for config in config_names(read_ini(FOLDER / f"{NAME}.ini")) if config != "General"]


@cache
def received(config: str, *overrides: str) -> tuple[Sample, ...]:
    """Return the sample of each station."""
    runs = [run_reference(NAME, config, seed=seed, overrides=overrides) for seed in SEEDS]
    return tuple(
        tuple(float(str(node.tracked_variables["received"])) for node in stations)
        for stations in zip(*(run.nodes for run in runs), strict=True)
        if "received" in stations[0].tracked_variables
    )


def ns3_received(config: str, version: str = VERSION, phy: str = "yans") -> tuple[Sample, ...]:
    """Return the sample of each station in ns-3."""
    stations: dict[str, list[float]] = {}
    for row in rows(NAME, config=config, version=version, phy=phy):
        stations.setdefault(row["station"], []).append(float(row["received"]))
    return tuple(tuple(values) for values in stations.values())


def total(samples: tuple[Sample, ...]) -> Sample:
    """Return what all stations together received, for each seed."""
    return tuple(map(sum, zip(*samples, strict=True)))


def deviation(ours: Sample, theirs: Sample) -> float:
    return fmean(ours) / fmean(theirs) - 1


def test_each_network_was_recorded() -> None:
    for config in networks():
        assert len(ns3_received(config)) == len(load_reference(NAME, config).nodes), config


@pytest.mark.verify
def test_what_a_network_receives_is_what_it_receives_in_ns3(report: Callable[[Finding], None]) -> None:
    off = {config: deviation(total(received(config)), total(ns3_received(config))) for config in networks()}
    worst = max(off, key=lambda config: abs(off[config]))
    report(
        Finding(
            f"{len(off)} saturated networks with as_ns3.ini: messages received, against ns-3 {VERSION}",
            f"differs by at most {off[worst]:+.2%} ({worst}), {fmean(map(abs, off.values())):.2%} on average",
            "3 %",
            "the standard error of ns-3's mean is at most 0.6 %; energy detection at -62 dBm would change "
            "10 % in chains and a factor of 2.6 with pairs",
            abs(off[worst]) <= TOLERANCE,
        )
    )


@pytest.mark.verify
def test_what_a_station_receives_is_what_it_receives_in_ns3(report: Callable[[Finding], None]) -> None:
    p_values: dict[tuple[str, int], float] = {}
    for config in networks():
        phy = "spectrum" if config == STATIONS_DIFFER else "yans"
        pairs = zip(received(config), ns3_received(config, phy=phy), strict=True)
        for station, (ours, theirs) in enumerate(pairs):
            if len({*ours, *theirs}) > 1:  # some hear nothing in either
                p_values[config, station] = welch_p(ours, theirs)
    (config, station), worst = min(p_values.items(), key=lambda item: item[1])
    limit = least_p(len(p_values))
    report(
        Finding(
            f"the same, {STATIONS_DIFFER} with SpectrumWifiPhy: each of {len(p_values)} stations",
            f"least p-value {worst:.2g} ({config}, station {station})",
            f"p ≥ {limit:.2g} for each",
            "sampling error at 99 % for all together (Welch's t test, Bonferroni; five runs of 10 s)",
            worst >= limit,
        )
    )


@pytest.mark.verify
def test_without_its_window_networks_receive_what_they_receive_in_an_older_ns3(
    report: Callable[[Finding], None],
) -> None:
    recorded = dict.fromkeys(row["config"] for row in rows(NAME, version=OLDER_VERSION))
    off = {
        config: deviation(
            total(received(config, "**.ns3StationWindow = false")),
            total(ns3_received(config, OLDER_VERSION)),
        )
        for config in recorded
    }
    worst = max(off, key=lambda config: abs(off[config]))
    report(
        Finding(
            f"{len(off)} of them, each message given up resets the window, against ns-3 {OLDER_VERSION}",
            f"differs by at most {off[worst]:+.2%} ({worst})",
            "3 %",
            "the standard error of ns-3's mean is at most 1 %; the other rule of the window changes hidden "
            "stations by 5 % to 17 %",
            abs(off[worst]) <= TOLERANCE,
        )
    )
