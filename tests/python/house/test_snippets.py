"""Every document in README.md and docs/ that has snippets has a test that reads all kinds of them."""

import re
from collections.abc import Callable
from pathlib import Path


def languages(document: Path) -> set[str]:
    """The languages of the document's snippets that can be run."""
    found = re.findall(r"^ *```(\w+)$", document.read_text(), re.MULTILINE)
    return {language for language in found if language in ("python", "ini", "sh", "bash", "console")}


def test_a_test_runs_them(root: Path, project_files: Callable[..., list[Path]]) -> None:
    tests = [(root / file).read_text() for file in project_files(".py") if file.name.startswith("test_")]
    documents = {str(file): languages(root / file) for file in project_files(".md")}
    missing = {
        (document, language)
        for document, found in documents.items()
        for language in found
        if not any(
            document in text.replace('" / "', "/") and re.search(rf"\b{language}\b", text) for text in tests
        )
    }
    assert any(documents.values())
    assert missing == set()
