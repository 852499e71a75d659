"""What holds where nothing else is said, whatever a node runs on. The engine's own defaults are the same."""

SPEED_MPS = 10
"""Of a vehicle, until its protocol sets another."""

UPDATE_S = 0.01
"""Simulated time between two places of a vehicle, and between two telemetries."""

LEAST_TELEMETRY_INTERVAL_S = 1e-6
"""Shorter ones would be nothing but telemetry."""

TRANSMISSION_RANGE_M = 60
"""How far messages get in prototype mode; radios of integrated mode have powers instead."""
