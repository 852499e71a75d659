"""Checks and output of `make release`, in a clone of this repository."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from python.git_command import git

pytestmark = pytest.mark.verify

NOTES = "### Added\n\n- Something.\n"
IDENTITY = {
    f"GIT_{role}_{key}": value
    for role in ("AUTHOR", "COMMITTER")
    for key, value in {"NAME": "test", "EMAIL": "test@example.org"}.items()
}


def open_changelog(directory: Path, heading: str, notes: str = NOTES) -> None:
    """Commit a changelog that begins with a section."""
    (directory / "CHANGELOG.md").write_text(
        f"# Changelog\n\n## {heading}\n\n{notes}\n## 1.2.2 (2026-01-31)\n\nOld.\n"
    )
    git(directory, "commit", "--quiet", "--all", "--message", "Open the changelog")


@pytest.fixture
def clone(root: Path, tmp_path: Path) -> Path:
    """Return a clone that is ready for the release of 1.2.3."""
    if not (root / ".git").exists():
        pytest.skip("the sources are not a clone")
    directory = tmp_path / "clone"
    git(root, "clone", "--quiet", "--shared", "--no-tags", str(root), str(directory))
    git(directory, "checkout", "--quiet", "-B", "main")
    project = directory / "pyproject.toml"
    project.write_text(
        re.sub(r"(?m)^fallback_version = .*$", 'fallback_version = "1.2.3.dev0"', project.read_text())
    )
    citation = directory / "CITATION.cff"
    dated = re.sub(r"(?m)^version: .*$", "version: 1.2.3", citation.read_text())
    citation.write_text(re.sub(r"(?m)^date-released: .*$", "date-released: 2026-11-30", dated))
    open_changelog(directory, "1.2.3 (2026-11-30)")
    return directory


def release(
    clone: Path, root: Path, command: str, version: str = "1.2.3"
) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, root / "packaging/release.py", command, version],
        cwd=clone,
        env=os.environ | IDENTITY,
        capture_output=True,
        text=True,
        check=False,
    )


def test_the_tag_has_the_notes(clone: Path, root: Path) -> None:
    done = release(clone, root, "tag")
    assert done.returncode == 0, done.stderr
    assert git(clone, "cat-file", "-t", "v1.2.3") == "tag"
    message = git(clone, "tag", "--list", "--format=%(contents)", "v1.2.3")
    assert message == f"gradysim 1.2.3\n\n{NOTES}".strip()


def test_the_tag_is_at_the_last_commit(clone: Path, root: Path) -> None:
    release(clone, root, "tag")
    assert git(clone, "rev-parse", "v1.2.3^{commit}") == git(clone, "rev-parse", "HEAD")


def test_the_next_step_is_printed(clone: Path, root: Path) -> None:
    printed = release(clone, root, "tag").stdout
    assert "git push origin main v1.2.3\n" in printed
    assert "fallback_version" in printed


def test_a_check_writes_no_tag(clone: Path, root: Path) -> None:
    assert release(clone, root, "check").returncode == 0
    assert git(clone, "tag", "--list") == ""


def expect(clone: Path, root: Path, message: str, version: str = "1.2.3") -> None:
    """Check that both commands refuse with a message."""
    for command in ("check", "tag"):
        done = release(clone, root, command, version)
        assert (done.returncode, done.stderr) == (1, f"{message}\n")


def test_changes_that_are_not_committed_are_refused(clone: Path, root: Path) -> None:
    (clone / "README.md").write_text("other")
    expect(clone, root, "there are changes that are not committed: `git status` lists them")


def test_another_branch_is_refused(clone: Path, root: Path) -> None:
    git(clone, "checkout", "--quiet", "-b", "other")
    expect(clone, root, "expected the branch `main`, got `other`")


def test_a_second_tag_is_refused(clone: Path, root: Path) -> None:
    git(clone, "tag", "v1.2.3")
    expect(clone, root, "the tag v1.2.3 exists")


def test_a_section_without_a_date_is_refused(clone: Path, root: Path) -> None:
    open_changelog(clone, "1.2.3 (soon)")
    done = release(clone, root, "check")
    assert re.fullmatch(
        r"CHANGELOG.md: expected the heading `## 1.2.3 \(20..-..-..\)`, got `## 1.2.3 \(soon\)`\n",
        done.stderr,
    )


def test_an_unreleased_section_is_refused(clone: Path, root: Path) -> None:
    open_changelog(clone, "Unreleased (1.2.3)")
    done = release(clone, root, "check")
    assert re.fullmatch(
        r"CHANGELOG.md: expected the heading `## 1.2.3 \(20..-..-..\)`, got `## Unreleased \(1.2.3\)`\n",
        done.stderr,
    )


def test_a_section_without_notes_is_refused(clone: Path, root: Path) -> None:
    open_changelog(clone, "1.2.3 (2026-11-30)", notes="")
    expect(clone, root, "CHANGELOG.md: nothing under `## 1.2.3 (2026-11-30)`")


def test_another_version_than_the_next_one_is_refused(clone: Path, root: Path) -> None:
    citation = clone / "CITATION.cff"
    citation.write_text(citation.read_text().replace("version: 1.2.3", "version: 2.0.0"))
    open_changelog(clone, "2.0.0 (2026-11-30)")
    message = "pyproject.toml: expected fallback_version `2.0.0.dev0`, got `1.2.3.dev0`"
    expect(clone, root, message, version="2.0.0")


@pytest.mark.parametrize("version", ["v1.2", "1.2.3-rc1", "1.2.3rc", "1.2.3.dev0"])
def test_other_versions_are_refused(clone: Path, root: Path, version: str) -> None:
    message = f"expected a version such as 1.0.0 or 1.0.0rc1, got `{version}`"
    expect(clone, root, message, version=version)


@pytest.mark.parametrize("version", ["1.2.3a1", "1.2.3b2", "1.2.3rc1"])
def test_a_pre_release_has_the_notes_so_far(clone: Path, root: Path, version: str) -> None:
    open_changelog(clone, "Unreleased (1.2.3)")
    done = release(clone, root, "tag", version)
    assert done.returncode == 0, done.stderr
    message = git(clone, "tag", "--list", "--format=%(contents)", f"v{version}")
    assert message == f"gradysim {version}\n\n{NOTES}".strip()
    assert f"git push origin main v{version}\n" in done.stdout
    assert "fallback_version" not in done.stdout


def test_a_pre_release_comes_before_its_release(clone: Path, root: Path) -> None:
    message = "CHANGELOG.md: expected the heading `## Unreleased (1.2.3)`, got `## 1.2.3 (2026-11-30)`"
    expect(clone, root, message, version="1.2.3rc1")


def test_a_citation_of_another_version_keeps_a_release_back(clone: Path, root: Path) -> None:
    citation = clone / "CITATION.cff"
    citation.write_text(
        citation.read_text().replace("date-released: 2026-11-30", "date-released: 2026-11-29")
    )
    git(clone, "commit", "--quiet", "--all", "--message", "Date the citation")
    assert release(clone, root, "check").stderr == "CITATION.cff: expected `date-released: 2026-11-30`\n"
