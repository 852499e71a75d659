"""Checksum of a whole file in its last line, after content that may be binary.

SQLite ignores what follows the last page of a database, so its readers open such a file as any other. The
line is text: `head -c -91 FILE | sha256sum` prints the same hash.
"""

import hashlib
import os
from functools import lru_cache
from pathlib import Path

from gradysim.results.durable import naming

_BEGIN = b"\ngradysim, SHA-256 above: "
_HASH_BYTES = 2 * hashlib.sha256().digest_size
LINE_BYTES = len(_BEGIN) + _HASH_BYTES + 1
"""Bytes of the checksum with both ends of its line."""

_BLOCK_BYTES = 2**20


def append_checksum(path: Path) -> None:
    """Append the checksum of a file. Raises OSError."""
    line = _line(path, path.stat().st_size)
    with path.open("ab") as file:
        file.write(line)


def remove_checksum(path: Path) -> None:
    """Remove the checksum at the end of a file. Raises OSError."""
    os.truncate(path, path.stat().st_size - LINE_BYTES)


def has_checksum(path: Path) -> bool:
    """Return whether a file ends with a checksum, right or wrong. Raises OSError."""
    return _last_line(path).startswith(_BEGIN)


def verify_checksum(path: Path) -> None:
    """Raise ValueError unless a file is as `append_checksum` left it, and OSError if it cannot be read.

    A process reads each state of a file once only.
    """
    status = path.stat()
    _verify(path, status.st_dev, status.st_ino, status.st_size, status.st_mtime_ns, status.st_ctime_ns)


@lru_cache(maxsize=1024)
def _verify(path: Path, *_state: int) -> None:
    found = _last_line(path)
    if not found.startswith(_BEGIN):
        raise ValueError("it does not end with a checksum")
    if found != _line(path, path.stat().st_size - LINE_BYTES):
        raise ValueError("its content does not fit its checksum")


def _last_line(path: Path) -> bytes:
    with naming(path), path.open("rb") as file:
        size = file.seek(0, os.SEEK_END)
        file.seek(max(0, size - LINE_BYTES))
        return file.read()


def _line(path: Path, size: int) -> bytes:
    """Return the last line for the first `size` bytes of a file."""
    found = hashlib.sha256()
    block = memoryview(bytearray(_BLOCK_BYTES))
    with naming(path), path.open("rb", buffering=0) as file:
        while size > 0 and (count := file.readinto(block[: min(size, _BLOCK_BYTES)])):
            found.update(block[:count])
            size -= count
    return _BEGIN + found.hexdigest().encode() + b"\n"
