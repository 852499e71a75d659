"""Shows a running simulation: a server with the page of replays, and chunks as they are made.

    GET /?token=T        the page
    /chunks?token=T      a WebSocket: {"run": ...}, then chunks as binary messages, then {"end": ...}
    from the page        {"time_s": displayed time, "speed": simulated seconds per second}

The server rejects pages of other servers, and clients without its token.
"""

import json
import os
import time
from collections.abc import Callable, Mapping
from tempfile import TemporaryFile
from typing import Any

from gradysim.replay.chunk import RawChunk, pack
from gradysim.viewer.page import live_page
from gradysim.viewer.server import PageServer, Viewer

CHUNK_S = 0.1
"""Wall time between two chunks, in seconds."""
LOOKAHEAD_S = 2.0
"""Limit of the run's lead over the fastest viewer, in seconds of wall time at the viewer's speed."""


class LiveView(PageServer):
    """A `ReplaySink` for viewers.

    Attributes:
        recorded: None: all nodes are recorded in full.
        recorded_s: End of the record, in seconds of simulated time.
        clocks: Requested end of the record for each viewer, in seconds of simulated time.
    """

    recorded: frozenset[int] | None = None

    def __init__(self, port: int = 0, host: str = "127.0.0.1") -> None:
        """Prepare to listen on a host and a port, 0 for a free one. ValueError if that is not a port."""
        super().__init__(host, port, needs_token=True)
        self._described: Mapping[str, Any] | None = None
        self._end: Mapping[str, Any] | None = None
        self._extents: list[tuple[int, int]] = []
        self.recorded_s = 0.0
        self.clocks: dict[Viewer, float] = {}
        self._cut_at = time.monotonic()

    def start(self) -> None:
        """Start to listen. Raises OSError if that cannot be done."""
        super().start()
        self._history = TemporaryFile()  # noqa: SIM115 (open until `stop`)

    def begin(self, run: Mapping[str, Any]) -> None:
        """Store the description of the run."""
        self._described = run
        self._tell_news()

    def wants_chunk(self) -> bool:
        """Return whether it is time for another chunk."""
        return time.monotonic() - self._cut_at >= CHUNK_S

    def add(self, chunk: RawChunk) -> None:
        """Show a chunk; no-op after `stop`."""
        data = pack(chunk)
        if self._history.closed:
            return
        offset = sum(self._extents[-1]) if self._extents else 0
        os.pwrite(self._history.fileno(), data, offset)
        self._extents.append((offset, len(data)))
        self.recorded_s = chunk.end_ns / 1e9
        self._cut_at = time.monotonic()
        self._tell_news()

    def close(self, end: Mapping[str, Any]) -> None:
        """Show how the run ended. The server continues until `stop`."""
        self._end = end
        self._tell_news()

    def stop(self) -> None:
        """End all connections, and the server."""
        super().stop()
        self._history.close()

    def paced(self, should_stop: Callable[[], bool]) -> Callable[[], bool]:
        """Return `should_stop` for a run that waits for its fastest viewer, if there is one.

        It returns when the record is not ahead of all viewers, or soon after `should_stop()` is True.
        """

        def wait() -> bool:
            self._wait(lambda: should_stop() or not self._is_ahead())
            return should_stop()

        return wait

    def _is_ahead(self) -> bool:
        return bool(clocks := list(self.clocks.values())) and self.recorded_s > max(clocks)

    def _page(self, path: str) -> bytes | None:
        return live_page(f"/chunks{self._query}").encode() if path == "/" else None

    def _read(self, viewer: Viewer, message: str | bytes) -> None:
        """Store the displayed time of a viewer. Raises ValueError for other messages."""
        content = json.loads(message)
        if not isinstance(content, dict):
            raise ValueError("expected an object")
        time_s, speed = (float(content.get(name, "")) for name in ("time_s", "speed"))
        self.clocks[viewer] = time_s + LOOKAHEAD_S * max(1.0, abs(speed))
        self._notify()

    def _left(self, viewer: Viewer) -> None:
        self.clocks.pop(viewer, None)

    async def _write(self, viewer: Viewer) -> None:
        """Send a viewer all chunks, and new ones as they come."""
        sent, has_run = 0, False
        while True:
            viewer.news.clear()
            # The run sets these in the opposite order.
            end, extents, run = self._end, self._extents[sent:], self._described
            if run is not None and not has_run:
                has_run = True
                await viewer.send(json.dumps({"run": run}))
            for offset, length in extents:
                await viewer.send(os.pread(self._history.fileno(), length, offset))
            sent += len(extents)
            if end is not None:
                await viewer.send(json.dumps({"end": end}))
                return
            if viewer.leaving and not viewer.news.is_set():
                return
            await viewer.news.wait()
