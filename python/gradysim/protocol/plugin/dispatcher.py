"""Lets others take part in the callbacks of a protocol: the base of every plugin.

A dispatcher puts a chain of handlers in front of each of the five callbacks of one protocol instance.
It lives on that instance and dies with it.
"""

from collections.abc import Callable
from enum import Enum
from typing import Any

from gradysim.protocol.interface import CALLBACKS, IProtocol
from gradysim.protocol.messages.telemetry import Telemetry

_ATTRIBUTE = "_gradysim_dispatcher"


class DispatchReturn(Enum):
    """What a handler wants to become of the event that it was given.

    Attributes:
        INTERRUPT: The event ends here: neither the handlers behind nor the protocol get it.
        CONTINUE: The next in the chain gets it too. Returning nothing means the same.
    """

    INTERRUPT = 1
    CONTINUE = 2


_INTERRUPT = DispatchReturn.INTERRUPT  # looking up a member of an enumeration takes longer than a call


class _Chain:
    """One callback of a protocol with the handlers in front of it."""

    def __init__(self, protocol: IProtocol, callback: str, dispatch: str) -> None:
        self._protocol = protocol
        self._callback = callback
        self._original: Callable[..., None] = getattr(protocol, callback)
        # A tuple, replaced on every change: an event under way keeps the chain that it started with.
        self._handlers: tuple[Callable[..., Any], ...] = ()
        setattr(protocol, callback, getattr(self, dispatch))

    def dispatch_event(self, event: Any) -> None:
        """A timer, a packet or telemetry."""
        for handler in self._handlers:
            if handler(self._protocol, event) is _INTERRUPT:
                return
        self._original(event)

    def dispatch_to_all(self) -> None:
        """`initialize` and `finish` have no argument and reach everybody."""
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

    Handlers are called with the protocol and the arguments of its callback. The one registered last is called
    first, the protocol's own callback last. `DispatchReturn.INTERRUPT` stops a timer, a packet or telemetry
    on its way; it has no effect on `initialize` and `finish`, which always reach everybody. Registering and
    unregistering while an event is being handled counts from the next event on.
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

    Raises TypeError if what it is given has not the callbacks of a protocol.
    """
    wrapper: ProtocolWrapper | None = getattr(protocol, "__dict__", {}).get(_ATTRIBUTE)
    if wrapper is None:
        if isinstance(protocol, type) or not all(hasattr(protocol, name) for name in CALLBACKS):
            raise TypeError(f"expected a protocol (a plugin's first argument is `self`), got {protocol!r}")
        wrapper = ProtocolWrapper(protocol)
        setattr(protocol, _ATTRIBUTE, wrapper)
    return wrapper
