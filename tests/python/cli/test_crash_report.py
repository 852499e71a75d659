from io import StringIO

import pytest

from gradysim.cli.errors import PACKAGE, from_users_code, print_failure
from gradysim.integrated.capture import CaptureError
from gradysim.protocol.errors import CommunicationException, NativeProtocolError, TimerException

USER = "/home/user/protocol.py"
OURS = str(PACKAGE / "integrated" / "run.py")


def function_in(filename, source):
    namespace = {}
    exec(compile(source, filename, "exec"), namespace)
    return namespace["function"]


def failure_through(*filenames):
    """Return an exception raised in a file of the last name, called from the name before it, and so on."""

    function = function_in(filenames[-1], "def function(): raise RuntimeError('spoilt')")
    for filename in reversed(filenames[:-1]):
        caller = function_in(filename, "def function(): return inner()")
        caller.__globals__["inner"] = function
        function = caller
    try:
        function()
    except RuntimeError as failure:
        # Without the frame of this function.
        return failure.with_traceback(failure.__traceback__.tb_next)


def files_of(frames):
    files = []
    while frames is not None:
        files.append(frames.tb_frame.f_code.co_filename)
        frames = frames.tb_next
    return files


def test_the_traceback_starts_at_the_users_code():
    failure = failure_through(OURS, OURS, USER)
    assert files_of(from_users_code(failure.__traceback__)) == [USER]


def test_what_the_users_code_called_stays():
    failure = failure_through(OURS, USER, OURS)
    assert files_of(from_users_code(failure.__traceback__)) == [USER, OURS]


def test_a_failure_of_our_own_is_shown_whole():
    failure = failure_through(OURS, OURS)
    assert files_of(from_users_code(failure.__traceback__)) == [OURS, OURS]


def test_notes_are_printed():
    failure = failure_through(OURS, USER)
    failure.add_note("in handle_timer of node 3")
    text = StringIO()
    print_failure(failure, text)
    assert text.getvalue().startswith("Traceback ")
    assert text.getvalue().splitlines()[-2:] == ["RuntimeError: spoilt", "in handle_timer of node 3"]
    assert OURS not in text.getvalue()


@pytest.mark.parametrize("kind", [CommunicationException, TimerException])
def test_a_refused_command_ends_at_the_users_line(kind):
    failure = failure_through(OURS, USER, OURS)
    text = StringIO()
    print_failure(kind("spoilt").with_traceback(failure.__traceback__), text)
    assert USER in text.getvalue()
    assert OURS not in text.getvalue()
    assert text.getvalue().endswith("spoilt\n")


def test_a_refused_command_of_our_own_is_shown_whole():
    failure = failure_through(OURS, OURS)
    text = StringIO()
    print_failure(TimerException("in the past").with_traceback(failure.__traceback__), text)
    assert text.getvalue().count(OURS) == 2


@pytest.mark.parametrize("kind", [NativeProtocolError, CaptureError])
def test_what_no_code_of_the_user_led_to_has_no_frames_to_show(kind):
    text = StringIO()
    try:
        raise kind("no message")
    except kind as failure:
        failure.add_note("in handle_timer of node 3")
        print_failure(failure, text)
    assert text.getvalue().splitlines() == [
        f"{kind.__module__}.{kind.__name__}: no message",
        "in handle_timer of node 3",
    ]
