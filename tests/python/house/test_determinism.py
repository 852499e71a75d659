"""The output in docs/explanation/determinism.md is the output of the commands."""

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
