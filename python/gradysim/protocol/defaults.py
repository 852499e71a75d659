"""What holds where nothing else is said, whatever a node runs on. The engine's own defaults are the same."""

SPEED_MPS = 10
"""Of a vehicle, until its protocol sets another."""

UPDATE_S = 0.01
"""Simulated time between two places of a vehicle, and between two telemetries."""

LOWEST_AUTOPILOT_SPEED_MPS = 0.2
"""Ground speed. ArduCopter accepts a lower one and flies on at the one before."""

AUTOPILOT_USER = "nobody"
"""User that autopilots belong to if root runs the simulation."""

LEAST_TELEMETRY_INTERVAL_S = 1e-6
"""Shorter ones would be nothing but telemetry."""

TRANSMISSION_RANGE_M = 60
"""How far messages get in prototype mode; radios of integrated mode have powers instead."""


def is_too_slow_for_autopilot(speed_mps: float) -> bool:
    """Whether ArduCopter ignores a ground speed. `LOWEST_AUTOPILOT_SPEED_MPS` may be off by rounding."""
    return speed_mps < LOWEST_AUTOPILOT_SPEED_MPS * (1 - 1e-9)
