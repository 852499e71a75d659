from typing import Any

import pytest

from gradysim.scenario import Scenario, load_scenarios
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.matching.key_check import NoSuchNodeError


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
    assert folder.error(added, "Small") == (
        "test.ini:6: `*.uavs[1].mobility.sped` matches no parameter; expected the name of one; "
        "did you mean `*.uavs[*].mobility.speed`?"
    )


def test_a_module_of_omnetpp_is_no_parameter(folder: Any) -> None:
    assert folder.error("*.visualizer = 3\n").startswith("test.ini:6: `*.visualizer` matches no node")


def test_sections_that_are_not_run_are_not_checked(folder: Any) -> None:
    assert folder.load("[Other]\n*.boats[*].mobility.speed = 1mps\n")


def test_the_first_mistake_of_the_file_is_reported(folder: Any) -> None:
    assert folder.error("*.boats.x.y = 1\n[X]\n*.ships.x.y = 1\n", "X").startswith(
        "test.ini:6: `*.boats.x.y`"
    )


@pytest.mark.parametrize(
    ("key", "hint"),
    [
        ("sim-time-limt", "; did you mean `sim-time-limit`?"),
        ("zzzz", ""),
        ("numUavs", "; did you mean `*.numUavs`?"),
    ],
)
def test_unknown_options(folder: Any, key: str, hint: str) -> None:
    assert folder.error(f"{key} = 3\n") == (
        f"test.ini:6: there is no option `{key}`; "
        f"expected one, or a parameter such as `*.uavs[*].mobility.speed`{hint}"
    )


def test_options_of_a_section_cannot_be_overridden(folder: Any) -> None:
    assert folder.error("", "General", "abstract=true") == (
        "override abstract=true: `abstract` belongs to a section; expected it in the file"
    )


def test_overrides_are_checked(folder: Any) -> None:
    assert folder.error("", "General", "*.uavz[*].mobility.speed=1mps") == (
        "override *.uavz[*].mobility.speed=1mps: `*.uavz[*].mobility.speed` matches no node; "
        "expected one of `groundStation`, `uavs[*]`; did you mean `*.uavs[*].mobility.speed`?"
    )


@pytest.mark.parametrize("base_first", [True, False])
def test_a_group_in_the_wrong_case_is_told_at_its_line(folder: Any, base_first: bool) -> None:
    line = "*.Uavs[*].mobility.speed = 3mps"
    own = f"[X]\n{line}\n" if base_first else f"[X]\n*.numUavs = 3\n{line}\n*.uavs[*].mobility.speed = 2mps\n"
    assert folder.error(own, "X") == (
        f"test.ini:{7 if base_first else 8}: `*.Uavs[*].mobility.speed` matches no node; expected one of "
        "`groundStation`, `uavs[*]`; did you mean `*.uavs[*].mobility.speed`?"
    )


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
    with pytest.raises(ConfigError, match=r":8: `\*\.uavs\[3\]\.mobility\.speed` matches no node in any run"):
        load_scenarios(folder.ini, "X")


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
    assert folder.error("", "General", "*.uavs[${n}].mobility.speed=1mps") == (
        "override *.uavs[${n}].mobility.speed=1mps: `*.uavs[${n}].mobility.speed` has a variable;"
        " expected `${...}` in values only"
    )


@pytest.mark.parametrize(
    ("key", "is_told_of_others"), [("*.boats[0].mobility.speed", True), ("boats[0].mobility.speed", False)]
)
def test_who_names_no_node_may_have_meant_another_configuration(
    folder: Any, key: str, is_told_of_others: bool
) -> None:
    with pytest.raises(ConfigError) as error:
        folder.load(f"{key} = 1mps\n[Config Boats]\n*.numBoats = 1\n")
    assert isinstance(error.value, NoSuchNodeError) == is_told_of_others
    assert ("; or run another configuration of the file: " in str(error.value)) == is_told_of_others
