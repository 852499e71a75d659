from dataclasses import replace

import pytest

from gradysim.scenario import load_scenarios
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.scenario import check_node_names, nodes_named


@pytest.fixture
def scenario(make_scenario, tmp_path):
    """Return two UAVs and a ground station."""
    make_scenario()
    with (tmp_path / "test.ini").open("a") as file:
        file.write('*.groundStation.protocol.class = "protocol.py:Tested"\n')
    (scenario,) = load_scenarios(tmp_path / "test.ini")
    return scenario


@pytest.mark.parametrize(
    ("names", "nodes"),
    [
        (["uavs[1]"], [1]),
        (["groundStation"], [2]),
        (["uavs"], [0, 1]),
        (["all"], [0, 1, 2]),
        (["groundStation", "uavs[0]"], [0, 2]),
        (["uavs", "uavs[0]", "all"], [0, 1, 2]),
        ([], []),
    ],
)
def test_nodes_by_name(scenario, names, nodes):
    check_node_names([scenario], names, "--pcap", 1)
    assert [node.id for node in nodes_named(scenario, names)] == nodes


def test_an_unknown_name_says_what_there_is(scenario):
    with pytest.raises(ConfigError) as error:
        check_node_names([scenario], ["groundstation"], "--outcomes-at", 1)
    assert error.value.problem.startswith("--outcomes-at groundstation: ")
    assert all(part in error.value.expected for part in (" uavs[0],", "(uavs, groundStation)"))
    assert error.value.suggestion == "groundStation"


def test_of_several_runs_the_one_without_such_a_node_is_named(scenario):
    one_of_two = replace(scenario, run_number=1, run_count=2)
    with pytest.raises(ConfigError) as caught:
        check_node_names([one_of_two], ["uavs[7]"], "--pcap", 1)
    assert "run 1" in caught.value.problem


@pytest.fixture
def study(scenario):
    """Return runs with one UAV and with three."""
    return load_scenarios(scenario.file, overrides=["*.uavs.count = ${1, 3}"])


def test_a_node_that_one_of_several_runs_has(study):
    check_node_names(study, ["uavs[2]", "all"], "--vectors", 2)
    assert [[node.name for node in nodes_named(scenario, ["uavs[2]"])] for scenario in study] == [
        [],
        ["uavs[2]"],
    ]


def test_a_node_that_none_of_several_runs_has(study):
    with pytest.raises(ConfigError) as error:
        check_node_names(study, ["uavs[2]", "uavs[3]"], "--vectors", 2)
    assert error.value.problem.startswith("--vectors uavs[3]: ")
    assert " runs" in error.value.problem
