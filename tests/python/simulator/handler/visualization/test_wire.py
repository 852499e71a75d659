import json
import math

import pytest
from hypothesis import given

from gradysim.simulator.handler.visualization.messages import is_pause_or_resume, snapshot
from gradysim.simulator.node import Node
from python.any_value import anything


class Bearer:
    """A protocol, its provider and its encapsulator in one."""

    def __init__(self, tracked_variables):
        self.tracked_variables = tracked_variables
        self.provider = self.protocol = self


def sent(tracked_variables):
    node = Node()
    node.id, node.position = 0, (0.0, 0.0, 0.0)
    node.protocol_encapsulator = Bearer(tracked_variables)
    return json.loads(snapshot([node], 0.0, 0.0), parse_constant=pytest.fail)["tracked_variables"][0]


class Mute:
    def __repr__(self):
        raise RuntimeError


def nested(depth):
    value = 0
    for _ in range(depth):
        value = [value]
    return value


class Odd:
    def __repr__(self):
        return "an odd one"


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (Odd(), "an odd one"),
        ({1, 2}, "{1, 2}"),
        (b"bytes", "b'bytes'"),
        (math.nan, "nan"),
        ([math.inf, 1], ["inf", 1]),
        ({(1, 2): Odd()}, {"(1, 2)": "an odd one"}),
        ((1, "two", None, True), [1, "two", None, True]),
    ],
)
def test_what_json_cannot_say_is_sent_as_its_repr(value, shown):
    assert sent({"odd": Odd(), "value": value})["value"] == shown


@pytest.mark.parametrize("make", [Mute, lambda: 2**20_000, lambda: nested(100_000)])
def test_what_cannot_even_be_shown_does_not_stop_the_simulation(make):
    assert sent({"value": make(), "other": 1})["other"] == 1


def test_numbers_of_numpy_are_sent_as_numbers():
    numpy = pytest.importorskip("numpy")
    assert sent({"count": numpy.int64(3), "levels": numpy.array([1.5])}) == {"count": 3, "levels": [1.5]}


def test_what_holds_itself_is_cut_off():
    endless = []
    endless.append(endless)
    assert "[...]" in json.dumps(sent({"endless": endless}))


@given(anything)
def test_whatever_is_tracked_can_be_sent(value):
    sent({"value": value})


def test_a_node_without_a_provider_has_no_tracked_variables():
    node = Node()
    node.id, node.position, node.protocol_encapsulator = 0, (0.0, 0.0, 0.0), object()
    assert json.loads(snapshot([node], 0.0, 0.0))["tracked_variables"] == [{}]


def test_pause_and_resume():
    assert is_pause_or_resume('{"interaction": "pause/resume"}')


@pytest.mark.parametrize("text", ["", "{", "[]", '"pause/resume"', '{"interaction": "stop"}', b"\xff\xfe"])
def test_anything_else_is_refused(text):
    with pytest.raises(ValueError, match="pause/resume"):
        is_pause_or_resume(text)
