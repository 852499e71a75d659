"""Every Python snippet of the documents runs, and each document with snippets has its own test."""

import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

_ROOT = Path(__file__).parents[3]

SAVED_AS = {
    f"docs/how-to/{page}.md": "climber"
    for page in (
        "check-a-run-with-assertions",
        "model-a-battery",
        "use-the-visualization-handler",
        "write-a-handler",
    )
}
"""Documents whose second snippet is a file that the others import."""

NEEDS_AN_AUTOPILOT = {"docs/how-to/fly-with-ardupilot.md"}
"""Documents whose main program flies an autopilot. Only their definitions run here.

tests/python/house/test_fly_with_ardupilot.py flies it with a toy. tests/python/sitl/test_real_autopilot.py
flies with real ones.
"""


DOCUMENTS = [*sorted(_ROOT.glob("*.md")), *sorted((_ROOT / "docs").rglob("*.md"))]


def snippets() -> list[tuple[str, int]]:
    """Return the document and the number of each Python snippet."""
    return [
        (str(file.relative_to(_ROOT)), number) for file in DOCUMENTS for number in range(len(programs(file)))
    ]


def programs(document: Path) -> list[str]:
    """Return the Python snippets of a document."""
    return re.findall(r"^```python\n(.*?)^```", document.read_text(), re.MULTILINE | re.DOTALL)


def languages(document: Path) -> set[str]:
    """Return the languages of the document's snippets that can run."""
    found = re.findall(r"^ *```(\w+)$", document.read_text(), re.MULTILINE)
    return {language for language in found if language in ("python", "ini", "sh", "bash", "console")}


def is_test(file: Path) -> bool:
    """Return whether it may be a document's own test, unlike this file."""
    return file.name.startswith("test_") and file.name != Path(__file__).name


def test_a_test_runs_them(root: Path, project_files: Callable[..., list[Path]]) -> None:
    tests = [(root / file).read_text() for file in project_files(".py") if is_test(file)]
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


@pytest.mark.parametrize(("document", "number"), snippets())
def test_a_snippet_runs(document: str, number: int, clone: Path) -> None:
    """The snippet runs after those before it on the page, as in one file."""
    texts = programs(_ROOT / document)
    if document in SAVED_AS:
        (clone / f"{SAVED_AS[document]}.py").write_text(texts.pop(1))
        number = min(number, len(texts) - 1)
    texts = texts[: number + 1]
    (clone / "page.py").write_text("\n\n".join(texts))
    command = ["-c", "import page"] if document in NEEDS_AN_AUTOPILOT else ["page.py"]
    done = subprocess.run(
        [sys.executable, "-W", "error", *command],
        cwd=clone,
        env={**os.environ, "PYTHONPATH": str(_ROOT / "python")},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr


def test_all_snippets_are_found() -> None:
    """Indented snippets, or those with another spelling of the language, would be skipped."""
    text = "".join(file.read_text() for file in DOCUMENTS)
    assert len(re.findall(r"```\s*py", text, re.IGNORECASE)) == len(snippets())
