"""configs/zigzag.ini: the content of its scenarios, and consistency of its parts."""

from functools import cache
from pathlib import Path

import pytest

from gradysim.scenario import Scenario, load_scenarios
from gradysim.scenario.node_spec import NodeSpec

FILE = Path(__file__).parents[4] / "configs" / "zigzag.ini"
SIZES = {"ZigZag5": (2, 5), "ZigZag15": (7, 15), "ZigZag25": (12, 25)}
CONFIGS = [size + variant for size in SIZES for variant in ("", "Synchronised")]


@cache
def scenario(config: str) -> Scenario:
    (only_run,) = load_scenarios(FILE, config)
    return only_run


def group(config: str, name: str) -> list[NodeSpec]:
    return [node for node in scenario(config).nodes if node.group == name]


@pytest.mark.parametrize("config", CONFIGS)
def test_it_has_the_size_that_its_name_says(config: str) -> None:
    sizes = tuple(len(group(config, name)) for name in ("uavs", "sensors", "groundStation"))
    assert sizes == (*SIZES[config.removesuffix("Synchronised")], 1)


@pytest.mark.parametrize("config", CONFIGS)
def test_ids_start_with_the_uavs_which_launch_in_that_order(config: str) -> None:
    groups = [node.group for node in scenario(config).nodes]
    uavs, sensors = SIZES[config.removesuffix("Synchronised")]
    assert groups == ["uavs"] * uavs + ["sensors"] * sensors + ["groundStation"]


@pytest.mark.parametrize("config", CONFIGS)
def test_the_mission_leads_to_where_the_sensors_are(config: str) -> None:
    for uav in group(config, "uavs"):
        count, spacing = (uav.protocol_parameters[name] for name in ("sensor_count", "sensor_spacing"))
        assert isinstance(count, int)
        assert isinstance(spacing, float)
        stops = [((stop + 1) * spacing, 0.0, 0.0) for stop in range(count)]
        assert [sensor.initial_position for sensor in group(config, "sensors")] == stops


@pytest.mark.parametrize("config", CONFIGS)
def test_uavs_start_at_the_ground_station_but_not_in_the_same_place(config: str) -> None:
    (station,) = group(config, "groundStation")
    places = [uav.initial_position for uav in group(config, "uavs")]
    assert station.initial_position == (0.0, 0.0, 0.0)
    assert all((x, z) == (0.0, 0.0) and 0 < y < 15 for x, y, z in places)
    assert len(set(places)) == len(places)


@pytest.mark.parametrize("config", CONFIGS)
def test_only_the_synchronised_ones_are_without_jitter(config: str) -> None:
    expected = 0.0 if config.endswith("Synchronised") else 0.1
    senders = [*group(config, "uavs"), *group(config, "groundStation")]
    assert {sender.protocol_parameters["heartbeat_jitter"] for sender in senders} == {expected}


@pytest.mark.parametrize("config", CONFIGS)
def test_it_lasts_two_hours(config: str) -> None:
    assert scenario(config).sim_time_limit_s == 7200.0
