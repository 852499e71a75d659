"""Physics of a quadcopter as a rigid body.

Positions and velocities are North, East and down of home. Rates and forces are forward, right and down of the
vehicle. The equations are those of rigid bodies (R. W. Beard and T. W. McLain, Small Unmanned Aircraft, 2012,
chapter 3), with a drag proportional to the airspeed. The integration is semi-implicit Euler.
"""

import math
from collections.abc import Sequence

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]

GRAVITY_MPS2 = 9.80665

MASS_KG = 2.0
INERTIA_KGM2: Vector = (0.03, 0.03, 0.05)
ARM_M = 0.25
"""Distance from the centre to each motor. The frame is an X."""

HOVER_THRUST = 0.35
"""Share of the maximum thrust at which it hovers: ArduCopter's default (MOT_THST_HOVER)."""

THRUST_EXPO = 0.65
"""Share of the thrust that grows with the square of the throttle: ArduCopter's default (MOT_THST_EXPO)."""

TORQUE_M = 0.02
"""Torque of a propeller about its axis per newton of thrust; N m / N."""

DRAG_KGPS = 0.3
"""Drag force in newtons per metre per second of airspeed, by default."""

ROTATION_DRAG_NMS = 0.05
"""Drag torque per radian per second."""

FRICTION = 0.5
"""Friction coefficient of the landing gear on the ground."""

MAX_THRUST_N = MASS_KG * GRAVITY_MPS2 / (4 * HOVER_THRUST)
"""Of one motor."""

LEVER_M = ARM_M * math.sqrt(0.5)
_IX, _IY, _IZ = INERTIA_KGM2


class Quadcopter:
    """One vehicle. It starts on the ground at home, level and facing North.

    Attributes:
        position_m: Position North, East and down of home.
        velocity_mps: Velocity, in the same frame.
        attitude: Quaternion (w, x, y, z) from the vehicle's frame to that of the world.
        rates_radps: Rotation rates about its own axes: roll, pitch, yaw.
        wind_mps: Velocity of the air, in the same frame.
        specific_force_mps2: Reading of its accelerometer, along its own axes. At rest (0, 0, -g).
    """

    def __init__(self, wind_mps: Vector = (0.0, 0.0, 0.0), drag_kgps: float = DRAG_KGPS) -> None:
        """Create a vehicle. `wind_mps` is the velocity of the air: North, East and down."""
        self._drag_per_s = drag_kgps / MASS_KG
        self.wind_mps = wind_mps
        self.position_m: Vector = (0.0, 0.0, 0.0)
        self.velocity_mps: Vector = (0.0, 0.0, 0.0)
        self.attitude: Quaternion = (1.0, 0.0, 0.0, 0.0)
        self.rates_radps: Vector = (0.0, 0.0, 0.0)
        self.specific_force_mps2: Vector = (0.0, 0.0, -GRAVITY_MPS2)

    def step(self, throttles: Sequence[float], duration_s: float) -> None:
        """Integrate one step of a few milliseconds at most, and note the reading of the accelerometer.

        The throttles of the four motors, 0 to 1, are in ArduPilot's order: front right, rear left
        (counterclockwise, seen from above), front left, rear right (clockwise).
        """
        front_right, rear_left, front_left, rear_right = map(_thrust_n, throttles)
        acceleration = self.push(front_right, rear_left, front_left, rear_right, duration_s)
        if acceleration is not None:
            north, east, down = acceleration
            w, x, y, z = self.attitude
            # Along the axes forward, right and down of the vehicle.
            self.specific_force_mps2 = (
                (1 - 2 * (y * y + z * z)) * north + 2 * (x * y + w * z) * east + 2 * (x * z - w * y) * down,
                2 * (x * y - w * z) * north + (1 - 2 * (x * x + z * z)) * east + 2 * (y * z + w * x) * down,
                2 * (x * z + w * y) * north + 2 * (y * z - w * x) * east + (1 - 2 * (x * x + y * y)) * down,
            )

    def push(
        self, front_right: float, rear_left: float, front_left: float, rear_right: float, duration_s: float
    ) -> Vector | None:
        """Integrate one step with these thrusts of the four motors, in newtons.

        Return the acceleration without gravity, along the axes of the world; None on the ground. All of the
        step is in one function, because it takes most of the time of a flight.
        """
        # Euler's equations for the rates; then the attitude by the new rates.
        p, q, r = self.rates_radps
        roll = LEVER_M * (rear_left + front_left - front_right - rear_right)
        pitch = LEVER_M * (front_right + front_left - rear_left - rear_right)
        yaw = TORQUE_M * (front_right + rear_left - front_left - rear_right)
        p, q, r = (
            p + duration_s * (roll - ROTATION_DRAG_NMS * p - (_IZ - _IY) * q * r) / _IX,
            q + duration_s * (pitch - ROTATION_DRAG_NMS * q - (_IX - _IZ) * r * p) / _IY,
            r + duration_s * (yaw - ROTATION_DRAG_NMS * r - (_IY - _IX) * p * q) / _IZ,
        )
        w, x, y, z = self.attitude
        half = duration_s / 2
        w, x, y, z = (
            w - half * (x * p + y * q + z * r),
            x + half * (w * p + y * r - z * q),
            y + half * (w * q - x * r + z * p),
            z + half * (w * r + x * q - y * p),
        )
        length = math.sqrt(w * w + x * x + y * y + z * z)
        w, x, y, z = w / length, x / length, y / length, z / length
        self.rates_radps = (p, q, r)
        self.attitude = (w, x, y, z)
        # Newton's law for the velocity; then the position by the new velocity.
        north, east, sink = self.velocity_mps
        wind_north, wind_east, wind_down = self.wind_mps
        lift = -(front_right + rear_left + front_left + rear_right) / MASS_KG
        drag_per_s = self._drag_per_s
        a_north = 2 * (x * z + w * y) * lift - drag_per_s * (north - wind_north)
        a_east = 2 * (y * z - w * x) * lift - drag_per_s * (east - wind_east)
        a_down = (1 - 2 * (x * x + y * y)) * lift - drag_per_s * (sink - wind_down)
        north += a_north * duration_s
        east += a_east * duration_s
        sink += (a_down + GRAVITY_MPS2) * duration_s
        x, y, z = self.position_m
        if z + sink * duration_s >= 0 and sink >= 0:
            self._slide(north, east, duration_s)
            return None
        self.velocity_mps = (north, east, sink)
        self.position_m = (x + north * duration_s, y + east * duration_s, z + sink * duration_s)
        return (a_north, a_east, a_down)

    def _slide(self, north: float, east: float, duration_s: float) -> None:
        """Be on the ground, level, with the heading that it had; lose speed by friction, or stand."""
        w, x, y, z = self.attitude
        heading = math.atan2(2 * (x * y + w * z), 1 - 2 * (y * y + z * z))
        self.attitude = (math.cos(heading / 2), 0.0, 0.0, math.sin(heading / 2))
        self.rates_radps = (0.0, 0.0, 0.0)
        speed, lost = math.hypot(north, east), FRICTION * GRAVITY_MPS2 * duration_s
        kept = 1 - lost / speed if speed > lost else 0.0
        a_north = (kept * north - self.velocity_mps[0]) / duration_s
        a_east = (kept * east - self.velocity_mps[1]) / duration_s
        self.velocity_mps = (kept * north, kept * east, 0.0)
        x, y, _ = self.position_m
        self.position_m = (x + kept * north * duration_s, y + kept * east * duration_s, 0.0)
        cos, sin = math.cos(heading), math.sin(heading)
        self.specific_force_mps2 = (
            cos * a_north + sin * a_east,
            cos * a_east - sin * a_north,
            -GRAVITY_MPS2,
        )


def _thrust_n(throttle: float) -> float:
    return MAX_THRUST_N * throttle * ((1 - THRUST_EXPO) + THRUST_EXPO * throttle)
