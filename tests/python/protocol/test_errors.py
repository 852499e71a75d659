import asyncio

import pytest

from gradysim.protocol.errors import add_protocol_note


class ZigZagMobile:
    pass


def notes_on(exception, time_s=12.5):
    add_protocol_note(exception, node_id=3, protocol=ZigZagMobile, time_s=time_s, callback="handle_timer")
    return getattr(exception, "__notes__", [])


def test_the_note_names_callback_node_and_time():
    assert notes_on(RuntimeError("x")) == [
        "in handle_timer of node 3 (ZigZagMobile 3) at 12.5 s of simulated time"
    ]


@pytest.mark.parametrize(
    ("time_s", "text"), [(0, "0"), (0.1 + 0.2, "0.3"), (28800, "28800"), (7199.990001, "7199.990001")]
)
def test_times_are_rounded_to_12_digits(time_s, text):
    assert f" {text} s " in notes_on(RuntimeError(), time_s)[0]


@pytest.mark.parametrize("exception", [SystemExit(3), asyncio.CancelledError(), GeneratorExit()])
def test_other_base_exceptions_get_a_note(exception):
    assert notes_on(exception) == notes_on(RuntimeError())


def test_ctrl_c_gets_the_note_of_the_callback_that_does_not_return():
    assert notes_on(KeyboardInterrupt()) == notes_on(ValueError())
