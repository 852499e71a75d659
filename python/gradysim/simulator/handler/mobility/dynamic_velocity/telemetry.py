"""What a vehicle that is steered by velocity reports."""

from dataclasses import dataclass

from gradysim.protocol.messages.telemetry import Telemetry

Velocity = tuple[float, float, float]
"""(vx, vy, vz) in m/s."""


@dataclass
class DynamicVelocityTelemetry(Telemetry):
    """State of the vehicle now.

    Attributes:
        current_velocity: (vx, vy, vz) in m/s; what it flies, not what it was told to.
    """

    current_velocity: Velocity
