"""Mobility handler for nodes that ArduPilot flies, in SITL or in real vehicles."""

from gradysim.sitl import ArdupilotMobilityException
from gradysim.sitl.ardupilot_mobility.configuration import ArdupilotMobilityConfiguration
from gradysim.sitl.ardupilot_mobility.handler import ArdupilotMobilityHandler

__all__ = ["ArdupilotMobilityConfiguration", "ArdupilotMobilityException", "ArdupilotMobilityHandler"]
