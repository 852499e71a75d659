"""What many keys have in common: where they stand, and the kinds of value that come up again and again."""

from dataclasses import dataclass, replace
from typing import Self

from gradysim.scenario.errors.config_error import BadValue
from gradysim.scenario.functions import Value
from gradysim.scenario.keys.key import Key, ReadBy
from gradysim.scenario.parameter_types import ParameterType, Scalar, quantity

_STRONGEST_W = 1


@dataclass(frozen=True)
class Below:
    """Makes keys that stand below one path and whose values go to one struct.

    Attributes:
        path: What their paths begin with.
        struct: The first part of their targets.
        read_by: Which models read them, if not all do.
    """

    path: str
    struct: str
    read_by: ReadBy | None = None

    def __call__(self, name: str, field: str, kind: ParameterType, meaning: str, default: str = "") -> Key:
        """Return the key `path.name`, whose value goes to `struct.field`."""
        return Key(f"{self.path}.{name}", f"{self.struct}.{field}", kind, meaning, default, self.read_by)

    def below(self, name: str) -> Self:
        """The same one step further down."""
        return replace(self, path=f"{self.path}.{name}")

    def only_for(self, chosen_by: str, *names: str, shown: str | None = None) -> Self:
        """The same for keys that only some models read; by default, `shown` is their names."""
        return replace(self, read_by=ReadBy(chosen_by, names, ", ".join(names) if shown is None else shown))


def angle() -> ParameterType:
    """How something is turned."""
    return quantity("rad", shown="deg")


def bit_rate() -> ParameterType:
    """The rate of some frames; -1bps stands for that of others."""
    return quantity("bps", above=0, special=-1, shown="Mbps")


def level(zero: bool = False) -> ParameterType:
    """A power that a receiver compares with, in the air around it; `zero` is allowed or not.

    At most 1 W (30 dBm): more than anybody receives, and less than the usual levels without their minus. The
    engine has no such bound: who builds networks in a program writes watts, and may put radios side by side.
    """
    power = quantity("W", at_least=0, shown="dBm") if zero else quantity("W", above=0, shown="dBm")

    def convert(value: Value) -> Scalar:
        power_w = power.convert(value)
        if float(power_w) > _STRONGEST_W:
            raise BadValue(f"`{value}` is more than any radio receives", "; a minus forgotten?")
        return power_w

    return replace(power, expected=f"{power.expected} and at most {_STRONGEST_W}W", convert=convert)
