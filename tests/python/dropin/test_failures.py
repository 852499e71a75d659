"""Behavior that users rely on, and fixes of the published package: failures."""

from pathlib import Path

import pytest

from gradysim.protocol.messages.communication import (
    CommunicationCommand,
    SendMessageCommand,
)
from gradysim.protocol.plugin.mission_mobility import MissionMobilityPlugin, MissionMobilityPluginException
from gradysim.simulator.handler.communication import CommunicationException
from gradysim.simulator.handler.timer import TimerException
from python.dropin.user_code import simulation
from python.quiet_protocol import Quiet


def test_an_exception_of_a_protocol_is_raised_and_says_where_it_was() -> None:
    class Broken(Quiet):
        def initialize(self) -> None:
            self.provider.schedule_timer("go", 2.5)

        def handle_timer(self, timer: str) -> None:
            raise RuntimeError("broken")

    with pytest.raises(RuntimeError, match="broken") as caught:
        simulation(Quiet, Broken).start_simulation()
    (note,) = caught.value.__notes__
    assert note.startswith("in handle_timer ")
    assert "(Broken 1) at 2.5 s " in note


def test_a_timer_in_the_past_is_an_exception() -> None:
    class Past(Quiet):
        def initialize(self) -> None:
            self.provider.schedule_timer("never", -1)

    with pytest.raises(TimerException, match="never"):
        simulation(Past).start_simulation()


@pytest.mark.parametrize(
    "command",
    [SendMessageCommand("to nobody", 7), SendMessageCommand("to itself", 0)],
    ids=lambda command: command.message,
)
def test_a_message_without_a_receiver_is_an_exception(command: CommunicationCommand) -> None:
    class Sender(Quiet):
        def initialize(self) -> None:
            self.provider.send_communication_command(command)

    with pytest.raises(CommunicationException):
        simulation(Sender, Quiet).start_simulation()


@pytest.mark.parametrize("content", [None, "1,2,3\n4,5\n"], ids=["missing", "malformed"])
def test_a_wrong_mission_file_is_an_exception(tmp_path: Path, content: str | None) -> None:
    file = tmp_path / "mission.txt"
    if content is not None:
        file.write_text(content)

    class Flyer(Quiet):
        def initialize(self) -> None:
            MissionMobilityPlugin(self).start_mission_with_waypoint_file(str(file))

    with pytest.raises(MissionMobilityPluginException, match=r"mission\.txt"):
        simulation(Flyer).start_simulation()


def test_a_negative_pace_is_an_exception() -> None:
    with pytest.raises(ValueError, match="real_time"):
        simulation(real_time=-1)
