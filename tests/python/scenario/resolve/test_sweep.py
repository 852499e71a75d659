import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from gradysim.scenario import load_scenarios
from gradysim.scenario.errors import ConfigError, ConfigErrors, Source
from gradysim.scenario.parse.ini import Entry
from gradysim.scenario.resolve.combinations import check_lock_step
from gradysim.scenario.resolve.sweep import (
    IterationVariable,
    depends_on_run,
    name_iterations,
    run_variables,
    substitute,
    text_of_iterations,
)


def entry(text: str, key: str = "*.x.label", line: int = 7) -> Entry:
    return Entry(key, text, Source(Path("a.ini"), line, key, text))


def named(*texts: str) -> tuple[list[str], list[IterationVariable]]:
    """Return the values of entries with different keys, from line 1 on, and their variables."""
    entries, variables = name_iterations(
        entry(text, f"**.p{line}", line) for line, text in enumerate(texts, start=1)
    )
    return [entry.text for entry in entries], variables


def values_of(text: str) -> tuple[str, ...]:
    (variable,) = named(text)[1]
    return variable.values


def error_of(*texts: str) -> ConfigError:
    with pytest.raises(ConfigError) as caught:
        check_lock_step(named(*texts)[1])
    return caught.value


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
    written = [entry("5"), entry("${x=1,2}", line=9), entry("${3,4}", "**.other")]
    entries, variables = name_iterations(written)
    assert [entry.text for entry in entries] == ["5", "${0}"]
    assert [variable.values for variable in variables] == [("3", "4")]


def test_the_variable_of_an_overridden_line_remains_for_others() -> None:
    written = [entry("5"), entry("${x=1,2}", line=9), entry("${x}", "**.other", 10)]
    entries, variables = name_iterations(written)
    assert [entry.text for entry in entries] == ["5", "${x}"]
    assert [variable.values for variable in variables] == [("1", "2")]


def test_another_value_of_a_variable_replaces_that_of_an_overridden_line() -> None:
    written = [entry("${x=5}"), entry("${x=1,2}", line=9), entry("${x}", "**.other", 10)]
    _, variables = name_iterations(written)
    assert [variable.values for variable in variables] == [("5",)]


def test_what_is_ignored_iterates_over_nothing() -> None:
    written = [entry("${x=1,2}", "*.visualizer.x"), entry("${unknown}", "result-dir")]
    assert name_iterations(written) == (written, [])


@pytest.mark.parametrize(
    "texts",
    [
        ["${1,2"],
        ["${1,${x}}"],
        ["${}"],
        ["${x=}"],
        ["${1,,2}"],
        ["${10m..60m}"],
        ["${3..1}"],
        ["${1..3 step 0}"],
        ["${0..1 step 1e-9}"],
        ["${0..1e999999 step 1e-9}"],
        ["${1e999999..1e999999}"],
        ["${1e-999999..1}"],
        ["${runnumber=1,2}"],
        ["${x=1,2}", "${x=3,4}"],
        ["${speed=1,2}", "${sped}"],
        ["${x=1,2,3}", "${4,5 ! x}"],
        ["${x=1,2 ! runnumber}"],
        ["${x=1,2 ! x}"],
        ["${1,2 ! y}"],
    ],
)
def test_mistakes(texts: list[str]) -> None:
    error = error_of(*texts)
    assert (error.line, error.key) == (len(texts), f"**.p{len(texts)}")


def test_a_variable_stands_inside_of_a_function() -> None:
    assert named("uniform(0s, ${1, 5}s)", '${"uniform(1)"}')[0] == ["uniform(0s, ${0}s)", "${1}"]


def test_the_text_of_a_combination() -> None:
    assert text_of_iterations({"x": "1", "speed": "5mps"}) == "$x=1, $speed=5mps"


def variables_of(
    config: str = "X", number: int = 0, repetition: int = 0, iterations: Mapping[str, str] | None = None
) -> dict[str, str]:
    return run_variables(Path("a.ini"), "Field", config, number, repetition, iterations or {})


def test_replaces_variables_also_in_texts() -> None:
    variables = variables_of("ZigZag5", 7, 3, {"x": "1", "0": "2s"})
    text = '"${configname} ${runnumber}#${repetition} ${x} ${0} (${iterationvars})"'
    assert substitute(entry(text), variables).text == '"ZigZag5 7#3 1 2s ($x=1, $0=2s)"'


def test_keeps_the_place() -> None:
    assert substitute(entry("${runnumber}"), variables_of(number=3)).source.line == 7


def test_knows_the_file_and_what_paths_begin_with() -> None:
    assert substitute(entry("${inifile}: ${network}.**"), variables_of()).text == "a.ini: Field.**"


@pytest.mark.parametrize(
    ("value", "written"),
    [
        (r'"c\"d"', "c#22d"),
        (r'"a\tb\\c"', "a#09b#5cc"),
        ('"a" + "b"', "#22a#22_+_#22b#22"),
    ],
)
def test_only_one_text_loses_its_quotes_in_names_of_files(value: str, written: str) -> None:
    assert variables_of(iterations={"x": value})["iterationvarsd"] == f"x={written}"


def test_writes_values_for_names_of_files() -> None:
    values = {"x": "1", "0": "2s", "q": '"a b/c:d\\""', "y": "é,*"}
    variables = variables_of(iterations=values)
    assert variables["iterationvarsf"] == "x=1,2s,q=a_b#2fc#3ad#22,y=#c3#a9,#2a-"
    assert variables["iterationvarsd"] == "x=1/2s/q=a_b#2fc#3ad#22/y=#c3#a9,#2a"
    assert variables_of()["iterationvarsf"] == variables_of()["iterationvarsd"] == ""


def test_a_variable_that_follows_from_the_value_itself_is_refused() -> None:
    with pytest.raises(ConfigError) as error:
        substitute(entry("${seedset}"), variables_of())
    assert error.value.line == 7


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("5", False),
        ("${configname}", False),
        ("${network} in ${inifile}", False),
        ("${seedset}", True),
        ("${experiment}", True),
        ("${runnumber}", True),
        ("${repetition}", True),
        ("${x}", True),
        ("${0}m", True),
    ],
)
def test_tells_what_differs_between_runs(text: str, expected: bool) -> None:
    assert depends_on_run(entry(text)) is expected


VARIABLES = ("seedset", "experiment", "measurement", "replication")


def error_at(folder: Any, added: str) -> ConfigError:
    """Return the error of the base with additional lines, which start at line 6."""
    with pytest.raises(ConfigError) as error:
        folder.load(added)
    return error.value


def variables(folder: Any, added: str = "") -> list[tuple[str, ...]]:
    folder.load(added)
    scenarios = load_scenarios(folder.ini)
    return [tuple(scenario.variables[name] for name in VARIABLES) for scenario in scenarios]


def test_what_they_are_unless_the_file_says_otherwise(folder: Any) -> None:
    assert variables(folder, "repeat = 2\n**.speed = ${v=3, 4}mps\n") == [
        ("0", "General", "$v=3", "#0"),
        ("1", "General", "$v=3", "#1"),
        ("2", "General", "$v=4", "#0"),
        ("3", "General", "$v=4", "#1"),
    ]


def test_labels_need_no_quotes_and_may_name_variables(folder: Any) -> None:
    added = """**.speed = ${v=3}mps
experiment-label = speeds of ${network}
measurement-label = "${experiment}: ${v}"
replication-label = seed ${seedset}
"""
    assert variables(folder, added) == [("0", "speeds of Network", "speeds of Network: 3", "seed 0")]


def test_the_seed_is_that_of_the_run(folder: Any) -> None:
    folder.load("seed-set = 7 + ${repetition}\n")
    assert load_scenarios(folder.ini)[0].variables["seedset"] == "7"
    assert load_scenarios(folder.ini, seed=40)[0].variables["seedset"] == "40"


@pytest.mark.parametrize(
    "line",
    [
        "seed-set = ${seedset}",
        "seed-set = ${replication}",
        "experiment-label = ${measurement}",
        'replication-label = "a ${replication}"',
    ],
)
def test_labels_and_seeds_do_not_depend_on_themselves(folder: Any, line: str) -> None:
    assert error_at(folder, f"{line}\n").key == line.partition(" ")[0]


def test_values_may_name_them(folder: Any) -> None:
    added = 'experiment-label = far\nseed-set = 5\n**.label = "${experiment} ${seedset}"\n'
    _, node, _ = folder.load(added).nodes
    assert node.protocol_parameters["label"] == "far 5"


def test_a_label_that_does_not_end_is_refused(folder: Any) -> None:
    assert error_at(folder, 'experiment-label = "a" b\n').key == "experiment-label"


def test_all_variables_that_are_not_understood_are_reported() -> None:
    for texts in (("${a=}", "${b=1..}", "${c}"), ("${a}", "${b=1 ! c}")):
        with pytest.raises(ConfigErrors) as caught:
            named(*texts)
        assert [error.line for error in caught.value.errors] == [1, 2]


@pytest.mark.parametrize(
    "texts",
    [
        ["${1..1000000, 1..1000000}"],
        [f"${{{'1' * 200}..{'1' * 193}9999999}}"],
        ["${" + ", ".join(["1" * 100_000] * 200) + "}"],
        ["${1}" * 1001],
    ],
)
def test_what_variables_stand_for_is_bounded(texts: list[str]) -> None:
    with pytest.raises(ConfigError) as caught:
        named(*texts)
    assert caught.value.line == 1


def test_so_is_what_a_value_becomes() -> None:
    with pytest.raises(ConfigError) as caught:
        substitute(entry("${a}" * 2000), {"a": "x" * 10_000})
    assert caught.value.line == 7


def test_a_long_number_takes_little_time() -> None:
    started_s = time.process_time()
    named(f"${{{'1' * 300_000}x, 2}}")
    assert time.process_time() - started_s < 5  # it took minutes
