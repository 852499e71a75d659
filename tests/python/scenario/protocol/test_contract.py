"""Classes that cannot be called as protocols are, and unusual ones that can."""

import re
from collections.abc import Callable
from functools import partial, partialmethod, wraps
from typing import Any

import pytest

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.errors import BadValue
from gradysim.scenario.protocol.contract import check_contract
from python.quiet_protocol import Quiet


def with_members(**members: object) -> type[IProtocol]:
    return type("Tested", (Quiet,), members)


def refusal(**members: object) -> BadValue:
    with pytest.raises(BadValue) as caught:
        check_contract(with_members(**members))
    return caught.value


def traced(function: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(function)
    def wrapper(*args: Any, **keywords: Any) -> Any:
        return function(*args, **keywords)

    return wrapper


def given_a_clock(function: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(function)
    def wrapper(self: Any, timer: str) -> None:
        function(self, timer, 0.0)

    return wrapper


def told(clock: float, timer: str) -> None: ...


class Told:
    def __call__(self, timer: str) -> None: ...


async def coroutine(self: Any, timer: str) -> None: ...


def generator(self: Any, timer: str) -> Any:
    yield timer


async def asynchronous_generator(self: Any, timer: str) -> Any:
    yield timer


@pytest.mark.parametrize(
    ("name", "function", "problem", "expected"),
    [
        ("handle_timer", lambda self: None, "cannot be called with `timer` alone", "(self, timer)"),
        ("handle_timer", lambda self, timer, clock: None, "with `timer` alone", "(self, timer)"),
        ("handle_packet", lambda self: None, "cannot be called with `message` alone", "(self, message)"),
        ("handle_packet", lambda self, *, message: None, "with `message` alone", "(self, message)"),
        ("handle_telemetry", lambda: None, "with `telemetry` alone", "(self, telemetry)"),
        ("handle_timer", staticmethod(lambda self, timer: None), "with `timer` alone", "(self, timer)"),
        ("handle_timer", classmethod(lambda cls: None), "with `timer` alone", "(self, timer)"),
        ("initialize", lambda self, stage: None, "cannot be called without arguments", "(self)"),
        ("finish", lambda: None, "cannot be called without arguments", "(self)"),
        ("__init__", lambda self, speed: None, "cannot be called without arguments", "(self)"),
        ("handle_timer", coroutine, "is asynchronous, and nothing would await it", "(self, timer)"),
        ("handle_timer", asynchronous_generator, "is asynchronous", "(self, timer)"),
        ("handle_timer", generator, "is a generator, as it has a `yield`", "(self, timer)"),
        ("handle_timer", None, "`handle_timer` of `Tested` is None", "(self, timer)"),
    ],
)
def test_refused(name: str, function: object, problem: str, expected: str) -> None:
    error = refusal(**{name: function})
    assert problem in str(error)
    assert error.expected == f"`def {name}{expected}`"


def test_the_place_of_the_function_is_told() -> None:
    line = coroutine.__code__.co_firstlineno
    assert re.search(rf"test_contract\.py:{line}\) is asynchronous", str(refusal(handle_timer=coroutine)))


@pytest.mark.parametrize(
    "function",
    [
        lambda self, timer, clock=0.0: None,
        lambda self, timer, *more, **keywords: None,
        lambda *arguments: None,
        lambda self, name: None,
        staticmethod(lambda timer: None),
        classmethod(lambda cls, timer: None),
        traced(lambda self, timer: None),
        given_a_clock(lambda self, timer, clock: None),
        partialmethod(lambda self, clock, timer: None, 0.0),
        partial(told, 0.0),
        Told(),
        print,
        property(lambda self: print),
    ],
)
def test_handlers_that_can_be_called(function: object) -> None:
    check_contract(with_members(handle_timer=function))


@pytest.mark.parametrize(
    "constructor", [lambda self: None, lambda self, speed=3.0: None, lambda *arguments, **keywords: None]
)
def test_constructors_that_can_be_called(constructor: object) -> None:
    check_contract(with_members(__init__=constructor))


def test_who_makes_its_own_instances_may_have_any_constructor() -> None:
    check_contract(
        with_members(
            __init__=lambda self, speed: None, instantiate=classmethod(lambda cls, provider: cls(speed=3.0))
        )
    )


def test_a_signature_that_only_is_shown_does_not_count() -> None:
    @traced
    def handler(self: Any, timer: str) -> None: ...

    handler.__signature__ = "(self)"  # type: ignore[attr-defined]
    check_contract(with_members(handle_timer=handler))
