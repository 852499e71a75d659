"""Records the numbers of a node over time, as vectors."""

import operator
from array import array
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeAlias

from gradysim.protocol.plain_value import as_float, key_text

Times: TypeAlias = "array[int]"
"""64-bit integers: picoseconds of simulated time."""

Values: TypeAlias = "array[float]"

_NAN = float("nan")
_PS_PER_S = 1e12


@dataclass(frozen=True)
class Vector:
    """One number over time: a tracked variable or a coordinate, with a row for each change.

    The arrays have the same length, and numpy can use them without a copy (`numpy.asarray(vector.values)`).
    If the run is not complete, they end where its result was taken.

    Attributes:
        part: Part of the node: "protocol" or "mobility".
        name: Name of the variable in the protocol; `positionX`, `positionY` and `positionZ` of the
            trajectory.
        times_ps: Picoseconds of simulated time, in ascending order.
        values: NaN if the variable was removed or is not a number.
        unit: Unit of the values; "" if there is none or it is unknown.
    """

    part: str
    name: str
    times_ps: Times
    values: Values
    unit: str = ""


class _Samples:
    """Rows of numbers that differ from those before, at most one in each interval.

    Later rows are held until the interval is over.
    """

    def __init__(self, count: int, interval_ps: int, *, is_continuous: bool) -> None:
        """Record rows of `count` numbers; with `is_continuous`, also the end of a period without changes."""
        self._interval_ps = interval_ps
        self._is_continuous = is_continuous
        self._times: Times = array("q")
        self._count = count
        self._values: Values = array("d")  # row by row
        self._last: tuple[float, ...] | None = None
        self._held: tuple[int, tuple[float, ...]] | None = None

    def add(self, time_ps: int, values: tuple[float, ...]) -> None:
        """Record a row."""
        if self._last is None:
            self._append(time_ps, values)
            return
        if values == self._last:
            self._held = (time_ps, values) if self._is_continuous else None
            return
        due_ps = self._times[-1] + self._interval_ps
        if time_ps < due_ps:
            self._held = (time_ps, values)
            return
        if self._held is not None:
            held_ps, held = self._held
            held_ps = max(held_ps, due_ps)
            if held_ps < time_ps:
                self._append(held_ps, held)
                self.add(time_ps, values)
                return
        self._append(time_ps, values)

    def rows(self) -> tuple[Times, tuple[Values, ...]]:
        """Return copies of the times and of the columns up to now, including the held row."""
        rows = len(self._values) // self._count  # without one that Ctrl-C interrupted
        times, values = self._times[:rows], self._values[: rows * self._count]
        if self._held is not None:
            times.append(self._held[0])
            values.extend(self._held[1])
        return times, tuple(values[place :: self._count] for place in range(self._count))

    def _append(self, time_ps: int, values: tuple[float, ...]) -> None:
        self._held = None
        self._times.append(time_ps)
        self._values.extend(values)
        self._last = values


class NodeRecorder:
    """The growing vectors of one node."""

    def __init__(self, interval_s: float = 0.0) -> None:
        """Record changes, at most one per `interval_s` for each vector."""
        self._interval_ps = round(interval_s * _PS_PER_S)
        self._tracked: dict[str, _Samples] = {}
        self._positions = _Samples(3, self._interval_ps, is_continuous=True)

    def variable_set(self, time_ps: int, name: str, value: object) -> None:
        """Record the new value of a tracked variable; None if it was removed.

        A variable that has never been a number is not recorded.
        """
        number = as_float(value)
        samples = self._tracked.get(name)
        if samples is None:
            if number is None:
                return
            samples = self._tracked[name] = _Samples(1, self._interval_ps, is_continuous=False)
        # Always the same NaN, which is equal to itself in a tuple.
        samples.add(time_ps, (_NAN if number is None or number != number else number,))

    def position_told(self, time_ps: int, x: float, y: float, z: float) -> None:
        """Record the position of the node, in meters."""
        self._positions.add(time_ps, (x, y, z))

    def vectors(self) -> tuple[Vector, ...]:
        """Return the vectors up to now, the tracked variables in the order of their first numbers.

        The arrays are copies: an array with a view (`numpy.asarray`) cannot grow.
        """
        tracked = []
        for name, samples in self._tracked.items():
            times_ps, (values,) = samples.rows()
            tracked.append(Vector("protocol", key_text(name), times_ps, values))
        times_ps, coordinates = self._positions.rows()
        positions = [
            Vector("mobility", f"position{axis}", times_ps, values, "m")
            for axis, values in zip("XYZ", coordinates, strict=True)
        ]
        return (*tracked, *positions)


def recorders_of(vectors_of: Iterable[int], count: int, interval_s: float = 0.0) -> dict[int, NodeRecorder]:
    """Return a recorder for each node with these ids, out of `count` nodes; see `NodeRecorder`.

    Raises TypeError and ValueError like `checked_ids`.
    """
    ids = sorted(set(checked_ids("vectors_of", vectors_of, count)))
    return {node_id: NodeRecorder(interval_s) for node_id in ids}


def checked_ids(argument: str, ids: Iterable[int], count: int, expected: str = "") -> list[int]:
    """Return the ids in `argument`, out of `count` nodes, as Python integers.

    Raises TypeError for a value that is not an id, and ValueError for an id that no node has. `expected` is
    for the first message.
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
