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
from queue import Empty
from typing import TYPE_CHECKING

from gradysim.simulator.handler.visualization.messages import (
    CommandQueue,
    VisualizationConfiguration,
    command_text,
    is_pause_or_resume,
)
from gradysim.viewer.page import snapshot_page
from gradysim.viewer.server import PageServer, Viewer

if TYPE_CHECKING:
    from websockets.asyncio.server import ServerConnection

_logger = logging.getLogger(__name__)

PUBLIC_VIEWER = "https://project-gradys.github.io"
"""Origin of the public viewer, which connects to port 5678 on localhost."""


class VisualizationException(Exception):  # noqa: N818 (named as the other handlers' exceptions)
    """The simulation cannot be shown."""


class AddressInUse(VisualizationException):
    """Another program listens on the address."""


class _Viewer(Viewer):
    """One connection. A slow one misses snapshots, but no command."""

    def __init__(self, connection: "ServerConnection") -> None:
        super().__init__(connection)
        self.commands: deque[str] = deque()
        self.snapshot: str | None = None
        self.has_sent_nonsense = False


class VisualizationServer(PageServer):
    """A WebSocket server for any number of viewers."""

    def __init__(
        self, configuration: VisualizationConfiguration, greeting: str, commands: CommandQueue
    ) -> None:
        """Prepare the server.

        `greeting` is the first message to each viewer; `commands` go to all viewers.
        """
        super().__init__(configuration.host, configuration.port, origins=[PUBLIC_VIEWER])
        self._update_rate = configuration.update_rate
        self._greeting = greeting
        self._commands = commands
        self._last_commands: dict[tuple[str, int | None], str] = {}
        self._pausing: Viewer | None = None
        # The newest snapshot, and the one that the viewers have.
        self._snapshot: str | None = None
        self._sent: str | None = None
        self._wanted = threading.Event()
        self._running = threading.Event()
        self._running.set()

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
        try:
            super().start()
        except OSError as error:
            kind = AddressInUse if error.errno == errno.EADDRINUSE else VisualizationException
            raise kind(f"cannot listen for viewers on {error.filename}: {error.strerror}") from error

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

    def _run(self) -> None:
        try:
            super()._run()
        finally:
            self._running.set()

    async def _attend(self, stop: asyncio.Event) -> None:
        while not stop.is_set():
            self._update()
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(stop.wait(), self._update_rate)
        self._update()

    def _update(self) -> None:
        """Send new data to the viewers. Without viewers, commands wait for the first one."""
        snapshot = self._snapshot
        self._wanted.set()
        if not self._viewers:
            return
        commands = self._waiting_commands()
        for viewer in self._viewers:
            assert isinstance(viewer, _Viewer)
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

    def _page(self, path: str) -> bytes | None:
        return snapshot_page().encode() if path == "/" else None

    def _viewer(self, connection: "ServerConnection") -> _Viewer:
        viewer = _Viewer(connection)
        viewer.snapshot = self._sent  # a paused simulation has no newer one
        viewer.commands.extend(self._last_commands.values())
        return viewer

    async def _write(self, viewer: _Viewer) -> None:
        await viewer.send(self._greeting)
        while True:
            viewer.news.clear()
            while viewer.commands:
                await viewer.send(viewer.commands.popleft())
            text, viewer.snapshot = viewer.snapshot, None
            if text is not None:
                await viewer.send(text)
            elif viewer.leaving:
                return
            elif not viewer.commands:
                await viewer.news.wait()

    def _read(self, viewer: _Viewer, message: str | bytes) -> None:
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

    def _left(self, viewer: _Viewer) -> None:
        if viewer is self._pausing:
            self._running.set()
