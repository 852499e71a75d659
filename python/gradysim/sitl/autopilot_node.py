"""A node flown by an autopilot, and the temperature and wind of its world."""

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass, field

from gradysim.motion.quadcopter import DRAG_KGPS, Vector
from gradysim.motion.wind import WindAtVehicle
from gradysim.protocol.defaults import AUTOPILOT_USER, SPEED_MPS
from gradysim.protocol.position import Position
from gradysim.sitl import SitlError
from gradysim.sitl.frame import home_of

_SEA_LEVEL_DEGC, _LAPSE_DEGCPM = 15.0, 0.0065
"""Standard atmosphere (ISO 2533) of ArduPilot's simulated barometers."""

_GROUND_TEMPERATURE = ("GND_TEMP", "BARO_GND_TEMP")
"""New and old name of the parameter. An autopilot ignores the one that it does not know."""

_WIND = "SIM_WIND_"
_WIND_SPEED, _WIND_FROM = "SIM_WIND_SPD", "SIM_WIND_DIR"
_WIND_FROM_BY_DEFAULT_DEG = 180.0


@dataclass(frozen=True)
class AutopilotNode:
    """A node flown by an autopilot.

    Attributes:
        id: Id of the node. Its MAVLink system id is one more.
        name: Name in messages.
        start: Position (x, y, z) at the start of the simulation, in meters; z >= 0.
        speed_mps: Initial ground speed, >= `LOWEST_AUTOPILOT_SPEED_MPS`.
        program: An arducopter program for SITL, version 4.1 or newer; see `find_arducopter`.
        user: User of the autopilot if root starts it; None for root.
        parameters: ArduCopter parameters by name. SIM_WIND_SPD (m/s) and SIM_WIND_DIR (deg, direction it
            comes from) set the wind.
        drag_kgps: Force of the air on the vehicle, in newtons per metre per second of airspeed.
        wind: Wind of the scenario; None if these parameters set it.
    """

    id: int
    name: str
    start: Position
    speed_mps: float = SPEED_MPS
    program: str | os.PathLike[str] | None = None
    user: str | None = AUTOPILOT_USER
    parameters: Mapping[str, float] = field(default_factory=dict)
    drag_kgps: float = DRAG_KGPS
    wind: WindAtVehicle | None = None


def check_start(name: str, start: Position, reference: Position) -> None:
    """Raise SitlError if a vehicle cannot start at (x, y, z) m from the reference."""
    if start[2] < 0:
        raise SitlError(f"{name}: the initial position is below the ground: z = {start[2]:g} m")
    try:
        home_of(reference, start)
    except ValueError as error:
        raise SitlError(f"{name}: the initial position is not valid: {error}") from error


def ground_temperature(altitude_m: float) -> dict[str, float]:
    """Return the parameters for the temperature at the place of take-off.

    Without them ArduPilot assumes 25 degC, and flies 3 % too low at sea level and 10 % at 3000 m.
    """
    return dict.fromkeys(_GROUND_TEMPERATURE, _SEA_LEVEL_DEGC - _LAPSE_DEGCPM * altitude_m)


def sets_wind(parameters: Mapping[str, float]) -> bool:
    """Return whether ArduCopter's parameters set the wind."""
    return any(name.startswith(_WIND) for name in parameters)


def wind_mps(name: str, parameters: Mapping[str, float]) -> Vector:
    """Return the wind velocity (North, East, down) from ArduCopter's parameters.

    Raise SitlError for a wind parameter that is not supported, such as turbulence.
    """
    unknown = [key for key in parameters if key.startswith(_WIND) and key not in (_WIND_SPEED, _WIND_FROM)]
    if unknown:
        raise SitlError(
            f"{name}: parameter {unknown[0]}: on simulated time the only wind parameters are "
            f"{_WIND_SPEED} and {_WIND_FROM}"
        )
    speed_mps = parameters.get(_WIND_SPEED, 0.0)
    heading = math.radians(parameters.get(_WIND_FROM, _WIND_FROM_BY_DEFAULT_DEG))
    return (-speed_mps * math.cos(heading), -speed_mps * math.sin(heading), 0.0)
