"""Nodes flown by autopilots: processes, MAVLink connections, flights, and a mobility handler.

It needs the extra `sitl`, which is imported when it is used, and an autopilot, which the user installs.
"""


class ArdupilotMobilityException(Exception):  # noqa: N818 (the published name)
    """An autopilot cannot start or has ended, a step of a flight failed, or a command is not valid."""


class SitlError(ArdupilotMobilityException):
    """An autopilot cannot start, has ended, or refuses a step. Names the vehicle, the step and its reply."""
