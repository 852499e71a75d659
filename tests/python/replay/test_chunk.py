from array import array

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.replay.chunk import RawChunk, pack, raw, unpack
from gradysim.replay.tables import ARRAY_TYPES, TABLES, Column

NO_COUNTS = {"bin_ns": 1, "frames": [], "lost": []}, {"node": [], "outcome": [], "count": []}


def chunk_of(table, rows):
    """A chunk with one table, whose columns all have the same rows."""
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


def test_a_delta_column_has_differences():
    assert raw(Column("time_ns", "u64", delta=True), [3, 3, 10]) == array("Q", [3, 0, 7]).tobytes()


@pytest.mark.parametrize("data", [b"", b"\x05\0\0\0{}", b"\x02\0\0\0{}"])
def test_what_is_no_chunk_is_refused(data):
    with pytest.raises(ValueError, match="not a chunk"):
        unpack(data)
