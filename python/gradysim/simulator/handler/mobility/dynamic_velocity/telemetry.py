"""Telemetry of a vehicle steered by velocity."""

from dataclasses import dataclass

from gradysim.protocol.messages.telemetry import Telemetry

Velocity = tuple[float, float, float]
"""(vx, vy, vz) in m/s."""


@dataclass
class DynamicVelocityTelemetry(Telemetry):
    """Current state of the vehicle.

    Attributes:
        current_velocity: Actual (vx, vy, vz) in m/s, not the commanded one.
    """

    current_velocity: Velocity
