"""Keys of a group of nodes and of what its nodes run."""

from gradysim.scenario.keys.key import HAS_TO_BE_GIVEN, Key
from gradysim.scenario.keys.shapes import Below
from gradysim.scenario.parameter_types import integer, si_number, text
from gradysim.scenario.units import UNITS_IN_NAMES

_protocol = Below("protocol", "protocol")

PROTOCOL_CLASS = _protocol(
    "class",
    "class",
    text(),
    'What the node runs: "file.py:Class", seen from the .ini file, or "package.module:Class"',
    default=HAS_TO_BE_GIVEN,
)

PROTOCOL_TYPENAME = _protocol(
    "typename",
    "typename",
    text(),
    "Instead of a class one of the engine's own protocols, listed below; integrated mode only",
    default="none",
)

PROTOCOL_KEYS: tuple[Key, ...] = (PROTOCOL_CLASS, PROTOCOL_TYPENAME)
"""The two ways to say what a node runs; of both the first match wins."""

PROTOCOL_PARAMETER = _protocol(
    "ATTRIBUTE",
    "attribute",
    si_number(),
    "A public class attribute of the protocol, int, float, str or bool; quantities become SI units,"
    ' or what its annotation says, `Annotated[float, "ms"]`, or its name ends in:'
    f" {', '.join(f'`_{unit.lower()}`' for unit in UNITS_IN_NAMES)}."
    " One whose unit is said so takes no quantity of another kind; an angle has to be said so. Of the others,"
    " one whose name ends in interval, timeout, period, delay or duration, or is jitter, spread or offset,"
    " should be a time, or a warning says so; the rest take any",
    default="the class's",
)
"""Stands for all of them in lists of keys; `parameters_of` knows a class's."""

GROUP_SIZE = Key(
    "count",
    "group.count",
    integer(0, 1_000_000),
    "Says the same as `*.numNodes`, `*.uavs.count` the same as `*.numUavs`",
    default="none",
)
"""Below the group, `*.uavs.count`; `*.numUavs` means the same."""

GROUP_SIZE_OF_NODES = Key(
    "numNodes",
    GROUP_SIZE.target,
    GROUP_SIZE.kind,
    "Number of nodes of the group `nodes`, `*.numUavs` that of `uavs`, and so on;"
    " neither this nor `count`: one node, no index",
    default="none",
)
"""Below the network. Stands for those of all groups in lists of keys; `find_groups` knows a file's."""
