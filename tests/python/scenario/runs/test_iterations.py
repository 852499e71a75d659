from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.scenario.errors.config_error import ConfigError
from gradysim.scenario.errors.source import Source
from gradysim.scenario.file.reader import Entry
from gradysim.scenario.sweep import (
    IterationVariable,
    check_lock_step,
    combinations,
    count_combinations,
    name_iterations,
    text_of_iterations,
)


def entry(text: str, key: str = "*.x.label", line: int = 7) -> Entry:
    return Entry(key, text, Source(Path("a.ini"), line, key, text), "General")


def named(*texts: str) -> tuple[list[str], list[IterationVariable]]:
    """Entries of different keys, from line 1 on: their texts afterwards, and the variables."""
    ranked = [(1, entry(text, f"**.p{line}", line)) for line, text in enumerate(texts, start=1)]
    entries, variables = name_iterations(ranked)
    return [entry.text for _, entry in entries], variables


def values_of(text: str) -> tuple[str, ...]:
    (variable,) = named(text)[1]
    return variable.values


def error_of(*texts: str) -> str:
    with pytest.raises(ConfigError) as caught:
        check_lock_step(named(*texts)[1])
    return str(caught.value)


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("${1,2}", ("1", "2")),
        ("${ 10ms , 1h 5min }", ("10ms", "1h 5min")),
        ("${x=1}", ("1",)),
        ('${x="a,b", "c"}', ('"a,b"', '"c"')),
        (r'${"a\"b,", c}', (r'"a\"b,"', "c")),
        ('${"(", ":)"}', ('"("', '":)"')),
        ("${(1, 2), [3, 4]}", ("(1, 2)", "[3, 4]")),
        (r"${a\,b, c\}}", ("a,b", "c}")),
        ("${1..4}", ("1", "2", "3", "4")),
        ("${0..10 step 5, 100}", ("0", "5", "10", "100")),
        ("${0 .. 0.3 step 0.1}", ("0", "0.1", "0.2", "0.3")),
        ("${3..1 step -1}", ("3", "2", "1")),
        ("${-1..1}", ("-1", "0", "1")),
        ("${1e-3..2e-3 step 1e-3}", ("0.001", "0.002")),
        ("${100..300 step 100}", ("100", "200", "300")),
        ("${1..4 step 2}", ("1", "3")),
    ],
)
def test_the_values_of_a_variable(text: str, values: tuple[str, ...]) -> None:
    assert values_of(text) == values


def test_names_are_left_in_the_place_of_values() -> None:
    texts, variables = named("${x=1,2}m", '"${x}-${a, b}-${ configname }"', "${3..4}")
    assert texts == ["${x}m", '"${x}-${0}-${configname}"', "${1}"]
    assert [variable.name for variable in variables] == ["x", "0", "1"]


def test_a_variable_may_be_used_above_the_line_with_its_values() -> None:
    assert named("${x}", "${x=1,2}")[0] == ["${x}", "${x}"]


def test_a_line_that_another_one_overrides_iterates_over_nothing() -> None:
    ranked = [(0, entry("5")), (1, entry("${x=1,2}", line=9)), (1, entry("${3,4}", "**.other"))]
    entries, variables = name_iterations(ranked)
    assert [entry.text for _, entry in entries] == ["5", "${0}"]
    assert [variable.values for variable in variables] == [("3", "4")]


def test_who_needs_the_variable_of_an_overridden_line_is_told_where_it_is() -> None:
    ranked = [(0, entry("5")), (1, entry("${x=1,2}", line=9)), (1, entry("${x}", "**.other", 10))]
    with pytest.raises(ConfigError) as caught:
        name_iterations(ranked)
    assert str(caught.value) == (
        "a.ini:10: **.other = ${x}: `x` has its values at a.ini:9, which another value of `*.x.label`"
        " overrides; expected a value here that does without it, or `${x=...}` there"
    )


def test_what_is_ignored_iterates_over_nothing() -> None:
    ranked = [(1, entry("${x=1,2}", "*.visualizer.x")), (1, entry("${unknown}", "result-dir"))]
    assert name_iterations(ranked) == (ranked, [])


@pytest.mark.parametrize(
    ("texts", "message"),
    [
        (["${1,2"], "`${` is not closed; expected a `}`"),
        (["${1,${x}}"], "a variable stands inside of another one; expected none there"),
        (["${}"], "a value of `${...}` is empty; expected a list such as `${x=1, 2, 5}`"),
        (["${x=}"], "a value of `${...}` is empty; expected a list such as `${x=1, 2, 5}`"),
        (["${1,,2}"], "a value of `${...}` is empty; expected a list such as `${x=1, 2, 5}`"),
        (
            ["${10m..60m}"],
            "`10m..60m` is no range; expected plain numbers, and the unit behind the brace:"
            " `${10..60 step 10}m`",
        ),
        (
            ["${3..1}"],
            "`3..1` has no values; expected a step that leads from the first to the last",
        ),
        (
            ["${1..3 step 0}"],
            "`1..3 step 0` has no values; expected a step that leads from the first to the last",
        ),
        (["${0..1 step 1e-9}"], "`0..1 step 1e-9` has too many values; expected at most 1000000"),
        (
            ["${0..1e999999 step 1e-9}"],
            "`0..1e999999 step 1e-9` is out of range; expected numbers of at most 300 digits",
        ),
        (
            ["${1e999999..1e999999}"],
            "`1e999999..1e999999` is out of range; expected numbers of at most 300 digits",
        ),
        (["${1e-999999..1}"], "`1e-999999..1` is out of range; expected numbers of at most 300 digits"),
        (
            ["${runnumber=1,2}"],
            "`${runnumber}` is there in every run; expected another name",
        ),
        (
            ["${x=1,2}", "${x=3,4}"],
            "`x` has its values at line 1 already; expected `${x}` here",
        ),
        (
            ["${speed=1,2}", "${sped}"],
            "there is no variable `sped`; expected one of `${speed}`, `${runnumber}`, `${repetition}`,"
            " `${configname}`, `${iterationvars}`, `${iterationvarsf}`, `${iterationvarsd}`, `${seedset}`,"
            " `${experiment}`, `${measurement}`, `${replication}`, `${inifile}`, `${network}`, or values such"
            " as `${sped=1, 2, 5}`; did you mean `speed`?",
        ),
        (
            ["${x=1,2}", "${3,4,5 ! x}"],
            "it has 3 values and is in lock-step with `x`, which has 2; expected as many",
        ),
        (
            ["${x=1,2 ! runnumber}"],
            "`runnumber` has no list of values; expected `repetition` or one that has",
        ),
        (["${x=1,2 ! x}"], "`x` is in lock-step with itself; expected no circle"),
    ],
)
def test_mistakes(texts: list[str], message: str) -> None:
    wrong = len(texts)
    assert error_of(*texts) == f"a.ini:{wrong}: **.p{wrong} = {texts[-1]}: {message}"


def test_a_lock_step_with_nobody() -> None:
    assert "a.ini:1: **.p1 = ${1,2 ! y}: there is no variable `y`" in error_of("${1,2 ! y}")


def test_the_variable_that_is_written_first_changes_slowest() -> None:
    variables = named("${x=1,2}", "${a, b}")[1]
    assert list(combinations(variables)) == [
        {"x": "1", "0": "a"},
        {"x": "1", "0": "b"},
        {"x": "2", "0": "a"},
        {"x": "2", "0": "b"},
    ]


def test_a_function_that_draws_is_no_value() -> None:
    assert error_of("${1s, uniform(0s, 5s)}") == (
        "a.ini:1: **.p1 = ${1s, uniform(0s, 5s)}: `uniform` draws the value of one parameter, and a value of"
        " `${...}` is for a whole run; expected the variable inside of the function: `uniform(0s, ${1, 5}s)`"
    )


def test_a_variable_stands_inside_of_a_function() -> None:
    assert named("uniform(0s, ${1, 5}s)", '${"uniform(1)"}')[0] == ["uniform(0s, ${0}s)", "${1}"]


def test_variables_in_lock_step_change_together() -> None:
    variables = named("${10s, 20s ! x}", "${x=1,2}", "${y=a, b ! x}")[1]
    assert list(combinations(variables)) == [
        {"0": "10s", "x": "1", "y": "a"},
        {"0": "20s", "x": "2", "y": "b"},
    ]


def test_without_variables_there_is_one_combination() -> None:
    assert (list(combinations([])), count_combinations([])) == ([{}], 1)


def test_too_many_combinations_are_refused_before_they_are_made() -> None:
    variables = named("${1..1000}", "${1..1000}", "${1..1000}")[1]
    with pytest.raises(ConfigError, match="more than 1000000 combinations of values; expected fewer"):
        count_combinations(variables)


@given(st.lists(st.integers(1, 4), max_size=4))
def test_each_combination_is_there_once(lengths: list[int]) -> None:
    variables = named(*(f"${{1..{length}}}" for length in lengths))[1]
    found = [tuple(values.values()) for values in combinations(variables)]
    assert len(found) == len(set(found)) == count_combinations(variables)
    assert found == sorted(found)


def test_the_text_of_a_combination() -> None:
    assert text_of_iterations({"x": "1", "speed": "5mps"}) == "$x=1, $speed=5mps"
