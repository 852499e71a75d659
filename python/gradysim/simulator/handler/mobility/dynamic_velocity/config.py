"""Configuration and exception of vehicles steered by velocity."""

from dataclasses import dataclass

from gradysim.protocol.checked_values import checked_number


class DynamicVelocityMobilityException(Exception):  # noqa: N818 (named as the other handlers' exceptions)
    """A command that a vehicle cannot carry out, or a node that is not registered."""


@dataclass
class DynamicVelocityMobilityConfiguration:
    """Limits of all vehicles, separate for the plane and the vertical. ValueError names an invalid value.

    Attributes:
        update_rate: Time between two updates of all positions; s, > 0.
        max_speed_xy: Largest speed in the plane; m/s, >= 0, may be infinite.
        max_speed_z: Largest speed up or down; m/s, >= 0, may be infinite.
        max_acc_xy: Largest acceleration in the plane; m/s², >= 0, may be infinite.
        max_acc_z: Largest acceleration up or down; m/s², >= 0, may be infinite.
        tau_xy: Time constant with which the velocity in the plane follows the desired one; s, > 0. None: only
            the acceleration limits it.
        tau_z: The same along the vertical.
        send_telemetry: Whether nodes get telemetry.
        telemetry_decimation: Number of updates per telemetry; >= 1.
    """

    update_rate: float
    max_speed_xy: float
    max_speed_z: float
    max_acc_xy: float
    max_acc_z: float
    tau_xy: float | None = None
    tau_z: float | None = None
    send_telemetry: bool = True
    telemetry_decimation: int = 1

    def __post_init__(self) -> None:
        checked_number("update_rate", self.update_rate, 0, above=True, unit="s")
        for name in ("max_speed_xy", "max_speed_z", "max_acc_xy", "max_acc_z"):
            unit = "m/s" if name.startswith("max_speed") else "m/s²"
            checked_number(name, getattr(self, name), 0, infinite=True, unit=unit)
        for name in ("tau_xy", "tau_z"):
            if (value := getattr(self, name)) is not None:
                checked_number(name, value, 0, above=True, unit="s")
        decimation = self.telemetry_decimation
        if not isinstance(decimation, int) or isinstance(decimation, bool) or decimation < 1:
            raise ValueError(f"telemetry_decimation must be an integer >= 1, got {decimation!r}")
