"""The commands of pages print what is shown, where they need only an empty directory or the project."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gradysim._netsim")

SLOW = pytest.mark.verify

PAGES = [
    ("docs/how-to/come-from-ns3-or-inet.md", 0, "empty", {"part": True}),
    ("docs/how-to/find-lost-frames.md", 0, "empty", {"part": True}),
    ("docs/how-to/let-clocks-drift.md", 0, "empty", {"part": True}),
    ("docs/how-to/troubleshoot.md", 0, "empty", {"part": True}),
    ("docs/how-to/behave-as-ns3-or-inet.md", 0, "project", {"part": True}),
    ("docs/how-to/trace-a-node.md", 1, "project", {}),
    pytest.param("docs/explanation/determinism.md", 0, "project", {}, marks=SLOW),
    pytest.param("docs/explanation/determinism.md", 1, "project", {}, marks=SLOW),
]
"""A page, the index of its blocks of commands and output, where they run, and how they are compared."""


@pytest.mark.parametrize(("page", "number", "where", "how"), PAGES)
def test_what_is_printed(
    root: Path,
    tmp_path: Path,
    code_blocks: Callable[[str, str], list[str]],
    shell: Callable[[str, Path], str],
    shows: Callable[..., None],
    page: str,
    number: int,
    where: str,
    how: dict[str, Any],
) -> None:
    folder = root if where == "project" else tmp_path
    shows(page, shell(code_blocks(page, "sh")[number], folder), number, **how)
