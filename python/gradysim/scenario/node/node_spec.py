"""One node of a scenario, as both modes build it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from gradysim.protocol.checked_values import checked_point
from gradysim.protocol.interface import IProtocol
from gradysim.scenario.errors.nearest import did_you_mean
from gradysim.scenario.errors.source import Source
from gradysim.scenario.node.autopilot_spec import AutopilotSpec
from gradysim.scenario.node.interface_spec import InterfaceSpec
from gradysim.scenario.parameters import can_be_set, parameters_of
from gradysim.scenario.protocol_modules import Origin, origin_of
from gradysim.scenario.settings import Setting


@dataclass(frozen=True)
class NodeSpec:
    """One node.

    Attributes:
        id: 0 to n-1, in the order of the groups.
        name: "uavs[0]", or "groundStation" for a single node.
        group: The name without the index.
        index: The index in the group; 0 for a single node.
        protocol: The class as it was written; see parametrize for its parameters. A subclass of
            NativeProtocol stands for a protocol of the engine.
        protocol_parameters: Values of class attributes, checked and converted.
        initial_position: x, y, z in metres.
        mobility: Fields of MobilityConfig that were set; the others keep their defaults.
        wlan: Its network interfaces, at least one.
        protocol_sources: Where the parameters were written, and under "" what chose the protocol.
        node: Where what is about the whole node was written: the number of its interfaces.
        autopilot: What flies it, if an autopilot does; its mobility is massless then, which follows the
            autopilot's vehicle.
        idle_autopilot: What was written for an autopilot, if none flies it.
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
    autopilot: AutopilotSpec | None = None
    idle_autopilot: Mapping[str, Setting] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Check what scripts replace. Raises TypeError and ValueError, which name the node."""
        if not isinstance(self.protocol, type):
            raise TypeError(f"the protocol of {self.name} must be a class, got {self.protocol!r}")
        for name in self.protocol_parameters:
            if not can_be_set(self.protocol, name):
                hint = did_you_mean(name, parameters_of(self.protocol))
                raise ValueError(
                    f"`{name}` is no parameter of {self.protocol.__name__}, the protocol of {self.name}{hint}"
                )
        place = checked_point(f"the position of {self.name}", self.initial_position, ValueError)
        object.__setattr__(self, "initial_position", place)

    def __reduce__(self) -> tuple[object, ...]:
        """For pickle: other processes load the protocol from its file."""
        return _from_fields, ({**vars(self), "protocol": origin_of(self.protocol) or self.protocol},)


def _from_fields(fields: dict[str, Any]) -> NodeSpec:
    protocol: type[IProtocol] | Origin = fields["protocol"]
    return NodeSpec(**{**fields, "protocol": protocol.load() if isinstance(protocol, Origin) else protocol})
