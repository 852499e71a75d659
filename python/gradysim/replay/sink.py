"""Destination of the chunks of a running simulation."""

from collections import deque
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Any, Protocol

from gradysim.replay.chunk import RawChunk, pack
from gradysim.replay.file import ReplayFile


class OutputError(RuntimeError):
    """A file that a run writes lacks its end. The message says which one and why."""


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
        """Take the end of the run, also after a failure: `time_s`, and whether it is `complete`.

        Raises OutputError if a file lacks its end.
        """


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
        """Forward it to all sinks, also if one fails."""
        with ExitStack() as stack:
            for sink in self._sinks:
                stack.callback(sink.close, end)


_MOST_WAITING = 2


class ReplayWriter:
    """Writes a run to an HTML file. A thread encodes chunks, since zlib releases the interpreter lock.

    If the disk becomes full, the run continues without its replay, and `close` raises the error.
    """

    def __init__(self, path: str | Path, recorded: Iterable[int] | None = None) -> None:
        """Create an empty file. Raises OSError if it cannot be created."""
        self.recorded = None if recorded is None else frozenset(recorded)
        self._file = ReplayFile(Path(path))
        self._failure: OSError | None = None
        self._packer = ThreadPoolExecutor(1, "gradysim replay")
        self._packed: deque[Future[bytes]] = deque()

    def begin(self, run: Mapping[str, Any]) -> None:
        """Write the page and the description of the run."""
        self._write(lambda: self._file.begin(run))

    def wants_chunk(self) -> bool:
        """Return False, since longer chunks are compressed better."""
        return False

    def add(self, chunk: RawChunk) -> None:
        """Write a chunk, and wait for earlier ones."""
        if self._failure is None:
            self._packed.append(self._packer.submit(pack, chunk))
            self._write_packed(_MOST_WAITING)

    def close(self, end: Mapping[str, Any]) -> None:
        """Write how the run ended, and close the file. Raises OutputError if a part is missing."""
        self._write_packed(0)
        self._packer.shutdown()
        self._write(lambda: self._file.end(end))
        failure = self._failure
        try:
            self._file.close()  # writes again what could not be written
        except OSError as error:
            failure = failure or error
        if failure is not None:
            reason = failure.strerror or str(failure)
            raise OutputError(f"cannot write the replay '{self._file.path}': {reason}; it lacks its end")

    def _write_packed(self, may_wait: int) -> None:
        while self._packed and (len(self._packed) > may_wait or self._packed[0].done()):
            chunk = self._packed.popleft().result()
            self._write(partial(self._file.add, chunk))

    def _write(self, write: Callable[[], None]) -> None:
        """Call `write`, unless an earlier part could not be written."""
        if self._failure is None:
            try:
                write()
            except OSError as error:
                self._failure = error
