"""Autopilots without a simulation: what integrates them somewhere else builds on this."""

import asyncio
import gc
import os

import pytest

from gradysim.sitl.error import SitlError
from gradysim.sitl.fleet import Fleet
from gradysim.sitl.link import MavlinkLink
from gradysim.sitl.vehicle import Vehicle

HOME = (-15.84, -47.92, 1000.0)


@pytest.fixture(autouse=True)
def _in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))


async def launched(fleet, identifier=0, timeout_s=20):
    link = MavlinkLink(f"vehicle {identifier}")
    connection = await fleet.launch(link, identifier, HOME, speedup=50, timeout_s=timeout_s)
    return Vehicle(link), connection


def fly(fleet, steps):
    """Do the steps, a coroutine function of a vehicle that has been met."""

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


def new_fleet(program):
    return Fleet(program, user=None)


async def ready(vehicle):
    await vehicle.stream(10)
    await vehicle.find_position(10)


def test_a_flight(toy_copter):
    async def steps(vehicle):
        await ready(vehicle)
        await vehicle.enter_guided(10)
        await vehicle.arm(10)
        await vehicle.take_off(10, 10)
        await vehicle.arrive(HOME[0] + 1e-4, HOME[1], 15, 10)
        return vehicle.position

    assert fly(new_fleet(toy_copter()), steps) == pytest.approx((HOME[0] + 1e-4, HOME[1], 15), abs=1)


def test_a_take_off_without_arming_is_an_error_and_no_progress(toy_copter):
    async def steps(vehicle):
        await ready(vehicle)
        await vehicle.take_off(10, 10)

    with pytest.raises(SitlError, match=r"^vehicle 0: take-off: refused with MAV_RESULT_FAILED"):
        fly(new_fleet(toy_copter()), steps)


def test_a_speed_that_is_refused_is_an_error(toy_copter):
    with pytest.raises(SitlError, match=r"^vehicle 0: speed -1 m/s: refused with MAV_RESULT_FAILED"):
        fly(new_fleet(toy_copter()), lambda vehicle: vehicle.set_speed(-1))


def test_a_parameter_that_is_not_confirmed_is_an_error(toy_copter, monkeypatch):
    monkeypatch.setattr("gradysim.sitl.vehicle._ANSWER_S", 0.05)
    with pytest.raises(SitlError, match=r"^vehicle 0: parameter NONESUCH = 1: not confirmed after 5 tries"):
        fly(new_fleet(toy_copter()), lambda vehicle: vehicle.set_parameter("NONESUCH", 1))


def is_alive(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def test_closing_ends_all_and_removes_their_files(toy_copter, tmp_path):
    fleet = new_fleet(toy_copter())

    async def run():
        connections = [(await launched(fleet, identifier))[1] for identifier in range(3)]
        pids = fleet.pids
        for connection in connections:
            connection.close()
        await asyncio.sleep(0)
        return pids

    pids = asyncio.run(run())
    fleet.close()
    fleet.close()
    assert len(pids) == 3
    assert [pid for pid in pids if is_alive(pid)] == []
    assert list(tmp_path.glob("gradysim-sitl-*")) == []


def test_a_fleet_that_is_dropped_ends_too(toy_copter, tmp_path):
    async def run():
        fleet = new_fleet(toy_copter())
        _, connection = await launched(fleet)
        pids = fleet.pids
        connection.close()
        await asyncio.sleep(0)
        return pids

    (pid,) = asyncio.run(run())
    gc.collect()
    assert not is_alive(pid)
    assert list(tmp_path.glob("gradysim-sitl-*")) == []


def test_the_path_of_its_folder_may_have_a_comma(toy_copter, tmp_path, monkeypatch):
    folder = tmp_path / "a, b"
    folder.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(folder))
    fly(new_fleet(toy_copter()), ready)


def test_a_message_that_seems_to_be_refused_is_asked_for_again(toy_copter):
    fly(new_fleet(toy_copter({0: {"refuses_first": True}})), ready)


def test_an_autopilot_that_does_not_connect_is_told(tmp_path):
    program = tmp_path / "sleeper"
    program.write_text('#!/bin/sh\n[ "$1" = --help ] || exec sleep 60\n')
    program.chmod(0o755)
    fleet = new_fleet(program)
    with pytest.raises(SitlError, match=r"^vehicle 0: start: it did not connect in 0.1 s$"):
        asyncio.run(launched(fleet, timeout_s=0.1))
    fleet.close()
