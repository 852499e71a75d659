"""Nodes that fly straight to a point from the start: one broadcasts, the other records its receptions."""

from beacon import Beacon
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand


class FlyingBeacon(Beacon):
    """Broadcasts like Beacon, in flight.

    Tracked variables, at the end: as in Beacon.
    """

    target_x: float = 0.0
    """x of the target; meters."""
    target_y: float = 0.0
    """y of the target; meters."""
    target_z: float = 0.0
    """z of the target; meters."""

    def initialize(self) -> None:
        """Take off, and schedule the first message."""
        super().initialize()
        target = GotoCoordsMobilityCommand(self.target_x, self.target_y, self.target_z)
        self.provider.send_mobility_command(target)


class FlyingSink(IProtocol):
    """Records receptions, in flight.

    Tracked variables, at the end:
        received_at: Time of each reception, in seconds.
    """

    target_x: float = 0.0
    """x of the target; meters."""
    target_y: float = 0.0
    """y of the target; meters."""
    target_z: float = 0.0
    """z of the target; meters."""

    def initialize(self) -> None:
        """Take off."""
        self._received_at: list[float] = []
        target = GotoCoordsMobilityCommand(self.target_x, self.target_y, self.target_z)
        self.provider.send_mobility_command(target)

    def handle_packet(self, message: str) -> None:
        """Record the time."""
        self._received_at.append(self.provider.current_time())

    def handle_timer(self, timer: str) -> None:
        """Do nothing: there are no timers."""

    def finish(self) -> None:
        """Track the times."""
        self.provider.tracked_variables["received_at"] = self._received_at
