"""Where the chunks of a run go while it runs."""

from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any, Protocol

from gradysim.replay.chunk import RawChunk, pack
from gradysim.replay.file import ReplayFile


class ReplaySink(Protocol):
    """Takes a run as it goes on.

    Attributes:
        recorded: Ids of the nodes at which all is recorded, or None for all nodes.
    """

    recorded: frozenset[int] | None

    def begin(self, run: Mapping[str, Any]) -> None:
        """Take what is known before the run."""

    def wants_chunk(self) -> bool:
        """Return whether a chunk should end now, before its 60 s of simulated time."""

    def add(self, chunk: RawChunk) -> None:
        """Take a chunk. May wait."""

    def close(self, end: Mapping[str, Any]) -> None:
        """Take how the run ended, also after a failure: `time_s`, and whether it is `complete`."""


class Sinks:
    """Passes a run on to several sinks; each gets the nodes that any of them wants recorded."""

    def __init__(self, sinks: Sequence[ReplaySink]) -> None:
        self._sinks = sinks
        wanted = [sink.recorded for sink in sinks]
        self.recorded = (
            None if None in wanted else frozenset().union(*(nodes for nodes in wanted if nodes is not None))
        )

    def begin(self, run: Mapping[str, Any]) -> None:
        """Pass it on."""
        for sink in self._sinks:
            sink.begin(run)

    def wants_chunk(self) -> bool:
        """Return whether any of them wants one."""
        return any(sink.wants_chunk() for sink in self._sinks)

    def add(self, chunk: RawChunk) -> None:
        """Pass it on."""
        for sink in self._sinks:
            sink.add(chunk)

    def close(self, end: Mapping[str, Any]) -> None:
        """Pass it on."""
        for sink in self._sinks:
            sink.close(end)


_MOST_WAITING = 2


class ReplayWriter:
    """Writes a run to an HTML file, packed by a thread: zlib lets the simulation go on meanwhile."""

    def __init__(self, path: str | Path, recorded: Iterable[int] | None = None) -> None:
        """Create the file, empty until the run begins. Raises OSError if that cannot be done."""
        self.recorded = None if recorded is None else frozenset(recorded)
        self._path = Path(path)
        self._path.touch()
        self._file: ReplayFile | None = None
        self._packer = ThreadPoolExecutor(1, "gradysim replay")
        self._packed: deque[Future[bytes]] = deque()

    def begin(self, run: Mapping[str, Any]) -> None:
        """Write the page and what is known of the run."""
        self._file = ReplayFile(self._path, run)

    def wants_chunk(self) -> bool:
        """Return False: the longer a chunk, the better it is compressed."""
        return False

    def add(self, chunk: RawChunk) -> None:
        """Write a chunk, and wait if earlier ones are not written yet. Raises OSError if the disk is full."""
        self._packed.append(self._packer.submit(pack, chunk))
        self._write(_MOST_WAITING)

    def close(self, end: Mapping[str, Any]) -> None:
        """Write how the run ended, and close the file."""
        assert self._file is not None
        try:
            self._write(0)
            self._file.close(end)
        finally:
            self._packer.shutdown()

    def _write(self, may_wait: int) -> None:
        assert self._file is not None
        while self._packed and (len(self._packed) > may_wait or self._packed[0].done()):
            self._file.add(self._packed.popleft().result())
