"""Passes a vehicle's messages on to a ground station's program, and its orders back."""

import asyncio
from typing import Any, cast

from gradysim.sitl.error import SitlError
from gradysim.sitl.link import MavlinkLink

PORT = 14550
"""UDP port on which ground stations' programs listen for vehicles."""


class GroundStationPort(asyncio.DatagramProtocol):
    """One vehicle's way to a ground station; to it each vehicle is at a port of its own."""

    def __init__(self, link: MavlinkLink) -> None:
        self._link = link
        self._transport: asyncio.DatagramTransport | None = None

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Begin to pass on."""
        # Before Python 3.12 it is not an instance of that class.
        self._transport = cast(asyncio.DatagramTransport, transport)
        self._link.on_bytes = self._transport.sendto

    def datagram_received(self, data: bytes, addr: Any) -> None:
        """Hand an order to the vehicle, as it is."""
        if self._link.lost is None:
            self._link.send_bytes(data)

    def error_received(self, exc: Exception) -> None:
        """Go on: nobody may listen there, for now."""
        return

    def close(self) -> None:
        """Stop."""
        if self._transport is not None:
            self._transport.abort()


async def open_ground_station(link: MavlinkLink, host: str, port: int = PORT) -> GroundStationPort:
    """Join a vehicle with the ground station at a host; SitlError if there is no such host."""
    loop = asyncio.get_running_loop()
    try:
        _, opened = await loop.create_datagram_endpoint(
            lambda: GroundStationPort(link), remote_addr=(host, port)
        )
    except OSError as error:
        raise SitlError(f"{link.name}: no way to the ground station {host}:{port}: {error}") from error
    return opened
