import gc
import weakref

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.plugin.dispatcher import DispatchReturn, create_dispatcher
from python.recording_protocol import RecordingProtocol

ARGUMENTS = {
    "initialize": (),
    "handle_timer": ("timer",),
    "handle_packet": ("message",),
    "handle_telemetry": ("telemetry",),
    "finish": (),
}
INTERRUPTIBLE = ["handle_timer", "handle_packet", "handle_telemetry"]


class Recorder(RecordingProtocol):
    def note(self, *call):
        self.calls.append("own")


def register(protocol, callback, handler):
    getattr(create_dispatcher(protocol), f"register_{callback}")(handler)


def unregister(protocol, callback, handler):
    getattr(create_dispatcher(protocol), f"unregister_{callback}")(handler)


def call(protocol, callback):
    getattr(protocol, callback)(*ARGUMENTS[callback])


def noting(name, answer=None):
    def handler(protocol, *arguments):
        protocol.calls.append(name)
        return answer

    return handler


def test_one_protocol_has_one_dispatcher():
    protocol = Recorder()
    assert create_dispatcher(protocol) is create_dispatcher(protocol)


def test_two_protocols_have_two_dispatchers():
    assert create_dispatcher(Recorder()) is not create_dispatcher(Recorder())


def test_a_dispatcher_does_not_keep_its_protocol_alive():
    protocol = Recorder()
    create_dispatcher(protocol)
    gone = weakref.ref(protocol)
    del protocol
    gc.collect()
    assert gone() is None


@pytest.mark.parametrize("callback", ARGUMENTS)
def test_handlers_run_last_registered_first_and_the_protocol_last(callback):
    protocol = Recorder()
    register(protocol, callback, noting("first"))
    register(protocol, callback, noting("second"))
    call(protocol, callback)
    assert protocol.calls == ["second", "first", "own"]


@pytest.mark.parametrize("callback", ARGUMENTS)
def test_handlers_get_the_protocol_and_the_arguments(callback):
    protocol = Recorder()
    seen = []
    register(protocol, callback, lambda *arguments: seen.append(arguments))
    call(protocol, callback)
    assert seen == [(protocol, *ARGUMENTS[callback])]


@pytest.mark.parametrize("callback", INTERRUPTIBLE)
def test_interrupt_stops_an_event(callback):
    protocol = Recorder()
    register(protocol, callback, noting("behind"))
    register(protocol, callback, noting("interrupting", DispatchReturn.INTERRUPT))
    call(protocol, callback)
    assert protocol.calls == ["interrupting"]


@pytest.mark.parametrize("callback", ["initialize", "finish"])
def test_beginning_and_end_cannot_be_interrupted(callback):
    protocol = Recorder()
    register(protocol, callback, noting("behind"))
    register(protocol, callback, noting("interrupting", DispatchReturn.INTERRUPT))
    call(protocol, callback)
    assert protocol.calls == ["interrupting", "behind", "own"]


@pytest.mark.parametrize("answer", [None, DispatchReturn.CONTINUE, 1, True])
def test_any_other_answer_continues(answer):
    protocol = Recorder()
    register(protocol, "handle_timer", noting("handler", answer))
    protocol.handle_timer("timer")
    assert protocol.calls == ["handler", "own"]


@pytest.mark.parametrize("callback", ARGUMENTS)
def test_an_unregistered_handler_is_not_called(callback):
    protocol = Recorder()
    handler = noting("handler")
    register(protocol, callback, handler)
    unregister(protocol, callback, handler)
    call(protocol, callback)
    assert protocol.calls == ["own"]


@pytest.mark.parametrize("callback", ARGUMENTS)
def test_unregistering_a_stranger_is_an_error(callback):
    with pytest.raises(ValueError, match=callback):
        unregister(Recorder(), callback, noting("stranger"))


@pytest.mark.parametrize("wrong", [object(), None, "self", Recorder], ids=["object", "None", "text", "class"])
def test_what_is_no_protocol_has_no_dispatcher(wrong):
    with pytest.raises(TypeError, match=r"protocol .*`self`"):
        create_dispatcher(wrong)


def test_a_handler_must_be_callable():
    with pytest.raises(TypeError):
        register(Recorder(), "handle_timer", "not a function")


def test_a_handler_that_unregisters_itself_does_not_hide_the_next():
    protocol = Recorder()

    def once(instance, timer):
        instance.calls.append("once")
        unregister(instance, "handle_timer", once)

    register(protocol, "handle_timer", noting("behind"))
    register(protocol, "handle_timer", once)
    protocol.handle_timer("timer")
    protocol.handle_timer("timer")
    assert protocol.calls == ["once", "behind", "own", "behind", "own"]


def test_a_handler_registered_during_an_event_waits_for_the_next():
    protocol = Recorder()

    def registering(instance, timer):
        register(instance, "handle_timer", noting("new"))
        unregister(instance, "handle_timer", registering)

    register(protocol, "handle_timer", registering)
    protocol.handle_timer("timer")
    protocol.handle_timer("timer")
    assert protocol.calls == ["own", "new", "own"]


@given(st.lists(st.tuples(st.booleans(), st.integers(0, 4)), max_size=20))
def test_the_chain_is_a_stack_with_removal(operations):
    protocol = Recorder()
    handlers = [noting(number) for number in range(5)]
    expected = []
    for adding, number in operations:
        if adding:
            register(protocol, "handle_packet", handlers[number])
            expected.insert(0, number)
        elif number in expected:
            unregister(protocol, "handle_packet", handlers[number])
            expected.remove(number)
    protocol.handle_packet("message")
    assert protocol.calls == [*expected, "own"]
