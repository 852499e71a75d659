"""Commands with which a protocol moves its node."""

from dataclasses import dataclass
from enum import Enum


class MobilityCommandType(int, Enum):
    """Kind of a mobility command, which decides the meaning of its parameters.

    Attributes:
        GOTO_COORDS: Go to (x, y, z) = (param_1, param_2, param_3), meters.
        GOTO_GEO_COORDS: Go to (latitude, longitude, altitude) = (param_1, param_2, param_3), degrees,
            degrees, meters.
        SET_SPEED: Set the speed to param_1, if param_2 and param_3 are None or 0. Otherwise set the velocity
            to (param_1, param_2, param_3); m/s.
    """

    GOTO_COORDS = 1
    GOTO_GEO_COORDS = 2
    SET_SPEED = 3


@dataclass
class MobilityCommand:
    """Command to the vehicle. The subclasses name their parameters. Unused parameters are None."""

    command_type: MobilityCommandType
    param_1: float | None = None
    param_2: float | None = None
    param_3: float | None = None
    param_4: float | None = None
    param_5: float | None = None
    param_6: float | None = None


class GotoCoordsMobilityCommand(MobilityCommand):
    """Go straight to the point (x, y, z), meters, in the simulation's Cartesian frame."""

    def __init__(self, x: float, y: float, z: float) -> None:
        super().__init__(MobilityCommandType.GOTO_COORDS, x, y, z)


class GotoGeoCoordsMobilityCommand(MobilityCommand):
    """Go straight to a geographic point: latitude and longitude in degrees, altitude in meters."""

    def __init__(self, lat: float, lon: float, alt: float) -> None:
        super().__init__(MobilityCommandType.GOTO_GEO_COORDS, lat, lon, alt)


class SetSpeedMobilityCommand(MobilityCommand):
    """Fly at `speed` (m/s, >= 0) from now on."""

    def __init__(self, speed: float) -> None:
        super().__init__(MobilityCommandType.SET_SPEED, speed)


class SetVelocityMobilityCommand(MobilityCommand):
    """Hold the velocity (vx, vy, vz), m/s, until the next command; for vehicles steered by velocity."""

    def __init__(self, vx: float, vy: float, vz: float) -> None:
        super().__init__(MobilityCommandType.SET_SPEED, vx, vy, vz)
