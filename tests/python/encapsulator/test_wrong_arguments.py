"""The texts of pybind11 in other words; that real ones are, the conformance tests say."""

import pytest

from gradysim.encapsulator.wrong_arguments import reword_wrong_arguments

NODE = "<gradysim._netsim.Node object at 0x7ffb7c65ea70>"


def reworded(name: str, invoked: str) -> str:
    failure = TypeError(
        f"{name}(): incompatible function arguments. The following argument types are supported:\n"
        f"    1. (self: gradysim._netsim.Node, timer: object)\n\nInvoked with: {invoked}"
    )
    reword_wrong_arguments(failure)
    return str(failure)


@pytest.mark.parametrize(
    ("invoked", "text"),
    [
        (f"{NODE}, 't'", "('t'): missing a required argument: 'timestamp'"),
        (f"{NODE}", "(): missing a required argument: 'timer'"),
        (f"{NODE}, 1, 2, 3", "(1, 2, 3): too many positional arguments"),
        (f"{NODE}, 1; kwargs: timer='t'", "(1, timer='t'): multiple values for argument 'timer'"),
        (
            f"{NODE}; kwargs: timer='t', timestamp=1, zone=2",
            "(timer='t', timestamp=1, zone=2): got an unexpected keyword argument 'zone'",
        ),
        (f"{NODE}, <object at 0x7>", "(<object at 0x7>): these are the wrong arguments"),
        (f"{NODE}, '{300 * 'x'}'", f"('{199 * 'x'}…): missing a required argument: 'timestamp'"),
    ],
)
def test_it_says_what_is_wrong(invoked: str, text: str) -> None:
    assert (
        reworded("schedule_timer", invoked)
        == f"schedule_timer{text}; expected schedule_timer(timer, timestamp)"
    )


@pytest.mark.parametrize(("name", "invoked"), [("frobnicate", NODE), ("schedule_timer", "<something else>")])
def test_what_is_no_call_of_the_provider_stays(name: str, invoked: str) -> None:
    assert "incompatible function arguments" in reworded(name, invoked)


def test_other_exceptions_stay() -> None:
    for failure in (TypeError("schedule_timer() is wrong"), ValueError("no"), TypeError()):
        before = failure.args
        reword_wrong_arguments(failure)
        assert failure.args == before
