"""Defaults and limits that hold in both modes. Those of the compiled engine have the same values."""

SPEED_MPS = 10
"""Speed of a vehicle until its protocol sets another one."""

UPDATE_S = 0.01
"""Simulated time between two position updates of a vehicle, and between two telemetry messages."""

LOWEST_AUTOPILOT_SPEED_MPS = 0.2
"""Ground speed. ArduCopter accepts a lower one and flies on at the one before."""

AUTOPILOT_USER = "nobody"
"""User that autopilots belong to if root runs the simulation."""

LEAST_TELEMETRY_INTERVAL_S = 1e-6
"""Shortest telemetry interval. A shorter one would fill the run with telemetry alone."""

TRANSMISSION_RANGE_M = 60
"""Range of messages in prototype mode. Radios of integrated mode have a power instead."""

MOST_INTERFACES = 16
"""Largest number of network interfaces of a node."""


def is_too_slow_for_autopilot(speed_mps: float) -> bool:
    """Whether ArduCopter ignores a ground speed. `LOWEST_AUTOPILOT_SPEED_MPS` may be off by rounding."""
    return speed_mps < LOWEST_AUTOPILOT_SPEED_MPS * (1 - 1e-9)
