from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.scenario.errors import ConfigError, Source
from gradysim.scenario.parse.ini import Entry
from gradysim.scenario.resolve.combinations import (
    Combinations,
    Constraint,
    check_lock_step,
    count_combinations,
)
from gradysim.scenario.resolve.sweep import IterationVariable, name_iterations


def variables_of(*texts: str) -> list[IterationVariable]:
    """Return the variables of entries with different keys, from line 1 on."""
    keys = [f"**.p{line}" for line in range(1, len(texts) + 1)]
    return name_iterations(
        Entry(key, text, Source(Path("a.ini"), line, key, text))
        for line, (key, text) in enumerate(zip(keys, texts, strict=True), start=1)
    )[1]


def test_the_variable_that_is_written_first_changes_slowest() -> None:
    variables = variables_of("${x=1,2}", "${a, b}")
    assert list(Combinations(variables)) == [
        {"x": "1", "0": "a"},
        {"x": "1", "0": "b"},
        {"x": "2", "0": "a"},
        {"x": "2", "0": "b"},
    ]


def test_variables_in_lock_step_change_together() -> None:
    variables = variables_of("${10s, 20s ! x}", "${x=1,2}", "${y=a, b ! x}")
    assert list(Combinations(variables)) == [
        {"0": "10s", "x": "1", "y": "a"},
        {"0": "20s", "x": "2", "y": "b"},
    ]


def test_values_that_the_partner_does_not_reach_are_not_used() -> None:
    variables = variables_of("${x=1,2}", "${y=a, b, c ! x}", "${10s, 20s, 30s ! y}")
    check_lock_step(variables)
    assert list(Combinations(variables)) == [
        {"x": "1", "y": "a", "0": "10s"},
        {"x": "2", "y": "b", "0": "20s"},
    ]


def test_without_variables_there_is_one_combination() -> None:
    assert (list(Combinations([])), count_combinations([])) == ([{}], 1)


def test_too_many_combinations_are_refused_before_they_are_made() -> None:
    variables = variables_of("${1..1000}", "${1..1000}", "${1..1000}")
    with pytest.raises(ConfigError) as error:
        count_combinations(variables)
    assert error.value.line == 3


@given(st.lists(st.integers(1, 4), max_size=4))
def test_each_combination_is_there_once(lengths: list[int]) -> None:
    variables = variables_of(*(f"${{1..{length}}}" for length in lengths))
    found = [tuple(values.values()) for values in Combinations(variables)]
    assert len(found) == len(set(found)) == count_combinations(variables)
    assert found == sorted(found)


VALUES = {"x": "3", "y": "4", "t": "10ms", "p": "-80dBm", "name": '"a"', "0": "7"}


def constraint(text: str) -> Entry:
    return Entry("constraint", text, Source(Path("a.ini"), 7, "constraint", text))


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("$x < $y", True),
        ("$x > $y", False),
        ("$x <= 3", True),
        ("$x >= 3.5", False),
        ("${x} * ${ y } == 12", True),
        ("$x != $y", True),
        ("$t < 1s", True),
        ("$t == 0.01s", True),
        ("$p < -70dBm", True),
        ('$name == "a"', True),
        ('$name != "(a"', True),
        ("($x + 1) * 2 == 8", True),
        ("$0 == 7", True),
        ("$x > $y || $t < 1s", True),
        ("$x < $y && $t > 1s", False),
        ("$x == 3 || $x == 4 && $y == 5", True),
        ('"$x < $y"', True),
        ('""', True),
        ("($x < 3 || $y > 3) && !($x == $y)", True),
        ("$x % 2 == 0", False),
        ('$name =~ "b*"', False),
        ('"a" == "b"', False),
    ],
)
def test_constraints(text: str, expected: bool) -> None:
    assert Constraint(constraint(text)).holds(VALUES) is expected


@pytest.mark.parametrize(
    "text",
    [
        "$z < 3",
        "$x",
        "1 < $x < 5",
        "$x < $t",
        "$x < 10mW",
        "$t < 10mW",
        "$x = 3",
        "$x > 1 and $y > 1",
        "$x > 1 or $y > 1",
        "$x > 1 &&",
        "($x > 1",
        "$x == $name",
    ],
)
def test_wrong_constraints(text: str) -> None:
    with pytest.raises(ConfigError) as error:
        Constraint(constraint(text)).holds(VALUES)
    assert (error.value.line, error.value.key) == (7, "constraint")


def test_a_place_has_the_same_value_wherever_the_strides_of_its_variable_agree() -> None:
    variables = variables_of("${x=1..3}", "${y=a, b}", "${z=5..7 ! x}", "${only=1}")
    found = Combinations(variables)
    assert found.strides(["x"]) == found.strides(["z", "only"]) == [(2, 3)]
    for names in (["x"], ["y"], ["x", "y"]):
        by_digits: dict[tuple[int, ...], set[tuple[str, ...]]] = {}
        for place, values in enumerate(found):
            digits = tuple(place // stride % size for stride, size in found.strides(names))
            by_digits.setdefault(digits, set()).add(tuple(values[name] for name in names))
        assert [len(values) for values in by_digits.values()] == [1] * len(set().union(*by_digits.values()))
