"""The connection to a viewer; apart, as only a server imports the package `websockets`."""

import os
from collections.abc import Awaitable
from typing import Any

from websockets.asyncio.server import ServerConnection

_PAYLOAD_BYTES = 4


class ViewerConnection(ServerConnection):
    """Leaves Python's `random` to the run: the library draws from it whenever it looks for a lost viewer."""

    async def ping(self, data: Any = None) -> Awaitable[float]:
        """Send a ping, by itself with a payload of the operating system."""
        return await super().ping(os.urandom(_PAYLOAD_BYTES) if data is None else data)
