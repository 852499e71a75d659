from typing import Any

import pytest

from gradysim.scenario import Scenario, load_scenarios
from gradysim.scenario.errors import ConfigError, ConfigErrors
from gradysim.scenario.resolve.unknown_keys import NoSuchNodeError


@pytest.mark.parametrize(
    "added",
    [
        "**.power = 1mW\n",
        "*.*.mobility.speed = 1mps\n",
        "*.*[*].mobility.speed = 1mps\n",
        "*.uavs[0..5].mobility.speed = 1mps\n",
        "*.uavs[1].wlan[0].bitrate = 1Mbps\n",
        "**.uavs[1].**.bitrate = 1Mbps\n",
        "*.uavs[*].**.power = 1mW\n",
        "**.heartbeat_jitter = 1s\n",
        "Network.uavs[*].mobility.speed = 1mps\n",
        "*.radioMedium.**.power = 1mW\n",
        "*.visualizer.**.anything = whatever\n*.visualizer.x = ${y}\n",
        "cmdenv-status-frequency = 1s\nqtenv-x = 1\n**.cmdenv-log-level = trace\nnetwork = Network\n",
        "result-dir = results\nexperiment-label = ${configname}\n",
        "*.numBoats = 0\n*.boats[*].mobility.speed = 1mps\n*.boats[*].protocol.anything = 3\n",
    ],
)
def test_keys_that_match_something(folder: Any, added: str) -> None:
    assert len(folder.load(added).nodes) == 3


def test_a_key_may_name_nodes_that_a_more_specific_section_takes_away(folder: Any) -> None:
    added = "*.uavs[1].mobility.speed = 1mps\n[Small]\n*.numUavs = 1\n"
    assert len(folder.load(added, "Small").nodes) == 2
    assert len(folder.load(added, "Small", "*.numUavs=0").nodes) == 1


def test_a_key_of_a_shrunk_group_still_has_to_name_a_parameter(folder: Any) -> None:
    added = "*.uavs[1].mobility.sped = 1mps\n[Small]\n*.numUavs = 1\n"
    error = folder.mistake(added, "Small")
    assert (error.line, error.suggestion) == (6, "*.uavs[*].mobility.speed")


def test_a_module_of_omnetpp_is_no_parameter(folder: Any) -> None:
    assert isinstance(folder.mistake("*.visualizer = 3\n"), NoSuchNodeError)


def test_sections_that_are_not_run_are_not_checked(folder: Any) -> None:
    assert folder.load("[Other]\n*.boats[*].mobility.speed = 1mps\n")


def test_mistakes_of_all_sections_are_reported_in_the_order_of_the_file(folder: Any) -> None:
    error = folder.mistake("*.boats.x.y = 1\n[X]\n*.ships.x.y = 1\n", "X")
    assert [each.key for each in error.errors] == ["*.boats.x.y", "*.ships.x.y"]


@pytest.mark.parametrize(
    ("key", "suggestion"),
    [
        ("sim-time-limt", "sim-time-limit"),
        ("zzzz", ""),
        ("numUavs", "*.numUavs"),
    ],
)
def test_unknown_options(folder: Any, key: str, suggestion: str) -> None:
    error = folder.mistake(f"{key} = 3\n")
    assert (error.line, error.key, error.suggestion) == (6, key, suggestion)


def test_options_of_a_section_cannot_be_overridden(folder: Any) -> None:
    error = folder.mistake("", "General", "abstract=true")
    assert (error.line, error.key) == (0, "abstract")


def test_overrides_are_checked(folder: Any) -> None:
    error = folder.mistake("", "General", "*.uavz[*].mobility.speed=1mps")
    assert (error.line, error.suggestion) == (0, "*.uavs[*].mobility.speed")


@pytest.mark.parametrize("base_first", [True, False])
def test_a_group_in_the_wrong_case_is_told_at_its_line(folder: Any, base_first: bool) -> None:
    line = "*.Uavs[*].mobility.speed = 3mps"
    own = f"[X]\n{line}\n" if base_first else f"[X]\n*.numUavs = 3\n{line}\n*.uavs[*].mobility.speed = 2mps\n"
    error = folder.mistake(own, "X")
    assert (error.line, error.suggestion) == (7 if base_first else 8, "*.uavs[*].mobility.speed")


def speeds(scenario: Scenario) -> list[object]:
    settings = [node.mobility.get("speed_mps") for node in scenario.nodes]
    return [setting and setting.value for setting in settings]


def test_a_line_about_a_node_that_only_some_runs_have_concerns_those(folder: Any) -> None:
    lines = "[X]\n*.numUavs = ${1, 3}\n*.uavs[2].mobility.speed = 3mps\n"
    folder.load(lines, "X")
    one, three = load_scenarios(folder.ini, "X")
    assert speeds(one) == [None, None]
    assert speeds(three) == [None, None, None, 3.0]


def test_a_line_about_a_node_that_no_run_has_is_refused(folder: Any) -> None:
    folder.load("[X]\n*.numUavs = ${1, 3}\n*.uavs[3].mobility.speed = 3mps\n", "X")
    with pytest.raises(NoSuchNodeError) as caught:
        load_scenarios(folder.ini, "X")
    assert caught.value.line == 8


def test_of_some_runs_alone_it_is_not_known_whether_others_have_a_node(folder: Any) -> None:
    folder.load("[X]\n*.numUavs = ${1, 3}\n*.uavs[2].mobility.speed = 3mps\n", "X")
    (one,) = load_scenarios(folder.ini, "X", "0")
    assert speeds(one) == [None, None]


def test_a_line_about_a_node_concerns_those_runs_that_draw_it(folder: Any) -> None:
    folder.load("[X]\nrepeat = 20\n*.numUavs = intuniform(1, 3)\n*.uavs[2].mobility.speed = 3mps\n", "X")
    scenarios = load_scenarios(folder.ini, "X")
    assert {len(scenario.nodes) - 1 for scenario in scenarios} == {1, 2, 3}
    assert all(speeds(scenario)[3:] == [3.0][: len(scenario.nodes) - 3] for scenario in scenarios)
    folder.load("[X]\n*.numUavs = intuniform(1, 2)\n*.uavs[2].mobility.speed = 3mps\n", "X")


def test_a_variable_in_a_key_is_refused_in_an_override_too(folder: Any) -> None:
    assert folder.mistake("", "General", "*.uavs[${n}].mobility.speed=1mps").line == 0


@pytest.mark.parametrize(
    ("key", "is_told_of_others"), [("*.boats[0].mobility.speed", True), ("boats[0].mobility.speed", False)]
)
def test_who_names_no_node_may_have_meant_another_configuration(
    folder: Any, key: str, is_told_of_others: bool
) -> None:
    with pytest.raises(ConfigError) as error:
        folder.load(f"{key} = 1mps\n[Config Boats]\n*.numBoats = 1\n")
    assert isinstance(error.value, NoSuchNodeError) == is_told_of_others
    assert ("configuration" in error.value.hint) == is_told_of_others


@pytest.mark.parametrize(
    ("key", "suggestion"),
    [
        ("*.uavz[*].mobility.speed", "*.uavs[*].mobility.speed"),
        ("*.uavz[*].mobility.sped", "*.uavs[*].mobility.sped"),
        ("*.physicalEnvironment.config", ""),
        ("*.uavs[*].app[0].typename", ""),
        ("**.ipv4.arp.typename", ""),
        ("*.radioMedum.pathLoss.alpha", "*.radioMedium.pathLoss.alpha"),
        ("*.boats[*].mobility.speed", ""),
        ("*.uavs[7].mobility.speed", "*.uavs[*].mobility.speed"),
        ("*.groundStation[*].mobility.speed", "*.groundStation.mobility.speed"),
        ("*.numuavs", "*.numUavs"),
        ("*.numberOfUavs", "*.numUavs"),
        ("*.uavs.mobility.speed", "*.uavs[*].mobility.speed"),
        ("**.wlan[0].mac.rtsThreshold", "**.wlan[0].mac.dcf.rtsPolicy.rtsThreshold"),
        ("*.uavs[1].power", "*.uavs[1].wlan[*].radio.transmitter.power"),
        ("*.radioMedium.sigma", "*.radioMedium.pathLoss.sigma"),
        ("uavs[*].mobility.speed", "*.uavs[*].mobility.speed"),
        ("*.uavs[0].wlan[0].radio.transmiter.power", "*.uavs[0].wlan[0].radio.transmitter.power"),
        ("*.uavs[*].bitrate", "*.uavs[*].wlan[*].bitrate"),
        ("*.radioMedium.pathLoss.alfa", "*.radioMedium.pathLoss.alpha"),
        ("**.powr", "**.power"),
        ("n[1..2]", ""),
        ("*.", ""),
        ("*..uavs", "*.numUavs"),
        ("**.radio.transmiter.power", "**.radio.transmitter.power"),
        ("**.heartbeat_jiter", "**.heartbeat_jitter"),
        ("*.uavs[*].protocol.heartbeat_jiter", "*.uavs[*].protocol.heartbeat_jitter"),
        ("*.uavs[*].protocol.waypoints", ""),
        ("*.groundStation.protocol.label", ""),
        ("*.*.protocol.lable", "*.*.protocol.label"),
    ],
)
def test_the_nearest_key_is_suggested(folder: Any, key: str, suggestion: str) -> None:
    error = folder.mistake(f"{key} = 1\n")
    assert (error.line, error.key, error.suggestion) == (6, key, suggestion)


def test_all_unknown_keys_are_reported_by_line(folder: Any) -> None:
    error = folder.mistake("*.uavz[*].mobility.speed = 1mps\n**.powr = 1mW\nrepeats = 2\n*.boats.x = 1\n")
    assert isinstance(error, ConfigErrors)
    assert [each.line for each in error.errors] == [6, 7, 8, 9]
    assert [each.suggestion for each in error.errors] == [
        "*.uavs[*].mobility.speed",
        "**.power",
        "repeat",
        "",
    ]


@pytest.mark.parametrize("body", ["gateway: int", "def __init__(self): self.gateway = 3"])
def test_an_attribute_without_a_value_in_the_class_is_told_apart(folder: Any, body: str) -> None:
    text = f"from protocols import Sensor as S\nclass Sensor(S):\n    {body}\n    gate = 1\n"
    folder.write("others.py", text)
    added = '*.buoy.protocol.class = "others.py:Sensor"\n*.buoy.protocol.gateway = 1\n'
    error = folder.mistake(added)
    assert (error.line, error.expected) == (7, "one of class, gate, typename")
    assert "value" in error.problem


def test_an_attribute_that_is_none_in_the_class_is_told_apart(folder: Any) -> None:
    text = "from protocols import Sensor as S\nclass Sensor(S):\n    gateway: int | None = None\n"
    folder.write("others.py", text)
    added = '*.buoy.protocol.class = "others.py:Sensor"\n*.buoy.protocol.gateway = 1\n'
    error = folder.mistake(added)
    assert (error.line, error.expected) == (7, "one of class, typename")
    assert "None" in error.problem


@pytest.mark.parametrize(("name", "made"), [("boat", "boat"), ("boat*", "uav")])
def test_without_any_node_what_makes_one_is_told(folder: Any, name: str, made: str) -> None:
    folder.write("test.ini", f"[General]\nsim-time-limit = 1s\n*.{name}.mobility.initialX = 3m\n")
    with pytest.raises(ConfigError) as caught:
        load_scenarios(folder.ini)
    assert caught.value.line == 3
    assert f'`*.{made}.protocol.class = "file.py:Class"`' in caught.value.expected


def test_a_forgotten_index_is_told_even_if_another_name_is_more_like_it(folder: Any) -> None:
    added = '*.tx.protocol.class = "protocols.py:Sensor"\n*.numRx = 2\n*.rx.mobility.speed = 1mps\n'
    added += '*.rx[*].protocol.class = "protocols.py:Sensor"\n'
    error = folder.mistake(added)
    assert (error.line, error.suggestion) == (8, "*.rx[*].mobility.speed")


def test_a_misspelt_number_of_nodes(folder: Any) -> None:
    error = folder.mistake("*.numUavz = 1\n")
    assert (error.line, error.suggestion) == (6, "*.numUavs")
