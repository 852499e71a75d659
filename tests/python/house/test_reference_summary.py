"""docs/reference/summary.md explains what `gradysim run` prints."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

from gradysim.cli.summary import MAX_ROWS
from gradysim.integrated.run import run
from gradysim.scenario import load_scenarios

PAGE = "docs/reference/summary.md"


@pytest.fixture
def file(code_blocks: Callable[[str, str], list[str]], tmp_path: Path) -> Path:
    """Return the .ini file of the example."""
    for language, name in [("python", "hello.py"), ("ini", "hello.ini")]:
        block = code_blocks("docs/reference/example.md", language)[0]
        (tmp_path / name).write_text(block, encoding="utf-8")
    return tmp_path / "hello.ini"


def test_it_shows_a_summary(
    file: Path, shell: Callable[[str, Path], str], shows: Callable[..., None]
) -> None:
    shows(PAGE, shell("gradysim run hello.ini -c Jittered", file.parent), changing=True)


def test_it_explains_every_outcome(root: Path, file: Path) -> None:
    text = " ".join((root / PAGE).read_text().split())
    outcomes = run(load_scenarios(file)[0]).outcomes
    names = {
        outcome.replace("_", " ")
        for kinds in outcomes.values()
        for counts in kinds.values()
        for outcome in counts
    }
    columns = {word for kinds in outcomes.values() for kind in kinds for word in kind.split()}
    assert {name for name in names if name not in text} == set()
    assert columns - {"broadcast"} <= set(re.findall(r"\w+", text))


def test_the_number_of_rows_is_that_of_the_summary(root: Path) -> None:
    assert f"If there are more than {MAX_ROWS} nodes" in (root / PAGE).read_text()
