"""Connection to a viewer. In a separate file, since only a server imports the package `websockets`."""

import os
from collections.abc import Awaitable
from typing import Any

from websockets.asyncio.server import ServerConnection

_PAYLOAD_BYTES = 4


class ViewerConnection(ServerConnection):
    """Does not draw from Python's `random`, which belongs to the run; the library draws for each ping."""

    async def ping(self, data: Any = None) -> Awaitable[float]:
        """Send a ping. The default payload comes from the operating system."""
        return await super().ping(os.urandom(_PAYLOAD_BYTES) if data is None else data)
