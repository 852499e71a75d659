"""What a scenario says of the autopilot of a node."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from gradysim.protocol.defaults import SPEED_MPS
from gradysim.scenario.errors.config_error import ConfigError
from gradysim.scenario.errors.source import Source
from gradysim.scenario.keys import ARDUPILOT
from gradysim.scenario.settings import Setting
from gradysim.sitl.arducopter import LOWEST_SPEED_MPS, is_too_slow
from gradysim.sitl.unprivileged import DEFAULT_USER


@dataclass(frozen=True)
class AutopilotSpec:
    """The autopilot of one node.

    Attributes:
        source: Where it was chosen.
        program_source: Where the program was named, or it was chosen.
        user_source: Where the user was named, or it was chosen.
        parameters_source: Where its parameters were written, or it was chosen.
        program: An arducopter for SITL, or an ArduPilot checkout; None for the environment's.
        user: Whom it belongs to if root runs the simulation; None for root.
        speed_mps: Ground speed until the protocol sets another, >= `LOWEST_SPEED_MPS`.
        parameters: Of ArduCopter, by name.
    """

    source: Source
    program_source: Source
    user_source: Source
    parameters_source: Source
    program: str | None = None
    user: str | None = DEFAULT_USER
    speed_mps: float = SPEED_MPS
    parameters: Mapping[str, float] = field(default_factory=dict)


def read_autopilot(mobility: Mapping[str, Setting], autopilot: Mapping[str, Setting]) -> AutopilotSpec | None:
    """Return what the settings of a node's mobility say; None if no autopilot flies it.

    Raises:
        ConfigError: A value is none, or is out of range for an autopilot.
    """
    typename = mobility.get("typename")
    if typename is None or typename.value != ARDUPILOT:
        return None
    speed = mobility.get("speed_mps")
    if speed is not None and is_too_slow(float(speed.value)):
        raise ConfigError.at(
            speed.source, f"too slow for an autopilot; expected at least {LOWEST_SPEED_MPS:g}mps"
        )
    program = autopilot.get("program")
    user = autopilot.get("user")
    parameters = autopilot.get("parameters")
    return AutopilotSpec(
        source=typename.source,
        program_source=program.source if program else typename.source,
        user_source=user.source if user else typename.source,
        parameters_source=parameters.source if parameters else typename.source,
        program=str(program.value) or None if program else None,
        user=str(user.value) or None if user else DEFAULT_USER,
        speed_mps=float(speed.value) if speed else SPEED_MPS,
        parameters=_parameters(parameters) if parameters else {},
    )


def _parameters(setting: Setting) -> dict[str, float]:
    """Return {name: value} of a text such as "WPNAV_SPEED_UP=500 SIM_WIND_SPD=8"."""
    parameters: dict[str, float] = {}
    for word in str(setting.value).replace(",", " ").split():
        name, equals, text = word.partition("=")
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not name or not equals or not math.isfinite(value):
            raise ConfigError.at(
                setting.source,
                f'`{word}` is no parameter; expected some as "WPNAV_SPEED_UP=500 SIM_WIND_SPD=8"',
            )
        if name.upper() in parameters:
            raise ConfigError.at(setting.source, f"`{name}` comes twice; expected each parameter once")
        parameters[name.upper()] = value
    return parameters
