"""MAVLink messages and the dialect."""

import asyncio
import os
import subprocess
import sys
from pathlib import Path

import pytest

from gradysim.sitl import SitlError
from gradysim.sitl.mavlink import MavlinkLink, load_dialect

mavlink = load_dialect()


class Sender:
    """Encodes the messages of one component."""

    def __init__(self, system=1, component=1):
        self.codec = mavlink.MAVLink(None, srcSystem=system, srcComponent=component)

    def heartbeat(self, autopilot=mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA, mode=0):
        return mavlink.MAVLink_heartbeat_message(2, autopilot, 1, mode, 4, 3).pack(self.codec)

    def text(self, text):
        return mavlink.MAVLink_statustext_message(2, text.encode()).pack(self.codec)


@pytest.fixture
def link():
    return MavlinkLink("node 3")


def test_messages_may_come_in_parts_and_among_noise(link):
    data = Sender().heartbeat(mode=4)
    for part in (b"noise", data[:5], data[5:], b"\xfd"):
        link.feed(part)
    assert link.latest["HEARTBEAT"].custom_mode == 4


def test_links_do_not_mix_their_parts(link):
    other = MavlinkLink("node 4")
    data = Sender().heartbeat()
    link.feed(data[:5])
    other.feed(data)
    link.feed(data[5:])
    assert "HEARTBEAT" in link.latest
    assert "HEARTBEAT" in other.latest


def test_only_the_autopilot_is_listened_to(link):
    camera, autopilot = Sender(1, 100), Sender(7, 1)
    link.feed(camera.heartbeat(autopilot=mavlink.MAV_AUTOPILOT_INVALID))
    link.feed(autopilot.heartbeat(mode=4))
    link.feed(camera.heartbeat(mode=9) + camera.text("click"))
    assert link.target == (7, 1)
    assert link.latest["HEARTBEAT"].custom_mode == 4
    assert list(link.texts) == []


def test_what_it_says_is_kept(link):
    sender = Sender()
    link.feed(sender.heartbeat() + sender.text("PreArm: no") + sender.text("PreArm: never"))
    assert list(link.texts) == ["PreArm: no", "PreArm: never"]


def test_who_waits_gets_the_first_message_that_is_accepted(link):
    async def wait():
        asyncio.get_running_loop().call_soon(
            link.feed, Sender().heartbeat(mode=1) + Sender().heartbeat(mode=4)
        )
        return await link.wait_for(lambda message: message.custom_mode == 4, 10)

    assert asyncio.run(wait()).custom_mode == 4


def test_who_waits_in_vain_gets_nothing(link):
    assert asyncio.run(link.wait_for(lambda message: True, 0.01)) is None


def test_who_waits_when_the_link_is_lost_is_told(link):
    async def wait():
        asyncio.get_running_loop().call_soon(link.lose, "it fell down")
        await link.wait_for(lambda message: True, None)

    with pytest.raises(SitlError, match=r"^node 3: .*down$"):
        asyncio.run(wait())


def test_after_the_link_was_lost_everything_is_refused(link):
    link.lose("it fell down")
    link.lose("and again")
    with pytest.raises(SitlError, match=r"^node 3: .*down$"):
        link.send(mavlink.MAVLink_heartbeat_message(6, 8, 0, 0, 4, 3))
    with pytest.raises(SitlError, match=r"^node 3: .*down$"):
        asyncio.run(link.wait_for(lambda message: True, 1))


def test_it_writes_version_2():
    mavlink = load_dialect()
    codec = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
    assert mavlink.MAVLink_heartbeat_message(6, 8, 0, 0, 4, 3).pack(codec)[0] == 0xFD


def test_without_pymavlink_it_says_what_to_install(monkeypatch):
    load_dialect.cache_clear()
    monkeypatch.setitem(sys.modules, "pymavlink.dialects.v20.ardupilotmega", None)
    with pytest.raises(ModuleNotFoundError, match=r"pip.*pymavlink"):
        load_dialect()


def test_pymavlink_is_imported_only_when_it_is_needed():
    program = "import gradysim.simulator.handler.ardupilot_mobility, sys; print('pymavlink' in sys.modules)"
    package = Path(__file__).parents[3] / "python"
    outcome = subprocess.run(
        [sys.executable, "-c", program],
        env=os.environ | {"PYTHONPATH": str(package)},
        capture_output=True,
        text=True,
        check=True,
    )
    assert outcome.stdout == "False\n"
