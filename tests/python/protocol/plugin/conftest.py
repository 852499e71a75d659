import pytest

from gradysim.protocol.interface import IProtocol, IProvider
from gradysim.protocol.messages.mobility import MobilityCommandType


class RecordingProvider(IProvider):
    """Keeps the mobility commands that it is given."""

    def __init__(self):
        self.commands = []
        self.tracked_variables = {}

    def send_communication_command(self, command):
        pass

    def send_mobility_command(self, command):
        self.commands.append(command)

    def schedule_timer(self, timer, timestamp):
        pass

    def cancel_timer(self, timer):
        pass

    def current_time(self):
        return 0.0

    def get_id(self):
        return 0

    @property
    def targets(self):
        """Points that the vehicle was sent to, in order."""
        return [
            (command.param_1, command.param_2, command.param_3)
            for command in self.commands
            if command.command_type == MobilityCommandType.GOTO_COORDS
        ]

    @property
    def speeds(self):
        return [
            command.param_1
            for command in self.commands
            if command.command_type == MobilityCommandType.SET_SPEED
        ]


class RecordingProtocol(IProtocol):
    """Keeps the callbacks that reach it, as (name, *arguments)."""

    def __init__(self):
        self.calls = []

    def initialize(self):
        self.calls.append(("initialize",))

    def handle_timer(self, timer):
        self.calls.append(("handle_timer", timer))

    def handle_packet(self, message):
        self.calls.append(("handle_packet", message))

    def handle_telemetry(self, telemetry):
        self.calls.append(("handle_telemetry", telemetry))

    def finish(self):
        self.calls.append(("finish",))


@pytest.fixture
def protocol():
    return RecordingProtocol.instantiate(RecordingProvider())
