"""What one number of a node was over time."""

from array import array
from dataclasses import dataclass
from typing import TypeAlias

Times: TypeAlias = "array[int]"
"""Of 64 bits each, in picoseconds of simulated time."""

Values: TypeAlias = "array[float]"


@dataclass(frozen=True)
class Vector:
    """One number over time: a variable that a protocol tracks, or a coordinate. A row for each assignment.

    The arrays are of one length, and go to numpy without a copy (`numpy.asarray(vector.values)`). Of a run
    that goes on they are what was recorded when its result was taken.

    Attributes:
        part: The part of the node that it is about: "protocol" or "mobility".
        name: What the protocol calls the variable; `positionX`, `positionY` and `positionZ` of the
            trajectory.
        times_ps: Picoseconds of simulated time, none before the one ahead of it.
        values: NaN where the variable became something else than a number, or was removed.
        unit: Of the values; "" for what has none, or none that is known.
    """

    part: str
    name: str
    times_ps: Times
    values: Values
    unit: str = ""
