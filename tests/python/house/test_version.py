"""The version names the release or the commit."""

import json
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path

import pytest

import gradysim
from python.git_command import git

BUILD = "from scikit_build_core.build import build_sdist; print(build_sdist('dist'))"


@pytest.fixture
def sources(root: Path, tmp_path: Path) -> Path:
    """Return the files that determine the version, without git."""
    pytest.importorskip("scikit_build_core")
    directory = tmp_path / "sources"
    (directory / "cpp").mkdir(parents=True)
    (directory / "python/gradysim").mkdir(parents=True)
    for file in ("cpp/CMakeLists.txt", "python/gradysim/__init__.py"):
        (directory / file).touch()
    for name in ("pyproject.toml", "README.md", "LICENSE", ".gitignore"):
        shutil.copy(root / name, directory)
    return directory


@pytest.fixture
def clone(sources: Path) -> Path:
    git(sources, "init", "-q")
    git(sources, "add", "--all")
    git(sources, "commit", "-q", "-m", "Begin")
    return sources


@pytest.fixture
def built(monkeypatch: pytest.MonkeyPatch) -> Callable[[Path], str]:
    """Return a function that builds the source distribution of a directory and returns its version."""
    monkeypatch.delenv("PYTHONPATH", raising=False)

    def build(directory: Path) -> str:
        done = subprocess.run(
            [sys.executable, "-c", BUILD], cwd=directory, check=True, capture_output=True, text=True
        )
        return done.stdout.split()[-1].removeprefix("gradysim-").removesuffix(".tar.gz")

    return build


def next_release(root: Path) -> str:
    with (root / "pyproject.toml").open("rb") as file:
        fallback: str = tomllib.load(file)["tool"]["vcs-versioning"]["fallback_version"]
    return fallback


def test_a_clone_without_tags_names_its_commit(root: Path, clone: Path, built: Callable[[Path], str]) -> None:
    release = next_release(root).removesuffix(".dev0")
    commit = git(clone, "rev-parse", "HEAD")
    found, _, local = built(clone).partition("+g")
    assert (found, commit[: len(local)]) == (f"{release}.dev1", local)


def test_a_tagged_commit_is_the_release(clone: Path, built: Callable[[Path], str]) -> None:
    git(clone, "tag", "--annotate", "v1.2.3", "--message", "1.2.3")
    assert built(clone) == "1.2.3"


def test_a_source_distribution_keeps_its_version(clone: Path, built: Callable[[Path], str]) -> None:
    first = built(clone)
    # Debian's Python 3.11.2 unpacks without the filter that newer versions ask for.
    subprocess.run(["tar", "-xf", clone / f"dist/gradysim-{first}.tar.gz"], cwd=clone.parent, check=True)
    assert built(clone.parent / f"gradysim-{first}") == first


def test_sources_without_git_have_the_next_version(
    root: Path, sources: Path, built: Callable[[Path], str]
) -> None:
    assert built(sources) == next_release(root)


def test_a_machine_without_git_has_the_next_version(
    root: Path, clone: Path, built: Callable[[Path], str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", "")
    assert built(clone) == next_release(root)


@pytest.mark.parametrize(
    ("installed", "is_editable", "shown"),
    [
        ("1.2.3", False, "1.2.3"),
        ("1.2.3", True, "1.2.3+editable"),
        ("1.2.3.dev4+gabcdef0", False, "1.2.3.dev4+gabcdef0"),
        ("1.2.3.dev4+gabcdef0", True, "1.2.3.dev4+gabcdef0.editable"),
    ],
)
def test_an_editable_installation_says_so(
    installed: str, is_editable: bool, shown: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    metadata = tmp_path / "gradysim.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text(f"Name: gradysim\nVersion: {installed}\n")
    origin = {"url": "file:///gradysim", "dir_info": {"editable": is_editable}}
    (metadata / "direct_url.json").write_text(json.dumps(origin))
    monkeypatch.syspath_prepend(tmp_path)
    assert gradysim.__version__ == shown
