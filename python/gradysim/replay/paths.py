"""Where nodes are during a chunk of a replay."""

from bisect import bisect_right
from collections import defaultdict

from gradysim.protocol.position import Position
from gradysim.replay.chunk import Chunk


class Paths:
    """The legs of a chunk, by node."""

    def __init__(self, chunk: Chunk) -> None:
        self._legs = chunk.tables["legs"]
        self._rows: defaultdict[int, list[int]] = defaultdict(list)
        for row, node in enumerate(self._legs["node"]):
            self._rows[node].append(row)
        self.nodes = sorted(self._rows)

    def position(self, node: int, time_ns: float) -> Position:
        """Return the position of a node in meters; before its first leg, where that begins."""
        legs, rows = self._legs, self._rows[node]
        row = rows[max(0, bisect_right(rows, time_ns, key=legs["time_ns"].__getitem__) - 1)]
        since_ns, duration_ns = time_ns - legs["time_ns"][row], legs["duration_ns"][row]
        share = 1.0 if since_ns >= duration_ns else max(0.0, since_ns / duration_ns)
        x, y, z = (
            legs[f"{axis}0"][row] + share * (legs[f"{axis}1"][row] - legs[f"{axis}0"][row]) for axis in "xyz"
        )
        return x, y, z
