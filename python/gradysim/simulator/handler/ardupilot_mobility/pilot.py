"""Turns one node's mobility commands into orders to its vehicle."""

import asyncio

from gradysim.encapsulator.command_numbers import finite_number, three_numbers
from gradysim.protocol.messages.mobility import MobilityCommand, MobilityCommandType
from gradysim.protocol.position import Position
from gradysim.simulator.handler.ardupilot_mobility.exception import ArdupilotMobilityException
from gradysim.sitl.frame import cartesian_to_geo
from gradysim.sitl.vehicle import Vehicle

_RENEWAL_S = 1.0
"""Of the autopilot's time: it drops a velocity that is 3 s old."""


class Pilot:
    """Remembers what the protocol wants, and has the vehicle do it. The newest command counts.

    Attributes:
        vehicle: What it flies.
    """

    def __init__(self, vehicle: Vehicle, reference: Position, speed_mps: float, real_time: float) -> None:
        """Take a vehicle in flight.

        Args:
            vehicle: Holds its position.
            reference: (latitude deg, longitude deg, altitude m) of the frame's origin.
            speed_mps: Ground speed, > 0.
            real_time: Seconds of the autopilot's time for each wall second.
        """
        self.vehicle = vehicle
        self._reference = reference
        self._renewal_s = _RENEWAL_S / real_time
        self._target: Position | None = None
        self._speed_mps = speed_mps
        self._velocity: Position | None = None
        self._speed_is_new = asyncio.Event()
        self._speed_is_new.set()

    def obey(self, command: MobilityCommand) -> None:
        """Carry out a command: at once, but for the speed, which the autopilot has to confirm.

        Args:
            command: A velocity, or GOTO_COORDS or a speed with nothing wrong by `wrong_mobility`.

        Raises:
            ArdupilotMobilityException: It is no velocity, or the place is none; says what the node "was".
            SitlError: The vehicle is gone.
        """
        if command.command_type == MobilityCommandType.GOTO_COORDS:
            self._go_to(_numbers(command))
        elif is_velocity(command):
            self._velocity = _numbers(command)
            self.vehicle.set_velocity(*self._velocity)
        else:
            self._set_speed(_speed(command))

    async def attend(self) -> None:
        """Do what takes time, for ever: have speeds confirmed, renew velocities. SitlError if that fails."""
        while True:
            try:
                await asyncio.wait_for(self._speed_is_new.wait(), self._renewal_s)
            except TimeoutError:
                if self._velocity is not None:
                    self.vehicle.set_velocity(*self._velocity)
                continue
            self._speed_is_new.clear()
            if self._speed_mps > 0:
                await self.vehicle.set_speed(self._speed_mps)

    def _go_to(self, target: Position) -> None:
        try:
            latitude, longitude, _ = cartesian_to_geo(self._reference, target)
        except ValueError as error:
            raise ArdupilotMobilityException(f"sent to a place that is none: {error}") from error
        self._target = target
        if self._speed_mps == 0:
            return
        if self._velocity is not None:
            self._velocity = None
            self._speed_is_new.set()  # ArduCopter forgets it while it holds a velocity.
        self.vehicle.go_to(latitude, longitude, target[2])

    def _set_speed(self, speed: float) -> None:
        before, self._speed_mps = self._speed_mps, speed
        if speed == 0:  # Which ArduCopter refuses.
            self._velocity = (0.0, 0.0, 0.0)
            self.vehicle.set_velocity(0, 0, 0)
            return
        self._speed_is_new.set()
        if before == 0 and self._target is not None:
            self._go_to(self._target)


def is_velocity(command: MobilityCommand) -> bool:
    """Whether a command sets three components of a velocity."""
    return getattr(command, "command_type", None) == MobilityCommandType.SET_SPEED and not (
        command.param_2 is command.param_3 is None
    )


def _speed(command: MobilityCommand) -> float:
    speed = finite_number(command.param_1)
    assert speed is not None
    return speed


def _numbers(command: MobilityCommand) -> Position:
    numbers = three_numbers(command)
    if numbers is None:
        raise ArdupilotMobilityException(
            f"given ({command.param_1!r}, {command.param_2!r}, {command.param_3!r}): "
            "expected three finite numbers"
        )
    return numbers
