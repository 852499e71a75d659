"""What docs/how-to/make-tables.md shows is what its python function returns to its command."""

from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

GUIDE = "docs/how-to/make-tables.md"


def test_its_columns_are_those_that_are_shown(
    code_blocks: Callable[[str, str], list[str]],
    shell: Callable[[str, Path], str],
    saved: Callable[..., Path],
    shows: Callable[..., None],
) -> None:
    (commands,) = code_blocks(GUIDE, "sh")
    shows(GUIDE, shell(commands, saved(GUIDE, python="tables.py")), part=True)
