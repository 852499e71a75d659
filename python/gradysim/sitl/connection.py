"""Connections to a vehicle (TCP and UDP, with asyncio), and from there to a ground station."""

import asyncio
from collections.abc import Callable
from typing import Any, cast

from gradysim.sitl import SitlError
from gradysim.sitl.mavlink import MavlinkLink

_GONE = "the connection was closed by the other side"
_CLOSED = "the connection was closed"
_RETRY_S = 0.2


class StreamConnection(asyncio.Protocol):
    """TCP connection of a link.

    Attributes:
        made: Set when the connection exists.
        explain: Returns why a connection has ended, if the caller knows more than the socket.
    """

    def __init__(self, link: MavlinkLink, explain: Callable[[], str] | None = None) -> None:
        self._link = link
        self.explain = explain
        self.made = asyncio.Event()
        self._is_taken = False
        self._transport: asyncio.Transport | None = None

    def accept(self) -> asyncio.Protocol:
        """Return the protocol for a new client of a server: this one first, then one that refuses."""
        if self._is_taken:
            return _Refusal()
        self._is_taken = True
        return self

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Use the connection, unless the link was lost in the meantime."""
        assert isinstance(transport, asyncio.Transport)
        if self._link.lost is not None:
            transport.abort()
            return
        self._transport = transport
        self._link.send_bytes = transport.write
        self.made.set()

    def data_received(self, data: bytes) -> None:
        """Pass bytes to the link."""
        self._link.feed(data)

    def connection_lost(self, exc: Exception | None) -> None:
        """Report that the link is lost. This is the first sign that an autopilot has ended."""
        if self._link.lost is None:
            reason = _GONE if exc is None else f"the connection broke: {exc}"
            self._link.lose(reason if self.explain is None else self.explain())

    def close(self) -> None:
        """Close the connection, even if it is not made yet, and the link."""
        self._link.lose(_CLOSED)
        if self._transport is not None:
            self._transport.abort()


class _Refusal(asyncio.Protocol):
    """Protocol that closes unexpected connections."""

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        assert isinstance(transport, asyncio.Transport)
        transport.abort()


class DatagramConnection(asyncio.DatagramProtocol):
    """UDP port of a link. Datagrams go to its only peer, or to the sender of the latest one."""

    def __init__(self, link: MavlinkLink, *, has_one_peer: bool) -> None:
        self._link = link
        self._has_one_peer = has_one_peer
        self._peer: Any = None
        self._transport: asyncio.DatagramTransport | None = None

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Use the port."""
        # Before Python 3.12 it is not an instance of that class.
        self._transport = cast(asyncio.DatagramTransport, transport)
        self._link.send_bytes = self._send

    def datagram_received(self, data: bytes, addr: Any) -> None:
        """Pass bytes to the link."""
        if not self._has_one_peer:
            self._peer = addr
        self._link.feed(data)

    def close(self) -> None:
        """Close the port and the link."""
        self._link.lose(_CLOSED)
        if self._transport is not None:
            self._transport.abort()

    def _send(self, data: bytes) -> None:
        if self._transport is not None and (self._has_one_peer or self._peer is not None):
            self._transport.sendto(data, self._peer)


Connection = StreamConnection | DatagramConnection


def parse_address(text: str) -> tuple[str, str, int]:
    """Return (kind, host, port) of "tcp:HOST:PORT", "udpin:HOST:PORT" or "udpout:HOST:PORT".

    The kinds are to connect to, to listen on and to send to. Raise ValueError for another text.
    """
    kind, _, rest = text.partition(":")
    host, _, port = rest.rpartition(":")
    if kind in ("tcp", "udpin", "udpout") and host and port.isdecimal() and 0 < int(port) < 65536:
        return kind, host, int(port)
    raise ValueError(
        f"expected the address of a vehicle, tcp:HOST:PORT, udpin:HOST:PORT or udpout:HOST:PORT, got {text!r}"
    )


async def connect(link: MavlinkLink, address: str, timeout_s: float) -> Connection:
    """Connect a link to a running vehicle at an address of `parse_address`.

    Raise SitlError if the vehicle does not answer within `timeout_s` of wall time.
    """
    kind, host, port = parse_address(address)
    loop = asyncio.get_running_loop()
    connection: Connection
    try:
        async with asyncio.timeout(timeout_s):
            if kind == "tcp":
                connection = await _connect_stream(link, host, port)
            elif kind == "udpin":
                _, connection = await loop.create_datagram_endpoint(
                    lambda: DatagramConnection(link, has_one_peer=False), local_addr=(host, port)
                )
            else:
                _, connection = await loop.create_datagram_endpoint(
                    lambda: DatagramConnection(link, has_one_peer=True), remote_addr=(host, port)
                )
    except (OSError, TimeoutError) as error:
        why = str(error) or f"no answer in {timeout_s:g} s"
        raise SitlError(f"{link.name}: cannot connect to {address}: {why}") from error
    return connection


async def _connect_stream(link: MavlinkLink, host: str, port: int) -> StreamConnection:
    """Connect. Try again while the port is closed."""
    loop = asyncio.get_running_loop()
    while True:
        try:
            _, connection = await loop.create_connection(lambda: StreamConnection(link), host, port)
        except ConnectionRefusedError:
            await asyncio.sleep(_RETRY_S)
        else:
            return connection


PORT = 14550
"""UDP port on which ground station programs listen for vehicles."""


class GroundStationPort(asyncio.DatagramProtocol):
    """Connection of one vehicle to a ground station, which may start later, from a port of its own."""

    def __init__(self, link: MavlinkLink) -> None:
        self._link = link
        self._transport: asyncio.DatagramTransport | None = None

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Start to forward messages of the vehicle."""
        # Before Python 3.12 it is not an instance of that class.
        self._transport = cast(asyncio.DatagramTransport, transport)
        self._link.on_bytes = self._transport.sendto

    def datagram_received(self, data: bytes, addr: Any) -> None:
        """Forward a message of the ground station to the vehicle."""
        if self._link.lost is None:
            self._link.send_bytes(data)

    def close(self) -> None:
        """Close the port."""
        if self._transport is not None:
            self._transport.abort()


async def open_ground_station(link: MavlinkLink, host: str, port: int = PORT) -> GroundStationPort:
    """Connect a vehicle with the ground station at a host. Raise SitlError if the host does not exist."""
    loop = asyncio.get_running_loop()
    try:
        _, opened = await loop.create_datagram_endpoint(
            lambda: GroundStationPort(link), remote_addr=(host, port)
        )
    except OSError as error:
        raise SitlError(f"{link.name}: no way to the ground station {host}:{port}: {error}") from error
    return opened
