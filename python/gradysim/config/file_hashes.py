"""Hashes of the files that a configuration names: whether a result was made with what they say now."""

import hashlib
import os
from collections.abc import Iterable
from pathlib import Path

_LENGTH = 16
"""Hexadecimal digits, as many as a fingerprint has."""


class FileHashes:
    """Reads each file once for a configuration, whose .ini file is in `folder`."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder.resolve()
        self._hashes: dict[Path, tuple[str, str]] = {}

    def of(self, files: Iterable[Path]) -> dict[str, str]:
        """Return {name: hash}, by name; names are seen from the folder of the .ini file."""
        return dict(sorted({self._named(file) for file in files}))

    def _named(self, file: Path) -> tuple[str, str]:
        known = self._hashes.get(file)
        if known is None:
            known = self._hashes[file] = (self._name(file.resolve()), _hash(file))
        return known

    def _name(self, file: Path) -> str:
        """Return a name that is the same in a copy of the user's folders elsewhere."""
        try:
            return Path(os.path.relpath(file, self._folder)).as_posix()
        except ValueError:  # another drive
            return file.as_posix()


def _hash(file: Path) -> str:
    try:
        return hashlib.sha256(file.read_bytes()).hexdigest()[:_LENGTH]
    except OSError:  # gone, or a secret, which whoever needs it will say
        return ""
