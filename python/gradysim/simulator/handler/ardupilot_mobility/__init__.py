"""Nodes flown by ArduPilot: each has an autopilot of its own, in SITL or in a real vehicle."""

from gradysim.simulator.handler.ardupilot_mobility.configuration import ArdupilotMobilityConfiguration
from gradysim.simulator.handler.ardupilot_mobility.exception import ArdupilotMobilityException
from gradysim.simulator.handler.ardupilot_mobility.handler import ArdupilotMobilityHandler

__all__ = ["ArdupilotMobilityConfiguration", "ArdupilotMobilityException", "ArdupilotMobilityHandler"]
