"""Antennas and obstacles, from an .ini file to the receptions: configs/town."""

from dataclasses import replace
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")

from gradysim.integrated.network import medium_config, node_config
from gradysim.integrated.run import run
from gradysim.scenario import ConfigError, load_scenarios

TOWN = Path(__file__).parents[3] / "configs" / "town" / "town.ini"
SENT = 200


def received(config: str, *overrides: str) -> list[int]:
    """Return the number of frames at each drone."""
    result = run(load_scenarios(TOWN, config, "0", overrides)[0])
    drones = [node for node in result.nodes if node.name.startswith("drones[")]
    return [int(str(node.tracked_variables["received"])) for node in drones]


def test_over_an_open_field_all_hear_all() -> None:
    assert received("OpenField") == [SENT] * 8


def test_whoever_is_behind_a_house_hears_nothing() -> None:
    assert received("Blocked") == [0, 0, 0, SENT, SENT, SENT, SENT, SENT]


def test_glass_lets_enough_through_and_concrete_nothing() -> None:
    assert received("Concrete")[:3] == [0, 0, SENT]


def test_an_antenna_that_looks_along_the_street() -> None:
    north = received("SectorAntenna")
    assert north[6] == SENT
    assert north[7] == 0  # above the station, outside of the beam
    assert received("SectorAntenna", "*.station.mobility.initialHeading=180deg")[6] == 0


def test_the_engine_is_given_what_the_file_says() -> None:
    scenario = load_scenarios(TOWN, "SectorAntenna", "0")[0]
    obstacles = medium_config(scenario).obstacles
    assert [obstacle.name.partition('"')[2] for obstacle in obstacles] == [
        'West block")',
        'North-west block")',
        'Two halls")',
        'Two halls")',
        'Glass pavilion")',
    ]
    antenna = node_config(scenario.nodes[0]).wlan[0].radio.antenna
    assert (antenna.typename, antenna.max_gain) == ("ParabolicAntenna", pytest.approx(10**1.5))


@pytest.mark.parametrize(
    ("override", "message"),
    [
        (
            "*.station.wlan[*].radio.antenna.minGain=20dB",
            "wlan[*].radio.antenna.maxGain, 15dB",
        ),
        (
            "*.station.wlan[*].radio.antenna.length=13cm",
            " 0.124292m",
        ),
    ],
)
def test_values_outside_of_the_engines_range_are_told(override: str, message: str) -> None:
    scenario = load_scenarios(TOWN, "SectorAntenna", "0", [override])[0]
    with pytest.raises(ConfigError, match="override") as caught:
        node_config(scenario.nodes[0])
    assert message in str(caught.value)


def test_what_the_engine_refuses_of_an_obstacle_names_it() -> None:
    scenario = load_scenarios(TOWN, "Blocked", "0")[0]
    first, second, *others = scenario.obstacles
    of_a_script = replace(scenario, obstacles=(first, replace(second, material="bricks"), *others))
    with pytest.raises(ConfigError, match="brick") as caught:
        medium_config(of_a_script)
    assert 'feature 1 ("North-west block")' in str(caught.value)
