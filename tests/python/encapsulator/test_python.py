import logging
from types import SimpleNamespace

import pytest

from gradysim.encapsulator.python import PythonEncapsulator, PythonProvider
from gradysim.encapsulator.random_stream import Purpose, RandomStream
from gradysim.protocol.messages.communication import BroadcastMessageCommand
from gradysim.protocol.messages.mobility import SetSpeedMobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry
from python.recording_protocol import RecordingProtocol


class Handler:
    """Logs every call of a provider, as (name, *arguments)."""

    def __init__(self):
        self.calls = []

    def handle_command(self, *arguments):
        self.calls.append(("handle_command", *arguments))

    def set_timer(self, *arguments):
        self.calls.append(("set_timer", *arguments))

    def cancel_timer(self, *arguments):
        self.calls.append(("cancel_timer", *arguments))

    def get_current_time(self):
        return 12.5


CALLBACKS = [
    ("initialize", ()),
    ("handle_timer", ("tick",)),
    ("handle_packet", ("hello",)),
    ("handle_telemetry", (Telemetry((1, 2, 3)),)),
    ("finish", ()),
]


@pytest.fixture
def node():
    return SimpleNamespace(id=3, seed=9)


@pytest.mark.parametrize(
    ("label", "order", "expected"),
    [
        ("communication", ("send_communication_command", BroadcastMessageCommand("a")), "handle_command"),
        ("mobility", ("send_mobility_command", SetSpeedMobilityCommand(1)), "handle_command"),
        ("timer", ("schedule_timer", "t", 1.0), "set_timer"),
        ("timer", ("cancel_timer", "t"), "cancel_timer"),
    ],
)
def test_orders_go_to_the_handler_of_their_label(node, label, order, expected):
    handler = Handler()
    name, *arguments = order
    getattr(PythonProvider(node, **{label: handler}), name)(*arguments)
    assert handler.calls == [(expected, *arguments, node)]


@pytest.mark.parametrize(
    ("label", "order"),
    [
        ("communication", ("send_communication_command", BroadcastMessageCommand("a"))),
        ("mobility", ("send_mobility_command", SetSpeedMobilityCommand(1))),
        ("timer", ("schedule_timer", "t", 1.0)),
        ("timer", ("cancel_timer", "t")),
    ],
)
def test_without_a_handler_an_order_is_dropped_with_a_warning(node, caplog, label, order):
    name, *arguments = order
    getattr(PythonProvider(node), name)(*arguments)
    assert [record.levelno for record in caplog.records] == [logging.WARNING]
    assert f" no {label} " in caplog.text


def test_the_time_is_the_timers(node):
    assert PythonProvider(node, timer=Handler()).current_time() == 12.5


def test_without_timers_the_time_is_zero(node, caplog):
    assert PythonProvider(node).current_time() == 0
    assert caplog.messages == ["Node 3 has no timer handler: the time is unknown"]


def test_the_id_is_the_nodes(node):
    assert PythonProvider(node).get_id() == 3


def test_other_handlers_can_be_found(node):
    handler = Handler()
    assert PythonProvider(node, visualization=handler).handlers == {"visualization": handler}


def test_the_stream_is_the_nodes_in_this_run(node):
    assert PythonProvider(node).random.random() == RandomStream(9, 3, Purpose.PROTOCOL).random()


def test_a_node_without_a_seed_has_a_stream_too():
    provider = PythonProvider(SimpleNamespace(id=3))
    assert provider.random.random() == RandomStream(0, 3, Purpose.PROTOCOL).random()


def test_tracked_variables_start_empty(node):
    assert PythonProvider(node).tracked_variables == {}


@pytest.mark.parametrize(("callback", "arguments"), CALLBACKS)
def test_callbacks_reach_the_protocol(node, callback, arguments):
    encapsulator = PythonEncapsulator(node)
    encapsulator.encapsulate(RecordingProtocol)
    getattr(encapsulator, callback)(*arguments)
    assert encapsulator.protocol.calls == [(callback, *arguments)]


@pytest.mark.parametrize(("callback", "arguments"), CALLBACKS)
def test_an_exception_passes_with_one_note(node, callback, arguments):
    def fail(self, *arguments):
        raise LookupError("broken")

    encapsulator = PythonEncapsulator(node, timer=Handler())
    encapsulator.encapsulate(type("Failing", (RecordingProtocol,), {callback: fail}))
    with pytest.raises(LookupError, match="broken") as raised:
        getattr(encapsulator, callback)(*arguments)
    assert raised.value.__notes__ == [f"in {callback} of node 3 (Failing 3) at 12.5 s of simulated time"]


def test_a_failing_constructor_is_noted(node):
    class Failing(RecordingProtocol):
        def __init__(self):
            raise LookupError("broken")

    with pytest.raises(LookupError) as raised:
        PythonEncapsulator(node).encapsulate(Failing)
    assert raised.value.__notes__ == ["in __init__ of node 3 (Failing 3) at 0 s of simulated time"]


def test_a_callback_replaced_later_is_the_one_called(node):
    encapsulator = PythonEncapsulator(node)
    encapsulator.encapsulate(RecordingProtocol)
    seen = []
    encapsulator.protocol.handle_timer = seen.append
    encapsulator.handle_timer("tick")
    assert seen == ["tick"]


def test_the_stream_goes_on_from_draw_to_draw():
    provider = PythonProvider(SimpleNamespace(id=3))
    assert provider.random is provider.random
