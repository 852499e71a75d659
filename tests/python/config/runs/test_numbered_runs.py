from typing import Any

import pytest

from gradysim.config.errors.config_error import ConfigError
from gradysim.config.scenario import load_scenarios


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
