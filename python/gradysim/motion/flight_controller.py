"""A quadcopter with a built-in controller: it has inertia and flies to targets without an autopilot.

The controller is a cascade, as those of autopilots: position, velocity, acceleration, attitude, rates and
thrusts. Its limits are close to ArduCopter's defaults. The engine has the same arithmetic in the same order:
cpp/netsim/mobility/quadcopter.cpp.

Source of the cascade and of the square root law: ArduPilot's documentation, "Copter Position Control and
Navigation". Source of the attitude error: R. Mahony, V. Kumar, P. Corke, "Multirotor Aerial Vehicles", IEEE
Robotics and Automation Magazine 19, 2012.
"""

import math
from dataclasses import dataclass

from gradysim.motion.gauss_markov import GaussMarkov
from gradysim.motion.quadcopter import (
    DRAG_KGPS,
    GRAVITY_MPS2,
    INERTIA_KGM2,
    LEVER_M,
    MASS_KG,
    MAX_THRUST_N,
    TORQUE_M,
    Quadcopter,
    Vector,
)
from gradysim.motion.wind import WindAtVehicle
from gradysim.protocol.position import Position

STEP_S = 0.01
"""Step of physics and controller. The fastest loop, that of the rates, needs 40 ms."""

MAX_ACCELERATION_MPS2 = 2.5
"""Limit on the horizontal acceleration, and on the vertical one, by default."""

_BRAKING_SHARE = 0.8
"""Share of this limit that is planned to brake before a target. The rest is a reserve."""

CLIMB_MPS, DESCENT_MPS = 2.5, 1.5
"""Largest vertical speeds."""

MAX_TILT_RAD = math.radians(30)

LEAST_HEIGHT_M = 0.5
"""Height above the ground at which it flies until it is above its target."""

ABOVE_TARGET_M = 1.0
"""Horizontal distance from which on it may land at its target."""

_POSITION_GAIN, _VELOCITY_GAIN, _ATTITUDE_GAIN, _RATE_GAIN = 0.9, 3.0, 8.0, 25.0
"""Of each loop, in 1/s."""

_MAX_RATE_RADPS = 3.0
_DRAG_TIME_S = 0.5
"""Time constant of the filter that estimates wind and drag."""

_TAN_TILT = math.tan(MAX_TILT_RAD)
_LEAST_LIFT_MPS2 = 0.3 * GRAVITY_MPS2
_FILTER = STEP_S / _DRAG_TIME_S
_ROLL_N = INERTIA_KGM2[0] * _RATE_GAIN / (4 * LEVER_M)
_PITCH_N = INERTIA_KGM2[1] * _RATE_GAIN / (4 * LEVER_M)
_YAW_N = INERTIA_KGM2[2] * _RATE_GAIN / (4 * TORQUE_M)
_MAX_YAW_N = 1.0


@dataclass(frozen=True)
class Airframe:
    """What differs between vehicles.

    Attributes:
        acceleration_mps2: Limit on the horizontal acceleration, and on the vertical one.
        drag_kgps: Force of the air in newtons per metre per second of airspeed.
    """

    acceleration_mps2: float = MAX_ACCELERATION_MPS2
    drag_kgps: float = DRAG_KGPS


class FlightController:
    """One vehicle and its controller. It hovers at its start until it gets a target.

    Attributes:
        speed_mps: Limit on its ground speed, and on its vertical speed if that is lower.
        position: Its true position (x, y, z) in meters.
    """

    def __init__(
        self,
        start: Position,
        speed_mps: float,
        wind: WindAtVehicle,
        error: GaussMarkov | None = None,
        airframe: Airframe = Airframe(),
    ) -> None:
        """Hover at `start`. The controller knows the position with this error."""
        x, y, z = start
        self._acceleration_mps2 = airframe.acceleration_mps2
        self._braking_mps2 = _BRAKING_SHARE * airframe.acceleration_mps2
        self._linear_m = self._braking_mps2 / (_POSITION_GAIN * _POSITION_GAIN)
        self._drag_per_s = airframe.drag_kgps / MASS_KG
        self._body = Quadcopter(drag_kgps=airframe.drag_kgps)
        self._body.position_m = (x, y, 0.0 - z)
        self._wind = wind
        self._error = error
        self._target: Vector = self._body.position_m
        self._drag_mps2: Vector = (0.0, 0.0, 0.0)
        self._steps = 0
        self.speed_mps = speed_mps
        self.position = start

    def go_to(self, target: Position) -> None:
        """Fly to a target (x, y, z) in meters, from the next step on."""
        x, y, z = target
        self._target = (x, y, 0.0 - z)

    def step(self) -> None:
        """Fly for `STEP_S`."""
        body = self._body
        time_s = self._steps / 100  # not times STEP_S, so that rounding errors do not add up
        self._steps += 1
        north, east, down = body.position_m
        if self._error is not None:
            error_x, error_y, error_z = self._error.at(time_s)
            north, east, down = north + error_x, east + error_y, down - error_z
        v_north, v_east, v_down = body.velocity_mps

        # Velocity that the position asks for.
        target_north, target_east, target_down = self._target
        delta_north, delta_east = target_north - north, target_east - east
        distance = math.sqrt(delta_north * delta_north + delta_east * delta_east)
        if distance > ABOVE_TARGET_M and target_down > -LEAST_HEIGHT_M:
            target_down = -LEAST_HEIGHT_M
        delta_down = target_down - down
        limit = self.speed_mps
        pace = self._approach_mps(distance, limit) / distance if distance > 0 else 0.0
        if delta_down < 0:
            sink = -self._approach_mps(-delta_down, CLIMB_MPS if limit > CLIMB_MPS else limit)
        else:
            sink = self._approach_mps(delta_down, DESCENT_MPS if limit > DESCENT_MPS else limit)

        # Acceleration that the velocity asks for.
        a_north = _VELOCITY_GAIN * (pace * delta_north - v_north)
        a_east = _VELOCITY_GAIN * (pace * delta_east - v_east)
        a_down = _VELOCITY_GAIN * (sink - v_down)
        size = math.sqrt(a_north * a_north + a_east * a_east)
        largest = self._acceleration_mps2
        if size > largest:
            a_north *= largest / size
            a_east *= largest / size
        if a_down > largest:
            a_down = largest
        elif a_down < -largest:
            a_down = -largest

        # Thrust, as an acceleration: against gravity, and against the wind that the accelerometer feels.
        wind = body.wind_mps = self._wind.velocity_mps(time_s)
        drag_north, drag_east, drag_down = self._drag_mps2
        drag_per_s = self._drag_per_s
        drag_north += _FILTER * (drag_per_s * (wind[0] - v_north) - drag_north)
        drag_east += _FILTER * (drag_per_s * (wind[1] - v_east) - drag_east)
        drag_down += _FILTER * (drag_per_s * (wind[2] - v_down) - drag_down)
        self._drag_mps2 = (drag_north, drag_east, drag_down)
        a_north -= drag_north
        a_east -= drag_east
        lift = GRAVITY_MPS2 + drag_down - a_down
        if lift < _LEAST_LIFT_MPS2:
            lift = _LEAST_LIFT_MPS2
        size = math.sqrt(a_north * a_north + a_east * a_east)
        if size > _TAN_TILT * lift:
            a_north *= _TAN_TILT * lift / size
            a_east *= _TAN_TILT * lift / size
        length = math.sqrt(a_north * a_north + a_east * a_east + lift * lift)

        # Attitude: its downward axis turns against the thrust, and its nose to the North.
        w, x, y, z = body.attitude
        forward_east = 2 * (x * y + w * z)
        forward = (1 - 2 * (y * y + z * z)) * a_north + forward_east * a_east - 2 * (x * z - w * y) * lift
        right = (
            2 * (x * y - w * z) * a_north + (1 - 2 * (x * x + z * z)) * a_east - 2 * (y * z + w * x) * lift
        )
        along = (
            (1 - 2 * (x * x + y * y)) * lift - 2 * (x * z + w * y) * a_north - 2 * (y * z - w * x) * a_east
        )
        p, q, r = body.rates_radps
        roll = _ROLL_N * (_limited(_ATTITUDE_GAIN * right / length, _MAX_RATE_RADPS) - p)
        pitch = _PITCH_N * (_limited(-_ATTITUDE_GAIN * forward / length, _MAX_RATE_RADPS) - q)
        yaw = _limited(_YAW_N * (-_ATTITUDE_GAIN * forward_east - r), _MAX_YAW_N)

        # Thrusts of the motors.
        each = along * MASS_KG / 4
        body.push(
            _limited_thrust(each - roll + pitch + yaw),
            _limited_thrust(each + roll - pitch + yaw),
            _limited_thrust(each + roll + pitch - yaw),
            _limited_thrust(each - roll - pitch - yaw),
            STEP_S,
        )
        north, east, down = body.position_m
        self.position = (north, east, 0.0 - down)

    def _approach_mps(self, distance_m: float, limit_mps: float) -> float:
        """Return the speed at a distance from the target with which it stops there, within a limit."""
        if distance_m > self._linear_m:
            speed = math.sqrt(2 * self._braking_mps2 * (distance_m - self._linear_m / 2))
        else:
            speed = _POSITION_GAIN * distance_m
        return speed if speed < limit_mps else limit_mps


def _limited(value: float, limit: float) -> float:
    return -limit if value < -limit else min(value, limit)


def _limited_thrust(thrust_n: float) -> float:
    return 0.0 if thrust_n < 0 else min(thrust_n, MAX_THRUST_N)
