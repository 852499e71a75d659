"""Whether a protocol can be called as environments call it.

Python finds a wrong signature only when the callback is called: in the middle of a run, or never. Decorators
are taken at their own word, not at that of what they wrap: a wrapper of `*args` may be called with anything.
"""

import inspect
from types import FunctionType

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.errors import BadValue

_CALLBACKS = {
    name: tuple(inspect.signature(vars(IProtocol)[name]).parameters)
    for name in ("initialize", "handle_timer", "handle_packet", "handle_telemetry", "finish")
}
"""Their arguments, with `self`; all are given by position."""


def check_contract(protocol: type[IProtocol]) -> None:
    """Check the constructor and the callbacks of a complete protocol.

    Raises:
        BadValue: One cannot be called as it will be, or its code would not run then.
    """
    if vars(IProtocol)["instantiate"] is inspect.getattr_static(protocol, "instantiate"):
        _check(protocol, "__init__", ("self",))
    for name, arguments in _CALLBACKS.items():
        _check(protocol, name, arguments)


def _check(protocol: type[IProtocol], name: str, arguments: tuple[str, ...]) -> None:
    found = inspect.getattr_static(protocol, name)
    given = arguments
    if isinstance(found, staticmethod | classmethod):
        found, given = getattr(protocol, name), arguments[1:]
    elif not isinstance(found, FunctionType):
        if hasattr(found, "__get__"):
            return  # what it makes of itself at an instance is its own business
        given = arguments[1:]
    expected = f"`def {name}({', '.join(arguments)})`"
    if not callable(found):
        raise BadValue(f"`{name}` of `{protocol.__name__}` is {found!r}", expected=expected)
    written = _signature(found)
    if written is not None and not _takes(written, given):
        what = f"`{name}{written}` of `{protocol.__name__}`{_place(found)}"
        call = f"with `{arguments[1]}` alone" if arguments[1:] else "without arguments"
        raise BadValue(f"{what} cannot be called {call}", expected=expected)
    if inspect.iscoroutinefunction(found) or inspect.isasyncgenfunction(found):
        what = "is asynchronous, and nothing would await it"
    elif inspect.isgeneratorfunction(found):
        what = "is a generator, as it has a `yield`, and its code would not run"
    else:
        return
    raise BadValue(f"`{name}` of `{protocol.__name__}`{_place(found)} {what}", expected=expected)


def _signature(function: object) -> inspect.Signature | None:
    """What the function itself takes; None if nothing tells."""
    if "__signature__" in getattr(function, "__dict__", {}):
        return None  # what somebody wants to be shown
    try:
        return inspect.signature(function, follow_wrapped=False)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        return None


def _takes(signature: inspect.Signature, arguments: tuple[str, ...]) -> bool:
    try:
        signature.bind(*arguments)
    except TypeError:
        return False
    return True


def _place(function: object) -> str:
    code = getattr(inspect.unwrap(function), "__code__", None)  # type: ignore[arg-type]
    return f" ({code.co_filename}:{code.co_firstlineno})" if code else ""
