"""Records what the numbers of a node are over time; whoever runs the node tells it."""

from array import array
from collections.abc import Iterable, Sized

from gradysim.protocol.plain_value import as_float, key_text
from gradysim.results.node_ids import checked_ids
from gradysim.results.vector import Times, Values, Vector

_NAN = float("nan")


class NodeRecorder:
    """The vectors of one node, while they grow."""

    def __init__(self) -> None:
        self._tracked: dict[str, tuple[Times, Values]] = {}
        self._position_times: Times = array("q")
        self._positions: tuple[Values, Values, Values] = (array("d"), array("d"), array("d"))

    def variable_set(self, time_ps: int, name: str, value: object) -> None:
        """Record what a tracked variable is from now on; None if it was removed.

        Of a variable that has never been a number nothing is recorded.
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
        """Record where the node is, in metres."""
        self._position_times.append(time_ps)
        for coordinates, value in zip(self._positions, (x, y, z), strict=True):
            coordinates.append(value)

    def vectors(self) -> tuple[Vector, ...]:
        """Return what was recorded up to now, the tracked variables in the order of their first numbers.

        These are copies, since an array that somebody has a view of (`numpy.asarray`) cannot grow.
        """
        tracked = []
        for name, (times_ps, values) in self._tracked.items():
            count = _whole_rows(times_ps, values)
            tracked.append(Vector("protocol", key_text(name), times_ps[:count], values[:count]))
        count = _whole_rows(self._position_times, *self._positions)
        times_ps = self._position_times[:count]
        positions = [
            Vector("mobility", f"position{axis}", times_ps, coordinates[:count], "m")
            for axis, coordinates in zip("XYZ", self._positions, strict=True)
        ]
        return (*tracked, *positions)


def _whole_rows(*columns: Sized) -> int:
    """How many rows there are, without one that Ctrl-C came into."""
    return min(map(len, columns))


def recorders_of(vectors_of: Iterable[int], count: int) -> dict[int, NodeRecorder]:
    """Return a recorder for each of the nodes with these ids, of `count` nodes.

    Raises TypeError for what is no id, and ValueError for one that is not there.
    """
    expected = f"ids of nodes, such as [0], or range({count}) for all"
    ids = sorted(set(checked_ids("vectors_of", vectors_of, count, expected)))
    return {node_id: NodeRecorder() for node_id in ids}
