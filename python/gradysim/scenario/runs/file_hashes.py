"""Hashes of the files that a configuration names: whether a result was made with what they say now."""

import hashlib
import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

HASH_DIGITS = 16
"""Hexadecimal digits, as many as a fingerprint has."""

_MOST_NAMES = 3
"""Of files that are told."""


class FileHashes:
    """Reads each file once for a configuration, whose .ini file is in `folder`."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder.resolve()
        self._hashes: dict[Path, tuple[str, str]] = {}

    def of(self, files: Iterable[Path], others: Mapping[str, Path] = MappingProxyType({})) -> dict[str, str]:
        """Return {name: hash}, by name; names are seen from the folder of the .ini file, or are given."""
        hashes = {self._named(file) for file in files}
        hashes |= {(name, self._named(file)[1]) for name, file in others.items()}
        return dict(sorted(hashes))

    def _named(self, file: Path) -> tuple[str, str]:
        known = self._hashes.get(file)
        if known is None:
            known = self._hashes[file] = (self._name(file.resolve()), hash_of(file))
        return known

    def _name(self, file: Path) -> str:
        """Return a name that is the same in a copy of the user's folders elsewhere."""
        try:
            return Path(os.path.relpath(file, self._folder)).as_posix()
        except ValueError:  # another drive
            return file.as_posix()


def text_of_files(names: Sequence[str]) -> str:
    """Return the names of files for a sentence, "a.py and b.py"; of many only the first ones."""
    left_out = len(names) - _MOST_NAMES
    if left_out > 1:
        return f"{', '.join(names[:_MOST_NAMES])} and {left_out} other files"
    return " and ".join(names)


def hash_of(file: Path) -> str:
    """Return the hash of a file; "" if it cannot be read."""
    try:
        if not file.is_file():  # a pipe, of which nothing would be left for whoever needs it, or gone
            return ""
        with file.open("rb") as content:
            return hashlib.file_digest(content, "sha256").hexdigest()[:HASH_DIGITS]
    except OSError:  # a secret, or a name that none can have: whoever needs it will say
        return ""
