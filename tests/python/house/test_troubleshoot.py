"""The messages in docs/how-to/troubleshoot.md are in the sources."""

import re
from pathlib import Path

PAGE = "docs/how-to/troubleshoot.md"


def test_its_messages_are_those_of_the_program(root: Path) -> None:
    symptoms = re.findall(r"^\| ([^|]*) \|", (root / PAGE).read_text(encoding="utf-8"), re.MULTILINE)
    messages = [text for symptom in symptoms for text in re.findall(r"`([^`]+)`", symptom)]
    files = [*(root / "python/gradysim").rglob("*.py"), *(root / "cpp").rglob("*.cpp")]
    source = "".join(file.read_text(encoding="utf-8") for file in files)
    assert len(messages) > 8
    assert [text for text in messages if text not in source and text.replace(" ", "_") not in source] == []
