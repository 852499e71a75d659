"""Metadata of the distribution."""

import re
import shutil
import tarfile
import tomllib
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gradysim.cli import examples


@pytest.fixture
def project(root: Path) -> dict[str, Any]:
    with (root / "pyproject.toml").open("rb") as file:
        return tomllib.load(file)


def test_the_changelog_opens_with_the_next_version(root: Path, project: dict[str, Any]) -> None:
    headings = re.findall(r"^## (.+)$", (root / "CHANGELOG.md").read_text(), re.MULTILINE)
    version = project["tool"]["vcs-versioning"]["fallback_version"].removesuffix(".dev0")
    assert re.fullmatch(rf"Unreleased \({version}\)|{version} \(\d{{4}}-\d\d-\d\d\)", headings[0])


def test_the_licence_is_mit(root: Path, project: dict[str, Any]) -> None:
    assert project["project"]["license"] == "MIT"
    assert (root / "LICENSE").read_text().startswith("MIT License")


def test_the_authors_are_those_of_the_licence(root: Path, project: dict[str, Any]) -> None:
    (author,) = project["project"]["authors"]
    assert re.findall(r"^Copyright \(c\) \d+ (.+)$", (root / "LICENSE").read_text(), re.MULTILINE) == [
        author["name"]
    ]


def test_the_citation_names_the_authors_and_the_licence(root: Path, project: dict[str, Any]) -> None:
    citation = (root / "CITATION.cff").read_text()
    assert re.findall(r"^authors:\n((?:  .+\n)+)", citation, re.MULTILINE) == [
        f"  - name: {author['name']}\n" for author in project["project"]["authors"]
    ]
    assert f"\nlicense: {project['project']['license']}\n" in citation


def test_the_source_distribution_leaves_out_what_git_ignores(
    root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    build = pytest.importorskip("scikit_build_core.build")
    for name in ("pyproject.toml", "README.md", "LICENSE", ".gitignore"):
        shutil.copy(root / name, tmp_path)
    (tmp_path / "cpp").mkdir()
    package = tmp_path / "python/gradysim"
    (package / "__pycache__").mkdir(parents=True)
    files = ("cpp/CMakeLists.txt", "python/gradysim/__init__.py")
    for file in (*files, "python/gradysim/__pycache__/__init__.pyc"):
        (tmp_path / file).touch()
    monkeypatch.chdir(tmp_path)
    with tarfile.open(tmp_path / "dist" / build.build_sdist("dist")) as archive:
        packed = {name.partition("/")[2] for name in archive.getnames()}
    assert set(files) <= packed
    assert [name for name in packed if "__pycache__" in name] == []


def test_a_wheel_has_the_files_of_all_examples(
    root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    build = pytest.importorskip("scikit_build_core.build")
    monkeypatch.chdir(root)
    wheel = tmp_path / build.build_wheel(str(tmp_path), {"wheel.cmake": "false"})
    with zipfile.ZipFile(wheel) as archive:
        packed = {name for name in archive.namelist() if re.match("gradysim/(configs|examples)/", name)}
    needed = {f"gradysim/{path}" for name in examples.NAMES for path in examples.files_of(name)}
    assert needed <= packed
    assert [name for name in packed if "configs/reference" in name or "__pycache__" in name] == []


def test_the_package_itself_needs_little(project: dict[str, Any]) -> None:
    names = {re.split(r"[<>=!~ \[]", requirement)[0] for requirement in project["project"]["dependencies"]}
    assert names <= {"cyclopts", "rich", "websockets"}


def test_nobody_is_told_to_install_the_published_gradysim(
    root: Path, project_files: Callable[..., list[Path]]
) -> None:
    texts = {
        file: (root / file).read_text() for file in project_files(".md", ".py") if file.parts[0] != "tests"
    }
    assert [
        str(file) for file, text in texts.items() if re.search(r"pip install [\"']?(gradysim|\.)\[", text)
    ] == []


def test_tools_are_pinned_exactly(project: dict[str, Any]) -> None:
    tools = [
        tool
        for group in [project["build-system"]["requires"], *project["dependency-groups"].values()]
        for tool in group
        if isinstance(tool, str)
    ]
    assert [tool for tool in tools if not re.fullmatch(r"[\w.-]+==[\w.]+", tool)] == []


def test_tools_have_one_version_each(project: dict[str, Any]) -> None:
    versions: dict[str, set[str]] = {}
    for group in [project["build-system"]["requires"], *project["dependency-groups"].values()]:
        for tool in group:
            if isinstance(tool, str):
                name, version = tool.split("==")
                versions.setdefault(name, set()).add(version)
    assert {name: found for name, found in versions.items() if len(found) > 1} == {}


def test_what_builds_the_published_distributions_has_hashes(root: Path, project: dict[str, Any]) -> None:
    """`make hashes` writes the file. `pip install --require-hashes` checks it when a release is built."""
    lines = (root / "packaging/requirements.txt").read_text().replace("\\\n", " ").splitlines()
    hashes = {line.split()[0]: line.count("--hash=sha256:") for line in lines if re.match(r"\w", line)}
    groups = project["dependency-groups"]
    tools = {*groups["build"], *(tool for tool in groups["dist"] if isinstance(tool, str))}
    assert tools <= hashes.keys()
    assert all(hashes.values())
