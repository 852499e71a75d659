"""What a node that is flown by an autopilot cannot do."""


class ArdupilotMobilityException(Exception):  # noqa: N818 (the published name)
    """An autopilot cannot be started or is gone, a step of a flight failed, or a command means nothing."""
