from typing import Any

import pytest

from gradysim.scenario.scenario import Scenario

GRID = """\
*.uavs[*].mobility.separationX = 20m
*.uavs[*].mobility.separationY = 10m
"""


def places(folder: Any, added: str, count: int = 5) -> list[tuple[float, float]]:
    scenario: Scenario = folder.load(added, "General", f"*.numUavs={count}")
    return [node.initial_position[:2] for node in scenario.nodes if node.group == "uavs"]


def test_nodes_are_in_the_middle_of_the_cells_row_after_row(folder: Any) -> None:
    row = [(10.0, 5.0), (30.0, 5.0), (50.0, 5.0)]
    assert places(folder, GRID) == [*row, (10.0, 15.0), (30.0, 15.0)]


@pytest.mark.parametrize(
    ("count", "columns", "rows"),
    [(1, 1, 1), (2, 2, 1), (4, 2, 2), (6, 3, 2), (7, 3, 3), (9, 3, 3), (10, 4, 3)],
)
def test_a_grid_is_as_square_as_can_be(folder: Any, count: int, columns: int, rows: int) -> None:
    found = places(folder, GRID, count)
    assert len({x for x, _ in found}) == columns
    assert len({y for _, y in found}) == rows


def test_columns(folder: Any) -> None:
    found = places(folder, GRID + "*.uavs[*].mobility.columns = 2\n")
    assert found == [(10, 5), (30, 5), (10, 15), (30, 15), (10, 25)]


def test_rows(folder: Any) -> None:
    assert [y for _, y in places(folder, GRID + "*.uavs[*].mobility.rows = 1\n")] == [5] * 5


def test_margins_are_where_the_first_cell_begins(folder: Any) -> None:
    margins = "*.uavs[*].mobility.marginX = 100m\n*.uavs[*].mobility.marginY = -50m\n"
    assert places(folder, GRID + margins)[:2] == [(110.0, -45.0), (130.0, -45.0)]


def test_a_group_may_take_a_part_of_a_grid(folder: Any) -> None:
    assert places(folder, GRID + "*.uavs[*].mobility.numHosts = 16\n")[4] == (10.0, 15.0)


def test_groups_with_the_same_lines_have_a_grid_each(folder: Any) -> None:
    lines = (
        GRID.replace("uavs[*]", "*")
        + '*.relays.count = 9\n*.relays[*].protocol.class = "protocols.py:Sensor"\n'
    )
    scenario = folder.load(lines, "General", "*.numUavs=2")
    assert [node.initial_position[:2] for node in scenario.nodes if node.index == 0] == [(10.0, 5.0)] * 3
    (second,) = [node for node in scenario.nodes if node.name == "relays[3]"]
    assert second.initial_position[:2] == (10.0, 15.0)


def test_nodes_of_a_grid_may_fly_or_stand(folder: Any) -> None:
    assert "typename" not in folder.load(GRID).nodes[1].mobility
    static = folder.load(GRID + '*.uavs[*].mobility.typename = "StaticGridMobility"\n').nodes[1]
    assert static.mobility["typename"].value == "StationaryMobility"
    assert static.initial_position == (10.0, 5.0, 0.0)


def test_height_is_not_of_the_grid(folder: Any) -> None:
    added = GRID + "*.uavs[*].mobility.initialZ = 7m\n"
    assert {node.initial_position[2] for node in folder.load(added).nodes[1:]} == {7.0}


def test_of_grid_and_place_the_first_line_counts(folder: Any) -> None:
    own = "*.uavs[1].mobility.initialX = 1m\n"
    assert places(folder, own + GRID, 2) == [(10.0, 5.0), (1.0, 5.0)]
    assert places(folder, GRID + own, 2) == [(10.0, 5.0), (30.0, 5.0)]
    line = "*.uavs[*].mobility.lineStepY = 3m\n"
    assert places(folder, line + GRID, 2) == [(10.0, 0.0), (30.0, 3.0)]
    assert places(folder, GRID + "*.uavs[*].mobility.separationX = default\n" + line, 2)[1] == (30.0, 5.0)


def test_defaults_ask_for_no_grid(folder: Any) -> None:
    assert places(folder, "*.uavs[*].mobility.separationX = default\n", 2) == [(0.0, 0.0)] * 2


def test_more_columns_than_nodes_take_no_separation(folder: Any) -> None:
    lines = "*.uavs[*].mobility.columns = 3\n*.uavs[*].mobility.marginX = 5m\n"
    assert places(folder, lines, 1) == [(5.0, 0.0)]


@pytest.mark.parametrize("line", ["columns = 2", "marginX = 3m", 'typename = "StaticGridMobility"'])
def test_a_grid_without_a_separation_is_an_error_at_its_line(folder: Any, line: str) -> None:
    error = folder.mistake(f"*.uavs[*].mobility.{line}\n")
    assert (error.line, error.expected) == (6, "`*.uavs[*].mobility.separationX = 50m`")


def test_one_row_takes_one_separation(folder: Any) -> None:
    lines = "*.uavs[*].mobility.separationX = 20m\n*.uavs[*].mobility.rows = 1\n"
    assert places(folder, lines, 3) == [(10.0, 0.0), (30.0, 0.0), (50.0, 0.0)]


@pytest.mark.parametrize(
    ("line", "text"),
    [
        ("numHosts = 1", "uavs[*] has 2 nodes"),
        ("columns = 0", "integer"),
        (
            "rows = 1\n*.uavs[*].mobility.columns = 1",
            "1 rows of 1 columns",
        ),
        ("marginX = 9999999m", "x = 10000029m"),
    ],
)
def test_a_grid_that_cannot_be(folder: Any, line: str, text: str) -> None:
    error = folder.error(f"*.uavs[*].mobility.{line}\n{GRID}")
    assert error.startswith("test.ini:")
    assert text in error
