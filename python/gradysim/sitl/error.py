"""What goes wrong with an autopilot."""


class SitlError(Exception):
    """An autopilot cannot be started, is gone, or refuses a step; names vehicle, step and what it said."""
