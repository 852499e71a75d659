"""The protocols of NAME: vehicles report to a station on the ground.

A protocol is a class that reacts to what happens at one node, and acts through `self.provider`. The same
class runs in prototype mode and in integrated mode.
"""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry


class Vehicle(IProtocol):
    """Flies back and forth, and sends a report every `interval` seconds."""

    # Class attributes are parameters: the .ini file may set them.
    interval: float = 1.0
    jitter: float = 0.0
    far: float = 200.0

    def initialize(self) -> None:
        """Called once, before anything else."""
        self.is_outbound = True
        self.reports = 0
        # What is here is in the results of the run.
        self.provider.tracked_variables["reports"] = 0
        self.turn()
        self.plan_report()

    def turn(self) -> None:
        """Fly to the other end of the way."""
        x = self.far if self.is_outbound else 0.0
        self.target = (x, 10.0 * self.provider.get_id(), 30.0)
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(*self.target))

    def plan_report(self) -> None:
        """Set the timer of the next report. Times are seconds since the start of the simulation."""
        wait = self.interval + self.jitter * self.provider.random.random()
        self.provider.schedule_timer("report", self.provider.current_time() + wait)

    def handle_timer(self, timer: str) -> None:
        """Called when a timer is due; `timer` is its name."""
        self.reports += 1
        self.provider.tracked_variables["reports"] = self.reports
        message = f"report {self.reports} of {self.provider.get_id()}"
        self.provider.send_communication_command(BroadcastMessageCommand(message))
        self.plan_report()

    def handle_packet(self, message: str) -> None:
        """Called for each message that arrives. Vehicles do not listen to each other."""

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        """Called with the position of the node, in meters, several times a second."""
        x, _, _ = telemetry.current_position
        if abs(x - self.target[0]) < 1:
            self.is_outbound = not self.is_outbound
            self.turn()


class Station(IProtocol):
    """Counts the reports that arrive."""

    def initialize(self) -> None:
        """Called once, before anything else."""
        self.heard = 0
        self.provider.tracked_variables["heard"] = 0

    def handle_packet(self, message: str) -> None:
        """Called for each message that arrives."""
        self.heard += 1
        self.provider.tracked_variables["heard"] = self.heard

    def handle_timer(self, timer: str) -> None:
        """Called when a timer is due. The station sets none."""
