"""One vehicle of a fleet in real time, and its steps."""

import asyncio

from gradysim.sitl.fleet import Fleet
from gradysim.sitl.mavlink import MavlinkLink
from gradysim.sitl.vehicle import Vehicle

HOME = (-15.84, -47.92, 1000.0)


def new_fleet(program):
    return Fleet(program, user=None)


async def launched(fleet, identifier=0, timeout_s=20):
    link = MavlinkLink(f"vehicle {identifier}")
    connection = await fleet.launch(link, identifier, HOME, speedup=50, timeout_s=timeout_s)
    return Vehicle(link), connection


def running(fleet):
    """Return the ids of its processes."""
    return [process.pid for process in fleet._processes if process.is_running]


def fly(fleet, steps):
    """Run the steps, a coroutine function of a connected vehicle."""

    async def run():
        vehicle, connection = await launched(fleet)
        try:
            await vehicle.meet(10)
            return await steps(vehicle)
        finally:
            connection.close()
            await asyncio.sleep(0)

    try:
        return asyncio.run(run())
    finally:
        fleet.close()


async def ready(vehicle):
    await vehicle.stream(10)
    await vehicle.find_position(10)
