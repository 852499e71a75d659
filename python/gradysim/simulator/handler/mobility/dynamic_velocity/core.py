"""Motion of a vehicle steered by velocity: pure functions of one time step.

In the plane a limit applies to the length of the vector (x, y), which keeps its direction. Along the vertical
it applies to |z|. Velocities are (vx, vy, vz) in m/s, positions (x, y, z) in meters.
"""

import math

from gradysim.protocol.position import Position
from gradysim.simulator.handler.mobility.dynamic_velocity.telemetry import Velocity


def apply_acceleration_limits(
    v_current: Velocity, v_desired: Velocity, dt: float, max_acc_xy: float, max_acc_z: float
) -> Velocity:
    """Move a velocity towards the desired one, within the acceleration (m/s², >= 0), in `dt` (s, >= 0).

    Raise ValueError if `dt` or a limit is negative or not a number.
    """
    if not dt >= 0:
        raise ValueError(f"dt must be >= 0 s, got {dt!r}")
    _check_limit("max_acc_xy", max_acc_xy)
    _check_limit("max_acc_z", max_acc_z)
    change = _difference(v_desired, v_current)
    return _sum(v_current, _limited(change, _times(max_acc_xy, dt), _times(max_acc_z, dt)))


def apply_velocity_tracking_first_order(
    v_current: Velocity,
    v_desired: Velocity,
    dt: float,
    max_acc_xy: float,
    max_acc_z: float,
    tau_xy: float | None,
    tau_z: float | None,
) -> Velocity:
    """Let a velocity follow the desired one like a first-order system: a = (v_desired - v_current) / tau.

    The acceleration (m/s², >= 0) is limited, too. A step of `dt` (s, > 0) that is longer than tau (s, > 0)
    ends at the desired velocity, not beyond it. Without a tau (None), only the acceleration limits the
    change. ValueError if a number is outside its range.
    """
    if not dt > 0:
        raise ValueError(f"dt must be > 0 s, got {dt!r}")
    _check_limit("max_acc_xy", max_acc_xy)
    _check_limit("max_acc_z", max_acc_z)
    share_xy = _share("tau_xy", tau_xy, dt)
    share_z = _share("tau_z", tau_z, dt)
    x, y, z = _difference(v_desired, v_current)
    change = (x * share_xy, y * share_xy, z * share_z)
    return _sum(v_current, _limited(change, _times(max_acc_xy, dt), _times(max_acc_z, dt)))


def apply_velocity_limits(v: Velocity, max_speed_xy: float, max_speed_z: float) -> Velocity:
    """Limit a velocity to the largest speeds (m/s, >= 0). ValueError if a limit is out of range."""
    _check_limit("max_speed_xy", max_speed_xy)
    _check_limit("max_speed_z", max_speed_z)
    return _limited(v, max_speed_xy, max_speed_z)


def integrate_position(position: Position, velocity: Velocity, dt: float) -> Position:
    """Return the position (m) after `dt` seconds at constant velocity."""
    return (
        position[0] + velocity[0] * dt,
        position[1] + velocity[1] * dt,
        position[2] + velocity[2] * dt,
    )


def _limited(vector: Velocity, limit_xy: float, limit_z: float) -> Velocity:
    x, y, z = vector
    length = math.hypot(x, y)
    if length > limit_xy:
        scale = limit_xy / length
        x *= scale
        y *= scale
    return (x, y, max(-limit_z, min(limit_z, z)))


def _times(limit: float, dt: float) -> float:
    """Return the product; 0 for a step of length 0, also if the limit is infinite."""
    return 0.0 if dt == 0 else limit * dt


def _share(name: str, tau: float | None, dt: float) -> float:
    """Return the part of the difference to the desired velocity that one step covers."""
    if tau is None:
        return 1.0
    if not tau > 0:
        raise ValueError(f"{name} must be > 0 s or None, got {tau!r}")
    return min(1.0, dt / tau)


def _check_limit(name: str, value: float) -> None:
    if not value >= 0:
        raise ValueError(f"{name} must be >= 0, got {value!r}")


def _difference(a: Velocity, b: Velocity) -> Velocity:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _sum(a: Velocity, b: Velocity) -> Velocity:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])
