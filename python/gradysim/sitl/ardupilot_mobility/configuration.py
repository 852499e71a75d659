"""Settings and exception of the ArduPilot mobility handler."""

import os
from collections.abc import Mapping
from dataclasses import dataclass

from gradysim.protocol.checked_values import checked_number
from gradysim.protocol.defaults import (
    AUTOPILOT_USER,
    LOWEST_AUTOPILOT_SPEED_MPS,
    SPEED_MPS,
    is_too_slow_for_autopilot,
)
from gradysim.protocol.position import Position
from gradysim.simulator.validation import check_reference
from gradysim.sitl.connection import parse_address


@dataclass
class ArdupilotMobilityConfiguration:
    """Settings of an `ArdupilotMobilityHandler`. A wrong value raises ValueError.

    Attributes:
        update_rate: Simulated time between two telemetries of a node; s, > 0.
        default_speed: Ground speed of each node until its protocol sets another; m/s, >= 0.2.
        reference_coordinates: (latitude deg, longitude deg, altitude m) of the origin of the frame.
        generate_report: Write `ardupilot_mobility_report.csv` to the working directory at the end.
        simulate_drones: Start an autopilot for each node; otherwise use the vehicles at `vehicle_addresses`.
        ground_station_ip: Host that gets the messages of all vehicles on UDP port 14550. Its commands reach
            the vehicles.
        starting_api_port: Ignored, for compatibility. No server is used, and free ports are found
            automatically.
        ardupilot_path: An arducopter program for SITL, or an ArduPilot checkout in which it was built. None
            for the path in the environment variable GRADYSIM_ARDUPILOT, or the command `arducopter`.
        uav_api_log_path: Directory for the output of autopilots, `autopilot_<id>.log`; None to discard it.
        uav_api_startup_timeout: Limit for each step before the simulation starts (connect, position, arm,
            take off, fly to the initial position); s, > 0. It is wall time. On simulated time it is the time
            of the vehicle after it has connected.
        uav_api_log_console: Log texts of autopilots (STATUSTEXT) at level INFO instead of DEBUG.
        simulation_startup_speedup: In real time only: speed of simulated autopilots before the simulation
            starts, in seconds per second of wall time; > 0.
        mavlink_streamrate: In real time only: positions per second of each autopilot; Hz, > 0. At least one
            per `update_rate` is requested.
        vehicle_addresses: Addresses of vehicles that are not simulated, by node id: "tcp:HOST:PORT" or
            "udpout:HOST:PORT" to connect to, "udpin:HOST:PORT" to listen on.
        autopilot_parameters: ArduCopter parameters by name, such as {"SIM_WIND_SPD": 5}, for simulated
            autopilots, which have to confirm them.
        autopilot_user: User of simulated autopilots if root runs the simulation; None for root.
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
    autopilot_user: str | None = AUTOPILOT_USER
    autopilot_parameters: Mapping[str, float] | None = None

    def __post_init__(self) -> None:
        for name, unit in (
            ("update_rate", "s"),
            ("default_speed", "m/s"),
            ("uav_api_startup_timeout", "s"),
            ("simulation_startup_speedup", ""),
            ("mavlink_streamrate", "Hz"),
        ):
            checked_number(name, getattr(self, name), 0, above=True, unit=unit)
        if is_too_slow_for_autopilot(self.default_speed):
            raise ValueError(
                f"default_speed must be at least {LOWEST_AUTOPILOT_SPEED_MPS:g} m/s for an autopilot, "
                f"got {self.default_speed!r}"
            )
        for name, value in (self.autopilot_parameters or {}).items():
            checked_number(f"the autopilot's parameter {name}", value)
        check_reference(self.reference_coordinates)
        for address in (self.vehicle_addresses or {}).values():
            parse_address(address)
