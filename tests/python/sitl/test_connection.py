"""Connections to vehicles and ground stations."""

import asyncio
import contextlib
import socket

import pytest

from gradysim.sitl import SitlError
from gradysim.sitl.connection import StreamConnection, connect, open_ground_station, parse_address
from gradysim.sitl.mavlink import MavlinkLink, load_dialect

mavlink = load_dialect()
HEARTBEAT = mavlink.MAVLink_heartbeat_message(2, 3, 1, 4, 4, 3)


def packed():
    return HEARTBEAT.pack(mavlink.MAVLink(None, srcSystem=1, srcComponent=1))


def any_message(message):
    return True


def test_an_address_has_three_parts():
    assert parse_address("udpin:0.0.0.0:14550") == ("udpin", "0.0.0.0", 14550)


@pytest.mark.parametrize(
    "text", ["", "tcp", "tcp:5760", "tcp::5760", "tcp:host:0", "tcp:host:99999", "serial:a:1"]
)
def test_other_texts_are_refused(text):
    with pytest.raises(ValueError, match="tcp:HOST:PORT"):
        parse_address(text)


def free_port(kind=socket.SOCK_DGRAM):
    with socket.socket(socket.AF_INET, kind) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


async def exchange(address, vehicle):
    """Connect; receive a message of the vehicle, a function of a connected link, and send one to it."""
    link = MavlinkLink("node 0")
    connection = await connect(link, address, 5)
    try:
        return await vehicle(link)
    finally:
        connection.close()
        await asyncio.sleep(0)


def test_udpin_listens_and_answers_to_where_messages_come_from():
    port = free_port()

    async def vehicle(link):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as udp:
            udp.setblocking(False)
            link.send(HEARTBEAT)  # without a receiver so far
            udp.sendto(packed(), ("127.0.0.1", port))
            assert await link.wait_for(any_message, 5) is not None
            link.send(HEARTBEAT)
            return await asyncio.get_running_loop().sock_recv(udp, 1000)

    assert len(asyncio.run(exchange(f"udpin:127.0.0.1:{port}", vehicle))) == len(packed())


def test_udpout_speaks_first():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as udp:
        udp.bind(("127.0.0.1", 0))
        udp.setblocking(False)

        async def vehicle(link):
            link.send(HEARTBEAT)
            _, address = await asyncio.get_running_loop().sock_recvfrom(udp, 1000)
            udp.sendto(packed(), address)
            return await link.wait_for(any_message, 5)

        message = asyncio.run(exchange(f"udpout:127.0.0.1:{udp.getsockname()[1]}", vehicle))
    assert message.custom_mode == 4


def test_a_tcp_connection_that_ends_loses_the_link():
    with socket.create_server(("127.0.0.1", 0)) as server:

        async def vehicle(link):
            server.accept()[0].close()
            await link.wait_for(any_message, 5)

        with pytest.raises(SitlError, match=r"^node 0: "):
            asyncio.run(exchange(f"tcp:127.0.0.1:{server.getsockname()[1]}", vehicle))


def test_where_nobody_listens_it_gives_up_in_time():
    port = free_port(socket.SOCK_STREAM)
    with pytest.raises(SitlError, match=rf"^node 0: .*tcp:127.0.0.1:{port}.* 0.01 s"):
        asyncio.run(connect(MavlinkLink("node 0"), f"tcp:127.0.0.1:{port}", 0.01))


def test_who_comes_second_is_refused_and_does_not_end_the_first():
    async def visit():
        link = MavlinkLink("node 0")
        connection = StreamConnection(link)
        loop = asyncio.get_running_loop()
        server = await loop.create_server(connection.accept, "127.0.0.1", 0)
        address = server.sockets[0].getsockname()
        first, second = await asyncio.open_connection(*address), await asyncio.open_connection(*address)
        refused = await second[0].read()
        first[1].write(packed())
        message = await link.wait_for(any_message, 5)
        lost = link.lost
        for _, writer in (first, second):
            writer.close()
        connection.close()
        server.close()
        return refused, message.get_type(), lost

    assert asyncio.run(visit()) == (b"", "HEARTBEAT", None)


def test_a_connection_that_is_closed_while_it_is_accepted_is_not_made():
    connection = StreamConnection(MavlinkLink("node 0"))

    def accept():
        asyncio.get_running_loop().call_soon(connection.close)  # asyncio makes the connection afterwards
        return connection.accept()

    async def vehicle():
        server = await asyncio.get_running_loop().create_server(accept, "127.0.0.1", 0)
        async with server:
            reader, writer = await asyncio.open_connection(*server.sockets[0].getsockname())
            with contextlib.suppress(ConnectionResetError):
                assert await asyncio.wait_for(reader.read(), 5) == b""
            writer.close()

    asyncio.run(vehicle())
    assert not connection.made.is_set()


@pytest.fixture
def orders():
    """Return the messages sent to the vehicle."""
    return asyncio.Queue()


@pytest.fixture
def link(orders):
    link = MavlinkLink("vehicle 0")
    link.send_bytes = orders.put_nowait
    return link


@pytest.fixture
def station():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as station:
        station.bind(("127.0.0.1", 0))
        station.settimeout(5)
        yield station


def joined(link, port, steps):
    """Run the steps, a coroutine function of the path between a link and a port."""

    async def run():
        way = await open_ground_station(link, "127.0.0.1", port)
        try:
            return await steps(way)
        finally:
            way.close()
            await asyncio.sleep(0)

    return asyncio.run(run())


def test_bytes_go_both_ways_as_they_are(link, orders, station):
    async def steps(way):
        link.feed(b"no MAVLink")
        data, address = station.recvfrom(1000)
        station.sendto(b"nor this", address)
        return data, await asyncio.wait_for(orders.get(), 5)

    assert joined(link, station.getsockname()[1], steps) == (b"no MAVLink", b"nor this")


def test_each_vehicle_is_at_a_port_of_its_own(link, station):
    host, port = station.getsockname()

    async def steps(way):
        other = MavlinkLink("vehicle 1")
        other_way = await open_ground_station(other, host, port)
        for each in (link, other):
            each.feed(b"hello")
        other_way.close()
        return {station.recvfrom(1000)[1] for _ in range(2)}

    assert len(joined(link, port, steps)) == 2


def test_an_order_to_a_vehicle_that_is_gone_is_dropped(link, orders, station):
    async def steps(way):
        link.feed(b"hello")
        _, address = station.recvfrom(1000)
        station.sendto(b"first", address)
        await asyncio.wait_for(orders.get(), 5)
        link.lose("it fell down")
        way.datagram_received(b"second", address)

    joined(link, station.getsockname()[1], steps)
    assert orders.empty()


def test_a_ground_station_may_come_later(link):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        address = probe.getsockname()

    async def steps(way):
        link.feed(b"early")
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as station:
            station.bind(address)
            station.settimeout(5)
            for _ in range(2):  # the first one notices that the peer has left
                link.feed(b"late")
            return station.recv(1000)

    assert joined(link, address[1], steps) == b"late"


def test_a_host_that_does_not_exist_is_named(link):
    with pytest.raises(SitlError, match=r"^vehicle 0: .*no host:14550"):
        asyncio.run(open_ground_station(link, "no host"))
