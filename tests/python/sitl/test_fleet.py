"""Autopilots without a simulation, for integrations elsewhere."""

import asyncio
import gc
import os

import pytest

from gradysim.sitl import SitlError
from gradysim.sitl.mavlink import MavlinkLink
from python.sitl.ardupilot_mobility.flying import programs_left_in
from python.sitl.fleet_flight import HOME, fly, launched, new_fleet, ready, running

pytestmark = pytest.mark.usefixtures("own_folder")


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
        pids = running(fleet)
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
        pids = running(fleet)
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


def test_a_launch_that_is_given_up_closes_its_connection(toy_copter, monkeypatch):
    """Otherwise the explanation of its later failure would use deleted files."""
    fleet, link = new_fleet(toy_copter()), MavlinkLink("vehicle 0")

    async def fail_once_it_is_made(connection, process, timeout_s):
        await connection.made.wait()
        raise SitlError("deliberate")

    monkeypatch.setattr("gradysim.sitl.fleet._connected", fail_once_it_is_made)
    with pytest.raises(SitlError, match="deliberate"):
        asyncio.run(fleet.launch(link, 0, HOME, speedup=50, timeout_s=20))
    fleet.close()
    assert link.lost


def test_an_autopilot_that_does_not_connect_is_told(tmp_path):
    program = tmp_path / "sleeper"
    program.write_text('#!/bin/sh\n[ "$1" = --help ] || exec sleep 60\n')
    program.chmod(0o755)
    fleet = new_fleet(program)
    with pytest.raises(SitlError, match=r"^vehicle 0: .*0\.1 s$"):
        asyncio.run(launched(fleet, timeout_s=0.1))
    fleet.close()


def test_a_program_that_does_not_answer_to_help_is_told_and_ends_with_what_it_started(tmp_path, monkeypatch):
    program = tmp_path / "wrapper"
    program.write_text('#!/bin/sh\ntail -f "$0"\nexit\n')
    program.chmod(0o755)
    monkeypatch.setattr("gradysim.sitl.fleet._HELP_S", 0.5)
    fleet = new_fleet(program)
    with pytest.raises(SitlError) as caught:
        asyncio.run(launched(fleet))
    assert str(caught.value).startswith("vehicle 0: ")
    assert f" {program} " in str(caught.value)
    assert caught.value.__cause__ is caught.value.__context__ is None
    assert programs_left_in(tmp_path) == []
    fleet.close()
