"""Mobility handlers. Names without a kind of vehicle, such as `MobilityHandler`, are the massless ones."""

from gradysim.simulator.handler.mobility.dynamic_velocity import (
    DynamicVelocityMobilityConfiguration,
    DynamicVelocityMobilityException,
    DynamicVelocityMobilityHandler,
    DynamicVelocityTelemetry,
)
from gradysim.simulator.handler.mobility.massless import (
    MasslessMobilityConfiguration,
    MasslessMobilityException,
    MasslessMobilityHandler,
)

MobilityConfiguration = MasslessMobilityConfiguration
MobilityException = MasslessMobilityException
MobilityHandler = MasslessMobilityHandler

__all__ = [
    "DynamicVelocityMobilityConfiguration",
    "DynamicVelocityMobilityException",
    "DynamicVelocityMobilityHandler",
    "DynamicVelocityTelemetry",
    "MasslessMobilityConfiguration",
    "MasslessMobilityException",
    "MasslessMobilityHandler",
    "MobilityConfiguration",
    "MobilityException",
    "MobilityHandler",
]
