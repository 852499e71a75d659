import math

import pytest

from gradysim.results.recorder import NodeRecorder, checked_ids, recorders_of


def tracked(*changes, interval_s=0.0):
    """Return the recorded part of (time, value) pairs of one variable, with NaN as "nan"."""
    recorder = NodeRecorder(interval_s)
    for time_ps, value in changes:
        recorder.variable_set(time_ps, "v", value)
    vectors = [vector for vector in recorder.vectors() if vector.part == "protocol"]
    return [
        [
            (time, "nan" if math.isnan(value) else value)
            for time, value in zip(vector.times_ps, vector.values, strict=True)
        ]
        for vector in vectors
    ]


def moved(*places, interval_s=0.0):
    """Return the recorded rows of (time, x) pairs."""
    recorder = NodeRecorder(interval_s)
    for time_ps, x in places:
        recorder.position_told(time_ps, x, 0.0, 0.0)
    x = recorder.vectors()[0]
    return list(zip(x.times_ps, x.values, strict=True))


def test_each_change_is_a_row():
    assert tracked((1, 5), (2, 5), (2, True), (3, 0.5)) == [[(1, 5), (2, 1), (3, 0.5)]]


def test_an_interval_has_one_row_and_the_last_value_of_it():
    changes = [(0, 0), (2, 1), (4, 2), (50, 3), (51, 4)]
    assert tracked(*changes, interval_s=10e-12) == [[(0, 0), (10, 2), (50, 3), (51, 4)]]


def test_a_value_that_comes_back_within_the_interval_is_no_change():
    assert tracked((0, 0), (2, 1), (4, 0), (50, 0), interval_s=10e-12) == [[(0, 0)]]


def test_a_node_that_stands_has_two_rows():
    assert moved(*((time, 7.0) for time in range(1000))) == [(0, 7.0), (999, 7.0)]


def test_a_node_stands_until_it_moves_again():
    places = [(1, 0.0), (2, 1.0), (3, 1.0), (4, 1.0), (5, 2.0), (6, 2.0)]
    assert moved(*places) == [(1, 0.0), (2, 1.0), (4, 1.0), (5, 2.0), (6, 2.0)]


def test_a_moving_node_has_a_row_in_each_interval_and_one_at_the_end():
    rows = moved(*((time, float(time)) for time in range(25)), interval_s=10e-12)
    assert [time for time, _ in rows] == [0, 10, 20, 24]


def test_what_is_never_a_number_has_no_vector():
    assert tracked((1, "on"), (2, None), (3, 10**400)) == []


def test_a_vector_begins_with_the_first_number_and_has_gaps():
    changes = [(1, "off"), (2, 7), (3, "off"), (4, 8), (5, None), (6, 10**400), (7, math.nan)]
    assert tracked(*changes) == [[(2, 7), (3, "nan"), (4, 8), (5, "nan")]]


def test_an_infinity_is_a_number():
    assert tracked((1, math.inf), (2, -math.inf)) == [[(1, math.inf), (2, -math.inf)]]


def test_positions_are_three_vectors_with_the_same_times():
    recorder = NodeRecorder()
    recorder.position_told(5, 1.0, 2.0, 3.0)
    recorder.position_told(9, 1.5, 2.0, 3.0)
    vectors = recorder.vectors()
    assert [(vector.name, list(vector.values), vector.unit) for vector in vectors] == [
        ("positionX", [1.0, 1.5], "m"),
        ("positionY", [2.0, 2.0], "m"),
        ("positionZ", [3.0, 3.0], "m"),
    ]
    assert {tuple(vector.times_ps) for vector in vectors} == {(5, 9)}


def test_who_looks_at_the_arrays_does_not_stop_the_recording():
    recorder = NodeRecorder()
    recorder.variable_set(1, "v", 7)
    recorder.position_told(1, 1.0, 2.0, 3.0)
    views = [memoryview(array) for vector in recorder.vectors() for array in (vector.times_ps, vector.values)]
    recorder.variable_set(2, "v", 8)
    recorder.position_told(2, 1.5, 2.0, 3.0)
    assert {len(view) for view in views} == {1}
    assert {len(vector.values) for vector in recorder.vectors()} == {2}


def test_a_row_that_is_not_whole_is_left_out():
    recorder = NodeRecorder()
    recorder.position_told(1, 1.0, 2.0, 3.0)
    with pytest.raises(TypeError):
        recorder.position_told(2, 1.5, None, 3.0)
    assert [list(vector.values) for vector in recorder.vectors()] == [[1.0], [2.0], [3.0]]


def test_a_name_that_is_no_text_becomes_one():
    recorder = NodeRecorder()
    recorder.variable_set(1, 5, 7)
    assert recorder.vectors()[0].name == "5"


def test_ids_name_nodes():
    assert list(recorders_of([2, 0, 2], 3)) == [0, 2]


def test_ids_of_numpy_are_ids():
    numpy = pytest.importorskip("numpy")
    (node_id,) = checked_ids("outcomes_at", [numpy.int64(1)], 2)
    assert type(node_id) is int


@pytest.mark.parametrize("node_id", [-1, 3])
def test_an_id_that_no_node_has_is_an_error(node_id):
    with pytest.raises(ValueError, match=f"^vectors_of: .* {node_id}; "):
        recorders_of([0, node_id], 3)


@pytest.mark.parametrize("ids", [True, "all", [0.5], [None]])
def test_other_kinds_of_ids_are_an_error(ids):
    with pytest.raises(TypeError, match=r"^vectors_of = .*range\(3\)"):
        recorders_of(ids, 3)
