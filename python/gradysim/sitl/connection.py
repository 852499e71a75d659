"""The ways by which bytes come from a vehicle and go to it: TCP and UDP, with asyncio."""

import asyncio
from collections.abc import Callable
from typing import Any, cast

from gradysim.sitl.error import SitlError
from gradysim.sitl.link import MavlinkLink

_GONE = "the connection was closed by the other side"
_CLOSED = "the connection was closed"
_RETRY_S = 0.2


class StreamConnection(asyncio.Protocol):
    """Joins a link with a TCP connection.

    Attributes:
        made: Whether somebody has connected.
        explain: Says what ended a connection that broke, if somebody knows better than this end of it.
    """

    def __init__(self, link: MavlinkLink, explain: Callable[[], str] | None = None) -> None:
        self._link = link
        self.explain = explain
        self.made = asyncio.Event()
        self._is_taken = False
        self._transport: asyncio.Transport | None = None

    def accept(self) -> asyncio.Protocol:
        """Return what a server gives the next one who connects: this, once. Who comes later is refused."""
        if self._is_taken:
            return _Refusal()
        self._is_taken = True
        return self

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Take the connection, unless the link was given up after it had been accepted."""
        assert isinstance(transport, asyncio.Transport)
        if self._link.lost is not None:
            transport.abort()
            return
        self._transport = transport
        self._link.send_bytes = transport.write
        self.made.set()

    def data_received(self, data: bytes) -> None:
        """Pass bytes on."""
        self._link.feed(data)

    def connection_lost(self, exc: Exception | None) -> None:
        """Say so: no bytes to read is how the death of an autopilot shows first."""
        if self._link.lost is None:
            reason = _GONE if exc is None else f"the connection broke: {exc}"
            self._link.lose(reason if self.explain is None else self.explain())

    def close(self) -> None:
        """Close the connection, even one that is about to be made, and the link with it."""
        self._link.lose(_CLOSED)
        if self._transport is not None:
            self._transport.abort()


class _Refusal(asyncio.Protocol):
    """Of a connection that nobody waits for."""

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Close it."""
        assert isinstance(transport, asyncio.Transport)
        transport.abort()


class DatagramConnection(asyncio.DatagramProtocol):
    """Joins a link with a UDP port. Datagrams go to its one peer, or to where the last one came from."""

    def __init__(self, link: MavlinkLink, *, has_one_peer: bool) -> None:
        self._link = link
        self._has_one_peer = has_one_peer
        self._peer: Any = None
        self._transport: asyncio.DatagramTransport | None = None

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Take the port."""
        # Before Python 3.12 it is not an instance of that class.
        self._transport = cast(asyncio.DatagramTransport, transport)
        self._link.send_bytes = self._send

    def datagram_received(self, data: bytes, addr: Any) -> None:
        """Pass bytes on."""
        if not self._has_one_peer:
            self._peer = addr
        self._link.feed(data)

    def close(self) -> None:
        """Close the port, and the link with it."""
        self._link.lose(_CLOSED)
        if self._transport is not None:
            self._transport.abort()

    def _send(self, data: bytes) -> None:
        if self._transport is not None and (self._has_one_peer or self._peer is not None):
            self._transport.sendto(data, self._peer)


Connection = StreamConnection | DatagramConnection


def parse_address(text: str) -> tuple[str, str, int]:
    """Return (kind, host, port) of "tcp:HOST:PORT", "udpin:HOST:PORT" or "udpout:HOST:PORT".

    Raises:
        ValueError: It is none of these.
    """
    kind, _, rest = text.partition(":")
    host, _, port = rest.rpartition(":")
    if kind in ("tcp", "udpin", "udpout") and host and port.isdecimal() and 0 < int(port) < 65536:
        return kind, host, int(port)
    raise ValueError(
        f"expected the address of a vehicle, tcp:HOST:PORT, udpin:HOST:PORT or udpout:HOST:PORT, got {text!r}"
    )


async def connect(link: MavlinkLink, address: str, timeout_s: float) -> Connection:
    """Connect a link with a vehicle that is there already.

    Args:
        link: Without a connection so far.
        address: "tcp:HOST:PORT" to connect to, "udpin:HOST:PORT" to listen on, "udpout:HOST:PORT" to speak
            to first.
        timeout_s: Wall time for connecting.

    Raises:
        ValueError: The address is none.
        SitlError: There is nobody.
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
    """Connect, as soon as somebody listens."""
    loop = asyncio.get_running_loop()
    while True:
        try:
            _, connection = await loop.create_connection(lambda: StreamConnection(link), host, port)
        except ConnectionRefusedError:
            await asyncio.sleep(_RETRY_S)
        else:
            return connection
