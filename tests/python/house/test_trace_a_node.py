"""The output in docs/how-to/trace-a-node.md is the output of the first command."""

from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

GUIDE = "docs/how-to/trace-a-node.md"


def test_the_trace_is_the_one_that_is_shown(
    code_blocks: Callable[[str, str], list[str]],
    shell: Callable[[str, Path], str],
    shows: Callable[..., None],
    tmp_path: Path,
) -> None:
    for language, name in [("python", "hello.py"), ("ini", "hello.ini")]:
        (tmp_path / name).write_text(code_blocks("docs/reference/example.md", language)[0], encoding="utf-8")
    shows(GUIDE, shell(code_blocks(GUIDE, "sh")[0], tmp_path), part=True)
