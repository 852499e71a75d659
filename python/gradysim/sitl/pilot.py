"""Carries out the latest command for one vehicle.

ArduCopter neither takes off nor lands for a target. On the ground it ignores a target in the air. With a
target on the ground it believes that it still flies after landing, and loses its position after some minutes.
So a flight to a target on the ground ends with a downward velocity, which makes it detect the landing. A
flight from the ground starts with an upward velocity:

    RISING --in the air, and clear of the ground--> FLYING --low over a target on the ground--> STANDING
       ^------------ landed somewhere else -------------+
"""

import asyncio
import math
from collections.abc import Callable
from enum import Enum, auto

from gradysim.protocol.defaults import LOWEST_AUTOPILOT_SPEED_MPS, is_too_slow_for_autopilot
from gradysim.protocol.position import Position, geo_to_cartesian
from gradysim.sitl.mavlink import Message
from gradysim.sitl.vehicle import Vehicle

_RENEWAL_S = 1.0
"""Period at which a velocity is sent again, in the autopilot's time. It drops one that is 3 s old."""

_ON_GROUND_M = 0.1
"""Highest target that counts as on the ground."""

_APPROACH_M = 0.5
"""Height of the flight to a target on the ground. Sliding over the ground would confuse its sensors."""

_OVER_M = 0.3
"""Horizontal distance at which it starts to descend."""

_NEAR_M = 1.0
"""Horizontal distance at which a vehicle that has landed has arrived."""

_CLEAR_M = 0.5
"""Height at which a take-off ends."""

_UPWARDS_MPS, _DOWNWARDS_MPS = (0.0, 0.0, 1.0), (0.0, 0.0, -0.5)


class _Phase(Enum):
    RISING = auto()
    FLYING = auto()
    STANDING = auto()


class Pilot:
    """Carries out the latest command for a `vehicle`."""

    def __init__(
        self,
        vehicle: Vehicle,
        coordinates_of: Callable[[Position], Position],
        start: Position,
        speed_mps: float,
        pace: float = 1.0,
    ) -> None:
        """Create a pilot for a vehicle that holds the point `start` before the first command.

        `coordinates_of` returns (latitude deg, longitude deg, height above home m) of a point (x, y, z) in m,
        or raises ValueError. `pace` is seconds of the autopilot's time per second of the asyncio loop.
        """
        self.vehicle = vehicle
        self._coordinates_of = coordinates_of
        self._renewal_s = _RENEWAL_S / pace
        self._target = start
        self._goal: Position | None = coordinates_of(start)  # None to hold a velocity
        self._phase = _Phase.FLYING
        self._speed_mps = speed_mps
        self._velocity: Position | None = None
        self._speed_is_new = asyncio.Event()
        self._speed_is_new.set()

    def go_to(self, target: Position) -> None:
        """Fly to a point (x, y, z) in meters. For z < 0 land at x and y.

        Raise ValueError if there is no such place on Earth, and SitlError if the link is lost.
        """
        x, y, z = target
        coordinates = self._coordinates_of((x, y, max(0.0, z)))
        self._target = target
        if self._speed_mps == 0:
            self._stop()
            return
        self._goal = coordinates
        if self.vehicle.is_on_ground:
            self._go_on_from_ground()
        else:
            self._fly()

    def set_velocity(self, velocity_mps: Position) -> None:
        """Fly with a velocity (North, East, up)."""
        self._goal = None
        self._hold(velocity_mps)

    def set_speed(self, speed_mps: float) -> None:
        """Set the ground speed. `attend` sends it and waits for the confirmation.

        Raise ValueError for a speed that is neither 0, to stop, nor >= `LOWEST_AUTOPILOT_SPEED_MPS`.
        """
        if speed_mps != 0 and is_too_slow_for_autopilot(speed_mps):
            raise ValueError(
                f"an autopilot flies at {LOWEST_AUTOPILOT_SPEED_MPS:g} m/s or faster, or stands at 0"
            )
        before, self._speed_mps = self._speed_mps, speed_mps
        if speed_mps == 0:
            self._stop()
            return
        self._speed_is_new.set()
        if before == 0:
            self.go_to(self._target)

    def _stop(self) -> None:
        """Stop by a velocity of 0, because ArduCopter refuses a speed of 0."""
        if self._goal is None or self._phase is not _Phase.STANDING:  # it stands already
            self.set_velocity((0.0, 0.0, 0.0))

    @property
    def has_new_speed(self) -> bool:
        """Whether a new speed has to be sent."""
        return self._speed_is_new.is_set()

    async def attend(self) -> None:
        """Send speeds, renew velocities, take off and land, until canceled or one fails by SitlError."""
        await asyncio.gather(self._send_speeds(), self._renew_velocities(), self._take_off_and_land())

    async def watch(self) -> None:
        """Raise SitlError when the link is lost, or the vehicle is disarmed or leaves mode GUIDED."""
        vehicle = self.vehicle
        vehicle.check_flight()
        await vehicle.link.wait_for(lambda message: not (vehicle.is_armed and vehicle.is_guided), None)
        vehicle.check_flight()

    async def _send_speeds(self) -> None:
        while True:
            await self._speed_is_new.wait()
            self._speed_is_new.clear()
            if self._speed_mps > 0:
                await self.vehicle.set_speed(self._speed_mps)

    async def _renew_velocities(self) -> None:
        while True:
            await asyncio.sleep(self._renewal_s)
            if self._velocity is not None:
                self.vehicle.set_velocity(*self._velocity)

    async def _take_off_and_land(self) -> None:
        while True:
            await self.vehicle.link.wait_for(_has_position, None)
            if self._goal is None or self.vehicle.position is None:
                continue
            over_m, height_m = _apart_m(self._goal, self.vehicle.position)
            if self._phase is _Phase.RISING:
                if self.vehicle.is_in_air and height_m >= _CLEAR_M:
                    self._fly()
            elif self._phase is _Phase.FLYING:
                if self.vehicle.is_on_ground:
                    self._go_on_from_ground()
                elif _is_on_ground(self._goal) and height_m <= _APPROACH_M + _OVER_M and over_m <= _OVER_M:
                    self._stand()

    def _go_on_from_ground(self) -> None:
        assert self._goal is not None
        position = self.vehicle.position
        if _is_on_ground(self._goal) and position and _apart_m(self._goal, position)[0] <= _NEAR_M:
            self._stand()
        else:
            self._phase = _Phase.RISING
            self._hold(_UPWARDS_MPS)

    def _fly(self) -> None:
        assert self._goal is not None
        self._phase = _Phase.FLYING
        if self._velocity is not None:
            self._velocity = None
            self._speed_is_new.set()  # ArduCopter forgets it during a velocity command.
        latitude, longitude, height_m = self._goal
        self.vehicle.go_to(latitude, longitude, _APPROACH_M if _is_on_ground(self._goal) else height_m)

    def _stand(self) -> None:
        self._phase = _Phase.STANDING
        self._hold(_DOWNWARDS_MPS)

    def _hold(self, velocity_mps: Position) -> None:
        self._velocity = velocity_mps
        self.vehicle.set_velocity(*velocity_mps)


def _has_position(message: Message) -> bool:
    return message.get_type() in ("GLOBAL_POSITION_INT", "EXTENDED_SYS_STATE")


def _is_on_ground(coordinates: Position) -> bool:
    return coordinates[2] <= _ON_GROUND_M


def _apart_m(coordinates: Position, position: Position) -> tuple[float, float]:
    """Return the horizontal distance of a vehicle from a place and its height above home, in m."""
    north_m, east_m, _ = geo_to_cartesian(coordinates, position)
    return math.hypot(north_m, east_m), position[2]
