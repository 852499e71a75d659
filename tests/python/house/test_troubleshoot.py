"""The commands of docs/how-to/troubleshoot.md in sh print what it shows; its messages are in the sources."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

PAGE = "docs/how-to/troubleshoot.md"


def test_its_command_checks_the_scenario(
    code_blocks: Callable[[str, str], list[str]],
    shell: Callable[[str, Path], str],
    shows: Callable[..., None],
    tmp_path: Path,
) -> None:
    shows(PAGE, shell(code_blocks(PAGE, "sh")[0], tmp_path), part=True)


def test_its_messages_are_those_of_the_program(root: Path) -> None:
    symptoms = re.findall(r"^\| ([^|]*) \|", (root / PAGE).read_text(encoding="utf-8"), re.MULTILINE)
    messages = [text for symptom in symptoms for text in re.findall(r"`([^`]+)`", symptom)]
    files = [*(root / "python/gradysim").rglob("*.py"), *(root / "cpp").rglob("*.cpp")]
    source = "".join(file.read_text(encoding="utf-8") for file in files)
    assert len(messages) > 8
    assert [text for text in messages if text not in source and text.replace(" ", "_") not in source] == []
