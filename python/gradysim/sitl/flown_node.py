"""What is known of a node that an autopilot flies, and of the world that it flies in."""

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass, field

from gradysim.protocol.defaults import SPEED_MPS
from gradysim.protocol.position import Position
from gradysim.sitl.error import SitlError
from gradysim.sitl.frame import home_of
from gradysim.sitl.quadcopter import Vector
from gradysim.sitl.unprivileged import DEFAULT_USER

_SEA_LEVEL_DEGC, _LAPSE_DEGCPM = 15.0, 0.0065
"""Of the standard atmosphere (ISO 2533), in which ArduPilot's simulated barometers are."""

_GROUND_TEMPERATURE = ("GND_TEMP", "BARO_GND_TEMP")
"""Both names of the parameter, old and new; one that an autopilot does not know has no effect on it."""

_WIND = "SIM_WIND_"
_WIND_SPEED, _WIND_FROM = "SIM_WIND_SPD", "SIM_WIND_DIR"
_WIND_FROM_BY_DEFAULT_DEG = 180.0


@dataclass(frozen=True)
class FlownNode:
    """A node that an autopilot flies.

    Attributes:
        id: Of the node; its MAVLink system id is one more.
        name: For people.
        start: Where it hovers as the simulation begins: (x, y, z) in metres, not below the ground.
        speed_mps: Ground speed until it is told another, >= `LOWEST_SPEED_MPS`.
        program: An arducopter for SITL, version 4.1 or newer; see `find_arducopter`.
        user: Whom its autopilot belongs to if root starts it; None for root.
        parameters: Of ArduCopter, by name; SIM_WIND_SPD (m/s) and SIM_WIND_DIR (deg, where it comes from) are
            the wind.
    """

    id: int
    name: str
    start: Position
    speed_mps: float = SPEED_MPS
    program: str | os.PathLike[str] | None = None
    user: str | None = DEFAULT_USER
    parameters: Mapping[str, float] = field(default_factory=dict)


def check_start(name: str, start: Position, reference: Position) -> None:
    """Raise SitlError, which names the vehicle, if it cannot start at (x, y, z) m from the reference."""
    if start[2] < 0:
        raise SitlError(f"{name}: its initial position is below the ground: z = {start[2]:g} m")
    try:
        home_of(reference, start)
    except ValueError as error:
        raise SitlError(f"{name}: its initial position is none: {error}") from error


def ground_temperature(altitude_m: float) -> dict[str, float]:
    """Return the parameters that tell an autopilot how warm it is where it takes off.

    It believes in 25 degC otherwise, and flies 3 % too low at sea level, and 10 % at 3000 m.
    """
    return dict.fromkeys(_GROUND_TEMPERATURE, _SEA_LEVEL_DEGC - _LAPSE_DEGCPM * altitude_m)


def wind_mps(name: str, parameters: Mapping[str, float]) -> Vector:
    """Return the velocity of the air, North, East and down, that ArduCopter's parameters of the wind mean.

    Raises:
        SitlError: One of them means nothing here: turbulence, ...; names the vehicle.
    """
    unknown = [key for key in parameters if key.startswith(_WIND) and key not in (_WIND_SPEED, _WIND_FROM)]
    if unknown:
        raise SitlError(
            f"{name}: parameter {unknown[0]}: on simulated time there are of the wind only {_WIND_SPEED} and "
            f"{_WIND_FROM}"
        )
    speed_mps = parameters.get(_WIND_SPEED, 0.0)
    heading = math.radians(parameters.get(_WIND_FROM, _WIND_FROM_BY_DEFAULT_DEG))
    return (-speed_mps * math.cos(heading), -speed_mps * math.sin(heading), 0.0)
