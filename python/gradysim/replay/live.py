"""Shows a running simulation: a server with the page of replays, and chunks as they are made.

    GET /?token=T        the page
    /chunks?token=T      a WebSocket: {"run": ...}, then chunks as binary messages, then {"end": ...}
    from the page        {"time_s": displayed time, "speed": simulated seconds per second}

The server rejects pages of other servers, and clients without its token.
"""

import contextlib
import json
import os
import secrets
import socket
import threading
import time
from collections.abc import Mapping
from tempfile import TemporaryFile
from typing import TYPE_CHECKING, Any
from urllib.parse import parse_qs, urlsplit

from gradysim.replay.chunk import RawChunk, pack
from gradysim.viewer.page import live_page
from gradysim.viewer.serving import (
    HANDSHAKE_S,
    LONGEST_MESSAGE_BYTES,
    Host,
    answer,
    is_allowed,
    silent_logger,
)

if TYPE_CHECKING:
    from websockets.http11 import Request, Response
    from websockets.sync.server import ServerConnection

CHUNK_S = 0.1
"""Wall time between two chunks, in seconds."""
LOOKAHEAD_S = 2.0
"""Limit of the run's lead over the fastest viewer, in seconds of wall time at the viewer's speed."""


class LiveView:
    """A `ReplaySink` for viewers. The run waits for the fastest viewer, if there is one.

    Attributes:
        recorded: None: all nodes are recorded in full.
        recorded_s: End of the record, in seconds of simulated time.
        clocks: Requested end of the record for each viewer, in seconds of simulated time.
    """

    recorded: frozenset[int] | None = None

    def __init__(self, port: int = 0, host: str = "127.0.0.1") -> None:
        """Listen on a host and a port, 0 for a free one. Raises OSError if that cannot be done."""
        from websockets.sync.server import serve

        self._host = Host(host)
        self._token = secrets.token_urlsafe(16)
        self._run: Mapping[str, Any] | None = None
        self._end: Mapping[str, Any] | None = None
        self._places: list[tuple[int, int]] = []
        self.recorded_s = 0.0
        self._news = threading.Condition()
        self.clocks: dict[ServerConnection, float] = {}
        self._viewers: set[ServerConnection] = set()
        self._cut_at = time.monotonic()
        self._is_stopped = False
        # Pings would draw from Python's random numbers, which belong to the run.
        self._server = serve(
            self._meet,
            host,
            port,
            process_request=self._answer,
            max_size=LONGEST_MESSAGE_BYTES,
            ping_interval=None,
            open_timeout=HANDSHAKE_S,
            close_timeout=HANDSHAKE_S,
            compression=None,
            logger=silent_logger(__name__),
        )
        self._history = TemporaryFile()  # noqa: SIM115 (open as long as the view)
        self._port: int = self._server.socket.getsockname()[1]
        threading.Thread(target=self._server.serve_forever, name="gradysim view", daemon=True).start()

    @property
    def address(self) -> str:
        """Address of the page for a browser."""
        return f"http://{self._host.name}:{self._port}/?token={self._token}"

    @property
    def viewers(self) -> int:
        """Number of viewers."""
        return len(self._viewers)

    def wait_for_viewer(self) -> None:
        """Return when there is a viewer."""
        with self._news:
            while not self._viewers:
                self._news.wait(0.2)  # with a timeout Ctrl-C gets through on every system

    def begin(self, run: Mapping[str, Any]) -> None:
        """Store the description of the run."""
        with self._news:
            self._run = run
            self._news.notify_all()

    def wants_chunk(self) -> bool:
        """Return whether it is time for another chunk."""
        return time.monotonic() - self._cut_at >= CHUNK_S

    def add(self, chunk: RawChunk) -> None:
        """Show a chunk, and wait while viewers are far behind it."""
        data = pack(chunk)
        with self._news:
            if self._is_stopped:  # there are no viewers any more
                return
            place = self._places[-1][0] + self._places[-1][1] if self._places else 0
            os.pwrite(self._history.fileno(), data, place)
            self._places.append((place, len(data)))
            self.recorded_s = chunk.end_ns / 1e9
            self._news.notify_all()
            while not self._is_stopped and self.clocks and self.recorded_s > max(self.clocks.values()):
                self._news.wait(0.2)
        self._cut_at = time.monotonic()

    def close(self, end: Mapping[str, Any]) -> None:
        """Show how the run ended. The server continues until `stop`."""
        with self._news:
            self._end = end
            self._news.notify_all()

    def stop(self) -> None:
        """End all connections, and the server."""
        with self._news:
            self._is_stopped = True
            self._news.notify_all()
        for viewer in list(self._viewers):
            with contextlib.suppress(OSError):
                viewer.socket.shutdown(socket.SHUT_RDWR)  # also for one that never reads
        self._server.shutdown()
        self._history.close()

    def _answer(self, connection: "ServerConnection", request: "Request") -> "Response | None":
        """Answer HTTP requests, and reject those that are not allowed."""
        token = parse_qs(urlsplit(request.path).query).get("token", [""])[0]
        knows_token = secrets.compare_digest(token.encode(), self._token.encode())
        allowed = knows_token and is_allowed(request, self._host.accepted)
        return answer(connection, request, allowed, lambda: live_page(f"/chunks?token={self._token}"))

    def _meet(self, viewer: "ServerConnection") -> None:
        """Serve one viewer until it leaves."""
        from websockets.exceptions import ConnectionClosed

        with self._news:
            self._viewers.add(viewer)
            self._news.notify_all()
        writer = threading.Thread(target=self._tell, args=(viewer,), daemon=True)
        writer.start()
        try:
            for message in viewer:
                self._take_clock(viewer, message)
        except (ConnectionClosed, ValueError):  # it left, or its message is malformed
            pass
        finally:
            with self._news:
                self._viewers.discard(viewer)
                self.clocks.pop(viewer, None)
                self._news.notify_all()

    def _take_clock(self, viewer: "ServerConnection", message: str | bytes) -> None:
        """Store the displayed time of a viewer. Raises ValueError for other messages."""
        content = json.loads(message)
        if not isinstance(content, dict):
            raise ValueError("expected an object")
        time_s, speed = (float(content.get(name, "")) for name in ("time_s", "speed"))
        with self._news:
            if viewer in self._viewers:
                self.clocks[viewer] = time_s + LOOKAHEAD_S * max(1.0, abs(speed))
                self._news.notify_all()

    def _tell(self, viewer: "ServerConnection") -> None:
        """Send a viewer all chunks, and new ones as they come."""
        from websockets.exceptions import ConnectionClosed

        told, has_run = 0, False
        with contextlib.suppress(ConnectionClosed, OSError, ValueError):  # it left, or the view was stopped
            while viewer in self._viewers:
                with self._news:
                    while viewer in self._viewers and not (
                        (self._run and not has_run) or told < len(self._places) or self._end
                    ):
                        self._news.wait(0.5)
                    run, end, places = self._run, self._end, self._places[told:]
                if run is not None and not has_run:
                    has_run = True
                    viewer.send(json.dumps({"run": run}))
                for place, length in places:
                    viewer.send(os.pread(self._history.fileno(), length, place))
                told += len(places)
                if end is not None and told == len(self._places):
                    viewer.send(json.dumps({"end": end}))
                    return
