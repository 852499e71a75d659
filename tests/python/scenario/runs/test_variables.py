from collections.abc import Mapping
from pathlib import Path

import pytest

from gradysim.scenario.errors.config_error import ConfigError
from gradysim.scenario.errors.source import Source
from gradysim.scenario.file.reader import Entry
from gradysim.scenario.sweep import depends_on_run, run_variables, substitute


def entry(text: str) -> Entry:
    return Entry("*.x.label", text, Source(Path("a.ini"), 7, "*.x.label", text), "General")


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
    with pytest.raises(ConfigError, match=r"^a.ini:7: .*: `\$\{seedset\}` follows from this value"):
        substitute(entry("${seedset}"), variables_of())


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
