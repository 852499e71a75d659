"""Git, as a test uses it in a repository of its own."""

import subprocess
from pathlib import Path


def git(directory: Path, *arguments: str) -> str:
    """Return what a command of git prints."""
    author = ("-c", "user.name=test", "-c", "user.email=test@example.org")
    done = subprocess.run(
        ["git", *author, *arguments], cwd=directory, check=True, capture_output=True, text=True
    )
    return done.stdout.strip()
