"""Has one vehicle do what is wanted of it last.

ArduCopter neither takes off nor lands for a target: on the ground it ignores one in the air, and what stands
on the ground with a target there flies, as it believes, until after some minutes it does not know any more
where it is. So the way to a target on the ground ends with a velocity downwards, by which it notices that it
has landed, and a way from the ground begins with one upwards:

    RISING --in the air, and clear of the ground--> FLYING --low over a target on the ground--> STANDING
       ^--------- it has landed somewhere else ---------+
"""

import asyncio
import math
from collections.abc import Callable
from enum import Enum, auto

from gradysim.protocol.position import Position, geo_to_cartesian
from gradysim.sitl.arducopter import LOWEST_SPEED_MPS, is_too_slow
from gradysim.sitl.link import Message
from gradysim.sitl.vehicle import Vehicle

_RENEWAL_S = 1.0
"""Of the autopilot's time: it drops a velocity that is 3 s old."""

_ON_GROUND_M = 0.1
"""Up to this height a target is on the ground."""

_APPROACH_M = 0.5
"""So high it flies to a target on the ground: to be dragged over the ground is more than its senses bear."""

_OVER_M = 0.3
"""From so near to that it goes straight down."""

_NEAR_M = 1.0
"""One that has landed so near to it has arrived, too."""

_CLEAR_M = 0.5
"""One that takes off flies on from this height."""

_UPWARDS_MPS, _DOWNWARDS_MPS = (0.0, 0.0, 1.0), (0.0, 0.0, -0.5)


class _Phase(Enum):
    """Of the way to a target."""

    RISING = auto()
    FLYING = auto()
    STANDING = auto()


class Pilot:
    """Remembers what is wanted, and has the vehicle do it. The newest order counts.

    Attributes:
        vehicle: What it flies.
    """

    def __init__(
        self,
        vehicle: Vehicle,
        place_of: Callable[[Position], Position],
        start: Position,
        speed_mps: float,
        pace: float = 1.0,
    ) -> None:
        """Take a vehicle that holds its position, or will before the first order.

        Args:
            vehicle: What it is to fly.
            place_of: Returns (latitude deg, longitude deg, height above home m) of a point (x, y, z) in
                metres; ValueError if there is no such place.
            start: (x, y, z) in metres: the position that the vehicle holds.
            speed_mps: Ground speed, >= `LOWEST_SPEED_MPS`.
            pace: Seconds of the autopilot's time for each second of the asyncio loop's.
        """
        self.vehicle = vehicle
        self._place_of = place_of
        self._renewal_s = _RENEWAL_S / pace
        self._target = start
        self._place: Position | None = place_of(start)  # None while it is to hold a velocity
        self._phase = _Phase.FLYING
        self._speed_mps = speed_mps
        self._velocity: Position | None = None
        self._speed_is_new = asyncio.Event()
        self._speed_is_new.set()

    def go_to(self, target: Position) -> None:
        """Fly to a point (x, y, z) in metres; for z < 0 to the ground at x and y, and stand there.

        A target below the ground would be met where the way to it meets the ground.

        Raises:
            ValueError: There is no such place on Earth.
            SitlError: The vehicle is gone, as for all orders.
        """
        x, y, z = target
        place = self._place_of((x, y, max(0.0, z)))
        self._target = target
        if self._speed_mps == 0:
            self._stop()
            return
        self._place = place
        if self.vehicle.is_on_ground:
            self._go_on_from_ground()
        else:
            self._fly()

    def set_velocity(self, velocity_mps: Position) -> None:
        """Hold a velocity (North, East, up)."""
        self._place = None
        self._hold(velocity_mps)

    def set_speed(self, speed_mps: float) -> None:
        """Fly at this ground speed from now on; the autopilot has to confirm it, in `attend`.

        Args:
            speed_mps: 0, to stand, or >= `LOWEST_SPEED_MPS`.

        Raises:
            ValueError: It is between them.
        """
        if speed_mps != 0 and is_too_slow(speed_mps):
            raise ValueError(f"an autopilot flies at {LOWEST_SPEED_MPS:g} m/s or faster, or stands at 0")
        before, self._speed_mps = self._speed_mps, speed_mps
        if speed_mps == 0:
            self._stop()
            return
        self._speed_is_new.set()
        if before == 0:
            self.go_to(self._target)

    def _stop(self) -> None:
        """Stand: by a velocity, as ArduCopter refuses a speed of 0."""
        if self._place is None or self._phase is not _Phase.STANDING:  # that it does
            self.set_velocity((0.0, 0.0, 0.0))

    @property
    def has_news(self) -> bool:
        """Whether a speed waits for its turn to be told to the autopilot."""
        return self._speed_is_new.is_set()

    async def attend(self) -> None:
        """Do what takes time, for ever: have speeds confirmed, renew velocities, take off and land.

        SitlError if that fails.
        """
        await asyncio.gather(
            self._have_speeds_confirmed(), self._renew_velocities(), self._take_off_and_land()
        )

    async def watch(self) -> None:
        """Wait for ever. SitlError as soon as the vehicle is gone or does not obey any more."""
        vehicle = self.vehicle
        vehicle.check_flight()
        await vehicle.link.wait_for(lambda message: not (vehicle.is_armed and vehicle.is_guided), None)
        vehicle.check_flight()

    async def _have_speeds_confirmed(self) -> None:
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
            await self.vehicle.link.wait_for(_tells_of_its_place, None)
            if self._place is None or self.vehicle.position is None:
                continue
            over_m, height_m = _apart_m(self._place, self.vehicle.position)
            if self._phase is _Phase.RISING:
                if self.vehicle.is_in_air and height_m >= _CLEAR_M:
                    self._fly()
            elif self._phase is _Phase.FLYING:
                if self.vehicle.is_on_ground:
                    self._go_on_from_ground()
                elif _is_on_ground(self._place) and height_m <= _APPROACH_M + _OVER_M and over_m <= _OVER_M:
                    self._stand()

    def _go_on_from_ground(self) -> None:
        assert self._place is not None
        position = self.vehicle.position
        if _is_on_ground(self._place) and position and _apart_m(self._place, position)[0] <= _NEAR_M:
            self._stand()
        else:
            self._phase = _Phase.RISING
            self._hold(_UPWARDS_MPS)

    def _fly(self) -> None:
        assert self._place is not None
        self._phase = _Phase.FLYING
        if self._velocity is not None:
            self._velocity = None
            self._speed_is_new.set()  # ArduCopter forgets it while it holds a velocity.
        latitude, longitude, height_m = self._place
        self.vehicle.go_to(latitude, longitude, _APPROACH_M if _is_on_ground(self._place) else height_m)

    def _stand(self) -> None:
        self._phase = _Phase.STANDING
        self._hold(_DOWNWARDS_MPS)

    def _hold(self, velocity_mps: Position) -> None:
        self._velocity = velocity_mps
        self.vehicle.set_velocity(*velocity_mps)


def _tells_of_its_place(message: Message) -> bool:
    return message.get_type() in ("GLOBAL_POSITION_INT", "EXTENDED_SYS_STATE")


def _is_on_ground(place: Position) -> bool:
    return place[2] <= _ON_GROUND_M


def _apart_m(place: Position, position: Position) -> tuple[float, float]:
    """Return how far a vehicle is from a place, along the ground, and its height above home, in m."""
    north_m, east_m, _ = geo_to_cartesian(place, position)
    return math.hypot(north_m, east_m), position[2]
