"""The folder of one fleet's files. It goes with the fleet; after a SIGKILL, with the next fleet that starts.

A lock on a file in it says that its owner lives: the kernel lets go of it however that process ends. Numbers
of processes would not do, since they are used again, and those of another container mean nothing here.
"""

import contextlib
import fcntl
import os
import shutil
import tempfile
from pathlib import Path
from typing import BinaryIO

_PREFIX = "gradysim-sitl-"
_LOCK = "owner.lock"


class FleetFolder:
    """A new folder among the system's temporary ones. Those whose owners are dead are removed first.

    Attributes:
        path: The folder.
    """

    def __init__(self) -> None:
        """Make it."""
        _remove_abandoned(Path(tempfile.gettempdir()))
        self.path = Path(tempfile.mkdtemp(prefix=_PREFIX))
        # Locked before it has its name: whoever sees the file and can lock it knows that the owner is dead.
        unnamed = self.path / f"{_LOCK}.new"
        self._lock: BinaryIO = unnamed.open("wb")
        fcntl.flock(self._lock, fcntl.LOCK_EX)
        unnamed.rename(self.path / _LOCK)

    def remove(self) -> None:
        """Remove it with all that is in it; no-op if that has happened."""
        shutil.rmtree(self.path, ignore_errors=True)
        self._lock.close()


def _remove_abandoned(parent: Path) -> None:
    """Remove the folders of dead owners, of this user only."""
    for folder in parent.glob(f"{_PREFIX}*"):
        with contextlib.suppress(OSError):
            if folder.lstat().st_uid == os.geteuid() and not folder.is_symlink():
                _remove_if_abandoned(folder)


def _remove_if_abandoned(folder: Path) -> None:
    """Raises OSError if the owner lives, or there is no lock yet."""
    with (folder / _LOCK).open("rb") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        shutil.rmtree(folder, ignore_errors=True)
