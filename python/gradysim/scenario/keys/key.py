"""One key of an .ini file: where its value goes, and what it has to be."""

from dataclasses import dataclass

from gradysim.scenario.parameter_types import ParameterType

HAS_TO_BE_GIVEN = "none: it has to be given"
"""The default of a key without which its model, or a run, is none."""


@dataclass(frozen=True)
class ReadBy:
    """The models that read a key, of those among which another key chooses.

    Attributes:
        chosen_by: The target of that other key.
        names: What it has to say.
        shown: What lists of keys call these models; "" where the key's path says enough.
    """

    chosen_by: str
    names: tuple[str, ...]
    shown: str


@dataclass(frozen=True)
class Key:
    """One parameter.

    Attributes:
        path: Below the node, or below the network for NETWORK_KEYS.
        target: "struct.field" that the value is for. Of two keys with one target, the first match wins.
        kind: What the value has to be.
        meaning: For people: a line of a list of all keys.
        default: As it would be written, for what no struct has a default for; "" where a struct has one.
        read_by: Which models read it, if not all do.
    """

    path: str
    target: str
    kind: ParameterType
    meaning: str
    default: str = ""
    read_by: ReadBy | None = None

    @property
    def written(self) -> str:
        """The path as people write it in a pattern."""
        return self.path.replace("[0]", "[*]")

    @property
    def struct(self) -> str:
        """The first part of the target."""
        return self.target.partition(".")[0]

    @property
    def field(self) -> str:
        """The second part of the target."""
        return self.target.partition(".")[2]
