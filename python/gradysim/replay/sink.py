"""Destination of the chunks of a running simulation."""

from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any, Protocol

from gradysim.replay.chunk import RawChunk, pack
from gradysim.replay.file import ReplayFile


class ReplaySink(Protocol):
    """Takes the record of a run.

    Attributes:
        recorded: Ids of the nodes that are recorded in full, or None for all nodes.
    """

    recorded: frozenset[int] | None

    def begin(self, run: Mapping[str, Any]) -> None:
        """Take the description of the run."""

    def wants_chunk(self) -> bool:
        """Return whether a chunk should end now, before its 60 s of simulated time."""

    def add(self, chunk: RawChunk) -> None:
        """Take a chunk. This may block."""

    def close(self, end: Mapping[str, Any]) -> None:
        """Take the end of the run, also after a failure: `time_s`, and whether it is `complete`."""


class Sinks:
    """Forwards a run to several sinks; each gets the nodes that any of them records."""

    def __init__(self, sinks: Sequence[ReplaySink]) -> None:
        self._sinks = sinks
        wanted = [sink.recorded for sink in sinks]
        self.recorded = (
            None if None in wanted else frozenset().union(*(nodes for nodes in wanted if nodes is not None))
        )

    def begin(self, run: Mapping[str, Any]) -> None:
        """Forward it."""
        for sink in self._sinks:
            sink.begin(run)

    def wants_chunk(self) -> bool:
        """Return whether any sink wants a chunk."""
        return any(sink.wants_chunk() for sink in self._sinks)

    def add(self, chunk: RawChunk) -> None:
        """Forward it."""
        for sink in self._sinks:
            sink.add(chunk)

    def close(self, end: Mapping[str, Any]) -> None:
        """Forward it."""
        for sink in self._sinks:
            sink.close(end)


_MOST_WAITING = 2


class ReplayWriter:
    """Writes a run to an HTML file. A thread encodes chunks, since zlib releases the interpreter lock."""

    def __init__(self, path: str | Path, recorded: Iterable[int] | None = None) -> None:
        """Create an empty file. Raises OSError if it cannot be created."""
        self.recorded = None if recorded is None else frozenset(recorded)
        self._path = Path(path)
        self._path.touch()
        self._file: ReplayFile | None = None
        self._packer = ThreadPoolExecutor(1, "gradysim replay")
        self._packed: deque[Future[bytes]] = deque()

    def begin(self, run: Mapping[str, Any]) -> None:
        """Write the page and the description of the run."""
        self._file = ReplayFile(self._path, run)

    def wants_chunk(self) -> bool:
        """Return False, since longer chunks are compressed better."""
        return False

    def add(self, chunk: RawChunk) -> None:
        """Write a chunk, and wait for earlier ones. Raises OSError if the disk is full."""
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
