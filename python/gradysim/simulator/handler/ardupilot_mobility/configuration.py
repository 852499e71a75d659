"""Which autopilots fly the nodes, and how they are started."""

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass

from gradysim.protocol.checked_values import is_in_range
from gradysim.protocol.defaults import SPEED_MPS
from gradysim.protocol.position import Position
from gradysim.simulator.validation import check_reference
from gradysim.sitl.arducopter import LOWEST_SPEED_MPS, is_too_slow
from gradysim.sitl.connection import parse_address
from gradysim.sitl.unprivileged import DEFAULT_USER


@dataclass
class ArdupilotMobilityConfiguration:
    """Settings of an `ArdupilotMobilityHandler`. ValueError names a wrong one.

    Attributes:
        update_rate: Simulated time between two telemetries of a node; s, > 0.
        default_speed: Ground speed of each node until its protocol sets another; m/s, >= 0.2.
        reference_coordinates: (latitude deg, longitude deg, altitude m) of the origin of the frame.
        generate_report: Write `ardupilot_mobility_report.csv` into the working directory at the end.
        simulate_drones: Start an autopilot for each node; otherwise fly what is at `vehicle_addresses`.
        ground_station_ip: Host to whose UDP port 14550 the messages of all vehicles are passed on; orders
            from there reach them.
        starting_api_port: Has no meaning here: no server stands between the simulation and its autopilots,
            and free ports are found by themselves.
        ardupilot_path: An arducopter program for SITL, or an ArduPilot checkout in which it was built. None
            for what the environment variable GRADYSIM_ARDUPILOT names, or the command `arducopter`.
        uav_api_log_path: Folder for what the autopilots print, `autopilot_<id>.log`; None to throw it away.
        uav_api_startup_timeout: Time for each step before the simulation starts: to connect, to know the
            position, to arm, to take off, to reach the initial position; s, > 0. Wall time; on simulated time
            that of the vehicle, from the moment when it has connected.
        uav_api_log_console: Log what the autopilots say (STATUSTEXT) as information, not just for debugging.
        simulation_startup_speedup: In real time: how fast simulated autopilots run before the simulation
            starts, seconds of theirs for each wall second; > 0.
        mavlink_streamrate: In real time: positions that each autopilot sends in a second of its own; Hz, > 0.
            At least one for each `update_rate` is asked for.
        vehicle_addresses: Where the vehicles are if they are not simulated, by node id: "tcp:HOST:PORT" or
            "udpout:HOST:PORT" to connect to, "udpin:HOST:PORT" to listen on.
        autopilot_parameters: ArduCopter's parameters by name, such as {"SIM_WIND_SPD": 5}, for simulated
            autopilots; each has to confirm them.
        autopilot_user: Whom simulated autopilots belong to if root runs the simulation; None for root.
    """

    update_rate: float = 0.1
    default_speed: float = SPEED_MPS
    reference_coordinates: Position = (0, 0, 0)
    generate_report: bool = True
    simulate_drones: bool = True
    ground_station_ip: str | None = None
    starting_api_port: int = 8000
    ardupilot_path: str | os.PathLike[str] | None = None
    uav_api_log_path: str | os.PathLike[str] | None = None
    uav_api_startup_timeout: float = 120
    uav_api_log_console: bool = False
    simulation_startup_speedup: float = 5
    mavlink_streamrate: float = 10
    vehicle_addresses: Mapping[int, str] | None = None
    autopilot_user: str | None = DEFAULT_USER
    autopilot_parameters: Mapping[str, float] | None = None

    def __post_init__(self) -> None:
        for name, unit in (
            ("update_rate", "s"),
            ("default_speed", "m/s"),
            ("uav_api_startup_timeout", "s"),
            ("simulation_startup_speedup", ""),
            ("mavlink_streamrate", "Hz"),
        ):
            value = getattr(self, name)
            if not is_in_range(value, 0, above=True):
                raise ValueError(f"{name} must be finite and > 0 {unit}".rstrip() + f", got {value!r}")
        if is_too_slow(self.default_speed):
            raise ValueError(
                f"default_speed must be at least {LOWEST_SPEED_MPS:g} m/s for an autopilot, "
                f"got {self.default_speed!r}"
            )
        for name, value in (self.autopilot_parameters or {}).items():
            if not is_in_range(value, -math.inf, above=True):
                raise ValueError(f"the autopilot's parameter {name} must be a finite number, got {value!r}")
        check_reference(self.reference_coordinates)
        for address in (self.vehicle_addresses or {}).values():
            parse_address(address)
