"""What a vehicle reports to its protocol, periodically."""

from dataclasses import dataclass

from gradysim.protocol.position import Position


@dataclass
class Telemetry:
    """State of the vehicle now.

    Attributes:
        current_position: (x, y, z) in meters.
    """

    current_position: Position
