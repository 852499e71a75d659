import math
from array import array

import pytest

from gradysim.results.omnetpp import RunIdentity, write_vector_file
from gradysim.results.recorder import Vector
from python.sqlite_rows import rows_of

IDENTITY = RunIdentity("A-0-20261123-05:00:00-7", {}, {}, ())
SECOND_PS = 10**12


@pytest.fixture
def rows(tmp_path):
    """`rows(vectors, query)`: rows of a file with these vectors, {(module, name): {time: value}}."""

    def of(vectors, query):
        path = tmp_path / "A.vec"
        written = [
            (module, Vector(part, name, array("q", times), array("d", values)))
            for module, part, name, times, values in vectors
        ]
        write_vector_file(written, IDENTITY, path)
        return rows_of(path, query)

    return of


HEARD = ("Network.uavs[0].protocol", "protocol", "heard", [1, 3, 3], [5.0, 6.0, 8.0])
SENT = ("Network.uavs[0].protocol", "protocol", "sent", [2, 3], [1.0, math.nan])


def test_each_vector_with_its_statistics(rows):
    assert rows([HEARD], "SELECT * FROM vector") == [
        (1, 1, "Network.uavs[0].protocol", "heard:vector", 3, 5.0, 8.0, 19.0, 125.0, 0, 0, 1, 3)
    ]


def test_rows_vector_by_vector_in_the_order_of_time(rows):
    found = rows([HEARD, SENT], "SELECT vectorId, eventNumber, simtimeRaw, value FROM vectorData")
    assert found == [(1, 0, 1, 5.0), (1, 0, 3, 6.0), (1, 0, 3, 8.0), (2, 0, 2, 1.0), (2, 0, 3, None)]


def test_times_beyond_what_floats_tell_apart(rows):
    late = 9_200_000 * SECOND_PS
    vectors = [("N.a", "protocol", "v", [late - 1, late], [1.0, 2.0])]
    assert rows(vectors, "SELECT simtimeRaw FROM vectorData") == [(late - 1,), (late,)]


def test_sums_of_what_is_not_always_a_number_are_none_either(rows):
    found = rows([SENT], "SELECT vectorCount, vectorMin, vectorMax, vectorSum, vectorSumSqr FROM vector")
    assert found == [(2, 1.0, 1.0, None, None)]


def test_of_infinities(rows):
    vectors = [("N.a", "protocol", "v", [1, 2], [math.inf, 1e300])]
    found = rows(vectors, "SELECT vectorMin, vectorMax, vectorSum, vectorSumSqr FROM vector")
    assert found == [(1e300, math.inf, math.inf, math.inf)]


def test_a_vector_without_rows(rows):
    vectors = [("N.a.mobility", "mobility", "positionX", [], [])]
    found = rows(vectors, "SELECT vectorCount, vectorMin, vectorMax, vectorSum, startSimtimeRaw FROM vector")
    assert found == [(0, math.inf, -math.inf, 0.0, 0)]


def test_no_vector_at_all(rows):
    assert rows([], "SELECT * FROM vectorData") == []


def test_attributes_say_how_to_draw_it(rows):
    vectors = [HEARD, ("Network.uavs[0].mobility", "mobility", "positionX", [1], [1.0])]
    found = rows(vectors, "SELECT * FROM vectorAttr")
    assert found == [
        (1, "title", "heard"),
        (1, "source", "heard"),
        (1, "recordingmode", "vector"),
        (1, "interpolationmode", "sample-hold"),
        (2, "title", "positionX"),
        (2, "source", "positionX"),
        (2, "recordingmode", "vector"),
        (2, "interpolationmode", "linear"),
    ]


def test_the_rows_of_a_vector_are_found_by_an_index(rows):
    assert rows([HEARD], "SELECT name, tbl_name FROM sqlite_master WHERE type = 'index'") == [
        ("vectorData_idx", "vectorData")
    ]


def test_times_and_values_that_are_not_as_many_are_an_error(rows):
    with pytest.raises(ValueError, match="shorter"):
        rows([("N.a", "protocol", "v", [1, 2], [1.0])], "SELECT * FROM vectorData")
