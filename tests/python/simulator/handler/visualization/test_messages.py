import json
import math

import pytest
from hypothesis import given

from gradysim.simulator.handler.visualization import VisualizationConfiguration
from gradysim.simulator.handler.visualization.messages import CommandQueue, is_pause_or_resume, snapshot
from gradysim.simulator.node import Node
from python.any_value import anything


class Bearer:
    """Protocol, provider and encapsulator in one object."""

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


@pytest.mark.parametrize(
    "text", ["", "{", "[]", "[" * 1000, '"pause/resume"', '{"interaction": "stop"}', b"\xff\xfe"]
)
def test_anything_else_is_refused(text):
    with pytest.raises(ValueError, match="pause/resume"):
        is_pause_or_resume(text)


def paint(node_id, color):
    return {"command": "paint_node", "payload": {"node_id": node_id, "color": color}}


def taken(queue):
    return [queue.get() for _ in range(queue.qsize())]


def test_first_in_first_out():
    queue = CommandQueue()
    for color in range(3):
        queue.put(paint(0, color))
    assert taken(queue) == [paint(0, 0), paint(0, 1), paint(0, 2)]


def test_when_they_become_many_the_last_of_each_kind_and_node_stay():
    queue = CommandQueue()
    for color in range(10_001):
        queue.put(paint(color % 3, color))
    assert taken(queue) == [paint(2, 9998), paint(0, 9999), paint(1, 10000)]


def test_its_length_is_bounded():
    queue = CommandQueue()
    for color in range(100_000):
        queue.put(paint(color % 7, color))
    assert queue.qsize() <= 10_000


def test_many_nodes_are_all_kept():
    queue = CommandQueue()
    for color in range(3):
        for node_id in range(12_000):
            queue.put(paint(node_id, color))
    last = {command["payload"]["node_id"]: command["payload"]["color"] for command in taken(queue)}
    assert last == dict.fromkeys(range(12_000), 2)


def test_the_defaults_are_the_published_ones():
    assert VisualizationConfiguration() == VisualizationConfiguration(
        information_collection_interval=0.01,
        update_rate=0.05,
        x_range=(-50, 50),
        y_range=(-50, 50),
        z_range=(0, 50),
        host="localhost",
        port=5678,
        open_browser=False,
    )


@pytest.mark.parametrize(
    "wrong",
    [
        {"information_collection_interval": 0},
        {"information_collection_interval": math.inf},
        {"update_rate": -1},
        {"update_rate": "fast"},
        {"x_range": (1, -1)},
        {"y_range": (0, math.nan)},
        {"z_range": 5},
        {"port": -1},
        {"port": 65536},
        {"port": "5678"},
    ],
)
def test_wrong_values_are_refused_by_name(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        VisualizationConfiguration(**wrong)
