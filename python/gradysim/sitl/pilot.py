"""Has one vehicle do what is wanted of it last."""

import asyncio
from collections.abc import Callable

from gradysim.protocol.position import Position
from gradysim.sitl.arducopter import LOWEST_SPEED_MPS, is_too_slow
from gradysim.sitl.vehicle import Vehicle

_RENEWAL_S = 1.0
"""Of the autopilot's time: it drops a velocity that is 3 s old."""


class Pilot:
    """Remembers what is wanted, and has the vehicle do it. The newest order counts.

    Attributes:
        vehicle: What it flies.
    """

    def __init__(
        self,
        vehicle: Vehicle,
        place_of: Callable[[Position], Position],
        speed_mps: float,
        pace: float = 1.0,
    ) -> None:
        """Take a vehicle that holds its position, or will before the first order.

        Args:
            vehicle: What it is to fly.
            place_of: Returns (latitude deg, longitude deg, height above home m) of a point (x, y, z) in
                metres; ValueError if there is no such place.
            speed_mps: Ground speed, >= `LOWEST_SPEED_MPS`.
            pace: Seconds of the autopilot's time for each second of the asyncio loop's.
        """
        self.vehicle = vehicle
        self._place_of = place_of
        self._renewal_s = _RENEWAL_S / pace
        self._target: Position | None = None
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
        if self._velocity is not None:
            self._velocity = None
            self._speed_is_new.set()  # ArduCopter forgets it while it holds a velocity.
        self.vehicle.go_to(*place)

    def set_velocity(self, velocity_mps: Position) -> None:
        """Hold a velocity (North, East, up)."""
        self._velocity = velocity_mps
        self.vehicle.set_velocity(*velocity_mps)

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
        if before == 0 and self._target is not None:
            self.go_to(self._target)

    def _stop(self) -> None:
        """Stand: by a velocity, as ArduCopter refuses a speed of 0."""
        self.set_velocity((0.0, 0.0, 0.0))

    @property
    def has_news(self) -> bool:
        """Whether a speed waits for its turn to be told to the autopilot."""
        return self._speed_is_new.is_set()

    async def attend(self) -> None:
        """Do what takes time, for ever: have speeds confirmed, renew velocities. SitlError if that fails."""
        await asyncio.gather(self._have_speeds_confirmed(), self._renew_velocities())

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
