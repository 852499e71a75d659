"""Format of the HTML file of a replay: the page, the description of the run, then the chunks.

Each chunk is a separate element. So the file of a killed run has all chunks up to the last one, and a browser
shows them.
"""

import base64
import json
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import IO, Any

from gradysim.viewer.page import json_text, page

FORMAT = 2
"""Version of the format. Readers reject other versions."""

_RUN = '<script type="application/json" id="gradysim-run">'
_CHUNK = '<script type="text/plain" class="gradysim-chunk">'
_END = '<script type="application/json" id="gradysim-end">'
_CLOSE = "</script>\n"


class ReplayFile:
    """The HTML file of a run in progress. Its methods raise OSError; for example, if the disk is full."""

    def __init__(self, path: Path) -> None:
        """Create an empty file."""
        self.path = path
        self._file: IO[bytes] = path.open("wb")

    def begin(self, run: Mapping[str, Any]) -> None:
        """Write the page. `run` is the description of the run; see `describe`."""
        head, tail = page().split("<!-- run -->")
        self._write(head + _RUN + json_text({"format": FORMAT, **run}) + _CLOSE + tail)

    def add(self, chunk: bytes) -> None:
        """Append an encoded chunk."""
        self._write(_CHUNK + base64.b64encode(chunk).decode() + _CLOSE)

    def end(self, end: Mapping[str, Any]) -> None:
        """Write how the run ended."""
        self._write(_END + json_text(end) + _CLOSE)

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def _write(self, text: str) -> None:
        self._file.write(text.encode())
        self._file.flush()


def read_parts(path: Path) -> tuple[dict[str, Any], Iterator[bytes], dict[str, Any] | None]:
    """Return the description of the run, its encoded chunks, and how it ended.

    The end is None if the run was killed or goes on, or if the end of the file is missing.

    Raises ValueError if the file is not a replay, OSError if it cannot be read.
    """
    text = path.read_text(encoding="utf-8", errors="replace")  # it may be any file
    run = _object(path, text, _RUN)
    if run is None:
        raise ValueError(f"{path}: expected a complete replay, as `gradysim run --replay` writes it")
    if run.get("format") != FORMAT:
        raise ValueError(f"{path}: a replay of format {run.get('format')}; expected format {FORMAT}")
    chunks = (
        base64.b64decode(chunk[1]) for chunk in re.finditer(f"{re.escape(_CHUNK)}([^<]*)</script>", text)
    )
    return run, chunks, _object(path, text, _END)


def _object(path: Path, text: str, start: str) -> dict[str, Any] | None:
    """Return the JSON object of an element; None if there is none. ValueError for another value."""
    found = re.search(re.escape(start) + "(.*?)</script>", text, re.DOTALL)
    if found is None:
        return None
    try:
        value = json.loads(found[1])
    except (ValueError, RecursionError):
        value = None
    if not isinstance(value, dict):
        raise ValueError(f"{path}: a damaged replay: expected a JSON object, got `{found[1][:50]}`")
    return value
