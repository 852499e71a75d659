"""From the moment that an autopilot can be heard until its vehicle hovers where the simulation begins."""

from collections.abc import Callable, Mapping

from gradysim.protocol.position import Position
from gradysim.sitl.vehicle import Vehicle

_TAKE_OFF_M = 10.0


async def prepare(
    vehicle: Vehicle,
    start: Position,
    *,
    position_hz: float,
    speed_mps: float,
    timeout_s: float,
    parameters: Mapping[str, float],
    check: Callable[[], None] = lambda: None,
) -> None:
    """Find out where it is, take off and fly to its start.

    Args:
        vehicle: Its link is connected.
        start: (latitude deg, longitude deg, height above home m).
        position_hz: How often it is to send its position, by its own clock.
        speed_mps: Ground speed from the start on, >= `LOWEST_SPEED_MPS`.
        timeout_s: For each step.
        parameters: Of the autopilot, by name; it has to confirm each.
        check: Called when its position is known and it has not moved; may raise SitlError.

    Raises:
        SitlError: A step failed.
    """
    await vehicle.meet(timeout_s)
    for name, value in parameters.items():
        await vehicle.set_parameter(name, value)
    await vehicle.stream(position_hz)
    await vehicle.find_position(timeout_s)
    check()
    await vehicle.enter_guided(timeout_s)
    await vehicle.arm(timeout_s)
    await vehicle.take_off(_TAKE_OFF_M, timeout_s)
    await vehicle.arrive(*start, timeout_s)
    await vehicle.set_speed(speed_mps)
