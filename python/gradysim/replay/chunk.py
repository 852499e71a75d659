"""Encoding of a chunk of a replay.

    4 bytes    length of the header, little-endian
    header     JSON, see `Chunk.header`
    columns    one after the other, in the order of the header

A column is an array of little-endian numbers, or of their differences if it is declared so. The first bytes
of all numbers come first, then the second ones, and so on, compressed with zlib. Bytes at the same place are
similar, so that this compresses much better.
"""

import json
import struct
import sys
import zlib
from array import array
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import accumulate
from typing import Any, TypeAlias, TypedDict

from gradysim.replay.tables import ARRAY_TYPES, BROADCAST, BYTES, TABLES, Column

Values: TypeAlias = "array[Any]"

_LEVEL = 6
_OF_OTHER_HEADERS = (KeyError, TypeError, AttributeError, OverflowError, RecursionError)


@dataclass
class RawChunk:
    """A chunk before it is packed.

    Attributes:
        start_ns: Start of the chunk: the end of the last one.
        end_ns: End of the chunk.
        strings: Strings that columns refer to.
        columns: {table: {column: little-endian numbers, differences where the column is declared so}}.
        density: Number of frames and losses over time.
        outcomes: Number of receptions of each outcome at each node.
    """

    start_ns: int
    end_ns: int
    strings: Sequence[str]
    columns: Mapping[str, Mapping[str, bytes]]
    density: "Density"
    outcomes: "Outcomes"


class Density(TypedDict):
    """Counts of successive intervals from the start of a chunk on. The first one includes earlier events.

    Attributes:
        bin_ns: Length of an interval.
        frames: Number of frames that started.
        lost: Number of lost receptions that started.
    """

    bin_ns: int
    frames: Sequence[int]
    lost: Sequence[int]


class Outcomes(TypedDict):
    """Counts of receptions, a row for each node and outcome that occurred.

    Attributes:
        node: Id of the receiver.
        outcome: Number of the outcome.
        count: Number of receptions.
    """

    node: Sequence[int]
    outcome: Sequence[int]
    count: Sequence[int]


@dataclass
class Chunk:
    """A decoded chunk.

    Attributes:
        start_ns: Start of the chunk. It includes frames whose last reception ended later.
        end_ns: End of the chunk.
        strings: Strings that columns refer to.
        tables: {table: {column: its values}}.
    """

    start_ns: int
    end_ns: int
    strings: list[str]
    tables: dict[str, dict[str, Values]] = field(default_factory=dict)

    def rows(self, table: str, *columns: str) -> Iterator[tuple[Any, ...]]:
        """Yield the rows of some columns of a table."""
        return zip(*(self.tables[table][column] for column in columns), strict=True)

    def messages(self) -> list[str]:
        """Return the beginnings of the messages, by the values of the column `text` of frames."""
        data, texts, end = bytes(self.tables["text_bytes"]["byte"]), [""], 0
        for size in self.tables["texts"]["recorded"]:
            texts.append(data[end : end + size].decode(errors="replace"))
            end += size
        return texts


def pack(chunk: RawChunk) -> bytes:
    """Return the bytes of a chunk."""
    header: dict[str, Any] = {
        "start_ns": chunk.start_ns,
        "end_ns": chunk.end_ns,
        "strings": list(chunk.strings),
        "density": chunk.density,
        "outcomes": chunk.outcomes,
        "sent": _sent(chunk),
        "extent_m": _extent_m(chunk),
        "tables": {},
    }
    packed: list[bytes] = []
    for table, columns in TABLES.items():
        described = []
        rows = 0
        for column in columns:
            data = chunk.columns[table][column.name]
            width = BYTES[column.type]
            rows = len(data) // width
            packed.append(zlib.compress(b"".join(data[byte::width] for byte in range(width)), _LEVEL))
            described.append([column.name, column.type, column.delta, len(packed[-1])])
        header["tables"][table] = {"rows": rows, "columns": described}
    text = json.dumps(header, separators=(",", ":")).encode()
    return b"".join([struct.pack("<I", len(text)), text, *packed])


class Sent(TypedDict):
    """Sums of the frames of a chunk, a row for each sender.

    Frames with an outcome only at their destination have a row for each destination.

    Attributes:
        node: Id of the sender.
        destination: Id of the only receiver, or `BROADCAST`.
        frames: Number of sent frames.
        receptions: Number of their outcomes, including those that were not noticed.
        unnoticed: Number of those that were not noticed.
    """

    node: Sequence[int]
    destination: Sequence[int]
    frames: Sequence[int]
    receptions: Sequence[int]
    unnoticed: Sequence[int]


def _sent(chunk: RawChunk) -> Sent:
    columns = {
        column.name: _numbers(column, chunk.columns["frames"][column.name])
        for column in TABLES["frames"]
        if column.name in ("node", "destination", "receptions", "unnoticed")
    }
    sums: dict[tuple[int, int], list[int]] = {}
    for node, destination, noticed, unnoticed in zip(*columns.values(), strict=True):
        only = destination if noticed + unnoticed == 1 else BROADCAST
        counts = sums.setdefault((node, only), [0, 0, 0])
        counts[0] += 1
        counts[1] += noticed + unnoticed
        counts[2] += unnoticed
    frames, receptions, unnoticed_by = ([counts[column] for counts in sums.values()] for column in range(3))
    return {
        "node": [node for node, _ in sums],
        "destination": [destination for _, destination in sums],
        "frames": frames,
        "receptions": receptions,
        "unnoticed": unnoticed_by,
    }


def _extent_m(chunk: RawChunk) -> list[float]:
    """Return the smallest and the largest x, y and z of all nodes, in meters, which the first view shows."""
    time_ns, duration_ns, node, *ends = (
        _numbers(column, chunk.columns["legs"][column.name]) for column in TABLES["legs"]
    )
    starts, targets = ends[:3], ends[3:]
    last = {who: row for row, who in enumerate(node)}.values()
    extent = []
    for start, target in zip(starts, targets, strict=True):
        # A leg that the chunk ends, or a later one, may not reach its target.
        for row in last:
            share = min(1.0, (chunk.end_ns - time_ns[row]) / max(duration_ns[row], 1))
            start.append(start[row] + share * (target[row] - start[row]))
        extent.append((min(start, default=0.0), max(start, default=0.0)))
    return [value for corner in zip(*extent, strict=True) for value in corner]


def unpack(data: bytes) -> Chunk:
    """Return the chunk with these bytes. Raise ValueError if they are not a chunk."""
    try:
        (length,) = struct.unpack_from("<I", data)
        header = json.loads(data[4 : 4 + length])
        chunk = Chunk(header["start_ns"], header["end_ns"], header["strings"])
        offset = 4 + length
        for table, described in header["tables"].items():
            columns = chunk.tables[table] = {}
            for name, type_name, delta, size in described["columns"]:
                columns[name] = _values(Column(name, type_name, delta), data[offset : offset + size])
                offset += size
    except (struct.error, zlib.error, *_OF_OTHER_HEADERS) as error:
        raise ValueError(f"not a chunk of a replay: {error}") from error
    return chunk


def unpacked(chunk: RawChunk) -> Chunk:
    """Return a chunk as if it had been encoded and decoded."""
    tables = {
        table: {column.name: _numbers(column, chunk.columns[table][column.name]) for column in columns}
        for table, columns in TABLES.items()
    }
    return Chunk(chunk.start_ns, chunk.end_ns, list(chunk.strings), tables)


def raw(column: Column, values: Sequence[int] | Sequence[float]) -> bytes:
    """Return the numbers of a column in the format of `RawChunk`."""
    if column.delta:
        values = [value - before for value, before in zip(values, [0, *values], strict=False)]
    return _little_endian(array(ARRAY_TYPES[column.type], values)).tobytes()


def _values(column: Column, packed: bytes) -> Values:
    shuffled = zlib.decompress(packed)
    width = BYTES[column.type]
    rows = len(shuffled) // width
    data = bytearray(len(shuffled))
    for byte in range(width):
        data[byte::width] = shuffled[byte * rows : (byte + 1) * rows]
    return _numbers(column, bytes(data))


def _numbers(column: Column, data: bytes) -> Values:
    values = array(ARRAY_TYPES[column.type], data)
    _little_endian(values)
    return array(values.typecode, accumulate(values)) if column.delta else values


def _little_endian(values: Values) -> Values:
    if sys.byteorder == "big":
        values.byteswap()
    return values
