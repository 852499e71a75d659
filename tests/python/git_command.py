"""Git, for tests with their own repository."""

import subprocess
from pathlib import Path


def git(directory: Path, *arguments: str) -> str:
    """Return the output of a git command."""
    author = ("-c", "user.name=test", "-c", "user.email=test@example.org")
    done = subprocess.run(
        ["git", *author, *arguments], cwd=directory, check=True, capture_output=True, text=True
    )
    return done.stdout.strip()
