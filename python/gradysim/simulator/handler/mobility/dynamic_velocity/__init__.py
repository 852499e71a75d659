"""Vehicles steered by velocity, with limited speed and acceleration."""

from gradysim.simulator.handler.mobility.dynamic_velocity.config import (
    DynamicVelocityMobilityConfiguration,
    DynamicVelocityMobilityException,
)
from gradysim.simulator.handler.mobility.dynamic_velocity.core import (
    apply_acceleration_limits,
    apply_velocity_limits,
    apply_velocity_tracking_first_order,
    integrate_position,
)
from gradysim.simulator.handler.mobility.dynamic_velocity.handler import DynamicVelocityMobilityHandler
from gradysim.simulator.handler.mobility.dynamic_velocity.telemetry import DynamicVelocityTelemetry

__all__ = [
    "DynamicVelocityMobilityConfiguration",
    "DynamicVelocityMobilityException",
    "DynamicVelocityMobilityHandler",
    "DynamicVelocityTelemetry",
    "apply_acceleration_limits",
    "apply_velocity_limits",
    "apply_velocity_tracking_first_order",
    "integrate_position",
]
