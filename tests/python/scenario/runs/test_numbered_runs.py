from typing import Any

import pytest

from gradysim.scenario import load_scenarios
from gradysim.scenario.errors import ConfigError


def test_a_constraint_chooses_combinations_and_numbers_close_up(folder: Any) -> None:
    folder.load(
        "*.uavs[*].mobility.speed = ${speed=1..3}mps\n*.uavs[*].protocol.retries = ${n=1..3}\n"
        "constraint = $n < $speed\n"
    )
    scenarios = load_scenarios(folder.ini)
    assert [scenario.run_number for scenario in scenarios] == [0, 1, 2]
    assert [tuple(scenario.iterations.values()) for scenario in scenarios] == [
        ("2", "1"),
        ("3", "1"),
        ("3", "2"),
    ]


def test_a_constraint_that_leaves_nothing(folder: Any) -> None:
    added = "*.uavs[*].mobility.speed = ${speed=1..3}mps\nconstraint = $speed > 3\n"
    assert folder.error(added) == (
        "test.ini:7: constraint = $speed > 3: none of 3 combinations of values is left; expected one at least"
    )


def test_repeat_is_the_same_for_all_combinations(folder: Any) -> None:
    assert folder.error("repeat = ${1, 2}\n") == (
        "test.ini:6: repeat = ${1, 2}: it is the same for all combinations; expected a number"
    )


def test_there_is_a_limit_to_the_number_of_runs(folder: Any) -> None:
    assert folder.error("repeat = 1000\n**.speed = ${1..2000}mps\n") == (
        "test.ini:6: configuration `General` has 2000 combinations of values and 1000 runs of each;"
        " expected at most 1000000 runs"
    )


def test_a_run_beyond_all_combinations_says_how_many_there_are(folder: Any) -> None:
    folder.load("repeat = 3\n**.speed = ${1, 2}mps\n")
    with pytest.raises(ConfigError, match=r"runs 0 to 5 \(2 combinations of values, `repeat = 3`\)$"):
        load_scenarios(folder.ini, runs=[6])


def values_of(folder: Any, added: str) -> list[tuple[tuple[str, ...], int]]:
    """The values of the iteration variables, and the repetition, run by run."""
    folder.load(added)
    return [(tuple(each.iterations.values()), each.repetition) for each in load_scenarios(folder.ini)]


SPEED_AND_N = (
    "*.uavs[*].mobility.speed = ${speed=1,2}mps\n*.uavs[*].protocol.retries = ${n=3,4}\nrepeat = 2\n"
)


def test_the_first_variable_is_the_outermost_and_repetitions_are_the_innermost(folder: Any) -> None:
    assert values_of(folder, SPEED_AND_N)[:4] == [
        (("1", "3"), 0),
        (("1", "3"), 1),
        (("1", "4"), 0),
        (("1", "4"), 1),
    ]


@pytest.mark.parametrize(
    ("order", "runs"),
    [
        ("repetition, n", [(("3", "1"), 0), (("3", "2"), 0), (("4", "1"), 0)]),
        ("*, speed", [(("3", "1"), 0), (("3", "2"), 0), (("3", "1"), 1)]),
        ("n", [(("3", "1"), 0), (("3", "1"), 1), (("3", "2"), 0)]),
        ("repetition, *", [(("1", "3"), 0), (("1", "4"), 0), (("2", "3"), 0)]),
        ('"n,*,repetition"', [(("3", "1"), 0), (("3", "1"), 1), (("3", "2"), 0)]),
    ],
)
def test_another_nesting_order(folder: Any, order: str, runs: list[tuple[tuple[str, str], int]]) -> None:
    assert values_of(folder, f"{SPEED_AND_N}iteration-nesting-order = {order}\n")[:3] == runs


@pytest.mark.parametrize(
    ("order", "message"),
    [
        ("m", "there is no variable `m`; expected some of speed, n, repetition, * for the others"),
        ("speeed", "there is no variable `speeed`; expected some of speed, n, repetition, * for the others;"),
        ("n, n", "`n` stands there twice; expected each once"),
        ("*, n, *", "`*` stands there twice; expected each once"),
    ],
)
def test_a_wrong_nesting_order(folder: Any, order: str, message: str) -> None:
    assert message in folder.error(f"{SPEED_AND_N}iteration-nesting-order = {order}\n")


def test_a_variable_may_be_in_lock_step_with_the_repetitions(folder: Any) -> None:
    added = "*.uavs[*].mobility.speed = ${speed=5, 6, 7 ! repetition}mps\nrepeat = 3\n"
    assert values_of(folder, added) == [(("5",), 0), (("6",), 1), (("7",), 2)]


def test_a_constraint_may_ask_for_the_repetition(folder: Any) -> None:
    added = f"{SPEED_AND_N}constraint = $repetition < $speed\n"
    assert [repetition for _, repetition in values_of(folder, added)] == [0, 0, 0, 1, 0, 1]


def test_a_run_beyond_what_the_constraint_leaves(folder: Any) -> None:
    folder.load(f"{SPEED_AND_N}constraint = $n == 3\n")
    leaves = r"what the constraint leaves of 4 combinations of values, `repeat = 2`"
    with pytest.raises(ConfigError, match=rf"runs 0 to 3 \({leaves}\)$"):
        load_scenarios(folder.ini, runs=[4])
