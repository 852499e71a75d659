"""Nodes, interfaces and autopilots of a scenario as plain data, as both modes build them."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from gradysim.protocol.checked_values import checked_point
from gradysim.protocol.defaults import (
    AUTOPILOT_USER,
    LOWEST_AUTOPILOT_SPEED_MPS,
    SPEED_MPS,
    is_too_slow_for_autopilot,
)
from gradysim.protocol.interface import IProtocol
from gradysim.scenario.errors import ConfigError, Source, did_you_mean
from gradysim.scenario.schema.keys import ARDUPILOT, QUADCOPTER
from gradysim.scenario.schema.parameters import can_be_set, parameters_of
from gradysim.scenario.schema.protocol_modules import Origin, origin_of
from gradysim.scenario.schema.values import Setting


@dataclass(frozen=True)
class InterfaceSpec:
    """What is set for one network interface; everything else keeps its default.

    Attributes:
        interface: Fields of InterfaceConfig itself.
        radio: Fields of RadioConfig.
        antenna: Fields of AntennaConfig.
        mac: Fields of MacConfig.
        csma: Fields of CsmaConfig.
        band: The name of a band that has no effect, at an 802.15.4 interface or with a channel or its center.
            It is kept for lint checks.
        range_sets_power: Whether transmitter.communicationRange comes before transmitter.power. On a medium
            where power decides, the range then sets the power.
    """

    interface: Mapping[str, Setting] = field(default_factory=dict)
    radio: Mapping[str, Setting] = field(default_factory=dict)
    antenna: Mapping[str, Setting] = field(default_factory=dict)
    mac: Mapping[str, Setting] = field(default_factory=dict)
    csma: Mapping[str, Setting] = field(default_factory=dict)
    band: Mapping[str, Setting] = field(default_factory=dict)
    range_sets_power: bool = False

    def structs(self) -> dict[str, Mapping[str, Setting]]:
        """Return the mappings by the names of their structs."""
        return {struct: getattr(self, struct) for struct in STRUCTS}

    def settings(self) -> dict[str, Setting]:
        """Return everything that is set, by field."""
        return {field: setting for struct in self.structs().values() for field, setting in struct.items()}


STRUCTS = ("interface", "radio", "antenna", "mac", "csma", "band")
"""The structs of an interface: the first parts of the targets of its keys."""


@dataclass(frozen=True)
class AutopilotSpec:
    """The autopilot of one node.

    Attributes:
        source: The source that chooses it.
        program_source: The source of the program, or `source`.
        user_source: The source of the user, or `source`.
        parameters_source: The source of its parameters, or `source`.
        program: An arducopter for SITL, or an ArduPilot checkout; None for that of the environment.
        user: The user that it runs as if root runs the simulation; None for root.
        speed_mps: Ground speed until the protocol sets another, >= `LOWEST_AUTOPILOT_SPEED_MPS`.
        parameters: Of ArduCopter, by name.
    """

    source: Source
    program_source: Source
    user_source: Source
    parameters_source: Source
    program: str | None = None
    user: str | None = AUTOPILOT_USER
    speed_mps: float = SPEED_MPS
    parameters: Mapping[str, float] = field(default_factory=dict)


def read_autopilot(mobility: Mapping[str, Setting], autopilot: Mapping[str, Setting]) -> AutopilotSpec | None:
    """Return the autopilot of a node; None if its mobility is not flown by one.

    Raises:
        ConfigError: A value is out of range for an autopilot, or its parameters are malformed.
    """
    typename = mobility.get("typename")
    if typename is None or typename.value != ARDUPILOT:
        return None
    speed = mobility.get("speed_mps")
    if speed is not None and is_too_slow_for_autopilot(float(speed.value)):
        raise ConfigError.at(
            speed.source, "too slow for an autopilot", expected=f"at least {LOWEST_AUTOPILOT_SPEED_MPS:g}mps"
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
        user=str(user.value) or None if user else AUTOPILOT_USER,
        speed_mps=float(speed.value) if speed else SPEED_MPS,
        parameters=_parameters(parameters) if parameters else {},
    )


def _parameters(setting: Setting) -> dict[str, float]:
    """Return {name: value} of a string such as "WPNAV_SPEED_UP=500 SIM_WIND_SPD=8"."""
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
                f"`{word}` is not a parameter",
                expected='parameters such as "WPNAV_SPEED_UP=500 SIM_WIND_SPD=8"',
            )
        if name.upper() in parameters:
            raise ConfigError.at(setting.source, f"`{name}` is repeated", expected="each parameter once")
        parameters[name.upper()] = value
    return parameters


@dataclass(frozen=True)
class NodeSpec:
    """One node.

    Attributes:
        id: 0 to n-1, in the order of the groups.
        name: "uavs[0]", or "groundStation" for a single node.
        group: The name without the index.
        index: The index in the group; 0 for a single node.
        protocol: The class as it is written; `parametrize` applies its parameters. A subclass of
            NativeProtocol stands for a protocol of the engine.
        protocol_parameters: Values of class attributes, checked and converted.
        initial_position: x, y, z in meters.
        mobility: Fields of MobilityConfig that are set; the others keep their defaults.
        wlan: Its network interfaces, at least one.
        protocol_sources: The sources of the parameters, and under "" that of the protocol.
        node: Settings of the node itself: the number of its interfaces, and its clock.
        computer: Fields of ComputerConfig that are set.
        autopilot: The autopilot that flies it, or None. The mobility is massless then and follows it.
        idle_autopilot: Settings of an autopilot, if none flies the node.
    """

    id: int
    name: str
    group: str
    index: int
    protocol: type[IProtocol]
    protocol_parameters: Mapping[str, object]
    initial_position: tuple[float, float, float]
    mobility: Mapping[str, Setting]
    wlan: tuple[InterfaceSpec, ...] = (InterfaceSpec(),)
    protocol_sources: Mapping[str, Source] = field(default_factory=dict)
    node: Mapping[str, Setting] = field(default_factory=dict)
    computer: Mapping[str, Setting] = field(default_factory=dict)
    autopilot: AutopilotSpec | None = None
    idle_autopilot: Mapping[str, Setting] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Check values that scripts may replace. Raises TypeError and ValueError, which name the node."""
        if not isinstance(self.protocol, type):
            raise TypeError(f"the protocol of {self.name} must be a class, got {self.protocol!r}")
        for name in self.protocol_parameters:
            if not can_be_set(self.protocol, name):
                hint = did_you_mean(name, parameters_of(self.protocol))
                raise ValueError(
                    f"`{name}` is not a parameter of {self.protocol.__name__}, the protocol of"
                    f" {self.name}{hint}"
                )
        position = checked_point(f"the position of {self.name}", self.initial_position, ValueError)
        object.__setattr__(self, "initial_position", position)

    @property
    def drift_rate(self) -> float:
        """How much faster than simulated time its clock runs, as a ratio: 1e-6 for 1 ppm."""
        drift = self.node.get("drift_rate_ppm")
        return 0.0 if drift is None else float(drift.value) * 1e-6

    @property
    def processing_time_s(self) -> float:
        """Median of the time that its computer takes for an event of the protocol."""
        median = self.computer.get("processing_time_s")
        return 0.0 if median is None else float(median.value)

    @property
    def is_quadcopter(self) -> bool:
        """Whether it is a quadcopter with the built-in controller."""
        typename = self.mobility.get("typename")
        return typename is not None and typename.value == QUADCOPTER

    @property
    def has_telemetry(self) -> bool:
        """Whether the telemetry interval is not 0."""
        interval = self.mobility.get("telemetry_interval_s")
        return interval is None or interval.value != 0

    def __reduce__(self) -> tuple[object, ...]:
        """Support pickle: other processes load the protocol from its file."""
        return _from_fields, ({**vars(self), "protocol": origin_of(self.protocol) or self.protocol},)


def _from_fields(fields: dict[str, Any]) -> NodeSpec:
    protocol: type[IProtocol] | Origin = fields["protocol"]
    return NodeSpec(**{**fields, "protocol": protocol.load() if isinstance(protocol, Origin) else protocol})
