"""What is known about one parameter of a run."""

from pathlib import Path
from typing import Any

import pytest

from gradysim.scenario import load_scenarios
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.explain import Explanation, explain
from gradysim.scenario.resolve.resolution import network_schemas, node_schema, protocol_schema

CONFIGS = Path(__file__).parents[3] / "configs"
POWER = "uavs[1].wlan[0].radio.transmitter.power"


@pytest.fixture
def explained(folder: Any) -> Any:
    """`explained(parameter, *lines)`: what is known of it if the lines are added, which begin at line 6."""

    def of(parameter: str, *lines: str, overrides: tuple[str, ...] = ()) -> Explanation:
        return explain(folder.load("\n".join(lines) + "\n", "General", *overrides), parameter)

    return of


def test_the_line_in_force_and_those_that_it_hides(explained: Any) -> None:
    lines = ("*.uavs[1].wlan[*].radio.transmitter.power = 3mW", "**.power = 4mW")
    found = explained(POWER, *lines, overrides=("*.uavs[0].wlan[*].radio.transmitter.power=5mW",))
    assert (found.name, found.value, found.default) == (POWER, "3mW", "20mW")
    assert [source.line for source in found.sources] == [6, 7]


def test_an_override_comes_first(explained: Any) -> None:
    found = explained(POWER, "**.power = 4mW", overrides=("**.transmitter.power=5mW",))
    assert (found.value, [source.line for source in found.sources]) == ("5mW", [0, 6])


@pytest.mark.parametrize("before", ["", "*.", "Network."])
def test_the_name_of_the_network_may_precede(explained: Any, before: str) -> None:
    assert explained(f"{before}uavs[0].mobility.speed", "**.speed = 36kmph").value == "10mps"


@pytest.mark.parametrize(
    ("parameter", "value"),
    [
        ("sim-time-limit", "1h"),
        ("repeat", "1"),
        ("numUavs", "2"),
        ("uavs.count", "2"),
        ("groundStation.protocol.class", '"protocols.py:Sensor"'),
        ("uavs[0].protocol.label", '"mobile"'),
        ("uavs[0].protocol.launch_interval", "5.0"),
        ("uavs[0].protocol.waypoints", "[1, 2]"),
        ("uavs[0].mobility.typename", '"MasslessMobility"'),
        ("radioMedium.pathLoss.typename", '"FreeSpacePathLoss"'),
        ("communicationMedium.delay", "0s"),
    ],
)
def test_what_no_added_line_sets(explained: Any, parameter: str, value: str) -> None:
    assert explained(parameter).value == value


def test_default_stops_the_search(explained: Any) -> None:
    found = explained("uavs[0].mobility.speed", "*.uavs[0].mobility.speed = default", "**.speed = 3mps")
    assert (found.value, [source.line for source in found.sources]) == ("10mps", [6, 7])


def test_the_value_of_a_run_is_the_one_that_it_draws(folder: Any) -> None:
    scenario = folder.load("*.uavs[*].mobility.initialX = uniform(0m, 100m)\n")
    values = [explain(scenario, f"uavs[{index}].mobility.initialX").value for index in range(2)]
    assert values == [f"{node.initial_position[0]:g}m" for node in scenario.nodes[1:]]


def test_the_default_of_the_chosen_standard(explained: Any) -> None:
    line = '**.wlan[*].typename = "Ieee802154NarrowbandInterface"'
    assert explained("uavs[0].wlan[0].radio.channelNumber", line).default == "20"


def test_the_models_that_read_it(explained: Any) -> None:
    assert "MasslessMobility" in explained("uavs[0].mobility.speed").read_by
    assert explained("uavs[0].protocol.label").read_by == ("Mobile",)


def test_what_would_have_to_be_chosen(explained: Any) -> None:
    found = explained("radioMedium.pathLoss.sigma", "*.radioMedium.pathLoss.sigma = 3")
    assert found.lacking is not None
    assert (found.lacking.chosen_by, found.lacking.names) == ("medium.path_loss", ("LogNormalShadowing",))
    assert found.chosen == "FreeSpacePathLoss"


@pytest.mark.parametrize(
    ("parameter", "line"),
    [
        ("uavs[0].mobility.initialX", "*.uavs[*].mobility.lineStartX = 3m"),
        ("uavs[0].wlan[0].radio.channelNumber", "**.radio.centerFrequency = 2.45GHz"),
        (POWER, "**.transmitter.communicationRange = 50m"),
    ],
)
def test_another_key_that_sets_the_same_thing(explained: Any, parameter: str, line: str) -> None:
    (instead,) = [source for source in (explained(parameter, line).instead,) if source]
    assert instead.line == 6


@pytest.mark.parametrize(
    ("parameter", "suggestion"),
    [
        ("uavs[0].mobility.sped", "uavs[0].mobility.speed"),
        ("uavs[0].protocol.lable", "uavs[0].protocol.label"),
        ("radioMedium.typname", "radioMedium.typename"),
        ("groundStatio.mobility.speed", "groundStation.mobility.speed"),
        ("sim-time-limt", "sim-time-limit"),
        ("uavs[7].mobility.speed", ""),
        ("uavs.mobility.speed", ""),
        ("", ""),
        (".", ""),
        ("uavs[0]", ""),
    ],
)
def test_an_unknown_name_is_an_error(explained: Any, parameter: str, suggestion: str) -> None:
    with pytest.raises(ConfigError) as caught:
        explained(parameter)
    assert (caught.value.suggestion, bool(caught.value.expected)) == (suggestion, True)


@pytest.mark.parametrize(
    ("file", "config"),
    [("zigzag.ini", "ZigZag5"), ("zigzag.ini", "ZigZag5Native"), ("town/town.ini", "Concrete")],
)
def test_every_parameter_has_an_explanation(file: str, config: str) -> None:
    scenario = load_scenarios(CONFIGS / file, config, "0")[0]
    resolution = scenario.resolution
    assert resolution is not None
    names = [f"{module}.{path}" for module, schema in network_schemas().items() for path in schema.keys]
    for node, kind in resolution.kinds.items():
        for schema in (node_schema(kind.interface_count), protocol_schema(kind.protocol.cls)):
            names += [f"{node}.{path}" for path in schema.keys]
    for name in names:
        found = explain(scenario, name)
        assert found.value
        assert found.meaning
