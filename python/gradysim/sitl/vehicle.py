"""A vehicle commanded over MAVLink. A step ends when the vehicle confirms it, or fails with its reply.

It is written for ArduCopter. Positions are latitude, longitude and height above the place where the vehicle
was armed. Times are those of the asyncio loop: wall time or simulated time.
"""

import asyncio
import math
from collections.abc import Awaitable, Callable, Mapping
from functools import partial
from typing import Any

from gradysim.protocol.position import Position, geo_to_cartesian, squared_distance
from gradysim.sitl import SitlError
from gradysim.sitl.frame import off_null_island
from gradysim.sitl.mavlink import COPTER_GUIDED, MavlinkLink, Message, load_dialect

_ANSWER_S = 1.0
"""Time after which a command without COMMAND_ACK is sent again."""

_TRIES = 5

_PAUSE_S = 0.2
"""Time between two attempts of a command that the autopilot may accept later."""

_CONFIRM_S = 5.0
"""Time in which an accepted change must show in a HEARTBEAT. There is one per second."""

_ARRIVED_M = 1.0

_POSITION_ONLY = 0b110111111000
"""`type_mask` of SET_POSITION_TARGET_*: use only the position."""

_VELOCITY_ONLY = 0b110111000111
"""Same for the velocity."""

_GROUND_SPEED = 1
"""`param1` of MAV_CMD_DO_CHANGE_SPEED: ground speed."""


class Vehicle:
    """One vehicle. A step that is refused or takes too long raises SitlError with vehicle and step.

    Attributes:
        name: Name in messages.
        link: Its messages.
    """

    def __init__(self, link: MavlinkLink) -> None:
        self.name = link.name
        self.link = link
        self._dialect = load_dialect()
        self._commands = asyncio.Lock()
        self._is_old = False

    @property
    def position(self) -> tuple[float, float, float] | None:
        """(latitude deg, longitude deg, height above home m); None before the first GLOBAL_POSITION_INT."""
        message = self.link.latest.get("GLOBAL_POSITION_INT")
        return None if message is None else position_of(message)

    @property
    def battery_percent(self) -> float | None:
        """Remaining battery in percent, or None if the autopilot does not know it."""
        message = self.link.latest.get("SYS_STATUS")
        if message is None or message.battery_remaining < 0:
            return None
        return float(message.battery_remaining)

    @property
    def is_armed(self) -> bool:
        """Whether the motors were on in the latest HEARTBEAT."""
        message = self.link.latest.get("HEARTBEAT")
        return message is not None and bool(message.base_mode & self._dialect.MAV_MODE_FLAG_SAFETY_ARMED)

    @property
    def is_guided(self) -> bool:
        """Whether the mode was GUIDED in the latest HEARTBEAT."""
        message = self.link.latest.get("HEARTBEAT")
        return message is not None and message.custom_mode == COPTER_GUIDED

    @property
    def is_in_air(self) -> bool:
        """Whether it reports that it flies."""
        return bool(self._landed_state == self._dialect.MAV_LANDED_STATE_IN_AIR)

    @property
    def is_on_ground(self) -> bool:
        """Whether it reports that it is on the ground."""
        return bool(self._landed_state == self._dialect.MAV_LANDED_STATE_ON_GROUND)

    @property
    def _landed_state(self) -> int | None:
        message = self.link.latest.get("EXTENDED_SYS_STATE")
        return None if message is None else int(message.landed_state)

    async def meet(self, timeout_s: float) -> None:
        """Wait for the first HEARTBEAT."""
        if "HEARTBEAT" not in self.link.latest:
            await self._wait("heartbeat", _is("HEARTBEAT"), timeout_s)

    async def stream(self, position_hz: float) -> None:
        """Request positions (Hz of the autopilot's clock) and the other messages that are needed."""
        dialect = self._dialect
        rates_hz = {
            dialect.MAVLINK_MSG_ID_GLOBAL_POSITION_INT: position_hz,
            dialect.MAVLINK_MSG_ID_EKF_STATUS_REPORT: 2.0,
            dialect.MAVLINK_MSG_ID_EXTENDED_SYS_STATE: 2.0,
            dialect.MAVLINK_MSG_ID_SYS_STATUS: 1.0,
        }
        for identifier, rate_hz in rates_hz.items():
            # A refusal may be the answer to a request of a ground station, so try again.
            await self._insist("telemetry", partial(self._ask_for, identifier, rate_hz), _CONFIRM_S)
            if self._is_old:
                self._request_stream(dialect.MAV_DATA_STREAM_POSITION, position_hz)
                self._request_stream(dialect.MAV_DATA_STREAM_EXTENDED_STATUS, 1.0)
                self._request_stream(dialect.MAV_DATA_STREAM_EXTRA3, 2.0)
                return

    def restore_stream(self, position_hz: float) -> None:
        """Request positions again, without waiting for a reply, in case their rate was changed."""
        dialect = self._dialect
        if self._is_old:
            self._request_stream(dialect.MAV_DATA_STREAM_POSITION, position_hz)
            return
        identifier, interval_us = dialect.MAVLINK_MSG_ID_GLOBAL_POSITION_INT, round(1e6 / position_hz)
        self._send_command(dialect.MAV_CMD_SET_MESSAGE_INTERVAL, identifier, interval_us)

    async def find_position(self, timeout_s: float) -> None:
        """Wait until the autopilot knows its position by GPS."""
        needed = self._dialect.EKF_POS_HORIZ_ABS

        def knows(message: Message) -> bool:
            return _is("EKF_STATUS_REPORT")(message) and bool(message.flags & needed)

        await self._wait("position estimate", knows, timeout_s)

    async def enter_guided(self, timeout_s: float) -> None:
        """Switch to mode GUIDED, in which the autopilot accepts commands."""
        dialect = self._dialect
        custom = dialect.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED

        async def switch() -> Message:
            ack = await self._answer("mode GUIDED", dialect.MAV_CMD_DO_SET_MODE, custom, COPTER_GUIDED)
            if ack.result == dialect.MAV_RESULT_UNSUPPORTED:  # ArduCopter 3: a message without reply.
                self._send("set_mode", self.link.target[0], custom, COPTER_GUIDED)
                return None
            return ack

        await self._insist("mode GUIDED", switch, timeout_s)
        await self._confirm("mode GUIDED", lambda: self.is_guided)

    async def arm(self, timeout_s: float) -> None:
        """Start the motors."""
        if self.is_armed:
            return
        command = self._dialect.MAV_CMD_COMPONENT_ARM_DISARM
        await self._insist("arming", lambda: self._answer("arming", command, 1), timeout_s)
        await self._confirm("arming", lambda: self.is_armed)

    async def take_off(self, height_m: float, timeout_s: float) -> None:
        """Climb to a height above home and wait until it is reached. Return at once if it flies already."""
        if self.is_in_air:
            return
        command = self._dialect.MAV_CMD_NAV_TAKEOFF
        self._check("take-off", await self._answer("take-off", command, 0, 0, 0, 0, 0, 0, height_m))

        def risen(message: Message) -> bool:
            return _is("GLOBAL_POSITION_INT")(message) and position_of(message)[2] > height_m - _ARRIVED_M

        await self._fly("take-off", risen, timeout_s)

    def go_to(self, latitude: float, longitude: float, height_m: float) -> None:
        """Command a straight flight to a place. It replaces the previous target or velocity. No reply."""
        latitude, longitude = off_null_island(latitude, longitude)
        frame = self._dialect.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT
        coordinates = (round(latitude * 1e7), round(longitude * 1e7), height_m)
        kind = "set_position_target_global_int"
        self._send(kind, 0, *self.link.target, frame, _POSITION_ONLY, *coordinates, *([0] * 8))

    async def arrive(self, latitude: float, longitude: float, height_m: float, timeout_s: float) -> None:
        """Fly to a place and wait until it is within 1 m."""
        coordinates = (latitude, longitude, height_m)

        def is_there(message: Message) -> bool:
            return (
                _is("GLOBAL_POSITION_INT")(message)
                and squared_distance(geo_to_cartesian(coordinates, position_of(message)), (0, 0, 0))
                <= _ARRIVED_M**2
            )

        self.go_to(*coordinates)
        await self._fly(f"flight to ({latitude:.7f}, {longitude:.7f}, {height_m:g} m)", is_there, timeout_s)

    def set_velocity(self, north_mps: float, east_mps: float, up_mps: float) -> None:
        """Command a velocity. The vehicle stops 3 s (of its own time) after the last command. No reply."""
        frame = self._dialect.MAV_FRAME_LOCAL_NED
        vector = (0, 0, 0, north_mps, east_mps, -up_mps, *([0] * 5))
        kind = "set_position_target_local_ned"
        self._send(kind, 0, *self.link.target, frame, _VELOCITY_ONLY, *vector)

    async def set_speed(self, speed_mps: float) -> None:
        """Set the ground speed of the flight to the present target. Climbing has its own speed.

        A speed below `LOWEST_AUTOPILOT_SPEED_MPS` is confirmed and ignored.
        """
        step = f"speed {speed_mps:g} m/s"
        command = self._dialect.MAV_CMD_DO_CHANGE_SPEED
        self._check(step, await self._answer(step, command, _GROUND_SPEED, speed_mps, -1))

    async def set_parameter(self, name: str, value: float) -> None:
        """Set a parameter of the autopilot and wait for its confirmation."""
        real = self._dialect.MAV_PARAM_TYPE_REAL32

        def confirmed(message: Message) -> bool:
            return (
                _is("PARAM_VALUE")(message)
                and bool(message.param_id == name)
                and math.isclose(message.param_value, value, rel_tol=1e-6)
            )

        for _ in range(_TRIES):
            self._send("param_set", *self.link.target, name.encode(), value, real)
            if await self.link.wait_for(confirmed, _ANSWER_S) is not None:
                return
        raise self._failure(
            f"parameter {name} = {value:g}", f"not confirmed after {_TRIES} tries: does this parameter exist?"
        )

    def send_heartbeat(self) -> None:
        """Send the HEARTBEAT of a ground station. Without it a real vehicle considers its link lost."""
        dialect = self._dialect
        station, active = dialect.MAV_TYPE_GCS, dialect.MAV_STATE_ACTIVE
        self._send("heartbeat", station, dialect.MAV_AUTOPILOT_INVALID, 0, 0, active, 3)

    def check_flight(self, step: str = "flight") -> None:
        """Raise SitlError if it is disarmed or in another mode by its latest HEARTBEAT."""
        if not self.is_armed:
            raise self._failure(step, "its motors were stopped")
        if not self.is_guided:
            mode = self.link.latest["HEARTBEAT"].custom_mode
            raise self._failure(step, f"it left mode GUIDED for mode number {mode}")

    async def _ask_for(self, identifier: int, rate_hz: float) -> Message | None:
        """Request a message. Return None, and set `_is_old`, if the command is unsupported."""
        dialect = self._dialect
        command = dialect.MAV_CMD_SET_MESSAGE_INTERVAL
        ack = await self._answer("telemetry", command, identifier, round(1e6 / rate_hz))
        self._is_old = bool(ack.result == dialect.MAV_RESULT_UNSUPPORTED)
        return None if self._is_old else ack

    def _request_stream(self, stream: int, rate_hz: float) -> None:
        """Request messages from ArduCopter 3, by REQUEST_DATA_STREAM. There is no reply."""
        rate = max(1, round(rate_hz))
        self._send("request_data_stream", *self.link.target, stream, rate, 1)

    def _send(self, kind: str, *fields: object) -> None:
        """Send a message of the dialect."""
        self.link.send(getattr(self._dialect, f"MAVLink_{kind}_message")(*fields))

    def _send_command(self, command: int, *parameters: float, attempt: int = 0) -> None:
        """Send a COMMAND_LONG. Parameters that are not given are 0."""
        values = [*parameters, *([0.0] * (7 - len(parameters)))]
        self._send("command_long", *self.link.target, command, attempt, *values)

    async def _answer(self, step: str, command: int, *parameters: float) -> Message:
        """Send a command until it is acknowledged. Return the COMMAND_ACK."""
        in_progress = self._dialect.MAV_RESULT_IN_PROGRESS

        def answers(message: Message) -> bool:
            return (
                _is("COMMAND_ACK")(message)
                and bool(message.command == command)
                and bool(message.result != in_progress)
            )

        async with self._commands:  # COMMAND_ACK names only the command, so send one at a time.
            for attempt in range(_TRIES):
                self._send_command(command, *parameters, attempt=attempt)
                ack = await self.link.wait_for(answers, _ANSWER_S)
                if ack is not None:
                    return ack
        raise self._failure(step, f"no answer after {_TRIES} tries")

    async def _insist(
        self, step: str, attempt: Callable[[], Awaitable[Message | None]], timeout_s: float
    ) -> None:
        """Repeat a command that may be refused at first, such as arming before the checks are done."""
        loop = asyncio.get_running_loop()
        deadline = loop.time() + timeout_s
        while True:
            ack = await attempt()
            if ack is None or ack.result == self._dialect.MAV_RESULT_ACCEPTED:
                return
            if loop.time() + _PAUSE_S > deadline:
                self._check(step, ack)
            await asyncio.sleep(_PAUSE_S)

    async def _confirm(self, step: str, holds: Callable[[], bool]) -> None:
        if not holds():
            await self._wait(step, lambda message: holds(), _CONFIRM_S)

    async def _wait(self, step: str, accept: Callable[[Message], bool], timeout_s: float) -> None:
        if await self.link.wait_for(accept, timeout_s) is None:
            raise self._failure(step, f"not done after {timeout_s:g} s")

    async def _fly(self, step: str, accept: Callable[[Message], bool], timeout_s: float) -> None:
        def news(message: Message) -> bool:
            return accept(message) or not (self.is_armed and self.is_guided)

        await self._wait(step, news, timeout_s)
        self.check_flight(step)

    def _check(self, step: str, ack: Message) -> None:
        if ack.result != self._dialect.MAV_RESULT_ACCEPTED:
            results: dict[int, Any] = self._dialect.enums["MAV_RESULT"]
            name = results[ack.result].name if ack.result in results else f"result {ack.result}"
            raise self._failure(step, f"refused with {name}")

    def _failure(self, step: str, why: str) -> SitlError:
        texts = list(dict.fromkeys(self.link.texts))[-3:]
        said = "; ".join(f'"{text}"' for text in texts) if texts else "nothing"
        printed = "" if texts else self.link.last_output()
        said += f"; it printed last: {printed}" if printed else ""
        return SitlError(f"{self.name}: {step}: {why}; the autopilot said: {said}")


def position_of(message: Message) -> tuple[float, float, float]:
    """Return (latitude deg, longitude deg, height above home m) of a GLOBAL_POSITION_INT."""
    return (message.lat / 1e7, message.lon / 1e7, message.relative_alt / 1000)


def _is(kind: str) -> Callable[[Message], bool]:
    return lambda message: bool(message.get_type() == kind)


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
    """Wait for a position, take off and fly to the start: (latitude deg, longitude deg, height above home m).

    The autopilot has to confirm each of its `parameters`. `check` is called when its position is known,
    before it moves. Raise SitlError if a step fails or takes longer than `timeout_s`.
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
