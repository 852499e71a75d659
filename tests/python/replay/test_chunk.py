import json
from array import array
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.replay.chunk import RawChunk, pack, raw, unpack
from gradysim.replay.tables import ARRAY_TYPES, BROADCAST, TABLES, Column

NO_COUNTS = {"bin_ns": 1, "frames": [], "lost": []}, {"node": [], "outcome": [], "count": []}


def chunk_of(table, rows):
    """Return a chunk with one table, whose columns all have the same rows."""
    columns = {
        name: {column.name: raw(column, rows if name == table else []) for column in declared}
        for name, declared in TABLES.items()
    }
    return RawChunk(5, 7, ["", "é <"], columns, *NO_COUNTS)


@given(rows=st.lists(st.integers(0, 255)).map(sorted), table=st.sampled_from(sorted(TABLES)))
def test_what_is_packed_comes_back(rows, table):
    chunk = unpack(pack(chunk_of(table, rows)))
    assert (chunk.start_ns, chunk.end_ns, chunk.strings) == (5, 7, ["", "é <"])
    for column in TABLES[table]:
        assert chunk.tables[table][column.name] == array(ARRAY_TYPES[column.type], rows)


def test_the_header_has_the_sums_of_each_sender():
    frames = [
        {"node": 4, "destination": BROADCAST, "receptions": 2, "unnoticed": 1},
        {"node": 4, "destination": BROADCAST, "receptions": 0, "unnoticed": 3},
        {"node": 4, "destination": 7, "receptions": 0, "unnoticed": 1},
    ]
    empty = chunk_of("events", [])
    columns = {
        column.name: raw(column, [frame.get(column.name, 0) for frame in frames])
        for column in TABLES["frames"]
    }
    packed = pack(replace(empty, columns={**empty.columns, "frames": columns}))
    header, _ = json.JSONDecoder().raw_decode(packed[4:].decode(errors="replace"))
    assert header["sent"] == {
        "node": [4, 4],
        "destination": [BROADCAST, 7],
        "frames": [2, 1],
        "receptions": [6, 1],
        "unnoticed": [4, 1],
    }


def test_the_header_has_the_box_that_nodes_move_in():
    # The second leg of node 1 is not over when the chunk ends, at 7 ns.
    legs = [
        {"node": 1, "time_ns": 1, "duration_ns": 2, "x0": 3.0, "x1": 5.0},
        {"node": 2, "time_ns": 1, "duration_ns": 9, "y0": -1.0, "y1": -1.0},
        {"node": 1, "time_ns": 3, "duration_ns": 8, "x0": 5.0, "x1": 13.0},
    ]
    empty = chunk_of("events", [])
    columns = {
        column.name: raw(column, [leg.get(column.name, 0) for leg in legs]) for column in TABLES["legs"]
    }
    packed = pack(replace(empty, columns={**empty.columns, "legs": columns}))
    header, _ = json.JSONDecoder().raw_decode(packed[4:].decode(errors="replace"))
    assert header["extent_m"] == [0, -1, 0, 9, 0, 0]


def test_a_delta_column_has_differences():
    assert raw(Column("time_ns", "u64", delta=True), [3, 3, 10]) == array("Q", [3, 0, 7]).tobytes()


@pytest.mark.parametrize("data", [b"", b"\x05\0\0\0{}", b"\x02\0\0\0{}"])
def test_what_is_no_chunk_is_refused(data):
    with pytest.raises(ValueError, match="chunk"):
        unpack(data)
