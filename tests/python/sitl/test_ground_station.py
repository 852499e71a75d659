"""The way from a vehicle to a ground station and back."""

import asyncio
import socket

import pytest

from gradysim.sitl.error import SitlError
from gradysim.sitl.ground_station import open_ground_station
from gradysim.sitl.link import MavlinkLink


@pytest.fixture
def orders():
    """What was sent to the vehicle."""
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
    """Do the steps, a coroutine function of the way between a link and a port."""

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
            for _ in range(2):  # the first one learns that nobody was there
                link.feed(b"late")
            return station.recv(1000)

    assert joined(link, address[1], steps) == b"late"


def test_a_host_that_does_not_exist_is_named(link):
    with pytest.raises(SitlError, match=r"^vehicle 0: no way to the ground station no host:14550: "):
        asyncio.run(open_ground_station(link, "no host"))
