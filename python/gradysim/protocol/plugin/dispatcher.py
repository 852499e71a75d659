"""Dispatcher: a chain of handlers in front of each callback of one protocol. The base of every plugin.

The protocol instance owns its dispatcher.
"""

from collections.abc import Callable
from enum import Enum
from typing import Any

from gradysim.protocol.interface import CALLBACKS, IProtocol
from gradysim.protocol.messages.telemetry import Telemetry

_ATTRIBUTE = "_gradysim_dispatcher"


class DispatchReturn(Enum):
    """Return value of a handler.

    Attributes:
        INTERRUPT: The later handlers and the protocol do not get the event.
        CONTINUE: The next handler gets the event, too. Returning None means the same.
    """

    INTERRUPT = 1
    CONTINUE = 2


_INTERRUPT = DispatchReturn.INTERRUPT  # the lookup of an enumeration's member takes longer than a call


class _Chain:
    """One callback of a protocol with the handlers in front of it."""

    def __init__(self, protocol: IProtocol, callback: str, dispatch: str) -> None:
        self._protocol = protocol
        self._callback = callback
        self._original: Callable[..., None] = getattr(protocol, callback)
        # A tuple, replaced on every change: an event in progress keeps its chain.
        self._handlers: tuple[Callable[..., Any], ...] = ()
        setattr(protocol, callback, getattr(self, dispatch))

    def dispatch_event(self, event: Any) -> None:
        """Dispatch a timer, a packet or telemetry."""
        for handler in self._handlers:
            if handler(self._protocol, event) is _INTERRUPT:
                return
        self._original(event)

    def dispatch_to_all(self) -> None:
        """Dispatch `initialize` or `finish`, which reach every handler."""
        for handler in self._handlers:
            handler(self._protocol)
        self._original()

    def register(self, handler: Callable[..., Any]) -> None:
        if not callable(handler):
            raise TypeError(f"a handler of {self._callback} must be callable, not {handler!r}")
        self._handlers = (handler, *self._handlers)

    def unregister(self, handler: Callable[..., Any]) -> None:
        remaining = list(self._handlers)
        try:
            remaining.remove(handler)
        except ValueError:
            raise ValueError(f"{handler!r} is not registered as a handler of {self._callback}") from None
        self._handlers = tuple(remaining)


class ProtocolWrapper:
    """The handlers registered on one protocol; made by `create_dispatcher`.

    Handlers are called with the protocol and the arguments of its callback. The handler registered last is
    called first, the protocol's own callback last. `DispatchReturn.INTERRUPT` stops a timer, a packet or
    telemetry; it has no effect on `initialize` and `finish`. Changes during an event take effect at the next
    event.
    """

    def __init__(self, protocol: IProtocol) -> None:
        self.protocol = protocol
        self._initialize = _Chain(protocol, "initialize", "dispatch_to_all")
        self._handle_timer = _Chain(protocol, "handle_timer", "dispatch_event")
        self._handle_telemetry = _Chain(protocol, "handle_telemetry", "dispatch_event")
        self._handle_packet = _Chain(protocol, "handle_packet", "dispatch_event")
        self._finish = _Chain(protocol, "finish", "dispatch_to_all")

    def register_initialize(self, handler: Callable[[Any], DispatchReturn | None]) -> None:
        """Call `handler(protocol)` before the protocol's `initialize`."""
        self._initialize.register(handler)

    def unregister_initialize(self, handler: Callable[[Any], DispatchReturn | None]) -> None:
        """Undo `register_initialize`; ValueError if it is not registered."""
        self._initialize.unregister(handler)

    def register_handle_timer(self, handler: Callable[[Any, str], DispatchReturn | None]) -> None:
        """Call `handler(protocol, timer)` before the protocol's `handle_timer`."""
        self._handle_timer.register(handler)

    def unregister_handle_timer(self, handler: Callable[[Any, str], DispatchReturn | None]) -> None:
        """Undo `register_handle_timer`; ValueError if it is not registered."""
        self._handle_timer.unregister(handler)

    def register_handle_telemetry(self, handler: Callable[[Any, Telemetry], DispatchReturn | None]) -> None:
        """Call `handler(protocol, telemetry)` before the protocol's `handle_telemetry`."""
        self._handle_telemetry.register(handler)

    def unregister_handle_telemetry(self, handler: Callable[[Any, Telemetry], DispatchReturn | None]) -> None:
        """Undo `register_handle_telemetry`; ValueError if it is not registered."""
        self._handle_telemetry.unregister(handler)

    def register_handle_packet(self, handler: Callable[[Any, str], DispatchReturn | None]) -> None:
        """Call `handler(protocol, message)` before the protocol's `handle_packet`."""
        self._handle_packet.register(handler)

    def unregister_handle_packet(self, handler: Callable[[Any, str], DispatchReturn | None]) -> None:
        """Undo `register_handle_packet`; ValueError if it is not registered."""
        self._handle_packet.unregister(handler)

    def register_finish(self, handler: Callable[[Any], DispatchReturn | None]) -> None:
        """Call `handler(protocol)` before the protocol's `finish`."""
        self._finish.register(handler)

    def unregister_finish(self, handler: Callable[[Any], DispatchReturn | None]) -> None:
        """Undo `register_finish`; ValueError if it is not registered."""
        self._finish.unregister(handler)


def create_dispatcher(protocol: IProtocol) -> ProtocolWrapper:
    """Return the dispatcher of a protocol, the same one each time; the first call makes it.

    Raises TypeError if `protocol` does not have the callbacks of a protocol.
    """
    wrapper: ProtocolWrapper | None = getattr(protocol, "__dict__", {}).get(_ATTRIBUTE)
    if wrapper is None:
        if isinstance(protocol, type) or not all(hasattr(protocol, name) for name in CALLBACKS):
            raise TypeError(f"expected a protocol (a plugin's first argument is `self`), got {protocol!r}")
        wrapper = ProtocolWrapper(protocol)
        setattr(protocol, _ATTRIBUTE, wrapper)
    return wrapper
