"""Random values of a file: different for each node, parameter and seed."""

from dataclasses import replace
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from gradysim.scenario import Scenario, load_scenarios

SCATTERED = """\
*.uavs[*].mobility.initialX = uniform(0m, 1km)
*.uavs[*].mobility.initialY = uniform(0m, 1km)
*.uavs[*].protocol.launch_interval = exponential(5s)
*.uavs[*].protocol.retries = intuniform(1, 1000000)
"""


def drawn(scenario: Scenario) -> dict[str, list[object]]:
    """Return the random values of each UAV, by its name."""
    return {
        node.name: [*node.initial_position[:2], *node.protocol_parameters.values()]
        for node in scenario.nodes
        if node.group == "uavs"
    }


def places(scenario: Scenario) -> list[float]:
    return [node.initial_position[0] for node in scenario.nodes if node.group == "uavs"]


def test_each_parameter_of_each_node_draws_its_own_number(folder: Any) -> None:
    values = drawn(folder.load(SCATTERED))
    assert len({value for of_node in values.values() for value in of_node}) == 8


@given(st.integers(2, 12), st.permutations(SCATTERED.splitlines()), st.booleans())
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None, max_examples=30)
def test_other_nodes_and_lines_change_no_draw(
    folder: Any, count: int, lines: list[str], before: bool
) -> None:
    few = drawn(folder.load(SCATTERED))
    others = '*.others[*].protocol.class = "protocols.py:Sensor"'
    lines = [*lines, "*.others.count = 3", others, "**.mobility.initialZ = uniform(0m, 1m)"]
    many = folder.load("\n".join(lines[::-1] if before else lines), "General", f"*.numUavs={count}")
    assert len(drawn(many)) == count
    assert {name: set(drawn(many)[name]) for name in few} == {name: set(few[name]) for name in few}


def test_nodes_that_draw_a_place_share_all_else(folder: Any) -> None:
    _, one, other = folder.load(
        "*.uavs[*].mobility.initialX = uniform(0m, 1km)\n*.uavs[*].mobility.speed = 3mps\n"
    ).nodes
    assert one.initial_position != other.initial_position
    assert one.mobility is other.mobility
    assert one.protocol_sources is other.protocol_sources
    assert one.wlan[0] is other.wlan[0]


def test_a_drawn_separation_is_each_nodes_own(folder: Any) -> None:
    added = "*.uavs[*].mobility.separationX = uniform(10m, 20m)\n*.uavs[*].mobility.separationY = 4m\n"
    x_0, x_1 = places(folder.load(added))
    assert 5 <= x_0 < 10
    assert 15 <= x_1 < 30
    assert x_1 != 3 * x_0


def test_a_drawn_value_that_is_out_of_range_names_the_node_and_the_number(folder: Any) -> None:
    error = folder.mistake("*.uavs[*].mobility.speed = -intuniform(2, 2) * 1mps\n")
    assert error.line == 6
    assert all(part in error.problem for part in (" -2mps ", " uavs[0].mobility.speed "))


ON_A_LINE = "*.uavs[*].mobility.initialX = uniform(0m, 1km)\n"


def test_runs_of_other_seeds_draw_other_values(folder: Any) -> None:
    folder.load(f"repeat = 3\n{ON_A_LINE}")
    scenarios = load_scenarios(folder.ini)
    assert len({place for scenario in scenarios for place in places(scenario)}) == 6
    assert places(load_scenarios(folder.ini, runs="2")[0]) == places(scenarios[2])
    assert len({scenario.settings_hash for scenario in scenarios}) == 1


def test_a_given_seed_draws_what_that_of_the_file_would(folder: Any) -> None:
    folder.load(f"repeat = 3\n{ON_A_LINE}")
    scenarios = load_scenarios(folder.ini, seed=1)
    assert [scenario.seed for scenario in scenarios] == [1, 2, 3]
    assert list(map(places, scenarios[:2])) == list(map(places, load_scenarios(folder.ini)[1:]))


def test_a_seed_of_numpy_draws_what_an_int_does(folder: Any) -> None:
    numpy = pytest.importorskip("numpy")
    folder.load(ON_A_LINE)
    scenarios = load_scenarios(folder.ini, seed=numpy.int64(3))
    assert type(scenarios[0].seed) is int
    assert places(scenarios[0]) == places(load_scenarios(folder.ini, seed=3)[0])
    assert type(replace(scenarios[0], seed=numpy.int64(4)).seed) is int


def test_equal_seeds_draw_equal_values_for_all_combinations(folder: Any) -> None:
    folder.load(f"seed-set = 7\n*.uavs[*].mobility.speed = ${{1, 2}}mps\n{ON_A_LINE}")
    one, other = map(places, load_scenarios(folder.ini))
    assert one == other


def test_a_variable_may_be_part_of_what_draws(folder: Any) -> None:
    folder.load("seed-set = 7\n*.uavs[*].mobility.initialX = ${uniform, normal}(1km, 1km)\n")
    one, other = map(places, load_scenarios(folder.ini))
    assert one == [1000, 1000]
    assert len({*one, *other}) == 3


def test_a_value_of_a_variable_may_draw(folder: Any) -> None:
    folder.load("seed-set = 7\n*.uavs[*].mobility.initialX = ${5m, uniform(0m, 1km), 1m+uniform(0m, 1km)}\n")
    fixed, drawn_once, shifted = map(places, load_scenarios(folder.ini))
    assert fixed == [5, 5]
    assert len(set(drawn_once)) == 2
    assert shifted == pytest.approx([place + 1 for place in drawn_once])


def test_repetitions_draw_other_values_by_a_function_that_a_variable_names(folder: Any) -> None:
    folder.load("repeat = 2\n*.uavs[*].mobility.initialX = ${uniform, normal}(0km, 1km)\n")
    scenarios = load_scenarios(folder.ini)
    assert len({place for scenario in scenarios for place in places(scenario)}) == 4 * 2


def test_the_network_draws_too(folder: Any) -> None:
    added = (
        "*.radioMedium.pathLoss.alpha = uniform(2, 3)\n*.environment.numObstacles = 2\n"
        "*.environment.obstacle[*].maxX = uniform(1m, 2m)\n*.environment.obstacle[*].maxY = 1m\n"
        "*.environment.obstacle[*].minX = 0m\n*.environment.obstacle[*].minY = 0m\n"
        "*.environment.obstacle[*].minZ = 0m\n*.environment.obstacle[*].maxZ = 1m\n"
        "*.communicationMedium.transmissionRange = uniform(10m, 20m)\n"
    )
    scenario = folder.load(added)
    assert 2 <= float(scenario.medium["alpha"].value) < 3
    assert 10 <= scenario.communication_medium.transmission_range_m < 20
    widths = [max(x for x, _ in obstacle.rings[0]) for obstacle in scenario.obstacles]
    assert len(set(widths)) == 2
    assert all(1 <= width < 2 for width in widths)


@pytest.mark.parametrize(
    "line",
    [
        "sim-time-limit = uniform(1s, 2s)",
        "seed-set = intuniform(1, 5)",
        "repeat = intuniform(1, 5)",
        "constraint = uniform(1, 2) < 3",
    ],
)
def test_options_draw_nothing(folder: Any, line: str) -> None:
    error = folder.error("[X]\n*.uavs[*].mobility.speed = ${1, 2}mps\n" + line + "\n", "X")
    assert error.startswith(f"test.ini:8: {line}: `")
    assert "uniform`" in error
