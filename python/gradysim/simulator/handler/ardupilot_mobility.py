"""Import path of the ArduPilot mobility handler in gradysim 0.8. The handler is in `gradysim.sitl`.

The names are loaded on first use, because the simulator does not depend on autopilots.
"""

import importlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gradysim.sitl.ardupilot_mobility import (
        ArdupilotMobilityConfiguration,
        ArdupilotMobilityException,
        ArdupilotMobilityHandler,
    )

__all__ = ["ArdupilotMobilityConfiguration", "ArdupilotMobilityException", "ArdupilotMobilityHandler"]


def __getattr__(name: str) -> object:
    if name in __all__:
        return getattr(importlib.import_module("gradysim.sitl.ardupilot_mobility"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
