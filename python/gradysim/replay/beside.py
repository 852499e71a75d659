"""Server of several replays side by side: their page, and each file."""

import os
from collections.abc import Sequence
from pathlib import Path

from gradysim.viewer.page import page_beside
from gradysim.viewer.server import PageServer


class ReplaysBeside(PageServer):
    """Serves replays while a browser shows them.

    Several replays need a page of their own. As a file it would be in a temporary directory, which some
    browsers cannot read, and which stays there.
    """

    def __init__(self, files: Sequence[Path], port: int = 0, host: str = "127.0.0.1") -> None:
        """Prepare to serve files of replays. ValueError if `port` is not a port."""
        super().__init__(host, port, needs_token=True)
        self._files = {f"/{index}": file for index, file in enumerate(files)}
        self._names = short_names(files)

    def _page(self, path: str) -> bytes | None:
        if path in self._files:
            return self._files[path].read_bytes()
        if path != "/":
            return None
        replays = {f"{file}{self._query}": name for file, name in zip(self._files, self._names, strict=True)}
        return page_beside(f"/viewer{self._query}", replays).encode()


def short_names(files: Sequence[Path]) -> list[str]:
    """Return the names of files, or their paths below the directory that they share if names are equal."""
    names = [file.name for file in files]
    if len(set(names)) == len(names):
        return names
    paths = [file.resolve() for file in files]
    shared = os.path.commonpath([path.parent for path in paths])
    return [str(path.relative_to(shared)) for path in paths]
