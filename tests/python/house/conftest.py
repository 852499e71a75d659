"""Where the project lies and which files belong to it."""

import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

_ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="session")
def root() -> Path:
    """The project's folder."""
    return _ROOT


@pytest.fixture(scope="session")
def project_files(root: Path) -> Callable[..., list[Path]]:
    """`project_files(".py", ".ini")`: the files that git tracks or would track, relative to the root.

    Without a suffix, all of them.
    """
    listing = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=root,
        check=True,
        capture_output=True,
        text=True,
    ).stdout
    files = [Path(name) for name in sorted(set(listing.split("\0"))) if name and (root / name).is_file()]

    def with_suffix(*suffixes: str) -> list[Path]:
        return [file for file in files if not suffixes or file.suffix in suffixes]

    return with_suffix
