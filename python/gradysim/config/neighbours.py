"""The files beside one that cannot be read: for messages that ask whether one of them was meant."""

from pathlib import Path


def names_beside(file: Path, pattern: str) -> list[str]:
    """The names of the files in its folder that match; none if there is no such folder, or it is a secret."""
    try:
        return sorted(sibling.name for sibling in file.parent.glob(pattern))
    except (OSError, ValueError):
        return []
