from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.scenario.errors.config_error import ConfigError
from gradysim.scenario.errors.source import Source
from gradysim.scenario.runs import select_runs, text_of_runs

SOURCE = Source(Path("a.ini"), 3)


@pytest.mark.parametrize(
    ("runs", "expected"),
    [
        (None, [0, 1, 2, 3, 4]),
        ("0", [0]),
        ("3,1", [1, 3]),
        ("1..3", [1, 2, 3]),
        ("1-3", [1, 2, 3]),
        (" 0 , 2 .. 4 ", [0, 2, 3, 4]),
        ("2,1..3", [1, 2, 3]),
        ([4, 0, 4], [0, 4]),
    ],
)
def test_selects(runs: str | list[int] | None, expected: list[int]) -> None:
    assert select_runs(runs, 5, "X", SOURCE) == expected


@pytest.mark.parametrize("runs", ["", "a", "1,,2", "3..1", "-1", "1.5"])
def test_texts_that_are_no_runs(runs: str) -> None:
    with pytest.raises(ConfigError) as caught:
        select_runs(runs, 5, "X", SOURCE)
    assert str(caught.value) == f"runs = {runs}: expected numbers of runs and ranges such as `0,2,5..9`"


@pytest.mark.parametrize("runs", [3, [0.5], ["0"]])
def test_what_are_no_numbers_of_runs(runs: Any) -> None:
    with pytest.raises(TypeError) as caught:
        select_runs(runs, 5, "X", SOURCE)
    assert str(caught.value) == f"runs = {runs!r}: expected numbers of runs, such as [0, 2]"


@pytest.mark.parametrize(("runs", "run"), [("5", 5), ("2..7", 7), ([-1], -1)])
def test_runs_that_do_not_exist(runs: str | list[int], run: int) -> None:
    with pytest.raises(ConfigError) as caught:
        select_runs(runs, 5, "X", SOURCE)
    assert (
        str(caught.value)
        == f"a.ini:3: configuration `X` has no run {run}; expected runs 0 to 4 (`repeat = 5`)"
    )


def test_a_range_of_any_size_is_refused_at_once() -> None:
    with pytest.raises(ConfigError, match="has no run 999999999"):
        select_runs("0..999999999", 5, "X", SOURCE)


@pytest.mark.parametrize(
    ("numbers", "text"), [([3], "3"), ([0, 1], "0..1"), ([0, 2, 5, 6, 7, 9], "0,2,5..7,9")]
)
def test_the_text_of_runs(numbers: list[int], text: str) -> None:
    assert text_of_runs(numbers) == text


@given(st.sets(st.integers(0, 30), min_size=1))
def test_the_text_of_runs_selects_them(numbers: set[int]) -> None:
    assert select_runs(text_of_runs(sorted(numbers)), 31, "X", SOURCE) == sorted(numbers)
