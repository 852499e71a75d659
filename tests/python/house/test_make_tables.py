"""What docs/how-to/make-tables.md shows is what its python function returns."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gradysim._netsim")

GUIDE = "docs/how-to/make-tables.md"


def test_its_columns_are_those_that_are_shown(
    code_blocks: Callable[[str, str], list[str]], shell: Callable[[str, Path], str], tmp_path: Path
) -> None:
    (commands,), (shown,) = code_blocks(GUIDE, "sh"), code_blocks(GUIDE, "text")
    shell(commands, tmp_path)
    names: dict[str, Any] = {}
    exec(code_blocks(GUIDE, "python")[0], names)
    columns = names["heard"](str(tmp_path / "results"))
    assert [f"{name} {values}" for name, values in columns.items()] == shown.splitlines()
