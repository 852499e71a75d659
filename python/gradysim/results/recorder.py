"""Records the numbers of a node over time, as vectors."""

import operator
from array import array
from collections.abc import Iterable, Sized
from dataclasses import dataclass
from typing import TypeAlias

from gradysim.protocol.plain_value import as_float, key_text

Times: TypeAlias = "array[int]"
"""64-bit integers: picoseconds of simulated time."""

Values: TypeAlias = "array[float]"

_NAN = float("nan")


@dataclass(frozen=True)
class Vector:
    """One number over time: a tracked variable or a coordinate, with a row for each assignment.

    The arrays have the same length, and go to numpy without copying (`numpy.asarray(vector.values)`). While a
    run goes on, they have what was recorded when its result was taken.

    Attributes:
        part: The part of the node that it belongs to: "protocol" or "mobility".
        name: Name of the variable in the protocol; `positionX`, `positionY` and `positionZ` of the
            trajectory.
        times_ps: Picoseconds of simulated time, in ascending order.
        values: NaN where the variable became something else than a number, or was removed.
        unit: Of the values; "" for none, or if it is not known.
    """

    part: str
    name: str
    times_ps: Times
    values: Values
    unit: str = ""


class NodeRecorder:
    """The vectors of one node, while they grow."""

    def __init__(self) -> None:
        self._tracked: dict[str, tuple[Times, Values]] = {}
        self._position_times: Times = array("q")
        self._positions: tuple[Values, Values, Values] = (array("d"), array("d"), array("d"))

    def variable_set(self, time_ps: int, name: str, value: object) -> None:
        """Record the new value of a tracked variable, None if it was removed.

        A variable that has never been a number is not recorded.
        """
        number = as_float(value)
        vector = self._tracked.get(name)
        if vector is None:
            if number is None:
                return
            vector = self._tracked[name] = (array("q"), array("d"))
        vector[0].append(time_ps)
        vector[1].append(_NAN if number is None else number)

    def position_told(self, time_ps: int, x: float, y: float, z: float) -> None:
        """Record where the node is, in meters."""
        self._position_times.append(time_ps)
        for coordinates, value in zip(self._positions, (x, y, z), strict=True):
            coordinates.append(value)

    def vectors(self) -> tuple[Vector, ...]:
        """Return what was recorded up to now, the tracked variables in the order of their first numbers.

        The arrays are copies: an array with a view (`numpy.asarray`) cannot grow.
        """
        tracked = []
        for name, (times_ps, values) in self._tracked.items():
            count = _complete_rows(times_ps, values)
            tracked.append(Vector("protocol", key_text(name), times_ps[:count], values[:count]))
        count = _complete_rows(self._position_times, *self._positions)
        times_ps = self._position_times[:count]
        positions = [
            Vector("mobility", f"position{axis}", times_ps, coordinates[:count], "m")
            for axis, coordinates in zip("XYZ", self._positions, strict=True)
        ]
        return (*tracked, *positions)


def _complete_rows(*columns: Sized) -> int:
    """Count the rows, without one that Ctrl-C interrupted."""
    return min(map(len, columns))


def recorders_of(vectors_of: Iterable[int], count: int) -> dict[int, NodeRecorder]:
    """Return a recorder for each of the nodes with these ids, of `count` nodes.

    Raises TypeError and ValueError as `checked_ids`.
    """
    return {node_id: NodeRecorder() for node_id in sorted(set(checked_ids("vectors_of", vectors_of, count)))}


def checked_ids(argument: str, ids: Iterable[int], count: int, expected: str = "") -> list[int]:
    """Return the ids of some of `count` nodes that `argument` names, as Python's integers.

    Raises TypeError for what is not an id, and ValueError for an id that no node has. `expected` is for the
    message of the first one.
    """
    try:
        checked = [operator.index(node_id) for node_id in ids]
    except TypeError:
        expected = expected or f"ids of nodes, such as [0], or range({count}) for all"
        raise TypeError(f"{argument} = {ids!r:.80}: expected {expected}") from None
    for node_id in checked:
        if not 0 <= node_id < count:
            raise ValueError(
                f"{argument}: there is no node {node_id}; expected ids of the {count} nodes, from 0"
            )
    return checked
