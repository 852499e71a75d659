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


def test_every_decision_has_its_date_and_those_that_changed_it(root: Path) -> None:
    pages = sorted((root / "docs/decisions").glob("[0-9]*.md"))
    since = {page.name: re.findall(r"^\*\*Since\.\*\* .*$", page.read_text(), re.MULTILINE) for page in pages}
    assert {name: lines for name, lines in since.items() if len(lines) != 1} == {}
    date = {name: re.findall(r"\d{4}-\d\d-\d\d", line)[0] for name, (line,) in since.items()}
    for name, (line,) in since.items():
        later = re.findall(r"(?:Changed|Superseded.*?) on (\S+|the same day) by \[[^]]*\]\((\S+)\)", line)
        assert len(later) == line.count("](")
        for day, by in later:
            assert by > name
            assert date[by] <= (date[name] if day == "the same day" else day), name
