"""Nodes that fly straight to a point from the start on: one broadcasts, one remembers what it heard when."""

from beacon import Beacon
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry


class FlyingBeacon(Beacon):
    """Broadcasts as Beacon does, in flight.

    Tracked variables, at the end: those of Beacon.
    """

    target_x: float = 0.0
    """Where it flies to; metres."""
    target_y: float = 0.0
    """Metres."""
    target_z: float = 0.0
    """Metres."""

    def initialize(self) -> None:
        """Take off, and schedule the first message."""
        super().initialize()
        target = GotoCoordsMobilityCommand(self.target_x, self.target_y, self.target_z)
        self.provider.send_mobility_command(target)


class FlyingSink(IProtocol):
    """Listens, in flight.

    Tracked variables, at the end:
        received_at: The time of each message, in seconds.
    """

    target_x: float = 0.0
    """Where it flies to; metres."""
    target_y: float = 0.0
    """Metres."""
    target_z: float = 0.0
    """Metres."""

    def initialize(self) -> None:
        """Take off."""
        self._received_at: list[float] = []
        target = GotoCoordsMobilityCommand(self.target_x, self.target_y, self.target_z)
        self.provider.send_mobility_command(target)

    def handle_packet(self, message: str) -> None:
        """Remember."""
        self._received_at.append(self.provider.current_time())

    def handle_timer(self, timer: str) -> None:
        """There are no timers."""

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        """Where it is does not matter."""

    def finish(self) -> None:
        """Show the times."""
        self.provider.tracked_variables["received_at"] = self._received_at
