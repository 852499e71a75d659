import pytest

from gradysim.results.tracked_variables import numbers_and_others, tracked_by_group, variables_of_group


def test_nodes_of_a_group_are_together() -> None:
    nodes = [
        {"name": name, "tracked_variables": {"of": name}} for name in ("uavs[0]", "base", "uavs[1]", "x[2]x")
    ]
    assert tracked_by_group(nodes) == {
        "uavs[*]": [{"of": "uavs[0]"}, {"of": "uavs[1]"}],
        "base": [{"of": "base"}],
        "x[2]x": [{"of": "x[2]x"}],
    }


@pytest.mark.parametrize("value", [7, -2.5, True])
def test_finite_numbers_are_taken(value: float) -> None:
    assert numbers_and_others([{"x": value}], "x") == ([value], [])


@pytest.mark.parametrize(
    ("value", "what"),
    [
        ("inf", "inf"),
        ("-inf", "-inf"),
        (float("-inf"), "-inf"),
        (None, "nan or None"),
        (float("nan"), "nan or None"),
        (10**400, "too large"),
        ("7", "no number"),
        ([1, 2], "no number"),
    ],
)
def test_what_else_a_value_is(value: object, what: str) -> None:
    assert numbers_and_others([{"x": value}, {"x": 3}], "x") == ([3], [what])


def test_a_node_may_lack_the_variable() -> None:
    assert numbers_and_others([{"x": 3}, {"y": 4}], "x") == ([3], ["missing"])


@pytest.mark.parametrize("value", [3, "inf", 10**400])
def test_a_variable_is_numeric_if_it_is_a_number_at_one_node(value: object) -> None:
    assert variables_of_group([{"x": None}, {"x": value}])["x"].is_numeric


@pytest.mark.parametrize("value", [None, "3", [3]])
def test_others_are_not(value: object) -> None:
    assert not variables_of_group([{"x": value}])["x"].is_numeric
