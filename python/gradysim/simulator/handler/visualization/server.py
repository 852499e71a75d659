"""Server for the viewers of one simulation, in a thread that ends with the simulation.

The simulation passes snapshots (`publish`) and a queue of commands. The server sends them every
`update_rate`. In return the viewers can pause the simulation.

    GET /           the page of gradysim, which connects to this server
    a WebSocket     the messages of `messages.py`, for scripts, that page and the public viewer
"""

import asyncio
import contextlib
import errno
import logging
import threading
from collections import deque
from concurrent.futures import Future
from queue import Empty
from typing import TYPE_CHECKING

from gradysim.simulator.handler.visualization.messages import (
    CommandQueue,
    VisualizationConfiguration,
    command_text,
    is_pause_or_resume,
)
from gradysim.viewer.page import snapshot_page
from gradysim.viewer.serving import (
    HANDSHAKE_S,
    LONGEST_MESSAGE_BYTES,
    Host,
    answer,
    is_allowed,
    silent_logger,
)

if TYPE_CHECKING:
    from websockets.asyncio.server import ServerConnection
    from websockets.http11 import Request, Response

_logger = logging.getLogger(__name__)

PUBLIC_VIEWER = "https://project-gradys.github.io"
"""Origin of the public viewer, which connects to port 5678 on localhost."""

# Time limits in seconds of wall time: for the last messages of a simulation, and for other messages.
_LAST_WORDS_S = 1.0
_MESSAGE_S = 20.0


class VisualizationException(Exception):  # noqa: N818 (named as the other handlers' exceptions)
    """The simulation cannot be shown."""


class AddressInUse(VisualizationException):
    """Another program listens on the address."""


class _Viewer:
    """One connection. A slow one misses snapshots, but no command."""

    def __init__(self, connection: "ServerConnection") -> None:
        self.connection = connection
        self.commands: deque[str] = deque()
        self.snapshot: str | None = None
        self.leaving = False
        self.has_sent_nonsense = False
        self.news = asyncio.Event()

    async def write(self, greeting: str) -> None:
        """Send pending messages until `leaving`. A viewer that does not read is disconnected."""
        try:
            await self._send(greeting)
            while True:
                while self.commands:
                    await self._send(self.commands.popleft())
                text, self.snapshot = self.snapshot, None
                if text is not None:
                    await self._send(text)
                elif self.leaving:
                    return
                elif not self.commands:
                    await self.news.wait()
                    self.news.clear()
        except TimeoutError:
            self.connection.transport.abort()

    async def _send(self, text: str) -> None:
        async with asyncio.timeout(_MESSAGE_S):
            await self.connection.send(text)


class VisualizationServer:
    """A WebSocket server for any number of viewers.

    Attributes:
        port: Port of the server, from `start` on.
    """

    def __init__(
        self, configuration: VisualizationConfiguration, greeting: str, commands: CommandQueue
    ) -> None:
        """Prepare the server.

        `greeting` is the first message to each viewer; `commands` go to all viewers.
        """
        self._configuration = configuration
        self._greeting = greeting
        self._commands = commands
        self._last_commands: dict[tuple[str, int | None], str] = {}
        self._viewers: dict[_Viewer, asyncio.Task[None]] = {}
        self._pausing: _Viewer | None = None
        # The newest snapshot, and the one that the viewers have.
        self._snapshot: str | None = None
        self._sent: str | None = None
        self._wanted = threading.Event()
        self._running = threading.Event()
        self._running.set()
        self._started: Future[int] = Future()
        self._thread: threading.Thread | None = None
        self._loop: asyncio.AbstractEventLoop | None = None
        self._stop: asyncio.Event | None = None
        self.port = 0
        self._host = Host(configuration.host)

    @property
    def address(self) -> str:
        """Address of the page for browsers on this machine."""
        return f"http://{self._host.name}:{self.port}/"

    @property
    def wants_snapshot(self) -> bool:
        """Whether the server has taken the last snapshot and needs a new one."""
        return self._wanted.is_set()

    def start(self) -> None:
        """Start to listen. Return when viewers can connect.

        Raises:
            AddressInUse: Another program listens there.
            VisualizationException: The address cannot be used.
        """
        self._thread = threading.Thread(target=self._run, name="gradysim visualization", daemon=True)
        self._thread.start()
        try:
            self.port = self._started.result()
        except OSError as error:
            self._thread.join()
            host, port = self._configuration.host, self._configuration.port
            kind = AddressInUse if error.errno == errno.EADDRINUSE else VisualizationException
            raise kind(f"cannot listen for viewers on {host!r} port {port}: {error}") from error

    def publish(self, snapshot: str) -> None:
        """Send this snapshot with the next update, unless a newer one replaces it."""
        self._snapshot = snapshot
        self._wanted.clear()

    def wait_while_paused(self) -> None:
        """Return when no viewer has paused the simulation; usually at once."""
        while not self._running.wait(timeout=0.2):  # without a timeout, Ctrl-C is blocked on some systems
            pass

    @property
    def is_paused(self) -> bool:
        """Whether a viewer has paused the simulation."""
        return not self._running.is_set()

    def stop(self) -> None:
        """Send pending messages, close every connection and end the thread; no-op if it has ended."""
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

    def _run(self) -> None:
        try:
            asyncio.run(self._serve())
        except BaseException as error:
            if self._started.done():
                _logger.exception("The server of the visualization failed; the simulation goes on without it")
            else:
                self._started.set_exception(error)
        finally:
            self._running.set()

    async def _serve(self) -> None:
        from websockets.asyncio.server import serve

        from gradysim.simulator.handler.visualization.connection import ViewerConnection

        self._loop = asyncio.get_running_loop()
        self._stop = asyncio.Event()
        configuration = self._configuration
        async with serve(
            self._meet,
            configuration.host,
            configuration.port,
            process_request=self._answer,
            create_connection=ViewerConnection,
            max_size=LONGEST_MESSAGE_BYTES,
            open_timeout=HANDSHAKE_S,
            close_timeout=_LAST_WORDS_S,
            logger=silent_logger(__name__),
            compression=None,
        ) as server:
            self._started.set_result(next(iter(server.sockets)).getsockname()[1])
            while not self._stop.is_set():
                self._update()
                with contextlib.suppress(TimeoutError):
                    await asyncio.wait_for(self._stop.wait(), configuration.update_rate)
            self._update()
            await self._take_leave()

    async def _take_leave(self) -> None:
        """Give the viewers time for the last messages."""
        for viewer in self._viewers:
            viewer.leaving = True
            viewer.news.set()
        if self._viewers:
            await asyncio.wait(list(self._viewers.values()), timeout=_LAST_WORDS_S)
        # The library has no time limit for sending "close" to a viewer that does not read.
        asyncio.get_running_loop().call_later(_LAST_WORDS_S, self._disconnect)

    def _disconnect(self) -> None:
        for viewer in self._viewers:
            viewer.connection.transport.abort()

    def _answer(self, connection: "ServerConnection", request: "Request") -> "Response | None":
        allowed = is_allowed(request, self._host.accepted, [PUBLIC_VIEWER])
        return answer(connection, request, allowed, snapshot_page)

    def _update(self) -> None:
        """Send new data to the viewers. Without viewers, commands wait for the first one."""
        snapshot = self._snapshot
        self._wanted.set()
        if not self._viewers:
            return
        commands = self._waiting_commands()
        for viewer in self._viewers:
            viewer.commands.extend(commands)
            if snapshot is not self._sent:
                viewer.snapshot = snapshot
            viewer.news.set()
        self._sent = snapshot

    def _waiting_commands(self) -> list[str]:
        texts: list[str] = []
        try:
            while True:
                command = self._commands.get_nowait()
                texts.append(command_text(command))
                self._last_commands[command["command"], command["payload"].get("node_id")] = texts[-1]
        except Empty:
            return texts

    async def _meet(self, connection: "ServerConnection") -> None:
        """Serve one viewer until it leaves."""
        viewer = _Viewer(connection)
        viewer.snapshot = self._sent  # a paused simulation has no newer one
        viewer.commands.extend(self._last_commands.values())
        writer = asyncio.create_task(viewer.write(self._greeting))
        self._viewers[viewer] = writer
        try:
            async for message in connection:
                self._interact(viewer, message)
        finally:
            del self._viewers[viewer]
            if viewer is self._pausing:
                self._running.set()
            writer.cancel()
            await asyncio.gather(writer, return_exceptions=True)

    def _interact(self, viewer: _Viewer, message: str | bytes) -> None:
        try:
            is_pause_or_resume(message)
        except ValueError as error:
            if not viewer.has_sent_nonsense:  # one line in the log is enough
                _logger.warning("A viewer's message was ignored: %s", error)
            viewer.has_sent_nonsense = True
            return
        if self._running.is_set():
            self._pausing = viewer
            self._running.clear()
        else:
            self._running.set()
