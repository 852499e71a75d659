from pathlib import Path

import pytest

from gradysim.config.errors.source import Source
from gradysim.config.file.reader import Entry
from gradysim.config.runs.variables import depends_on_run, run_variables, substitute


def entry(text: str) -> Entry:
    return Entry("*.x.label", text, Source(Path("a.ini"), 7, "*.x.label", text), "General")


def test_replaces_variables_also_in_texts() -> None:
    variables = run_variables("ZigZag5", 7, 3, {"x": "1", "0": "2s"})
    text = '"${configname} ${runnumber}#${repetition} ${x} ${0} (${iterationvars})"'
    assert substitute(entry(text), variables).text == '"ZigZag5 7#3 1 2s ($x=1, $0=2s)"'


def test_keeps_the_place() -> None:
    assert substitute(entry("${runnumber}"), run_variables("X", 3, 3, {})).source.line == 7


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("5", False),
        ("${configname}", False),
        ("${runnumber}", True),
        ("${repetition}", True),
        ("${x}", True),
        ("${0}m", True),
    ],
)
def test_tells_what_differs_between_runs(text: str, expected: bool) -> None:
    assert depends_on_run(entry(text)) is expected
