"""What many keys have in common: where they stand, and the kinds of value that come up again and again."""

from dataclasses import dataclass, replace
from typing import Self

from gradysim.config.key import Key, ReadBy
from gradysim.config.kinds import Kind, quantity


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

    def __call__(self, name: str, field: str, kind: Kind, meaning: str, default: str = "") -> Key:
        """Return the key `path.name`, whose value goes to `struct.field`."""
        return Key(f"{self.path}.{name}", f"{self.struct}.{field}", kind, meaning, default, self.read_by)

    def below(self, name: str) -> Self:
        """The same one step further down."""
        return replace(self, path=f"{self.path}.{name}")

    def only_for(self, chosen_by: str, *names: str, shown: str | None = None) -> Self:
        """The same for keys that only some models read; by default, `shown` is their names."""
        return replace(self, read_by=ReadBy(chosen_by, names, ", ".join(names) if shown is None else shown))


def angle() -> Kind:
    """How something is turned."""
    return quantity("rad", shown="deg")


def bit_rate() -> Kind:
    """The rate of some frames; -1bps stands for that of others."""
    return quantity("bps", above=0, special=-1, shown="Mbps")


def level() -> Kind:
    """A power that a receiver compares with."""
    return quantity("W", above=0, shown="dBm")
