"""Server of a page and of its viewers, in a thread that ends soon after it is asked to.

    GET /           the page
    a WebSocket     messages to a viewer, and from it

The run and the server share an interpreter. The run never waits for a connection: a viewer that sleeps, or
whose network is gone, does not answer pings and is dropped.
"""

import asyncio
import contextlib
import logging
import os
import secrets
import threading
import time
from collections.abc import Callable, Collection
from concurrent.futures import Future
from http import HTTPStatus
from typing import TYPE_CHECKING, Any, Self
from urllib.parse import parse_qs

from gradysim.viewer.serving import Host, is_allowed, respond, respond_with_page, silent_logger

if TYPE_CHECKING:
    from websockets.asyncio.server import ServerConnection
    from websockets.http11 import Request, Response

    from gradysim.viewer.connection import ViewerConnection

_logger = logging.getLogger(__name__)

LONGEST_MESSAGE_BYTES = 1000
"""Limit for messages from a viewer."""

PORTS = range(65536)
"""Valid ports; 0 stands for any free one."""

# Time limits in seconds of wall time: for the opening handshake or the download of a page, which may hold
# hundreds of megabytes, for a message, between two pings, for the answer to a ping, for pending messages when
# the server ends, and for the closing handshake.
_DOWNLOAD_S = 600.0
_MESSAGE_S = 20.0
_PING_S = 10.0
_PONG_S = 20.0
_LAST_WORDS_S = 0.8
_CLOSE_S = 0.3

_RELOAD_S = 3.0
"""A viewer that comes back within this time has only reloaded the page; seconds of wall time."""

_POLL_S = 0.1
"""Interval at which waiting functions look whether they should stop, in seconds of wall time."""


class Viewer:
    """A connection to a page.

    Attributes:
        connection: The WebSocket.
        news: Set when there may be something to send.
        leaving: Whether the server ends: what is pending is sent, then nothing more.
    """

    def __init__(self, connection: "ServerConnection") -> None:
        self.connection = connection
        self.news = asyncio.Event()
        self.leaving = False

    async def send(self, message: str | bytes) -> None:
        """Send a message. Raises TimeoutError if the viewer does not read it."""
        async with asyncio.timeout(_MESSAGE_S):
            await self.connection.send(message)


class PageServer:
    """Serves a page to any number of viewers, from `start` to `stop`.

    Attributes:
        port: Port of the server, from `start` on.
    """

    def __init__(
        self, host: str, port: int, *, needs_token: bool = False, origins: Collection[str] = ()
    ) -> None:
        """Prepare the server.

        Args:
            host: Name or address to listen on.
            port: Port to listen on; 0 for any free one.
            needs_token: Whether only those who know the address can connect.
            origins: Sites that may connect, besides the page itself.

        Raises:
            ValueError: The port is not one of `PORTS`.
        """
        if port not in PORTS:
            raise ValueError(f"port {port}: expected {PORTS[0]} to {PORTS[-1]}")
        self.port = port
        self._listens_on = host
        self._host = Host(host)
        self._origins = origins
        self._token = secrets.token_urlsafe(16) if needs_token else ""
        self._pass = secrets.token_urlsafe(16) if needs_token else ""
        self._viewers: dict[Viewer, asyncio.Task[None]] = {}
        self._connections: dict[ViewerConnection, None] = {}
        self._changed = threading.Condition()
        self._started: Future[int] = Future()
        self._thread: threading.Thread | None = None
        self._loop: asyncio.AbstractEventLoop | None = None
        self._stop: asyncio.Event | None = None

    @property
    def address(self) -> str:
        """Address of the page for browsers on this machine."""
        return f"http://{self._host.name}:{self.port}/{self._query}"

    @property
    def address_for_once(self) -> str:
        """Address that leads one browser to the page.

        Other users of the machine see it among the arguments of the browser's process.
        """
        return f"http://{self._host.name}:{self.port}/" + (f"?pass={self._pass}" if self._pass else "")

    @property
    def viewers(self) -> int:
        """Number of viewers."""
        return len(self._viewers)

    def start(self) -> None:
        """Start to listen. Return when viewers can connect.

        Raises:
            OSError: The address cannot be used. Its `filename` is the address.
        """
        self._thread = threading.Thread(target=self._run, name="gradysim page", daemon=True)
        self._thread.start()
        try:
            self.port = self._started.result()
        except OSError as error:
            self._thread.join()
            number = error.errno or 0  # negative if the name is unknown
            reason = os.strerror(number) if number > 0 else error.strerror or str(error)
            raise OSError(error.errno, reason, f"{self._listens_on} port {self.port}") from error

    def stop(self) -> None:
        """Send pending messages, close every connection and end the thread; no-op if it has ended.

        It takes about a second at most, if viewers do not answer.
        """
        thread, loop, stop = self._thread, self._loop, self._stop
        if thread is None:
            return
        if loop is not None and stop is not None:
            with contextlib.suppress(RuntimeError):  # the loop is closed: the thread is ending
                loop.call_soon_threadsafe(stop.set)
        if thread is threading.current_thread():
            return  # the garbage collector may run in any thread
        thread.join()
        self._thread = None

    def __enter__(self) -> Self:
        self.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    def wait_for_viewer(self, should_stop: Callable[[], bool]) -> None:
        """Return when there is a viewer, or soon after `should_stop()` returns True."""
        self._wait(lambda: bool(self._viewers) or should_stop())

    def wait_for_the_last(self, should_stop: Callable[[], bool]) -> None:
        """Return when all viewers have left and none has come back, or soon after `should_stop()`."""
        seen_at = time.monotonic()

        def have_left() -> bool:
            nonlocal seen_at
            if self._viewers:
                seen_at = time.monotonic()
            return time.monotonic() - seen_at > _RELOAD_S or should_stop()

        self._wait(have_left)

    def _wait(self, condition: Callable[[], bool]) -> None:
        with self._changed:
            while not condition():
                self._changed.wait(_POLL_S)  # handlers of signals only set flags

    def _notify(self) -> None:
        """Wake the functions that wait for viewers."""
        with self._changed:
            self._changed.notify_all()

    def _tell_news(self) -> None:
        """Wake the writers of all viewers; from any thread."""

        def tell() -> None:
            for viewer in self._viewers:
                viewer.news.set()

        if self._loop is not None:
            with contextlib.suppress(RuntimeError):  # the server has ended
                self._loop.call_soon_threadsafe(tell)

    def _page(self, path: str) -> bytes | None:
        """Return the page at a path; None if there is none. OSError if it cannot be read."""
        return None

    def _viewer(self, connection: "ServerConnection") -> Viewer:
        """Return a new viewer."""
        return Viewer(connection)

    async def _write(self, viewer: Any) -> None:
        """Send messages to a viewer. Return when all have been sent and it is `leaving`."""

    def _read(self, viewer: Any, message: str | bytes) -> None:
        """Handle a message of a viewer. ValueError ends the connection."""

    def _left(self, viewer: Any) -> None:
        """Handle that a viewer has left."""

    async def _attend(self, stop: asyncio.Event) -> None:
        """Return when the server should end."""
        await stop.wait()

    @property
    def _query(self) -> str:
        return f"?token={self._token}" if self._token else ""

    def _run(self) -> None:
        try:
            asyncio.run(self._serve())
        except BaseException as error:
            if self._started.done():
                _logger.exception("The server of the page failed; the run goes on without it")
            else:
                self._started.set_exception(error)

    async def _serve(self) -> None:
        from websockets.asyncio.server import serve

        from gradysim.viewer.connection import ViewerConnection

        self._loop = asyncio.get_running_loop()
        self._stop = asyncio.Event()

        def connect(*arguments: Any, **options: Any) -> ViewerConnection:
            return ViewerConnection(self._connections, *arguments, **options)

        async with serve(
            self._meet,
            self._listens_on,
            self.port,
            process_request=self._answer,
            create_connection=connect,  # type: ignore[arg-type]
            max_size=LONGEST_MESSAGE_BYTES,
            open_timeout=_DOWNLOAD_S,
            close_timeout=_DOWNLOAD_S,
            ping_interval=_PING_S,
            ping_timeout=_PONG_S,
            logger=silent_logger(__name__),
            compression=None,
        ) as server:
            self._started.set_result(next(iter(server.sockets)).getsockname()[1])
            await self._attend(self._stop)
            await self._take_leave()
            self._loop.call_later(_CLOSE_S, self._drop_all)

    async def _take_leave(self) -> None:
        """Send pending messages, and drop the viewers that do not read them."""
        for viewer in self._viewers:
            viewer.leaving = True
            viewer.news.set()
        if self._viewers:
            await asyncio.wait(self._viewers.values(), timeout=_LAST_WORDS_S)
        for viewer, writer in self._viewers.items():
            if not writer.done():
                viewer.connection.transport.abort()

    def _drop_all(self) -> None:
        """Drop the connections that are left, and those that come until the thread ends."""
        for connection in list(self._connections):
            connection.abort()
        asyncio.get_running_loop().call_later(_CLOSE_S, self._drop_all)

    def _answer(self, connection: "ServerConnection", request: "Request") -> "Response | None":
        """Answer HTTP requests, and reject those that are not allowed. None opens the WebSocket."""
        path, _, query = request.path.partition("?")
        given = {name: values[0] for name, values in parse_qs(query).items()}
        if not is_allowed(request, self._host.accepted, self._origins):
            return respond(connection, HTTPStatus.FORBIDDEN)
        if self._pass and secrets.compare_digest(given.get("pass", "").encode(), self._pass.encode()):
            self._pass = ""
            return respond(connection, HTTPStatus.SEE_OTHER, location=f"/{self._query}")
        if self._token and not secrets.compare_digest(given.get("token", "").encode(), self._token.encode()):
            return respond(connection, HTTPStatus.FORBIDDEN)
        if "Upgrade" in request.headers:
            return None
        try:
            page = self._page(path)
        except OSError:
            page = None
        if page is None:
            return respond(connection, HTTPStatus.NOT_FOUND)
        return respond_with_page(connection, page, is_sandboxed=path != "/")

    async def _meet(self, connection: "ServerConnection") -> None:
        """Serve one viewer until it leaves."""
        connection.close_timeout = _CLOSE_S
        viewer = self._viewer(connection)
        writer = asyncio.create_task(self._write_or_drop(viewer))
        self._viewers[viewer] = writer
        self._notify()
        try:
            async for message in connection:
                self._read(viewer, message)
        except ValueError:  # its message is malformed
            pass
        finally:
            del self._viewers[viewer]
            self._left(viewer)
            self._notify()
            writer.cancel()
            await asyncio.gather(writer, return_exceptions=True)

    async def _write_or_drop(self, viewer: Viewer) -> None:
        from websockets.exceptions import ConnectionClosed

        with contextlib.suppress(ConnectionClosed):
            try:
                await self._write(viewer)
            except TimeoutError:
                viewer.connection.transport.abort()
