"""The ArduCopter program for SITL: its path, options, parameters, limits and ports."""

import os
import random
import shutil
import socket
from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path

from gradysim.protocol.position import Position
from gradysim.sitl import SitlError

ENVIRONMENT_VARIABLE = "GRADYSIM_ARDUPILOT"
"""Environment variable with the path of the program or of an ArduPilot checkout."""

_IN_A_CHECKOUT = Path("build/sitl/bin/arducopter")

PARAMETERS: Mapping[str, float] = {
    # A quadcopter in X.
    "FRAME_CLASS": 1,
    "FRAME_TYPE": 1,
    # It may stand on the ground for long, without remote control or ground station.
    "DISARM_DELAY": 0,
    "FS_THR_ENABLE": 0,
    "FS_GCS_ENABLE": 0,
    # Its port for remote control listens on all interfaces. It ignores what comes there.
    "SIM_RC_FAIL": 1,
    # Only one connection is used. The others would listen on all interfaces.
    "SERIAL1_PROTOCOL": -1,
    "SERIAL2_PROTOCOL": -1,
    # Monitor the simulated battery. Write no log, which would fill the disk.
    "BATT_MONITOR": 4,
    "LOG_BITMASK": 0,
    # The checks before arming need calibrated sensors. The compass offsets are the simulated ones.
    **{f"COMPASS_OFS{n}_{axis}": v for n in ("", 2, 3) for axis, v in zip("XYZ", (5, 13, -18), strict=True)},
    **{f"INS_ACC{n}OFFS_{axis}": 0.001 for n in ("", 2) for axis in "XYZ"},
    **{f"INS_ACC{n}SCAL_{axis}": 1.001 for n in ("", 2) for axis in "XYZ"},
    **{f"RC{n}_{end}": v for n in range(1, 5) for end, v in (("MIN", 1000), ("MAX", 2000))},
    **{f"RC{n}_TRIM": v for n, v in ((1, 1500), (2, 1500), (3, 1000), (4, 1500))},
}
"""Parameters that differ from the defaults. ArduCopter 3 exits at a name that it does not know."""

_AT_ONCE = "1000"
"""Speed-up that is never reached, so that it waits only for the physics, not for wall time."""

_SYSTEM_ID_OF_OLD = "SYSID_THISMAV"


def find_arducopter(path: str | os.PathLike[str] | None) -> Path:
    """Find the program. Raise SitlError if it does not exist or is not executable.

    The path is that of the program itself, or of a checkout of ArduPilot in which it was built. None stands
    for the path in `ENVIRONMENT_VARIABLE`, or else the command `arducopter`.
    """
    given = path or os.environ.get(ENVIRONMENT_VARIABLE) or shutil.which("arducopter")
    if not given:
        raise SitlError(
            "no autopilot: set mobility.autopilotPath (in a script ardupilot_path) to the path of an "
            "arducopter program for SITL or of an ArduPilot checkout in which it was built, or set the "
            f"environment variable {ENVIRONMENT_VARIABLE}"
        )
    location = Path(given).expanduser().absolute()
    program = location / _IN_A_CHECKOUT if location.is_dir() else location
    if not program.is_file():
        built = " (./waf configure --board sitl && ./waf copter builds it)" if location.is_dir() else ""
        raise SitlError(f"no autopilot at {program}: this file does not exist{built}")
    if not os.access(program, os.X_OK):
        raise SitlError(f"the autopilot {program} is not executable")
    return program


def options(
    *,
    home: Position,
    speedup: float,
    parameters: Path,
    instance: int,
    system_id: int,
    port: int,
    help_text: str,
    physics_port: int | None = None,
) -> list[str]:
    """Return the command-line options for one vehicle, which faces North.

    The path of its parameter file is relative to its working directory. Each instance opens ports ten higher
    than the one before. It connects to `port` (TCP, of 127.0.0.1) for MAVLink, and to `physics_port` (UDP)
    for external physics; without one it has ArduPilot's own, at the rate of `speedup`. Versions differ by
    their output for --help.
    """
    is_ours = physics_port is not None
    latitude, longitude, altitude = home
    serial = "--serial0" if "--serial0" in help_text else "--uartA"
    return [
        "--wipe",
        *("--model", "JSON:127.0.0.1" if is_ours else "quad"),
        *("--home", f"{latitude:.7f},{longitude:.7f},{altitude:.3f},0"),
        *("--speedup", _AT_ONCE if is_ours else f"{speedup:g}"),
        *(("--sim-port-out", str(physics_port)) if is_ours else ()),
        *("--defaults", str(parameters)),
        *("--instance", str(instance)),
        *(("--sysid", str(system_id)) if _takes_system_id(help_text) else ()),
        *(serial, f"tcpclient:127.0.0.1:{port}"),
    ]


def parameter_file(*, system_id: int, help_text: str, more: Mapping[str, float]) -> str:
    """Return the content of a parameter file for one vehicle, see `options`. `more` comes last."""
    ids = {} if _takes_system_id(help_text) else {_SYSTEM_ID_OF_OLD: system_id}
    return "".join(f"{name} {value:.9g}\n" for name, value in {**PARAMETERS, **ids, **more}.items())


def _takes_system_id(help_text: str) -> bool:
    return "--sysid" in help_text


_FIRST_PORTS = ((socket.SOCK_DGRAM, 5501), (socket.SOCK_DGRAM, 9003), (socket.SOCK_STREAM, 5760))
"""Ports that instance 0 may open: remote control and external physics (UDP), first serial port (TCP)."""

_PORTS_PER_INSTANCE = 10
_INSTANCES = 256
"""ArduCopter 4.1 and older take larger numbers modulo 256."""

_TRIES = 100


def free_instance(taken: set[int]) -> int:
    """Return an instance number, not in `taken`, whose ports are free. Raise SitlError if none is found.

    It is drawn from the system's random numbers, not from the simulation's seed, so simulations that start
    at the same time rarely conflict.
    """
    generator = random.SystemRandom()
    for _ in range(_TRIES):
        instance = generator.randrange(_INSTANCES)
        if instance not in taken and _is_free(instance):
            return instance
    raise SitlError(f"no free ports for another autopilot, after {_TRIES} tries")


def _is_free(instance: int) -> bool:
    with ExitStack() as stack:
        try:
            for kind, first in _FIRST_PORTS:
                probe = stack.enter_context(socket.socket(socket.AF_INET, kind))
                probe.bind(("0.0.0.0", first + _PORTS_PER_INSTANCE * instance))
        except OSError:
            return False
    return True
