"""Rules for every file of the project."""

import re
from collections.abc import Callable
from pathlib import Path

ProjectFiles = Callable[..., list[Path]]

# Directory of one machine, except home directories of the container's user and of the examples.
MACHINE_PATH = re.compile(r"(?<![\w.~/}*)-])/(?:work|root|Users|mnt|home/(?!(?:gradysim|user)\b)\w+)/\w")
VAGUE_NAMES = {"utils", "util", "helpers", "helper", "common", "misc"}


def text_of(file: Path) -> str:
    """Return the text of the file; empty for a binary file."""
    try:
        return file.read_text()
    except UnicodeDecodeError:
        return ""


def test_no_file_names_a_folder_of_one_machine(root: Path, project_files: ProjectFiles) -> None:
    offenders = [
        f"{file}:{number}: {line.strip()}"
        for file in project_files()
        for number, line in enumerate(text_of(root / file).splitlines(), start=1)
        if MACHINE_PATH.search(line)
    ]
    assert offenders == []


def test_no_file_has_a_vague_name(project_files: ProjectFiles) -> None:
    offenders = [str(file) for file in project_files() if VAGUE_NAMES & {*file.parts, file.stem}]
    assert offenders == []


def test_relative_links_of_documents_lead_somewhere(root: Path, project_files: ProjectFiles) -> None:
    link = re.compile(r"\]\((?!\w+:|#)([^)\s#]+)(?:#[^)]*)?\)")
    offenders = [
        f"{file} links to {target}"
        for file in project_files(".md")
        for target in link.findall((root / file).read_text())
        if not (root / file.parent / target).exists()
    ]
    assert offenders == []


def test_every_decision_is_listed(root: Path, project_files: ProjectFiles) -> None:
    folder = Path("docs/decisions")
    index = (root / folder / "README.md").read_text()
    pages = [file for file in project_files(".md") if file.parent == folder and file.name != "README.md"]
    assert pages
    assert [page.name for page in pages if f"({page.name})" not in index] == []
