"""Every configuration of configs/reference runs, in both modes; those with native protocols in one."""

from collections.abc import Callable
from functools import cache

import pytest

import gradysim.integrated.run
import gradysim.prototype.run
from gradysim.results.result import RunResult
from gradysim.scenario import Scenario, load_scenarios
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.parse.ini import read_ini
from gradysim.scenario.parse.sections import config_names
from gradysim.scenario.schema.native_protocols import NativeProtocol
from verification.reference_data import rows
from verification.reference_run import FOLDER, load_reference

BASES = {"Sensitivity", "Noise"}
COMPLETED = {
    *("flyby", "hidden_inet", "link", "narrowband", "narrowband_contention", "saturation"),
    *("ns3_networks", "unicast_failures"),
}
"""Files whose General runs only with the other configurations."""
FILES = {
    *("beacons", "capture", "flood", "flyby", "hidden", "hidden_inet", "jittered", "link", "narrowband"),
    *("narrowband_contention", "narrowband_link", "rate_control", "rate_control_inet", "saturation", "sir"),
    *("ns3_networks", "synchronised", "unicast_failures"),
}
MODES = {"integrated": gradysim.integrated.run.run, "prototype": gradysim.prototype.run.run}


def runnable() -> list[tuple[str, str]]:
    """Return all configurations that run by themselves."""
    return [
        (file.stem, config)
        for file in sorted(FOLDER.glob("*.ini"))
        if "sim-time-limit" in file.read_text()  # other files are only included
        for config in dict.fromkeys(("General", *config_names(read_ini(file))))
        if config not in BASES and (config != "General" or file.stem not in COMPLETED)
    ]


@cache
def short_run(name: str, config: str) -> Scenario:
    # Saturated stations are busy from the start, and need much computation.
    limit_s = 0.1 if name in ("saturation", "ns3_networks") else 1.5
    file = FOLDER / f"{name}.ini"
    return load_scenarios(file, config, runs=[0], overrides=[f"sim-time-limit = {limit_s}s"])[0]


def test_every_comparison_has_its_file() -> None:
    assert {name for name, _ in runnable()} == FILES


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize(("name", "config"), runnable())
def test_it_runs(name: str, config: str, mode: str) -> None:
    scenario = short_run(name, config)
    run: Callable[[Scenario], RunResult] = MODES[mode]
    if mode == "prototype" and any(issubclass(node.protocol, NativeProtocol) for node in scenario.nodes):
        with pytest.raises(ConfigError, match="does not run in prototype mode"):
            run(scenario)
        return
    result = run(scenario)
    assert not result.interrupted
    assert sum(sum(outcomes.values()) for outcomes in result.outcomes["messages"].values()) > 0


@pytest.mark.parametrize(
    ("config", "table"),
    [
        ("Inet50", "inet_beacons_g24_50"),
        ("Inet100", "inet_beacons_g24_100"),
        ("Window10ms", "inet_window_10000_50"),
        ("Window2ms", "inet_window_2000_20"),
        ("Window2ms30", "inet_window_2000_30"),
        ("Window2ms50", "inet_window_2000_50"),
        ("Window500us50", "inet_window_500_50"),
    ],
)
def test_given_places_and_phases_are_those_of_the_table(config: str, table: str) -> None:
    nodes = load_reference("beacons", config).nodes
    assert {node.protocol_parameters["spread"] for node in nodes} == {0}
    assert [(*node.initial_position[:2], node.protocol_parameters["first_send"]) for node in nodes] == [
        (float(row["x_m"]), float(row["y_m"]), int(row["first_send_us"]) / 1e6) for row in rows(table)
    ]
