"""ArduCopter's program for SITL: where it is, how it is started, how its options are called; its limits."""

import os
import shutil
from collections.abc import Mapping
from pathlib import Path

from gradysim.protocol.position import Position
from gradysim.sitl.error import SitlError

ENVIRONMENT_VARIABLE = "GRADYSIM_ARDUPILOT"
"""Names the program, or a checkout of ArduPilot, where no path is given."""

LOWEST_SPEED_MPS = 0.2
"""Ground speed of flights to a place: ArduCopter accepts a lower one, and flies on at the one before."""

_IN_A_CHECKOUT = Path("build/sitl/bin/arducopter")

PARAMETERS: Mapping[str, float] = {
    # A quadcopter in X.
    "FRAME_CLASS": 1,
    "FRAME_TYPE": 1,
    # It may stand on the ground for long, and has neither remote control nor ground station to lose.
    "DISARM_DELAY": 0,
    "FS_THR_ENABLE": 0,
    "FS_GCS_ENABLE": 0,
    # One way to talk to it; the others would listen on all interfaces.
    "SERIAL1_PROTOCOL": -1,
    "SERIAL2_PROTOCOL": -1,
    # The simulated battery has a monitor; the log would fill the disk.
    "BATT_MONITOR": 4,
    "LOG_BITMASK": 0,
    # The checks before arming ask for calibrated sensors: as many as there are. The compass's offsets are the
    # simulated ones.
    **{f"COMPASS_OFS{n}_{axis}": v for n in ("", 2, 3) for axis, v in zip("XYZ", (5, 13, -18), strict=True)},
    **{f"INS_ACC{n}OFFS_{axis}": 0.001 for n in ("", 2) for axis in "XYZ"},
    **{f"INS_ACC{n}SCAL_{axis}": 1.001 for n in ("", 2) for axis in "XYZ"},
    **{f"RC{n}_{end}": v for n in range(1, 5) for end, v in (("MIN", 1000), ("MAX", 2000))},
    **{f"RC{n}_TRIM": v for n, v in ((1, 1500), (2, 1500), (3, 1000), (4, 1500))},
}
"""What differs from ArduCopter's defaults. Version 3 ends at a name that it does not know."""

_AT_ONCE = "1000"
"""A pace that it never reaches: who waits for physics is not to wait for the wall's clock besides."""

_SYSTEM_ID_OF_OLD = "SYSID_THISMAV"


def is_too_slow(speed_mps: float) -> bool:
    """Whether ArduCopter ignores a ground speed; one that is `LOWEST_SPEED_MPS` but for rounding it obeys."""
    return speed_mps < LOWEST_SPEED_MPS * (1 - 1e-9)


def find_arducopter(path: str | os.PathLike[str] | None) -> Path:
    """Find the program.

    Args:
        path: The program itself, or a checkout of ArduPilot in which it was built; None for what
            `ENVIRONMENT_VARIABLE` names, or else an `arducopter` among the commands.

    Raises:
        SitlError: It is not there, or cannot be executed.
    """
    given = path or os.environ.get(ENVIRONMENT_VARIABLE) or shutil.which("arducopter")
    if not given:
        raise SitlError(
            "no autopilot: give the path of an arducopter program for SITL, or of an ArduPilot checkout in "
            "which it was built, as mobility.autopilotPath (in a script ardupilot_path) or in the "
            f"environment variable {ENVIRONMENT_VARIABLE}"
        )
    place = Path(given).expanduser().absolute()
    program = place / _IN_A_CHECKOUT if place.is_dir() else place
    if not program.is_file():
        built = " (./waf configure --board sitl && ./waf copter builds it)" if place.is_dir() else ""
        raise SitlError(f"no autopilot at {program}: there is no such file{built}")
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
    """Return the options with which one vehicle is started.

    Args:
        home: (latitude deg, longitude deg, altitude m); it looks North.
        speedup: Seconds of its clock for each wall second.
        parameters: A file with its parameters, seen from its working directory.
        instance: Shifts the ports that it opens besides, by ten each.
        system_id: Its MAVLink id, 1 to 255.
        port: Of 127.0.0.1, where it connects to for MAVLink.
        help_text: What the program answers to --help: versions differ.
        physics_port: Of 127.0.0.1, UDP, where somebody else's physics listen; None for ArduPilot's own, at
            the pace of `speedup`.
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
    """Return the text of a file of parameters for one vehicle; see `options`. `more` come last."""
    ids = {} if _takes_system_id(help_text) else {_SYSTEM_ID_OF_OLD: system_id}
    return "".join(f"{name} {value:.9g}\n" for name, value in {**PARAMETERS, **ids, **more}.items())


def _takes_system_id(help_text: str) -> bool:
    return "--sysid" in help_text
