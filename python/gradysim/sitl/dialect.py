"""The MAVLink messages of ArduPilot, from pymavlink, an extra."""

import importlib
from functools import cache
from typing import Any

COPTER_GUIDED = 4
"""Mode of ArduCopter in which it obeys orders over MAVLink; `custom_mode` of its HEARTBEAT."""


@cache
def load_dialect() -> Any:
    """Return the module with messages and constants.

    Only the dialect is used, not pymavlink's connections, so `MAVLINK20` need not be in the environment:
    this module writes version 2 whatever stands there.

    Raises:
        ModuleNotFoundError: pymavlink is not installed; says how to install it.
    """
    try:
        return importlib.import_module("pymavlink.dialects.v20.ardupilotmega")
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(
            "autopilots need the package pymavlink: pip install pymavlink", name=error.name
        ) from error
