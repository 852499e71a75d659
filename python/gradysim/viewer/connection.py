"""Connection to a viewer. In a separate file, since only a server imports the package `websockets`."""

import os
from collections.abc import Awaitable
from typing import Any

from websockets.asyncio.server import ServerConnection
from websockets.protocol import State

MOST_UNFINISHED = 64
"""Limit for connections that have not opened the WebSocket, nor got their whole answer yet."""

_PAYLOAD_BYTES = 4


class ViewerConnection(ServerConnection):
    """A connection that is listed while it exists.

    It does not draw from Python's `random`, which belongs to the run; the library draws for each ping.
    """

    def __init__(self, connections: "dict[ViewerConnection, None]", *arguments: Any, **options: Any) -> None:
        """Take the list of connections, in the order in which they came, and what the library gives."""
        super().__init__(*arguments, **options)
        self._connections = connections

    def connection_made(self, transport: Any) -> None:
        """List the connection. If too many have not finished their handshake, drop the oldest of them."""
        super().connection_made(transport)
        self._connections[self] = None
        unfinished = [one for one in self._connections if one.state is State.CONNECTING]
        if len(unfinished) > MOST_UNFINISHED:
            unfinished[0].abort()

    def connection_lost(self, exc: Exception | None) -> None:
        """Remove the connection from the list."""
        self._connections.pop(self, None)
        super().connection_lost(exc)

    def abort(self) -> None:
        """Drop the connection now, whatever is still to be sent."""
        self._connections.pop(self, None)
        self.transport.abort()

    async def ping(self, data: Any = None) -> Awaitable[float]:
        """Send a ping. The default payload comes from the operating system."""
        return await super().ping(os.urandom(_PAYLOAD_BYTES) if data is None else data)
