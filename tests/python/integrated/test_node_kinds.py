"""Which nodes are alike."""

from collections.abc import Callable

import pytest

from gradysim.integrated.node_kinds import by_kind, one_of_each_kind
from gradysim.scenario import Scenario

FOUR = "*.numUavs = 4"


@pytest.mark.parametrize(
    ("settings", "kinds"),
    [
        ([], [[0, 1, 2, 3]]),
        (["*.uavs[1].wlan[*].radio.channelNumber = 5"], [[0, 2, 3], [1]]),
        (["*.uavs[2..].mobility.speed = 3mps"], [[0, 1], [2, 3]]),
        (["*.uavs[*].mobility.initialX = uniform(0m, 1km)"], [[0, 1, 2, 3]]),
    ],
    ids=["all", "an interface", "mobility", "places"],
)
def test_nodes_are_alike_if_the_same_lines_hold_for_them(
    make_scenario: Callable[..., Scenario], settings: list[str], kinds: list[list[int]]
) -> None:
    scenario = make_scenario("class Tested(Quiet): pass", FOUR, *settings)
    assert [[spec.id for spec in specs] for specs in by_kind(scenario.nodes).values()] == kinds
    assert [spec.id for spec in one_of_each_kind(scenario.nodes)] == [ids[0] for ids in kinds]


def test_nodes_of_two_groups_are_of_two_kinds(make_scenario: Callable[..., Scenario]) -> None:
    boats = ("*.boats.count = 2", '*.boats[*].protocol.class = "protocol.py:Tested"')
    scenario = make_scenario("class Tested(Quiet): pass", *boats)
    assert sorted(len(specs) for specs in by_kind(scenario.nodes).values()) == [2, 2]
