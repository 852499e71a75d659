"""The output in docs/explanation/determinism.md is the output of the commands."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

PAGE = "docs/explanation/determinism.md"


@pytest.mark.verify
@pytest.mark.parametrize("number", [0, 1])
def test_the_output_is_the_one_that_is_shown(
    root: Path,
    code_blocks: Callable[[str, str], list[str]],
    shell: Callable[[str, Path], str],
    shows: Callable[..., None],
    number: int,
) -> None:
    shows(PAGE, shell(code_blocks(PAGE, "sh")[number], root), number)


def test_it_names_the_purposes_of_streams(root: Path) -> None:
    page = (root / PAGE).read_text(encoding="utf-8")
    streams = (root / "cpp/netsim/kernel/random.hpp").read_text(encoding="utf-8")
    purposes = re.findall(r"^    (\w+) = \d+,", streams, re.MULTILINE)
    words = {"csma_backoff": "backoff", "parameter": "values", "position_error": "position errors"}
    (sentence,) = re.findall(r"Purposes are (.*?)\.\n", page, re.DOTALL)
    assert len(purposes) > 8
    assert [each for each in purposes if words.get(each, each.replace("_", " ")) not in sentence] == []
