import enum

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.plugin.raft.value import carried_value, same_value, typed_value


class Colour(enum.IntEnum):
    RED = 1


@pytest.mark.parametrize(
    "value", [1, True, 1.5, "text", [1, [2]], (1, 2), {"a": [1]}, ""], ids=lambda value: repr(value)
)
def test_a_value_arrives_as_it_was(value):
    kind = type(value)
    assert typed_value(kind, carried_value("v", kind, value)) == value


@pytest.mark.parametrize(
    ("value", "arrives"),
    [
        ((1, (2, 3)), (1, [2, 3])),
        ([(1, 2)], [[1, 2]]),
        ([Colour.RED], [1]),
        ({1: (2, 3)}, {"1": [2, 3]}),
        ({True: 1, None: 2, 1.5: 3}, {"true": 1, "null": 2, "1.5": 3}),
    ],
    ids=repr,
)
def test_what_is_inside_arrives_as_json_has_it(value, arrives):
    kind = type(value)
    shown = typed_value(kind, carried_value("v", kind, value))
    assert (type(shown), repr(shown)) == (kind, repr(arrives))


@given(st.recursive(st.integers() | st.text() | st.floats(allow_nan=False), lambda inner: st.lists(inner)))
def test_any_value_that_json_has_arrives_as_it_was(value):
    assert typed_value(object, carried_value("v", object, value)) == value


def test_a_value_is_a_copy():
    value = [1]
    carried = carried_value("v", list, value)
    value.append(2)
    assert carried == [1]


def test_what_is_read_is_a_copy():
    carried = [1]
    typed_value(list, carried).append(2)
    assert carried == [1]


@pytest.mark.parametrize(
    ("kind", "value", "complaint"),
    [
        (int, "x", "must be of type int, got 'x'"),
        (float, 1, "must be of type float"),
        (int, None, "must be of type int"),
        (set, {1}, "JSON cannot carry"),
        (bytes, b"x", "JSON cannot carry"),
        (Colour, Colour.RED, "a Colour arrives as 1"),
    ],
)
def test_what_does_not_arrive_is_an_error(kind, value, complaint):
    with pytest.raises(ValueError, match=complaint):
        carried_value("v", kind, value)


@pytest.mark.parametrize(
    ("first", "second", "answer"),
    [
        (1, 1, True),
        (1, 1.0, False),
        (1, True, False),
        ([1], [True], False),
        ({"a": 1, "b": 2}, {"b": 2, "a": 1}, True),
    ],
)
def test_which_values_are_the_same(first, second, answer):
    assert same_value(first, second) is answer
