"""One network interface of a node, as integrated mode builds it."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from gradysim.scenario.settings import Setting


@dataclass(frozen=True)
class InterfaceSpec:
    """What was set for one interface; all else keeps its default.

    Attributes:
        interface: Fields of InterfaceConfig itself.
        radio: Fields of RadioConfig.
        antenna: Fields of AntennaConfig.
        mac: Fields of MacConfig.
        csma: Fields of CsmaConfig.
        band: The name of a band, at an 802.15.4 interface or beside a channel or its centre. No struct of
            the engine has it; it is kept so that the line can be reported where nothing reads it.
        range_sets_power: Whether transmitter.communicationRange comes before transmitter.power: on a medium
            where power decides, the power is to be that for the range.
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
        """Return all that was set, by field."""
        return {field: setting for struct in self.structs().values() for field, setting in struct.items()}


STRUCTS = ("interface", "radio", "antenna", "mac", "csma", "band")
"""The structs that an interface is made of: the first parts of its keys' targets."""
