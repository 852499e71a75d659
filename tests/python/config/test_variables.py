from pathlib import Path

import pytest

from gradysim.config.error import ConfigError
from gradysim.config.reader import Entry
from gradysim.config.source import Source
from gradysim.config.variables import depends_on_run, run_variables, substitute


def entry(text: str) -> Entry:
    return Entry("*.x.label", text, Source(Path("a.ini"), 7, "*.x.label", text), "General")


def test_replaces_predefined_variables_also_in_texts() -> None:
    variables = run_variables("ZigZag5", 3)
    assert (
        substitute(entry('"${configname} ${ runnumber }#${repetition}"'), variables).text == '"ZigZag5 3#3"'
    )


def test_keeps_the_place() -> None:
    assert substitute(entry("${runnumber}"), run_variables("X", 3)).source.line == 7


@pytest.mark.parametrize("variable", ["${1,2}", "${x=1,2}", "${x}", "${0..10 step 2}"])
def test_iteration_variables_are_errors(variable: str) -> None:
    with pytest.raises(ConfigError) as caught:
        substitute(entry(f"{variable}mps"), run_variables("X", 0))
    assert str(caught.value) == (
        f"a.ini:7: *.x.label = {variable}mps: iteration variables (`{variable}`) are not supported; "
        "expected one value, or `${runnumber}` or `${repetition}` or `${configname}`"
    )


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("5", False),
        ("${configname}", False),
        ("${runnumber}", True),
        ("${repetition}", True),
    ],
)
def test_tells_what_differs_between_runs(text: str, expected: bool) -> None:
    assert depends_on_run(entry(text)) is expected
